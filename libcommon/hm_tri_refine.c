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
    struct hm_tri_worklist large; /* triangles over their area; all before … */
    struct hm_tri_worklist small; /* … those that only have an angle under the minimum */
    struct hm_tri_cavity cavity;
    struct hm_tri_grade grade;
    struct segment *split; /* constraints to be split, a stack */
    size_t n_split, cap_split;
    int64_t added;          /* vertices, those taken out again included */
    int32_t first;          /* vertices from here on are ours … */
    struct segment *parent; /* … and lie on these constraints, or on HM_TRI_NONE */
    size_t n_parent, cap_parent;
    double *stuck; /* by vertex: of the longest constraint there that could not be split, the square
                    * of its length, or 0 */
    size_t n_stuck, cap_stuck;
    double cos2;      /* square of the cosine of the minimum angle */
    double lens;      /* square of the cosine of twice that */
    double off;       /* the farthest off-centre, in lengths of the edge */
    double most;      /* square of the longest edge */
    double most_area; /* infinite: no bound … */
    bool varies;      /* … or smaller ones, from place to place */
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

/* Has it turned out that the constraint e cannot be split, or a longer one at each of its ends? */
static bool is_stuck(const struct refine *r, int32_t e)
{
    int32_t ends[2] = {r->t->half[e].org, hm_tri_dest_of(r->t, e)};
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        least = (size_t)ends[i] < r->n_stuck ? fmin(least, r->stuck[ends[i]]) : 0;
    return least > 0 && length2(hm_tri_at(r->t, ends[0]), hm_tri_at(r->t, ends[1])) <= least;
}

static bool is_whole(const struct refine *r, int32_t e)
{
    return (r->t->marks[e] & r->q->whole) || (r->n_stuck > 0 && is_stuck(r, e));
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

/* The corner that makes the edge e short: it is one between two constraints on a circle about the
 * place where they meet, under the minimum angle there; or HM_TRI_NONE. */
static int32_t forcing_corner(const struct refine *r, int32_t e)
{
    int32_t p = r->t->half[e].org, q = hm_tri_dest_of(r->t, e), corner = common_corner(r, p, q);
    if (corner == HM_TRI_NONE)
        return HM_TRI_NONE;
    const double *o = hm_tri_at(r->t, corner), *a = hm_tri_at(r->t, p), *b = hm_tri_at(r->t, q);
    double one = length2(o, a), other = length2(o, b), dot = dot_at(o, a, b);
    bool forced =
        one < 1.001 * other && one > 0.999 * other && dot > 0 && dot * dot > r->cos2 * one * other;
    return forced ? corner : HM_TRI_NONE;
}

static double asked_area(const struct refine *r, double x, double y, int32_t region)
{
    double bound = r->most_area;
    if (r->q->area_at) {
        double here = r->q->area_at(r->q->arg, x, y, region);
        bound = here > 0 && here < bound ? here : bound;
    }
    return bound;
}

static double largest_area(const struct refine *r, int32_t tri)
{
    const struct hm_tri_half *h = r->t->half + 3 * (size_t)tri;
    const double *a = hm_tri_at(r->t, h[0].org), *b = hm_tri_at(r->t, h[1].org);
    const double *c = hm_tri_at(r->t, h[2].org);
    double bound =
        asked_area(r, (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, hm_tri_region(r->t, tri));
    if (r->q->growth > 0)
        bound = fmin(bound, hm_tri_grade_area(&r->grade, h[0].org, h[1].org, h[2].org));
    return bound;
}

/* The squares of a triangle's edges, 3 tri + i the i-th, and twice its area. */
struct shape {
    double length2[3], area2;
};

static struct shape shape_of(const struct refine *r, int32_t tri)
{
    const struct hm_tri_half *h = r->t->half + 3 * (size_t)tri;
    const double *a = hm_tri_at(r->t, h[0].org), *b = hm_tri_at(r->t, h[1].org);
    const double *c = hm_tri_at(r->t, h[2].org);
    return (struct shape){{length2(a, b), length2(b, c), length2(c, a)}, hm_area2(a, b, c)};
}

struct verdict {
    int32_t shortest;   /* edge; the smallest angle is opposite */
    double length2;     /* its length squared */
    double dot, others; /* the square of that angle's cosine is dot^2 / others; dot > 0 */
    bool small, large;
};

/* Without branches: what comes out is as good as random. */
static inline struct verdict judge(const struct refine *r, int32_t tri, const struct shape *s)
{
    double a = s->length2[0], b = s->length2[1], c = s->length2[2];
    double ab = a < b ? a : b, least = ab < c ? ab : c, product = a * b * c;
    int last = c < ab, middle = (b < a) & !last;
    struct verdict is = {.shortest = 3 * tri + middle + 2 * last, .length2 = least};
    is.dot = (a + b + c) / 2 - least;
    is.small = is.dot * is.dot * least > r->cos2 * product;
    is.large = (a > r->most) | (b > r->most) | (c > r->most) |
               (s->area2 > 2 * (r->varies ? largest_area(r, tri) : r->most_area));
    is.others = product / least;
    return is;
}

static enum hm_err queue_bad(struct refine *r, int32_t tri, const struct shape *shape)
{
    struct verdict is = judge(r, tri, shape);
    if (!is.large && (!is.small || is_given(r, is.shortest)))
        return HM_OK;
    const struct hm_tri_half *h = r->t->half + 3 * (size_t)tri;
    struct hm_tri_work work = {is.shortest, {h[0].org, h[1].org, h[2].org}};
    return hm_tri_worklist_push(is.large ? &r->large : &r->small, work, is.length2, r->d);
}

static enum hm_err check_triangle(struct refine *r, int32_t tri)
{
    if (!is_inside(r, tri))
        return HM_OK;
    struct shape shape = shape_of(r, tri);
    return queue_bad(r, tri, &shape);
}

/* The triangles that fill the cavity around a new vertex at p: each spoke is measured once. */
static enum hm_err check_fan(struct refine *r, const double *p)
{
    const struct hm_tri_cavity *c = &r->cavity;
    const double *a = hm_tri_at(r->t, c->rim[0].org);
    double ax = a[0] - p[0], ay = a[1] - p[1], aa = ax * ax + ay * ay;
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < c->n_rim; i++) {
        const double *b = hm_tri_at(r->t, hm_tri_cavity_dest(c, i));
        double bx = b[0] - p[0], by = b[1] - p[1], bb = bx * bx + by * by;
        double dx = bx - ax, dy = by - ay;
        struct shape shape = {{dx * dx + dy * dy, bb, aa}, ax * by - ay * bx};
        if (c->rim[i].region != r->q->outside)
            err = queue_bad(r, c->tri[i], &shape);
        ax = bx;
        ay = by;
        aa = bb;
    }
    return err;
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
                          HM_TRI_EQUILATERAL));
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

