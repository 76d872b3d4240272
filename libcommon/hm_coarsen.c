/* hm_coarsen: see hm_coarsen.h. */
#include "hm_coarsen.h"
#include "hm_pred.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdlib.h>

struct round {
    struct hm_domain *dom;
    double least2, most2;
    bool *busy; /* free nodes that are part of a collapse already */
    bool *gone; /* nodes that end with this round */
    int64_t n;
};

/* Two or three vertices that become one: the first, at x, y, z. */
struct cluster {
    int32_t v[3];
    int size;
    double length2; /* sum over its edges: the shorter the sooner */
    double x, y, z;
};

static enum hm_err begin(struct round *r, struct hm_domain *dom, const struct hm_lengths *l,
                         int threads, struct hm_diag *d)
{
    *r = (struct round){.dom = dom, .least2 = l->least * l->least, .most2 = l->most * l->most};
    enum hm_err err = hm_domain_triangulate(dom, threads, d);
    if (err)
        return err;
    r->busy = hm_alloc0(dom->nnodes, sizeof *r->busy);
    r->gone = hm_alloc0(dom->nnodes, sizeof *r->gone);
    return r->busy && r->gone ? HM_OK : hm_fail_memory(d);
}

static enum hm_err end(struct round *r, enum hm_err err, int64_t *n, struct hm_diag *d)
{
    if (!err && r->n > 0)
        err = hm_domain_remove(r->dom, r->gone, d);
    free(r->busy);
    free(r->gone);
    *n = r->n;
    return err;
}

static struct hm_node *node_at(const struct round *r, int32_t v)
{
    return &r->dom->node[r->dom->node_of[v]];
}

static bool is_free(const struct round *r, int32_t v)
{
    return !(node_at(r, v)->flags & HM_NODE_FIXED);
}

/* Free and in no collapse yet, or fixed: several may collapse onto one fixed node. */
static bool is_ready(const struct round *r, int32_t v)
{
    return !r->busy[r->dom->node_of[v]];
}

/* --- what becomes of a cluster --- */

static void swap(int32_t *a, int32_t *b)
{
    int32_t c = *a;
    *a = *b;
    *b = c;
}

/* The centre of the vertices; or the fixed one among them; or of two fixed ones the one nearer to
 * the free one, which alone then goes. Expects that one at least is free. */
static void aim(const struct round *r, struct cluster *c)
{
    int fixed = 0;
    for (int k = 0; k < c->size; k++)
        if (!is_free(r, c->v[k]))
            swap(&c->v[k], &c->v[fixed++]);
    if (fixed == 2) {
        const struct hm_node *last = node_at(r, c->v[2]);
        if (hm_node_distance2(node_at(r, c->v[1]), last) <
            hm_node_distance2(node_at(r, c->v[0]), last))
            swap(&c->v[0], &c->v[1]);
        swap(&c->v[1], &c->v[2]);
        c->size = 2;
    }
    int count = fixed ? 1 : c->size;
    c->x = c->y = c->z = 0;
    for (int k = 0; k < count; k++) {
        const struct hm_node *node = node_at(r, c->v[k]);
        c->x += node->x / count;
        c->y += node->y / count;
        c->z += node->z / count;
    }
}

/* Would a neighbour of v be farther from the new node than the maximum, and farther than it is from
 * v now? */
