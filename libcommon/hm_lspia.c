#include "hm_lspia.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BAND = 32 };

struct sample {
    double u, v, z;
    double rest; /* z - surface; NaN: does not count */
};

struct lspia {
    struct hm_bsurf *s;
    struct sample *sample; /* by the row of control points below them, then by u, v, z */
    size_t *start;         /* a row: its first sample; m + 1 */
    double *sum;           /* a band: sum of squares, and the number of samples */
    double *moved;         /* a band: the longest way of a control point */
    bool *failed;          /* a band */
};

static size_t band_end(const struct lspia *l, size_t band)
{
    return (band + 1) * BAND < l->s->m ? (band + 1) * BAND : l->s->m;
}

/* Spacings from the first node to x, in steps too fine to matter. Whole numbers are taken off those
 * exactly, so windows of a lattice place a sample alike, also when x = 0 lies in one of them. */
static double spacings_to(double x, double spacing, int64_t first)
{
    const double steps = 4294967296; /* a spacing */
    return rint(x / spacing * steps) / steps - (double)first;
}

static struct sample sample_at(const struct hm_anchor *a, const double *xyz)
{
    return (struct sample){spacings_to(xyz[0], a->spacing, a->i0),
                           spacings_to(xyz[1], a->spacing, a->j0), xyz[2], 0};
}

/* Row under a sample, or m when it is outside of the net. */
static size_t row_of(const struct hm_bsurf *s, const struct sample *p)
{
    if (!(p->u >= 0 && p->u <= (double)(s->n - 1) && p->v >= 0 && p->v <= (double)(s->m - 1)))
        return s->m;
    return (size_t)p->v;
}

static int by_place(const void *pa, const void *pb)
{
    const struct sample *a = pa, *b = pb;
    if (a->u != b->u)
        return a->u < b->u ? -1 : 1;
    if (a->v != b->v)
        return a->v < b->v ? -1 : 1;
    return (a->z > b->z) - (a->z < b->z);
}

/* In an order that does not depend on that of the measurements: nor will rounding in the sums. */
static enum hm_err sort_samples(struct lspia *l, const struct hm_anchor *a, const double *xyz,
                                size_t n, struct hm_diag *d)
{
    size_t m = l->s->m;
    l->sample = hm_alloc(n, sizeof *l->sample);
    l->start = hm_alloc0(m + 2, sizeof *l->start);
    if (!l->sample || !l->start)
        return hm_fail_memory(d);
    for (size_t k = 0; k < n; k++) {
        struct sample p = sample_at(a, xyz + 3 * k);
        l->start[row_of(l->s, &p) + 1]++;
    }
    for (size_t j = 0; j < m; j++)
        l->start[j + 1] += l->start[j];
    size_t *next = hm_alloc(m + 1, sizeof *next);
    if (!next)
        return hm_fail_memory(d);
    memcpy(next, l->start, (m + 1) * sizeof *next);
    for (size_t k = 0; k < n; k++) {
        struct sample p = sample_at(a, xyz + 3 * k);
        size_t row = row_of(l->s, &p);
        if (row < m)
            l->sample[next[row]++] = p;
    }
    free(next);
    for (size_t j = 0; j < m; j++)
        if (l->start[j + 1] > l->start[j])
            qsort(l->sample + l->start[j], l->start[j + 1] - l->start[j], sizeof *l->sample,
                  by_place);
    return HM_OK;
}

/* Are all control points that act at (u, v) known? */
static bool is_covered(const struct hm_bsurf *s, const struct sample *p)
{
    double w[4];
    int64_t i0, j0;
    hm_bspline_weights(s->degree, p->u, &i0, w, NULL);
    hm_bspline_weights(s->degree, p->v, &j0, w, NULL);
    for (int64_t j = j0; j <= j0 + s->degree && j <= (int64_t)s->m; j++)
        for (int64_t i = i0; i <= i0 + s->degree && i <= (int64_t)s->n; i++)
            if (!hm_bsurf_knows(s, i, j))
                return false;
    return true;
}

static double residual(const struct hm_bsurf *s, const struct sample *p)
{
    double z;
    if (!is_covered(s, p))
        return NAN;
    hm_bspline_eval(s, p->u, p->v, &z, NULL, NULL);
    return p->z - z;
}

static void find_residuals(void *arg, size_t band)
{
    const struct lspia *l = arg;
    double squares = 0, count = 0;
    for (size_t k = l->start[band * BAND]; k < l->start[band_end(l, band)]; k++) {
        struct sample *p = &l->sample[k];
        p->rest = residual(l->s, p);
        if (isnan(p->rest))
            continue;
        squares += p->rest * p->rest;
        count++;
    }
    l->sum[2 * band] = squares;
    l->sum[2 * band + 1] = count;
}

/* Spread the residual of p over the control points of rows start .. end-1; sums holds the weighted
 * residuals and the weights of each. */
