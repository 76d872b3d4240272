/* The predicates against an oracle that knows nothing of filters, differences or limbs: it expands
 * the determinants of raw coordinates into products and sums each into one long fixed-point number.
 */
#include "hm_pred.h"
#include "tap.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* --- the oracle --- */

/* Two's complement, digits of 24 bits kept in int64, least first. The last digit weighs 2^-4512,
 * for products of four denormals with 53 bits each; the first lies beyond 2^4200. */
enum { DIGITS = 376, DIGIT_BITS = 24, POINT = 4512 };

struct fixed {
    int64_t digit[DIGITS];
};

/* sum += sign * product of the k factors, k <= 4 */
static void add_product(struct fixed *sum, int sign, const double *factor, int k)
{
    int64_t part[16] = {1}; /* the mantissas' product, in the same digits */
    int exponent = 0;
    for (int i = 0; i < k; i++) {
        int e;
        double m = frexp(factor[i], &e);
        int64_t whole = (int64_t)ldexp(m, 53);
        exponent += e - 53;
        sign = whole < 0 ? -sign : sign;
        whole = whole < 0 ? -whole : whole;
        int64_t next[16] = {0};
        for (int a = 0; a < 13; a++)
            for (int b = 0; b < 3; b++)
                next[a + b] += part[a] * (whole >> DIGIT_BITS * b & 0xffffff);
        for (int a = 0; a < 15; a++) {
            next[a + 1] += next[a] >> DIGIT_BITS;
            next[a] &= 0xffffff;
        }
        memcpy(part, next, sizeof part);
    }
    int shift = exponent + POINT, whole = shift / DIGIT_BITS, rest = shift % DIGIT_BITS;
    for (int a = 0; a < 14; a++)
        sum->digit[whole + a] += sign * (part[a] << rest);
}

static int sign_of(struct fixed *sum)
{
    int last = 0;
    for (int i = 0; i + 1 < DIGITS; i++) {
        int64_t carry = sum->digit[i] >> DIGIT_BITS; /* rounds down, also below zero */
        sum->digit[i + 1] += carry;
        sum->digit[i] -= carry * (1 << DIGIT_BITS);
        last |= sum->digit[i] != 0;
    }
    int64_t top = sum->digit[DIGITS - 1];
    return top < 0 ? -1 : top > 0 || last;
}

/* det [x y 1] */
static int true_orient(const double *a, const double *b, const double *c)
{
    const double *p[3] = {a, b, c};
    struct fixed sum = {{0}};
    for (int i = 0; i < 3; i++) {
        const double *q = p[(i + 1) % 3], *r = p[(i + 2) % 3];
        add_product(&sum, 1, (double[]){q[0], r[1]}, 2);
        add_product(&sum, -1, (double[]){q[1], r[0]}, 2);
    }
    return sign_of(&sum);
}

/* det [x y x²+y² 1] by permutations of the four rows */
static int true_incircle(const double *a, const double *b, const double *c, const double *d)
{
    const double *p[4] = {a, b, c, d};
    struct fixed sum = {{0}};
    for (int code = 0; code < 256; code++) {
        int row[4] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6}, sign = 1;
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < i; k++)
                sign *= row[k] < row[i] ? 1 : row[k] > row[i] ? -1 : 0;
        if (!sign)
            continue;
        double x = p[row[0]][0], y = p[row[1]][1], s = p[row[2]][0], t = p[row[2]][1];
        add_product(&sum, sign, (double[]){x, y, s, s}, 4);
        add_product(&sum, sign, (double[]){x, y, t, t}, 4);
    }
    return sign_of(&sum);
}

/* --- points that are hard to tell --- */

static uint64_t seed = 88172645463325252u;

