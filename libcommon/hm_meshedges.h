/* hm_meshedges: the edges and the boundary loops of a mesh. Layer 4. */
#ifndef HM_MESHEDGES_H
#define HM_MESHEDGES_H

#include "hm_mesh.h"

/* An edge of a mesh: its nodes as the left element runs through them, and the elements beside. */
struct hm_mesh_edge {
    int32_t a, b;
    int32_t left, right; /* element numbers; right is -1 on the boundary */
};

/* All edges, each once, sorted by (min node, max node); malloc'd. An edge that is used more than
 * twice or twice in one direction appears once a use, right = -2. In time proportional to the
 * mesh, whatever its shape. */
enum hm_err hm_mesh_edges(const struct hm_mesh *m, struct hm_mesh_edge **edges, size_t *n,
                          struct hm_diag *d);

/* Boundary loops: node numbers, loops one after the other, outer ones counter-clockwise, islands
 * clockwise (the mesh on the left); start[k] .. start[k+1] is loop k, nloops + 1 starts. Each loop
 * begins with its lowest node, and loops come in the order of that. Where loops touch in a node,
 * each follows the elements that it bounds. HM_EGEOM when an edge is used wrongly. */
struct hm_mesh_loops {
    int32_t *node;
    int32_t *elem; /* by place in `node`: the element left of the edge that begins there */
    size_t *start;
    size_t nloops;
};
enum hm_err hm_mesh_boundary(const struct hm_mesh *m, struct hm_mesh_loops *loops,
                             struct hm_diag *d);
/* The same from edges that hm_mesh_edges gave. */
enum hm_err hm_mesh_boundary_of(const struct hm_mesh *m, const struct hm_mesh_edge *edges, size_t n,
                                struct hm_mesh_loops *loops, struct hm_diag *d);
void hm_mesh_loops_free(struct hm_mesh_loops *loops);

#endif
