#include "hm_tri_cavity.h"

#include <stdlib.h>

void hm_tri_cavity_free(struct hm_tri_cavity *c)
{
    free(c->tri);
    free(c->rim);
    free(c->stack);
}

static bool is_in_circle(const struct hm_tri *t, int32_t e, const double *p)
{
    return hm_pred_incircle_unique_fast(hm_tri_at(t, t->half[e].org),
                                        hm_tri_at(t, hm_tri_dest_of(t, e)),
                                        hm_tri_at(t, hm_tri_apex_of(t, e)), p) > 0;
}

/* For one triangle more. With m of them the rim and the edges still to look beyond are m + 2. */
static bool make_room(struct hm_tri_cavity *c)
{
    size_t need = c->n_tri + 3, caps[2] = {c->cap, c->cap};
    return need <= c->cap || (hm_grow(&c->tri, &caps[0], need, sizeof *c->tri) &&
                              hm_grow(&c->rim, &caps[1], need, sizeof *c->rim) &&
                              hm_grow(&c->stack, &c->cap, need, sizeof *c->stack));
}

/* Depth first, the edges of a triangle in their order: so the rim comes in order too. No vertex is
 * inside a cavity, hence its triangles form a tree and each is met once. */
enum hm_err hm_tri_cavity_find(struct hm_tri_cavity *c, const struct hm_tri *t, const double *p,
                               int32_t tri, struct hm_diag *d)
{
    size_t n = 0;
    c->n_tri = c->n_rim = 0;
    if (!make_room(c))
        return hm_fail_memory(d);
    c->tri[c->n_tri++] = tri;
    for (int32_t i = 2; i >= 0; i--)
        c->stack[n++] = 3 * tri + i;
    while (n > 0) {
        int32_t e = c->stack[--n], f = t->half[e].twin;
        if (t->marks[e] || !is_in_circle(t, f, p)) {
            c->rim[c->n_rim++] =
                (struct hm_tri_rim_edge){t->half[e].org, f, t->marks[e], t->region[e / 3]};
            continue;
        }
        if (!make_room(c))
            return hm_fail_memory(d);
        c->tri[c->n_tri++] = f / 3;
        c->stack[n++] = hm_tri_prev(f);
        c->stack[n++] = hm_tri_next(f);
    }
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
