/* hm_tri_edit: vertices put in, taken out and moved. */
#include "hm_tri_topology.h"

#include <math.h>

/* --- in --- */

static void set_half(struct hm_tri *t, int32_t e, int32_t org, int32_t marks)
{
    t->half[e].org = org;
    if (t->marks)
        t->marks[e] = marks;
    if (org != HM_TRI_INFINITY)
        t->edge[org] = e;
}

static int32_t new_triangle(struct hm_tri *t, int32_t like)
{
    int32_t tri = hm_tri_take_triangle(t);
    if (t->region)
        t->region[tri] = t->region[like];
    return 3 * tri;
}

void hm_tri_split_edge(struct hm_tri *t, int32_t e, int32_t v)
{
    struct hm_tri_half *half = t->half;
    int32_t f = half[e].twin, bc = hm_tri_next(e), ca = hm_tri_prev(e), db = hm_tri_prev(f);
    int32_t b = half[bc].org, c = half[ca].org, d = half[db].org;
    int32_t marks = hm_tri_marks_of(t, e), marks_bc = hm_tri_marks_of(t, bc);
    int32_t marks_db = hm_tri_marks_of(t, db);
    int32_t beyond_bc = half[bc].twin, beyond_db = half[db].twin;
    int32_t left = new_triangle(t, e / 3), right = new_triangle(t, f / 3);
    set_half(t, left, v, marks);
    set_half(t, left + 1, b, marks_bc);
    set_half(t, left + 2, c, 0);
    set_half(t, right, b, marks);
    set_half(t, right + 1, v, 0);
    set_half(t, right + 2, d, marks_db);
    set_half(t, bc, v, 0);
    set_half(t, f, v, marks);
    set_half(t, db, d, 0);
    hm_tri_pair(half, bc, left + 2);
    hm_tri_pair(half, left + 1, beyond_bc);
    hm_tri_pair(half, db, right + 1);
    hm_tri_pair(half, right + 2, beyond_db);
    hm_tri_pair(half, left, right);
    hm_tri_legalize_star(t, ca);
}

void hm_tri_split_triangle(struct hm_tri *t, int32_t tri, int32_t v)
{
    struct hm_tri_half *half = t->half;
    int32_t e = 3 * tri, a = half[e].org, b = half[e + 1].org, c = half[e + 2].org;
    int32_t beyond_bc = half[e + 1].twin, beyond_ca = half[e + 2].twin;
    int32_t marks_bc = hm_tri_marks_of(t, e + 1), marks_ca = hm_tri_marks_of(t, e + 2);
    int32_t right = new_triangle(t, tri), left = new_triangle(t, tri);
    set_half(t, right, b, marks_bc);
    set_half(t, right + 1, c, 0);
    set_half(t, right + 2, v, 0);
    set_half(t, left, c, marks_ca);
    set_half(t, left + 1, a, 0);
    set_half(t, left + 2, v, 0);
    set_half(t, e + 1, b, 0);
    set_half(t, e + 2, v, 0);
    hm_tri_pair(half, right, beyond_bc);
    hm_tri_pair(half, left, beyond_ca);
    hm_tri_pair(half, e + 1, right + 2);
    hm_tri_pair(half, right + 1, left + 2);
    hm_tri_pair(half, left + 1, e + 2);
    hm_tri_legalize_star(t, e);
}

/* Where a point is: at a vertex, on an edge, or inside a triangle; beyond the hull, in a ghost. */
struct place {
    int32_t vertex, edge, tri; /* the one that applies; others are HM_TRI_NONE; tri always is set */
};

static struct place find_place(const struct hm_tri *t, const double *p, int32_t hint)
{
    struct place at = {HM_TRI_NONE, HM_TRI_NONE, hm_tri_find(t, p, hint)};
    if (hm_tri_is_ghost(t, at.tri))
        return at;
    for (int32_t e = 3 * at.tri; e < 3 * at.tri + 3; e++) {
        const double *a = hm_tri_at(t, t->half[e].org), *b = hm_tri_at(t, hm_tri_dest_of(t, e));
        if (a[0] == p[0] && a[1] == p[1])
            at.vertex = t->half[e].org;
        if (hm_pred_orient_fast(a, b, p) == 0)
            at.edge = e;
    }
    return at;
}

static void put_in(struct hm_tri *t, const struct place *at, int32_t v)
{
    if (at->edge != HM_TRI_NONE)
        hm_tri_split_edge(t, at->edge, v);
    else
        hm_tri_split_triangle(t, at->tri, v);
}

/* For one vertex more. */
static enum hm_err make_room(struct hm_tri *t, struct hm_diag *d)
{
    enum hm_err err = hm_tri_need_edges(t, d);
    if (!err)
        err = hm_tri_need_triangles(t, 2, d);
    return err ? err : hm_tri_need_vertices(t, 1, d);
}

