/* hm_bspline: B-spline basis and uniform tensor product surfaces. Layer 1.
 *
 * Surfaces have uniform knots and a net of n × m control points. The parameters are counted in
 * control points: u = i is the Greville site of control point i, and u runs over [0, n-1], v over
 * [0, m-1] (for even degree the Greville sites are the middles of the knot intervals, half a cell
 * off the knots: the right reading of the paper's equation 3). A ring of control points beyond the
 * net, by linear extrapolation, lets the surface reach its outermost Greville lines.
 */
#ifndef HM_BSPLINE_H
#define HM_BSPLINE_H

#include "hm_base.h"

/* N_i^r(u) over any non-decreasing knots (equations 5 and 7, with r = 1 .. K and 0/0 = 0); needs
 * knots[i .. i+r+1]. */
double hm_bspline_basis(const double *knots, size_t i, int degree, double u);

/* The degree + 1 uniform basis values that act at parameter u (counted as above), degree 1 .. 3;
 * *first is the control point of w[0] and may be -1, the last may be n (the ring). For degree 3 at
 * u = n-1 exactly the last would be n+1: its weight and derivative are 0 there, leave it out. dw
 * (may be NULL) gets the derivatives with respect to u. */
void hm_bspline_weights(int degree, double u, int64_t *first, double w[4], double dw[4]);

struct hm_bsurf {
    int degree;                /* 1, 2 or 3, in both directions */
    size_t n, m;               /* control points along u and along v, at least 2 */
    size_t dim;                /* coordinates a control point: 1 (z) or 3 */
    double *d;                 /* (n + 2) × (m + 2) × dim, with the ring; use hm_bsurf_at */
    struct hm_bfringe *fringe; /* control points missing inside the net (hm_bfringe.h), or NULL */
};

enum hm_err hm_bsurf_init(struct hm_bsurf *s, int degree, size_t n, size_t m, size_t dim,
                          struct hm_diag *d);
void hm_bsurf_free(struct hm_bsurf *s);

/* Control point (i, j), -1 <= i <= n, -1 <= j <= m. */
static inline double *hm_bsurf_at(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    return s->d + ((size_t)(j + 1) * (s->n + 2) + (size_t)(i + 1)) * s->dim;
}

/* Make the ring, and the fringe of missing control points, anew from the net: to be called after
 * the net was written. */
void hm_bsurf_extend(struct hm_bsurf *s);

/* Point (dim coordinates) at u, v (equation 4), and on request its derivatives (NULL: not). */
void hm_bsurf_eval(const struct hm_bsurf *s, double u, double v, double *point, double *du,
                   double *dv);

/* The surface at the Greville sites of row j: n × dim numbers, and on request the derivatives there
 * (NULL: not; the mean of both sides for degree 1, which has an edge there). */
void hm_bsurf_row(const struct hm_bsurf *s, size_t j, double *point, double *du, double *dv);

/* Dragging (progressive-iterative approximation): `iterations` times D += Z - B·D·Bᵀ, where Z
 * (n × m × dim) is what the surface should pass through at the Greville sites; the ring is made
 * anew each time. Where Z is NaN the control point stays. Returns the largest remaining distance in
 * any coordinate in *rest (may be NULL). */
enum hm_err hm_bsurf_drag(struct hm_bsurf *s, const double *z, int iterations, int threads,
                          double *rest, struct hm_diag *d);

#endif
