#include "hm_tri_refine.h"

#include "hm_pred.h"
#include "hm_tri_cavity.h"
#include "hm_tri_grade.h"
#include "hm_tri_worklist.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* A constraint, or a piece of one, between two vertices. */
struct segment {
    int32_t a, b;
};

struct refine {
    struct hm_tri *t;
    const struct hm_tri_quality *q;
    struct hm_tri_refined *done;
    struct hm_diag *d;
    struct hm_tri_worklist bad;
    struct hm_tri_cavity cavity;
    struct hm_tri_grade grade;
    struct segment *split; /* constraints to be split, a stack */
    size_t n_split, cap_split;
    int64_t added;          /* vertices, those taken out again included */
    int32_t first;          /* vertices from here on are ours … */
    struct segment *parent; /* … and lie on these constraints, or on HM_TRI_NONE */
    size_t n_parent, cap_parent;
    double cos2; /* square of the cosine of the minimum angle */
    double lens; /* square of the cosine of twice that */
    double off;  /* the farthest off-centre, in lengths of the edge */
    double most; /* square of the longest edge */
};

/* Ghosts are outside by region. */
static bool is_inside(const struct refine *r, int32_t tri)
{
    return r->t->region[tri] != r->q->outside && r->t->half[3 * tri].org != HM_TRI_FREE;
}

static double dot_at(const double *o, const double *a, const double *b)
{
    return (a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]);
}

static double length2(const double *a, const double *b)
{
    return dot_at(a, b, b);
}

/* --- what is bad --- */

/* Does p see the edge under more than 180 degrees less twice the minimum angle? (Chew's lens; where
 * no such p is, no triangle on the edge has a circumcentre beyond it and good angles.) */
static bool encroaches(const struct refine *r, int32_t e, const double *p)
{
    const double *a = hm_tri_at(r->t, r->t->half[e].org),
                 *b = hm_tri_at(r->t, hm_tri_dest_of(r->t, e));
    double dot = dot_at(p, a, b);
    return dot < 0 && dot * dot >= r->lens * length2(p, a) * length2(p, b);
}

static enum hm_err push_segment(struct refine *r, int32_t e)
{
    if (!hm_grow(&r->split, &r->cap_split, r->n_split + 1, sizeof *r->split))
        return hm_fail_memory(r->d);
    r->split[r->n_split++] = (struct segment){r->t->half[e].org, hm_tri_dest_of(r->t, e)};
    return HM_OK;
}

static bool is_whole(const struct refine *r, int32_t e)
{
    return (r->t->marks[e] & r->q->whole) != 0;
}

/* Queue a constraint that is too long, or has a vertex too near. */
static enum hm_err check_segment(struct refine *r, int32_t e)
{
    if (!r->t->marks[e] || is_whole(r, e))
        return HM_OK;
    const struct hm_tri *t = r->t;
    bool is_long =
        length2(hm_tri_at(t, t->half[e].org), hm_tri_at(t, hm_tri_dest_of(t, e))) > r->most;
    for (int side = 0; side < 2; side++, e = t->half[e].twin)
        if (is_inside(r, e / 3) &&
            (is_long || encroaches(r, e, hm_tri_at(t, hm_tri_apex_of(t, e)))))
            return push_segment(r, e);
    return HM_OK;
}

/* The corner at which the constraints of two vertices meet, or HM_TRI_NONE. */
static int32_t common_corner(const struct refine *r, int32_t p, int32_t q)
{
    if (p < r->first || q < r->first)
        return HM_TRI_NONE;
    struct segment s = r->parent[p - r->first], u = r->parent[q - r->first];
    if (s.a == HM_TRI_NONE || u.a == HM_TRI_NONE || (s.a == u.a && s.b == u.b))
        return HM_TRI_NONE;
    if (s.a == u.a || s.a == u.b)
        return s.a;
    return s.b == u.a || s.b == u.b ? s.b : HM_TRI_NONE;
}

