/* hm_assemble_ground: the ground to be meshed, and the domain that it makes. See
 * hm_assemble_private.h. */
#include "hm_assemble_private.h"
#include "hm_median.h"
#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>

/* --- what is inside --- */

/* Zone + 1 of the ground around (x, y), or 0 when it is not to be meshed. Ring k makes zone k + 1;
 * of several region polygons the last counts. */
static int32_t ground_at(const struct hm_build *b, double x, double y)
{
    bool odd = false;
    size_t zone = 0;
    for (size_t k = 0; k < b->nrings; k++) {
        const struct hm_ring *r = &b->ring[k];
        if (hm_polygon_side(&r->line, x, y) <= 0)
            continue;
        if (r->role == HM_ROLE_HOLE)
            return 0;
        if (r->role == HM_ROLE_BOUNDARY)
            odd = !odd;
        else
            zone = k + 1;
    }
    return odd && !hm_fence_is_inside(b->fence, x, y) ? (int32_t)zone + 1 : 0;
}

/* Each component that borders, regular meshes and regions leave is judged by the centre of its
 * largest triangle, which is farthest from what rounding did to its rim. */
enum hm_err hm_build_judge(struct hm_build *b, struct hm_diag *d)
{
    const int32_t stop = HM_EDGE_REGULAR | HM_EDGE_BORDER | HM_EDGE_REGION;
    struct hm_tri_components c;
    enum hm_err err = hm_tri_components(b->tri, stop, &c, d);
    if (err)
        return err;
    int32_t *ground = hm_alloc((size_t)c.n, sizeof *ground);
    if (!ground)
        err = hm_fail_memory(d);
    for (int32_t k = 0; !err && k < c.n; k++) {
        double p[2];
        ground[k] = 0;
        if (c.largest[k] == HM_TRI_NONE)
            continue;
        hm_tri_centre(b->tri, c.largest[k], p);
        ground[k] = ground_at(b, p[0], p[1]);
    }
    for (int32_t tri = 0; !err && tri < hm_tri_triangles(b->tri); tri++)
        if (hm_tri_is_solid(b->tri, tri) &&
            hm_tri_set_region(b->tri, tri, ground[c.of[tri]]) != HM_OK)
            err = hm_fail_memory(d);
    free(ground);
    hm_tri_components_free(&c);
    return err;
}

/* --- the domain --- */

enum hm_err hm_build_fail_empty(const struct hm_build *b, struct hm_diag *d)
{
    size_t k = 0;
    while (k + 1 < b->nrings && b->ring[k].role != HM_ROLE_BOUNDARY)
        k++;
    const double *at = b->ring[k].line.xyz; /* without a ring given there is the hull */
    return hm_fail_at(d, HM_EGEOM, at[0], at[1],
                      "no measurement lies inside the outline, which has a corner");
}

/* The nodes that the inside uses, in the order in which they came in, then those that crossings
 * made. Of several at one place the first that has a height gives it. */
static enum hm_err take_nodes(struct hm_build *b, struct hm_domain *dom, struct hm_diag *d)
{
    struct hm_tri *t = b->tri;
    int32_t vertices = hm_tri_vertices(t);
    int64_t used = 0;
    dom->node_of = hm_alloc((size_t)vertices, sizeof *dom->node_of);
    if (!dom->node_of)
        return hm_fail_memory(d);
    for (int32_t v = 0; v < vertices; v++)
        dom->node_of[v] = HM_OUTSIDE;
    const int32_t wanted = HM_OUTSIDE - 1;
    for (int32_t tri = 0; tri < hm_tri_triangles(t); tri++)
        for (int k = 0; k < 3 && hm_tri_is_solid(t, tri) && hm_tri_region(t, tri) > 0; k++)
            dom->node_of[hm_tri_org(t, 3 * tri + k)] = wanted;
    for (size_t i = 0; i < b->nnodes; i++) {
        int32_t v = hm_tri_of_input(t, i), node = dom->node_of[v];
        bool measured = i >= b->first_point && i < b->end_points;
        used += measured && node != HM_OUTSIDE;
        b->counts->outside_points += measured && node == HM_OUTSIDE;
        if (node >= 0 && !isfinite(dom->node[node].z))
            dom->node[node].z = b->node[i].z;
        if (node != wanted)
            continue;
        dom->node_of[v] = (int32_t)dom->nnodes;
        enum hm_err err = hm_domain_add_node(dom, b->node[i], d);
        if (err)
            return err;
    }
    for (int32_t v = 0; v < vertices; v++) {
        if (dom->node_of[v] != wanted)
            continue;
        const double *xy = hm_tri_xy(t, v);
        dom->node_of[v] = (int32_t)dom->nnodes;
        enum hm_err err =
            hm_domain_add_node(dom, (struct hm_node){.x = xy[0], .y = xy[1], .z = NAN}, d);
        if (err)
            return err;
    }
    if (dom->nnodes == 0)
        return hm_fail(d, HM_EGEOM,
                       "outline, holes and regular meshes leave no ground to be meshed");
    if (used == 0 && b->end_points > b->first_point)
        return hm_build_fail_empty(b, d);
    return HM_OK;
}

