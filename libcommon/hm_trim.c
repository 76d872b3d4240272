/* hm_trim: see hm_trim.h. */
#include "hm_trim.h"
#include "hm_plane.h"
#include "hm_pred.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdlib.h>

/* A node as the fixed edges see it. */
struct vertex {
    int32_t edge[2]; /* of a plain one; HM_TRI_NONE */
    bool plain;      /* nothing but a vertex of one breakline, or its loose end */
    bool gone;
};

struct trim {
    struct hm_domain *dom;
    double least;
    struct vertex *vertex;     /* by node */
    bool *gone;                /* by edge */
    struct hm_segindex *index; /* the edges as they were: those now are nowhere `least` off */
};

static const double *at(const struct trim *t, int32_t node)
{
    return &t->dom->node[node].x;
}

static double distance(const struct trim *t, int32_t a, int32_t b)
{
    return sqrt(hm_node_distance2(&t->dom->node[a], &t->dom->node[b]));
}

static enum hm_err start(struct trim *t, struct hm_diag *d)
{
    const struct hm_domain *dom = t->dom;
    t->vertex = hm_alloc(dom->nnodes, sizeof *t->vertex);
    t->gone = hm_alloc0(dom->nedges, sizeof *t->gone);
    struct hm_segment *s = hm_alloc0(dom->nedges, sizeof *s);
    if (!t->vertex || !t->gone || !s) {
        free(s);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < dom->nnodes; i++)
        t->vertex[i] = (struct vertex){.edge = {HM_TRI_NONE, HM_TRI_NONE}, .plain = true};
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_domain_edge *e = &dom->edge[k];
        const int32_t end[2] = {e->a, e->b};
        for (int i = 0; i < 2; i++) {
            struct vertex *v = &t->vertex[end[i]];
            int free_slot = v->edge[0] == HM_TRI_NONE ? 0 : v->edge[1] == HM_TRI_NONE ? 1 : 2;
            v->plain = v->plain && free_slot < 2 && e->marks == HM_EDGE_BREAKLINE;
            if (free_slot < 2)
                v->edge[free_slot] = (int32_t)k;
        }
        const double *a = at(t, e->a), *b = at(t, e->b);
        s[k] = (struct hm_segment){{a[0], a[1], 0}, {b[0], b[1], 0}, (int32_t)k, 0};
    }
    enum hm_err err = hm_segindex_build(&t->index, s, dom->nedges, d);
    free(s);
    return err;
}

/* --- what is in the way --- */

struct search {
    const struct trim *t;
    int32_t a, b, c; /* the triangle that the line sweeps; or the loose end: b */
    bool found;
};

/* In the triangle a, b, c or on its border, exactly. */
static bool is_swept(const struct search *s, const double *p)
{
    const double *corner[3] = {at(s->t, s->a), at(s->t, s->b), at(s->t, s->c)};
    bool left = false, right = false;
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        int side = hm_pred_orient(corner[i], corner[(i + 1) % 3], p);
        left = left || side > 0;
        right = right || side < 0;
        for (int k = 0; k < 2; k++) {
            lo[k] = fmin(lo[k], corner[i][k]);
            hi[k] = fmax(hi[k], corner[i][k]);
        }
    }
    /* the box decides for triangles without area */
    return !(left && right) && lo[0] <= p[0] && p[0] <= hi[0] && lo[1] <= p[1] && p[1] <= hi[1];
}

/* Would this edge be swept over or met, when the line goes from a straight to c? */
static bool blocks(void *arg, const struct hm_segment *segment)
{
    struct search *s = arg;
    const struct hm_domain_edge *e = &s->t->dom->edge[segment->line];
    if (s->t->gone[segment->line] || e->a == s->b || e->b == s->b)
        return true;
    bool from = e->a == s->a || e->a == s->c, to = e->b == s->a || e->b == s->c;
    const double *p = at(s->t, e->a), *q = at(s->t, e->b);
    s->found = (from && to) || (!from && is_swept(s, p)) || (!to && is_swept(s, q)) ||
               (!from && !to && hm_plane_meet(p, q, at(s->t, s->a), at(s->t, s->c)));
    return !s->found;
}

static bool is_border_near(void *arg, const struct hm_segment *segment)
{
    struct search *s = arg;
    const struct hm_domain_edge *e = &s->t->dom->edge[segment->line];
    s->found = (e->marks & HM_EDGE_BORDER) &&
               hm_plane_distance(at(s->t, s->b), at(s->t, e->a), at(s->t, e->b)) < s->t->least;
    return !s->found;
}

