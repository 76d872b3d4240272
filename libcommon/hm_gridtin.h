/* hm_gridtin: heights at the nodes of an anchored lattice from a TIN. Layer 6. */
#ifndef HM_GRIDTIN_H
#define HM_GRIDTIN_H

#include "hm_anchor.h"
#include "hm_tin.h"

struct hm_gridtin_count {
    size_t gap;     /* nodes in triangles with an edge over the limit */
    size_t outside; /* nodes beyond the hull of the points */
};

/* z[a->nx * a->ny], row after row: linear in each triangle; NaN outside the hull and in triangles
 * with an edge over `gap` (metres; 0: no limit). Nodes on the border of what is covered belong to
 * it. The values depend on the triangulation's shape alone, not on its numbering nor on the number
 * of threads. */
enum hm_err hm_gridtin(double *z, const struct hm_anchor *a, const struct hm_tin *tin, double gap,
                       int threads, struct hm_gridtin_count *count, struct hm_diag *d);

#endif
