/* hm_tri_constrain: segments become chains of edges.
 *
 * A segment is followed from its start through the triangles that it crosses. Where it meets a
 * vertex its first piece ends; the triangles crossed until then are a hole that is filled anew on
 * both sides of the piece. Where it crosses a constraint, a vertex comes to be at the intersection,
 * rounded to doubles, and both are led through it. That bends a constraint by a last digit (a few
 * where many cross in one spot), so what lies that near may come to lie on it, or on its other
 * side; but the triangulation is one of straight edges after every step, decided by exact
 * predicates.
 */
#include "hm_pred.h"
#include "hm_tri_topology.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* A segment yet to go in. Pieces that rounding bends have been led away from the true line `bends`
 * times; there is an end to that on a finite grid, and a guard in case there is not. */
struct task {
    int32_t a, b, marks, bends;
};

enum { MOST_BENDS = 1000 };

struct constrain {
    struct hm_tri *t;
    struct hm_tri_mends *mends;
    struct task *task;
    size_t n, cap;
    struct hm_diag *d;
};

static enum hm_err push(struct constrain *c, struct task task)
{
    if (task.a == task.b)
        return HM_OK;
    if (!hm_grow(&c->task, &c->cap, c->n + 1, sizeof *c->task))
        return hm_fail_memory(c->d);
    c->task[c->n++] = task;
    return HM_OK;
}

static void count(struct constrain *c, enum hm_tri_mend what, double x, double y)
{
    c->mends->n[what]++;
    if (c->mends->tell)
        c->mends->tell(c->mends->who, what, x, y);
}

static void count_at(struct constrain *c, enum hm_tri_mend what, int32_t v)
{
    count(c, what, hm_tri_at(c->t, v)[0], hm_tri_at(c->t, v)[1]);
}

static void mark(struct constrain *c, int32_t e, int32_t marks)
{
    int32_t before = c->t->marks[e];
    const double *p = hm_tri_at(c->t, c->t->half[e].org);
    const double *q = hm_tri_at(c->t, hm_tri_dest_of(c->t, e));
    if (before)
        count(c, HM_TRI_OVERLAP, p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2);
    hm_tri_set_marks(c->t, e, before | marks);
}

/* The piece that a segment from a to b makes: through a hole, along an edge, or none because it
 * crosses a constraint first. */
struct piece {
    int32_t end;   /* the vertex where it ends */
    int32_t along; /* the edge that it is already, or HM_TRI_NONE */
    int32_t block; /* the constraint in the way, or HM_TRI_NONE */
};

/* Follow the segment from a to b; what it crosses is in t->hole, t->left and t->right. */
static enum hm_err follow(struct hm_tri *t, int32_t a, int32_t b, struct piece *piece,
                          struct hm_diag *d)
{
    const double *pa = hm_tri_at(t, a), *pb = hm_tri_at(t, b);
    int32_t e = hm_tri_aim(t, a, pb), x = hm_tri_dest_of(t, e);
    *piece = (struct piece){HM_TRI_NONE, HM_TRI_NONE, HM_TRI_NONE};
    t->left.n = t->right.n = t->n_hole = 0;
    if (hm_pred_orient_fast(pa, pb, hm_tri_at(t, x)) == 0) {
        piece->end = x;
        piece->along = e;
        return HM_OK;
    }
    enum hm_err err = hm_tri_hole_add(t, e / 3, d);
    if (!err)
        err = hm_tri_rim_add(t, &t->right, e, d);
    if (!err)
        err = hm_tri_rim_add(t, &t->left, hm_tri_prev(e), d);
    for (e = hm_tri_next(e); !err && piece->end == HM_TRI_NONE;) {
        if (hm_tri_marks_of(t, e)) {
            piece->block = e;
            return HM_OK;
        }
        e = t->half[e].twin;
        int32_t apex = hm_tri_apex_of(t, e), right = hm_tri_next(e), left = hm_tri_prev(e);
        int side = hm_pred_orient_fast(pa, pb, hm_tri_at(t, apex));
        err = hm_tri_hole_add(t, e / 3, d);
        if (!err && side <= 0)
            err = hm_tri_rim_add(t, &t->right, right, d);
        if (!err && side >= 0)
            err = hm_tri_rim_add(t, &t->left, left, d);
        if (side == 0)
            piece->end = apex;
        e = side < 0 ? left : right;
    }
    return err;
}

