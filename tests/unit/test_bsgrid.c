/* Start grids against independent ways to the same heights: location in the triangulation, plain
 * sums, and brute force. */
#include "hm_anchor.h"
#include "hm_bsample.h"
#include "hm_cellmean.h"
#include "hm_cellsort.h"
#include "hm_gapfill.h"
#include "hm_gridtin.h"
#include "hm_pred.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static uint32_t seed = 1;

static double uniform(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) / (1 << 24);
}

static void test_anchor(void)
{
    struct hm_anchor a, b;
    const double box[4] = {0.3, 0.7, -0.25, 0.25};
    hm_anchor_within(&a, 0.1, box, NULL);
    ok(a.i0 == 3 && a.nx == 5 && a.j0 == -2 && a.ny == 5, "nodes on the border are within");
    hm_anchor_touching(&b, 0.1, (const double[]){0.34, 0.76, 0.36, 0.36}, NULL);
    ok(b.i0 == 3 && b.nx == 6 && b.j0 == 4 && b.ny == 1, "cells that reach into the box");
    ok(hm_anchor_within(&a, 1, (const double[]){0.2, 0.8, 0, 5}, NULL) == HM_EARG, "no node");
    ok(hm_anchor_within(&a, 1, (const double[]){-1e300, 1e300, 0, 5}, NULL) == HM_EARG, "too many");
}

/* What location says of (x, y): the height of the plane through the triangle's corners, solved by
 * Cramer's rule; NaN outside and in a gap. On an edge, whichever of its two triangles tells. */
static double locate(const struct hm_tin *tin, double x, double y, double gap, bool *on_edge)
{
    const double at[2] = {x, y};
    int32_t tri = hm_tri_locate(tin->tri, x, y, NULL);
    *on_edge = false;
    if (tri < 0)
        return NAN;
    const double *p[3];
    double z[3];
    bool wide = false;
    for (int k = 0; k < 3; k++) {
        p[k] = hm_tri_xy(tin->tri, hm_tri_org(tin->tri, 3 * tri + k));
        z[k] = tin->z[hm_tri_org(tin->tri, 3 * tri + k)];
    }
    for (int k = 0; k < 3; k++) {
        const double *a = p[k], *b = p[(k + 1) % 3];
        wide = wide || hypot(b[0] - a[0], b[1] - a[1]) > gap;
        *on_edge = *on_edge || hm_pred_orient(a, b, at) == 0;
    }
    double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1], uz = z[1] - z[0];
    double vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1], vz = z[2] - z[0];
    double det = ux * vy - uy * vx;
    double dzdx = (uz * vy - uy * vz) / det, dzdy = (ux * vz - uz * vx) / det;
    return wide ? NAN : z[0] + dzdx * (x - p[0][0]) + dzdy * (y - p[0][1]);
}

static void test_gridtin(double x0, double y0, double gap)
{
    enum { N = 3000, SIDE = 61 };
    static double xyz[3 * N], z[SIDE * SIDE], again[SIDE * SIDE];
    for (size_t k = 0; k < N; k++) {
        bool on_lattice = k % 5 == 0;
        double x = uniform() * 60, y = uniform() * 60;
        xyz[3 * k] = x0 + (on_lattice ? floor(x) : x);
        xyz[3 * k + 1] = y0 + (on_lattice ? floor(y) : y);
        xyz[3 * k + 2] = 10 * uniform();
    }
    struct hm_tin tin;
    struct hm_gridtin_count count;
    struct hm_anchor a = {1, (int64_t)x0, (int64_t)y0, SIDE, SIDE};
    bool good = !hm_tin_build(&tin, xyz, N, 1, NULL) &&
                !hm_gridtin(z, &a, &tin, gap, 1, &count, NULL) &&
                !hm_gridtin(again, &a, &tin, gap, 2, &count, NULL);
    ok(good && !memcmp(z, again, sizeof z), "one thread as two");
    double worst = 0;
    size_t missing = 0, differ = 0;
    for (size_t k = 0; good && k < SIDE * SIDE; k++) {
        bool on_edge;
        double want = locate(&tin, x0 + (double)(k % SIDE), y0 + (double)(k / SIDE), gap, &on_edge);
        missing += isnan(z[k]) != 0;
        /* a node between a gap and what is covered is covered, whichever triangle location finds */
        if (isnan(z[k]) != isnan(want) && (isnan(z[k]) || !on_edge))
            differ++;
        if (!isnan(z[k]) && !isnan(want))
            worst = fmax(worst, fabs(z[k] - want));
    }
    near(worst, 0, 1e-9, "heights as by location");
    ok(differ == 0, "the same nodes missing (%zu, %zu differ)", missing, differ);
    ok(count.gap + count.outside == missing, "missing nodes: %zu in gaps, %zu outside", count.gap,
       count.outside);
    hm_tin_free(&tin);
}

