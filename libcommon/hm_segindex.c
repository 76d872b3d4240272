#include "hm_segindex.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

enum {
    BOX_MOST = 4096 /* entries that a box query sorts; beyond, it looks through all segments */
};

struct hm_segindex {
    struct hm_segment *s; /* by (line, piece) */
    size_t n;
    double x0, y0, cell; /* lower left corner; size of the square buckets */
    int64_t nx, ny;
    size_t *start; /* bucket k = j*nx + i holds item[start[k]] .. item[start[k+1] - 1] */
    int32_t *item; /* numbers of segments, ascending in each bucket */
};

/* --- building --- */

static int by_number(const void *a, const void *b)
{
    const struct hm_segment *p = a, *q = b;
    if (p->line != q->line)
        return p->line < q->line ? -1 : 1;
    if (p->piece != q->piece)
        return p->piece < q->piece ? -1 : 1;
    for (int k = 0; k < 2; k++) { /* the same number twice: any order that is always the same */
        if (p->a[k] != q->a[k])
            return p->a[k] < q->a[k] ? -1 : 1;
        if (p->b[k] != q->b[k])
            return p->b[k] < q->b[k] ? -1 : 1;
    }
    return 0;
}

static int64_t bucket_of(double offset, double cell, int64_t n)
{
    double k = floor(offset / cell);
    return !(k > 0) ? 0 : k >= (double)(n - 1) ? n - 1 : (int64_t)k;
}

/* Buckets of about one segment each: a cell has the area of the extent over n, but at least the
 * extent over n (all on a line) and half a mean segment, so that long segments do not fill it. */
static void size_grid(struct hm_segindex *x)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, total = 0;
    for (size_t i = 0; i < x->n; i++)
        for (int k = 0; k < 2; k++) {
            double p = x->s[i].a[k], q = x->s[i].b[k];
            lo[k] = fmin(lo[k], fmin(p, q));
            hi[k] = fmax(hi[k], fmax(p, q));
            total += fabs(q - p);
        }
    double w = hi[0] - lo[0], h = hi[1] - lo[1], n = (double)x->n;
    x->x0 = lo[0];
    x->y0 = lo[1];
    x->cell = fmax(sqrt(w / n) * sqrt(h), fmax(fmax(w, h) / n, total / n / 2));
    if (!(x->cell > 0))
        x->cell = 1;
    x->nx = (int64_t)(w / x->cell) + 1;
    x->ny = (int64_t)(h / x->cell) + 1;
}

/* Call put for every bucket that segment i runs through: row by row, the columns between where it
 * enters and leaves the row, a hair wider than rounding could make it wrong. */
static void rasterize(struct hm_segindex *x, int32_t i,
                      void (*put)(struct hm_segindex *x, size_t bucket, int32_t i))
{
    const struct hm_segment *s = &x->s[i];
    const double *a = s->a[1] <= s->b[1] ? s->a : s->b, *b = a == s->a ? s->b : s->a;
    int64_t j0 = bucket_of(a[1] - x->y0, x->cell, x->ny);
    int64_t j1 = bucket_of(b[1] - x->y0, x->cell, x->ny);
    for (int64_t j = j0; j <= j1; j++) {
        double bottom = x->y0 + ((double)j - 1e-6) * x->cell;
        double top = x->y0 + ((double)j + 1 + 1e-6) * x->cell;
        double rise = b[1] - a[1];
        double t0 = rise > 0 ? fmax(0, (bottom - a[1]) / rise) : 0;
        double t1 = rise > 0 ? fmin(1, (top - a[1]) / rise) : 1;
        double p = a[0] + t0 * (b[0] - a[0]) - x->x0, q = a[0] + t1 * (b[0] - a[0]) - x->x0;
        double slack = 1e-6 * x->cell;
        int64_t i1 = bucket_of(fmax(p, q) + slack, x->cell, x->nx);
        for (int64_t k = bucket_of(fmin(p, q) - slack, x->cell, x->nx); k <= i1; k++)
            put(x, (size_t)(j * x->nx + k), i);
    }
}

static void count_one(struct hm_segindex *x, size_t bucket, int32_t i)
{
    (void)i;
    x->start[bucket + 1]++;
}

