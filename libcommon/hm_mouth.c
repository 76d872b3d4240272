#include "hm_mouth.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

/* A notch between the outline and the higher border must be no narrower than this, since other
 * elements may have to fill it; nor, in a sharp junction, than this part of the junction's angle.
 */
static const double notch_degrees = 20, notch_part = 0.6;

/* A node of the outline may be left out when the outline without it passes so near: in edges. */
static const double most_off = 0.25;

/* How many nodes of the outline may be left out at its end, to get a better one. */
enum { MOST_TRIMMED = 12 };

/* --- mouths: the stretches of the higher border inside the lower mesh --- */

/* Crossings with their numbers, to be sorted along the higher border. */
struct along {
    size_t edge;
    double at;
    size_t number;
};

static int by_place(const void *pa, const void *pb)
{
    const struct along *a = pa, *b = pb;
    if (a->edge != b->edge)
        return a->edge < b->edge ? -1 : 1;
    if (a->at != b->at)
        return a->at < b->at ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

/* The higher border's node next to a crossing on the inner side of the mouth, as place in it. */
static size_t inner_place(const struct hm_border *h, const struct hm_crossing *x)
{
    if (x->enter)
        return x->at >= 1 ? h->next[x->edge] : x->edge;
    return x->at <= 0 ? x->edge : h->next[x->edge];
}

static size_t place_before(const struct hm_border *h, const size_t *prev, size_t place, bool back)
{
    return back ? prev[place] : h->next[place];
}

/* Attach a crossing to the border's node at `place`; beyond lies away from the mouth: back along
 * the border where the mouth begins (the outline leaves), onward where it ends. */
static void attach(const struct hm_border *h, const size_t *prev, struct hm_crossing *x,
                   size_t place)
{
    x->attach = h->loops.node[place];
    x->beyond = h->loops.node[place_before(h, prev, place, !x->enter)];
    x->inward = h->loops.node[place_before(h, prev, place, x->enter)];
}

static double distance_from(const struct hm_border *h, const struct hm_crossing *x, size_t place)
{
    double at[2];
    const double *p = hm_border_from(h, place);
    hm_border_at(h, x->edge, x->at, at);
    return hypot(at[0] - p[0], at[1] - p[1]);
}

/* The nearer end of the edge in which a crossing lies. */
static size_t nearest_place(const struct hm_border *h, const size_t *prev,
                            const struct hm_crossing *x)
{
    size_t inner = inner_place(h, x), outer = place_before(h, prev, inner, !x->enter);
    return distance_from(h, x, outer) < distance_from(h, x, inner) ? outer : inner;
}

/* A mouth from crossing `begin` to crossing `end` takes the nodes nearest to these. It needs two:
 * where they are the same, the next one is taken at the side where it is nearer, and of a mouth
 * inside one edge both ends of that. True when so. */
static bool open_mouth(const struct hm_border *h, const size_t *prev, struct hm_crossing *begin,
                       struct hm_crossing *end)
{
    size_t first = inner_place(h, begin), last = inner_place(h, end);
    if (first == h->next[last] && begin->edge == end->edge && begin->at <= end->at) {
        attach(h, prev, begin, prev[first]);
        attach(h, prev, end, h->next[last]);
        return true;
    }
    first = nearest_place(h, prev, begin);
    last = nearest_place(h, prev, end);
    bool same = first == last;
    if (same && distance_from(h, begin, prev[first]) < distance_from(h, end, h->next[last]))
        first = prev[first];
    else if (same)
        last = h->next[last];
    attach(h, prev, begin, first);
    attach(h, prev, end, last);
    return same;
}

enum hm_err hm_mouth_find(struct hm_stretches *c, const struct hm_border *h, int64_t *widened,
                          struct hm_diag *d)
{
    struct along *order = hm_alloc(c->ncrossings, sizeof *order);
    size_t *prev = hm_alloc(h->n, sizeof *prev);
    if (!order || !prev) {
        free(order);
        free(prev);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < h->n; i++)
        prev[h->next[i]] = i;
    for (size_t i = 0; i < c->ncrossings; i++) {
        struct hm_crossing *x = &c->crossing[i];
        order[i] = (struct along){x->edge, x->at, i};
        attach(h, prev, x, inner_place(h, x));
    }
    if (c->ncrossings > 0)
        qsort(order, c->ncrossings, sizeof *order, by_place);
    for (size_t k = 0, i = 0; k < h->loops.nloops; k++) {
        size_t begin = i;
        while (i < c->ncrossings && order[i].edge < h->loops.start[k + 1])
            i++;
        for (size_t j = begin; j < i; j++) {
            struct hm_crossing *end = &c->crossing[order[j].number];
            struct hm_crossing *start = &c->crossing[order[j > begin ? j - 1 : i - 1].number];
            if (end->enter && !start->enter)
                *widened += open_mouth(h, prev, start, end);
        }
    }
    free(order);
    free(prev);
    return HM_OK;
}

/* --- the outline's last node --- */

/* Does the way from p to q, which is allowed to end at nodes of the border, meet it elsewhere? */
static bool is_hidden(const struct hm_border *b, const double *p, const double *q)
{
    struct hm_boxquery query = hm_boxtree_find(b->tree, hm_box_of(p, q));
    for (int32_t k; (k = hm_boxtree_next(&query)) >= 0;) {
        const double *from = hm_border_from(b, (size_t)k), *to = hm_border_to(b, (size_t)k);
        const double *end = NULL, *other = NULL; /* the end of the way that is a node of the edge */
        for (int i = 0; i < 4; i++) {
            const double *mine = i & 1 ? p : q, *theirs = i & 2 ? from : to;
            if (mine[0] == theirs[0] && mine[1] == theirs[1]) {
                end = mine;
                other = i & 2 ? to : from;
            }
        }
        if (!end) {
            if (hm_plane_meet(p, q, from, to))
                return true;
        } else if (hm_pred_orient(p, q, other) == 0 &&
                   hm_plane_angle(end, end == p ? q : p, other) < 90) {
            return true; /* along the edge */
        }
    }
    return false;
}

/* The outline in the order in which its nodes may be left out: node(k) is node[k * step]. */
struct tail {
    const int32_t *node;
    ptrdiff_t step;
};

static int32_t tail_node(const struct tail *t, size_t k)
{
    return t->node[(ptrdiff_t)k * t->step];
}

static bool is_left_out(const struct tail *t, size_t j, int32_t node)
{
    for (size_t k = 0; k < j; k++)
        if (tail_node(t, k) == node)
            return true;
    return false;
}

/* Does the way from p to q cross the outline, other than where nodes before number j are left out?
 */
static bool crosses(const struct hm_border *b, const struct tail *t, size_t j, const double *p,
                    const double *q)
{
    struct hm_boxquery query = hm_boxtree_find(b->tree, hm_box_of(p, q));
    for (int32_t k; (k = hm_boxtree_next(&query)) >= 0;)
        if (hm_plane_cross(p, q, hm_border_from(b, (size_t)k), hm_border_to(b, (size_t)k)) &&
            !is_left_out(t, j, b->loops.node[k]) && !is_left_out(t, j, b->loops.node[b->next[k]]))
            return true;
    return false;
}

/* What speaks against ending the outline at node `j`, counted from the crossing; INT_MAX: it cannot
 * be. */
static int objection(const struct hm_crossing *x, const struct tail *t, size_t j, double notch,
                     const struct hm_sides *s)
{
    int32_t last = tail_node(t, j);
    const struct hm_mesh *higher = s->higher->mesh;
    const double *p = hm_mesh_xy(s->lower, last), *r = hm_mesh_xy(higher, x->attach);
    if (is_hidden(s->higher, p, r) || is_hidden(s->rest, p, r))
        return INT_MAX;
    int against = 0;
    bool off = crosses(s->outline, t, j, p, r);
    for (size_t k = 0; k < j; k++)
        off |= hm_plane_distance(hm_mesh_xy(s->lower, tail_node(t, k)), p, r) >
               most_off * s->size[last];
    if (off)
        against += 4;
    if (hm_plane_angle(r, hm_mesh_xy(higher, x->beyond), p) < notch)
        against += 2;
    double inside = hm_plane_angle(r, hm_mesh_xy(higher, x->inward), p);
    if (inside < notch_degrees)
        against += inside < notch_degrees / 2 ? 5 : 2; /* a needle is worse than a bank bent */
    if (!s->kept[last] && hm_border_is_near(s->higher, p, HM_SIDES_CLEAR, s->size[last]))
        against += hm_border_is_near(s->higher, p, HM_SIDES_CLEAR / 2, s->size[last]) ? 3 : 1;
    return against;
}

enum hm_err hm_mouth_attach(const struct hm_stretches *c, const struct hm_stretch *stretch,
                            bool at_end, const struct hm_sides *s, size_t limit, size_t *found,
                            struct hm_diag *d)
{
    const struct hm_crossing *x = &c->crossing[at_end ? stretch->to : stretch->from];
    const int32_t *node = c->node + stretch->first + (at_end ? stretch->count - 1 : 0);
    const struct tail tail = {node, at_end ? -1 : 1};
    double place[2];
    hm_border_at(s->higher, x->edge, x->at, place);
    double junction =
        hm_plane_angle(place, hm_mesh_xy(s->higher->mesh, x->beyond), hm_mesh_xy(s->lower, *node));
    double notch = fmin(notch_degrees, notch_part * junction);
    int least = INT_MAX;
    for (size_t j = 0; j < limit && j < MOST_TRIMMED && least > 0; j++) {
        int against = objection(x, &tail, j, notch, s);
        if (against < least) {
            least = against;
            *found = at_end ? stretch->count - 1 - j : j;
        }
        if (s->kept[tail_node(&tail, j)])
            break; /* a node of an element that stays cannot be left out */
    }
    if (least < INT_MAX)
        return HM_OK;
    return hm_fail_at(d, HM_EGEOM, place[0], place[1],
                      "no way to join the outline to the mesh of higher priority; "
                      "try another buffer");
}
