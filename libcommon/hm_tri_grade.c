#include "hm_tri_grade.h"

#include <stdlib.h>

void hm_tri_grade_free(struct hm_tri_grade *g)
{
    free(g->size);
    free(g->lowered);
}

static double length(const struct hm_tri *t, int32_t a, int32_t b)
{
    const double *p = hm_tri_at(t, a), *q = hm_tri_at(t, b);
    return hypot(p[0] - q[0], p[1] - q[1]);
}

static enum hm_err lower(struct hm_tri_grade *g, int32_t v, double size, struct hm_diag *d)
{
    if (!hm_grow(&g->lowered, &g->cap_lowered, g->n_lowered + 1, sizeof *g->lowered))
        return hm_fail_memory(d);
    g->size[v] = size;
    g->lowered[g->n_lowered++] = v;
    return HM_OK;
}

/* Carry the sizes of g->lowered[from] and after on to their neighbours, and so forth. */
static enum hm_err spread(struct hm_tri_grade *g, const struct hm_tri *t, size_t from,
                          struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = from; !err && i < g->n_lowered; i++) {
        int32_t v = g->lowered[i], first = t->edge[v], e = first;
        do {
            int32_t u = hm_tri_dest_of(t, e);
            double most = u == HM_TRI_INFINITY ? 0 : g->size[v] + g->growth * length(t, u, v);
            if (u != HM_TRI_INFINITY && g->size[u] > most * (1 + 1e-9))
                err = lower(g, u, most, d);
            e = hm_tri_turn(t, e);
        } while (!err && e != first);
    }
    return err;
}

static enum hm_err make_room(struct hm_tri_grade *g, const struct hm_tri *t, struct hm_diag *d)
{
    return hm_grow(&g->size, &g->cap_size, (size_t)t->vertices, sizeof *g->size)
               ? HM_OK
               : hm_fail_memory(d);
}

enum hm_err hm_tri_grade_start(struct hm_tri_grade *g, const struct hm_tri *t, double growth,
                               int32_t outside, struct hm_diag *d)
{
    enum hm_err err = make_room(g, t, d);
    g->growth = growth;
    g->n_lowered = 0;
    for (int32_t v = 0; !err && v < t->vertices; v++)
        g->size[v] = INFINITY;
    for (int32_t e = 0; !err && e < 3 * t->triangles; e++) {
        if (!hm_tri_is_solid(t, e / 3) || hm_tri_region(t, e / 3) == outside)
            continue;
        int32_t v = t->half[e].org, u = hm_tri_dest_of(t, e);
        double here = length(t, u, v);
        g->size[v] = fmin(g->size[v], here);
        g->size[u] = fmin(g->size[u], here);
    }
    for (int32_t v = 0; !err && v < t->vertices; v++)
        if (t->edge[v] != HM_TRI_NONE)
            err = lower(g, v, g->size[v], d);
    if (!err)
        err = spread(g, t, 0, d);
    g->n_lowered = 0;
    return err;
}

enum hm_err hm_tri_grade_add(struct hm_tri_grade *g, const struct hm_tri *t, int32_t v, double own,
                             struct hm_diag *d)
{
    enum hm_err err = make_room(g, t, d);
    if (err)
        return err;
    g->size[v] = own;
    int32_t first = t->edge[v], e = first;
    do {
        int32_t u = hm_tri_dest_of(t, e);
        if (u != HM_TRI_INFINITY)
            g->size[v] = fmin(g->size[v], g->size[u] + g->growth * length(t, u, v));
        e = hm_tri_turn(t, e);
    } while (e != first);
    size_t from = g->n_lowered;
    err = lower(g, v, g->size[v], d);
    return err ? err : spread(g, t, from, d);
}
