#include "hm_rcm.h"

#include "hm_meshedges.h"

#include <stdlib.h>

/* Neighbours of each node over the edges of the mesh. */
struct graph {
    size_t n;
    size_t *start;  /* n + 1 */
    int32_t *to;    /* neighbours, by degree and then by number */
    int32_t *level; /* of the last search that reached the node; -1 before */
    bool *numbered; /* it has its place in the order */
};

static int64_t spread(const struct hm_elem *e)
{
    int32_t least = e->node[0], most = e->node[0];
    for (int k = 1; k < hm_elem_corners(e); k++) {
        least = e->node[k] < least ? e->node[k] : least;
        most = e->node[k] > most ? e->node[k] : most;
    }
    return (int64_t)most - least;
}

int64_t hm_rcm_bandwidth(const struct hm_mesh *m)
{
    int64_t most = 0;
    for (size_t i = 0; i < m->nelems; i++)
        most = spread(&m->elem[i]) > most ? spread(&m->elem[i]) : most;
    return most;
}

static size_t degree(const struct graph *g, int32_t node)
{
    return g->start[node + 1] - g->start[node];
}

/* Insertion sort: a node has few neighbours. */
static void sort_neighbours(struct graph *g, size_t node)
{
    int32_t *to = g->to + g->start[node];
    for (size_t i = 1; i < degree(g, (int32_t)node); i++)
        for (size_t k = i; k > 0; k--) {
            size_t mine = degree(g, to[k]), other = degree(g, to[k - 1]);
            if (mine > other || (mine == other && to[k] > to[k - 1]))
                break;
            int32_t swap = to[k];
            to[k] = to[k - 1];
            to[k - 1] = swap;
        }
}

static void graph_free(struct graph *g)
{
    free(g->start);
    free(g->to);
    free(g->level);
    free(g->numbered);
}

static enum hm_err graph_build(struct graph *g, const struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_mesh_edge *edge;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edge, &n, d);
    if (err)
        return err;
    *g = (struct graph){.n = m->nnodes};
    g->start = hm_alloc0(g->n + 2, sizeof *g->start);
    g->to = hm_alloc(2 * n, sizeof *g->to);
    g->level = hm_alloc(g->n, sizeof *g->level);
    g->numbered = hm_alloc0(g->n, sizeof *g->numbered);
    if (!g->start || !g->to || !g->level || !g->numbered) {
        free(edge);
        graph_free(g);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < n; i++) {
        g->start[edge[i].a + 2]++;
        g->start[edge[i].b + 2]++;
    }
    for (size_t i = 2; i < g->n + 2; i++)
        g->start[i] += g->start[i - 1];
    for (size_t i = 0; i < n; i++) { /* leaves start[k] where node k begins */
        g->to[g->start[edge[i].a + 1]++] = edge[i].b;
        g->to[g->start[edge[i].b + 1]++] = edge[i].a;
    }
    for (size_t i = 0; i < g->n; i++) {
        g->level[i] = -1;
        sort_neighbours(g, i);
    }
    free(edge);
    return HM_OK;
}

/* Breadth first from `root` over nodes not yet numbered; they go to queue. Their number. */
static size_t search(struct graph *g, int32_t root, int32_t *queue)
{
    size_t n = 1;
    queue[0] = root;
    g->level[root] = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = g->start[queue[i]]; k < g->start[queue[i] + 1]; k++) {
            int32_t next = g->to[k];
            if (g->level[next] >= 0 || g->numbered[next])
                continue;
            g->level[next] = g->level[queue[i]] + 1;
            queue[n++] = next;
        }
    return n;
}

/* A node at the rim of the piece of `root`: the far end of searches as long as they get longer. */
static int32_t rim_node(struct graph *g, int32_t root, int32_t *queue)
{
    for (int32_t depth = -1;;) {
        size_t n = search(g, root, queue);
        int32_t last = g->level[queue[n - 1]], far = queue[n - 1];
        for (size_t i = n; i-- > 0 && g->level[queue[i]] == last;)
            if (degree(g, queue[i]) <= degree(g, far))
                far = queue[i];
        for (size_t i = 0; i < n; i++)
            g->level[queue[i]] = -1;
        if (last <= depth)
            return root;
        depth = last;
        root = far;
    }
}

/* order[i] becomes the node that gets number i. */
static void find_order(struct graph *g, int32_t *order)
{
    size_t n = 0;
    for (size_t i = 0; i < g->n; i++) {
        if (g->numbered[i])
            continue;
        size_t found = search(g, rim_node(g, (int32_t)i, order + n), order + n);
        for (size_t k = n; k < n + found; k++)
            g->numbered[order[k]] = true;
        n += found;
    }
    for (size_t i = 0; i < n / 2; i++) {
        int32_t swap = order[i];
        order[i] = order[n - 1 - i];
        order[n - 1 - i] = swap;
    }
}

struct ranked {
    struct hm_elem elem;
    int32_t lowest, number;
};

static int by_lowest(const void *pa, const void *pb)
{
    const struct ranked *a = pa, *b = pb;
    if (a->lowest != b->lowest)
        return a->lowest < b->lowest ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static void renumber(struct hm_mesh *m, const int32_t *order, struct hm_node *node, int32_t *number,
                     struct ranked *ranked)
{
    for (size_t i = 0; i < m->nnodes; i++) {
        node[i] = m->node[order[i]];
        number[order[i]] = (int32_t)i;
    }
    for (size_t i = 0; i < m->nnodes; i++)
        m->node[i] = node[i];
    for (size_t i = 0; i < m->nelems; i++) {
        struct ranked *r = &ranked[i];
        *r = (struct ranked){m->elem[i], INT32_MAX, (int32_t)i};
        for (int k = 0; k < hm_elem_corners(&m->elem[i]); k++) {
            r->elem.node[k] = number[m->elem[i].node[k]];
            r->lowest = r->elem.node[k] < r->lowest ? r->elem.node[k] : r->lowest;
        }
    }
    if (m->nelems > 0)
        qsort(ranked, m->nelems, sizeof *ranked, by_lowest);
    for (size_t i = 0; i < m->nelems; i++)
        m->elem[i] = ranked[i].elem;
}

enum hm_err hm_rcm_renumber(struct hm_mesh *m, int32_t *number, struct hm_diag *d)
{
    struct graph g;
    enum hm_err err = graph_build(&g, m, d);
    if (err)
        return err;
    int32_t *order = hm_alloc(m->nnodes, sizeof *order);
    struct hm_node *node = hm_alloc(m->nnodes, sizeof *node);
    struct ranked *ranked = hm_alloc(m->nelems, sizeof *ranked);
    if (order && node && ranked) {
        find_order(&g, order);
        renumber(m, order, node, number, ranked);
    } else {
        err = hm_fail_memory(d);
    }
    free(order);
    free(node);
    free(ranked);
    graph_free(&g);
    return err;
}
