#include "hm_pred.h"

#include "hm_bigint.h"
#include "hm_pred_inline.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* A finite double as m * 2^e, m odd or 0. `top` is the exponent behind its highest bit. */
struct parts {
    int64_t m;
    int e, top;
};

static struct parts take_apart(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    int field = (int)(bits >> 52 & 0x7ff);
    uint64_t m = bits & 0xfffffffffffff;
    if (field > 0)
        m |= 1ULL << 52;
    if (m == 0)
        return (struct parts){0};
    int zeros = __builtin_ctzll(m), e = (field > 0 ? field : 1) - 1075;
    m >>= zeros;
    return (struct parts){.m = bits >> 63 ? -(int64_t)m : (int64_t)m,
                          .e = e + zeros,
                          .top = e + zeros + 64 - __builtin_clzll(m)};
}

/* Take n values apart and find the largest power of two that divides all; how many bits the largest
 * has in that unit. */
static int common_unit(const double *v, int n, struct parts *p, int *unit)
{
    int top = -2000;
    *unit = 2000;
    for (int i = 0; i < n; i++) {
        p[i] = take_apart(v[i]);
        if (p[i].m == 0)
            continue;
        *unit = p[i].e < *unit ? p[i].e : *unit;
        top = p[i].top > top ? p[i].top : top;
    }
    return top > *unit ? top - *unit : 0;
}

/* v[0 .. n) as whole numbers of a common unit, when they have at most `bits` bits in it. */
static bool as_small(const double *v, int n, int bits, int64_t *whole)
{
    struct parts p[6];
    int unit;
    if (common_unit(v, n, p, &unit) > bits)
        return false;
    for (int i = 0; i < n; i++)
        whole[i] = p[i].m == 0 ? 0 : p[i].m * (1LL << (p[i].e - unit));
    return true;
}

/* The points p[0 .. n) relative to `origin` in plain arithmetic; true when no difference was
 * rounded (two-difference of Shewchuk 1997; not a number, and so false, after overflow). */
static bool differences(const double *const *p, int n, const double *origin, double *diff)
{
    bool exact = true;
    for (int i = 0; i < 2 * n; i++) {
        double a = p[i / 2][i % 2], b = origin[i % 2];
        double d = a - b, back = a - d;
        diff[i] = d;
        exact = exact && (a - (d + back)) + (back - b) == 0;
    }
    return exact;
}

/* The same as big whole numbers of a common unit, exact whatever the coordinates. */
static void big_differences(const double *const *p, int n, const double *origin,
                            struct hm_bigint *diff)
{
    double v[8];
    struct parts part[8];
    int unit;
    for (int i = 0; i < 2 * n; i++)
        v[i] = p[i / 2][i % 2];
    v[2 * n] = origin[0];
    v[2 * n + 1] = origin[1];
    common_unit(v, 2 * n + 2, part, &unit);
    struct hm_bigint a, o[2];
    for (int k = 0; k < 2; k++)
        hm_bigint_set(&o[k], part[2 * n + k].m, part[2 * n + k].m ? part[2 * n + k].e - unit : 0);
    for (int i = 0; i < 2 * n; i++) {
        hm_bigint_set(&a, part[i].m, part[i].m ? part[i].e - unit : 0);
        hm_bigint_sub(&diff[i], &a, &o[i % 2]);
    }
}

static int sign_of(int64_t v)
{
    return (v > 0) - (v < 0);
}

/* r = a[0] b[1] - a[1] b[0] */
static void big_cross(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    struct hm_bigint left, right;
    hm_bigint_mul(&left, &a[0], &b[1]);
    hm_bigint_mul(&right, &a[1], &b[0]);
    hm_bigint_sub(r, &left, &right);
}

static bool differ(const double *a, const double *b)
{
    return a[0] != b[0] || a[1] != b[1];
}

/* Lattices of any spacing are full of lines along an axis and of upright rectangles. Both are told
 * by equal coordinates alone, for a tenth of what exact arithmetic takes. */

static bool is_upright_line(const double *a, const double *b, const double *c)
{
    return (a[0] == b[0] && b[0] == c[0]) || (a[1] == b[1] && b[1] == c[1]);
}

/* Are d and q opposite corners of a rectangle, p and r the others? */
static bool is_upright_rectangle(const double *d, const double *p, const double *q, const double *r)
{
    return (d[0] == p[0] && p[1] == q[1] && q[0] == r[0] && r[1] == d[1]) ||
           (d[1] == p[1] && p[0] == q[0] && q[1] == r[1] && r[0] == d[0]);
}

static int order_of(double a, double b)
{
    return (a > b) - (a < b);
}

