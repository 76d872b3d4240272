#include "hm_join.h"

#include "hm_boxtree.h"
#include "hm_meshedges.h"

#include <math.h>
#include <stdlib.h>

enum hm_err hm_join_node(struct hm_join *j, struct hm_node node, int32_t *number, struct hm_diag *d)
{
    *number = hm_places_put(&j->places, node.x, node.y, (int32_t)j->mesh.nnodes);
    if (*number < 0)
        return hm_fail_memory(d);
    if ((size_t)*number == j->mesh.nnodes)
        return hm_mesh_add_node(&j->mesh, node, d);
    struct hm_node *there = &j->mesh.node[*number];
    there->flags |= node.flags;
    if (there->owner == 0)
        there->owner = node.owner;
    return HM_OK;
}

/* --- matching within a tolerance --- */

struct pair {
    double apart;
    int32_t mine, theirs; /* node of the mesh to add, node of the mesh there */
};

static int by_distance(const void *pa, const void *pb)
{
    const struct pair *a = pa, *b = pb;
    if (a->apart != b->apart)
        return a->apart < b->apart ? -1 : 1;
    if (a->mine != b->mine)
        return a->mine < b->mine ? -1 : 1;
    return (a->theirs > b->theirs) - (a->theirs < b->theirs);
}

/* The pairs of boundary nodes not further apart than the tolerance. */
static enum hm_err find_pairs(const struct hm_mesh *there, const struct hm_mesh_loops *at,
                              const struct hm_mesh *m, const struct hm_mesh_loops *mine,
                              double tolerance, struct pair **pair, size_t *n, struct hm_diag *d)
{
    size_t cap = 0, nodes = at->start[at->nloops];
    struct hm_boxtree *tree = NULL;
    struct hm_box *box = hm_alloc(nodes, sizeof *box);
    if (!box)
        return hm_fail_memory(d);
    for (size_t i = 0; i < nodes; i++)
        box[i] = hm_box_of(hm_mesh_xy(there, at->node[i]), hm_mesh_xy(there, at->node[i]));
    enum hm_err err = hm_boxtree_build(&tree, box, nodes, d);
    for (size_t i = 0; !err && i < mine->start[mine->nloops]; i++) {
        const double *p = hm_mesh_xy(m, mine->node[i]);
        struct hm_boxquery q = hm_boxtree_find(tree, hm_box_grown(hm_box_of(p, p), tolerance));
        for (int32_t k; !err && (k = hm_boxtree_next(&q)) >= 0;) {
            const double *o = hm_mesh_xy(there, at->node[k]);
            double apart = hypot(o[0] - p[0], o[1] - p[1]);
            if (apart > tolerance)
                continue;
            if (!hm_grow(pair, &cap, *n + 1, sizeof **pair))
                err = hm_fail_memory(d);
            else
                (*pair)[(*n)++] = (struct pair){apart, mine->node[i], at->node[k]};
        }
    }
    hm_boxtree_free(tree);
    free(box);
    return err;
}

/* Choose pairs, the nearest first, each node once: map gets the chosen. */
static enum hm_err choose_pairs(struct pair *pair, size_t n, size_t there, int32_t *map,
                                struct hm_joined *joined, struct hm_diag *d)
{
    bool *taken = hm_alloc0(there, sizeof *taken);
    if (!taken)
        return hm_fail_memory(d);
    if (n > 0)
        qsort(pair, n, sizeof *pair, by_distance);
    for (size_t i = 0; i < n; i++) {
        if (map[pair[i].mine] >= 0 || taken[pair[i].theirs])
            continue;
        map[pair[i].mine] = pair[i].theirs;
        taken[pair[i].theirs] = true;
        joined->matched += pair[i].apart > 0;
        joined->furthest = fmax(joined->furthest, pair[i].apart);
    }
    free(taken);
    return HM_OK;
}

