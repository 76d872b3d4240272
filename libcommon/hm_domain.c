/* hm_domain: see hm_domain.h. */
#include "hm_domain.h"
#include "hm_order.h"
#include "hm_pred.h"

#include <stdlib.h>
#include <string.h>

void hm_domain_free(struct hm_domain *dom)
{
    hm_domain_changed(dom);
    free(dom->node);
    free(dom->edge);
    free(dom->zone);
    *dom = (struct hm_domain){0};
}

void hm_domain_changed(struct hm_domain *dom)
{
    hm_tri_free(dom->tri);
    free(dom->node_of);
    free(dom->vertex_of);
    dom->tri = NULL;
    dom->node_of = dom->vertex_of = NULL;
}

enum hm_err hm_domain_add_node(struct hm_domain *dom, struct hm_node node, struct hm_diag *d)
{
    if (!hm_grow(&dom->node, &dom->node_cap, dom->nnodes + 1, sizeof node))
        return hm_fail_memory(d);
    dom->node[dom->nnodes++] = node;
    return HM_OK;
}

enum hm_err hm_domain_add_edge(struct hm_domain *dom, struct hm_domain_edge edge, struct hm_diag *d)
{
    if (!hm_grow(&dom->edge, &dom->edge_cap, dom->nedges + 1, sizeof edge))
        return hm_fail_memory(d);
    dom->edge[dom->nedges++] = edge;
    return HM_OK;
}

/* Put the fixed edges in. They meet in nodes only, so nothing can need mending; if something did,
 * dom->edge would no longer say what the triangulation has. */
static enum hm_err constrain(struct hm_domain *dom, struct hm_diag *d)
{
    struct hm_tri_segment *s = hm_alloc(dom->nedges, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_domain_edge *e = &dom->edge[k];
        s[k] = (struct hm_tri_segment){hm_tri_of_input(dom->tri, (size_t)e->a),
                                       hm_tri_of_input(dom->tri, (size_t)e->b), e->marks};
    }
    struct hm_tri_mends mends = {0};
    enum hm_err err = hm_tri_constrain(dom->tri, s, dom->nedges, &mends, d);
    free(s);
    if (!err &&
        mends.n[HM_TRI_CROSSING] + mends.n[HM_TRI_ON_SEGMENT] + mends.n[HM_TRI_ZERO_LENGTH] > 0)
        err = hm_fail(d, HM_EGEOM,
                      "fixed edges lie too near to each other for the precision of "
                      "the coordinates: move the origin nearer to them");
    return err;
}

/* What the fixed edges say of their two sides holds of all that these hang together with. */
static enum hm_err fill(struct hm_domain *dom, struct hm_diag *d)
{
    const int32_t stop = HM_EDGE_REGULAR | HM_EDGE_BORDER | HM_EDGE_REGION;
    struct hm_tri *t = dom->tri;
    struct hm_tri_components c;
    enum hm_err err = hm_tri_components(t, stop, &c, d);
    if (err)
        return err;
    int32_t *region = hm_alloc0((size_t)c.n, sizeof *region);
    if (!region)
        err = hm_fail_memory(d);
    for (size_t k = 0; !err && k < dom->nedges; k++) {
        const struct hm_domain_edge *e = &dom->edge[k];
        int32_t left = hm_tri_edge_between(t, hm_tri_of_input(t, (size_t)e->a),
                                           hm_tri_of_input(t, (size_t)e->b));
        int32_t *side[2] = {&region[c.of[left / 3]], &region[c.of[hm_tri_twin(t, left) / 3]]};
        *side[0] = *side[0] ? *side[0] : e->left + 1;
        *side[1] = *side[1] ? *side[1] : e->right + 1;
    }
    for (int32_t tri = 0; !err && tri < hm_tri_triangles(t); tri++)
        if (c.of[tri] != HM_TRI_NONE && hm_tri_set_region(t, tri, region[c.of[tri]]) != HM_OK)
            err = hm_fail_memory(d);
    free(region);
    hm_tri_components_free(&c);
    return err;
}

