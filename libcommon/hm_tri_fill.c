/* hm_tri_fill: a hole in the triangulation is triangulated anew, constrained Delaunay.
 *
 * Two kinds of holes occur: the triangles that a new segment crosses, cut in two by it, and the
 * star of a vertex that is taken out. In both every vertex of the rim was joined by an old edge to
 * a place beyond the base or within the hole, and no part of the rim can cross that edge. So among
 * the rim vertices left of the base the one whose circle through the base holds no other is always
 * visible from it: it makes the Delaunay triangle of the base, and leaves two smaller polygons of
 * the same kind (Anglada 1997). A rim may run out along an edge and back; the vertex between lies
 * inside the circle of the one passed twice, which therefore is never chosen as long as it is there
 * twice.
 */
#include "hm_tri_topology.h"

enum hm_err hm_tri_rim_add(struct hm_tri *t, struct hm_tri_rim *rim, int32_t h, struct hm_diag *d)
{
    if (!hm_grow(&rim->link, &rim->cap, rim->n + 1, sizeof *rim->link))
        return hm_fail_memory(d);
    rim->link[rim->n++] =
        (struct hm_tri_link){t->half[h].org, t->half[h].twin, hm_tri_marks_of(t, h)};
    return HM_OK;
}

enum hm_err hm_tri_rim_end(struct hm_tri_rim *rim, int32_t v, struct hm_diag *d)
{
    if (!hm_grow(&rim->link, &rim->cap, rim->n + 1, sizeof *rim->link))
        return hm_fail_memory(d);
    rim->link[rim->n] = (struct hm_tri_link){v, HM_TRI_NONE, 0};
    return HM_OK;
}

void hm_tri_rim_reverse(struct hm_tri_rim *rim)
{
    for (size_t i = 0, k = rim->n; i + 1 < k; i++) {
        struct hm_tri_link swap = rim->link[--k];
        rim->link[k] = rim->link[i];
        rim->link[i] = swap;
    }
}

/* The half-edges inside a hole are done with: each gets the number of its link for a twin. So a
 * link whose other side has such a number lies on an edge with the hole on both sides. */
void hm_tri_rim_match(struct hm_tri *t, struct hm_tri_rim *rim)
{
    for (size_t i = 0; i < rim->n; i++) {
        int32_t inner = t->half[rim->link[i].outer].twin;
        if (inner <= -2) {
            rim->link[i].outer = inner;
            rim->link[-2 - inner].outer = -2 - (int32_t)i;
        } else {
            t->half[inner].twin = -2 - (int32_t)i;
        }
    }
}

enum hm_err hm_tri_hole_add(struct hm_tri *t, int32_t tri, struct hm_diag *d)
{
    if (!hm_grow(&t->hole, &t->cap_hole, t->n_hole + 1, sizeof *t->hole))
        return hm_fail_memory(d);
    t->hole[t->n_hole++] = tri;
    return HM_OK;
}

enum hm_err hm_tri_fill_prepare(struct hm_tri *t, const struct hm_tri_rim *rim, struct hm_diag *d)
{
    if (!hm_grow(&t->stack, &t->cap_stack, 3 * (rim->n + 1), sizeof *t->stack))
        return hm_fail_memory(d);
    return HM_OK;
}

/* The link between i and j whose vertex makes the Delaunay triangle of the base v_j → v_i. */
static int32_t find_apex(const struct hm_tri *t, const struct hm_tri_rim *rim, int32_t i, int32_t j)
{
    const double *a = hm_tri_at(t, rim->link[j].v), *b = hm_tri_at(t, rim->link[i].v), *c = NULL;
    int32_t apex = HM_TRI_NONE;
    for (int32_t k = i + 1; k < j; k++) {
        const double *p = hm_tri_at(t, rim->link[k].v);
        if (hm_pred_orient_fast(a, b, p) <= 0)
            continue;
        if (!c || hm_pred_incircle_unique_fast(a, b, c, p) > 0) {
            c = p;
            apex = k;
        }
    }
    return apex;
}

/* Join the inner half-edge h of link i to what is on the other side. */
static void join(struct hm_tri *t, struct hm_tri_rim *rim, int32_t i, int32_t h)
{
    struct hm_tri_link *link = &rim->link[i];
    if (t->marks)
        t->marks[h] = link->marks;
    if (link->outer <= -2)
        rim->link[-2 - link->outer].outer = h; /* the way back will find it */
    else
        hm_tri_pair(t->half, h, link->outer);
}

/* A triangle v_j → v_i → v_k. */
static int32_t make_triangle(struct hm_tri *t, const struct hm_tri_rim *rim, int32_t i, int32_t j,
                             int32_t k)
{
    int32_t e = 3 * t->hole[--t->n_hole];
    t->half[e].org = rim->link[j].v;
    t->half[e + 1].org = rim->link[i].v;
    t->half[e + 2].org = rim->link[k].v;
    if (t->marks)
        t->marks[e] = t->marks[e + 1] = t->marks[e + 2] = 0;
    for (int n = 0; n < 3; n++)
        t->edge[t->half[e + n].org] = e + n;
    return e;
}

int32_t hm_tri_fill(struct hm_tri *t, struct hm_tri_rim *rim, int32_t outer)
{
    int32_t base = HM_TRI_NONE;
    size_t n = 0;
    int32_t *todo = t->stack; /* threes of i, j, and the half-edge behind the base */
    todo[n++] = 0;
    todo[n++] = (int32_t)rim->n;
    todo[n++] = outer;
    while (n > 0) {
        int32_t behind = todo[--n], j = todo[--n], i = todo[--n];
        if (j == i + 1) {
            join(t, rim, i, behind);
            continue;
        }
        int32_t k = find_apex(t, rim, i, j), e = make_triangle(t, rim, i, j, k);
        if (base == HM_TRI_NONE)
            base = e;
        if (behind != HM_TRI_NONE) {
            hm_tri_pair(t->half, e, behind);
            if (t->marks)
                t->marks[e] = t->marks[behind];
        }
        todo[n++] = i;
        todo[n++] = k;
        todo[n++] = e + 1;
        todo[n++] = k;
        todo[n++] = j;
        todo[n++] = e + 2;
    }
    return base;
}