static void spread(const struct hm_bsurf *s, const struct sample *p, int64_t start, int64_t end,
                   double *sums)
{
    double wu[4], wv[4];
    int64_t i0, j0;
    hm_bspline_weights(s->degree, p->u, &i0, wu, NULL);
    hm_bspline_weights(s->degree, p->v, &j0, wv, NULL);
    for (int b = 0; b <= s->degree; b++) {
        int64_t j = j0 + b;
        if (j < start || j >= end)
            continue;
        for (int a = 0; a <= s->degree; a++) {
            int64_t i = i0 + a;
            if (i < 0 || i >= (int64_t)s->n)
                continue;
            double w = wu[a] * wv[b], *sum = sums + 2 * ((size_t)(j - start) * s->n + (size_t)i);
            sum[0] += w * p->rest;
            sum[1] += w;
        }
    }
}

static void move_band(void *arg, size_t band)
{
    const struct lspia *l = arg;
    const struct hm_bsurf *s = l->s;
    size_t start = band * BAND, end = band_end(l, band);
    double *sums = hm_alloc0(2 * (end - start) * s->n, sizeof *sums);
    if (!sums) {
        l->failed[band] = true;
        return;
    }
    /* basis functions reach two rows, so samples of the rows around act here, too */
    size_t first = start > 2 ? start - 2 : 0, last = end + 2 < s->m ? end + 2 : s->m;
    for (size_t k = l->start[first]; k < l->start[last]; k++)
        if (!isnan(l->sample[k].rest))
            spread(s, &l->sample[k], (int64_t)start, (int64_t)end, sums);
    l->moved[band] = 0;
    for (size_t j = start; j < end; j++)
        for (size_t i = 0; i < s->n; i++) {
            const double *sum = sums + 2 * ((j - start) * s->n + i);
            if (!(sum[1] > 0 && hm_bsurf_has_data(s, (int64_t)i, (int64_t)j)))
                continue;
            *hm_bsurf_at(s, (int64_t)i, (int64_t)j) += sum[0] / sum[1];
            l->moved[band] = fmax(l->moved[band], fabs(sum[0] / sum[1]));
        }
    free(sums);
}

static double find_rms(struct lspia *l, size_t bands, int threads)
{
    double squares = 0, count = 0;
    hm_bsurf_extend(l->s);
    hm_thread_for(threads, bands, find_residuals, l);
    for (size_t b = 0; b < bands; b++) {
        squares += l->sum[2 * b];
        count += l->sum[2 * b + 1];
    }
    return count > 0 ? sqrt(squares / count) : 0;
}

/* One iteration; *moved gets the longest way of a control point. */
static enum hm_err iterate(struct lspia *l, size_t bands, int threads, double *moved,
                           struct hm_diag *d)
{
    find_rms(l, bands, threads);
    hm_thread_for(threads, bands, move_band, l);
    *moved = 0;
    for (size_t b = 0; b < bands; b++) {
        if (l->failed[b])
            return hm_fail_memory(d);
        *moved = fmax(*moved, l->moved[b]);
    }
    return HM_OK;
}

enum hm_err hm_lspia(struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz, size_t n,
                     int iterations, double tolerance, int threads, double *rms, struct hm_diag *d)
{
    struct lspia l = {.s = s};
    size_t bands = (s->m + BAND - 1) / BAND;
    double moved = INFINITY;
    l.sum = hm_alloc(2 * bands, sizeof *l.sum);
    l.moved = hm_alloc(bands, sizeof *l.moved);
    l.failed = hm_alloc0(bands, sizeof *l.failed);
    enum hm_err err =
        l.sum && l.moved && l.failed ? sort_samples(&l, a, xyz, n, d) : hm_fail_memory(d);
    for (int k = 0; k < iterations && moved > tolerance && !err; k++)
        err = iterate(&l, bands, threads, &moved, d);
    if (!err) {
        double rest = find_rms(&l, bands, threads);
        if (rms)
            *rms = rest;
    }
    free(l.sample);
    free(l.start);
    free(l.sum);
    free(l.moved);
    free(l.failed);
    return err;
}

/* --- residuals alone --- */

enum { CHUNK = 1 << 14 };

struct judge {
    const struct hm_bsurf *s;
    const struct hm_anchor *anchor;
    const double *xyz;
    size_t n;
    double *rest;
};

static void judge_chunk(void *arg, size_t chunk)
{
    const struct judge *g = arg;
    size_t end = (chunk + 1) * CHUNK < g->n ? (chunk + 1) * CHUNK : g->n;
    for (size_t k = chunk * CHUNK; k < end; k++) {
        struct sample p = sample_at(g->anchor, g->xyz + 3 * k);
        g->rest[k] = row_of(g->s, &p) < g->s->m ? residual(g->s, &p) : NAN;
    }
}

void hm_lspia_residuals(const struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz,
                        size_t n, int threads, double *rest)
{
    struct judge g = {s, a, xyz, n, rest};
    hm_thread_for(threads, (n + CHUNK - 1) / CHUNK, judge_chunk, &g);
}
