/* hm_meshcheck: is a mesh one that solvers accept? Layer 4.
 */
#ifndef HM_MESHCHECK_H
#define HM_MESHCHECK_H

#include "hm_meshedges.h"

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

/* Of pieces that cover each other completely there may be n² pairs: counting overlaps ends here. */
enum { HM_MESHCHECK_MOST_OVERLAPS = 10000 };

struct hm_meshcheck {
    int64_t count[HM_FAULTS];
    double place[HM_FAULTS][2]; /* of the first of each */
    int64_t components;         /* pieces that hang together by edges; count holds one less */
};

/* Find all faults. HM_OK means that it could be checked, not that there are none. Exact, but for
 * one thing: a boundary node off a boundary edge by no more than the last bits of the coordinates
 * is a hanging node too, since the midpoint of a slanted edge never lies on it exactly. Overlaps
 * are looked for among elements that are neither clockwise nor concave themselves. */
enum hm_err hm_meshcheck_run(const struct hm_mesh *m, struct hm_meshcheck *c, struct hm_diag *d);

/* "element with negative or zero area", … */
const char *hm_mesh_fault_name(enum hm_mesh_fault fault);
bool hm_meshcheck_is_valid(const struct hm_meshcheck *c, bool allow_components);

/* HM_EGEOM naming the first fault, in the order of the enum, its count and place; HM_OK without. */
enum hm_err hm_meshcheck_verdict(const struct hm_meshcheck *c, bool allow_components,
                                 struct hm_diag *d);

#endif
