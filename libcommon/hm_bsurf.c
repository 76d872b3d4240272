#include "hm_bsurf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* rows and columns first, then diagonals */
static const int direction[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                    {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};

enum hm_err hm_bsurf_init(struct hm_bsurf *s, int degree, size_t n, size_t m, size_t dim,
                          struct hm_diag *d)
{
    *s = (struct hm_bsurf){.degree = degree, .n = n, .m = m, .dim = dim};
    if (degree < 1 || degree > 3)
        return hm_fail(d, HM_EARG, "degree %d of a B-spline surface is not 1, 2 or 3", degree);
    if (n < 2 || m < 2)
        return hm_fail(d, HM_EARG, "a B-spline surface needs 2 control points in each direction");
    if (n > PTRDIFF_MAX / 64 || m > PTRDIFF_MAX / 64 / (n + 2) - 2)
        return hm_fail_memory(d);
    s->d = hm_alloc0((n + 2) * (m + 2), dim * sizeof *s->d);
    return s->d ? HM_OK : hm_fail_memory(d);
}

void hm_bsurf_free(struct hm_bsurf *s)
{
    if (s->fringe) {
        free(s->fringe->state);
        free(s->fringe->item);
    }
    free(s->fringe);
    free(s->d);
    *s = (struct hm_bsurf){0};
}

/* --- the fringe --- */

static bool is_beside_data(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    for (int k = 0; k < 8; k++)
        if (hm_bsurf_has_data(s, i + direction[k][0], j + direction[k][1]))
            return true;
    return false;
}

static enum hm_err find_fringe(const struct hm_bsurf *s, struct hm_diag *d)
{
    struct hm_bsurf_fringe *f = s->fringe;
    for (int64_t j = -1; j <= (int64_t)s->m; j++)
        for (int64_t i = -1; i <= (int64_t)s->n; i++) {
            size_t at = hm_bsurf_position(s, i, j);
            if (f->state[at] == HM_BSURF_DATA || !is_beside_data(s, i, j))
                continue;
            if (!hm_grow(&f->item, &f->cap, f->n + 1, sizeof *f->item))
                return hm_fail_memory(d);
            f->item[f->n++] = at;
            f->state[at] = HM_BSURF_FRINGE;
        }
    return HM_OK;
}

static void set_states(const struct hm_bsurf *s, const double *z)
{
    for (size_t j = 0; j < s->m; j++, z += s->n) {
        int8_t *state = s->fringe->state + hm_bsurf_position(s, 0, (int64_t)j);
        double *d = hm_bsurf_at(s, 0, (int64_t)j);
        for (size_t i = 0; i < s->n; i++, d += s->dim) {
            if (!isnan(z[i]))
                state[i] = HM_BSURF_DATA;
            else
                memset(d, 0, s->dim * sizeof *d);
        }
    }
}

enum hm_err hm_bsurf_set_missing(struct hm_bsurf *s, const double *z, struct hm_diag *d)
{
    size_t k = 0, nodes = s->n * s->m;
    while (k < nodes && !isnan(z[k]))
        k++;
    if (k == nodes)
        return HM_OK;
    s->fringe = hm_alloc0(1, sizeof *s->fringe);
    if (!s->fringe)
        return hm_fail_memory(d);
    s->fringe->state = hm_alloc0((s->n + 2) * (s->m + 2), sizeof *s->fringe->state);
    if (!s->fringe->state)
        return hm_fail_memory(d);
    set_states(s, z);
    return find_fringe(s, d);
}

bool hm_bsurf_knows(const struct hm_bsurf *s, int64_t i, int64_t j)
{
    return !s->fringe || s->fringe->state[hm_bsurf_position(s, i, j)] != HM_BSURF_MISSING;
}

/* Mean of the linear extrapolations along directions first .. first+3; false when no direction has
 * two control points with data. */
static bool by_lines(const struct hm_bsurf *s, int64_t i, int64_t j, int first, size_t c,
                     double *value)
{
    double sum = 0;
    int n = 0;
    for (int k = first; k < first + 4; k++) {
        int di = direction[k][0], dj = direction[k][1];
        if (!hm_bsurf_has_data(s, i + di, j + dj) || !hm_bsurf_has_data(s, i + 2 * di, j + 2 * dj))
            continue;
        sum += 2 * hm_bsurf_at(s, i + di, j + dj)[c] - hm_bsurf_at(s, i + 2 * di, j + 2 * dj)[c];
        n++;
    }
    *value = sum / n;
    return n > 0;
}

/* The plane of least squares through the control points up to two steps away, at (i, j); their mean
 * when they lie on one line. */
static double by_plane(const struct hm_bsurf *s, int64_t i, int64_t j, size_t c)
{
    double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
    for (int dj = -2; dj <= 2; dj++)
        for (int di = -2; di <= 2; di++) {
            if (!hm_bsurf_has_data(s, i + di, j + dj))
                continue;
            double v = hm_bsurf_at(s, i + di, j + dj)[c];
            n += 1, x += di, y += dj, z += v;
            xx += di * di, xy += di * dj, yy += dj * dj, xz += di * v, yz += dj * v;
        }
    x /= n, y /= n, z /= n;
    xx -= n * x * x, xy -= n * x * y, yy -= n * y * y, xz -= n * x * z, yz -= n * y * z;
    double det = xx * yy - xy * xy;
    if (det < 1e-6) /* of small integers: 0 but for rounding */
        return z;
    return z - x * (xz * yy - yz * xy) / det - y * (yz * xx - xz * xy) / det;
}

static void fill_fringe(const struct hm_bsurf *s)
{
    const struct hm_bsurf_fringe *f = s->fringe;
    for (size_t k = 0; k < f->n; k++) {
        int64_t i = (int64_t)(f->item[k] % (s->n + 2)) - 1;
        int64_t j = (int64_t)(f->item[k] / (s->n + 2)) - 1;
        double *d = hm_bsurf_at(s, i, j);
        for (size_t c = 0; c < s->dim; c++)
            if (!by_lines(s, i, j, 0, c, &d[c]) && !by_lines(s, i, j, 4, c, &d[c]))
                d[c] = by_plane(s, i, j, c);
    }
}

/* --- the ring --- */

/* ring = 2 * edge - inner */
static void extrapolate(double *ring, const double *edge, const double *inner, size_t count)
{
    for (size_t k = 0; k < count; k++)
        ring[k] = 2 * edge[k] - inner[k];
}

void hm_bsurf_extend(struct hm_bsurf *s)
{
    int64_t n = (int64_t)s->n, m = (int64_t)s->m;
    for (int64_t j = 0; j < m; j++) {
        extrapolate(hm_bsurf_at(s, -1, j), hm_bsurf_at(s, 0, j), hm_bsurf_at(s, 1, j), s->dim);
        extrapolate(hm_bsurf_at(s, n, j), hm_bsurf_at(s, n - 1, j), hm_bsurf_at(s, n - 2, j),
                    s->dim);
    }
    size_t row = (s->n + 2) * s->dim;
    extrapolate(hm_bsurf_at(s, -1, -1), hm_bsurf_at(s, -1, 0), hm_bsurf_at(s, -1, 1), row);
    extrapolate(hm_bsurf_at(s, -1, m), hm_bsurf_at(s, -1, m - 1), hm_bsurf_at(s, -1, m - 2), row);
    if (s->fringe)
        fill_fringe(s);
}