/* Is the angle opposite e between two constraints? */
static bool is_given(const struct refine *r, int32_t e)
{
    return r->t->marks[hm_tri_next(e)] && r->t->marks[hm_tri_prev(e)];
}

/* Is the shortest edge, e, one between two constraints on a circle about their corner, under the
 * minimum angle there? Then it is the corner that makes it short, and to split its triangle would
 * only make shorter ones. Equally when the small angle is between two constraints itself. */
static bool is_forced(const struct refine *r, int32_t e)
{
    if (is_given(r, e))
        return true;
    int32_t p = r->t->half[e].org, q = hm_tri_dest_of(r->t, e), corner = common_corner(r, p, q);
    if (corner == HM_TRI_NONE)
        return false;
    const double *o = hm_tri_at(r->t, corner), *a = hm_tri_at(r->t, p), *b = hm_tri_at(r->t, q);
    double one = length2(o, a), other = length2(o, b), dot = dot_at(o, a, b);
    return one < 1.001 * other && one > 0.999 * other && dot > 0 &&
           dot * dot > r->cos2 * one * other;
}

static double asked_area(const struct refine *r, double x, double y, int32_t region)
{
    double bound = r->q->max_area > 0 ? r->q->max_area : INFINITY;
    if (r->q->area_at) {
        double here = r->q->area_at(r->q->arg, x, y, region);
        bound = here > 0 && here < bound ? here : bound;
    }
    return bound;
}

