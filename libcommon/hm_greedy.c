/* hm_greedy: see hm_greedy.h. */
#include "hm_greedy.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

enum { NONE = -1 };

/* The measurements in a triangle: a list, and the worst of them. */
struct bucket {
    int32_t first, worst;
    int32_t place; /* in the heap, or NONE */
    double error;  /* of the worst */
};

struct greedy {
    struct hm_domain *dom;
    const double *xyz;
    const struct hm_greedy_options *o;
    struct hm_greedy_done *done;
    struct hm_diag *d;
    int32_t *next;         /* by measurement: the next in its bucket */
    double *z;             /* by vertex */
    struct bucket *bucket; /* by triangle */
    int32_t *heap, n_heap; /* triangles whose buckets hold something, the worst on top */
    size_t z_cap, bucket_cap, heap_cap, n_buckets;
    int32_t *star; /* triangles around the new vertex, as edges from it */
    size_t n_star, star_cap;
};

static const double *at(const struct greedy *g, int32_t c)
{
    return g->xyz + 3 * (size_t)c;
}

/* --- the heap --- */

static bool is_worse(const struct greedy *g, int32_t s, int32_t t)
{
    const struct bucket *a = &g->bucket[s], *b = &g->bucket[t];
    return a->error != b->error ? a->error > b->error : a->worst < b->worst;
}

