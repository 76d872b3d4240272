/* hm_meshstat: sizes and shapes of the elements of a mesh. Layer 6. */
#ifndef HM_MESHSTAT_H
#define HM_MESHSTAT_H

#include "hm_mesh.h"

enum {
    HM_MESHSTAT_BINS = 18, /* of 5 degrees each: smallest angles of elements, 0 .. 90 */
    HM_MESHSTAT_WORST = 10
};

/* A measure and where it was taken: middle of an element, or of an edge between two. */
struct hm_measure {
    double value, x, y;
};

struct hm_meshstat {
    size_t nodes, triangles, quads;
    double area;                               /* of all elements, m² */
    struct hm_measure area_least, area_most;   /* m² */
    struct hm_measure angle_least, angle_most; /* corner angles, degrees */
    struct hm_measure edge_ratio;        /* largest: longest over shortest edge of an element */
    struct hm_measure area_ratio;        /* largest: larger over smaller of two neighbours */
    double edge_ratio_mean;              /* over the elements */
    int64_t neighbours, jumps;           /* pairs of neighbours; those of area ratio over 2 */
    int64_t below[3];                    /* elements with an angle under 10, 20, 30 degrees */
    int64_t histogram[HM_MESHSTAT_BINS]; /* elements by smallest angle */
    struct hm_measure worst[HM_MESHSTAT_WORST]; /* smallest angles first, one an element */
    size_t nworst;
};

/* Values that do not exist (no element, no neighbours) are NaN. */
enum hm_err hm_meshstat_run(const struct hm_mesh *m, struct hm_meshstat *s, struct hm_diag *d);

/* The share of elements in percent; NaN without elements. */
double hm_meshstat_percent(const struct hm_meshstat *s, int64_t count);

#endif
