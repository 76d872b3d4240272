/* hm_greedy: see hm_greedy.h. */
#include "hm_greedy.h"

#include "hm_buckets.h"
#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

enum { NONE = -1 };

/* What the measurements in a triangle say. */
struct standing {
    int32_t worst; /* the one farthest above or below it */
    int32_t place; /* in the heap, or NONE */
    double error;  /* of the worst */
};

struct greedy {
    struct hm_domain *dom;
    const struct hm_greedy_options *o;
    struct hm_greedy_done *done;
    struct hm_diag *d;
    struct hm_buckets bucket;
    double *z;                 /* by vertex */
    struct standing *standing; /* by triangle */
    int32_t *heap, n_heap;     /* triangles that hold a measurement, the worst on top */
    size_t z_cap, standing_cap, heap_cap, n_standing;
};

/* --- the heap --- */

static bool is_worse(const struct greedy *g, int32_t s, int32_t t)
{
    const struct standing *a = &g->standing[s], *b = &g->standing[t];
    return a->error != b->error ? a->error > b->error : a->worst < b->worst;
}

static void put(struct greedy *g, int32_t place, int32_t tri)
{
    g->heap[place] = tri;
    g->standing[tri].place = place;
}

/* Find the place of a triangle that begins at one, upward and then downward. */
static void sift(struct greedy *g, int32_t place, int32_t tri)
{
    for (; place > 0 && is_worse(g, tri, g->heap[(place - 1) / 2]); place = (place - 1) / 2)
        put(g, place, g->heap[(place - 1) / 2]);
    for (;;) {
        int32_t child = 2 * place + 1;
        if (child + 1 < g->n_heap && is_worse(g, g->heap[child + 1], g->heap[child]))
            child++;
        if (child >= g->n_heap || !is_worse(g, g->heap[child], tri))
            break;
        put(g, place, g->heap[child]);
        place = child;
    }
    put(g, place, tri);
}

/* The standing of a triangle has changed. */
static enum hm_err update(struct greedy *g, int32_t tri)
{
    struct standing *b = &g->standing[tri];
    bool holds = g->bucket.first[tri] != HM_NOBODY;
    if (holds && b->place == NONE) {
        if (!hm_grow(&g->heap, &g->heap_cap, (size_t)g->n_heap + 1, sizeof *g->heap))
            return hm_fail_memory(g->d);
        g->n_heap++;
        sift(g, g->n_heap - 1, tri);
    } else if (holds) {
        sift(g, b->place, tri);
    } else if (b->place != NONE) {
        int32_t place = b->place, last = g->heap[--g->n_heap];
        b->place = NONE;
        if (last != tri)
            sift(g, place, last);
    }
    return HM_OK;
}

/* --- triangles --- */

/* Find the worst measurement of a triangle: the farthest above or below its plane. */
static enum hm_err scan(struct greedy *g, int32_t tri)
{
    const struct hm_tri *t = g->dom->tri;
    struct standing *b = &g->standing[tri];
    int32_t v[3];
    const double *p[3];
    for (int k = 0; k < 3; k++) {
        v[k] = hm_tri_org(t, 3 * tri + k);
        p[k] = hm_tri_xy(t, v[k]);
    }
    double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1], uz = g->z[v[1]] - g->z[v[0]];
    double wx = p[2][0] - p[0][0], wy = p[2][1] - p[0][1], wz = g->z[v[2]] - g->z[v[0]];
    double det = ux * wy - uy * wx;
    double dzdx = (uz * wy - wz * uy) / det, dzdy = (wz * ux - uz * wx) / det;
    b->worst = NONE;
    b->error = -1;
    for (int32_t c = g->bucket.first[tri]; c != HM_NOBODY; c = g->bucket.next[c]) {
        const double *m = hm_buckets_at(&g->bucket, c);
        double surface = g->z[v[0]] + dzdx * (m[0] - p[0][0]) + dzdy * (m[1] - p[0][1]);
        double error = fabs(m[2] - surface);
        if (!isfinite(error)) /* a triangle as thin as rounding */
            error = 0;
        if (error > b->error || (error == b->error && c < b->worst)) {
            b->error = error;
            b->worst = c;
        }
    }
    return update(g, tri);
}

static enum hm_err need(struct greedy *g)
{
    size_t triangles = (size_t)hm_tri_triangles(g->dom->tri);
    size_t vertices = (size_t)hm_tri_vertices(g->dom->tri);
    if (!hm_grow(&g->standing, &g->standing_cap, triangles, sizeof *g->standing) ||
        !hm_grow(&g->z, &g->z_cap, vertices, sizeof *g->z))
        return hm_fail_memory(g->d);
    while (g->n_standing < triangles)
        g->standing[g->n_standing++] = (struct standing){NONE, NONE, -1};
    return HM_OK;
}

