#include "hm_bspline.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double hm_bspline_basis(const double *knots, size_t i, int degree, double u)
{
    if (degree == 0)
        return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
    size_t r = (size_t)degree;
    double rise = knots[i + r] - knots[i];
    double fall = knots[i + r + 1] - knots[i + 1];
    double value = 0;
    if (rise > 0)
        value += (u - knots[i]) / rise * hm_bspline_basis(knots, i, degree - 1, u);
    if (fall > 0)
        value += (knots[i + r + 1] - u) / fall * hm_bspline_basis(knots, i + 1, degree - 1, u);
    return value;
}

static void linear_weights(double t, double w[4], double dw[4])
{
    w[0] = 1 - t;
    w[1] = t;
    dw[0] = -1;
    dw[1] = 1;
}

/* t from the middle of the knot interval, -½ .. ½ */
static void quadratic_weights(double t, double w[4], double dw[4])
{
    w[0] = (0.5 - t) * (0.5 - t) / 2;
    w[1] = 0.75 - t * t;
    w[2] = (0.5 + t) * (0.5 + t) / 2;
    dw[0] = t - 0.5;
    dw[1] = -2 * t;
    dw[2] = t + 0.5;
}

static void cubic_weights(double t, double w[4], double dw[4])
{
    double s = 1 - t;
    w[0] = s * s * s / 6;
    w[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    w[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    w[3] = t * t * t / 6;
    dw[0] = -s * s / 2;
    dw[1] = t * (1.5 * t - 2);
    dw[2] = -s * (1.5 * s - 2);
    dw[3] = t * t / 2;
}

void hm_bspline_weights(int degree, double u, int64_t *first, double w[4], double dw[4])
{
    double unused[4];
    double start = degree == 2 ? floor(u + 0.5) : floor(u);
    double t = u - start;
    double *slope = dw ? dw : unused;
    if (degree == 1)
        linear_weights(t, w, slope);
    else if (degree == 2)
        quadratic_weights(t, w, slope);
    else
        cubic_weights(t, w, slope);
    *first = (int64_t)start - (degree > 1);
}

/* Weights at u; leaves out the last when it is the point behind the ring, where it is 0. */
static int acting(int degree, double u, size_t n, int64_t *first, double w[4], double dw[4])
{
    hm_bspline_weights(degree, u, first, w, dw);
    return *first + degree > (int64_t)n ? degree : degree + 1;
}

void hm_bspline_eval(const struct hm_bsurf *s, double u, double v, double *point, double *du,
                     double *dv)
{
    int64_t i0, j0;
    double wu[4], wv[4], gu[4], gv[4];
    int nu = acting(s->degree, u, s->n, &i0, wu, gu);
    int nv = acting(s->degree, v, s->m, &j0, wv, gv);
    for (size_t c = 0; c < s->dim; c++) {
        double sum = 0, sum_u = 0, sum_v = 0;
        for (int j = 0; j < nv; j++) {
            const double *d = hm_bsurf_at(s, i0, j0 + j) + c;
            double row = 0, row_u = 0;
            for (int i = 0; i < nu; i++) {
                row += wu[i] * d[(size_t)i * s->dim];
                row_u += gu[i] * d[(size_t)i * s->dim];
            }
            sum += wv[j] * row;
            sum_u += wv[j] * row_u;
            sum_v += gv[j] * row;
        }
        point[c] = sum;
        if (du)
            du[c] = sum_u;
        if (dv)
            dv[c] = sum_v;
    }
}

/* Basis values at a Greville site: side, middle, side. */
static double side_weight(int degree)
{
    return degree == 1 ? 0 : degree == 2 ? 1.0 / 8 : 1.0 / 6;
}

/* --- dragging --------------------------------------------------------------------------------
 *
 * At the Greville sites the basis has the values side, middle, side in either direction (quadratic:
 * 1/8, 6/8, 1/8), so B·D·Bᵀ is a filter along the rows and then one across them. The net is changed
 * in place: a row may go as soon as the filtered rows around it are kept. The rows are cut into
 * bands for the threads; the filtered rows on either side of every band are made before any band
 * changes, so the result is that of one thread.
 */
enum { BAND = 64 };

struct drag {
    struct hm_bsurf *s;
    const double *z;
    double side, middle;
    size_t width;   /* numbers in a row without ring */
    double *border; /* a band: the filtered rows before and behind it */
    double *work;   /* a band: three filtered rows */
    double *rest;   /* a band: the largest residual */
    bool move;      /* false: measure only */
};

static size_t band_end(const struct drag *g, size_t band)
{
    return (band + 1) * BAND < g->s->m ? (band + 1) * BAND : g->s->m;
}

static void filter_row(const struct drag *g, int64_t j, double *out)
{
    const double *d = hm_bsurf_at(g->s, 0, j);
    size_t dim = g->s->dim;
    for (size_t k = 0; k < g->width; k++)
        out[k] = g->side * (*(d + k - dim) + d[k + dim]) + g->middle * d[k];
}

static void filter_border(void *arg, size_t band)
{
    const struct drag *g = arg;
    double *border = g->border + 2 * band * g->width;
    filter_row(g, (int64_t)(band * BAND) - 1, border);
    filter_row(g, (int64_t)band_end(g, band), border + g->width);
}

/* Residuals of row j; `before`, `here`, `behind` are the filtered rows j-1, j, j+1. */
static double drag_row(const struct drag *g, size_t j, const double *before, const double *here,
                       const double *behind)
{
    double *d = hm_bsurf_at(g->s, 0, (int64_t)j);
    const double *z = g->z + j * g->width;
    double rest = 0;
    for (size_t k = 0; k < g->width; k++) {
        double r = z[k] - (g->side * (before[k] + behind[k]) + g->middle * here[k]);
        r = isnan(r) ? 0 : r;
        rest = fabs(r) > rest ? fabs(r) : rest;
        if (g->move)
            d[k] += r;
    }
    return rest;
}

static void drag_band(void *arg, size_t band)
{
    const struct drag *g = arg;
    const double *border = g->border + 2 * band * g->width;
    double *row[3];
    for (size_t k = 0; k < 3; k++)
        row[k] = g->work + (3 * band + k) * g->width;
    size_t start = band * BAND, end = band_end(g, band);
    double rest = 0;
    memcpy(row[0], border, g->width * sizeof *border);
    filter_row(g, (int64_t)start, row[1]);
    for (size_t j = start; j < end; j++) {
        if (j + 1 < end)
            filter_row(g, (int64_t)j + 1, row[2]);
        else
            memcpy(row[2], border + g->width, g->width * sizeof *border);
        double r = drag_row(g, j, row[0], row[1], row[2]);
        rest = r > rest ? r : rest;
        double *oldest = row[0];
        row[0] = row[1];
        row[1] = row[2];
        row[2] = oldest;
    }
    g->rest[band] = rest;
}

static double drag_once(struct drag *g, int threads)
{
    size_t bands = (g->s->m + BAND - 1) / BAND;
    hm_bsurf_extend(g->s);
    hm_thread_for(threads, bands, filter_border, g);
    hm_thread_for(threads, bands, drag_band, g);
    double rest = 0;
    for (size_t b = 0; b < bands; b++)
        rest = g->rest[b] > rest ? g->rest[b] : rest;
    return rest;
}

enum hm_err hm_bspline_drag(struct hm_bsurf *s, const double *z, int iterations, double tolerance,
                            int threads, double *rest, struct hm_diag *d)
{
    struct drag g = {.s = s, .z = z, .side = side_weight(s->degree), .width = s->n * s->dim};
    g.middle = 1 - 2 * g.side;
    size_t bands = (s->m + BAND - 1) / BAND;
    g.border = hm_alloc(2 * bands, g.width * sizeof *g.border);
    g.work = hm_alloc(3 * bands, g.width * sizeof *g.work);
    g.rest = hm_alloc(bands, sizeof *g.rest);
    enum hm_err err = g.border && g.work && g.rest ? HM_OK : hm_fail_memory(d);
    if (!err) {
        g.move = true;
        double moved = INFINITY;
        for (int k = 0; k < iterations && moved > tolerance; k++)
            moved = drag_once(&g, threads);
        g.move = false;
        if (rest)
            *rest = drag_once(&g, threads);
        else
            hm_bsurf_extend(s);
    }
    free(g.border);
    free(g.work);
    free(g.rest);
    return err;
}