static enum hm_err match(const struct hm_join *j, const struct hm_mesh *m, double tolerance,
                         int32_t *map, struct hm_joined *joined, struct hm_diag *d)
{
    struct hm_mesh_loops there = {0}, mine = {0};
    struct pair *pair = NULL;
    size_t n = 0;
    enum hm_err err = hm_mesh_boundary(&j->mesh, &there, d);
    if (!err)
        err = hm_mesh_boundary(m, &mine, d);
    if (!err)
        err = find_pairs(&j->mesh, &there, m, &mine, tolerance, &pair, &n, d);
    if (!err)
        err = choose_pairs(pair, n, j->mesh.nnodes, map, joined, d);
    free(pair);
    hm_mesh_loops_free(&there);
    hm_mesh_loops_free(&mine);
    return err;
}

/* --- joining --- */

/* Number the nodes that elements use: map from -1, or what was matched, to numbers. */
static enum hm_err add_nodes(struct hm_join *j, const struct hm_mesh *m, const bool *gone,
                             int32_t *map, struct hm_joined *joined, struct hm_diag *d)
{
    bool *used = hm_alloc0(m->nnodes, sizeof *used), *lost = hm_alloc0(m->nnodes, sizeof *lost);
    enum hm_err err = used && lost ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; !err && i < m->nelems; i++)
        for (int k = 0; k < hm_elem_corners(&m->elem[i]); k++)
            (gone && gone[i] ? lost : used)[m->elem[i].node[k]] = true;
    for (size_t i = 0; !err && i < m->nnodes; i++) {
        size_t before = j->mesh.nnodes;
        if (!used[i]) {
            joined->unused += !lost[i];
            map[i] = -1;
        } else if (map[i] >= 0) {
            struct hm_node twin = m->node[i]; /* its flags go to the node that was matched */
            twin.x = j->mesh.node[map[i]].x;
            twin.y = j->mesh.node[map[i]].y;
            err = hm_join_node(j, twin, &map[i], d);
            joined->shared++;
        } else {
            err = hm_join_node(j, m->node[i], &map[i], d);
            joined->shared += j->mesh.nnodes == before;
        }
    }
    free(used);
    free(lost);
    return err;
}

enum hm_err hm_join_mesh(struct hm_join *j, const struct hm_mesh *m, const bool *gone,
                         double tolerance, int32_t *map, struct hm_joined *joined,
                         struct hm_diag *d)
{
    int32_t *number = map ? map : hm_alloc(m->nnodes, sizeof *number);
    if (!number)
        return hm_fail_memory(d);
    for (size_t i = 0; i < m->nnodes; i++)
        number[i] = -1;
    enum hm_err err = HM_OK;
    if (tolerance > 0 && j->mesh.nelems > 0)
        err = match(j, m, tolerance, number, joined, d);
    if (!err)
        err = add_nodes(j, m, gone, number, joined, d);
    for (size_t i = 0; !err && i < m->nelems; i++) {
        struct hm_elem e = m->elem[i];
        if (gone && gone[i])
            continue;
        for (int k = 0; k < hm_elem_corners(&e); k++)
            e.node[k] = number[e.node[k]];
        err = hm_mesh_add_elem(&j->mesh, e, d);
    }
    if (!map)
        free(number);
    return err;
}

enum hm_err hm_join_flag_boundary(struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_mesh_loops loops;
    enum hm_err err = hm_mesh_boundary(m, &loops, d);
    if (err)
        return err;
    for (size_t i = 0; i < m->nnodes; i++)
        m->node[i].flags &= ~HM_NODE_BOUNDARY;
    for (size_t i = 0; i < loops.start[loops.nloops]; i++)
        m->node[loops.node[i]].flags |= HM_NODE_BOUNDARY;
    hm_mesh_loops_free(&loops);
    return HM_OK;
}

void hm_join_free(struct hm_join *j)
{
    hm_mesh_free(&j->mesh);
    hm_places_free(&j->places);
}