/* Ask every edge near the nodes a, b, c. */
static bool find(const struct trim *t, int32_t a, int32_t b, int32_t c,
                 bool (*see)(void *, const struct hm_segment *))
{
    struct search s = {t, a, b, c, false};
    double lo[2], hi[2];
    for (int k = 0; k < 2; k++) {
        lo[k] = fmin(at(t, a)[k], fmin(at(t, b)[k], at(t, c)[k])) - t->least;
        hi[k] = fmax(at(t, a)[k], fmax(at(t, b)[k], at(t, c)[k])) + t->least;
    }
    hm_segindex_box(t->index, lo, hi, see, &s);
    return s.found;
}

/* --- leaving out --- */

static int32_t other_end(const struct hm_domain_edge *e, int32_t node)
{
    return e->a == node ? e->b : e->a;
}

/* Edge e ends in the loose end b: both go, and the other end is the loose one. */
static void shorten(struct trim *t, int32_t e, int32_t b)
{
    int32_t a = other_end(&t->dom->edge[e], b);
    struct vertex *v = &t->vertex[a];
    t->gone[e] = t->vertex[b].gone = true;
    if (!v->plain)
        return;
    if (v->edge[0] == e)
        v->edge[0] = v->edge[1];
    v->edge[1] = HM_TRI_NONE;
    v->gone = v->edge[0] == HM_TRI_NONE;
}

/* Edge f takes the place of e at its end. */
static void relink(struct vertex *v, int32_t e, int32_t f)
{
    for (int i = 0; i < 2; i++)
        if (v->edge[i] == e)
            v->edge[i] = f;
}

/* Edge e goes from a to the plain vertex b, which may be left out or not. */
static bool straighten(struct trim *t, int32_t e, int32_t a, int32_t b)
{
    const struct vertex *v = &t->vertex[b];
    int32_t f = v->edge[v->edge[0] == e];
    struct hm_domain_edge *next = &t->dom->edge[f];
    if (find(t, a, b, other_end(next, b), blocks))
        return false;
    *(next->a == b ? &next->a : &next->b) = a;
    relink(&t->vertex[a], e, f);
    t->gone[e] = t->vertex[b].gone = true;
    return true;
}

/* The edge seen from its end a; is its end b left out? */
static bool trim_end(struct trim *t, int32_t e, int32_t a, int32_t b)
{
    const struct vertex *v = &t->vertex[b];
    if (!v->plain)
        return false;
    bool is_short = !t->vertex[a].plain && distance(t, a, b) < t->least;
    if (v->edge[1] != HM_TRI_NONE)
        return is_short && straighten(t, e, a, b);
    if (!is_short && !find(t, b, b, b, is_border_near))
        return false;
    shorten(t, e, b);
    return true;
}

/* Is b the tip of a spike, and left out? Its neighbours are near each other, and not near it. */
static bool trim_spike(struct trim *t, int32_t b)
{
    const struct vertex *v = &t->vertex[b];
    if (v->gone || !v->plain || v->edge[1] == HM_TRI_NONE)
        return false;
    const struct hm_domain_edge *edge = t->dom->edge;
    int32_t a = other_end(&edge[v->edge[0]], b), c = other_end(&edge[v->edge[1]], b);
    return distance(t, a, c) < t->least && distance(t, a, b) >= t->least &&
           distance(t, b, c) >= t->least && straighten(t, v->edge[0], a, b);
}

static enum hm_err finish(struct trim *t, int64_t *n, struct hm_diag *d)
{
    struct hm_domain *dom = t->dom;
    bool *gone = hm_alloc(dom->nnodes, sizeof *gone);
    if (!gone)
        return hm_fail_memory(d);
    size_t edges = 0;
    for (size_t k = 0; k < dom->nedges; k++)
        if (!t->gone[k])
            dom->edge[edges++] = dom->edge[k];
    dom->nedges = edges;
    *n = 0;
    for (size_t i = 0; i < dom->nnodes; i++) {
        gone[i] = t->vertex[i].gone;
        *n += gone[i];
    }
    enum hm_err err = *n > 0 ? hm_domain_remove(dom, gone, d) : HM_OK;
    free(gone);
    return err;
}

enum hm_err hm_trim_breaklines(struct hm_domain *dom, double least, int threads, int64_t *n,
                               struct hm_diag *d)
{
    struct trim t = {.dom = dom, .least = least};
    enum hm_err err = start(&t, d);
    for (size_t i = 0; !err && i < dom->nnodes; i++)
        trim_spike(&t, (int32_t)i);
    for (bool changed = true; !err && changed;) {
        changed = false;
        for (size_t k = 0; k < dom->nedges; k++) {
            const struct hm_domain_edge *e = &dom->edge[k];
            if (!t.gone[k] && e->marks == HM_EDGE_BREAKLINE)
                changed = trim_end(&t, (int32_t)k, e->a, e->b) ||
                          trim_end(&t, (int32_t)k, e->b, e->a) || changed;
        }
    }
    if (!err)
        err = finish(&t, n, d);
    if (!err)
        err = hm_domain_triangulate(dom, threads, d);
    free(t.vertex);
    free(t.gone);
    hm_segindex_free(t.index);
    return err;
}
