/* hm_hull: convex hull of points. Layer 2. */
#ifndef HM_HULL_H
#define HM_HULL_H

#include "hm_base.h"

/* The corners of the convex hull of n points (point i is xy[i*stride], xy[i*stride + 1]) as numbers
 * of points, counter-clockwise from the leftmost; points on its edges are none. *hull is malloc'd.
 * Exact. HM_EGEOM when all points lie on one line or are fewer than three. */
enum hm_err hm_hull_build(const double *xy, size_t n, size_t stride, size_t **hull, size_t *nhull,
                          struct hm_diag *d);

#endif
