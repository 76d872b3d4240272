/* hm_tri_conquer: Delaunay triangulation by divide and conquer (Guibas & Stolfi 1985, with cuts in
 * both directions, Dwyer 1987), on triangles with ghosts (Shewchuk 1996).
 *
 * The points come in Morton order, so that a range of them is cut in two by the first bit in which
 * its keys differ: all of the lower part lies strictly to the left of, or below, the rest. There is
 * nothing to partition, and what is merged lies together in memory. A triangulation of m points has
 * 2m - 2 triangles, ghosts included, and a merge adds two: the points [lo, hi) own the slots
 * 2lo .. 2hi-3, and the merge at mid takes the two left over, 2mid-2 and 2mid-1. So nothing is
 * allocated, and halves can be done by different threads.
 *
 * Below, "left" and "right" are the lower and the upper part; when the cut is a horizontal line the
 * picture is turned by a quarter, left is below and up is towards smaller x.
 */
#include "hm_tri_topology.h"

#include "hm_order.h"
#include "hm_thread.h"

/* A triangulated range. A ghost is named by its finite half-edge: for the hull edge v → w, counter-
 * clockwise around, that is w → v. With a single point there are no ghosts. */
struct part {
    int32_t single;    /* the point when there is but one */
    int32_t low, high; /* ghosts at the lower and the upper end of the last merge, or HM_TRI_NONE */
};

struct work {
    struct hm_tri_half *half;
    const double *xy;
    uint32_t *key;
};

/* A merge as it rises: left.v and right.v are the ends of the base edge, left.ghost that of the
 * hull edge that leaves left.v upwards, right.ghost that of the one that comes down to right.v. */
struct rim {
    int32_t v, ghost;
};

static inline const double *at(const struct work *w, int32_t v)
{
    return w->xy + 2 * (size_t)v;
}

static inline int32_t org(const struct work *w, int32_t e)
{
    return w->half[e].org;
}

static inline int32_t twin(const struct work *w, int32_t e)
{
    return w->half[e].twin;
}

/* The ghost of the hull edge behind or before that of g, counter-clockwise. */
static inline int32_t hull_next(const struct work *w, int32_t g)
{
    return hm_tri_prev(twin(w, hm_tri_prev(g)));
}

static inline int32_t hull_prev(const struct work *w, int32_t g)
{
    return hm_tri_next(twin(w, hm_tri_next(g)));
}

static void set_triangle(const struct work *w, int32_t tri, int32_t a, int32_t b, int32_t c)
{
    struct hm_tri_half *h = w->half + 3 * (size_t)tri;
    h[0].org = a;
    h[1].org = b;
    h[2].org = c;
}

/* Tie the ghosts of a hull together; ghost[i]'s hull edge ends where ghost[i+1]'s begins. */
static void tie_ghosts(const struct work *w, const int32_t *ghost, int n)
{
    for (int i = 0; i < n; i++)
        hm_tri_pair(w->half, hm_tri_prev(ghost[i]), hm_tri_next(ghost[(i + 1) % n]));
}

static struct part two_points(const struct work *w, int32_t a)
{
    int32_t t = 2 * a, b = a + 1;
    set_triangle(w, t, a, b, HM_TRI_INFINITY);
    set_triangle(w, t + 1, b, a, HM_TRI_INFINITY);
    hm_tri_pair(w->half, 3 * t, 3 * t + 3);
    tie_ghosts(w, (int32_t[]){3 * t, 3 * t + 3}, 2);
    return (struct part){.single = HM_TRI_NONE, .low = 3 * t, .high = 3 * t + 3};
}

static bool is_before(const double *p, const double *q, int axis)
{
    if (axis == 0)
        return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
    return p[1] < q[1] || (p[1] == q[1] && p[0] > q[0]);
}

/* Three points on a line: two edges with a ghost on each side. */
static struct part three_in_line(const struct work *w, int32_t first)
{
    int32_t v[3] = {first, first + 1, first + 2}, t = 2 * first;
    for (int i = 0; i < 3; i++) {
        int32_t k = i == 1 ? 1 : 0, swap = v[k];
        if (is_before(at(w, v[k + 1]), at(w, v[k]), 0)) {
            v[k] = v[k + 1];
            v[k + 1] = swap;
        }
    }
    int32_t ghost[4] = {3 * t, 3 * t + 3, 3 * t + 6, 3 * t + 9};
    set_triangle(w, t, v[1], v[0], HM_TRI_INFINITY);
    set_triangle(w, t + 1, v[2], v[1], HM_TRI_INFINITY);
    set_triangle(w, t + 2, v[1], v[2], HM_TRI_INFINITY);
    set_triangle(w, t + 3, v[0], v[1], HM_TRI_INFINITY);
    hm_tri_pair(w->half, ghost[0], ghost[3]);
    hm_tri_pair(w->half, ghost[1], ghost[2]);
    tie_ghosts(w, ghost, 4);
    return (struct part){.single = HM_TRI_NONE, .low = ghost[0], .high = ghost[2]};
}

