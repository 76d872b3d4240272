/* hm_pred: exact geometric predicates on doubles. Layer 1.
 *
 * The sign is that of the exact real number for every finite input, whatever its size (denormals
 * and 1e300 included): a rounding-error filter first, exact arithmetic only when the filter cannot
 * tell (adaptive, after Shewchuk 1997). Needs IEEE arithmetic: no -ffast-math, no contraction.
 */
#ifndef HM_PRED_H
#define HM_PRED_H

/* > 0 when a, b, c (x, y each) turn left (counter-clockwise), < 0 right, 0 exactly on a line. */
int hm_pred_orient(const double *a, const double *b, const double *c);

/* For counter-clockwise a, b, c: > 0 when d is inside their circumcircle, < 0 outside, 0 on it. */
int hm_pred_incircle(const double *a, const double *b, const double *c, const double *d);

/* As hm_pred_incircle, but never 0 for four different points: cocircular points are told apart by a
 * symbolic perturbation that depends on their lexicographic (x, y) order alone (Devillers &
 * Teillaud 2011), so that a Delaunay triangulation is unique. */
int hm_pred_incircle_unique(const double *a, const double *b, const double *c, const double *d);

/* Twice the signed area of a, b, c in plain arithmetic: measures, for predicates use orient. */
static inline double hm_area2(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

#endif
