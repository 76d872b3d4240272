/* hm_bspline: B-spline basis; uniform tensor product surfaces evaluated and dragged. Layer 2.
 *
 * Surfaces have uniform knots and a net of n × m control points. The parameters are counted in
 * control points: u = i is the Greville site of control point i, and u runs over [0, n-1], v over
 * [0, m-1] (for even degree the Greville sites are the middles of the knot intervals, half a cell
 * off the knots: the right reading of the paper's equation 3).
 */
#ifndef HM_BSPLINE_H
#define HM_BSPLINE_H

#include "hm_bsurf.h"

/* N_i^r(u) over any non-decreasing knots (equations 5 and 7, with r = 1 .. K and 0/0 = 0); needs
 * knots[i .. i+r+1]. */
double hm_bspline_basis(const double *knots, size_t i, int degree, double u);

/* The degree + 1 uniform basis values that act at parameter u (counted as above), degree 1 .. 3;
 * *first is the control point of w[0] and may be -1, the last may be n (the ring). For degree 3 at
 * u = n-1 exactly the last would be n+1: its weight and derivative are 0 there, leave it out. dw
 * (may be NULL) gets the derivatives with respect to u. */
void hm_bspline_weights(int degree, double u, int64_t *first, double w[4], double dw[4]);

/* Point (dim coordinates) at u, v (equation 4), and on request its derivatives (NULL: not). */
void hm_bspline_eval(const struct hm_bsurf *s, double u, double v, double *point, double *du,
                     double *dv);

/* Dragging (progressive-iterative approximation): `iterations` times D += Z - B·D·Bᵀ, where Z
 * (n × m × dim) is what the surface should pass through at the Greville sites; the ring is made
 * anew each time. Ends sooner when an iteration has moved no coordinate by more than `tolerance`.
 * Where Z is NaN the control point stays. Returns the largest remaining distance in any coordinate
 * in *rest (may be NULL). */
enum hm_err hm_bspline_drag(struct hm_bsurf *s, const double *z, int iterations, double tolerance,
                            int threads, double *rest, struct hm_diag *d);

#endif
