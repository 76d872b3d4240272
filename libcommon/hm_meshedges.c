#include "hm_meshedges.h"

#include "hm_pred.h"

#include <stdlib.h>
#include <string.h>

/* One use of an edge by an element. */
struct use {
    int32_t a, b, elem;
};

static int32_t low(const struct use *u)
{
    return u->a < u->b ? u->a : u->b;
}

static int32_t high(const struct use *u)
{
    return u->a < u->b ? u->b : u->a;
}

/* A stable counting sort of the uses by a node number. */
static void sort_uses(const struct use *from, struct use *to, size_t n,
                      int32_t (*node)(const struct use *), size_t *start, size_t nnodes)
{
    memset(start, 0, (nnodes + 1) * sizeof *start);
    for (size_t i = 0; i < n; i++)
        start[node(&from[i]) + 1]++;
    for (size_t k = 0; k < nnodes; k++)
        start[k + 1] += start[k];
    for (size_t i = 0; i < n; i++)
        to[start[node(&from[i])]++] = from[i];
}

static size_t list_uses(const struct hm_mesh *m, struct use *use)
{
    size_t n = 0;
    for (size_t i = 0; i < m->nelems; i++) {
        const struct hm_elem *e = &m->elem[i];
        int corners = hm_elem_corners(e);
        for (int k = 0; k < corners; k++)
            use[n++] = (struct use){e->node[k], e->node[(k + 1) % corners], (int32_t)i};
    }
    return n;
}

/* Uses of one edge, `n` of them side by side, become one edge, or n faulty ones. */
static size_t join_uses(const struct use *u, size_t n, struct hm_mesh_edge *edge)
{
    if (n == 1 || (n == 2 && u[0].a == u[1].b && u[0].a != u[0].b)) {
        *edge = (struct hm_mesh_edge){u->a, u->b, u->elem, n == 1 ? -1 : u[1].elem};
        return 1;
    }
    for (size_t i = 0; i < n; i++)
        edge[i] = (struct hm_mesh_edge){u[i].a, u[i].b, u[i].elem, -2};
    return n;
}

enum hm_err hm_mesh_edges(const struct hm_mesh *m, struct hm_mesh_edge **edges, size_t *n,
                          struct hm_diag *d)
{
    *n = 0;
    size_t uses = 0;
    for (size_t i = 0; i < m->nelems; i++)
        uses += (size_t)hm_elem_corners(&m->elem[i]);
    struct use *use = hm_alloc(uses, sizeof *use), *spare = hm_alloc(uses, sizeof *spare);
    size_t *start = hm_alloc(m->nnodes + 1, sizeof *start);
    *edges = hm_alloc(uses, sizeof **edges);
    if (use && spare && start && *edges) {
        list_uses(m, use);
        sort_uses(use, spare, uses, high, start, m->nnodes);
        sort_uses(spare, use, uses, low, start, m->nnodes);
        for (size_t i = 0, end; i < uses; i = end) {
            for (end = i + 1; end < uses; end++)
                if (low(&use[end]) != low(&use[i]) || high(&use[end]) != high(&use[i]))
                    break;
            *n += join_uses(use + i, end - i, *edges + *n);
        }
        struct hm_mesh_edge *fit = realloc(*edges, (*n ? *n : 1) * sizeof *fit);
        *edges = fit ? fit : *edges;
        free(use);
        free(spare);
        free(start);
        return HM_OK;
    }
    free(use);
    free(spare);
    free(start);
    free(*edges);
    *edges = NULL;
    return hm_fail_memory(d);
}

/* The boundary edges, grouped by the node where they start. */
struct border {
    size_t *first; /* of each node; nnodes + 1 */
    int32_t *to;   /* where the edge goes; -1 once it was walked */
    int32_t *left; /* the element left of it */
    size_t n;
};

static bool border_build(struct border *b, const struct hm_mesh_edge *edges, size_t n,
                         size_t nnodes)
{
    b->first = hm_alloc0(nnodes + 2, sizeof *b->first);
    b->n = 0;
    for (size_t i = 0; i < n; i++)
        b->n += edges[i].right == -1;
    b->to = hm_alloc(b->n, sizeof *b->to);
    b->left = hm_alloc(b->n, sizeof *b->left);
    if (!b->first || !b->to || !b->left)
        return false;
    for (size_t i = 0; i < n; i++)
        if (edges[i].right == -1)
            b->first[edges[i].a + 2]++;
    for (size_t k = 0; k < nnodes; k++)
        b->first[k + 2] += b->first[k + 1];
    for (size_t i = 0; i < n; i++) /* leaves first[k] where node k begins */
        if (edges[i].right == -1) {
            size_t place = b->first[edges[i].a + 1]++;
            b->to[place] = edges[i].b;
            b->left[place] = edges[i].left;
        }
    return true;
}