static double largest_area(const struct refine *r, const double *a, const double *b,
                           const double *c, int32_t tri)
{
    const struct hm_tri_half *h = r->t->half + 3 * (size_t)tri;
    double bound =
        asked_area(r, (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, hm_tri_region(r->t, tri));
    if (r->q->growth > 0)
        bound = fmin(bound, hm_tri_grade_area(&r->grade, h[0].org, h[1].org, h[2].org));
    return bound;
}

struct verdict {
    int32_t shortest;  /* edge; the smallest angle is opposite */
    double length2;    /* its length squared */
    double dot2, base; /* the square of the cosine of that angle is dot2 / base */
    bool small, large;
};

static inline struct verdict judge(const struct refine *r, int32_t tri)
{
    const struct hm_tri_half *h = r->t->half + 3 * (size_t)tri;
    const double *a = hm_tri_at(r->t, h[0].org), *b = hm_tri_at(r->t, h[1].org);
    const double *c = hm_tri_at(r->t, h[2].org);
    double length[3] = {length2(a, b), length2(b, c), length2(c, a)};
    int least = length[1] < length[0] ? 1 : 0;
    least = length[2] < length[least] ? 2 : least;
    double product = length[0] * length[1] * length[2];
    double dot = (length[0] + length[1] + length[2]) / 2 - length[least];
    struct verdict is = {.shortest = 3 * tri + least, .length2 = length[least]};
    is.dot2 = dot * dot;
    is.base = product / length[least];
    is.small = is.dot2 > r->cos2 * is.base;
    is.large = fmax(length[0], fmax(length[1], length[2])) > r->most ||
               hm_area2(a, b, c) > 2 * largest_area(r, a, b, c, tri);
    return is;
}

static enum hm_err check_triangle(struct refine *r, int32_t tri)
{
    if (!is_inside(r, tri))
        return HM_OK;
    struct verdict is = judge(r, tri);
    if (!is.large && (!is.small || is_forced(r, is.shortest)))
        return HM_OK;
    int32_t e = is.shortest;
    return hm_tri_worklist_push(
        &r->bad,
        (struct hm_tri_work){e,
                             {r->t->half[e].org, hm_tri_dest_of(r->t, e), hm_tri_apex_of(r->t, e)}},
        is.length2, r->d);
}

/* Look at all triangles and constraints around a vertex. */
static enum hm_err check_around(struct refine *r, int32_t v)
{
    int32_t first = r->t->edge[v], e = first;
    enum hm_err err = HM_OK;
    do {
        err = check_segment(r, e);
        if (!err)
            err = check_segment(r, hm_tri_next(e));
        if (!err)
            err = check_triangle(r, e / 3);
        e = hm_tri_turn(r->t, e);
    } while (!err && e != first);
    return err;
}

/* The size at a new vertex; where others become smaller by it, their triangles may be too large. */
static enum hm_err grade(struct refine *r, int32_t v)
{
    const struct hm_tri *t = r->t;
    double own = INFINITY;
    int32_t first = t->edge[v], e = first;
    enum hm_err err = HM_OK;
    if (!(r->q->growth > 0))
        return HM_OK;
    do {
        if (is_inside(r, e / 3))
            own = fmin(
                own, sqrt(asked_area(r, hm_tri_at(t, v)[0], hm_tri_at(t, v)[1], t->region[e / 3]) /
                          0.43301270189221932));
        e = hm_tri_turn(t, e);
    } while (e != first);
    r->grade.n_lowered = 0;
    err = hm_tri_grade_add(&r->grade, t, v, own, r->d);
    for (size_t i = 1; !err && i < r->grade.n_lowered; i++) /* the first is v */
        err = check_around(r, r->grade.lowered[i]);
    return err;
}

static enum hm_err note_parent(struct refine *r, int32_t v, struct segment parent)
{
    r->added++;
    if (!hm_grow(&r->parent, &r->cap_parent, (size_t)(v - r->first) + 1, sizeof *r->parent))
        return hm_fail_memory(r->d);
    r->parent[v - r->first] = parent;
    return HM_OK;
}

/* --- constraints split --- */

/* Vertices of ours inside the circle on the constraint give way: they would make short edges. */
static enum hm_err clear_side(struct refine *r, struct segment s)
{
    struct hm_tri *t = r->t;
    for (;;) {
        int32_t e = hm_tri_edge_between(t, s.a, s.b), v = hm_tri_apex_of(t, e);
        if (v < r->first || r->parent[v - r->first].a != HM_TRI_NONE || !is_inside(r, e / 3) ||
            dot_at(hm_tri_at(t, v), hm_tri_at(t, s.a), hm_tri_at(t, s.b)) >= 0)
            return HM_OK;
        enum hm_err err = hm_tri_remove(t, v, r->d);
        r->done->inside -= !err;
        for (size_t i = 0; !err && i <= t->left.n; i++)
            err = check_around(r, t->left.link[i].v);
        if (err)
            return err;
    }
}

/* Where to split: at the middle; or, when the next constraint is near, at a power of two from the
 * corner between, so that both are split on the same circles. */
static double choose_part(const struct refine *r, int32_t e)
{
    bool at_org = false, at_dest = false;
    int32_t sides[2] = {e, r->t->half[e].twin};
    for (int i = 0; i < 2; i++)
        if (is_inside(r, sides[i] / 3)) {
            bool begin = hm_tri_marks_of(r->t, hm_tri_prev(sides[i])) != 0;
            bool end = hm_tri_marks_of(r->t, hm_tri_next(sides[i])) != 0;
            at_org = at_org || (i ? end : begin);
            at_dest = at_dest || (i ? begin : end);
        }
    if (at_org == at_dest)
        return 0.5;
    int exponent;
    double length =
        sqrt(length2(hm_tri_at(r->t, r->t->half[e].org), hm_tri_at(r->t, hm_tri_dest_of(r->t, e))));
    frexp(length / 1.5, &exponent); /* a power of two in 1/3 .. 2/3 of the length */
    double part = ldexp(1, exponent - 1) / length;
    return at_org ? part : 1 - part;
}

/* Split e; where that would fold a triangle, because those outside are no thicker than rounding
 * made them, a few last digits into the triangle of e. HM_EGEOM when it is too short for that too.
 */
static enum hm_err split_near(struct refine *r, int32_t e, int32_t *v)
{
    struct hm_tri *t = r->t;
    const double *a = hm_tri_at(t, t->half[e].org), *b = hm_tri_at(t, hm_tri_dest_of(t, e));
    double part = choose_part(r, e), p[2];
    for (int k = 0; k < 2; k++)
        p[k] = a[k] + part * (b[k] - a[k]);
    enum hm_err err = hm_tri_split(t, e, p[0], p[1], v, NULL);
    if (err != HM_EGEOM)
        return err;
    if (!is_inside(r, e / 3))
        e = t->half[e].twin;
    const double *apex = hm_tri_at(t, hm_tri_apex_of(t, e));
    double step = DBL_EPSILON * (fabs(p[0]) + fabs(p[1])) / sqrt(length2(apex, p));
    for (int i = 0; i < 4 && err == HM_EGEOM; i++, step *= 2)
        err = hm_tri_split(t, e, p[0] + step * (apex[0] - p[0]), p[1] + step * (apex[1] - p[1]), v,
                           NULL);
    return err;
}

static struct segment parent_of(const struct refine *r, struct segment s)
{
    int32_t ends[2] = {s.a, s.b};
    for (int i = 0; i < 2; i++)
        if (ends[i] >= r->first && r->parent[ends[i] - r->first].a != HM_TRI_NONE)
            return r->parent[ends[i] - r->first];
    return s;
}

static enum hm_err split_segment(struct refine *r, struct segment s)
{
    struct hm_tri *t = r->t;
    int32_t e = hm_tri_edge_between(t, s.a, s.b), v;
    if (e == HM_TRI_NONE || !hm_tri_marks_of(t, e))
        return HM_OK;
    enum hm_err err = clear_side(r, s);
    if (!err)
        err = clear_side(r, (struct segment){s.b, s.a});
    if (err)
        return err;
    err = split_near(r, hm_tri_edge_between(t, s.a, s.b), &v);
    if (err == HM_EGEOM)
        return HM_OK;
    if (err)
        return hm_fail_memory(r->d);
    err = note_parent(r, v, parent_of(r, s));
    r->done->on_segments += !err;
    if (!err)
        err = grade(r, v);
    return err ? err : check_around(r, v);
}

/* --- triangles split --- */

/* The circumcentre; or, when that is far from the shortest edge, the point before it on the way
 * there that makes just a good enough triangle with it. */
static void off_centre(const struct refine *r, int32_t e, double *p)
{
    const double *a = hm_tri_at(r->t, r->t->half[e].org),
                 *b = hm_tri_at(r->t, hm_tri_dest_of(r->t, e));
    const double *c = hm_tri_at(r->t, hm_tri_apex_of(r->t, e));
    double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    double bb = bx * bx + by * by, cc = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
    double x = (cy * bb - by * cc) / twice, y = (bx * cc - cx * bb) / twice;
    double ox = 0.5 * bx - r->off * by, oy = 0.5 * by + r->off * bx;
    if (r->off > 0 && ox * ox + oy * oy < x * x + y * y) {
        x = ox;
        y = oy;
    }
    p[0] = a[0] + x;
    p[1] = a[1] + y;
}

static bool is_there(const struct hm_tri *t, const struct hm_tri_work *work)
{
    const struct hm_tri_half *half = t->half;
    return half[work->e].org == work->v[0] && half[hm_tri_next(work->e)].org == work->v[1] &&
           half[hm_tri_prev(work->e)].org == work->v[2];
}

enum place { GOOD, TAKEN, BLOCKED };

/* Of the constraints that have p beyond them, the one on the straight way there from the triangle.
 */
static bool is_on_way(const struct refine *r, int32_t tri, size_t rim, const double *p)
{
    const struct hm_tri *t = r->t;
    const double *a = hm_tri_at(t, r->cavity.rim[rim].org);
    const double *b = hm_tri_at(t, hm_tri_cavity_dest(&r->cavity, rim));
    double from[2] = {0, 0};
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++)
        for (int k = 0; k < 2; k++)
            from[k] += hm_tri_at(t, t->half[e].org)[k] / 3;
    return hm_area2(from, p, a) <= 0 && hm_area2(from, p, b) >= 0;
}

