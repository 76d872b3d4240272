/* hm_meshcheck: is a mesh one that solvers accept? Layer 4. And the edges of a mesh, on which the
 * check, the seams and the drawings build.
 */
#ifndef HM_MESHCHECK_H
#define HM_MESHCHECK_H

#include "hm_data.h"

/* An edge of a mesh: its nodes as the left element runs through them, and the elements beside. */
struct hm_mesh_edge {
    int32_t a, b;
    int32_t left, right; /* element numbers; right is -1 on the boundary */
};

/* All edges, each once, sorted by (min node, max node); malloc'd. An edge that is used more than
 * twice or twice in one direction appears once a further use, right = -2. */
enum hm_err hm_mesh_edges(const struct hm_mesh *m, struct hm_mesh_edge **edges, size_t *n,
                          struct hm_diag *d);

/* Boundary loops: node numbers, loops one after the other, outer ones counter-clockwise, islands
 * clockwise (the mesh on the left); start[k] .. start[k+1] is loop k, nloops + 1 starts. */
struct hm_mesh_loops {
    int32_t *node;
    size_t *start;
    size_t nloops;
};
enum hm_err hm_mesh_boundary(const struct hm_mesh *m, struct hm_mesh_loops *loops,
                             struct hm_diag *d);
void hm_mesh_loops_free(struct hm_mesh_loops *loops);

enum hm_mesh_fault {
    HM_FAULT_AREA,       /* zero or clockwise */
    HM_FAULT_CONCAVE,    /* quadrilateral not strictly convex */
    HM_FAULT_EDGE,       /* used more than twice, or twice in one direction */
    HM_FAULT_HANGING,    /* a node inside an edge of another element */
    HM_FAULT_OVERLAP,    /* elements that cover the same ground */
    HM_FAULT_ISOLATED,   /* a node that no element uses */
    HM_FAULT_DUPLICATE,  /* two nodes at one place, or two elements on the same nodes */
    HM_FAULT_TOUCH,      /* a node where two boundary loops touch */
    HM_FAULT_COMPONENTS, /* more than one connected piece */
    HM_FAULT_HEIGHT,     /* z missing or infinite */
    HM_FAULTS
};

struct hm_meshcheck {
    int64_t count[HM_FAULTS];
    double place[HM_FAULTS][2]; /* of the first of each */
    int64_t components;
};

/* Find all faults. HM_OK means that it could be checked, not that there are none. Exact: no
 * tolerance. */
enum hm_err hm_meshcheck_run(const struct hm_mesh *m, struct hm_meshcheck *c, struct hm_diag *d);

/* "negative or zero area", … */
const char *hm_mesh_fault_name(enum hm_mesh_fault fault);
bool hm_meshcheck_is_valid(const struct hm_meshcheck *c, bool allow_components);

#endif