static void place_one(struct hm_segindex *x, size_t bucket, int32_t i)
{
    x->item[x->start[bucket]++] = i;
}

static enum hm_err fill_grid(struct hm_segindex *x, struct hm_diag *d)
{
    size_t buckets = (size_t)(x->nx * x->ny);
    x->start = hm_alloc0(buckets + 1, sizeof *x->start);
    if (!x->start)
        return hm_fail_memory(d);
    for (size_t i = 0; i < x->n; i++)
        rasterize(x, (int32_t)i, count_one);
    for (size_t k = 0; k < buckets; k++)
        x->start[k + 1] += x->start[k];
    x->item = hm_alloc(x->start[buckets], sizeof *x->item);
    if (!x->item)
        return hm_fail_memory(d);
    for (size_t i = 0; i < x->n; i++)
        rasterize(x, (int32_t)i, place_one);
    for (size_t k = buckets; k > 0; k--) /* place_one moved each start to its end: move back */
        x->start[k] = x->start[k - 1];
    x->start[0] = 0;
    return HM_OK;
}

enum hm_err hm_segindex_build(struct hm_segindex **out, const struct hm_segment *s, size_t n,
                              struct hm_diag *d)
{
    *out = NULL;
    if (n > INT32_MAX)
        return hm_fail(d, HM_ENOMEM, "more than %d segments", INT32_MAX);
    struct hm_segindex *x = hm_alloc0(1, sizeof *x);
    if (!x)
        return hm_fail_memory(d);
    x->n = n;
    x->s = hm_alloc(n, sizeof *s);
    enum hm_err err = x->s ? HM_OK : hm_fail_memory(d);
    bool sorted = true;
    for (size_t i = 0; !err && i < n; i++) {
        x->s[i] = s[i];
        sorted = sorted && (i == 0 || by_number(&s[i - 1], &s[i]) <= 0);
    }
    if (!err && !sorted)
        qsort(x->s, n, sizeof *s, by_number);
    if (!err && n > 0) {
        size_grid(x);
        err = fill_grid(x, d);
    }
    if (err)
        hm_segindex_free(x);
    else
        *out = x;
    return err;
}

void hm_segindex_free(struct hm_segindex *x)
{
    if (!x)
        return;
    free(x->s);
    free(x->start);
    free(x->item);
    free(x);
}

/* --- the nearest --- */

struct nearest {
    double x, y;
    double best2; /* squared distance */
    int32_t item; /* -1: none yet */
    double t;
};

static void foot_at(const struct hm_segment *s, double t, double foot[3])
{
    for (int k = 0; k < 3; k++)
        foot[k] = t <= 0 ? s->a[k] : t >= 1 ? s->b[k] : s->a[k] + t * (s->b[k] - s->a[k]);
}

static void try_bucket(const struct hm_segindex *x, int64_t i, int64_t j, struct nearest *q)
{
    size_t bucket = (size_t)(j * x->nx + i);
    for (size_t k = x->start[bucket]; k < x->start[bucket + 1]; k++) {
        const struct hm_segment *s = &x->s[x->item[k]];
        double t = hm_plane_foot((const double[]){q->x, q->y}, s->a, s->b), foot[3];
        foot_at(s, t, foot);
        double dx = foot[0] - q->x, dy = foot[1] - q->y, d2 = dx * dx + dy * dy;
        if (d2 < q->best2 || (d2 == q->best2 && (q->item < 0 || x->item[k] < q->item))) {
            q->best2 = d2;
            q->item = x->item[k];
            q->t = t;
        }
    }
}

/* The buckets at Chebyshev distance `ring` from bucket ci, cj, which may lie outside the grid. */
static void try_ring(const struct hm_segindex *x, int64_t ci, int64_t cj, int64_t ring,
                     struct nearest *q)
{
    int64_t i0 = ci - ring > 0 ? ci - ring : 0, i1 = ci + ring < x->nx ? ci + ring : x->nx - 1;
    int64_t j0 = cj - ring > 0 ? cj - ring : 0, j1 = cj + ring < x->ny ? cj + ring : x->ny - 1;
    for (int64_t j = j0; j <= j1; j++) {
        if (j == cj - ring || j == cj + ring) {
            for (int64_t i = i0; i <= i1; i++)
                try_bucket(x, i, j, q);
        } else {
            if (ci - ring >= 0 && ci - ring < x->nx)
                try_bucket(x, ci - ring, j, q);
            if (ci + ring >= 0 && ci + ring < x->nx)
                try_bucket(x, ci + ring, j, q);
        }
    }
}