static struct part three_points(const struct work *w, int32_t a)
{
    int32_t b = a + 1, c = a + 2, t = 2 * a;
    int turn = hm_pred_orient_fast(at(w, a), at(w, b), at(w, c));
    if (turn == 0)
        return three_in_line(w, a);
    if (turn < 0) {
        b = a + 2;
        c = a + 1;
    }
    int32_t ghost[3] = {3 * t + 3, 3 * t + 6, 3 * t + 9};
    set_triangle(w, t, a, b, c);
    set_triangle(w, t + 1, b, a, HM_TRI_INFINITY);
    set_triangle(w, t + 2, c, b, HM_TRI_INFINITY);
    set_triangle(w, t + 3, a, c, HM_TRI_INFINITY);
    for (int i = 0; i < 3; i++)
        hm_tri_pair(w->half, 3 * t + i, ghost[i]);
    tie_ghosts(w, ghost, 3);
    return (struct part){.single = HM_TRI_NONE, .low = ghost[0], .high = ghost[1]};
}

/* The ghost of the hull edge that leaves the last vertex in the direction of the axis. On a convex
 * hull the way up is always up, even where the hull is but a line. */
static int32_t climb_to_last(const struct work *w, int32_t g, int axis)
{
    int32_t v = org(w, hm_tri_next(g)), start = g;
    while (is_before(at(w, v), at(w, org(w, g)), axis)) {
        v = org(w, g);
        g = hull_next(w, g);
    }
    if (g != start)
        return g;
    for (;;) {
        int32_t before = hull_prev(w, g), u = org(w, hm_tri_next(before));
        if (!is_before(at(w, v), at(w, u), axis))
            return g;
        v = u;
        g = before;
    }
}

/* The ghost of the hull edge that comes to the first vertex in the direction of the axis. */
static int32_t climb_to_first(const struct work *w, int32_t g, int axis)
{
    int32_t v = org(w, g), start = g;
    while (is_before(at(w, org(w, hm_tri_next(g))), at(w, v), axis)) {
        v = org(w, hm_tri_next(g));
        g = hull_prev(w, g);
    }
    if (g != start)
        return g;
    for (;;) {
        int32_t after = hull_next(w, g), u = org(w, after);
        if (!is_before(at(w, u), at(w, v), axis))
            return g;
        v = u;
        g = after;
    }
}

/* Move the two ends down to the lower common tangent. */
static void find_tangent(const struct work *w, struct rim *left, struct rim *right)
{
    for (;;) {
        const double *l = at(w, left->v), *r = at(w, right->v);
        if (left->ghost != HM_TRI_NONE) {
            int32_t g = hull_prev(w, left->ghost), v = org(w, hm_tri_next(g));
            if (hm_pred_orient_fast(l, r, at(w, v)) < 0) {
                *left = (struct rim){v, g};
                continue;
            }
        }
        if (right->ghost != HM_TRI_NONE) {
            int32_t g = hull_next(w, right->ghost), v = org(w, g);
            if (hm_pred_orient_fast(l, r, at(w, v)) < 0) {
                *right = (struct rim){v, g};
                continue;
            }
        }
        return;
    }
}

/* Take away hull edges at left->v while the triangle behind has its apex inside the circle through
 * the base and the far end; that triangle becomes the ghost of the edge above it. */
static void peel_left(const struct work *w, const struct rim *left, const struct rim *right)
{
    struct hm_tri_half *half = w->half;
    int32_t g = left->ghost;
    const double *l = at(w, left->v), *r = at(w, right->v);
    for (;;) {
        int32_t solid = twin(w, g), apex = org(w, hm_tri_prev(solid));
        if (apex == HM_TRI_INFINITY ||
            hm_pred_incircle_unique_fast(l, r, at(w, org(w, g)), at(w, apex)) <= 0)
            return;
        int32_t inner = twin(w, hm_tri_prev(solid)), above = twin(w, hm_tri_prev(g));
        half[g].org = apex;
        half[solid].org = HM_TRI_INFINITY;
        hm_tri_pair(half, solid, above);
        hm_tri_pair(half, hm_tri_prev(solid), hm_tri_prev(g));
        hm_tri_pair(half, g, inner);
    }
}

