/* Slopes: every method on planes (borders, holes, any steps), orders of error on a curved surface.
 */
#include "hm_bsample.h"
#include "hm_slope.h"
#include "tap.h"

#include <stdlib.h>

static const double degree = 3.14159265358979323846 / 180;

enum { NX = 23, NY = 17 };

struct field {
    double z[NX * NY], gx[NX * NY], gy[NX * NY], dx, dy;
};

static void take(struct field *f, enum hm_slope_method method)
{
    for (size_t j = 0; j < NY; j++) {
        const double *const rows[3] = {j > 0 ? f->z + (j - 1) * NX : NULL, f->z + j * NX,
                                       j + 1 < NY ? f->z + (j + 1) * NX : NULL};
        hm_slope_gradient(method, rows, NX, f->dx, f->dy, f->gx + j * NX, f->gy + j * NX);
    }
}

static void test_plane(enum hm_slope_method method, double dx, double dy, bool holes)
{
    static struct field f;
    f.dx = dx;
    f.dy = dy;
    for (size_t k = 0; k < NX * NY; k++)
        f.z[k] = 0.3 * (double)(k % NX) * dx - 0.7 * (double)(k / NX) * dy;
    for (size_t k = 0; holes && k < NX * NY; k += 11)
        f.z[k] = NAN;
    take(&f, method);
    double worst = 0;
    size_t missing = 0;
    for (size_t k = 0; k < NX * NY; k++) {
        if (isnan(f.gx[k])) {
            missing++;
            continue;
        }
        worst = fmax(worst, fmax(fabs(f.gx[k] - 0.3), fabs(f.gy[k] + 0.7)));
    }
    size_t want = holes ? (NX * NY + 10) / 11 : 0;
    /* a node between two holes, or a hole and the border, knows nothing from the middle row alone
     */
    size_t more = !holes ? 0 : method == HM_SLOPE_ZT || method == HM_SLOPE_SIMPLE ? 20 : 2;
    ok(worst < 1e-13 && missing >= want && missing <= want + more,
       "method %d is exact on a plane, steps %g %g%s", (int)method, dx, dy,
       holes ? ", with holes" : "");
}

/* Equation (1), node by node. */
static void test_equation(void)
{
    static struct field f;
    f.dx = f.dy = 2;
    for (size_t k = 0; k < NX * NY; k++)
        f.z[k] = (double)(k * 7919 % 101);
    take(&f, HM_SLOPE_OVER_DISTANCE);
    double worst = 0, r2 = sqrt(2);
    for (size_t j = 1; j + 1 < NY; j++)
        for (size_t i = 1; i + 1 < NX; i++) {
            const double *z = f.z + j * NX + i;
            double u = (z[NX + 1] + r2 * z[1] + z[1 - NX]) - (z[NX - 1] + r2 * z[-1] + z[-1 - NX]);
            double v =
                (z[NX - 1] + r2 * z[NX] + z[NX + 1]) - (z[-1 - NX] + r2 * z[-NX] + z[1 - NX]);
            double s = atan(hypot(u, v) / ((4 + 2 * r2) * 2)) / degree;
            double got = hm_slope_of(f.gx[j * NX + i], f.gy[j * NX + i], HM_SLOPE_DEGREE);
            worst = fmax(worst, fabs(got - s));
        }
    ok(worst < 1e-12, "one-over-distance is equation (1)");
}

static double error_at(enum hm_slope_method method, double h)
{
    double z[3][3], gx[3], gy[3], x0 = 0.4, y0 = 0.7;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            z[j][i] = sin(x0 + (i - 1) * h) * exp(y0 + (j - 1) * h);
    const double *const rows[3] = {z[0], z[1], z[2]};
    hm_slope_gradient(method, rows, 3, h, h, gx, gy);
    return hypot(gx[1] - cos(x0) * exp(y0), gy[1] - sin(x0) * exp(y0));
}

static void test_order(enum hm_slope_method method, double want)
{
    double order = log2(error_at(method, 0.02) / error_at(method, 0.01));
    near(order, want, 0.1, "order of error on a curved surface");
}

/* The derivative of the B-spline surface of degree k that has the heights as control points. */
static double spline_error_at(int k, double h)
{
    enum { N = 5, MIDDLE = 2 };
    struct hm_bsurf s;
    struct hm_bsample *b;
    double z[N], zu[N], zv[N], x0 = 0.4, y0 = 0.7;
    hm_bsurf_init(&s, k, N, N, 1, NULL);
    for (int64_t j = 0; j < N; j++)
        for (int64_t i = 0; i < N; i++)
            *hm_bsurf_at(&s, i, j) =
                sin(x0 + (double)(i - MIDDLE) * h) * exp(2 * (y0 + (double)(j - MIDDLE) * h));
    hm_bsurf_extend(&s);
    hm_bsample_new(&b, &s, 1, NULL);
    hm_bsample_row(b, MIDDLE, z, zu, zv);
    hm_bsample_free(b);
    hm_bsurf_free(&s);
    return hypot(zu[MIDDLE] / h - cos(x0) * exp(2 * y0),
                 zv[MIDDLE] / h - 2 * sin(x0) * exp(2 * y0));
}