/* Queue a constraint of the rim, or note that it may not be split. */
static enum hm_err give_up(struct refine *r, size_t rim, enum place *place)
{
    if (is_whole(r, r->cavity.rim[rim].outer)) {
        *place = TAKEN;
        return HM_OK;
    }
    *place = *place == TAKEN ? TAKEN : BLOCKED;
    return push_segment(r, r->cavity.rim[rim].outer);
}

/* May a vertex be put at p, in the cavity found from the triangle? BLOCKED: constraints that are in
 * the way, or would have it too near, are queued. TAKEN: one of them may not be split, or doubles
 * cannot tell p from what is there. */
static enum hm_err check_place(struct refine *r, int32_t tri, const double *p, enum place *place)
{
    const struct hm_tri_cavity *c = &r->cavity;
    enum hm_err err = HM_OK;
    bool beyond = false;
    *place = GOOD;
    for (size_t i = 0; !err && i < c->n_rim; i++)
        if (hm_pred_orient_fast(hm_tri_at(r->t, c->rim[i].org),
                                hm_tri_at(r->t, hm_tri_cavity_dest(c, i)), p) <= 0) {
            beyond = true;
            if (c->rim[i].marks && is_on_way(r, tri, i, p))
                err = give_up(r, i, place);
        }
    if (beyond && *place == GOOD)
        *place = TAKEN;
    for (size_t i = 0; !err && !beyond && i < c->n_rim; i++)
        if (c->rim[i].marks && encroaches(r, c->rim[i].outer, p))
            err = give_up(r, i, place);
    return err;
}

