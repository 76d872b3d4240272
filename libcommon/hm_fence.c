/* hm_fence: see hm_fence.h. */
#include "hm_fence.h"

#include "hm_attr.h"
#include "hm_elem.h"
#include "hm_median.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hm_fence {
    const struct hm_mesh *mesh;
    size_t n;
    struct hm_mesh_loops *loops; /* one a mesh */
    struct hm_line *ring;        /* every loop of every mesh as a closed line */
    size_t nrings, ring_cap;
    struct hm_segindex *index; /* of the boundary edges */
};

struct span {
    double lo, hi;
};

struct spans {
    struct span *v;
    size_t n, cap;
};

/* --- building --- */

void hm_fence_free(struct hm_fence *f)
{
    if (!f)
        return;
    for (size_t k = 0; f->loops && k < f->n; k++)
        hm_mesh_loops_free(&f->loops[k]);
    for (size_t k = 0; k < f->nrings; k++)
        free(f->ring[k].xyz);
    free(f->loops);
    free(f->ring);
    hm_segindex_free(f->index);
    free(f);
}

static enum hm_err add_ring(struct hm_fence *f, const struct hm_mesh *m, const int32_t *node,
                            size_t n, struct hm_diag *d)
{
    if (!hm_grow(&f->ring, &f->ring_cap, f->nrings + 1, sizeof *f->ring))
        return hm_fail_memory(d);
    double *xyz = hm_alloc(n, 3 * sizeof *xyz);
    if (!xyz)
        return hm_fail_memory(d);
    for (size_t i = 0; i < n; i++) {
        const struct hm_node *p = &m->node[node[i]];
        memcpy(xyz + 3 * i, (double[3]){p->x, p->y, p->z}, 3 * sizeof *xyz);
    }
    f->ring[f->nrings++] = (struct hm_line){.xyz = xyz, .n = n, .closed = true};
    return HM_OK;
}

