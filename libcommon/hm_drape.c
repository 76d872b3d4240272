#include "hm_drape.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

/* The control points that act at a sample, the ring folded into the net that it is made from. */
struct acting {
    size_t first;
    int count;
    double w[4];
};

struct drape {
    struct hm_bsurf *s;
    const double *z;
    struct acting *u, *v; /* na columns, nb rows of samples */
    size_t na, nb;
    double *across; /* nb × n: control points combined across, at the rows of samples */
    double *sum;    /* nb × n: residuals of a row of samples under the basis functions along it */
    double *weight; /* nb × n: and what they weigh */
};

static double *height(const struct drape *g, size_t i, size_t j)
{
    return hm_bsurf_at(g->s, (int64_t)i, (int64_t)j) + g->s->dim - 1;
}

/* Weights at parameter t of an axis with n control points. A point of the ring is twice the
 * outermost point less the one beside it. */
static struct acting act(int degree, double t, size_t n)
{
    double w[4], net[6] = {0}; /* control points first .. first + 5 */
    int64_t at, last = (int64_t)n - 1;
    hm_bspline_weights(degree, t, &at, w, NULL);
    int64_t first = at < 0 ? 0 : at + 3 > last ? (last > 3 ? last - 3 : 0) : at;
    for (int k = 0; k <= degree; k++) {
        int64_t i = at + k;
        if (i < 0) {
            net[0] += 2 * w[k];
            net[1] -= w[k];
        } else if (i > last && w[k] != 0) {
            net[last - first] += 2 * w[k];
            net[last - 1 - first] -= w[k];
        } else if (i <= last) {
            net[i - first] += w[k];
        }
    }
    struct acting a = {(size_t)first, last - first < 3 ? (int)(last - first) + 1 : 4, {0}};
    for (int k = 0; k < a.count; k++)
        a.w[k] = net[k];
    return a;
}

static struct acting *act_along(int degree, size_t samples, size_t n)
{
    struct acting *a = hm_alloc(samples, sizeof *a);
    for (size_t k = 0; a && k < samples; k++)
        a[k] = act(degree, (double)k * (double)(n - 1) / (double)(samples - 1), n);
    return a;
}

/* A row of samples against the surface: across[] holds the control points combined across. */
static void sum_residuals(const struct drape *g, size_t b, const double *across, double *sum,
                          double *weight)
{
    const double *z = g->z + b * g->na;
    for (size_t i = 0; i < g->s->n; i++)
        sum[i] = weight[i] = 0;
    for (size_t a = 0; a < g->na; a++) {
        const struct acting *u = &g->u[a];
        if (isnan(z[a]))
            continue;
        double rest = z[a];
        for (int k = 0; k < u->count; k++)
            rest -= u->w[k] * across[u->first + (size_t)k];
        for (int k = 0; k < u->count; k++) {
            sum[u->first + (size_t)k] += u->w[k] * rest;
            weight[u->first + (size_t)k] += u->w[k];
        }
    }
}

static void measure_row(void *arg, size_t b)
{
    const struct drape *g = arg;
    const struct acting *v = &g->v[b];
    size_t n = g->s->n;
    double *across = g->across + b * n;
    for (size_t i = 0; i < n; i++) {
        across[i] = 0;
        for (int k = 0; k < v->count; k++)
            across[i] += v->w[k] * *height(g, i, v->first + (size_t)k);
    }
    sum_residuals(g, b, across, g->sum + b * n, g->weight + b * n);
}

/* Row j of control points, from all rows of samples that it acts on. */
static void move_row(void *arg, size_t j)
{
    const struct drape *g = arg;
    size_t n = g->s->n;
    for (size_t i = 0; i < n; i++) {
        double sum = 0, weight = 0;
        for (size_t b = 0; b < g->nb; b++) {
            const struct acting *v = &g->v[b];
            if (j < v->first || j >= v->first + (size_t)v->count)
                continue;
            sum += v->w[j - v->first] * g->sum[b * n + i];
            weight += v->w[j - v->first] * g->weight[b * n + i];
        }
        if (weight > 0)
            *height(g, i, j) += sum / weight;
    }
}

enum hm_err hm_drape(struct hm_bsurf *s, const double *z, size_t na, size_t nb, int iterations,
                     int threads, struct hm_diag *d)
{
    struct drape g = {.s = s, .z = z, .na = na, .nb = nb};
    g.u = act_along(s->degree, na, s->n);
    g.v = act_along(s->degree, nb, s->m);
    g.across = hm_alloc(nb * s->n, sizeof *g.across);
    g.sum = hm_alloc(nb * s->n, sizeof *g.sum);
    g.weight = hm_alloc(nb * s->n, sizeof *g.weight);
    enum hm_err err = g.u && g.v && g.across && g.sum && g.weight ? HM_OK : hm_fail_memory(d);
    if (!err) {
        for (int round = 0; round < iterations; round++) {
            hm_thread_for(threads, nb, measure_row, &g);
            hm_thread_for(threads, s->m, move_row, &g);
        }
        hm_bsurf_extend(s);
    }
    free(g.u);
    free(g.v);
    free(g.across);
    free(g.sum);
    free(g.weight);
    return err;
}
