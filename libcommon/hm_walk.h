/* hm_walk: which element of a mesh holds a point, for many points of which each lies near the one
 * before. Layer 4.
 *
 * From the element of the last point across the edges that have the new one on their far side
 * (Devillers, Pion, Teillaud 2002). Where that does not end strictly inside an element (borders,
 * holes, faulty meshes) hm_locate decides, so the answer is always its answer, to the last bit, and
 * does not depend on where the walk began. Read-only queries: threads may share it.
 */
#ifndef HM_WALK_H
#define HM_WALK_H

#include "hm_locate.h"
#include "hm_meshedges.h"

struct hm_walk;

/* Of a mesh, which must outlive it, and its edges (hm_mesh_edges), which need not. `plane`: no two
 * elements have ground in common, and none is clockwise or concave (hm_meshcheck); only then it
 * walks. */
enum hm_err hm_walk_build(struct hm_walk **w, const struct hm_mesh *mesh,
                          const struct hm_mesh_edge *edge, size_t nedges, bool plane,
                          struct hm_diag *d);
void hm_walk_free(struct hm_walk *w);

/* As hm_locate_element. *hint: any element or 0 at first; keep one a thread. */
int64_t hm_walk_element(const struct hm_walk *w, double px, double py, int32_t *hint);

/* Does a point of element e lie on the border of the mesh, exactly? */
bool hm_walk_on_border(const struct hm_walk *w, int64_t e, double px, double py);

/* The elements' boxes, for other queries; belongs to the walk. */
const struct hm_boxtree *hm_walk_boxes(const struct hm_walk *w);

#endif
