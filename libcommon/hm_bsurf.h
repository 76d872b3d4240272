/* hm_bsurf: the control net of a uniform B-spline surface, and what continues it. Layer 2.
 *
 * A ring of control points beyond the net, by linear extrapolation, lets the surface reach its
 * outermost Greville lines. Control points without data (gaps, the outside of a survey) take no
 * part in a surface; those beside points with data form its fringe, ring included, and are
 * extrapolated so that the surface can be evaluated at every control point that has data: linearly
 * along rows and columns, else along diagonals, else by a plane fitted to the control points
 * around. Planes are continued exactly.
 */
#ifndef HM_BSURF_H
#define HM_BSURF_H

#include "hm_base.h"

/* What a control point of a surface with missing ones is. */
enum hm_bsurf_state { HM_BSURF_MISSING, HM_BSURF_DATA, HM_BSURF_FRINGE };

struct hm_bsurf_fringe {
    int8_t *state; /* (n + 2) × (m + 2), ring included */
    size_t *item;  /* positions of the fringe in it, ascending */
    size_t n, cap;
};

struct hm_bsurf {
    int degree;                     /* 1, 2 or 3, in both directions */
    size_t n, m;                    /* control points along u and along v, at least 2 */
    size_t dim;                     /* coordinates a control point: 1 (z) or 3 */
    double *d;                      /* (n + 2) × (m + 2) × dim, with the ring; use hm_bsurf_at */
    struct hm_bsurf_fringe *fringe; /* control points missing inside the net, or NULL */
};

enum hm_err hm_bsurf_init(struct hm_bsurf *s, int degree, size_t n, size_t m, size_t dim,
                          struct hm_diag *d);
void hm_bsurf_free(struct hm_bsurf *s);

/* The position of control point (i, j) among all of them, -1 <= i <= n, -1 <= j <= m. */
static inline size_t hm_bsurf_position(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    return (size_t)(j + 1) * (s->n + 2) + (size_t)(i + 1);
}

/* Its coordinates. */
static inline double *hm_bsurf_at(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    return s->d + hm_bsurf_position(s, i, j) * s->dim;
}

/* Declare the control points missing for which z (n × m, row after row) is NaN, and set them
 * to 0 (they have weight 0 wherever the surface counts); once, at first. When there are none this
 * does nothing. */
enum hm_err hm_bsurf_set_missing(struct hm_bsurf *s, const double *z, struct hm_diag *d);

/* Make the ring, and the fringe of missing control points, anew from the net: to be called after
 * the net was written. */
void hm_bsurf_extend(struct hm_bsurf *s);

/* Has control point (i, j), ring included, coordinates of its own or extrapolated ones? */
bool hm_bsurf_knows(const struct hm_bsurf *s, int64_t i, int64_t j);

/* Has it data of its own? Never the ring, nor what lies beyond. */
static inline bool hm_bsurf_has_data(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    return i >= 0 && j >= 0 && i < (int64_t)s->n && j < (int64_t)s->m &&
           (!s->fringe || s->fringe->state[hm_bsurf_position(s, i, j)] == HM_BSURF_DATA);
}

#endif
