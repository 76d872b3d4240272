/* hm_gridtin: heights at the nodes of an anchored lattice from a triangulation. Layer 6. */
#ifndef HM_GRIDTIN_H
#define HM_GRIDTIN_H

#include "hm_anchor.h"
#include "hm_tri.h"

struct hm_gridtin_count {
    size_t gap;     /* nodes in triangles with an edge over the limit */
    size_t outside; /* nodes beyond the hull of the points */
};

/* z[a->nx * a->ny], row after row: linear in each triangle, from the height of each vertex; NaN
 * outside the hull and in triangles with an edge over `gap` (metres). Nodes on the border of what
 * is covered belong to it. The values depend on the triangulation's shape alone, not on its
 * numbering nor on the number of threads. */
enum hm_err hm_gridtin(double *z, const struct hm_anchor *a, const struct hm_tri *t,
                       const double *height, double gap, int threads,
                       struct hm_gridtin_count *count, struct hm_diag *d);

/* Heights by vertex of a triangulation of n points x, y, z; the mean where points share a vertex.
 * *height is malloc'd. */
enum hm_err hm_gridtin_heights(double **height, const struct hm_tri *t, const double *xyz, size_t n,
                               struct hm_diag *d);

#endif
