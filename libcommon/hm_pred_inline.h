/* hm_pred_inline: the floating-point filters of hm_pred, for inner loops. Layer 1.
 *
 * Each computes the determinant in plain arithmetic and trusts its sign when it is larger than all
 * rounding errors together; otherwise the exact function of hm_pred.c decides. The bounds are those
 * of Shewchuk 1997 (Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates), with eps = 2^-53:
 *
 *   orient     (3 + 16 eps) eps (|l| + |r|)
 *   incircle   (10 + 96 eps) eps P, where P = sum of |a|^2 (|bx cy| + |cx by|), cyclic. As
 *              |bx cy| + |cx by| <= |b| |c| <= (|b|^2 + |c|^2) / 2, P <= S^2 / 3 with
 *              S = |a|^2 + |b|^2 + |c|^2: a bound of 4 eps S^2 that costs two additions and a
 * product.
 *
 * The constants added to the bounds swallow what underflow can do; overflow makes the bound
 * infinite or not a number, which no determinant exceeds.
 */
#ifndef HM_PRED_INLINE_H
#define HM_PRED_INLINE_H

#include <math.h>

int hm_pred_orient_exact(const double *a, const double *b, const double *c);
int hm_pred_incircle_exact(const double *a, const double *b, const double *c, const double *d);

/* The sign of incircle for four different points on one circle, never 0. */
int hm_pred_incircle_tie(const double *a, const double *b, const double *c, const double *d);

static inline int hm_pred_orient_fast(const double *a, const double *b, const double *c)
{
    double l = (a[0] - c[0]) * (b[1] - c[1]), r = (a[1] - c[1]) * (b[0] - c[0]);
    double det = l - r, bound = 0x1.8000000000004p-52 * (fabs(l) + fabs(r)) + 1e-300;
    if (det > bound)
        return 1;
    if (det < -bound)
        return -1;
    return hm_pred_orient_exact(a, b, c);
}

static inline int hm_pred_incircle_fast(const double *a, const double *b, const double *c,
                                        const double *d)
{
    double ax = a[0] - d[0], ay = a[1] - d[1], aa = ax * ax + ay * ay;
    double bx = b[0] - d[0], by = b[1] - d[1], bb = bx * bx + by * by;
    double cx = c[0] - d[0], cy = c[1] - d[1], cc = cx * cx + cy * cy;
    double det = aa * (bx * cy - cx * by) + bb * (cx * ay - ax * cy) + cc * (ax * by - bx * ay);
    double sum = aa + bb + cc, bound = 0x1p-51 * (sum * sum) + 1e-270;
    if (det > bound)
        return 1;
    if (det < -bound)
        return -1;
    return hm_pred_incircle_exact(a, b, c, d);
}

static inline int hm_pred_incircle_unique_fast(const double *a, const double *b, const double *c,
                                               const double *d)
{
    int sign = hm_pred_incircle_fast(a, b, c, d);
    return sign ? sign : hm_pred_incircle_tie(a, b, c, d);
}

#endif
