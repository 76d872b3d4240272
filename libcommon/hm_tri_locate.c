/* hm_tri_locate: which triangle holds a point? */
#include "hm_tri_topology.h"

#include "hm_order.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

/* Walk to the point across any edge that has it on its far side. Without constraints every order of
 * looking at the edges comes to an end; with them some orders may go round in circles, so the order
 * is drawn by lot (Devillers, Pion & Teillaud 2002, Walking in a triangulation). */
int32_t hm_tri_walk(const struct hm_tri *t, const double *p, int32_t tri)
{
    uint32_t lot = 2463534242u;
    int32_t from = HM_TRI_NONE; /* the edge that the walk came in by */
    for (;;) {
        lot ^= lot << 13;
        lot ^= lot >> 17;
        lot ^= lot << 5;
        int32_t e = 3 * tri + (int32_t)(lot % 3), cross = HM_TRI_NONE;
        for (int i = 0; i < 3 && cross == HM_TRI_NONE; i++, e = hm_tri_next(e)) {
            if (e == from)
                continue;
            int32_t a = t->half[e].org, b = hm_tri_dest_of(t, e);
            if (hm_pred_orient_fast(hm_tri_at(t, a), hm_tri_at(t, b), p) < 0)
                cross = e;
        }
        if (cross == HM_TRI_NONE)
            return tri;
        from = t->half[cross].twin;
        tri = from / 3;
        if (hm_tri_is_ghost(t, tri))
            return tri;
    }
}

static int32_t solid_beside(const struct hm_tri *t, int32_t ghost)
{
    int32_t e = 3 * ghost;
    while (hm_tri_apex_of(t, e) != HM_TRI_INFINITY)
        e++;
    return t->half[e].twin / 3;
}

static double distance(const double *p, const double *q)
{
    return fabs(p[0] - q[0]) + fabs(p[1] - q[1]);
}

/* Vertices are in spatial order: the nearest of some spread evenly over their numbers is a good
 * place to begin (jump and walk). */
static int32_t jump(const struct hm_tri *t, const double *p)
{
    int32_t n = t->vertices, samples = (int32_t)cbrt(n) + 1, nearest = HM_TRI_NONE;
    double least = INFINITY;
    for (int32_t i = 0; i < samples; i++) {
        int32_t v = (int32_t)((int64_t)(n - 1) * i / samples);
        while (v < n && !hm_tri_is_used(t, v))
            v++;
        if (v == n)
            break; /* never the first time: not all vertices can be removed */
        if (nearest == HM_TRI_NONE || distance(hm_tri_at(t, v), p) < least) {
            least = distance(hm_tri_at(t, v), p);
            nearest = v;
        }
    }
    return t->edge ? t->edge[nearest] / 3 : 2 * nearest;
}

/* As built, triangle 2v or one near it is at vertex v, give or take the last two. */
int32_t hm_tri_edge_of(const struct hm_tri *t, int32_t v)
{
    if (t->edge)
        return t->edge[v];
    int32_t e = 3 * hm_tri_find(t, hm_tri_at(t, v), v < t->vertices - 1 ? 2 * v : 2 * v - 2);
    while (t->half[e].org != v)
        e++;
    return e;
}

int32_t hm_tri_find(const struct hm_tri *t, const double *p, int32_t hint)
{
    bool good = hint >= 0 && hint < t->triangles && t->half[3 * hint].org != HM_TRI_FREE;
    int32_t start = good ? hint : jump(t, p);
    return hm_tri_walk(t, p, hm_tri_is_ghost(t, start) ? solid_beside(t, start) : start);
}

/* Do p and q, which are on a line with a, lie to the same side of it? */
static bool is_same_way(const double *a, const double *p, const double *q)
{
    int k = p[0] == a[0];
    return (p[k] > a[k] && q[k] > a[k]) || (p[k] < a[k] && q[k] < a[k]);
}

bool hm_tri_is_between(const double *a, const double *b, const double *c)
{
    int k = b[0] == a[0];
    return b[k] > a[k] ? b[k] <= c[k] : b[k] >= c[k];
}

int32_t hm_tri_aim(const struct hm_tri *t, int32_t a, const double *p)
{
    const double *from = hm_tri_at(t, a);
    int32_t first = hm_tri_edge_of(t, a), e = first;
    do {
        int32_t x = hm_tri_dest_of(t, e), y = hm_tri_apex_of(t, e);
        if (x != HM_TRI_INFINITY) {
            const double *px = hm_tri_at(t, x);
            int side = hm_pred_orient_fast(from, px, p);
            if (side == 0 && is_same_way(from, p, px))
                return e;
            if (side > 0 && y != HM_TRI_INFINITY &&
                hm_pred_orient_fast(from, hm_tri_at(t, y), p) < 0)
                return e;
        }
        e = hm_tri_turn(t, e);
    } while (e != first);
    return HM_TRI_NONE;
}

int32_t hm_tri_locate(const struct hm_tri *t, double x, double y, int32_t *hint)
{
    if (!isfinite(x) || !isfinite(y))
        return HM_TRI_NONE;
    int32_t tri = hm_tri_find(t, (double[]){x, y}, hint ? *hint : HM_TRI_NONE);
    if (hint)
        *hint = tri;
    return hm_tri_is_ghost(t, tri) ? HM_TRI_NONE : tri;
}

enum { CHUNK = 8192 };

struct queries {
    const struct hm_tri *t;
    const double *xy;
    size_t n, stride;
    const struct hm_order_item *item;
    int32_t *tri;
};

static void locate_chunk(void *pointer, size_t chunk)
{
    struct queries *q = pointer;
    size_t end = (chunk + 1) * CHUNK < q->n ? (chunk + 1) * CHUNK : q->n;
    int32_t hint = HM_TRI_NONE;
    for (size_t i = chunk * CHUNK; i < end; i++) {
        const double *p = q->xy + q->item[i].index * q->stride;
        q->tri[q->item[i].index] = hm_tri_locate(q->t, p[0], p[1], &hint);
    }
}

enum hm_err hm_tri_locate_all(const struct hm_tri *t, const double *xy, size_t n, size_t stride,
                              int threads, int32_t *tri, struct hm_diag *d)
{
    if (n > UINT32_MAX)
        return hm_fail(d, HM_EARG, "more than 2^32 points to locate at once");
    struct hm_order_item *item = hm_alloc(n, 2 * sizeof *item);
    if (!item)
        return hm_fail_memory(d);
    enum hm_err err = hm_order_sort(xy, n, stride, HM_ORDER_COARSE, threads, item, item + n, d);
    struct queries q = {.t = t, .xy = xy, .n = n, .stride = stride, .item = item, .tri = tri};
    if (!err)
        hm_thread_for(threads, (n + CHUNK - 1) / CHUNK, locate_chunk, &q);
    free(item);
    return err;
}