/* The sign of x0 y1 - y0 x1, exactly, for v = x0, y0, x1, y1, or false. Rounding keeps the order of
 * the products; where they round to the same, what was rounded off decides, which fma gives as long
 * as it does not underflow. */
static bool compare_products(const double *v, int *sign)
{
    double l = v[0] * v[3], r = v[1] * v[2];
    if (!isfinite(l) || !isfinite(r))
        return false;
    *sign = order_of(l, r);
    if (*sign == 0 && fabs(l) < 1e-250)
        return false;
    if (*sign == 0)
        *sign = order_of(fma(v[0], v[3], -l), fma(v[1], v[2], -r));
    return true;
}

int hm_pred_orient_exact(const double *a, const double *b, const double *c)
{
    const double *const p[2] = {a, b};
    double v[4];
    int sign;
    if (is_upright_line(a, b, c) || !differ(a, c) || !differ(b, c) || !differ(a, b))
        return 0;
    if (differences(p, 2, c, v) && compare_products(v, &sign))
        return sign;
    struct hm_bigint diff[4], det;
    big_differences(p, 2, c, diff);
    big_cross(&det, diff, diff + 2);
    return det.sign;
}

/* sum += |a|^2 (b x c) */
static void big_add_term(struct hm_bigint *sum, const struct hm_bigint *a,
                         const struct hm_bigint *b, const struct hm_bigint *c)
{
    struct hm_bigint xx, yy, lift, cross, term, before = *sum;
    hm_bigint_mul(&xx, &a[0], &a[0]);
    hm_bigint_mul(&yy, &a[1], &a[1]);
    hm_bigint_add(&lift, &xx, &yy);
    big_cross(&cross, b, c);
    hm_bigint_mul(&term, &lift, &cross);
    hm_bigint_add(sum, &before, &term);
}

int hm_pred_incircle_exact(const double *a, const double *b, const double *c, const double *d)
{
    const double *const p[3] = {a, b, c};
    double v[6];
    int64_t w[6];
    if (is_upright_rectangle(d, a, b, c) || is_upright_rectangle(d, b, c, a) ||
        is_upright_rectangle(d, c, a, b))
        return 0;
    /* 14 bits: lifts and cross products have 29, their products 58, the sum 60 */
    if (differences(p, 3, d, v) && as_small(v, 6, 14, w)) {
        int64_t aa = w[0] * w[0] + w[1] * w[1], bb = w[2] * w[2] + w[3] * w[3];
        int64_t cc = w[4] * w[4] + w[5] * w[5];
        return sign_of(aa * (w[2] * w[5] - w[4] * w[3]) + bb * (w[4] * w[1] - w[0] * w[5]) +
                       cc * (w[0] * w[3] - w[2] * w[1]));
    }
    struct hm_bigint diff[6], det;
    big_differences(p, 3, d, diff);
    hm_bigint_set(&det, 0, 0);
    big_add_term(&det, diff, diff + 2, diff + 4);
    big_add_term(&det, diff + 2, diff + 4, diff);
    big_add_term(&det, diff + 4, diff, diff + 2);
    return det.sign;
}

static bool is_before(const double *a, const double *b)
{
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Think of the paraboloid over the plane with each point lifted off it by an amount of its own: the
 * later in lexicographic order, the more, each infinitely more than those before it. d is inside
 * when it lies below the plane through a, b, c; of four points on a circle, the last alone decides.
 * Lifting d takes it out; lifting a raises the plane at d by a's barycentric coordinate there.
 * (Devillers & Teillaud 2011, Perturbations for Delaunay and weighted Delaunay 3D triangulations.)
 */
int hm_pred_incircle_tie(const double *a, const double *b, const double *c, const double *d)
{
    const double *last = a;
    last = is_before(last, b) ? b : last;
    last = is_before(last, c) ? c : last;
    last = is_before(last, d) ? d : last;
    if (last == a)
        return hm_pred_orient_fast(d, b, c);
    if (last == b)
        return hm_pred_orient_fast(a, d, c);
    if (last == c)
        return hm_pred_orient_fast(a, b, d);
    return -1;
}

int hm_pred_orient(const double *a, const double *b, const double *c)
{
    return hm_pred_orient_fast(a, b, c);
}

int hm_pred_incircle(const double *a, const double *b, const double *c, const double *d)
{
    return hm_pred_incircle_fast(a, b, c, d);
}

int hm_pred_incircle_unique(const double *a, const double *b, const double *c, const double *d)
{
    if (!differ(a, d) || !differ(b, d) || !differ(c, d))
        return 0;
    return hm_pred_incircle_unique_fast(a, b, c, d);
}
