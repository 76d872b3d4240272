#include "hm_bsample.h"

#include <stdlib.h>

enum {
    WIDTH = 4,  /* control points that may act, from the one before the place on */
    BEYOND = 3, /* numbers kept behind the last control point, for weights that are 0 */
};

/* The weights at a place `part` of the way from control point i to the next: of i - 1 .. i + 2. */
struct phase {
    double w[WIDTH], dw[WIDTH];
};

struct hm_bsample {
    const struct hm_bsurf *s;
    size_t over;
    struct phase *phase; /* over of them */
    double *line;        /* the surface along u as a curve: control points -1 .. n + 1 */
    double *line_v;      /* its derivative with respect to v */
};

static struct phase make_phase(int degree, double part)
{
    struct phase p = {{0}, {0}};
    double w[WIDTH], dw[WIDTH];
    int64_t first;
    hm_bspline_weights(degree, part, &first, w, dw);
    for (int k = 0; k <= degree; k++) {
        int at = (int)first + 1 + k;
        if (at < WIDTH) { /* else the weight is 0 */
            p.w[at] = w[k];
            p.dw[at] = dw[k];
        }
    }
    if (degree == 1 && part == 0) {
        p.dw[0] = -0.5;
        p.dw[1] = 0;
        p.dw[2] = 0.5;
    }
    return p;
}

enum hm_err hm_bsample_new(struct hm_bsample **b, const struct hm_bsurf *s, int over,
                           struct hm_diag *d)
{
    *b = hm_alloc0(1, sizeof **b);
    if (!*b)
        return hm_fail_memory(d);
    (*b)->s = s;
    (*b)->over = (size_t)over;
    (*b)->phase = hm_alloc((size_t)over, sizeof *(*b)->phase);
    (*b)->line = hm_alloc0(s->n + 1 + BEYOND, sizeof *(*b)->line);
    (*b)->line_v = hm_alloc0(s->n + 1 + BEYOND, sizeof *(*b)->line_v);
    if (!(*b)->phase || !(*b)->line || !(*b)->line_v) {
        hm_bsample_free(*b);
        *b = NULL;
        return hm_fail_memory(d);
    }
    for (int k = 0; k < over; k++)
        (*b)->phase[k] = make_phase(s->degree, (double)k / over);
    return HM_OK;
}

void hm_bsample_free(struct hm_bsample *b)
{
    if (!b)
        return;
    free(b->phase);
    free(b->line);
    free(b->line_v);
    free(b);
}

/* line = Σ w[k] × row j - 1 + k of the net, ring included */
static void combine(const struct hm_bsurf *s, int64_t j, const double w[WIDTH], double *line)
{
    size_t width = s->n + 2;
    for (size_t i = 0; i < width; i++)
        line[i] = 0;
    for (int k = 0; k < WIDTH; k++) {
        if (w[k] == 0)
            continue;
        const double *d = hm_bsurf_at(s, -1, j - 1 + k);
        for (size_t i = 0; i < width; i++)
            line[i] += w[k] * d[i];
    }
}

/* out[i * over] = Σ w[k] line[i + k] for `count` control points i; line begins at number -1. */
static void weigh(const double *line, const double w[WIDTH], size_t count, size_t over, double *out)
{
    for (size_t i = 0; i < count; i++)
        out[i * over] =
            w[0] * line[i] + w[1] * line[i + 1] + w[2] * line[i + 2] + w[3] * line[i + 3];
}

void hm_bsample_row(struct hm_bsample *b, size_t row, double *z, double *zu, double *zv)
{
    const struct phase *across = &b->phase[row % b->over];
    int64_t j = (int64_t)(row / b->over);
    combine(b->s, j, across->w, b->line);
    if (zv)
        combine(b->s, j, across->dw, b->line_v);
    for (size_t k = 0; k < b->over; k++) {
        const struct phase *along = &b->phase[k];
        size_t count = k == 0 ? b->s->n : b->s->n - 1;
        weigh(b->line, along->w, count, b->over, z + k);
        if (zu)
            weigh(b->line, along->dw, count, b->over, zu + k);
        if (zv)
            weigh(b->line_v, along->w, count, b->over, zv + k);
    }
}