static double edge_length(const struct hm_domain *dom, const struct hm_domain_edge *e)
{
    return sqrt(hm_node_distance2(&dom->node[e->a], &dom->node[e->b]));
}

static int by_ends(const void *pa, const void *pb)
{
    const struct hm_domain_edge *a = pa, *b = pb;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

/* The fixed edges with the domain on one side at least. *stale: one came that no longer means
 * anything, as between two outlines that share an edge. */
static enum hm_err take_edges(struct hm_build *b, struct hm_domain *dom, bool *stale,
                              struct hm_diag *d)
{
    struct hm_tri *t = b->tri;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        int32_t twin, marks;
        if (!hm_tri_is_solid(t, e / 3) || !(marks = hm_tri_marks(t, e)))
            continue;
        twin = hm_tri_twin(t, e);
        if (twin < e && hm_tri_is_solid(t, twin / 3))
            continue;
        int32_t left = hm_tri_region(t, e / 3) - 1, right = hm_tri_region(t, twin / 3) - 1;
        int32_t from = hm_tri_org(t, e), to = hm_tri_dest(t, e);
        if (left == HM_OUTSIDE && right == HM_OUTSIDE) {
            const double *p = hm_tri_xy(t, from), *q = hm_tri_xy(t, to);
            if (marks & HM_EDGE_BREAKLINE)
                b->counts->outside_length += hypot(q[0] - p[0], q[1] - p[1]);
            continue;
        }
        if (left != HM_OUTSIDE && right != HM_OUTSIDE) {
            marks &= HM_EDGE_BREAKLINE | HM_EDGE_REGION;
            *stale = *stale || marks != hm_tri_marks(t, e);
            if (!marks)
                continue;
        }
        struct hm_domain_edge edge = {dom->node_of[from], dom->node_of[to], marks, left, right, 0};
        if (edge.a > edge.b) /* one direction, whatever the triangles' numbers */
            edge = (struct hm_domain_edge){edge.b, edge.a, marks, right, left, 0};
        enum hm_err err = hm_domain_add_edge(dom, edge, d);
        if (err)
            return err;
        dom->node[edge.a].flags |= HM_NODE_FIXED;
        dom->node[edge.b].flags |= HM_NODE_FIXED;
    }
    qsort(dom->edge, dom->nedges, sizeof *dom->edge, by_ends);
    return HM_OK;
}

/* The edges of regular meshes learn which elements are beside. */
static void note_beside(const struct hm_build *b, struct hm_domain *dom)
{
    for (size_t k = 0; k < b->first_breakline; k++) {
        const struct hm_tri_segment *s = &b->segment[k];
        int32_t from = dom->node_of[s->a], to = dom->node_of[s->b];
        const struct hm_domain_edge key = {.a = from < to ? from : to, .b = from < to ? to : from};
        struct hm_domain_edge *edge = bsearch(&key, dom->edge, dom->nedges, sizeof key, by_ends);
        if (edge)
            edge->beside = b->beside[k];
    }
}

static enum hm_err find_median(struct hm_build *b, const struct hm_domain *dom, struct hm_diag *d)
{
    double *length = hm_alloc(dom->nedges, sizeof *length);
    size_t n = 0;
    if (!length)
        return hm_fail_memory(d);
    for (size_t k = 0; k < dom->nedges; k++)
        if (dom->edge[k].marks & HM_EDGE_BREAKLINE)
            length[n++] = edge_length(dom, &dom->edge[k]);
    b->counts->median_segment = hm_median(length, n);
    free(length);
    return HM_OK;
}

static enum hm_err take_zones(const struct hm_build *b, struct hm_domain *dom, struct hm_diag *d)
{
    dom->nzones = b->nrings + 1;
    dom->zone = hm_alloc0(dom->nzones, sizeof *dom->zone);
    if (!dom->zone)
        return hm_fail_memory(d);
    for (size_t k = 0; k < b->nrings; k++)
        dom->zone[k + 1] = b->ring[k].zone;
    return HM_OK;
}

enum hm_err hm_build_domain(struct hm_build *b, struct hm_domain *dom, struct hm_diag *d)
{
    bool stale = false;
    enum hm_err err = take_nodes(b, dom, d);
    if (!err)
        err = take_edges(b, dom, &stale, d);
    if (err)
        return err;
    note_beside(b, dom);
    err = hm_build_heights(b, dom, d);
    if (!err)
        err = find_median(b, dom, d);
    if (!err)
        err = take_zones(b, dom, d);
    if (err)
        return err;
    dom->tri = b->tri;
    b->tri = NULL;
    if (!stale)
        return hm_domain_number_vertices(dom, d);
    hm_domain_changed(dom);
    return hm_domain_triangulate(dom, b->in->threads, d);
}
