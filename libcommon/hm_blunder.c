#include "hm_blunder.h"

#include "hm_cellsort.h"
#include "hm_lspia.h"

#include <math.h>
#include <stdlib.h>

enum {
    NEAREST = 1, /* cells around, made wider */
    WIDEST = 8,  /* as far as this */
    ENOUGH = 12, /* until so many measurements are around */
    FEWEST = 5,  /* fewer tell no plane */
    ALONE = 2    /* a blunder has no more companions */
};

struct search {
    const struct hm_anchor *a;
    const double *xyz;
    double *rest; /* residuals; NaN: not judged */
    double limit, k;
    struct hm_cellsort cells;
    size_t *around; /* the measurements around a place */
    double *away;   /* their distances from the plane through them */
    double *sizes;  /* room for a median of them */
    size_t n, around_cap, away_cap, sizes_cap;
};

/* The standard deviation of normal errors is so many times the median of their sizes. */
static double robust_sigma(double *sizes, size_t n)
{
    return n > 0 ? 1.4826 * hm_cellsort_median(sizes, n) : 0;
}

/* --- the measurements around --- */

static enum hm_err collect(struct search *s, size_t i, size_t j, size_t reach, struct hm_diag *d)
{
    const struct hm_cellsort *c = &s->cells;
    size_t i0 = i > reach ? i - reach : 0, i1 = i + reach < c->nx ? i + reach : c->nx - 1;
    size_t j0 = j > reach ? j - reach : 0, j1 = j + reach < c->ny ? j + reach : c->ny - 1;
    s->n = 0;
    for (j = j0; j <= j1; j++) {
        size_t from = c->start[j * c->nx + i0], to = c->start[j * c->nx + i1 + 1];
        if (!hm_grow(&s->around, &s->around_cap, s->n + to - from, sizeof *s->around))
            return hm_fail_memory(d);
        for (size_t k = from; k < to; k++)
            s->around[s->n++] = c->item[k];
    }
    if (!hm_grow(&s->away, &s->away_cap, s->n, sizeof *s->away) ||
        !hm_grow(&s->sizes, &s->sizes_cap, s->n, sizeof *s->sizes))
        return hm_fail_memory(d);
    return HM_OK;
}

/* Measurements around measurement p, itself included; none when it is outside of the net. */
static enum hm_err look_around(struct search *s, size_t p, struct hm_diag *d)
{
    size_t i, j;
    enum hm_err err = HM_OK;
    s->n = 0;
    if (!hm_cellsort_cell(s->a, s->xyz + 3 * p, &i, &j))
        return HM_OK;
    for (size_t reach = NEAREST; reach <= WIDEST && s->n < ENOUGH && !err; reach *= 2)
        err = collect(s, i, j, reach, d);
    return err;
}

/* --- the plane --- */

/* Sums about an origin: of weights w, and of their products with x, y, z. */
struct sums {
    double w, x, y, z, xx, xy, yy, xz, yz;
};

/* The plane of weighted least squares, z = p[0] + p[1] x + p[2] y; level when the measurements lie
 * on a line. */
static void solve(const struct sums *s, double p[3])
{
    double x = s->x / s->w, y = s->y / s->w, z = s->z / s->w;
    double xx = s->xx - x * s->x, xy = s->xy - x * s->y, yy = s->yy - y * s->y;
    double xz = s->xz - x * s->z, yz = s->yz - y * s->z, det = xx * yy - xy * xy;
    bool level = !(det > 1e-9 * xx * yy);
    p[1] = level ? 0 : (xz * yy - yz * xy) / det;
    p[2] = level ? 0 : (yz * xx - xz * xy) / det;
    p[0] = z - p[1] * x - p[2] * y;
}

/* Distances from the plane of least absolute deviations, by least squares with the inverse of the
 * last distances as weights. */
