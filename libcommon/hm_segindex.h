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

#endif