static enum hm_err fill(struct greedy *g, const double *xyz, size_t n)
{
    const struct hm_tri *t = g->dom->tri;
    enum hm_err err = hm_buckets_fill(&g->bucket, g->dom, xyz, n, g->o->threads, g->d);
    if (!err)
        err = need(g);
    for (int32_t v = 0; !err && v < hm_tri_vertices(t); v++)
        g->z[v] = g->dom->node_of[v] < 0 ? NAN : g->dom->node[g->dom->node_of[v]].z;
    for (int32_t k = 0; !err && k < hm_tri_triangles(t); k++)
        if (g->bucket.first[k] != HM_NOBODY)
            err = scan(g, k);
    return err;
}

/* --- insertion --- */

static double distance2(const double *p, const double *q)
{
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
}

/* Is p too near to an edge of its triangle? On a breakline it is in any case: there the line says
 * how high the ground is. An outline is split by what lies on it. */
static bool is_near_edge(const struct greedy *g, int32_t e, const double *p)
{
    const struct hm_tri *t = g->dom->tri;
    int32_t marks = hm_tri_marks(t, e);
    if (!marks)
        return false;
    const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
    double least = marks & HM_EDGE_REGULAR ? g->o->clearance : g->o->least / 2;
    if (hm_pred_orient(a, b, p) <= 0)
        return (marks & (HM_EDGE_BREAKLINE | HM_EDGE_REGULAR)) != 0;
    return hm_plane_distance(p, a, b) < least;
}

/* May measurement c become a node? The nearest nodes are those of its triangle and beyond its
 * edges. */
static bool may_insert(const struct greedy *g, int32_t tri, int32_t c)
{
    const struct hm_tri *t = g->dom->tri;
    const double *p = hm_buckets_at(&g->bucket, c);
    double least2 = g->o->least * g->o->least;
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++) {
        int32_t beyond = hm_tri_apex(t, hm_tri_twin(t, e));
        const double *q = hm_tri_xy(t, hm_tri_org(t, e));
        if (is_near_edge(g, e, p) || hm_plane_same(p, q) || distance2(p, q) < least2)
            return false;
        if (!hm_tri_marks(t, e) && beyond != HM_TRI_INFINITY &&
            distance2(p, hm_tri_xy(t, beyond)) < least2)
            return false;
    }
    return true;
}

static enum hm_err insert(struct greedy *g, int32_t tri, int32_t c)
{
    const double *p = hm_buckets_at(&g->bucket, c);
    int32_t v;
    enum hm_err err = hm_tri_insert(g->dom->tri, p[0], p[1], tri, &v, g->d);
    if (!err)
        err = need(g);
    if (!err)
        err = hm_buckets_look(&g->bucket, v, g->d);
    if (err)
        return err;
    g->z[v] = p[2];
    hm_buckets_deal(&g->bucket, p, c);
    for (size_t k = 0; !err && k < g->bucket.n_star; k++)
        err = scan(g, g->bucket.star[k] / 3);
    g->done->inserted++;
    return err;
}

/* The worst triangle by now, or NONE. */
static int32_t find_worst(struct greedy *g)
{
    g->done->error = 0;
    if (g->n_heap == 0)
        return NONE;
    const struct standing *s = &g->standing[g->heap[0]];
    g->done->error = s->error;
    g->done->x = hm_buckets_at(&g->bucket, s->worst)[0];
    g->done->y = hm_buckets_at(&g->bucket, s->worst)[1];
    return g->heap[0];
}

static enum hm_err go(struct greedy *g)
{
    enum hm_err err = HM_OK;
    int32_t tri;
    while (!err && (tri = find_worst(g)) != NONE) {
        int32_t c = g->standing[tri].worst;
        if (g->done->error <= g->o->max_error ||
            (g->o->max_nodes > 0 && (int64_t)g->dom->nnodes + g->done->inserted >= g->o->max_nodes))
            break;
        if (may_insert(g, tri, c)) {
            err = insert(g, tri, c);
            continue;
        }
        g->done->refused++;
        hm_buckets_drop(&g->bucket, tri, c);
        err = scan(g, tri);
    }
    return err;
}

static void dispose(struct greedy *g)
{
    hm_buckets_free(&g->bucket);
    free(g->z);
    free(g->standing);
    free(g->heap);
}

enum hm_err hm_greedy_reach(struct hm_domain *dom, const double *xyz, size_t n,
                            const struct hm_greedy_options *o, struct hm_greedy_done *done,
                            struct hm_diag *d)
{
    struct greedy g = {.dom = dom, .o = o, .done = done, .d = d};
    *done = (struct hm_greedy_done){0};
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    int32_t first = err ? 0 : hm_tri_vertices(dom->tri);
    if (!err)
        err = fill(&g, xyz, n);
    if (!err)
        err = go(&g);
    dispose(&g);
    return err ? err : hm_domain_adopt(dom, first, d);
}

enum hm_err hm_greedy_look(struct hm_domain *dom, const double *xyz, size_t n, int threads,
                           struct hm_greedy_done *done, struct hm_diag *d)
{
    const struct hm_greedy_options o = {.threads = threads};
    struct greedy g = {.dom = dom, .o = &o, .done = done, .d = d};
    *done = (struct hm_greedy_done){0};
    enum hm_err err = fill(&g, xyz, n);
    if (!err)
        find_worst(&g);
    dispose(&g);
    return err;
}
