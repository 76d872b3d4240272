/* hm_tri_grade: sizes at the vertices that grow by no more than a given share of the way. Layer 2.
 * Internal to hm_tri_refine.c.
 *
 * The size at a vertex of the input is its shortest edge. From there, and from where smaller sizes
 * are asked for, h(v) <= h(u) + growth |uv| holds along every edge (Persson 2006, Mesh size
 * functions for implicit geometries and PDE-based gradient limiting), so that a new vertex, whose
 * own edges do not count, cannot make the sizes shrink for ever.
 */
#ifndef HM_TRI_GRADE_H
#define HM_TRI_GRADE_H

#include "hm_tri_topology.h"

/* Area of the equilateral triangle with edges of 1. */
#define HM_TRI_EQUILATERAL 0.43301270189221932

struct hm_tri_grade {
    double growth; /* lengths a length */
    double *size;
    int32_t *lowered; /* vertices whose size became smaller; the rest of them is to be looked at */
    size_t n_lowered, cap_size, cap_lowered;
};

void hm_tri_grade_free(struct hm_tri_grade *g);

/* Sizes at all vertices there are, by the edges of triangles whose region is not `outside`. */
enum hm_err hm_tri_grade_start(struct hm_tri_grade *g, const struct hm_tri *t, double growth,
                               int32_t outside, struct hm_diag *d);

/* Size at a new vertex: `own`, or less by those around. Where it makes others smaller they are in
 * g->lowered afterwards. */
enum hm_err hm_tri_grade_add(struct hm_tri_grade *g, const struct hm_tri *t, int32_t v, double own,
                             struct hm_diag *d);

/* The largest area of a triangle between three vertices: that of the equilateral one with the mean
 * of their sizes. */
static inline double hm_tri_grade_area(const struct hm_tri_grade *g, int32_t a, int32_t b,
                                       int32_t c)
{
    double h = (g->size[a] + g->size[b] + g->size[c]) / 3;
    return HM_TRI_EQUILATERAL * h * h;
}

#endif