static enum hm_err split_triangle(struct refine *r, const struct hm_tri_work *work,
                                  enum place *place)
{
    double p[2];
    int32_t v, tri = work->e / 3;
    *place = TAKEN;
    off_centre(r, work->e, p);
    if (!isfinite(p[0]) || !isfinite(p[1]) ||
        hm_pred_incircle_fast(hm_tri_at(r->t, work->v[0]), hm_tri_at(r->t, work->v[1]),
                              hm_tri_at(r->t, work->v[2]), p) <= 0)
        return HM_OK;
    enum hm_err err = hm_tri_cavity_find(&r->cavity, r->t, p, tri, r->d);
    if (!err)
        err = check_place(r, tri, p, place);
    if (err || *place != GOOD)
        return err;
    err = hm_tri_cavity_fill(&r->cavity, r->t, p, &v, r->d);
    if (!err)
        err = note_parent(r, v, (struct segment){HM_TRI_NONE, HM_TRI_NONE});
    r->done->inside += !err;
    if (!err)
        err = grade(r, v);
    for (size_t i = 0; !err && i < r->cavity.n_tri; i++)
        err = check_triangle(r, r->cavity.tri[i]);
    return err;
}

/* --- all of it --- */

/* The outline of what is refined is made of constraints, and beyond it is outside. */
static enum hm_err close_outline(struct refine *r)
{
    struct hm_tri *t = r->t;
    enum hm_err err = hm_tri_need_edges(t, r->d);
    if (!err)
        err = hm_tri_need_marks(t, r->d);
    if (!err)
        err = hm_tri_need_regions(t, r->d);
    for (int32_t e = 0; !err && e < 3 * t->triangles; e++) {
        if (t->half[e - e % 3].org == HM_TRI_FREE || !hm_tri_is_ghost(t, e / 3))
            continue;
        t->region[e / 3] = r->q->outside;
        if (hm_tri_apex_of(t, e) == HM_TRI_INFINITY && !t->marks[e])
            hm_tri_set_marks(t, e, r->q->hull_marks);
    }
    return err;
}

static bool is_full(struct refine *r)
{
    r->done->capped = r->q->most > 0 && r->added >= r->q->most;
    return r->done->capped;
}

static enum hm_err split_segments(struct refine *r)
{
    enum hm_err err = HM_OK;
    while (!err && r->n_split > 0 && !is_full(r))
        err = split_segment(r, r->split[--r->n_split]);
    return err;
}

