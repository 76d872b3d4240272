/* hm_segindex: a spatial index of line segments. Layer 2.
 *
 * A bucket grid of about one segment a bucket; queries visit buckets outward from the point. Cells
 * are never so small that the segments would lie in more than a few of them on average. Queries are
 * read-only: threads may share an index.
 */
#ifndef HM_SEGINDEX_H
#define HM_SEGINDEX_H

#include "hm_base.h"

struct hm_segindex;

struct hm_segment {
    double a[3], b[3];
    int32_t line;  /* the caller's number of the line */
    int32_t piece; /* and of the piece in that line */
};

/* Index n segments; they are copied. n = 0 is allowed: every query finds nothing. */
enum hm_err hm_segindex_build(struct hm_segindex **x, const struct hm_segment *s, size_t n,
                              struct hm_diag *d);
void hm_segindex_free(struct hm_segindex *x);

/* The segment nearest to (x, y) in the plane within `reach`; NULL when there is none. foot[3] gets
 * the nearest place on it (z interpolated), *distance the distance. Ties: lowest line, then piece.
 */
const struct hm_segment *hm_segindex_nearest(const struct hm_segindex *x, double px, double py,
                                             double reach, double foot[3], double *distance);

/* Call visit for each segment that has a point inside the box or on its border (exactly), each
 * once, in ascending order of (line, piece); visit returns false to stop. */
void hm_segindex_box(const struct hm_segindex *x, const double lo[2], const double hi[2],
                     bool (*visit)(void *arg, const struct hm_segment *s), void *arg);

/* The place on segment a b (2 or 3 doubles each; only x and y count) nearest to (x, y), as the part
 * 0 .. 1 of the way from a to b; 0 for a segment of no length. */
double hm_segment_project(const double *a, const double *b, double x, double y);

/* Do the closed segments a b and c d (x, y) have a point in common? Exact. When they do, xy gets
 * one (rounded); of segments on one line, an end point. */
bool hm_segment_meet(const double *a, const double *b, const double *c, const double *d,
                     double xy[2]);

#endif
