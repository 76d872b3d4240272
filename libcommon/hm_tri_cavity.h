/* hm_tri_cavity: a vertex put in by emptying the triangles whose circles hold it, and joining it to
 * the rim of what they leave (Bowyer 1981; Watson 1981). Layer 2. Internal to hm_tri_refine*.c.
 *
 * It is looked at before anything is changed, which is what refinement wants: a place too near a
 * constraint is given up. Constraints are not crossed, so the result is constrained Delaunay.
 */
#ifndef HM_TRI_CAVITY_H
#define HM_TRI_CAVITY_H

#include "hm_tri_topology.h"

/* An edge of the rim, counter-clockwise, from org to the next one's org. */
struct hm_tri_rim_edge {
    int32_t org, outer;    /* outer: the half-edge on its other side */
    int32_t marks, region; /* region of the triangle that was inside */
};

struct hm_tri_cavity {
    int32_t *tri; /* the triangles inside; once filled, the new ones, one a rim edge */
    struct hm_tri_rim_edge *rim;
    int32_t *stack; /* half-edges to look beyond */
    size_t n_tri, n_rim, cap;
};

void hm_tri_cavity_free(struct hm_tri_cavity *c);

/* Find the cavity of p from a triangle whose circle holds it. No triangle reached may be a ghost:
 * the hull is constrained. */
enum hm_err hm_tri_cavity_find(struct hm_tri_cavity *c, const struct hm_tri *t, const double *p,
                               int32_t tri, struct hm_diag *d);

/* Where an edge of the rim ends. */
static inline int32_t hm_tri_cavity_dest(const struct hm_tri_cavity *c, size_t i)
{
    return c->rim[i + 1 < c->n_rim ? i + 1 : 0].org;
}

/* Put a new vertex at p: every edge of the rim must have p strictly on its left. HM_ENOMEM changes
 * nothing. */
enum hm_err hm_tri_cavity_fill(struct hm_tri_cavity *c, struct hm_tri *t, const double *p,
                               int32_t *v, struct hm_diag *d);

#endif