/* Errors of the second derivatives and of the curvatures made of them. */
static double second_error_at(enum hm_slope_method method, double h)
{
    double z[3][3], x0 = 0.4, y0 = 0.7, u = sin(x0) * exp(y0), v = cos(x0) * exp(y0);
    struct hm_slope_second got[3], want = {-u, v, u};
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            z[j][i] = sin(x0 + (i - 1) * h) * exp(y0 + (j - 1) * h);
    hm_slope_second(method, (const double *const[]){z[0], z[1], z[2]}, 3, h, h, got);
    double profile = hm_slope_profile_curvature(v, u, &got[1]);
    double plan = hm_slope_plan_curvature(v, u, &got[1]);
    return fabs(got[1].xx - want.xx) + fabs(got[1].xy - want.xy) + fabs(got[1].yy - want.yy) +
           fabs(profile - hm_slope_profile_curvature(v, u, &want)) +
           fabs(plan - hm_slope_plan_curvature(v, u, &want));
}

static void test_second_order(enum hm_slope_method method)
{
    near(log2(second_error_at(method, 0.02) / second_error_at(method, 0.01)), 2, 0.1,
         "order of error of second derivatives");
}

/* Beside a missing node what is left still gives a quadratic surface exactly. */
static void test_second_beside_nodata(void)
{
    double z[3][5];
    struct hm_slope_second s[5];
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 5; i++)
            z[j][i] = 2 * i * i - 3 * i * j + 0.5 * j * j + i;
    z[0][0] = z[2][3] = NAN;
    hm_slope_second(HM_SLOPE_HORN, (const double *const[]){z[0], z[1], z[2]}, 5, 1, 1, s);
    double worst = 0;
    for (int i = 1; i < 4; i++)
        worst = fmax(worst, fabs(s[i].xx - 4) + fabs(s[i].xy + 3) + fabs(s[i].yy - 1));
    near(worst, 0, 1e-12, "second derivatives beside nodata");
    hm_slope_second(HM_SLOPE_ZT, (const double *const[]){NULL, z[1], z[2]}, 5, 1, 1, s);
    ok(isnan(s[2].yy) && s[2].xx == 4 && isnan(s[0].xx), "none at the border");
}

static void test_steepest(void)
{
    static struct field f;
    f.dx = f.dy = 1;
    for (size_t k = 0; k < NX * NY; k++)
        f.z[k] = 0.5 * (double)(k % NX) + 0.5 * (double)(k / NX);
    take(&f, HM_SLOPE_STEEPEST);
    double worst = 0;
    for (size_t k = 0; k < NX * NY; k++) {
        bool corner = k == NX - 1 || k == NX * NY - NX; /* no diagonal neighbour up or down there */
        if (!corner)
            worst = fmax(worst, fabs(hypot(f.gx[k], f.gy[k]) - sqrt(0.5)));
    }
    ok(worst < 1e-14, "steepest is exact along a neighbour");
}

int main(void)
{
    const double steps[][2] = {{1, 1}, {5, 5}, {2, 3}, {1, -1}, {-0.5, 2}};
    for (int m = HM_SLOPE_OVER_DISTANCE; m <= HM_SLOPE_SIMPLE; m++)
        for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
            test_plane((enum hm_slope_method)m, steps[k][0], steps[k][1], false);
            test_plane((enum hm_slope_method)m, steps[k][0], steps[k][1], true);
        }
    test_equation();
    for (int m = HM_SLOPE_OVER_DISTANCE; m <= HM_SLOPE_EQUAL; m++)
        test_order((enum hm_slope_method)m, 2);
    test_order(HM_SLOPE_SIMPLE, 1);
    test_order(HM_SLOPE_STEEPEST, 0); /* eight directions stay eight */
    for (int k = 1; k <= 3; k++)
        near(log2(spline_error_at(k, 0.02) / spline_error_at(k, 0.01)), 2, 0.1,
             "order of error of the surface's own derivative");
    for (int m = HM_SLOPE_OVER_DISTANCE; m <= HM_SLOPE_STEEPEST; m++)
        test_second_order((enum hm_slope_method)m);
    test_second_beside_nodata();
    test_steepest();
    near(hm_slope_aspect(0, -1), 0, 0, "ground that falls to the north: aspect 0");
    near(hm_slope_aspect(-1, 0), 90, 1e-13, "to the east: 90");
    near(hm_slope_aspect(0, 1), 180, 1e-13, "to the south: 180");
    near(hm_slope_aspect(1, 0), 270, 1e-13, "to the west: 270");
    ok(isnan(hm_slope_aspect(0, 0)), "level ground has no aspect");
    near(hm_slope_convert(45, HM_SLOPE_DEGREE, HM_SLOPE_PERCENT), 100, 1e-13, "45 degrees: 100 %");
    near(hm_slope_convert(100, HM_SLOPE_PERCENT, HM_SLOPE_RADIAN), 45 * degree, 1e-15,
         "100 %: pi/4");
    return done();
}