/* Split a triangle, first the constraints in its way; those that cannot be split end it. */
static enum hm_err mend(struct refine *r, const struct hm_tri_work *work)
{
    enum hm_err err = HM_OK;
    enum place place = BLOCKED;
    while (!err && place == BLOCKED && is_there(r->t, work) && !is_full(r)) {
        int64_t added = r->added;
        err = split_triangle(r, work, &place);
        if (!err)
            err = split_segments(r);
        if (added == r->added)
            break;
    }
    return err;
}

static void fetch_soon(const struct refine *r)
{
    const struct hm_tri_work *soon = hm_tri_worklist_soon(&r->bad);
    if (soon) {
        __builtin_prefetch(r->t->half + soon->e);
        __builtin_prefetch(hm_tri_at(r->t, soon->v[2]));
    }
}

static enum hm_err refine(struct refine *r)
{
    struct hm_tri_work work;
    enum hm_err err = close_outline(r);
    if (!err && r->q->growth > 0)
        err = hm_tri_grade_start(&r->grade, r->t, r->q->growth, r->q->outside, r->d);
    for (int32_t e = 0; !err && e < 3 * r->t->triangles; e++)
        if (is_inside(r, e / 3))
            err = check_segment(r, e);
    for (int32_t k = 0; !err && k < r->t->triangles; k++)
        err = check_triangle(r, k);
    if (!err)
        err = split_segments(r);
    while (!err && !is_full(r) && hm_tri_worklist_pop(&r->bad, &work)) {
        fetch_soon(r);
        err = mend(r, &work);
    }
    return err;
}

static double degrees(double cos2)
{
    return acos(sqrt(fmin(cos2, 1))) * 180 / acos(-1);
}

static void report(struct refine *r)
{
    struct hm_tri_refined *done = r->done;
    double most = 0;
    for (int32_t k = 0; k < r->t->triangles; k++) {
        if (!is_inside(r, k))
            continue;
        struct verdict is = judge(r, k);
        double cos2 = is.dot2 / is.base;
        int32_t v = hm_tri_apex_of(r->t, is.shortest);
        const double *apex = hm_tri_at(r->t, v);
        bool given = is.small && is_given(r, is.shortest);
        done->small += is.small;
        done->given += given;
        done->large += is.large;
        if (is.small && r->q->sharp)
            r->q->sharp(r->q->sharp_arg,
                        &(struct hm_tri_sharp){apex[0], apex[1], degrees(cos2), v, given});
        if (cos2 > most) {
            most = cos2;
            done->x = apex[0];
            done->y = apex[1];
        }
    }
    done->smallest = degrees(most);
}

enum hm_err hm_tri_refine(struct hm_tri *t, const struct hm_tri_quality *q,
                          struct hm_tri_refined *done, struct hm_diag *d)
{
    struct hm_tri_refined unasked;
    if (!(q->min_angle >= 0 && q->min_angle <= 40) || !(q->max_area >= 0) || !(q->max_edge >= 0) ||
        !(q->growth >= 0) || q->hull_marks == 0)
        return hm_fail(d, HM_EARG, "bounds of the refinement are out of range");
    struct refine *r = hm_alloc0(1, sizeof *r);
    if (!r)
        return hm_fail_memory(d);
    double angle = q->min_angle * acos(-1) / 180;
    *r = (struct refine){.t = t, .q = q, .done = done ? done : &unasked, .d = d};
    *r->done = (struct hm_tri_refined){0};
    r->first = t->vertices;
    r->cos2 = q->min_angle > 0 ? cos(angle) * cos(angle) : 2;
    r->lens = cos(2 * angle) * cos(2 * angle);
    r->off = q->min_angle > 0 ? 0.36 * sqrt((1 + cos(angle)) / (1 - cos(angle))) : 0;
    r->most = q->max_edge > 0 ? q->max_edge * q->max_edge : INFINITY;
    hm_tri_worklist_init(&r->bad);
    enum hm_err err = refine(r);
    if (!err)
        report(r);
    hm_tri_cavity_free(&r->cavity);
    hm_tri_grade_free(&r->grade);
    free(r->bad.block);
    free(r->split);
    free(r->parent);
    free(r);
    return err;
}
