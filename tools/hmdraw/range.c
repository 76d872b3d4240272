/* Ranges of colours: what lies in the window sets them, but for a few blunders. */
#include "draw.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* So many values of each layer are enough. */
enum { SAMPLES = 100000 };

static enum hm_err take(struct sampling *s, double value, struct hm_diag *d)
{
    if (!isfinite(value))
        return HM_OK;
    if (!hm_grow(&s->v, &s->cap, s->n + 1, sizeof *s->v))
        return hm_fail_memory(d);
    s->v[s->n++] = value;
    return HM_OK;
}

enum hm_err sample_points(struct sampling *s, const struct view *v, const struct hm_points *p,
                          struct hm_diag *d)
{
    size_t stride = view_points(v, p) / SAMPLES + 1, inside = 0;
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < p->n && !err; i++) {
        const double *row = &p->v[i * p->stride];
        if (view_holds(v, row[0], row[1]) && inside++ % stride == 0)
            err = take(s, row[2], d);
    }
    return err;
}

/* The nodes between two sides of the window along one axis, and those next to it: from[0] to
 * from[1], of n. */
static void nodes_within(double first, double step, int64_t n, double a, double b, int64_t from[2])
{
    double u = (a - first) / step, v = (b - first) / step, last = (double)(n - 1);
    from[0] = (int64_t)fmin(last, fmax(0, floor(fmin(u, v))));
    from[1] = (int64_t)fmin(last, fmax(0, ceil(fmax(u, v))));
}

enum hm_err sample_grid(struct sampling *s, const struct view *v, const struct hm_grid *g,
                        size_t band, struct hm_diag *d)
{
    const struct hm_lattice *l = &g->header.lattice;
    int64_t column[2], row[2];
    nodes_within(l->x0, l->dx, l->nx, v->w, v->e, column);
    nodes_within(l->y0, l->dy, l->ny, v->s, v->n, row);
    const int64_t wide = column[1] - column[0] + 1, nodes = wide * (row[1] - row[0] + 1);
    enum hm_err err = HM_OK;
    for (int64_t k = 0; k < nodes && !err; k += nodes / SAMPLES + 1) {
        int64_t node = (row[0] + k / wide) * l->nx + column[0] + k % wide;
        err = take(s, g->v[(size_t)node * g->bands + band], d);
    }
    return err;
}

enum hm_err sample_mesh(struct sampling *s, const struct view *v, const struct hm_mesh *m,
                        struct hm_diag *d)
{
    size_t stride = view_elements(v, m) / SAMPLES + 1, inside = 0;
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        if (!view_meets(v, m, e) || inside++ % stride)
            continue;
        for (int c = 0; c < hm_elem_corners(e) && !err; c++)
            err = take(s, m->node[e->node[c]].z, d);
    }
    return err;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The outermost 0.5 % of the values on either side are left out. What differs by rounding alone,
 * by less than 1e-9 of its size, counts as one value. */
struct range sampling_range(struct sampling *s)
{
    struct range range = {0, 0};
    if (s->n) {
        qsort(s->v, s->n, sizeof *s->v, by_value);
        size_t cut = s->n / 200;
        range = (struct range){s->v[cut], s->v[s->n - 1 - cut]};
        double size = fmax(fabs(range.lo), fabs(range.hi));
        if (range.hi / 2 - range.lo / 2 <= fmax(0.5e-9 * size, 1e-300))
            range.hi = range.lo;
    }
    free(s->v);
    *s = (struct sampling){0};
    return range;
}

/* Usual classes of slopes: of ground that carries water, of banks, and of what hardly stands. */
static const struct {
    const char *unit;
    double limit[SLOPE_LIMITS];
} slope_classes[] = {{"degree", {2, 5, 10, 15, 20, 30}},
                     {"percent", {3, 10, 20, 30, 40, 60}},
                     {"radian", {0.03, 0.1, 0.2, 0.3, 0.4, 0.6}}};

void scale_name(struct scale *scale, const struct hm_header *h, size_t column, const char *name)
{
    char unit[24];
    hm_header_unit(h, column, unit, sizeof unit);
    if (!strcmp(name, "z"))
        name = "height";
    scale->limits = NULL;
    for (size_t k = 0; k < sizeof slope_classes / sizeof *slope_classes; k++)
        if (!strcmp(name, "slope") && !strcmp(unit, slope_classes[k].unit))
            scale->limits = slope_classes[k].limit;
    bool bare = !*unit || !strcmp(unit, "1");
    snprintf(scale->title, sizeof scale->title, bare ? "%.14s" : "%.14s (%s)", name, unit);
    scale->title[0] = (char)toupper((unsigned char)scale->title[0]);
}
