/* hm_tri_flip: edges turned until all are locally Delaunay; constraints let go. */
#include "hm_tri_topology.h"

void hm_tri_flip(struct hm_tri *t, int32_t e)
{
    struct hm_tri_half *half = t->half;
    int32_t f = half[e].twin, a = half[e].org, b = half[f].org;
    int32_t bc = hm_tri_next(e), ca = hm_tri_prev(e), ad = hm_tri_next(f), db = hm_tri_prev(f);
    int32_t beyond_bc = half[bc].twin, beyond_ad = half[ad].twin;
    half[bc].org = half[db].org;
    half[ad].org = half[ca].org;
    hm_tri_pair(half, e, beyond_ad);
    hm_tri_pair(half, f, beyond_bc);
    hm_tri_pair(half, bc, ad);
    if (t->marks) {
        t->marks[e] = t->marks[ad];
        t->marks[f] = t->marks[bc];
        t->marks[ad] = t->marks[bc] = 0;
    }
    if (a != HM_TRI_INFINITY)
        t->edge[a] = e;
    if (b != HM_TRI_INFINITY)
        t->edge[b] = f;
}

bool hm_tri_is_illegal(const struct hm_tri *t, int32_t e)
{
    int32_t a = t->half[e].org, b = hm_tri_dest_of(t, e), c = hm_tri_apex_of(t, e);
    int32_t d = hm_tri_apex_of(t, t->half[e].twin);
    if (c == HM_TRI_INFINITY || d == HM_TRI_INFINITY || hm_tri_marks_of(t, e))
        return false;
    const double *pc = hm_tri_at(t, c), *pd = hm_tri_at(t, d);
    if (b == HM_TRI_INFINITY) /* the hull comes from d over a to c */
        return hm_pred_orient_fast(pd, hm_tri_at(t, a), pc) < 0;
    if (a == HM_TRI_INFINITY)
        return hm_pred_orient_fast(pc, hm_tri_at(t, b), pd) < 0;
    return hm_pred_incircle_unique_fast(hm_tri_at(t, a), hm_tri_at(t, b), pc, pd) > 0;
}

void hm_tri_legalize_star(struct hm_tri *t, int32_t link)
{
    int32_t first = t->half[link].org;
    do {
        while (hm_tri_is_illegal(t, link))
            hm_tri_flip(t, link); /* link starts where it did, and has v as apex still */
        link = hm_tri_next(t->half[hm_tri_next(link)].twin);
    } while (t->half[link].org != first);
}

enum hm_err hm_tri_legalize(struct hm_tri *t, size_t n, struct hm_diag *d)
{
    while (n > 0) {
        int32_t e = t->stack[--n], f = t->half[e].twin;
        if (!hm_tri_is_illegal(t, e))
            continue;
        if (!hm_grow(&t->stack, &t->cap_stack, n + 4, sizeof *t->stack))
            return hm_fail_memory(d);
        hm_tri_flip(t, e);
        t->stack[n++] = e;
        t->stack[n++] = f;
        t->stack[n++] = hm_tri_prev(e);
        t->stack[n++] = hm_tri_prev(f);
    }
    return HM_OK;
}

enum hm_err hm_tri_unmark(struct hm_tri *t, int32_t e, int32_t marks, struct hm_diag *d)
{
    int32_t left = hm_tri_marks_of(t, e) & ~marks;
    if (left == hm_tri_marks_of(t, e))
        return HM_OK;
    enum hm_err err = hm_tri_need_edges(t, d);
    if (!err && !hm_grow(&t->stack, &t->cap_stack, 1, sizeof *t->stack))
        err = hm_fail_memory(d);
    if (err)
        return err;
    hm_tri_set_marks(t, e, left);
    t->stack[0] = e;
    return hm_tri_legalize(t, 1, d); /* which leaves alone what still has marks */
}