static void test_cellmean(void)
{
    enum { N = 20000, SIDE = 300 };
    static double sum[SIDE * SIDE], count[SIDE * SIDE], z[SIDE * SIDE];
    struct hm_cellmean *c;
    double sum_x = 0;
    struct hm_anchor a = {0.5, -150, -170, SIDE, SIDE};
    hm_cellmean_new(&c, 0.5, true, NULL);
    for (size_t k = 0; k < N; k++) {
        double x = 150 * uniform() - 75, y = 150 * uniform() - 85, h = uniform();
        size_t node =
            (size_t)(floor(y * 2 + 0.5) + 170) * SIDE + (size_t)(floor(x * 2 + 0.5) + 150);
        if (floor(x * 2 + 0.5) < 150 && floor(y * 2 + 0.5) < 130) {
            sum[node] += h;
            count[node]++;
            sum_x += x;
        }
        hm_cellmean_add(c, (const double[]){x, y, h}, 1, NULL);
    }
    hm_cellmean_get(c, &a, z);
    bool same = true;
    for (size_t k = 0; k < SIDE * SIDE; k++)
        same = same && (count[k] > 0 ? z[k] == sum[k] / count[k] : isnan(z[k]));
    ok(same, "cell means over many tiles, with negative numbers");
    double *xyz, whole = 0;
    size_t n, inside = 0, cells = 0;
    hm_cellmean_points(c, &a, &xyz, &n, NULL);
    for (size_t k = 0; k < n; k++) {
        double i = floor(xyz[3 * k] * 2 + 0.5), j = floor(xyz[3 * k + 1] * 2 + 0.5);
        size_t node = (size_t)(j + 170) * SIDE + (size_t)(i + 150);
        inside += node < SIDE * SIDE && z[node] == xyz[3 * k + 2];
        whole += xyz[3 * k] * count[node];
    }
    for (size_t k = 0; k < SIDE * SIDE; k++)
        cells += count[k] > 0;
    ok(n == cells && inside == n, "mean points lie in their cells");
    near(whole, sum_x, 1e-7, "and have the points' centre of gravity");
    free(xyz);
    ok(hm_cellmean_add(c, (const double[]){1e300, 0, 1}, 1, NULL) == HM_EGEOM,
       "a point too far off is refused");
    hm_cellmean_free(c);
}

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void test_median(void)
{
    enum { MOST = 41, RUNS = 500 };
    size_t wrong = 0;
    for (size_t run = 0; run < RUNS; run++) {
        double v[MOST], sorted[MOST];
        size_t n = 1 + run % MOST;
        for (size_t k = 0; k < n; k++)
            v[k] = sorted[k] = floor(uniform() * (run % 3 ? 1000 : 4));
        qsort(sorted, n, sizeof *sorted, by_value);
        double want = (sorted[n / 2] + sorted[(n - 1) / 2]) / 2;
        wrong += hm_cellsort_median(v, n) != want;
    }
    ok(wrong == 0, "medians by selection as by sorting");
}

/* Rows of samples against the evaluation of single places, to the border of the net. */
static void test_bsample(int degree, int over)
{
    enum { N = 7, M = 5 };
    struct hm_bsurf s;
    struct hm_bsample *b;
    static double z[400], zu[400], zv[400];
    double worst = 0;
    hm_bsurf_init(&s, degree, N, M, 1, NULL);
    for (int64_t k = 0; k < N * M; k++)
        *hm_bsurf_at(&s, k % N, k / N) = uniform();
    hm_bsurf_extend(&s);
    hm_bsample_new(&b, &s, over, NULL);
    for (int j = 0; j <= (M - 1) * over; j++) {
        hm_bsample_row(b, (size_t)j, z, zu, zv);
        for (int i = 0; i <= (N - 1) * over; i++) {
            double p, du, dv;
            hm_bspline_eval(&s, (double)i / over, (double)j / over, &p, &du, &dv);
            worst = fmax(worst, fabs(p - z[i]));
            if (degree > 1) /* degree 1 has edges, where two derivatives meet */
                worst = fmax(worst, fmax(fabs(du - zu[i]), fabs(dv - zv[i])));
        }
    }
    near(worst, 0, 1e-13, "samples as by single evaluation");
    hm_bsample_free(b);
    hm_bsurf_free(&s);
}