static void peel_right(const struct work *w, const struct rim *left, const struct rim *right)
{
    struct hm_tri_half *half = w->half;
    int32_t g = right->ghost;
    const double *l = at(w, left->v), *r = at(w, right->v);
    for (;;) {
        int32_t far = hm_tri_next(g), solid = twin(w, g), apex = org(w, hm_tri_prev(solid));
        if (apex == HM_TRI_INFINITY ||
            hm_pred_incircle_unique_fast(l, r, at(w, org(w, far)), at(w, apex)) <= 0)
            return;
        int32_t inner = twin(w, hm_tri_next(solid)), above = twin(w, far);
        half[far].org = apex;
        half[hm_tri_next(solid)].org = HM_TRI_INFINITY;
        hm_tri_pair(half, solid, above);
        hm_tri_pair(half, hm_tri_next(solid), far);
        hm_tri_pair(half, g, inner);
    }
}

/* The ghosts below the first base edge (tri) and, once all is zipped up, above the last (tri + 1).
 */
static int32_t close_below(const struct work *w, int32_t tri, const struct rim *left,
                           const struct rim *right)
{
    struct hm_tri_half *half = w->half;
    int32_t e = 3 * tri, above = e + 3;
    set_triangle(w, tri, right->v, left->v, HM_TRI_INFINITY);
    if (left->ghost != HM_TRI_NONE)
        hm_tri_pair(half, e + 1, twin(w, hm_tri_next(left->ghost)));
    else
        hm_tri_pair(half, e + 1, above + 2);
    if (right->ghost != HM_TRI_NONE)
        hm_tri_pair(half, e + 2, twin(w, hm_tri_prev(right->ghost)));
    else
        hm_tri_pair(half, e + 2, above + 1);
    return e;
}

static int32_t close_above(const struct work *w, int32_t tri, const struct rim *left,
                           const struct rim *right, int32_t open)
{
    struct hm_tri_half *half = w->half;
    int32_t e = 3 * tri;
    set_triangle(w, tri, left->v, right->v, HM_TRI_INFINITY);
    hm_tri_pair(half, e, open);
    if (right->ghost != HM_TRI_NONE)
        hm_tri_pair(half, e + 1, hm_tri_prev(right->ghost));
    if (left->ghost != HM_TRI_NONE)
        hm_tri_pair(half, e + 2, hm_tri_next(left->ghost));
    return e;
}

/* Give the ghost of an end the other end as apex, and step up. `open` is the base edge seen from
 * below; returns that of the new triangle. */
static int32_t raise_left(const struct work *w, struct rim *left, const struct rim *right,
                          int32_t open)
{
    int32_t g = left->ghost;
    *left = (struct rim){org(w, g), hull_next(w, g)};
    w->half[hm_tri_prev(g)].org = right->v;
    hm_tri_pair(w->half, hm_tri_next(g), open);
    return hm_tri_prev(g);
}

static int32_t raise_right(const struct work *w, const struct rim *left, struct rim *right,
                           int32_t open)
{
    int32_t g = right->ghost;
    *right = (struct rim){org(w, hm_tri_next(g)), hull_prev(w, g)};
    w->half[hm_tri_prev(g)].org = left->v;
    hm_tri_pair(w->half, hm_tri_prev(g), open);
    return hm_tri_next(g);
}

/* Zip the two hulls together from the base edge upwards, until the upper tangent. */
static int32_t zip(const struct work *w, struct rim *left, struct rim *right, int32_t open)
{
    for (;;) {
        const double *l = at(w, left->v), *r = at(w, right->v);
        bool can_left =
            left->ghost != HM_TRI_NONE && hm_pred_orient_fast(l, r, at(w, org(w, left->ghost))) > 0;
        bool can_right = right->ghost != HM_TRI_NONE &&
                         hm_pred_orient_fast(l, r, at(w, org(w, hm_tri_next(right->ghost)))) > 0;
        if (can_left)
            peel_left(w, left, right);
        if (can_right)
            peel_right(w, left, right);
        if (can_left && can_right) {
            const double *a = at(w, org(w, left->ghost));
            const double *b = at(w, org(w, hm_tri_next(right->ghost)));
            can_left = hm_pred_incircle_unique_fast(l, r, a, b) <= 0;
        } else if (!can_left && !can_right) {
            return open;
        }
        open = can_left ? raise_left(w, left, right, open) : raise_right(w, left, right, open);
    }
}