static bool stretches(const struct round *r, int32_t v, const struct cluster *c)
{
    const struct hm_tri *t = r->dom->tri;
    const struct hm_node there = {.x = c->x, .y = c->y};
    int32_t first = hm_tri_edge_from(t, v), e = first;
    do {
        if (hm_domain_is_inside(r->dom, e / 3)) {
            const struct hm_node *w = node_at(r, hm_tri_dest(t, e));
            double then2 = hm_node_distance2(w, &there);
            if (then2 > r->most2 && then2 > hm_node_distance2(w, node_at(r, v)))
                return true;
        }
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return false;
}

/* Is the new node strictly left of the edges that follow e in its triangle (as of e itself, when
 * `all`)? Rounding can put the centre of a flat triangle outside, beyond a fixed edge even. */
static bool is_within(const struct round *r, int32_t e, const struct cluster *c, bool all)
{
    const struct hm_tri *t = r->dom->tri;
    const double at[2] = {c->x, c->y};
    const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
    const double *top = hm_tri_xy(t, hm_tri_apex(t, e));
    return (!all || hm_pred_orient(a, b, at) > 0) && hm_pred_orient(b, top, at) > 0 &&
           hm_pred_orient(top, a, at) > 0;
}

/* May the cluster at edge e (a triangle: left of it) become one node? Fills in where. */
static bool may_collapse(const struct round *r, int32_t e, struct cluster *c)
{
    int whole = c->size;
    aim(r, c);
    bool moves = is_free(r, c->v[0]);
    if (moves && whole == 3 && !is_within(r, e, c, true))
        return false;
    if (moves && whole == 2 &&
        !(is_within(r, e, c, false) && is_within(r, hm_tri_twin(r->dom->tri, e), c, false)))
        return false;
    for (int k = moves ? 0 : 1; k < c->size; k++)
        if (stretches(r, c->v[k], c))
            return false;
    return true;
}

static void collapse(struct round *r, const struct cluster *c)
{
    struct hm_node *node = node_at(r, c->v[0]);
    if (is_free(r, c->v[0])) {
        node->x = c->x;
        node->y = c->y;
        node->z = c->z;
        node->flags |= HM_NODE_NEW;
        r->busy[r->dom->node_of[c->v[0]]] = true;
    }
    for (int k = 1; k < c->size; k++) {
        r->busy[r->dom->node_of[c->v[k]]] = true;
        r->gone[r->dom->node_of[c->v[k]]] = true;
    }
    r->n++;
}

/* --- which clusters --- */

/* A total order that does not depend on where the walk around a vertex begins. */
static bool comes_first(const struct cluster *a, const struct cluster *b)
{
    if (a->length2 != b->length2)
        return a->length2 < b->length2;
    int32_t a0 = a->v[1], a1 = a->v[a->size - 1], b0 = b->v[1], b1 = b->v[b->size - 1];
    int32_t a_low = a0 < a1 ? a0 : a1, b_low = b0 < b1 ? b0 : b1;
    return a_low != b_low ? a_low < b_low : a0 + a1 - a_low < b0 + b1 - b_low;
}

/* The cluster at e (size 2: the edge, 3: its triangle), if all its edges are short enough and its
 * vertices are ready. */
static bool cluster_at(const struct round *r, int32_t e, int size, struct cluster *c)
{
    const struct hm_tri *t = r->dom->tri;
    *c = (struct cluster){.v = {hm_tri_org(t, e), hm_tri_dest(t, e), hm_tri_apex(t, e)},
                          .size = size};
    if (!hm_domain_is_inside(r->dom, e / 3))
        return false;
    for (int k = 0; k < (size == 2 ? 1 : 3); k++) {
        double length2 = hm_node_distance2(node_at(r, c->v[k]), node_at(r, c->v[(k + 1) % 3]));
        if (length2 >= r->least2)
            return false;
        c->length2 += length2;
    }
    for (int k = 0; k < size; k++)
        if (!is_ready(r, c->v[k]))
            return false;
    return true;
}

/* Go through the vertices, in spatial order, and let each collapse with its nearest. */
static enum hm_err collapse_round(struct hm_domain *dom, const struct hm_lengths *l, int size,
                                  int threads, int64_t *n, struct hm_diag *d)
{
    struct round r;
    enum hm_err err = begin(&r, dom, l, threads, d);
    for (int32_t v = 0; !err && v < hm_tri_vertices(dom->tri); v++) {
        if (dom->node_of[v] < 0 || !is_free(&r, v) || !is_ready(&r, v))
            continue;
        struct cluster best = {.size = 0};
        int32_t first = hm_tri_edge_from(dom->tri, v), e = first;
        struct cluster key = {.size = 0}; /* best as found: aim() turns its vertices around */
        do {
            struct cluster c;
            if (cluster_at(&r, e, size, &c) && (key.size == 0 || comes_first(&c, &key))) {
                struct cluster aimed = c;
                if (may_collapse(&r, e, &aimed)) {
                    best = aimed;
                    key = c;
                }
            }
            e = hm_tri_twin(dom->tri, hm_tri_prev(e));
        } while (e != first);
        if (best.size > 0)
            collapse(&r, &best);
    }
    return end(&r, err, n, d);
}

enum hm_err hm_coarsen_triangles(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                                 int64_t *n, struct hm_diag *d)
{
    return collapse_round(dom, l, 3, threads, n, d);
}

enum hm_err hm_coarsen_edges(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                             int64_t *n, struct hm_diag *d)
{
    return collapse_round(dom, l, 2, threads, n, d);
}

/* --- too near to a fixed edge --- */

static enum hm_err index_edges(const struct hm_domain *dom, struct hm_segindex **index,
                               struct hm_diag *d)
{
    struct hm_segment *s = hm_alloc0(dom->nedges, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_node *a = &dom->node[dom->edge[k].a], *b = &dom->node[dom->edge[k].b];
        s[k] = (struct hm_segment){{a->x, a->y, 0}, {b->x, b->y, 0}, (int32_t)k, 0};
    }
    enum hm_err err = hm_segindex_build(index, s, dom->nedges, d);
    free(s);
    return err;
}

enum hm_err hm_coarsen_clear(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                             int64_t *n, struct hm_diag *d)
{
    (void)threads;
    struct hm_segindex *index = NULL;
    bool *gone = hm_alloc0(dom->nnodes, sizeof *gone);
    enum hm_err err = gone ? index_edges(dom, &index, d) : hm_fail_memory(d);
    *n = 0;
    for (size_t i = 0; !err && i < dom->nnodes; i++) {
        const struct hm_node *node = &dom->node[i];
        double foot[3], distance;
        if (node->flags & HM_NODE_FIXED ||
            !hm_segindex_nearest(index, node->x, node->y, l->clearance, foot, &distance))
            continue;
        gone[i] = true;
        ++*n;
    }
    if (!err && *n > 0)
        err = hm_domain_remove(dom, gone, d);
    hm_segindex_free(index);
    free(gone);
    return err;
}
