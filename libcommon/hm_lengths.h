/* hm_lengths: the bounds that the edges of an irregular mesh are held to. Layer 6. */
#ifndef HM_LENGTHS_H
#define HM_LENGTHS_H

struct hm_lengths {
    double least, most; /* m */
    double clearance;   /* m: free nodes nearer to a fixed edge make slivers and are taken out */
};

#endif
