#include "hm_tri_cavity.h"

#include <stdlib.h>

void hm_tri_cavity_free(struct hm_tri_cavity *c)
{
    free(c->tri);
    free(c->rim);
    free(c->stack);
}

/* Any corner may come first: the sign is that of the circle. */
static bool is_in_circle(const struct hm_tri *t, int32_t tri, const double *p)
{
    const struct hm_tri_half *h = t->half + 3 * (size_t)tri;
    return hm_pred_incircle_unique_fast(hm_tri_at(t, h[0].org), hm_tri_at(t, h[1].org),
                                        hm_tri_at(t, h[2].org), p) > 0;
}

/* For `need` triangles, edges of the rim and edges still to look beyond. */
static bool make_room(struct hm_tri_cavity *c, size_t need)
{
    size_t caps[2] = {c->cap, c->cap};
    return need <= c->cap || (hm_grow(&c->tri, &caps[0], need, sizeof *c->tri) &&
                              hm_grow(&c->rim, &caps[1], need, sizeof *c->rim) &&
                              hm_grow(&c->stack, &c->cap, need, sizeof *c->stack));
}

/* Depth first, the edges of a triangle in their order: so the rim comes in order too. No vertex is
 * inside a cavity, hence its triangles form a tree and each is met once; m of them have m + 2 edges
 * on the rim. */
enum hm_err hm_tri_cavity_find(struct hm_tri_cavity *c, const struct hm_tri *t, const double *p,
                               int32_t tri, struct hm_diag *d)
{
    size_t n_tri = 0, n_rim = 0, n = 0;
    if (!make_room(c, 3))
        return hm_fail_memory(d);
    c->tri[n_tri++] = tri;
    for (int32_t i = 2; i >= 0; i--)
        c->stack[n++] = 3 * tri + i;
    while (n > 0) {
        int32_t e = c->stack[--n], f = t->half[e].twin;
        if (t->marks[e] || !is_in_circle(t, f / 3, p)) {
            c->rim[n_rim++] =
                (struct hm_tri_rim_edge){t->half[e].org, f, t->marks[e], t->region[e / 3]};
            continue;
        }
        if (!make_room(c, n_tri + 3))
            return hm_fail_memory(d);
        c->tri[n_tri++] = f / 3;
        c->stack[n++] = hm_tri_prev(f);
        c->stack[n++] = hm_tri_next(f);
    }
    c->n_tri = n_tri;
    c->n_rim = n_rim;
    return HM_OK;
}

enum hm_err hm_tri_cavity_fill(struct hm_tri_cavity *c, struct hm_tri *t, const double *p,
                               int32_t *v, struct hm_diag *d)
{
    enum hm_err err = hm_tri_need_triangles(t, 2, d);
    if (!err)
        err = hm_tri_need_vertices(t, 1, d);
    if (err)
        return err;
    while (c->n_tri < c->n_rim)
        c->tri[c->n_tri++] = hm_tri_take_triangle(t);
    *v = hm_tri_take_vertex(t, p[0], p[1]);
    int32_t before = 3 * c->tri[c->n_rim - 1] + 1;
    for (size_t i = 0; i < c->n_rim; i++) {
        const struct hm_tri_rim_edge *rim = c->rim + i;
        int32_t e = 3 * c->tri[i];
        t->half[e] = (struct hm_tri_half){rim->org, rim->outer};
        t->half[rim->outer].twin = e;
        t->half[e + 1].org = hm_tri_cavity_dest(c, i);
        t->half[e + 2] = (struct hm_tri_half){*v, before};
        t->half[before].twin = e + 2;
        t->marks[e] = rim->marks;
        t->marks[e + 1] = t->marks[e + 2] = 0;
        t->region[c->tri[i]] = rim->region;
        t->edge[rim->org] = e;
        before = e + 1;
    }
    t->edge[*v] = 3 * c->tri[0] + 2;
    return HM_OK;
}
