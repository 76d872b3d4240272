/* hm_settle: smoothing that leaves a mesh as near to the measurements as it is. Layer 6.
 *
 * Laplace smoothing, as hm_smooth: a free node moves to the mean of its neighbours, or part of the
 * way, and gets the height of the terrain there. But only where that makes no angle under 30
 * degrees smaller, no element too large, no pair of them more uneven; and where, of the
 * measurements around, none gets farther from the mesh than a bound (or than the farthest was), nor
 * the sum of squares of their distances larger. Edges that would flip stay, so all of it holds of
 * the mesh at the end.
 */
#ifndef HM_SETTLE_H
#define HM_SETTLE_H

#include "hm_sizes.h"
#include "hm_terrain.h"

struct hm_settle_options {
    const struct hm_terrain *terrain;
    const double *xyz; /* n measurements */
    size_t n;
    double bound; /* m */
    double least; /* m: no edge from a free node gets shorter than this, or than the shortest was */
    double ratio; /* of areas of neighbours; 0: any */
    const struct hm_sizes *sizes;
    int passes;
    int threads;
};

/* The domain comes back triangulated, all its nodes had heights. *moved: how often a node moved. */
enum hm_err hm_settle_reach(struct hm_domain *dom, const struct hm_settle_options *o,
                            int64_t *moved, struct hm_diag *d);

#endif
