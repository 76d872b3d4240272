/* Surfaces draped over heights that are known, and the Coons patch below them. */
#include "hm_coons.h"
#include "hm_drape.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static uint64_t seed = 5;

static double chance(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

static void fill(struct hm_bsurf *s, double (*height)(double u, double v))
{
    for (int64_t j = 0; j < (int64_t)s->m; j++)
        for (int64_t i = 0; i < (int64_t)s->n; i++) {
            double *d = hm_bsurf_at(s, i, j);
            d[0] = (double)i;
            d[1] = (double)j;
            d[2] = height((double)i, (double)j);
        }
    hm_bsurf_extend(s);
}

static double slant(double u, double v)
{
    return 3 + 2 * u - 0.5 * v;
}

static double rough(double u, double v)
{
    (void)u, (void)v;
    return chance();
}

static double zero(double u, double v)
{
    (void)u, (void)v;
    return 0;
}

static void sample(const struct hm_bsurf *s, size_t na, size_t nb, double *z)
{
    for (size_t k = 0; k < na * nb; k++) {
        double p[3];
        hm_bspline_eval(s, (double)(k % na) * (double)(s->n - 1) / (double)(na - 1),
                        (double)(k / na) * (double)(s->m - 1) / (double)(nb - 1), p, NULL, NULL);
        z[k] = p[2];
    }
}

static double worst(const struct hm_bsurf *a, const struct hm_bsurf *b)
{
    double most = 0;
    for (int64_t j = -1; j <= (int64_t)a->m; j++)
        for (int64_t i = -1; i <= (int64_t)a->n; i++)
            most = fmax(most, fabs(hm_bsurf_at(a, i, j)[2] - hm_bsurf_at(b, i, j)[2]));
    return most;
}

/* What a surface can represent it shall become: from zero to the surface that was sampled. */
static void test_reproduces(int degree, size_t n, size_t m)
{
    struct hm_bsurf want, got, again;
    struct hm_diag d = {0};
    size_t na = (n - 1) * 4 + 1, nb = (m - 1) * 4 + 1;
    double *z = malloc(na * nb * sizeof *z);
    bool good = !hm_bsurf_init(&want, degree, n, m, 3, &d) &&
                !hm_bsurf_init(&got, degree, n, m, 3, &d) &&
                !hm_bsurf_init(&again, degree, n, m, 3, &d);
    fill(&want, rough);
    sample(&want, na, nb, z);
    fill(&got, zero);
    good = good && !hm_drape(&got, z, na, nb, 4000, 1, &d);
    ok(good && worst(&want, &got) < 1e-6, "degree %d, %zu by %zu: the surface sampled (%g off)",
       degree, n, m, worst(&want, &got));
    fill(&got, zero);
    fill(&again, zero);
    hm_drape(&got, z, na, nb, 5, 1, &d);
    hm_drape(&again, z, na, nb, 5, 3, &d);
    ok(!memcmp(got.d, again.d, (n + 2) * (m + 2) * 3 * sizeof *got.d), "the same by three threads");
    fill(&want, slant);
    sample(&want, na, nb, z);
    z[na] = z[na + 1] = z[2 * na] = NAN; /* a gap */
    fill(&got, slant);
    hm_drape(&got, z, na, nb, 5, 1, &d);
    near(worst(&want, &got), 0, 1e-12, "a plane stays a plane, with a gap in the samples");
    hm_bsurf_free(&want);
    hm_bsurf_free(&got);
    hm_bsurf_free(&again);
    free(z);
}

static void test_unknown(void)
{
    struct hm_bsurf s, start;
    struct hm_diag d = {0};
    double z[29 * 29];
    hm_bsurf_init(&s, 2, 8, 8, 3, &d);
    hm_bsurf_init(&start, 2, 8, 8, 3, &d);
    fill(&s, slant);
    fill(&start, slant);
    for (size_t k = 0; k < 29 * 29; k++)
        z[k] = NAN;
    hm_drape(&s, z, 29, 29, 5, 1, &d);
    near(worst(&s, &start), 0, 0, "without any sample nothing moves");
    hm_bsurf_free(&s);
    hm_bsurf_free(&start);
}

static void test_coons(void)
{
    enum { N = 6, M = 4 };
    double net[N * M * 3], u[N], v[M] = {0, 0.1, 0.7, 1};
    for (size_t k = 0; k < N * M * 3; k++)
        net[k] = -7;
    for (size_t i = 0; i < N; i++)
        u[i] = (double)i / (N - 1);
    /* a bilinear patch is its own Coons patch, and bent banks with straight sections give the ruled
     * surface between them */
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < M; j++)
            if (i == 0 || i + 1 == N || j == 0 || j + 1 == M) {
                double *p = net + 3 * (j * N + i);
                p[0] = 10 * u[i] + v[j] * u[i];
                p[1] = 4 * v[j] + (1 - v[j]) * u[i] * (1 - u[i]);
            }
    hm_coons_fill(net, N, M, 3, u, v);
    double off = 0;
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < M; j++) {
            const double *p = net + 3 * (j * N + i);
            off = fmax(off, fabs(p[0] - 10 * u[i] - v[j] * u[i]));
            off = fmax(off, fabs(p[1] - 4 * v[j] - (1 - v[j]) * u[i] * (1 - u[i])));
        }
    near(off, 0, 1e-14, "Coons patch: ruled between bent banks");
    ok(net[3 * (N + 1) + 2] == -7, "and z is left alone");
}

int main(void)
{
    for (int degree = 1; degree <= 3; degree++)
        test_reproduces(degree, 7, 5);
    test_reproduces(2, 2, 2);
    test_reproduces(3, 3, 2);
    test_unknown();
    test_coons();
    return done();
}
