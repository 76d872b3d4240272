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

/* The vertex found nearest so far. */
struct nearest {
    const double *p;
    int32_t v;
    double distance;
};

/* Look at v, or when it is removed at one with a number near it. */
static void look_at(const struct hm_tri *t, struct nearest *n, int32_t v)
{
    enum { TRIES = 64 };
    int32_t last = v + TRIES < t->vertices ? v + TRIES : t->vertices;
    while (v < last && !hm_tri_is_used(t, v))
        v++;
    if (v == last)
        return;
    double here = distance(hm_tri_at(t, v), n->p);
    if (n->v == HM_TRI_NONE || here < n->distance) {
        n->v = v;
        n->distance = here;
    }
}

/* Where p would stand among the vertices that are in order. */
static int32_t find_in_order(const struct hm_tri *t, const double *p)
{
    uint32_t key = hm_order_key(&t->frame, p);
    int32_t low = 0, high = t->built;
    while (high - low > 1) {
        int32_t mid = low + (high - low) / 2;
        if (hm_order_key(&t->frame, hm_tri_at(t, mid)) <= key)
            low = mid;
        else
            high = mid;
    }
    return low;
}

/* Look at some vertices, spread evenly over the numbers not under `from` (jump and walk). */
static void look_around(const struct hm_tri *t, struct nearest *n, int32_t from)
{
    int32_t some = t->vertices - from, samples = some > 0 ? (int32_t)cbrt(some) + 1 : 0;
    for (int32_t i = 0; i < samples; i++)
        look_at(t, n, from + (int32_t)((int64_t)some * i / samples));
}

/* A triangle at vertex v; as built, 2v or one near it, give or take the last two. */
static int32_t triangle_near(const struct hm_tri *t, int32_t v)
{
    if (t->edge)
        return t->edge[v] / 3;
    return v < t->vertices - 1 ? 2 * v : 2 * v - 2;
}

/* A good place to begin a walk to p: of the vertices as built those beside p in their order along
 * the curve; of those added later, which are in no order, the nearest of a few. */
static int32_t jump(const struct hm_tri *t, const double *p)
{
    struct nearest n = {.p = p, .v = HM_TRI_NONE};
    int32_t here = find_in_order(t, p);
    look_at(t, &n, here);
    if (here + 1 < t->built)
        look_at(t, &n, here + 1);
    look_around(t, &n, t->built);
    if (n.v == HM_TRI_NONE)
        look_around(t, &n, 0);
    for (int32_t v = 0; n.v == HM_TRI_NONE; v++) /* not all vertices can be removed */
        look_at(t, &n, v);
    return triangle_near(t, n.v);
}

int32_t hm_tri_edge_of(const struct hm_tri *t, int32_t v)
{
    if (t->edge)
        return t->edge[v];
    int32_t e = 3 * hm_tri_find(t, hm_tri_at(t, v), triangle_near(t, v));
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
