/* hm_mesh: nodes and elements. Layer 3.
 *
 * Elements are counter-clockwise; node[3] is -1 in a triangle. A mesh begins life as `= {0}`, owns
 * what its pointers hold, and is emptied by hm_mesh_free.
 */
#ifndef HM_MESH_H
#define HM_MESH_H

#include "hm_header.h"

#include <assert.h>
#include <stddef.h>

enum hm_node_flag {
    HM_NODE_BOUNDARY = 1,  /* on the boundary of the mesh */
    HM_NODE_BREAKLINE = 2, /* on a breakline */
    HM_NODE_FIXED = 4      /* must not be moved */
};
struct hm_node {
    double x, y, z; /* metres; z may be NaN only before heights are known */
    int32_t flags;  /* hm_node_flag bits */
    int32_t owner;  /* 0, or the number of the regular mesh that the node belongs to */
};
struct hm_elem {
    int32_t node[4];
    int32_t region; /* material number, 0 or more */
};
struct hm_mesh {
    struct hm_header header; /* keys name, role: regular, irregular or hybrid */
    struct hm_node *node;
    size_t nnodes, node_cap; /* at most INT32_MAX */
    struct hm_elem *elem;
    size_t nelems, elem_cap;
};
/* The place of a node: x and y side by side. */
static inline const double *hm_mesh_xy(const struct hm_mesh *m, int32_t node)
{
    static_assert(offsetof(struct hm_node, x) == 0 && offsetof(struct hm_node, y) == sizeof(double),
                  "x and y lie side by side at the beginning of a node");
    return (const double *)&m->node[node];
}
static inline int hm_elem_corners(const struct hm_elem *e)
{
    return e->node[3] < 0 ? 3 : 4;
}
enum hm_err hm_mesh_add_node(struct hm_mesh *m, struct hm_node node, struct hm_diag *d);
enum hm_err hm_mesh_add_elem(struct hm_mesh *m, struct hm_elem elem, struct hm_diag *d);
void hm_mesh_free(struct hm_mesh *m);

#endif
