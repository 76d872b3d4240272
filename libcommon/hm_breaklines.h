/* hm_breaklines: the breaklines of a run, indexed, to find banks on. Layer 6. */
#ifndef HM_BREAKLINES_H
#define HM_BREAKLINES_H

#include "hm_line.h"
#include "hm_segindex.h"

struct hm_breaklines {
    const struct hm_line **line;
    double **behind; /* of line k: its length before each vertex, and in all (pieces + 1 numbers) */
    bool *sided;     /* steep on its left, as lines with limit= are */
    size_t n;
    struct hm_segindex *index;
};

/* The lines without a role in n sets. The sets must outlive it. */
enum hm_err hm_breaklines_build(struct hm_breaklines **b, const struct hm_lines *sets, size_t n,
                                struct hm_diag *d);
void hm_breaklines_free(struct hm_breaklines *b);

/* The point of line l at s from its start; around in a closed one, else kept within it. */
void hm_breaklines_at(const struct hm_breaklines *b, int32_t l, double s, double xy[2]);

/* How far from s1 to s2 along line l, the shorter way around a closed one. */
double hm_breaklines_way(const struct hm_breaklines *b, int32_t l, double s1, double s2);

/* The first breakline on the way between two points, as a part of the way, of those that run within
 * 60 degrees of the direction `along` (a unit vector), either way; infinite when there is none. */
double hm_breaklines_first(const struct hm_breaklines *b, const double from[2], const double to[2],
                           const double along[2]);

#endif