enum hm_err hm_tri_insert(struct hm_tri *t, double x, double y, int32_t hint, int32_t *v,
                          struct hm_diag *d)
{
    const double p[2] = {x, y};
    if (!isfinite(x) || !isfinite(y))
        return hm_fail(d, HM_EGEOM, "coordinates of a new vertex are not finite");
    struct place at = find_place(t, p, hint);
    *v = at.vertex;
    if (at.vertex != HM_TRI_NONE)
        return HM_OK;
    enum hm_err err = make_room(t, d);
    if (err)
        return err;
    *v = hm_tri_take_vertex(t, x, y);
    put_in(t, &at, *v);
    return HM_OK;
}

/* --- on an edge --- */

static enum hm_err legalize_around(struct hm_tri *t, int32_t v, struct hm_diag *d)
{
    int32_t first = t->edge[v], e = first;
    size_t n = 0;
    do {
        if (!hm_grow(&t->stack, &t->cap_stack, n + 2, sizeof *t->stack))
            return hm_fail_memory(d);
        t->stack[n++] = e;
        t->stack[n++] = hm_tri_next(e);
        e = hm_tri_turn(t, e);
    } while (e != first);
    return hm_tri_legalize(t, n, d);
}

static bool turns_left(const struct hm_tri *t, int32_t a, const double *p, int32_t b, int32_t apex)
{
    const double *q = apex == HM_TRI_INFINITY ? NULL : hm_tri_at(t, apex);
    return !q || (hm_pred_orient_fast(hm_tri_at(t, a), p, q) > 0 &&
                  hm_pred_orient_fast(p, hm_tri_at(t, b), q) > 0);
}

bool hm_tri_can_split(const struct hm_tri *t, int32_t e, const double *p)
{
    int32_t a = t->half[e].org, b = hm_tri_dest_of(t, e);
    return a != HM_TRI_INFINITY && b != HM_TRI_INFINITY &&
           turns_left(t, a, p, b, hm_tri_apex_of(t, e)) &&
           turns_left(t, b, p, a, hm_tri_apex_of(t, t->half[e].twin));
}

/* Strictly inside, so never of a ghost. */
static bool is_within(const struct hm_tri *t, int32_t tri, const double *p)
{
    if (hm_tri_is_ghost(t, tri))
        return false;
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++)
        if (hm_pred_orient_fast(hm_tri_at(t, t->half[e].org), hm_tri_at(t, hm_tri_dest_of(t, e)),
                                p) <= 0)
            return false;
    return true;
}

/* Split edge e, from a to b, at a vertex inside its triangle: e stays as an edge, and the
 * constraint leaves it to go over the vertex. What is between now lies on the other side of it. */
static void split_beside(struct hm_tri *t, int32_t e, int32_t v)
{
    int32_t a = t->half[e].org, b = hm_tri_dest_of(t, e), marks = hm_tri_marks_of(t, e);
    int32_t beyond = hm_tri_region(t, t->half[e].twin / 3);
    if (marks)
        hm_tri_set_marks(t, e, 0);
    hm_tri_split_triangle(t, e / 3, v);
    int32_t spoke = hm_tri_edge_between(t, v, a);
    if (marks)
        hm_tri_set_marks(t, spoke, marks);
    for (; hm_tri_dest_of(t, spoke) != b; spoke = hm_tri_turn(t, spoke))
        if (t->region)
            t->region[spoke / 3] = beyond;
    if (marks)
        hm_tri_set_marks(t, spoke, marks);
}

enum hm_err hm_tri_split(struct hm_tri *t, int32_t e, double x, double y, int32_t *v,
                         struct hm_diag *d)
{
    const double p[2] = {x, y};
    bool finite = isfinite(x) && isfinite(y), on = finite && hm_tri_can_split(t, e, p);
    if (finite && !on && !is_within(t, e / 3, p))
        e = t->half[e].twin;
    if (!finite || (!on && !is_within(t, e / 3, p)))
        return hm_fail_at(d, HM_EGEOM, x, y, "an edge cannot be split here");
    enum hm_err err = make_room(t, d);
    if (err)
        return err;
    *v = hm_tri_take_vertex(t, x, y);
    if (on)
        hm_tri_split_edge(t, e, *v);
    else
        split_beside(t, e, *v);
    return legalize_around(t, *v, d); /* off the edge by rounding: any edge at v may be wrong */
}

/* --- out --- */

static bool is_loose(const struct hm_tri *t, int32_t v)
{
    int32_t first = t->edge[v], e = first;
    if (first == HM_TRI_NONE)
        return false;
    do {
        if (hm_tri_marks_of(t, e) || hm_tri_dest_of(t, e) == HM_TRI_INFINITY)
            return false;
        e = hm_tri_turn(t, e);
    } while (e != first);
    return true;
}

