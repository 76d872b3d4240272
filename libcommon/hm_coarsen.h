/* hm_coarsen: rounds that make a mesh coarser where its edges are too short. Layer 6.
 *
 * The paper's section 6, Figure 9: triangles, then single edges, under a minimum length shrink to
 * their centre. A round makes many such changes that do not touch each other; which ones depends on
 * the nodes alone.
 */
#ifndef HM_COARSEN_H
#define HM_COARSEN_H

#include "hm_domain.h"
#include "hm_lengths.h"

/* Each round triangulates the domain when it has to, changes it, and says how much: *n = 0 when
 * nothing is left to do. Heights of new nodes are means and marked as HM_NODE_NEW; on breaklines
 * they are right, linear between the ends.
 *
 * Coarsening: triangles with all edges under the minimum become one node, then (edges) single edges
 * under it. Onto the fixed node when there is one; not at all between fixed nodes, nor where an
 * edge over the maximum would come of it. hm_coarsen_clear takes out what is too near to a fixed
 * edge.
 */
enum hm_err hm_coarsen_triangles(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                                 int64_t *n, struct hm_diag *d);
enum hm_err hm_coarsen_edges(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                             int64_t *n, struct hm_diag *d);

/* Take out the free nodes nearer to a fixed edge than the clearance: all at once, without a
 * triangulation. */
enum hm_err hm_coarsen_clear(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                             int64_t *n, struct hm_diag *d);

#endif