/* Fill the hole that a piece from a to b cut, and mark the edge between. */
static enum hm_err cut(struct constrain *c, int32_t a, int32_t b, int32_t marks)
{
    struct hm_tri *t = c->t;
    hm_tri_rim_reverse(&t->left);
    enum hm_err err = hm_tri_rim_end(&t->left, a, c->d);
    if (!err)
        err = hm_tri_rim_end(&t->right, b, c->d);
    if (!err)
        err = hm_tri_fill_prepare(t, &t->left, c->d);
    if (!err)
        err = hm_tri_fill_prepare(t, &t->right, c->d);
    if (err)
        return err;
    hm_tri_rim_match(t, &t->left);
    hm_tri_rim_match(t, &t->right);
    int32_t e = hm_tri_fill(t, &t->left, HM_TRI_NONE);
    hm_tri_fill(t, &t->right, e);
    mark(c, e, marks);
    return HM_OK;
}

static double middle(double low, double v, double high)
{
    return v < low ? low : v > high ? high : v;
}

/* Four points scaled by a power of two into [-1, 1], so that neither 1e300 nor 1e-300 harms
 * products of them. */
struct quad {
    double q[4][2];
    int shift;
};

static struct quad scale(const struct hm_tri *t, const int32_t *v)
{
    struct quad quad;
    double most = 0;
    for (int i = 0; i < 4; i++)
        most = fmax(most, fmax(fabs(hm_tri_at(t, v[i])[0]), fabs(hm_tri_at(t, v[i])[1])));
    frexp(most, &quad.shift);
    for (int i = 0; i < 8; i++)
        quad.q[i / 2][i % 2] = ldexp(hm_tri_at(t, v[i / 2])[i % 2], -quad.shift);
    return quad;
}

/* Where the segments q0 q1 and q2 q3, which cross, do so; rounded. */
static void intersect(const struct quad *quad, double *p)
{
    const double(*q)[2] = quad->q;
    double here = hm_area2(q[2], q[3], q[0]), there = hm_area2(q[2], q[3], q[1]);
    double part = here != there ? middle(0, here / (here - there), 1) : 0.5;
    for (int k = 0; k < 2; k++) {
        double v = q[0][k] + part * (q[1][k] - q[0][k]);
        v = middle(fmin(q[0][k], q[1][k]), v, fmax(q[0][k], q[1][k]));
        v = middle(fmin(q[2][k], q[3][k]), v, fmax(q[2][k], q[3][k]));
        p[k] = ldexp(v, quad->shift);
    }
}

static bool is_near(const double *p, const double *a, const double *b, double distance)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], size = dx * dx + dy * dy;
    double part = size > 0 ? middle(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / size, 1) : 0;
    return hypot(p[0] - (a[0] + part * dx), p[1] - (a[1] + part * dy)) <= distance;
}

/* The vertex that the crossing of a b and u w shall go through, when it is one of these four; p is
 * the intersection. An end so near the other segment that rounding cannot tell it from the
 * intersection is taken for it: lines that all but coincide would cross again and again, each
 * time a digit further on. Ends of u w come first, since then it can stay as it is; and what counts
 * as near grows with the bends, or three constraints a digit apart may hand their crossing round.
 */
static int32_t choose_end(const struct quad *quad, const int32_t *v, const double *p, int bends)
{
    static const int order[4] = {2, 3, 0, 1};
    for (int i = 0; i < 4; i++) {
        int k = order[i], other = k < 2 ? 2 : 0;
        const double *q = quad->q[k];
        if ((ldexp(q[0], quad->shift) == p[0] && ldexp(q[1], quad->shift) == p[1]) ||
            is_near(q, quad->q[other], quad->q[other + 1], (1 + bends) * DBL_EPSILON / 2))
            return v[k];
    }
    return HM_TRI_NONE;
}

