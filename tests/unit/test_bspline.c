/* B-spline basis, surfaces and dragging against the facts that the scheme names. */
#include "hm_bspline.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

/* Equation (7) on uniform knots, counted so that control point 0 has its Greville site at 0. */
static double by_recursion(int degree, int64_t control, double u)
{
    double knots[32];
    for (int k = 0; k < 32; k++)
        knots[k] = k - 16 - (degree + 1) / 2.0;
    return hm_bspline_basis(knots, (size_t)(control + 16), degree, u);
}

static void test_basis(int degree)
{
    double worst = 0, sum_error = 0, slope_sum = 0, slope_error = 0, linear_error = 0;
    for (double u = 0; u < 5; u += 1.0 / 64) {
        double w[4], dw[4], ahead[4], behind[4], sum = 0, slopes = 0, place = 0;
        int64_t first, f1, f2;
        hm_bspline_weights(degree, u, &first, w, dw);
        hm_bspline_weights(degree, u + 1e-6, &f1, ahead, NULL);
        hm_bspline_weights(degree, u - 1e-6, &f2, behind, NULL);
        for (int k = 0; k <= degree; k++) {
            worst = fmax(worst, fabs(w[k] - by_recursion(degree, first + k, u)));
            sum += w[k];
            slopes += dw[k];
            place += w[k] * (double)(first + k);
            if (f1 == first && f2 == first)
                slope_error = fmax(slope_error, fabs((ahead[k] - behind[k]) / 2e-6 - dw[k]));
        }
        sum_error = fmax(sum_error, fabs(sum - 1));
        slope_sum = fmax(slope_sum, fabs(slopes));
        linear_error = fmax(linear_error, fabs(place - u));
    }
    ok(worst < 1e-14, "degree %d: weights are those of the recursion (7)", degree);
    ok(sum_error < 1e-15, "degree %d: the basis sums to one", degree);
    ok(slope_sum < 1e-15, "degree %d: its derivatives sum to zero", degree);
    ok(slope_error < 1e-9, "degree %d: derivatives agree with differences", degree);
    ok(linear_error < 1e-14, "degree %d: u = i is the Greville site of control point i", degree);
}

static void test_multiple_knots(void)
{
    const double knots[] = {0, 0, 0, 1, 1, 1}; /* Bernstein polynomials: 0/0 counts as 0 */
    double sum = 0;
    for (size_t i = 0; i < 3; i++)
        sum += hm_bspline_basis(knots, i, 2, 0.25);
    near(sum, 1, 1e-15, "basis on multiple knots sums to one");
    near(hm_bspline_basis(knots, 1, 2, 0.25), 2 * 0.25 * 0.75, 1e-15, "and is Bernstein's");
}

static double height(size_t i, size_t j)
{
    return sin(0.7 * (double)i) + 0.1 * (double)(j * j) - 0.3 * (double)(i * j % 7);
}

/* A surface that passes through its data at all Greville sites, borders and corners included. */
static void test_interpolation(int degree)
{
    enum { N = 9, M = 7 };
    struct hm_bsurf s;
    double z[N * M], rest = 1, worst = 0;
    hm_bsurf_init(&s, degree, N, M, 1, NULL);
    for (size_t j = 0; j < M; j++)
        for (size_t i = 0; i < N; i++)
            z[j * N + i] = *hm_bsurf_at(&s, (int64_t)i, (int64_t)j) = height(i, j);
    hm_bspline_drag(&s, z, 200, 0, 1, &rest, NULL);
    for (size_t j = 0; j < M; j++)
        for (size_t i = 0; i < N; i++) {
            double p;
            hm_bspline_eval(&s, (double)i, (double)j, &p, NULL, NULL);
            worst = fmax(worst, fabs(p - z[j * N + i]));
        }
    ok(rest < 1e-12 && worst < 1e-12, "degree %d: dragging converges to interpolation", degree);
    hm_bsurf_free(&s);
}