/* Bucket coordinate of a point that may be far outside: kept so far within int64 that rings can be
 * counted from it. */
static int64_t free_bucket(double offset, double cell)
{
    double k = floor(offset / cell);
    return (int64_t)fmax(-1e15, fmin(1e15, k));
}

static int64_t beyond(int64_t k, int64_t n)
{
    return k < 0 ? -k : k >= n ? k - (n - 1) : 0;
}

const struct hm_segment *hm_segindex_nearest(const struct hm_segindex *x, double px, double py,
                                             double reach, double foot[3], double *distance)
{
    if (x->n == 0 || !(reach >= 0) || !isfinite(px) || !isfinite(py))
        return NULL;
    struct nearest q = {px, py, reach * reach, -1, 0};
    int64_t ci = free_bucket(px - x->x0, x->cell), cj = free_bucket(py - x->y0, x->cell);
    int64_t oi = beyond(ci, x->nx), oj = beyond(cj, x->ny);
    int64_t first = oi > oj ? oi : oj, last = first + (x->nx > x->ny ? x->nx : x->ny);
    for (int64_t ring = first; ring <= last; ring++) {
        double least = (double)(ring - 1) * x->cell * (1 - 1e-9); /* to anything in this ring */
        if (least > 0 && least * least > q.best2)
            break;
        try_ring(x, ci, cj, ring, &q);
    }
    if (q.item < 0)
        return NULL;
    const struct hm_segment *s = &x->s[q.item];
    foot_at(s, q.t, foot);
    *distance = sqrt(q.best2);
    return s;
}

/* --- boxes --- */

/* A segment meets a box when their extents do and the corners are not all on one side of it. */
static bool meets_box(const struct hm_segment *s, const double lo[2], const double hi[2])
{
    for (int k = 0; k < 2; k++)
        if (fmax(s->a[k], s->b[k]) < lo[k] || fmin(s->a[k], s->b[k]) > hi[k])
            return false;
    if (s->a[0] == s->b[0] && s->a[1] == s->b[1])
        return true;
    int sides = 0;
    for (int k = 0; k < 4; k++) {
        double corner[2] = {k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1]};
        int side = hm_pred_orient(s->a, s->b, corner);
        sides |= side > 0 ? 1 : side < 0 ? 2 : 3;
    }
    return sides == 3;
}

static int by_item(const void *a, const void *b)
{
    int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;
    return p < q ? -1 : p > q;
}

void hm_segindex_box(const struct hm_segindex *x, const double lo[2], const double hi[2],
                     bool (*visit)(void *arg, const struct hm_segment *s), void *arg)
{
    if (x->n == 0)
        return;
    int64_t i0 = bucket_of(lo[0] - x->x0, x->cell, x->nx);
    int64_t i1 = bucket_of(hi[0] - x->x0, x->cell, x->nx);
    int64_t j0 = bucket_of(lo[1] - x->y0, x->cell, x->ny);
    int64_t j1 = bucket_of(hi[1] - x->y0, x->cell, x->ny);
    int32_t item[BOX_MOST];
    size_t n = 0;
    for (int64_t j = j0; j <= j1; j++) {
        size_t from = x->start[j * x->nx + i0], to = x->start[j * x->nx + i1 + 1];
        for (size_t k = from; k < to && n <= BOX_MOST; k++) {
            if (n < BOX_MOST)
                item[n] = x->item[k];
            n++;
        }
    }
    if (n > BOX_MOST) { /* many: in their own order, without sorting */
        for (size_t k = 0; k < x->n; k++)
            if (meets_box(&x->s[k], lo, hi) && !visit(arg, &x->s[k]))
                return;
        return;
    }
    if (n > 1)
        qsort(item, n, sizeof *item, by_item);
    for (size_t k = 0; k < n; k++)
        if ((k == 0 || item[k] != item[k - 1]) && meets_box(&x->s[item[k]], lo, hi) &&
            !visit(arg, &x->s[item[k]]))
            return;
}