/* Split e; where that would fold a triangle that is no thicker than rounding made it, a few last
 * digits beside it, into the triangle of e: towards its apex, or straight away from e when the apex
 * is far along it. HM_EGEOM when there is no place. */
static enum hm_err split_near(struct refine *r, int32_t e, int32_t *v)
{
    struct hm_tri *t = r->t;
    if (!is_inside(r, e / 3))
        e = t->half[e].twin;
    const double *a = hm_tri_at(t, t->half[e].org), *b = hm_tri_at(t, hm_tri_dest_of(t, e));
    double part = choose_part(r, e), p[2];
    for (int k = 0; k < 2; k++)
        p[k] = a[k] + part * (b[k] - a[k]);
    enum hm_err err = hm_tri_split(t, e, p[0], p[1], v, NULL);
    if (err != HM_EGEOM)
        return err;
    const double *apex = hm_tri_at(t, hm_tri_apex_of(t, e));
    double way[2][2] = {{apex[0] - p[0], apex[1] - p[1]}, {a[1] - b[1], b[0] - a[0]}};
    for (int i = 0; i < 8 && err == HM_EGEOM; i++) {
        const double *w = way[i % 2];
        double step = ldexp(DBL_EPSILON * (fabs(p[0]) + fabs(p[1])), i / 2) / hypot(w[0], w[1]);
        err = hm_tri_split(t, e, p[0] + step * w[0], p[1] + step * w[1], v, NULL);
    }
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

/* The constraint s cannot be split, and vertices beside it were taken out to try. That shall not
 * happen again: they would be put in and taken out for ever. */
static enum hm_err note_stuck(struct refine *r, struct segment s)
{
    size_t n = (size_t)r->t->vertices;
    double here = length2(hm_tri_at(r->t, s.a), hm_tri_at(r->t, s.b));
    if (!hm_grow(&r->stuck, &r->cap_stuck, n, sizeof *r->stuck))
        return hm_fail_memory(r->d);
    while (r->n_stuck < n)
        r->stuck[r->n_stuck++] = 0;
    r->stuck[s.a] = fmax(r->stuck[s.a], here);
    r->stuck[s.b] = fmax(r->stuck[s.b], here);
    return HM_OK;
}

static enum hm_err split_segment(struct refine *r, struct segment s)
{
    struct hm_tri *t = r->t;
    int32_t e = hm_tri_edge_between(t, s.a, s.b), v;
    int64_t before = r->done->inside;
    if (e == HM_TRI_NONE || !hm_tri_marks_of(t, e) || is_whole(r, e))
        return HM_OK;
    enum hm_err err = clear_side(r, s);
    if (!err)
        err = clear_side(r, (struct segment){s.b, s.a});
    if (err)
        return err;
    err = split_near(r, hm_tri_edge_between(t, s.a, s.b), &v);
    if (err == HM_EGEOM)
        return r->done->inside < before ? note_stuck(r, s) : HM_OK;
    if (err)
        return hm_fail_memory(r->d);
    err = note_parent(r, v, parent_of(r, s));
    r->done->on_segments += !err;
    if (!err)
        err = grade(r, v);
    return err ? err : check_around(r, v);
}

/* --- triangles split --- */

/* How far from edge e, in its lengths, a new vertex may be: so near that it makes a good enough
 * angle with the edge; and, as long as angles to 30 degrees are asked, so near that it also makes a
 * triangle within its area, though not much flatter than an equilateral one. The mesh then grows
 * from its short edges inwards as an advancing front (Rebay 1993, Efficient unstructured mesh
 * generation by means of Delaunay triangulation), a fifth fewer triangles for the same area. Over
 * 30 degrees circumcentres may make edges shorter than those there were, and a front that fills the
 * area leaves them no room. */
static double farthest(const struct refine *r, int32_t e, double length2)
{
    if (r->q->min_angle > 30)
        return r->off;
    double most =
        fmin(r->varies ? largest_area(r, e / 3) : r->most_area, HM_TRI_EQUILATERAL * r->most);
    return fmin(r->off, fmax(0.9 * 2 * most / length2, 0.8));
}

/* The circumcentre; or, when that is far from the shortest edge, a point before it on the way
 * there. */
static void off_centre(const struct refine *r, int32_t e, double *p)
{
    const double *a = hm_tri_at(r->t, r->t->half[e].org),
                 *b = hm_tri_at(r->t, hm_tri_dest_of(r->t, e));
    const double *c = hm_tri_at(r->t, hm_tri_apex_of(r->t, e));
    double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    double bb = bx * bx + by * by, cc = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
    double x = (cy * bb - by * cc) / twice, y = (bx * cc - cx * bb) / twice;
    double off = farthest(r, e, bb), ox = 0.5 * bx - off * by, oy = 0.5 * by + off * bx;
    if (ox * ox + oy * oy < x * x + y * y) {
        x = ox;
        y = oy;
    }
    p[0] = a[0] + x;
    p[1] = a[1] + y;
}

static bool is_there(const struct hm_tri *t, const struct hm_tri_work *work)
{
    const struct hm_tri_half *h = t->half + work->e / 3 * 3;
    return h[0].org == work->v[0] && h[1].org == work->v[1] && h[2].org == work->v[2];
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
 * cannot tell p from what is there.
 *
 * Only constraints of the rim can have p beyond them. At any other edge the circle inside holds p
 * and the one outside does not; beyond the edge the one outside holds all that the other does. */
static enum hm_err check_place(struct refine *r, int32_t tri, const double *p, enum place *place)
{
    const struct hm_tri_cavity *c = &r->cavity;
    enum hm_err err = HM_OK;
    bool beyond = false;
    *place = GOOD;
    for (size_t i = 0; !err && i < c->n_rim; i++)
        if (c->rim[i].marks &&
            hm_pred_orient_fast(hm_tri_at(r->t, c->rim[i].org),
                                hm_tri_at(r->t, hm_tri_cavity_dest(c, i)), p) <= 0) {
            beyond = true;
            if (is_on_way(r, tri, i, p))
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
    return err ? err : check_fan(r, p);
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

/* Squares of squares of lengths must be neither zero nor infinite. */
static enum hm_err check_extent(const struct hm_tri *t, struct hm_diag *d)
{
    double extent = 0;
    for (int32_t i = 2; i < 2 * t->vertices; i++)
        extent = fmax(extent, fabs(t->xy[i] - t->xy[i % 2]));
    if (extent > 1e-50 && extent < 1e50)
        return HM_OK;
    return hm_fail(d, HM_EGEOM, "points that extend over %g cannot be refined", extent);
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

/* The triangle of e, its shortest edge, cannot be split before the queued constraints are. Is it
 * small by force of a corner only, and would that take another circle about it: within the
 * smallest, or between two that are a doubling apart? */
static bool is_spared(const struct refine *r, int32_t e)
{
    int32_t corner = forcing_corner(r, e);
    struct shape shape = shape_of(r, e / 3);
    if (corner == HM_TRI_NONE || judge(r, e / 3, &shape).large)
        return false;
    bool another = false;
    for (size_t i = 0; i < r->n_split; i++) {
        const double *o = hm_tri_at(r->t, corner);
        double one = length2(o, hm_tri_at(r->t, r->split[i].a));
        double other = length2(o, hm_tri_at(r->t, r->split[i].b));
        another = another || fmax(one, other) < 4.2 * fmin(one, other) || fmin(one, other) == 0;
    }
    return another;
}

/* Split a triangle, first the constraints in its way; those that cannot or shall not be split end
 * it. */
static enum hm_err mend(struct refine *r, const struct hm_tri_work *work)
{
    enum hm_err err = HM_OK;
    enum place place = BLOCKED;
    while (!err && place == BLOCKED && is_there(r->t, work) && !is_full(r)) {
        int64_t added = r->added;
        err = split_triangle(r, work, &place);
        if (place == BLOCKED && is_spared(r, work->e))
            r->n_split = 0;
        if (!err)
            err = split_segments(r);
        if (added == r->added)
            break;
    }
    return err;
}

static void fetch_soon(const struct refine *r)
{
    const struct hm_tri *t = r->t;
    const struct hm_tri_worklist *list = r->large.lowest < HM_TRI_LISTS ? &r->large : &r->small;
    const struct hm_tri_work *later = hm_tri_worklist_soon(list, 7);
    const struct hm_tri_work *soon = hm_tri_worklist_soon(list, 3);
    if (later)
        __builtin_prefetch(t->half + later->e);
    if (soon && is_there(t, soon)) {
        const struct hm_tri_half *h = t->half + soon->e / 3 * 3;
        for (int i = 0; i < 3; i++) {
            __builtin_prefetch(hm_tri_at(t, h[i].org));
            __builtin_prefetch(t->half + h[i].twin);
        }
    }
}

/* Large triangles by their newest: what is in the cache. Where angles decide, the oldest first
 * makes fewer triangles. */
static bool take_work(struct refine *r, struct hm_tri_work *work)
{
    return hm_tri_worklist_pop(&r->large, work) || hm_tri_worklist_pop(&r->small, work);
}

static enum hm_err refine(struct refine *r)
{
    struct hm_tri_work work;
    enum hm_err err = check_extent(r->t, r->d);
    if (!err)
        err = close_outline(r);
    if (!err && r->q->growth > 0)
        err = hm_tri_grade_start(&r->grade, r->t, r->q->growth, r->q->outside, r->d);
    for (int32_t e = 0; !err && e < 3 * r->t->triangles; e++)
        if (is_inside(r, e / 3))
            err = check_segment(r, e);
    for (int32_t k = 0; !err && k < r->t->triangles; k++)
        err = check_triangle(r, k);
    if (!err)
        err = split_segments(r);
    while (!err && !is_full(r) && take_work(r, &work)) {
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
        struct shape shape = shape_of(r, k);
        struct verdict is = judge(r, k, &shape);
        double cos2 = is.dot * is.dot / is.others;
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
    r->most = q->max_edge > 0 ? q->max_edge * q->max_edge : INFINITY;
    r->most_area = q->max_area > 0 ? q->max_area : INFINITY;
    r->varies = q->area_at || q->growth > 0;
    r->off = q->min_angle > 0 ? 0.36 * sqrt((1 + cos(angle)) / (1 - cos(angle))) : INFINITY;
    hm_tri_worklist_init(&r->large, true);
    hm_tri_worklist_init(&r->small, false);
    enum hm_err err = refine(r);
    if (!err && (done || q->sharp))
        report(r);
    hm_tri_cavity_free(&r->cavity);
    hm_tri_grade_free(&r->grade);
    free(r->large.block);
    free(r->small.block);
    free(r->split);
    free(r->parent);
    free(r->stuck);
    free(r);
    return err;
}
