/* hm_even: see hm_even.h. */
#include "hm_even.h"
#include "hm_star.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 12,
    ONLY_MOVES = 3 /* rounds before nodes come and go */
};

/* The square of a cosine that any angle may have for a while. */
#define ANY_ANGLE 0.99

/* The edge between two elements, by its vertices, the lower one first. */
struct pair {
    int32_t a, b;
};

struct even {
    struct hm_domain *dom;
    struct hm_tri *t;
    const struct hm_even_options *o;
    struct hm_star_rules rules;
    struct hm_diag *d;
    int32_t first;     /* vertices from here on are new */
    struct pair *pair; /* bad ones */
    size_t n_pairs, cap_pairs;
    int32_t *touched; /* vertices around which triangles have changed */
    size_t n_touched, cap_touched;
};

static bool is_free(const struct even *w, int32_t v)
{
    return v >= w->first ||
           (w->dom->node_of[v] >= 0 && !(w->dom->node[w->dom->node_of[v]].flags & HM_NODE_FIXED));
}

/* --- one vertex and what is around --- */

/* The best place in a star that a search by ever smaller steps from p finds; how bad it is. */
static double search(const struct even *w, const struct hm_star *s, double p[2])
{
    const double step[8][2] = {{1, 0},  {0.7, 0.7},   {0, 1},  {-0.7, 0.7},
                               {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}};
    double best = hm_star_rate(&w->rules, s, p);
    for (double size = 0.3 * s->shortest; best > 0 && size > 0.01 * s->shortest; size /= 2) {
        bool better = true;
        for (int n = 0; better && best > 0 && n < 4; n++) {
            double from[2] = {p[0], p[1]};
            better = false;
            for (int k = 0; k < 8; k++) {
                double q[2] = {from[0] + size * step[k][0], from[1] + size * step[k][1]};
                double now = hm_star_rate(&w->rules, s, q);
                if (now < best) {
                    best = now;
                    memcpy(p, q, sizeof q);
                    better = true;
                }
            }
        }
    }
    return best;
}

/* --- a vertex moves --- */

static bool is_size_kept(const struct even *w, int32_t tri, const struct hm_star *s)
{
    const struct hm_tri *t = w->t;
    double p[2], most;
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++)
        if (hm_star_length2(hm_tri_xy(t, hm_tri_org(t, e)), hm_tri_xy(t, hm_tri_dest(t, e))) >
            s->longest)
            return false;
    hm_tri_centre(t, tri, p);
    most = hm_sizes_area((void *)w->o->sizes, p[0], p[1], hm_tri_region(t, tri));
    return most == 0 || hm_domain_area(w->dom, tri) <= fmax(most, s->largest);
}

/* Are all corners of a triangle on the rim of a star? */
static bool is_between_corners(const struct hm_tri *t, int32_t tri, const struct hm_star *s)
{
    int found = 0;
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++)
        for (int k = 0; k < s->n; k++)
            found += hm_tri_xy(t, hm_tri_org(t, e)) == s->corner[k];
    return found == 3;
}

/* Edges may have flipped, so that triangles are others than those that were rated: those around v,
 * and what it left behind, beside them. */