/* Every empty node that is filled lies on the plane; those in a wide gap are not. */
static void test_gapfill(void)
{
    enum { NX = 90, NY = 70 };
    static double z[NX * NY];
    size_t wrong = 0, filled = 0, far_in = 0;
    for (size_t k = 0; k < NX * NY; k++) {
        double i = (double)(k % NX), j = (double)(k / NX);
        bool hole = hypot(i - 45, j - 35) < 12 || uniform() < 0.8;
        z[k] = hole ? NAN : 3 * i - 2 * j;
    }
    hm_gapfill(z, NX, NY, 8, 1, NULL);
    for (size_t k = 0; k < NX * NY; k++) {
        double i = (double)(k % NX), j = (double)(k / NX);
        far_in += !isnan(z[k]) && hypot(i - 45, j - 35) < 6;
        filled += isnan(z[k]) == 0;
        wrong += !isnan(z[k]) && fabs(z[k] - 3 * i + 2 * j) > 1e-12;
    }
    ok(wrong == 0, "filled nodes lie on the plane");
    ok(filled > NX * NY * 8 / 10, "small gaps are filled");
    ok(far_in == 0, "the wide one is not");
    double few[] = {1, NAN, 3, NAN, NAN, NAN};
    ok(!hm_gapfill(few, 3, 2, 8, 1, NULL) && isnan(few[1]), "two nodes make no triangle");
    double line[] = {1, NAN, 3, NAN, 5, NAN};
    ok(!hm_gapfill(line, 6, 1, 8, 1, NULL) && isnan(line[1]), "nor do those on one line");
}

enum { FEW = 11 };
struct heights {
    double low, high;
};

/* Widen h by the height at p of every triangle of nodes with data over p whose circle is empty: all
 * that Delaunay allows. */
static void allow(const double *z, const int t[3], int p, struct heights *h)
{
    double xy[3][2], at[2] = {p % FEW, p / FEW}, area = 0, height = 0;
    for (int k = 0; k < 3; k++) {
        xy[k][0] = t[k] % FEW;
        xy[k][1] = t[k] / FEW;
    }
    if (hm_pred_orient(xy[0], xy[1], xy[2]) <= 0)
        return;
    for (int k = 0; k < 3; k++) {
        const double *a = xy[(k + 1) % 3], *b = xy[(k + 2) % 3];
        double w = (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
        if (w < 0)
            return;
        area += w;
        height += w * z[t[k]];
    }
    for (int q = 0; q < FEW * FEW; q++)
        if (!isnan(z[q]) &&
            hm_pred_incircle(xy[0], xy[1], xy[2], (const double[]){q % FEW, q / FEW}) > 0)
            return;
    h->low = fmin(h->low, height / area);
    h->high = fmax(h->high, height / area);
}

/* What is filled lies within what the Delaunay triangles over it say, by brute force; it is exactly
 * that where they agree. */
static void test_gapfill_delaunay(double share)
{
    double z[FEW * FEW], filled[FEW * FEW];
    int data[FEW * FEW], n = 0, wrong = 0, beyond = 0;
    for (int k = 0; k < FEW * FEW; k++) {
        z[k] = filled[k] = uniform() < share ? NAN : uniform();
        if (!isnan(z[k]))
            data[n++] = k;
    }
    hm_gapfill(filled, FEW, FEW, 1e6, 1, NULL);
    for (int p = 0; p < FEW * FEW; p++) {
        struct heights h = {INFINITY, -INFINITY};
        if (!isnan(z[p]))
            continue;
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n; b++)
                for (int c = a + 1; c < n && b > a; c++)
                    allow(z, (const int[]){data[a], data[b], data[c]}, p, &h);
        beyond += h.low > h.high;
        wrong += h.low > h.high ? !isnan(filled[p])
                                : !(filled[p] > h.low - 1e-12 && filled[p] < h.high + 1e-12);
    }
    ok(wrong == 0 && beyond < FEW * FEW / 2, "gaps of %g of the nodes are filled as Delaunay says",
       share);
}

int main(void)
{
    test_anchor();
    test_gridtin(0, 0, 3);
    test_gridtin(545000, 5972000, 2.2);
    test_gridtin(-30, -30, 1e9);
    test_cellmean();
    test_median();
    for (int degree = 1; degree <= 3; degree++)
        for (int over = 1; over <= 4; over++)
            test_bsample(degree, over);
    test_gapfill();
    test_gapfill_delaunay(0.08);
    test_gapfill_delaunay(0.3);
    test_gapfill_delaunay(0.7);
    return done();
}