static uint64_t draw(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

static double uniform(void)
{
    return (double)(draw() >> 11) * 0x1p-53;
}

static double step_ulps(double v)
{
    for (int k = (int)(draw() % 5) - 2; k != 0; k += k < 0 ? 1 : -1)
        v = nextafter(v, k < 0 ? -INFINITY : INFINITY);
    return v;
}

static void on_grid(double p[8])
{
    for (int i = 0; i < 8; i++)
        p[i] = (double)(draw() % 7);
}

static void on_decimal_grid(double p[8])
{
    for (int i = 0; i < 8; i++)
        p[i] = 545000 * (i % 2) + 0.1 * (double)(draw() % 9);
}

/* Corners of a rectangle along the axes, with random bits: all cocircular, many in line. */
static void upright(double p[8])
{
    double x[2] = {uniform(), uniform()}, y[2] = {uniform(), uniform()};
    uint64_t odd = draw();
    for (int i = 0; i < 4; i++) {
        uint64_t corner = draw();
        p[2 * i] = x[corner % 2];
        p[2 * i + 1] = y[corner / 2 % 2];
    }
    if (odd % 2)
        p[odd / 2 % 8] = uniform();
}

/* whole points on a circle of radius 65 about a whole centre */
static void cocircular(double p[8])
{
    static const int on[9][2] = {{65, 0},  {63, 16}, {60, 25}, {56, 33}, {52, 39},
                                 {39, 52}, {33, 56}, {25, 60}, {16, 63}};
    double cx = (double)(draw() % 100000), cy = (double)(draw() % 100000);
    for (int i = 0; i < 4; i++) {
        const int *q = on[draw() % 9];
        p[2 * i] = cx + (draw() % 2 ? q[0] : -q[0]);
        p[2 * i + 1] = cy + (draw() % 2 ? q[1] : -q[1]);
    }
}

static void cocircular_by_an_ulp(double p[8])
{
    cocircular(p);
    p[draw() % 8] *= 1 + 0x1p-52;
    double turn = uniform();
    for (int i = 0; i < 8; i++)
        p[i] = step_ulps(p[i] * turn);
}

static void nearly_in_line(double p[8])
{
    double x = uniform(), y = uniform(), dx = uniform(), dy = uniform();
    for (int i = 0; i < 4; i++) {
        double s = 12 * uniform();
        p[2 * i] = step_ulps(x + s * dx);
        p[2 * i + 1] = step_ulps(y + s * dy);
    }
}

static void any_bits(double p[8])
{
    for (int i = 0; i < 8; i++)
        do {
            uint64_t bits = draw();
            memcpy(&p[i], &bits, sizeof bits);
        } while (!isfinite(p[i]));
}

static void scaled(double p[8], double scale)
{
    draw() % 2 ? cocircular(p) : cocircular_by_an_ulp(p);
    for (int i = 0; i < 8; i++)
        p[i] *= scale;
}

static void huge(double p[8])
{
    scaled(p, 1e302);
}

static void tiny(double p[8])
{
    scaled(p, 1e-300);
}

static void denormal(double p[8])
{
    for (int i = 0; i < 8; i++)
        p[i] = (double)(int64_t)(draw() % 9) * 0x1p-1074;
}

static void mixed_sizes(double p[8])
{
    for (int i = 0; i < 8; i++)
        p[i] = ldexp(uniform() - 0.5, (int)(draw() % 2000) - 1000);
}

static void far_apart(double p[8])
{
    on_grid(p);
    p[draw() % 8] = 1e300;
    p[draw() % 8] = 1e-300;
}

static void compare(void (*make)(double *), const char *name)
{
    int wrong_orient = 0, wrong_circle = 0, zeros = 0, wrong_tie = 0, asymmetric = 0;
    for (int i = 0; i < 2000; i++) {
        double p[8];
        make(p);
        const double *a = p, *b = p + 2, *c = p + 4, *d = p + 6;
        int orient = hm_pred_orient(a, b, c), in = hm_pred_incircle(a, b, c, d);
        wrong_orient += orient != true_orient(a, b, c);
        wrong_circle += in != true_incircle(a, b, c, d);
        zeros += in == 0;
        bool different = memcmp(a, d, 16) && memcmp(b, d, 16) && memcmp(c, d, 16);
        if (orient <= 0 || !different)
            continue;
        int unique = hm_pred_incircle_unique(a, b, c, d);
        wrong_tie += unique == 0 || (in != 0 && unique != in);
        asymmetric += unique != hm_pred_incircle_unique(b, c, a, d);
    }
    ok(!wrong_orient && !wrong_circle, "%s: 2000 signs of each as the oracle's (%d on circles)",
       name, zeros);
    ok(!wrong_tie && !asymmetric, "%s: ties broken, and the same from every side", name);
}

/* Of the two diagonals of a cocircular quadrilateral just one is Delaunay. */
static void one_diagonal(void)
{
    int wrong = 0;
    for (int i = 0; i < 5000; i++) {
        double p[8];
        cocircular(p);
        const double *a = p, *b = p + 2, *c = p + 4, *d = p + 6;
        bool convex = hm_pred_orient(a, b, c) > 0 && hm_pred_orient(b, c, d) > 0 &&
                      hm_pred_orient(c, d, a) > 0 && hm_pred_orient(d, a, b) > 0;
        if (!convex)
            continue;
        int ac = hm_pred_incircle_unique(a, b, c, d), bd = hm_pred_incircle_unique(b, c, d, a);
        wrong += ac + bd != 0 || hm_pred_incircle_unique(c, d, a, b) != ac;
    }
    ok(wrong == 0, "of two diagonals of cocircular quadrilaterals one is Delaunay");
}

int main(void)
{
    compare(on_grid, "small grid");
    compare(on_decimal_grid, "decimal grid");
    compare(upright, "upright rectangles");
    compare(cocircular, "cocircular");
    compare(cocircular_by_an_ulp, "cocircular but for an ulp");
    compare(nearly_in_line, "nearly in line");
    compare(any_bits, "any finite bits");
    compare(huge, "huge");
    compare(tiny, "tiny");
    compare(denormal, "denormal");
    compare(mixed_sizes, "mixed sizes");
    compare(far_apart, "1e300 beside 1e-300");
    one_diagonal();
    return done();
}