/* The rim of the star of v, which becomes the hole. */
static enum hm_err take_star(struct hm_tri *t, int32_t v, struct hm_diag *d)
{
    int32_t first = t->edge[v], e = first;
    enum hm_err err = HM_OK;
    t->left.n = t->n_hole = 0;
    do {
        err = hm_tri_hole_add(t, e / 3, d);
        if (!err)
            err = hm_tri_rim_add(t, &t->left, hm_tri_next(e), d);
        e = hm_tri_turn(t, e);
    } while (!err && e != first);
    if (!err)
        err = hm_tri_fill_prepare(t, &t->left, d);
    return err;
}

enum hm_err hm_tri_remove(struct hm_tri *t, int32_t v, struct hm_diag *d)
{
    enum hm_err err = hm_tri_need_edges(t, d);
    if (err)
        return err;
    if (v < 0 || v >= t->vertices || !is_loose(t, v))
        return hm_fail(d, HM_EARG, "vertex %d is on the hull, on a constraint or removed", (int)v);
    err = take_star(t, v, d);
    if (err)
        return err;
    t->left.n--; /* the last link is the base */
    hm_tri_rim_match(t, &t->left);
    hm_tri_fill(t, &t->left, t->left.link[t->left.n].outer);
    while (t->n_hole > 0)
        hm_tri_give_triangle(t, t->hole[--t->n_hole]);
    t->edge[v] = HM_TRI_NONE;
    return HM_OK;
}

/* --- elsewhere --- */

/* Does the star of v, seen from p, still turn left everywhere? */
static bool star_holds(const struct hm_tri *t, int32_t v, const double *p)
{
    int32_t first = t->edge[v], e = first;
    do {
        const double *a = hm_tri_at(t, hm_tri_dest_of(t, e));
        if (hm_pred_orient_fast(a, hm_tri_at(t, hm_tri_apex_of(t, e)), p) <= 0)
            return false;
        e = hm_tri_turn(t, e);
    } while (e != first);
    return true;
}

/* Is the straight way from v to p free of constraints? One may be touched only at its far side, by
 * p itself, which then is no place for a vertex either. */
static bool is_open_way(const struct hm_tri *t, int32_t v, const double *p)
{
    const double *from = hm_tri_at(t, v);
    int32_t e = hm_tri_aim(t, v, p);
    while (e != HM_TRI_NONE) {
        int32_t x = hm_tri_dest_of(t, e), cross = hm_tri_next(e), apex = HM_TRI_NONE;
        if (hm_pred_orient_fast(from, hm_tri_at(t, x), p) != 0) {
            for (;;) { /* from and p are on different sides of cross, or p is this side of it */
                x = t->half[cross].org;
                int32_t y = hm_tri_dest_of(t, cross);
                if (hm_pred_orient_fast(hm_tri_at(t, x), hm_tri_at(t, y), p) >= 0)
                    return true;
                if (hm_tri_marks_of(t, cross))
                    return false;
                cross = t->half[cross].twin;
                apex = hm_tri_apex_of(t, cross);
                if (apex == HM_TRI_INFINITY)
                    return false;
                int side = hm_pred_orient_fast(from, p, hm_tri_at(t, apex));
                if (side == 0)
                    break;
                cross = side < 0 ? hm_tri_prev(cross) : hm_tri_next(cross);
            }
            x = apex;
        } else if (hm_tri_marks_of(t, e)) {
            return false;
        }
        if (hm_tri_is_between(from, p, hm_tri_at(t, x)))
            return true;
        if (!is_loose(t, x))
            return false;
        e = hm_tri_aim(t, x, p);
    }
    return false;
}

static bool is_free_place(const struct hm_tri *t, int32_t v, const double *p)
{
    struct place at = find_place(t, p, t->edge[v] / 3);
    return at.vertex == HM_TRI_NONE && !hm_tri_is_ghost(t, at.tri) &&
           (at.edge == HM_TRI_NONE || !hm_tri_marks_of(t, at.edge)) && is_open_way(t, v, p);
}

enum hm_err hm_tri_move(struct hm_tri *t, int32_t v, double x, double y, struct hm_diag *d)
{
    const double p[2] = {x, y};
    enum hm_err err = hm_tri_need_edges(t, d);
    if (err)
        return err;
    if (v < 0 || v >= t->vertices || !isfinite(x) || !isfinite(y) || !is_loose(t, v))
        return hm_fail(d, HM_EARG, "vertex %d cannot be moved", (int)v);
    double *now = t->xy + 2 * (size_t)v;
    if (star_holds(t, v, p)) {
        now[0] = x;
        now[1] = y;
        return legalize_around(t, v, d);
    }
    if (!is_free_place(t, v, p))
        return hm_fail_at(d, HM_EARG, x, y, "vertex %d cannot be moved here", (int)v);
    err = hm_tri_remove(t, v, d);
    if (err)
        return err;
    now[0] = x; /* the two triangles given back make room for it */
    now[1] = y;
    struct place at = find_place(t, p, HM_TRI_NONE);
    put_in(t, &at, v);
    return HM_OK;
}