static bool are_sizes_kept(const struct even *w, int32_t v, const struct hm_star *s)
{
    const struct hm_tri *t = w->t;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    bool kept = true;
    do {
        int32_t beyond = hm_tri_twin(t, hm_tri_next(e)) / 3;
        kept = is_size_kept(w, e / 3, s) &&
               (!hm_domain_is_inside(w->dom, beyond) || !is_between_corners(t, beyond, s) ||
                is_size_kept(w, beyond, s));
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (kept && e != first);
    return kept;
}

/* Triangles around a vertex change, or have changed. */
static enum hm_err touch(struct even *w, int32_t v)
{
    int32_t first = hm_tri_edge_from(w->t, v), e = first;
    do {
        if (!hm_grow(&w->touched, &w->cap_touched, w->n_touched + 1, sizeof *w->touched))
            return hm_fail_memory(w->d);
        w->touched[w->n_touched++] = hm_tri_dest(w->t, e);
        e = hm_tri_twin(w->t, hm_tri_prev(e));
    } while (e != first);
    return HM_OK;
}

/* Move a vertex; back when that makes elements too large. */
static enum hm_err move(struct even *w, int32_t v, const double *p, const struct hm_star *s,
                        bool *moved)
{
    const double *at = hm_tri_xy(w->t, v), before[2] = {at[0], at[1]};
    size_t touched = w->n_touched;
    enum hm_err err = touch(w, v);
    if (!err)
        err = hm_tri_move(w->t, v, p[0], p[1], w->d);
    *moved = !err && are_sizes_kept(w, v, s);
    if (*moved)
        return touch(w, v);
    if (err == HM_EARG) /* no place for it */
        err = HM_OK;
    else if (!err)
        err = hm_tri_move(w->t, v, before[0], before[1], w->d);
    w->n_touched = touched;
    return err;
}

static enum hm_err relax(struct even *w, int32_t v)
{
    struct hm_star s;
    bool moved;
    if (!is_free(w, v) || !hm_star_look(&w->rules, v, &s))
        return HM_OK;
    const double *at = hm_tri_xy(w->t, v);
    double p[2] = {at[0], at[1]}, before = hm_star_rate(&w->rules, &s, p);
    return before > 0 && search(w, &s, p) < before ? move(w, v, p, &s, &moved) : HM_OK;
}

/* --- one pair --- */

/* Is the edge still there, and bad? Then *e is it, the larger element on its left, or the one
 * within the domain. */
static bool is_bad(const struct even *w, const struct pair *p, int32_t *e)
{
    *e = hm_tri_edge_between(w->t, p->a, p->b);
    if (*e == HM_TRI_NONE || hm_star_excess(&w->rules, *e) == 0)
        return false;
    if (hm_star_area(&w->rules, *e) < hm_star_area(&w->rules, hm_tri_twin(w->t, *e)))
        *e = hm_tri_twin(w->t, *e);
    return true;
}

static enum hm_err relax_around(struct even *w, const struct pair *p)
{
    int32_t e;
    enum hm_err err = HM_OK;
    for (int k = 0; !err && k < 4 && is_bad(w, p, &e); k++) {
        int32_t v = k == 0   ? hm_tri_apex(w->t, e)
                    : k == 1 ? hm_tri_apex(w->t, hm_tri_twin(w->t, e))
                    : k == 2 ? hm_tri_org(w->t, e)
                             : hm_tri_dest(w->t, e);
        if (v != HM_TRI_INFINITY)
            err = relax(w, v);
    }
    return err;
}

/* Where a new node would help: the middle of the longest edge of the triangle left of e, or its
 * centre when that edge is fixed. */
static void choose_place(const struct hm_tri *t, int32_t e, double p[2])
{
    const int32_t edge[3] = {e, hm_tri_next(e), hm_tri_prev(e)};
    const double *corner[3];
    int longest = 0;
    for (int k = 0; k < 3; k++)
        corner[k] = hm_tri_xy(t, hm_tri_org(t, edge[k]));
    for (int k = 1; k < 3; k++)
        if (hm_star_length2(corner[k], corner[(k + 1) % 3]) >
            hm_star_length2(corner[longest], corner[(longest + 1) % 3]))
            longest = k;
    const double *a = corner[longest], *b = corner[(longest + 1) % 3];
    for (int k = 0; k < 2; k++)
        p[k] = hm_tri_marks(t, edge[longest]) ? (corner[0][k] + corner[1][k] + corner[2][k]) / 3
                                              : (a[k] + b[k]) / 2;
}

/* A new node in the larger element, where that makes the pairs around better than this one is. */
static enum hm_err add_node(struct even *w, int32_t e)
{
    double before = hm_star_excess(&w->rules, e), p[2];
    int32_t v, vertices = hm_tri_vertices(w->t);
    if (!hm_domain_is_inside(w->dom, e / 3))
        return HM_OK;
    choose_place(w->t, e, p);
    enum hm_err err = hm_tri_insert(w->t, p[0], p[1], e / 3, &v, w->d);
    if (err || v < vertices)
        return err;
    struct hm_star s;
    bool good = hm_star_look(&w->rules, v, &s);
    if (good) {
        s.worst = ANY_ANGLE;
        search(w, &s, p);
        s.worst = w->rules.cos2;
        good = search(w, &s, p) < before;
    }
    if (good)
        err = move(w, v, p, &s, &good);
    return good || err ? err : hm_tri_remove(w->t, v, w->d);
}

/* --- all of them --- */

static int by_vertices(const void *pa, const void *pb)
{
    const struct pair *a = pa, *b = pb;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

/* Note the pair at an edge when it is bad. */
static enum hm_err check_pair(struct even *w, int32_t e)
{
    const struct hm_tri *t = w->t;
    if ((!hm_domain_is_inside(w->dom, e / 3) &&
         !hm_domain_is_inside(w->dom, hm_tri_twin(t, e) / 3)) ||
        hm_star_excess(&w->rules, e) == 0)
        return HM_OK;
    if (!hm_grow(&w->pair, &w->cap_pairs, w->n_pairs + 1, sizeof *w->pair))
        return hm_fail_memory(w->d);
    int32_t a = hm_tri_org(t, e), b = hm_tri_dest(t, e);
    w->pair[w->n_pairs++] = (struct pair){a < b ? a : b, a < b ? b : a};
    return HM_OK;
}

/* Pairs in order, each once. */
static void sort_pairs(struct even *w)
{
    size_t n = 0;
    if (w->n_pairs == 0)
        return;
    qsort(w->pair, w->n_pairs, sizeof *w->pair, by_vertices);
    for (size_t k = 0; k < w->n_pairs; k++)
        if (n == 0 || by_vertices(&w->pair[n - 1], &w->pair[k]) != 0)
            w->pair[n++] = w->pair[k];
    w->n_pairs = n;
}

static enum hm_err find_pairs(struct even *w)
{
    enum hm_err err = HM_OK;
    for (int32_t e = 0; !err && e < 3 * hm_tri_triangles(w->t); e++)
        if (hm_domain_is_inside(w->dom, e / 3))
            err = check_pair(w, e);
    sort_pairs(w);
    return err;
}

static int by_number(const void *pa, const void *pb)
{
    const int32_t *a = pa, *b = pb;
    return (*a > *b) - (*a < *b);
}

/* Of the pairs those that are still bad, and those that became so around what was touched. */
static enum hm_err find_pairs_again(struct even *w)
{
    const struct hm_tri *t = w->t;
    enum hm_err err = HM_OK;
    size_t n = 0;
    int32_t e;
    for (size_t k = 0; k < w->n_pairs; k++)
        if (is_bad(w, &w->pair[k], &e))
            w->pair[n++] = w->pair[k];
    w->n_pairs = n;
    if (w->n_touched > 0)
        qsort(w->touched, w->n_touched, sizeof *w->touched, by_number);
    for (size_t k = 0; !err && k < w->n_touched; k++) {
        int32_t v = w->touched[k],
                first = v == HM_TRI_INFINITY ? HM_TRI_NONE : hm_tri_edge_from(t, v);
        if (first == HM_TRI_NONE || (k > 0 && w->touched[k - 1] == v))
            continue;
        e = first;
        do {
            err = check_pair(w, e);
            if (!err)
                err = check_pair(w, hm_tri_next(e));
            e = hm_tri_twin(t, hm_tri_prev(e));
        } while (!err && e != first);
    }
    w->n_touched = 0;
    sort_pairs(w);
    return err;
}

static enum hm_err go(struct even *w)
{
    enum hm_err err = find_pairs(w);
    for (int round = 0; !err && round < ROUNDS && w->n_pairs > 0; round++) {
        for (size_t k = 0; !err && k < w->n_pairs; k++) {
            int32_t e;
            err = relax_around(w, &w->pair[k]);
            if (!err && round >= ONLY_MOVES && is_bad(w, &w->pair[k], &e))
                err = add_node(w, e);
        }
        if (!err)
            err = find_pairs_again(w);
    }
    return err;
}

/* Nodes are where their vertices are by now. */
static void take_places(struct even *w)
{
    for (int32_t v = 0; v < w->first; v++) {
        struct hm_node *node = is_free(w, v) ? &w->dom->node[w->dom->node_of[v]] : NULL;
        const double *at = hm_tri_xy(w->t, v);
        if (!node || (node->x == at[0] && node->y == at[1]))
            continue;
        node->x = at[0];
        node->y = at[1];
        node->flags |= HM_NODE_NEW;
    }
}

static void count_left(const struct even *w, struct hm_even_left *left)
{
    const struct hm_tri *t = w->t;
    for (size_t k = 0; k < w->n_pairs; k++) {
        int32_t e = hm_tri_edge_between(t, w->pair[k].a, w->pair[k].b);
        double one = hm_star_area(&w->rules, e), other = hm_star_area(&w->rules, hm_tri_twin(t, e));
        double ratio = fmin(one, other) > 0 ? fmax(one, other) / fmin(one, other) : 1;
        const double *a = hm_tri_xy(t, w->pair[k].a), *b = hm_tri_xy(t, w->pair[k].b);
        left->pairs += ratio > w->o->ratio;
        left->regular += ratio > w->o->ratio && (hm_tri_marks(t, e) & HM_EDGE_REGULAR);
        if (ratio <= left->worst)
            continue;
        left->worst = ratio;
        left->x = (a[0] + b[0]) / 2;
        left->y = (a[1] + b[1]) / 2;
    }
}

enum hm_err hm_even_reach(struct hm_domain *dom, const struct hm_even_options *o,
                          struct hm_even_left *left, struct hm_diag *d)
{
    *left = (struct hm_even_left){0};
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (err)
        return err;
    struct even w = {.dom = dom, .t = dom->tri, .o = o, .d = d, .first = hm_tri_vertices(dom->tri)};
    err = hm_star_open(&w.rules, dom, o->ratio, o->min_angle, o->sizes, d);
    if (!err)
        err = go(&w);
    if (!err) {
        take_places(&w);
        count_left(&w, left);
    }
    hm_star_close(&w.rules);
    free(w.pair);
    free(w.touched);
    return err ? err : hm_domain_adopt(dom, w.first, d);
}