/* The segment s crosses the constrained edge e: lead both through one vertex. Usually that is a new
 * one on e. It may also be an end of e, when only s bends; or an end of s or some other vertex that
 * is there already, or one that would not fit on e: then e is taken out and led through it anew. */
static enum hm_err cross(struct constrain *c, struct task s, int32_t e)
{
    struct hm_tri *t = c->t;
    int32_t u = t->half[e].org, w = hm_tri_dest_of(t, e), marks = t->marks[e];
    int32_t ends[4] = {s.a, s.b, u, w};
    struct quad quad = scale(t, ends);
    double p[2];
    intersect(&quad, p);
    int32_t v = choose_end(&quad, ends, p, s.bends);
    if (v == HM_TRI_NONE)
        count(c, HM_TRI_CROSSING, p[0], p[1]);
    else
        count_at(c, HM_TRI_CROSSING, v);
    enum hm_err err = HM_OK;
    bool leads = v != u && v != w; /* must e be led to the vertex? */
    if (v == HM_TRI_NONE && hm_tri_can_split(t, e, p)) {
        leads = false;
        err = hm_tri_split(t, e, p[0], p[1], &v, c->d);
    } else if (leads) {
        err = hm_tri_unmark(t, e, marks, c->d);
        if (!err && v == HM_TRI_NONE)
            err = hm_tri_insert(t, p[0], p[1], e / 3, &v, c->d);
    }
    if (!err)
        err = push(c, (struct task){v, s.b, s.marks, s.bends + (v == s.a)});
    if (!err)
        err = push(c, (struct task){s.a, v, s.marks, s.bends + 1});
    if (!err && leads)
        err = push(c, (struct task){u, v, marks, s.bends + 1});
    if (!err && leads)
        err = push(c, (struct task){v, w, marks, s.bends + 1});
    return err;
}

static enum hm_err put_in(struct constrain *c, struct task s)
{
    struct piece piece;
    if (s.bends > MOST_BENDS) {
        const double *p = hm_tri_at(c->t, s.a);
        return hm_fail_at(c->d, HM_EGEOM, p[0], p[1],
                          "constraints cross too finely to be told apart");
    }
    enum hm_err err = follow(c->t, s.a, s.b, &piece, c->d);
    if (err)
        return err;
    if (piece.block != HM_TRI_NONE)
        return cross(c, s, piece.block);
    if (piece.along != HM_TRI_NONE)
        mark(c, piece.along, s.marks);
    else
        err = cut(c, s.a, piece.end, s.marks);
    if (err || piece.end == s.b)
        return err;
    count_at(c, HM_TRI_ON_SEGMENT, piece.end);
    s.a = piece.end;
    return push(c, s);
}

static bool is_vertex(const struct hm_tri *t, int32_t v)
{
    return v >= 0 && v < t->vertices && hm_tri_is_used(t, v);
}

static enum hm_err check(const struct hm_tri *t, const struct hm_tri_segment *s, size_t n,
                         struct hm_diag *d)
{
    for (size_t i = 0; i < n; i++) {
        if (s[i].marks == 0)
            return hm_fail(d, HM_EARG, "segment %zu has no marks", i);
        if (!is_vertex(t, s[i].a) || !is_vertex(t, s[i].b))
            return hm_fail(d, HM_EARG, "an end of segment %zu is no vertex", i);
    }
    return HM_OK;
}

enum hm_err hm_tri_constrain(struct hm_tri *t, const struct hm_tri_segment *s, size_t n,
                             struct hm_tri_mends *mends, struct hm_diag *d)
{
    struct hm_tri_mends unasked = {0};
    struct constrain c = {.t = t, .mends = mends ? mends : &unasked, .d = d};
    enum hm_err err = check(t, s, n, d);
    if (!err)
        err = hm_tri_need_edges(t, d);
    if (!err)
        err = hm_tri_need_marks(t, d);
    for (size_t i = 0; !err && i < n; i++) {
        if (s[i].a == s[i].b)
            count_at(&c, HM_TRI_ZERO_LENGTH, s[i].a);
        err = push(&c, (struct task){s[i].a, s[i].b, s[i].marks, 0});
        while (!err && c.n > 0)
            err = put_in(&c, c.task[--c.n]);
    }
    free(c.task);
    return err;
}