/* Is c, seen from `at`, met before b when one turns clockwise from the direction of a? */
static bool met_before(const double *at, const double *a, const double *c, const double *b)
{
    int ac = hm_pred_orient(at, a, c), ab = hm_pred_orient(at, a, b), cb = hm_pred_orient(at, c, b);
    if (ac <= 0) /* c within the first half turn */
        return ab > 0 || cb <= 0;
    return ab > 0 && cb <= 0;
}

/* The edge to go on with at node `at`, come from node `from`. The elements on the left of the way
 * fill the turn clockwise from where it came, so the next one so met bounds the same elements. */
static size_t next_edge(const struct border *b, const struct hm_mesh *m, int32_t from, int32_t at)
{
    size_t best = SIZE_MAX;
    const double *here = hm_mesh_xy(m, at), *back = hm_mesh_xy(m, from);
    for (size_t i = b->first[at]; i < b->first[at + 1]; i++) {
        if (b->to[i] < 0)
            continue;
        if (best == SIZE_MAX ||
            met_before(here, back, hm_mesh_xy(m, b->to[i]), hm_mesh_xy(m, b->to[best])))
            best = i;
    }
    return best;
}

/* Walk the loop that starts with edge `first` at `node`; its nodes and elements go behind those
 * that are there. The number of nodes, 0 at a dead end. A loop that touches itself passes a node
 * twice, so only the edge tells its end. */
static size_t walk(struct border *b, const struct hm_mesh *m, int32_t node, size_t first,
                   struct hm_mesh_loops *loops)
{
    int32_t *nodes = loops->node + loops->start[loops->nloops];
    int32_t *elems = loops->elem + loops->start[loops->nloops];
    size_t n = 0, edge = first;
    int32_t at = node;
    do {
        int32_t from = at;
        nodes[n] = from;
        elems[n++] = b->left[edge];
        at = b->to[edge];
        if (edge != first)
            b->to[edge] = -1;
        edge = next_edge(b, m, from, at);
    } while (edge != first && edge != SIZE_MAX);
    b->to[first] = -1;
    return edge == first ? n : 0;
}

static enum hm_err walk_all(struct border *b, const struct hm_mesh *m, struct hm_mesh_loops *loops,
                            struct hm_diag *d)
{
    size_t cap = 0;
    if (!hm_grow(&loops->start, &cap, 1, sizeof *loops->start))
        return hm_fail_memory(d);
    loops->start[0] = 0;
    for (size_t node = 0; node < m->nnodes; node++) {
        for (size_t i = b->first[node]; i < b->first[node + 1]; i++) {
            if (b->to[i] < 0)
                continue;
            size_t begin = loops->start[loops->nloops];
            size_t n = walk(b, m, (int32_t)node, i, loops);
            if (n == 0)
                return hm_fail_at(d, HM_EGEOM, m->node[node].x, m->node[node].y,
                                  "the boundary of the mesh is not closed");
            if (!hm_grow(&loops->start, &cap, loops->nloops + 2, sizeof *loops->start))
                return hm_fail_memory(d);
            loops->start[++loops->nloops] = begin + n;
        }
    }
    return HM_OK;
}

enum hm_err hm_mesh_boundary_of(const struct hm_mesh *m, const struct hm_mesh_edge *edges, size_t n,
                                struct hm_mesh_loops *loops, struct hm_diag *d)
{
    *loops = (struct hm_mesh_loops){0};
    for (size_t i = 0; i < n; i++)
        if (edges[i].right == -2)
            return hm_fail_at(d, HM_EGEOM, m->node[edges[i].a].x, m->node[edges[i].a].y,
                              "an edge is used more than twice, or twice in one direction");
    struct border b = {0};
    bool built = border_build(&b, edges, n, m->nnodes);
    loops->node = hm_alloc(b.n, sizeof *loops->node);
    loops->elem = hm_alloc(b.n, sizeof *loops->elem);
    enum hm_err err =
        built && loops->node && loops->elem ? walk_all(&b, m, loops, d) : hm_fail_memory(d);
    free(b.first);
    free(b.to);
    free(b.left);
    if (err)
        hm_mesh_loops_free(loops);
    return err;
}

enum hm_err hm_mesh_boundary(const struct hm_mesh *m, struct hm_mesh_loops *loops,
                             struct hm_diag *d)
{
    struct hm_mesh_edge *edges;
    size_t n;
    *loops = (struct hm_mesh_loops){0};
    enum hm_err err = hm_mesh_edges(m, &edges, &n, d);
    if (err)
        return err;
    err = hm_mesh_boundary_of(m, edges, n, loops, d);
    free(edges);
    return err;
}

void hm_mesh_loops_free(struct hm_mesh_loops *loops)
{
    free(loops->node);
    free(loops->elem);
    free(loops->start);
    *loops = (struct hm_mesh_loops){0};
}