enum hm_err hm_domain_number_vertices(struct hm_domain *dom, struct hm_diag *d)
{
    free(dom->vertex_of);
    dom->vertex_of = hm_alloc(dom->nnodes, sizeof *dom->vertex_of);
    if (!dom->vertex_of)
        return hm_fail_memory(d);
    for (int32_t v = 0; v < hm_tri_vertices(dom->tri); v++)
        if (dom->node_of[v] >= 0)
            dom->vertex_of[dom->node_of[v]] = v;
    return HM_OK;
}

enum hm_err hm_domain_triangulate(struct hm_domain *dom, int threads, struct hm_diag *d)
{
    if (dom->tri)
        return HM_OK;
    const size_t stride = sizeof *dom->node / sizeof(double);
    enum hm_err err = hm_tri_build(&dom->tri, &dom->node->x, dom->nnodes, stride, threads, d);
    if (!err)
        err = constrain(dom, d);
    if (!err)
        err = fill(dom, d);
    if (!err) {
        int32_t vertices = hm_tri_vertices(dom->tri);
        dom->node_of = hm_alloc((size_t)vertices, sizeof *dom->node_of);
        if (!dom->node_of)
            err = hm_fail_memory(d);
        for (int32_t v = 0; !err && v < vertices; v++)
            dom->node_of[v] = (int32_t)hm_tri_input(dom->tri, v);
    }
    if (!err)
        err = hm_domain_number_vertices(dom, d);
    if (err)
        hm_domain_changed(dom);
    return err;
}

enum hm_err hm_domain_remove(struct hm_domain *dom, const bool *gone, struct hm_diag *d)
{
    int32_t *now = hm_alloc(dom->nnodes, sizeof *now), n = 0;
    if (!now)
        return hm_fail_memory(d);
    for (size_t i = 0; i < dom->nnodes; i++) {
        now[i] = gone[i] ? -1 : n;
        if (!gone[i])
            dom->node[n++] = dom->node[i];
    }
    dom->nnodes = (size_t)n;
    for (size_t k = 0; k < dom->nedges; k++) {
        dom->edge[k].a = now[dom->edge[k].a];
        dom->edge[k].b = now[dom->edge[k].b];
    }
    free(now);
    hm_domain_changed(dom);
    return HM_OK;
}

double hm_domain_area(const struct hm_domain *dom, int32_t tri)
{
    return !hm_domain_is_inside(dom, tri)
               ? 0
               : hm_area2(hm_tri_xy(dom->tri, hm_tri_org(dom->tri, 3 * tri)),
                          hm_tri_xy(dom->tri, hm_tri_dest(dom->tri, 3 * tri)),
                          hm_tri_xy(dom->tri, hm_tri_apex(dom->tri, 3 * tri))) /
                     2;
}

/* --- the finished mesh --- */

/* What the edges make of their nodes. */
static void flag_nodes(const struct hm_domain *dom, const int32_t *number, struct hm_mesh *mesh)
{
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_domain_edge *e = &dom->edge[k];
        int32_t flags = HM_NODE_FIXED;
        if (e->left == HM_OUTSIDE || e->right == HM_OUTSIDE)
            flags |= HM_NODE_BOUNDARY;
        if (e->marks & HM_EDGE_BREAKLINE)
            flags |= HM_NODE_BREAKLINE;
        mesh->node[number[e->a]].flags |= flags;
        mesh->node[number[e->b]].flags |= flags;
    }
}

static int by_nodes(const void *pa, const void *pb)
{
    const struct hm_elem *a = pa, *b = pb;
    for (int k = 0; k < 3; k++)
        if (a->node[k] != b->node[k])
            return a->node[k] < b->node[k] ? -1 : 1;
    return 0;
}

/* Elements in the order of their lowest node, so that the numbers of triangles, which depend on how
 * the triangulation was made, cannot show. Counting sort, then each node's few elements. */
static enum hm_err sort_elements(struct hm_mesh *mesh, struct hm_diag *d)
{
    size_t *start = hm_alloc0(mesh->nnodes + 2, sizeof *start);
    struct hm_elem *sorted = hm_alloc(mesh->nelems, sizeof *sorted);
    if (!start || !sorted) {
        free(start);
        free(sorted);
        return hm_fail_memory(d);
    }
    for (size_t k = 0; k < mesh->nelems; k++)
        start[mesh->elem[k].node[0] + 2]++;
    for (size_t i = 2; i < mesh->nnodes + 2; i++)
        start[i] += start[i - 1];
    for (size_t k = 0; k < mesh->nelems; k++)
        sorted[start[mesh->elem[k].node[0] + 1]++] = mesh->elem[k];
    for (size_t i = 0; i < mesh->nnodes; i++)
        qsort(sorted + start[i], start[i + 1] - start[i], sizeof *sorted, by_nodes);
    memcpy(mesh->elem, sorted, mesh->nelems * sizeof *sorted);
    free(start);
    free(sorted);
    return HM_OK;
}

