/* hm_subdivide: rounds that make a mesh finer where its edges are too long. Layer 6.
 *
 * The paper's section 6, Figure 10: triangles, then single edges, over a maximum length get their
 * centre as a new node.
 */
#ifndef HM_SUBDIVIDE_H
#define HM_SUBDIVIDE_H

#include "hm_domain.h"
#include "hm_lengths.h"

/* Rounds as those of hm_coarsen. No new node comes nearer to another than the minimum, lest
 * coarsening take it away again; but fixed edges over the maximum are halved in any case, those of
 * regular meshes never. Heights of new nodes are means and marked as HM_NODE_NEW; on breaklines
 * they are right as they are, linear between the ends. Edges are halved longest first. */
enum hm_err hm_subdivide_triangles(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                                   int64_t *n, struct hm_diag *d);
enum hm_err hm_subdivide_edges(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                               int64_t *n, struct hm_diag *d);

#endif