static void put(struct greedy *g, int32_t place, int32_t tri)
{
    g->heap[place] = tri;
    g->bucket[tri].place = place;
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

/* The bucket of a triangle has changed. */
static enum hm_err update(struct greedy *g, int32_t tri)
{
    struct bucket *b = &g->bucket[tri];
    if (b->first != NONE && b->place == NONE) {
        if (!hm_grow(&g->heap, &g->heap_cap, (size_t)g->n_heap + 1, sizeof *g->heap))
            return hm_fail_memory(g->d);
        g->n_heap++;
        sift(g, g->n_heap - 1, tri);
    } else if (b->first != NONE) {
        sift(g, b->place, tri);
    } else if (b->place != NONE) {
        int32_t place = b->place, last = g->heap[--g->n_heap];
        b->place = NONE;
        if (last != tri)
            sift(g, place, last);
    }
    return HM_OK;
}

/* --- buckets --- */

static void add(struct greedy *g, int32_t tri, int32_t c)
{
    g->next[c] = g->bucket[tri].first;
    g->bucket[tri].first = c;
}

/* Find the worst measurement of a triangle: the farthest above or below its plane. */
static enum hm_err scan(struct greedy *g, int32_t tri)
{
    const struct hm_tri *t = g->dom->tri;
    struct bucket *b = &g->bucket[tri];
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
    for (int32_t c = b->first; c != NONE; c = g->next[c]) {
        const double *m = at(g, c);
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

static void drop(struct greedy *g, int32_t tri, int32_t c)
{
    int32_t *link = &g->bucket[tri].first;
    while (*link != c)
        link = &g->next[*link];
    *link = g->next[c];
}

static enum hm_err need(struct greedy *g)
{
    size_t triangles = (size_t)hm_tri_triangles(g->dom->tri);
    size_t vertices = (size_t)hm_tri_vertices(g->dom->tri);
    if (!hm_grow(&g->bucket, &g->bucket_cap, triangles, sizeof *g->bucket) ||
        !hm_grow(&g->z, &g->z_cap, vertices, sizeof *g->z))
        return hm_fail_memory(g->d);
    for (; g->n_buckets < triangles; g->n_buckets++)
        g->bucket[g->n_buckets] = (struct bucket){NONE, NONE, NONE, -1};
    return HM_OK;
}

static enum hm_err fill(struct greedy *g, size_t n)
{
    const struct hm_tri *t = g->dom->tri;
    int32_t *tri = hm_alloc(n, sizeof *tri);
    g->next = hm_alloc(n, sizeof *g->next);
    enum hm_err err = tri && g->next ? need(g) : hm_fail_memory(g->d);
    if (!err)
        err = hm_tri_locate_all(t, g->xyz, n, 3, g->o->threads, tri, g->d);
    for (size_t c = n; !err && c-- > 0;)
        if (tri[c] != HM_TRI_NONE && hm_domain_is_inside(g->dom, tri[c]))
            add(g, tri[c], (int32_t)c);
    for (int32_t v = 0; !err && v < hm_tri_vertices(t); v++)
        g->z[v] = g->dom->node_of[v] < 0 ? NAN : g->dom->node[g->dom->node_of[v]].z;
    for (int32_t k = 0; !err && k < hm_tri_triangles(t); k++)
        if (g->bucket[k].first != NONE)
            err = scan(g, k);
    free(tri);
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
    const double *p = at(g, c);
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

/* The triangles around the new vertex took the places of those that were there, and two more. */
static enum hm_err find_star(struct greedy *g, int32_t v)
{
    const struct hm_tri *t = g->dom->tri;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    g->n_star = 0;
    do {
        if (!hm_grow(&g->star, &g->star_cap, g->n_star + 1, sizeof *g->star))
            return hm_fail_memory(g->d);
        if (hm_domain_is_inside(g->dom, e / 3))
            g->star[g->n_star++] = e;
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return HM_OK;
}

/* Which triangle of the star holds p: the one with p left of its first edge and right of its last;
 * otherwise p is on the border, or at the vertex, as rounding has it. */
static int32_t sector(const struct greedy *g, const double *v, const double *p)
{
    const struct hm_tri *t = g->dom->tri;
    int32_t nearest = g->star[0] / 3;
    double least = INFINITY;
    for (size_t k = 0; k < g->n_star; k++) {
        const double *a = hm_tri_xy(t, hm_tri_dest(t, g->star[k]));
        const double *b = hm_tri_xy(t, hm_tri_apex(t, g->star[k]));
        double after = hm_area2(v, a, p), before = hm_area2(b, v, p);
        if (after >= 0 && before > 0)
            return g->star[k] / 3;
        double beyond = -fmin(after, before);
        if (beyond < least && hm_area2(a, b, p) <= hm_area2(a, b, v)) {
            least = beyond;
            nearest = g->star[k] / 3;
        }
    }
    return nearest;
}

static enum hm_err insert(struct greedy *g, int32_t tri, int32_t c)
{
    const double *p = at(g, c);
    int32_t v, all = NONE;
    enum hm_err err = hm_tri_insert(g->dom->tri, p[0], p[1], tri, &v, g->d);
    if (!err)
        err = need(g);
    if (!err)
        err = find_star(g, v);
    if (err)
        return err;
    g->z[v] = p[2];
    for (size_t k = 0; k < g->n_star; k++) {
        struct bucket *b = &g->bucket[g->star[k] / 3];
        for (int32_t m = b->first, next; m != NONE; m = next) {
            next = g->next[m];
            g->next[m] = all;
            all = m;
        }
        b->first = NONE;
    }
    for (int32_t m = all, next; m != NONE; m = next) {
        next = g->next[m];
        if (m != c)
            add(g, sector(g, p, at(g, m)), m);
    }
    for (size_t k = 0; !err && k < g->n_star; k++)
        err = scan(g, g->star[k] / 3);
    g->done->inserted++;
    return err;
}

static enum hm_err go(struct greedy *g)
{
    enum hm_err err = HM_OK;
    while (!err && g->n_heap > 0) {
        int32_t tri = g->heap[0], c = g->bucket[tri].worst;
        g->done->error = g->bucket[tri].error;
        g->done->x = at(g, c)[0];
        g->done->y = at(g, c)[1];
        if (g->done->error <= g->o->max_error ||
            (g->o->max_nodes > 0 && (int64_t)g->dom->nnodes + g->done->inserted >= g->o->max_nodes))
            return HM_OK;
        if (may_insert(g, tri, c)) {
            err = insert(g, tri, c);
            continue;
        }
        g->done->refused++;
        drop(g, tri, c);
        err = scan(g, tri);
    }
    g->done->error = g->n_heap > 0 ? g->done->error : 0;
    return err;
}

enum hm_err hm_greedy_reach(struct hm_domain *dom, const double *xyz, size_t n,
                            const struct hm_greedy_options *o, struct hm_greedy_done *done,
                            struct hm_diag *d)
{
    struct greedy g = {.dom = dom, .xyz = xyz, .o = o, .done = done, .d = d};
    *done = (struct hm_greedy_done){0};
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    int32_t first = err ? 0 : hm_tri_vertices(dom->tri);
    if (!err)
        err = fill(&g, n);
    if (!err)
        err = go(&g);
    free(g.next);
    free(g.z);
    free(g.bucket);
    free(g.heap);
    free(g.star);
    return err ? err : hm_domain_adopt(dom, first, o->threads, d);
}