static enum hm_err add_elements(const struct hm_domain *dom, const int32_t *number,
                                struct hm_mesh *mesh, struct hm_diag *d)
{
    for (int32_t tri = 0; tri < hm_tri_triangles(dom->tri); tri++) {
        if (!hm_domain_is_inside(dom, tri))
            continue;
        int32_t node[3];
        hm_domain_corners(dom, tri, node);
        for (int k = 0; k < 3; k++)
            node[k] = number[node[k]];
        int first = node[0] < node[1] ? (node[0] < node[2] ? 0 : 2) : (node[1] < node[2] ? 1 : 2);
        struct hm_elem e = {{node[first], node[(first + 1) % 3], node[(first + 2) % 3], -1},
                            dom->zone[hm_tri_region(dom->tri, tri) - 1].material};
        enum hm_err err = hm_mesh_add_elem(mesh, e, d);
        if (err)
            return err;
    }
    return HM_OK;
}

/* number[i] = 0 for the nodes that the inside uses, -1 for the others. */
static void mark_used(const struct hm_domain *dom, int32_t *number)
{
    for (size_t i = 0; i < dom->nnodes; i++)
        number[i] = -1;
    for (int32_t tri = 0; tri < hm_tri_triangles(dom->tri); tri++) {
        int32_t node[3];
        if (!hm_domain_is_inside(dom, tri))
            continue;
        hm_domain_corners(dom, tri, node);
        for (int k = 0; k < 3; k++)
            number[node[k]] = 0;
    }
}

enum hm_err hm_domain_order(const struct hm_domain *dom, int32_t **nodes, struct hm_diag *d)
{
    const size_t stride = sizeof *dom->node / sizeof(double);
    struct hm_order_item *order = hm_alloc(dom->nnodes, 2 * sizeof *order);
    *nodes = hm_alloc(dom->nnodes, sizeof **nodes);
    enum hm_err err = order && *nodes ? HM_OK : hm_fail_memory(d);
    if (!err)
        err = hm_order_sort(&dom->node->x, dom->nnodes, stride, HM_ORDER_FINE, 1, order,
                            order + dom->nnodes, d);
    for (size_t k = 0; !err && k < dom->nnodes; k++)
        (*nodes)[k] = (int32_t)order[k].index;
    free(order);
    if (!err)
        return HM_OK;
    free(*nodes);
    *nodes = NULL;
    return err;
}

/* Number the nodes that the inside uses, in spatial order. */
static enum hm_err add_nodes(const struct hm_domain *dom, int32_t *number, struct hm_mesh *mesh,
                             struct hm_diag *d)
{
    int32_t *order;
    enum hm_err err = hm_domain_order(dom, &order, d);
    if (err)
        return err;
    mark_used(dom, number);
    for (size_t k = 0; !err && k < dom->nnodes; k++) {
        int32_t i = order[k];
        if (number[i] < 0)
            continue;
        number[i] = (int32_t)mesh->nnodes;
        struct hm_node node = dom->node[i];
        node.flags &= ~HM_NODE_NEW;
        err = hm_mesh_add_node(mesh, node, d);
    }
    free(order);
    return err;
}

enum hm_err hm_domain_mesh(const struct hm_domain *dom, struct hm_mesh *mesh, struct hm_diag *d)
{
    int32_t *number = hm_alloc(dom->nnodes, sizeof *number);
    if (!number)
        return hm_fail_memory(d);
    enum hm_err err = add_nodes(dom, number, mesh, d);
    if (!err)
        err = add_elements(dom, number, mesh, d);
    if (!err) {
        flag_nodes(dom, number, mesh);
        err = sort_elements(mesh, d);
    }
    free(number);
    return err;
}
