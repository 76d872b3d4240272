/* hm_border: the boundary of a mesh, indexed. Layer 4. */
#ifndef HM_BORDER_H
#define HM_BORDER_H

#include "hm_boxtree.h"
#include "hm_meshedges.h"

#include <math.h>

/* Edge i of the border runs from loops.node[i] to loops.node[next[i]], the mesh on its left. */
struct hm_border {
    const struct hm_mesh *mesh; /* must outlive the border */
    struct hm_mesh_loops loops;
    size_t n; /* edges, and as many nodes */
    size_t *next;
    double longest;          /* length of the longest edge */
    struct hm_boxtree *tree; /* of the edges */
};

enum hm_err hm_border_build(struct hm_border *b, const struct hm_mesh *mesh, struct hm_diag *d);
void hm_border_free(struct hm_border *b);

static inline const double *hm_border_from(const struct hm_border *b, size_t i)
{
    return hm_mesh_xy(b->mesh, b->loops.node[i]);
}
static inline const double *hm_border_to(const struct hm_border *b, size_t i)
{
    return hm_border_from(b, b->next[i]);
}

static inline double hm_border_length(const struct hm_border *b, size_t i)
{
    const double *from = hm_border_from(b, i), *to = hm_border_to(b, i);
    return hypot(to[0] - from[0], to[1] - from[1]);
}

/* The place on edge i at a part of it, 0 .. 1. */
static inline void hm_border_at(const struct hm_border *b, size_t i, double at, double place[2])
{
    const double *from = hm_border_from(b, i), *to = hm_border_to(b, i);
    for (int k = 0; k < 2; k++)
        place[k] = from[k] + at * (to[k] - from[k]);
}

/* Is p nearer to some edge than `factor` times the larger of that edge's length and `length`? */
bool hm_border_is_near(const struct hm_border *b, const double *p, double factor, double length);

/* The first (or, when `last`, the last) place where the way from p to q meets the border: its edge,
 * and the place on the edge, 0 .. 1. False when there is none. */
bool hm_border_meeting(const struct hm_border *b, const double *p, const double *q, bool last,
                       size_t *edge, double *at);

#endif