/* A plane in three coordinates, with its derivatives, up to the outermost Greville lines. */
static void test_plane(int degree)
{
    enum { N = 5, M = 4 };
    struct hm_bsurf s;
    double worst = 0;
    hm_bsurf_init(&s, degree, N, M, 3, NULL);
    for (int64_t j = 0; j < M; j++)
        for (int64_t i = 0; i < N; i++) {
            double *d = hm_bsurf_at(&s, i, j);
            d[0] = 2.0 * (double)i;
            d[1] = 3.0 * (double)j;
            d[2] = (double)(i - 2 * j);
        }
    hm_bsurf_extend(&s);
    for (double v = 0; v <= M - 1; v += 0.25)
        for (double u = 0; u <= N - 1; u += 0.25) {
            double p[3], du[3], dv[3];
            hm_bspline_eval(&s, u, v, p, du, dv);
            worst = fmax(worst, fabs(p[0] - 2 * u) + fabs(p[1] - 3 * v) + fabs(p[2] - u + 2 * v));
            worst = fmax(worst, fabs(du[0] - 2) + fabs(dv[1] - 3) + fabs(du[2] - 1) +
                                    fabs(dv[2] + 2) + fabs(du[1]) + fabs(dv[0]));
        }
    ok(worst < 1e-13, "degree %d: a plane and its derivatives are exact to the border", degree);
    hm_bsurf_free(&s);
}

/* scheme.md: a spike of 1 keeps 0.56, 0.77, 0.97 of its height after 0, 1, 5 iterations. */
static void test_spike(int iterations, double keeps)
{
    enum { N = 41 };
    struct hm_bsurf s;
    double *z = calloc((size_t)N * N, sizeof *z), p;
    z[20 * N + 20] = 1;
    hm_bsurf_init(&s, 2, N, N, 1, NULL);
    *hm_bsurf_at(&s, 20, 20) = 1;
    hm_bspline_drag(&s, z, iterations, 0, 1, NULL, NULL);
    hm_bspline_eval(&s, 20, 20, &p, NULL, NULL);
    near(p, keeps, 0.005, "a spike's height after dragging");
    hm_bsurf_free(&s);
    free(z);
}

static void test_threads(void)
{
    enum { N = 67, M = 333 };
    struct hm_bsurf s[2];
    double *z = malloc(sizeof *z * N * M);
    for (size_t k = 0; k < (size_t)N * M; k++)
        z[k] = k % 101 == 7 ? NAN : height(k % N, k / N);
    for (int t = 0; t < 2; t++) {
        hm_bsurf_init(&s[t], 2, N, M, 1, NULL);
        for (size_t k = 0; k < (size_t)N * M; k++)
            *hm_bsurf_at(&s[t], (int64_t)(k % N), (int64_t)(k / N)) = isnan(z[k]) ? 1 : z[k];
        hm_bspline_drag(&s[t], z, 3, 0, t + 1, NULL, NULL);
    }
    ok(!memcmp(s[0].d, s[1].d, sizeof(double) * (N + 2) * (M + 2)), "two threads: the same bytes");
    ok(*hm_bsurf_at(&s[0], 7, 0) == 1, "a control point without data stays");
    hm_bsurf_free(&s[0]);
    hm_bsurf_free(&s[1]);
    free(z);
}

static void test_refusals(void)
{
    struct hm_bsurf s;
    struct hm_diag d = {0};
    ok(hm_bsurf_init(&s, 4, 5, 5, 1, &d) == HM_EARG, "degree 4 is refused");
    ok(hm_bsurf_init(&s, 2, 1, 5, 1, NULL) == HM_EARG, "one control point is refused");
    ok(hm_bsurf_init(&s, 2, SIZE_MAX / 2, 5, 1, NULL) == HM_ENOMEM, "an absurd net is refused");
    ok(hm_bsurf_init(&s, 2, 1u << 31, SIZE_MAX >> 20, 1, NULL) == HM_ENOMEM, "another one, too");
}

int main(void)
{
    for (int degree = 1; degree <= 3; degree++) {
        test_basis(degree);
        test_interpolation(degree);
        test_plane(degree);
    }
    test_multiple_knots();
    test_spike(0, 0.56);
    test_spike(1, 0.77);
    test_spike(5, 0.97);
    test_threads();
    test_refusals();
    return done();
}