static enum hm_err index_rings(struct hm_fence *f, struct hm_diag *d)
{
    size_t n = 0;
    for (size_t k = 0; k < f->nrings; k++)
        n += f->ring[k].n;
    struct hm_segment *s = hm_alloc(n, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    n = 0;
    for (size_t k = 0; k < f->nrings; k++)
        for (size_t i = 0; i < f->ring[k].n; i++, n++) {
            const double *xyz = f->ring[k].xyz;
            memcpy(s[n].a, xyz + 3 * i, sizeof s[n].a);
            memcpy(s[n].b, xyz + 3 * ((i + 1) % f->ring[k].n), sizeof s[n].b);
            s[n].line = (int32_t)k;
            s[n].piece = (int32_t)i;
        }
    enum hm_err err = hm_segindex_build(&f->index, s, n, d);
    free(s);
    return err;
}

static bool inside_rings(const struct hm_line *ring, size_t n, double x, double y)
{
    bool odd = false;
    for (size_t k = 0; k < n; k++)
        if (hm_polygon_side(&ring[k], x, y) > 0)
            odd = !odd;
    return odd;
}

/* Meshes whose boundaries do not cross overlap when one lies within the other: look from the middle
 * of its first element. */
static enum hm_err refuse_nested(const struct hm_fence *f, const size_t *first_ring,
                                 struct hm_diag *d)
{
    for (size_t a = 0; a < f->n; a++) {
        if (f->mesh[a].nelems == 0)
            continue;
        double xy[4][2], x = 0, y = 0;
        int corners = hm_elem_xy(&f->mesh[a], &f->mesh[a].elem[0], xy);
        for (int i = 0; i < corners; i++) {
            x += xy[i][0] / corners;
            y += xy[i][1] / corners;
        }
        for (size_t b = 0; b < f->n; b++)
            if (b != a &&
                inside_rings(f->ring + first_ring[b], first_ring[b + 1] - first_ring[b], x, y))
                return hm_fail_at(d, HM_EGEOM, x, y, HM_FENCE_OVERLAP);
    }
    return HM_OK;
}

enum hm_err hm_fence_build(struct hm_fence **out, const struct hm_mesh *mesh, size_t n,
                           struct hm_diag *d)
{
    struct hm_fence *f = hm_alloc0(1, sizeof *f);
    size_t *first_ring = hm_alloc0(n + 1, sizeof *first_ring);
    *out = f;
    enum hm_err err = f && first_ring ? HM_OK : hm_fail_memory(d);
    if (!err) {
        f->mesh = mesh;
        f->n = n;
        f->loops = hm_alloc0(n, sizeof *f->loops);
        err = f->loops ? HM_OK : hm_fail_memory(d);
    }
    for (size_t k = 0; !err && k < n; k++) {
        struct hm_mesh_loops *l = &f->loops[k];
        err = hm_mesh_boundary(&mesh[k], l, d);
        for (size_t i = 0; !err && i < l->nloops; i++)
            err = add_ring(f, &mesh[k], l->node + l->start[i], l->start[i + 1] - l->start[i], d);
        first_ring[k + 1] = f->nrings;
    }
    if (!err)
        err = index_rings(f, d);
    if (!err)
        err = refuse_nested(f, first_ring, d);
    free(first_ring);
    if (err) {
        hm_fence_free(f);
        *out = NULL;
    }
    return err;
}

enum hm_err hm_fence_median_edge(const struct hm_mesh *mesh, size_t n, double *edge,
                                 struct hm_diag *d)
{
    double *length = NULL;
    size_t count = 0, cap = 0;
    enum hm_err err = HM_OK;
    for (size_t k = 0; !err && k < n; k++) {
        struct hm_mesh_edge *e;
        size_t edges;
        err = hm_mesh_edges(&mesh[k], &e, &edges, d);
        if (!err && !hm_grow(&length, &cap, count + edges + 1, sizeof *length))
            err = hm_fail_memory(d);
        for (size_t i = 0; !err && i < edges; i++) {
            const struct hm_node *a = &mesh[k].node[e[i].a], *b = &mesh[k].node[e[i].b];
            if (e[i].right == -1)
                length[count++] = hypot(b->x - a->x, b->y - a->y);
        }
        free(e);
    }
    *edge = err ? 0 : hm_median(length, count);
    free(length);
    return err;
}

const struct hm_mesh_loops *hm_fence_loops(const struct hm_fence *f, size_t k)
{
    return &f->loops[k];
}

bool hm_fence_is_inside(const struct hm_fence *f, double x, double y)
{
    return inside_rings(f->ring, f->nrings, x, y);
}

bool hm_fence_is_near(const struct hm_fence *f, double x, double y, double clearance)
{
    double foot[3], distance;
    return hm_segindex_nearest(f->index, x, y, clearance, foot, &distance) != NULL;
}

/* --- cutting lines --- */

static void widen(struct span *s, double lo, double hi)
{
    s->lo = fmin(s->lo, lo);
    s->hi = fmax(s->hi, hi);
}

/* The t at which p + t v is within r of the point c. */
static void span_of_disc(const double *p, const double *v, const double *c, double r,
                         struct span *s)
{
    double w[2] = {p[0] - c[0], p[1] - c[1]};
    double a = v[0] * v[0] + v[1] * v[1], b = w[0] * v[0] + w[1] * v[1];
    double disc = b * b - a * (w[0] * w[0] + w[1] * w[1] - r * r);
    if (disc >= 0)
        widen(s, (-b - sqrt(disc)) / a, (-b + sqrt(disc)) / a);
}

/* Narrow s to the t at which lo <= c + t k <= hi. */
static void clip(struct span *s, double c, double k, double lo, double hi)
{
    if (k == 0) {
        if (c < lo || c > hi)
            s->hi = -INFINITY;
        return;
    }
    double t0 = (lo - c) / k, t1 = (hi - c) / k;
    s->lo = fmax(s->lo, fmin(t0, t1));
    s->hi = fmin(s->hi, fmax(t0, t1));
}

/* The t at which p + t v is within r of the segment a b: a capsule is convex, so it is one span,
 * the hull of those of its two discs and its rectangle. */
static struct span span_of_capsule(const double *p, const double *v, const double *a,
                                   const double *b, double r)
{
    struct span s = {INFINITY, -INFINITY}, box = {-INFINITY, INFINITY};
    double e[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(e[0], e[1]);
    span_of_disc(p, v, a, r, &s);
    span_of_disc(p, v, b, r, &s);
    if (length > 0) {
        double w[2] = {p[0] - a[0], p[1] - a[1]};
        clip(&box, (w[0] * e[0] + w[1] * e[1]) / length, (v[0] * e[0] + v[1] * e[1]) / length, 0,
             length);
        clip(&box, (e[0] * w[1] - e[1] * w[0]) / length, (e[0] * v[1] - e[1] * v[0]) / length, -r,
             r);
        if (box.lo <= box.hi)
            widen(&s, box.lo, box.hi);
    }
    return s;
}

struct cutting {
    const double *p;
    double v[2], clearance;
    struct spans *spans;
    bool failed;
};

static bool add_span(void *arg, const struct hm_segment *s)
{
    struct cutting *c = arg;
    struct span span = span_of_capsule(c->p, c->v, s->a, s->b, c->clearance);
    span.lo = fmax(span.lo, 0);
    span.hi = fmin(span.hi, 1);
    if (span.lo > span.hi)
        return true;
    if (!hm_grow(&c->spans->v, &c->spans->cap, c->spans->n + 1, sizeof span)) {
        c->failed = true;
        return false;
    }
    c->spans->v[c->spans->n++] = span;
    return true;
}

static int by_lo(const void *pa, const void *pb)
{
    const struct span *a = pa, *b = pb;
    return (a->lo > b->lo) - (a->lo < b->lo);
}

/* The parts 0 <= t <= 1 of p q that are too near: sorted, apart from each other. */
static enum hm_err too_near(const struct hm_fence *f, const double *p, const double *q,
                            double clearance, struct spans *spans, struct hm_diag *d)
{
    struct cutting c = {p, {q[0] - p[0], q[1] - p[1]}, clearance, spans, false};
    double lo[2], hi[2];
    for (int k = 0; k < 2; k++) {
        lo[k] = fmin(p[k], q[k]) - clearance;
        hi[k] = fmax(p[k], q[k]) + clearance;
    }
    spans->n = 0;
    hm_segindex_box(f->index, lo, hi, add_span, &c);
    if (c.failed)
        return hm_fail_memory(d);
    if (spans->n == 0)
        return HM_OK;
    qsort(spans->v, spans->n, sizeof *spans->v, by_lo);
    size_t n = 0;
    for (size_t k = 1; k < spans->n; k++) {
        if (spans->v[k].lo <= spans->v[n].hi)
            spans->v[n].hi = fmax(spans->v[n].hi, spans->v[k].hi);
        else
            spans->v[++n] = spans->v[k];
    }
    spans->n = n + 1;
    return HM_OK;
}

/* A line with what is too near taken out: `gap` says that something is missing before a vertex. */
struct cut_vertex {
    double xyz[3];
    bool gap;
};

struct cut_line {
    struct cut_vertex *v;
    size_t n, cap;
    bool gap; /* before the vertex to come */
};

static enum hm_err put(struct cut_line *c, const double *a, const double *b, double t,
                       struct hm_diag *d)
{
    if (!hm_grow(&c->v, &c->cap, c->n + 1, sizeof *c->v))
        return hm_fail_memory(d);
    struct cut_vertex *v = &c->v[c->n++];
    v->gap = c->gap;
    c->gap = false;
    for (int k = 0; k < 3; k++)
        v->xyz[k] = t > 0 ? a[k] + t * (b[k] - a[k]) : a[k];
    return HM_OK;
}

static enum hm_err cut_all(const struct hm_fence *f, const struct hm_line *line, double clearance,
                           struct spans *spans, struct cut_line *c, struct hm_diag *d)
{
    size_t pieces = line->n - !line->closed;
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < pieces; i++) {
        const double *a = line->xyz + 3 * i, *b = line->xyz + 3 * ((i + 1) % line->n);
        err = too_near(f, a, b, clearance, spans, d);
        if (!err && (spans->n == 0 || spans->v[0].lo > 0))
            err = put(c, a, b, 0, d);
        for (size_t k = 0; !err && k < spans->n; k++) {
            if (spans->v[k].lo > 0)
                err = put(c, a, b, spans->v[k].lo, d);
            c->gap = true;
            if (!err && spans->v[k].hi < 1)
                err = put(c, a, b, spans->v[k].hi, d);
        }
        bool ends = !line->closed && i == pieces - 1;
        if (!err && ends && (spans->n == 0 || spans->v[spans->n - 1].hi < 1))
            err = put(c, b, b, 0, d);
    }
    if (line->closed && c->n > 0 && c->gap)
        c->v[0].gap = true;
    return err;
}

static double step(const double *xyz, size_t i)
{
    return hypot(xyz[3 * i + 3] - xyz[3 * i], xyz[3 * i + 4] - xyz[3 * i + 1]);
}

/* Write a piece, unless it is a remnant or inside a mesh. */
static enum hm_err finish(const struct hm_fence *f, double *xyz, size_t n, bool cut_start,
                          bool cut_end, const char *attrs, double clearance, struct hm_lines *out,
                          struct hm_diag *d)
{
    if (n >= 3 && cut_start && step(xyz, 0) < clearance) {
        xyz += 3;
        n--;
    }
    if (n >= 3 && cut_end && step(xyz, n - 2) < clearance)
        n--;
    struct hm_line piece = {.attrs = (char *)attrs, .xyz = xyz, .n = n};
    if (n < 2 || ((cut_start || cut_end) && hm_polyline_length(&piece) < clearance) ||
        hm_fence_is_inside(f, xyz[0], xyz[1]))
        return HM_OK;
    return hm_lines_append(out, &piece, d);
}

/* The pieces between the gaps. A closed line is taken around from its first gap. */
static enum hm_err write_pieces(const struct hm_fence *f, const struct cut_line *c,
                                const struct hm_line *line, char *attrs, double clearance,
                                struct hm_lines *out, struct hm_diag *d)
{
    size_t first = 0, n = 0;
    while (line->closed && first < c->n && !c->v[first].gap)
        first++;
    double *xyz = hm_alloc(c->n, 3 * sizeof *xyz);
    enum hm_err err = xyz ? HM_OK : hm_fail_memory(d);
    bool cut_start = line->closed || (c->n > 0 && c->v[0].gap);
    for (size_t k = 0; !err && k < c->n; k++) {
        const struct cut_vertex *v = &c->v[(first + k) % c->n];
        if (k > 0 && v->gap) {
            err = finish(f, xyz, n, cut_start, true, attrs, clearance, out, d);
            n = 0;
            cut_start = true;
        }
        memcpy(xyz + 3 * n++, v->xyz, sizeof v->xyz);
    }
    if (!err && n > 0)
        err = finish(f, xyz, n, cut_start, line->closed || c->gap, attrs, clearance, out, d);
    free(xyz);
    return err;
}

enum hm_err hm_fence_cut(const struct hm_fence *f, const struct hm_line *line, double clearance,
                         struct hm_lines *out, struct hm_diag *d)
{
    struct spans spans = {0};
    struct cut_line c = {0};
    enum hm_err err = cut_all(f, line, clearance, &spans, &c, d);
    bool is_cut = c.gap;
    for (size_t k = 0; k < c.n; k++)
        is_cut = is_cut || c.v[k].gap;
    if (!err && !is_cut && !hm_fence_is_inside(f, line->xyz[0], line->xyz[1]))
        err = hm_lines_append(out, line, d);
    else if (!err && is_cut) {
        char *attrs = hm_attr_set(line->attrs, "closed", NULL);
        err = attrs ? write_pieces(f, &c, line, attrs, clearance, out, d) : hm_fail_memory(d);
        free(attrs);
    }
    free(spans.v);
    free(c.v);
    return err;
}

/* --- joining rings --- */

/* A place on a ring: its vertices, and where it meets the fence. */
struct stop {
    double xyz[3];
    double t; /* along the ring's segment */
};

struct joining {
    const double *p, *q;
    struct stop *stop;
    size_t n, cap;
    bool failed;
};

static const double *nearer_end(const struct hm_segment *s, const double *p)
{
    double to_a = hypot(s->a[0] - p[0], s->a[1] - p[1]);
    return to_a <= hypot(s->b[0] - p[0], s->b[1] - p[1]) ? s->a : s->b;
}

/* Where p q crosses or touches s: a stop at the nearer node of s. */
static bool add_stop(void *arg, const struct hm_segment *s)
{
    struct joining *j = arg;
    if (hm_plane_same(j->p, s->a) || hm_plane_same(j->p, s->b) || hm_plane_same(j->q, s->a) ||
        hm_plane_same(j->q, s->b))
        return true;
    int a = hm_pred_orient(j->p, j->q, s->a), b = hm_pred_orient(j->p, j->q, s->b);
    int p = hm_pred_orient(s->a, s->b, j->p), q = hm_pred_orient(s->a, s->b, j->q);
    if (a * b > 0 || p * q > 0 || (a == 0 && b == 0))
        return true;
    double along = hm_area2(s->a, s->b, j->p), whole = along - hm_area2(s->a, s->b, j->q);
    double t = whole == 0 ? 0.5 : along / whole, at[2];
    for (int k = 0; k < 2; k++)
        at[k] = j->p[k] + t * (j->q[k] - j->p[k]);
    if (!hm_grow(&j->stop, &j->cap, j->n + 1, sizeof *j->stop)) {
        j->failed = true;
        return false;
    }
    struct stop *stop = &j->stop[j->n++];
    memcpy(stop->xyz, nearer_end(s, at), sizeof stop->xyz);
    stop->t = t;
    return true;
}

static int by_t(const void *pa, const void *pb)
{
    const struct stop *a = pa, *b = pb;
    return (a->t > b->t) - (a->t < b->t);
}

/* The segment p q, bent to the stops on its way, without what lies inside. */
static enum hm_err join_one(const struct hm_fence *f, struct joining *j, struct hm_segment **out,
                            size_t *n, size_t *cap, struct hm_diag *d)
{
    double lo[2], hi[2];
    for (int k = 0; k < 2; k++) {
        lo[k] = fmin(j->p[k], j->q[k]);
        hi[k] = fmax(j->p[k], j->q[k]);
    }
    j->n = 0;
    hm_segindex_box(f->index, lo, hi, add_stop, j);
    if (j->failed)
        return hm_fail_memory(d);
    if (j->n > 1)
        qsort(j->stop, j->n, sizeof *j->stop, by_t);
    const double *from = j->p;
    for (size_t k = 0; k <= j->n; k++) {
        const double *to = k < j->n ? j->stop[k].xyz : j->q;
        if (hm_plane_same(from, to))
            continue;
        if (!hm_fence_is_inside(f, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2)) {
            if (!hm_grow(out, cap, *n + 1, sizeof **out))
                return hm_fail_memory(d);
            struct hm_segment *s = &(*out)[(*n)++];
            memcpy(s->a, from, sizeof s->a);
            memcpy(s->b, to, sizeof s->b);
        }
        from = to;
    }
    return HM_OK;
}

enum hm_err hm_fence_join(const struct hm_fence *f, const struct hm_line *ring, double clearance,
                          struct hm_segment **out, size_t *n, struct hm_diag *d)
{
    double *xyz = hm_alloc(ring->n, 3 * sizeof *xyz), foot[3], distance;
    size_t cap = 0;
    *out = NULL;
    *n = 0;
    if (!xyz)
        return hm_fail_memory(d);
    for (size_t i = 0; i < ring->n; i++) {
        const double *p = ring->xyz + 3 * i;
        const struct hm_segment *s =
            hm_segindex_nearest(f->index, p[0], p[1], clearance, foot, &distance);
        memcpy(xyz + 3 * i, s ? nearer_end(s, p) : p, 3 * sizeof *xyz);
    }
    struct joining j = {0};
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < ring->n; i++) {
        j.p = xyz + 3 * i;
        j.q = xyz + 3 * ((i + 1) % ring->n);
        if (!hm_plane_same(j.p, j.q))
            err = join_one(f, &j, out, n, &cap, d);
    }
    free(xyz);
    free(j.stop);
    if (err) {
        free(*out);
        *out = NULL;
    }
    return err;
}