static void fit_plane(struct search *s)
{
    enum { ROUNDS = 12 };
    const double closest = 1e-3; /* metres: nearer ones have no larger weight */
    const double *origin = s->xyz + 3 * s->around[0];
    for (size_t k = 0; k < s->n; k++)
        s->away[k] = 1;
    for (int round = 0; round < ROUNDS; round++) {
        struct sums t = {0};
        double plane[3];
        for (size_t k = 0; k < s->n; k++) {
            const double *q = s->xyz + 3 * s->around[k];
            double w = 1 / fmax(fabs(s->away[k]), closest);
            double x = q[0] - origin[0], y = q[1] - origin[1], z = q[2] - origin[2];
            t.w += w, t.x += w * x, t.y += w * y, t.z += w * z;
            t.xx += w * x * x, t.xy += w * x * y, t.yy += w * y * y;
            t.xz += w * x * z, t.yz += w * y * z;
        }
        solve(&t, plane);
        for (size_t k = 0; k < s->n; k++) {
            const double *q = s->xyz + 3 * s->around[k];
            s->away[k] = q[2] - origin[2] - plane[0] - plane[1] * (q[0] - origin[0]) -
                         plane[2] * (q[1] - origin[1]);
        }
    }
}

/* --- the blunder --- */

/* The measurement farthest off the plane; of equals the one that lies first, row by row. */
static size_t farthest(const struct search *s)
{
    size_t best = 0;
    for (size_t k = 1; k < s->n; k++) {
        double more = fabs(s->away[k]) - fabs(s->away[best]);
        const double *a = s->xyz + 3 * s->around[k], *b = s->xyz + 3 * s->around[best];
        if (more > 0 || (more == 0 && (a[1] < b[1] || (a[1] == b[1] && a[0] < b[0]))))
            best = k;
    }
    return best;
}

static bool is_blunder(const struct search *s, size_t k)
{
    double away = s->away[k];
    size_t companions = 0, n = 0;
    if (!(fabs(s->rest[s->around[k]]) > s->limit))
        return false;
    for (size_t q = 0; q < s->n; q++) {
        if (q == k)
            continue;
        companions += s->away[q] / away > 0.5;
        s->sizes[n++] = fabs(s->away[q]);
    }
    return companions <= ALONE && fabs(away) > s->limit &&
           fabs(away) > s->k * robust_sigma(s->sizes, n);
}

static enum hm_err sigma_of_all(const double *rest, size_t n, double *sigma, struct hm_diag *d)
{
    double *sizes = hm_alloc(n, sizeof *sizes);
    if (!sizes)
        return hm_fail_memory(d);
    size_t judged = 0;
    for (size_t p = 0; p < n; p++)
        if (!isnan(rest[p]))
            sizes[judged++] = fabs(rest[p]);
    *sigma = robust_sigma(sizes, judged);
    free(sizes);
    return HM_OK;
}

static enum hm_err run(struct search *s, size_t n, bool *bad, size_t *found, struct hm_diag *d)
{
    enum hm_err err = hm_cellsort_make(&s->cells, s->a, s->xyz, n, d);
    for (size_t p = 0; p < n && !err; p++) {
        if (!(fabs(s->rest[p]) > s->limit))
            continue;
        err = look_around(s, p, d);
        if (err || s->n <= FEWEST)
            continue;
        fit_plane(s);
        size_t k = farthest(s);
        if (!bad[s->around[k]] && is_blunder(s, k)) {
            bad[s->around[k]] = true;
            ++*found;
        }
    }
    hm_cellsort_free(&s->cells);
    return err;
}

enum hm_err hm_blunder_find(const struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz,
                            size_t n, const struct hm_blunder_rule *rule, int threads, bool *bad,
                            size_t *found, double *sigma, struct hm_diag *d)
{
    struct search search = {.a = a, .xyz = xyz, .k = rule->k};
    *found = 0;
    search.rest = hm_alloc(n, sizeof *search.rest);
    if (!search.rest)
        return hm_fail_memory(d);
    hm_lspia_residuals(s, a, xyz, n, threads, search.rest);
    enum hm_err err = sigma_of_all(search.rest, n, sigma, d);
    search.limit = fmax(rule->k * *sigma, rule->least);
    if (!err)
        err = run(&search, n, bad, found, d);
    free(search.rest);
    free(search.around);
    free(search.away);
    free(search.sizes);
    return err;
}
