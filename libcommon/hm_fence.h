/* hm_fence: the boundaries of regular meshes, which points and lines around them must keep clear
 * of. Layer 6.
 *
 * A breakline that a regular mesh was snapped to follows its boundary within centimetres; triangles
 * between the two would be slivers. So what comes nearer than a clearance is cut off.
 */
#ifndef HM_FENCE_H
#define HM_FENCE_H

#include "hm_line.h"
#include "hm_meshcheck.h"
#include "hm_segindex.h"

struct hm_fence;

/* What is said of overlapping meshes: the way out. */
#define HM_FENCE_OVERLAP                                                                           \
    "regular meshes overlap: join them first (stitch a.hm b.hm > river.hm) and give that mesh"

/* Boundaries of n meshes, which must outlive the fence (n = 0 is allowed). HM_EGEOM, with the
 * place, when one of them lies within another; crossing boundaries are not noticed here. */
enum hm_err hm_fence_build(struct hm_fence **f, const struct hm_mesh *mesh, size_t n,
                           struct hm_diag *d);
void hm_fence_free(struct hm_fence *f);

/* The median length of the boundary edges of n meshes, m; 0 without any. */
enum hm_err hm_fence_median_edge(const struct hm_mesh *mesh, size_t n, double *edge,
                                 struct hm_diag *d);

/* The boundary loops of mesh k. */
const struct hm_mesh_loops *hm_fence_loops(const struct hm_fence *f, size_t k);

/* Is (x, y) inside a mesh? Its boundary counts as either. */
bool hm_fence_is_inside(const struct hm_fence *f, double x, double y);

/* Is (x, y) within `clearance` of a boundary? */
bool hm_fence_is_near(const struct hm_fence *f, double x, double y, double clearance);

/* Append to `out` the pieces of a line that lie outside all meshes and not nearer to them than
 * `clearance` (m, > 0), with the line's attributes. Ends that were cut are kept clear of the next
 * vertex too, by as much, and remnants shorter than it are dropped. A line that is clear
 * everywhere comes out as it is. */
enum hm_err hm_fence_cut(const struct hm_fence *f, const struct hm_line *line, double clearance,
                         struct hm_lines *out, struct hm_diag *d);

/* The segments of a ring (outline, hole, region) that bound the ground outside the meshes: vertices
 * within `clearance` of a boundary move to its nearest node, where the ring crosses a boundary it
 * is bent to the nearer node of that edge, and what is inside a mesh is left out. *out is
 * malloc'd. */
enum hm_err hm_fence_join(const struct hm_fence *f, const struct hm_line *ring, double clearance,
                          struct hm_segment **out, size_t *n, struct hm_diag *d);

#endif
