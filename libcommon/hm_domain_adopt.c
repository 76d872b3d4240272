/* hm_domain_adopt: what was added to the triangulation of a domain becomes part of it. See
 * hm_domain.h. */
#include "hm_domain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum hm_err add_nodes(struct hm_domain *dom, int32_t first, struct hm_diag *d)
{
    int32_t vertices = hm_tri_vertices(dom->tri);
    int32_t *node_of = hm_alloc((size_t)vertices, sizeof *node_of);
    if (!node_of || !hm_grow(&dom->node, &dom->node_cap, dom->nnodes + (size_t)(vertices - first),
                             sizeof *dom->node)) {
        free(node_of);
        return hm_fail_memory(d);
    }
    memcpy(node_of, dom->node_of, (size_t)first * sizeof *node_of);
    free(dom->node_of);
    dom->node_of = node_of;
    for (int32_t v = first; v < vertices; v++) {
        node_of[v] = HM_OUTSIDE;
        if (!hm_tri_is_used(dom->tri, v))
            continue;
        const double *xy = hm_tri_xy(dom->tri, v);
        node_of[v] = (int32_t)dom->nnodes;
        enum hm_err err = hm_domain_add_node(
            dom, (struct hm_node){.x = xy[0], .y = xy[1], .z = NAN, .flags = HM_NODE_NEW}, d);
        if (err)
            return err;
    }
    return hm_domain_number_vertices(dom, d);
}

/* The next vertex on a fixed edge that was split, from `at` on the way to `end`: the end itself or,
 * of the new vertices to which edges with its marks lead, the one straight ahead. */
static int32_t step(const struct hm_domain *dom, int32_t at, int32_t end, int32_t marks,
                    int32_t first)
{
    const struct hm_tri *t = dom->tri;
    const double *p = hm_tri_xy(t, at), *q = hm_tri_xy(t, end);
    int32_t from = hm_tri_edge_from(t, at), e = from, best = HM_TRI_NONE;
    double least = INFINITY;
    do {
        int32_t to = hm_tri_dest(t, e);
        if ((hm_tri_marks(t, e) & marks) == marks) {
            if (to == end)
                return end;
            const double *r = hm_tri_xy(t, to);
            double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
            double aside = fabs(ux * vy - uy * vx) / hypot(vx, vy);
            if (to >= first && ux * vx + uy * vy > 0 && aside < least) {
                least = aside;
                best = to;
            }
        }
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != from);
    return best;
}

/* A new node on a fixed edge. */
static void fix(struct hm_domain *dom, const struct hm_domain_edge *whole, int32_t number)
{
    const struct hm_node *a = &dom->node[whole->a], *b = &dom->node[whole->b];
    struct hm_node *node = &dom->node[number];
    node->flags |= HM_NODE_FIXED;
    if (!(whole->marks & HM_EDGE_BREAKLINE))
        return;
    double part = sqrt(hm_node_distance2(a, node) / hm_node_distance2(a, b));
    node->z = a->z + fmin(part, 1) * (b->z - a->z);
    node->flags &= ~HM_NODE_NEW;
}

/* Put the pieces of edge k in its place, and behind all others. */
static enum hm_err cut_edge(struct hm_domain *dom, size_t k, int32_t first, struct hm_diag *d)
{
    const struct hm_domain_edge whole = dom->edge[k];
    int32_t at = dom->vertex_of[whole.a], end = dom->vertex_of[whole.b];
    enum hm_err err = HM_OK;
    for (size_t n = 0; !err && at != end; n++) {
        int32_t next = step(dom, at, end, whole.marks, first);
        if (next == HM_TRI_NONE || n > dom->nnodes)
            return hm_fail_at(d, HM_EGEOM, dom->node[whole.a].x, dom->node[whole.a].y,
                              "a fixed edge got lost");
        struct hm_domain_edge piece = whole;
        piece.a = dom->node_of[at];
        piece.b = dom->node_of[next];
        if (next != end)
            fix(dom, &whole, piece.b);
        if (n == 0)
            dom->edge[k] = piece;
        else
            err = hm_domain_add_edge(dom, piece, d);
        at = next;
    }
    return err;
}

enum hm_err hm_domain_adopt(struct hm_domain *dom, int32_t first, struct hm_diag *d)
{
    size_t nedges = dom->nedges;
    enum hm_err err = add_nodes(dom, first, d);
    for (size_t k = 0; !err && k < nedges; k++)
        err = cut_edge(dom, k, first, d);
    if (err)
        hm_domain_changed(dom);
    return err;
}