/* Merge two parts, a before b along the axis; tri and tri + 1 are free slots. */
static struct part merge(const struct work *w, struct part a, struct part b, int axis, int32_t tri)
{
    struct rim left = {a.single, HM_TRI_NONE}, right = {b.single, HM_TRI_NONE};
    if (a.single == HM_TRI_NONE) {
        left.ghost = climb_to_last(w, axis == 0 ? a.low : a.high, axis);
        left.v = org(w, hm_tri_next(left.ghost));
    }
    if (b.single == HM_TRI_NONE) {
        right.ghost = climb_to_first(w, axis == 0 ? b.high : b.low, axis);
        right.v = org(w, right.ghost);
    }
    find_tangent(w, &left, &right);
    int32_t low = close_below(w, tri, &left, &right);
    int32_t open = zip(w, &left, &right, low);
    int32_t high = close_above(w, tri + 1, &left, &right, open);
    return (struct part){.single = HM_TRI_NONE, .low = low, .high = high};
}

/* A range whose points share a cell: give it keys of its own, as hm_order_sort did. */
static void part_cell(const struct work *w, int32_t lo, int32_t hi)
{
    struct hm_order_frame frame = hm_order_frame(at(w, lo), (size_t)(hi - lo), 2);
    for (int32_t v = lo; v < hi; v++)
        w->key[v] = hm_order_key(&frame, at(w, v));
}

/* Where the keys in [lo, hi) first part, and along which axis. */
static int32_t find_cut(const struct work *w, int32_t lo, int32_t hi, int *axis)
{
    if (w->key[lo] == w->key[hi - 1])
        part_cell(w, lo, hi);
    uint32_t differ = w->key[lo] ^ w->key[hi - 1];
    int bit = 31 - __builtin_clz(differ);
    *axis = bit & 1;
    while (hi - lo > 1) {
        int32_t mid = lo + (hi - lo) / 2;
        if (w->key[mid] >> bit & 1)
            hi = mid;
        else
            lo = mid;
    }
    return hi;
}

static struct part conquer(const struct work *w, int32_t lo, int32_t hi)
{
    if (hi - lo == 1)
        return (struct part){lo, HM_TRI_NONE, HM_TRI_NONE};
    if (hi - lo == 2)
        return two_points(w, lo);
    if (hi - lo == 3)
        return three_points(w, lo);
    int axis;
    int32_t mid = find_cut(w, lo, hi, &axis);
    struct part a = conquer(w, lo, mid), b = conquer(w, mid, hi);
    return merge(w, a, b, axis, 2 * mid - 2);
}

/* The first few cuts make a tree, node k above 2k+1 and 2k+2; its leaves are done side by side. */
enum { LEVELS = 7, NODES = (1 << LEVELS) - 1, SMALL = 4096 };

struct node {
    int32_t lo, hi, mid; /* mid 0: a leaf */
    int axis;
    struct part part;
};

struct tree {
    struct work work;
    struct node node[NODES];
    int leaf[NODES], leaves;
};

static void plant(struct tree *tree, int k, int32_t lo, int32_t hi)
{
    struct node *node = &tree->node[k];
    *node = (struct node){.lo = lo, .hi = hi};
    if (2 * k + 2 < NODES && hi - lo > SMALL) {
        node->mid = find_cut(&tree->work, lo, hi, &node->axis);
        plant(tree, 2 * k + 1, lo, node->mid);
        plant(tree, 2 * k + 2, node->mid, hi);
    } else {
        tree->leaf[tree->leaves++] = k;
    }
}

static void do_leaf(void *pointer, size_t leaf)
{
    struct tree *tree = pointer;
    struct node *node = &tree->node[tree->leaf[leaf]];
    node->part = conquer(&tree->work, node->lo, node->hi);
}

static struct part gather(struct tree *tree, int k)
{
    struct node *node = &tree->node[k];
    if (node->mid == 0)
        return node->part;
    struct part a = gather(tree, 2 * k + 1), b = gather(tree, 2 * k + 2);
    return merge(&tree->work, a, b, node->axis, 2 * node->mid - 2);
}

int32_t hm_tri_conquer(struct hm_tri_half *half, const double *xy, int32_t n, uint32_t *key,
                       int threads)
{
    struct tree tree = {.work = {.half = half, .xy = xy, .key = key}};
    plant(&tree, 0, 0, n);
    hm_thread_for(threads, (size_t)tree.leaves, do_leaf, &tree);
    return gather(&tree, 0).low;
}
