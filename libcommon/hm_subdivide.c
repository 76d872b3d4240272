/* hm_subdivide: see hm_subdivide.h. */
#include "hm_subdivide.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

static double side2(const struct hm_domain *dom, int32_t e)
{
    return hm_node_distance2(&dom->node[dom->node_of[hm_tri_org(dom->tri, e)]],
                             &dom->node[dom->node_of[hm_tri_dest(dom->tri, e)]]);
}

static const double *xy_of(const struct hm_domain *dom, int32_t i)
{
    return &dom->node[i].x;
}

/* Is p nearer than the clearance to edge e, which is fixed? */
static bool crowds(const struct hm_domain *dom, int32_t e, const double *p, double clearance)
{
    if (!hm_tri_marks(dom->tri, e))
        return false;
    const double *a = hm_tri_xy(dom->tri, hm_tri_org(dom->tri, e));
    const double *b = hm_tri_xy(dom->tri, hm_tri_dest(dom->tri, e));
    return fabs(hm_area2(a, b, p)) < clearance * hypot(b[0] - a[0], b[1] - a[1]);
}

/* The mean of n nodes, free and without owner. */
static struct hm_node centre(const struct hm_domain *dom, const int32_t *node, int n)
{
    struct hm_node c = {.flags = HM_NODE_NEW};
    for (int k = 0; k < n; k++) {
        c.x += dom->node[node[k]].x / n;
        c.y += dom->node[node[k]].y / n;
        c.z += dom->node[node[k]].z / n;
    }
    return c;
}

/* --- triangles --- */

enum hm_err hm_subdivide_triangles(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                                   int64_t *n, struct hm_diag *d)
{
    const double least2 = l->least * l->least, most2 = l->most * l->most;
    enum hm_err err = hm_domain_triangulate(dom, threads, d);
    struct hm_node *added = NULL;
    size_t nadded = 0, cap = 0;
    for (int32_t tri = 0; !err && tri < hm_tri_triangles(dom->tri); tri++) {
        if (!hm_domain_is_inside(dom, tri))
            continue;
        int32_t node[3];
        hm_domain_corners(dom, tri, node);
        struct hm_node c = centre(dom, node, 3);
        const double at[2] = {c.x, c.y};
        bool good = true;
        for (int k = 0; k < 3 && good; k++)
            good = side2(dom, 3 * tri + k) > most2 &&
                   hm_node_distance2(&dom->node[node[k]], &c) >= least2 &&
                   !crowds(dom, 3 * tri + k, at, l->clearance) &&
                   hm_pred_orient(xy_of(dom, node[k]), xy_of(dom, node[(k + 1) % 3]), at) > 0;
        if (!good)
            continue;
        if (!hm_grow(&added, &cap, nadded + 1, sizeof c))
            err = hm_fail_memory(d);
        else
            added[nadded++] = c;
    }
    for (size_t k = 0; !err && k < nadded; k++)
        err = hm_domain_add_node(dom, added[k], d);
    if (nadded > 0)
        hm_domain_changed(dom);
    free(added);
    *n = (int64_t)nadded;
    return err;
}

/* --- edges --- */

/* An edge that is too long. */
struct longedge {
    double length2;
    int32_t a, b;  /* nodes, a < b */
    int32_t e;     /* of the triangulation */
    int64_t fixed; /* number of the fixed edge, or -1 */
};

struct longedges {
    struct longedge *v;
    size_t n, cap;
};

static enum hm_err add(struct longedges *list, const struct hm_domain *dom, int32_t e,
                       int64_t fixed, struct hm_diag *d)
{
    if (!hm_grow(&list->v, &list->cap, list->n + 1, sizeof *list->v))
        return hm_fail_memory(d);
    int32_t a = dom->node_of[hm_tri_org(dom->tri, e)], b = dom->node_of[hm_tri_dest(dom->tri, e)];
    list->v[list->n++] = (struct longedge){side2(dom, e), a < b ? a : b, a < b ? b : a, e, fixed};
    return HM_OK;
}

static int longest_first(const void *pa, const void *pb)
{
    const struct longedge *x = pa, *y = pb;
    if (x->length2 != y->length2)
        return x->length2 > y->length2 ? -1 : 1;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    return (x->b > y->b) - (x->b < y->b);
}

/* All edges over the maximum but those of regular meshes, longest first. */
static enum hm_err find_long(const struct hm_domain *dom, double most2, struct longedges *list,
                             struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int32_t e = 0; !err && e < 3 * hm_tri_triangles(dom->tri); e++)
        if (hm_domain_is_inside(dom, e / 3) && !hm_tri_marks(dom->tri, e) &&
            e < hm_tri_twin(dom->tri, e) && side2(dom, e) > most2)
            err = add(list, dom, e, -1, d);
    for (size_t k = 0; !err && k < dom->nedges; k++) {
        const struct hm_domain_edge *edge = &dom->edge[k];
        if ((edge->marks & HM_EDGE_REGULAR) ||
            hm_node_distance2(&dom->node[edge->a], &dom->node[edge->b]) <= most2)
            continue;
        int32_t e = hm_tri_edge_between(dom->tri, dom->vertex_of[edge->a], dom->vertex_of[edge->b]);
        err = add(list, dom, e, (int64_t)k, d);
    }
    if (!err && list->n > 1)
        qsort(list->v, list->n, sizeof *list->v, longest_first);
    return err;
}

/* Can c, on the edge that e meets at `corner`, not come to lie on e or beyond? Outside the domain
 * only fixed edges count, and none that runs on in the direction of the halved one: borders that
 * were halved before are nearly straight there. */
static bool keeps_left(const struct hm_domain *dom, int32_t e, int32_t corner, const double *c)
{
    const struct hm_tri *t = dom->tri;
    const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
    if (!hm_domain_is_inside(dom, e / 3)) {
        const double *at = hm_tri_xy(t, corner), *end = at == a ? b : a;
        double dot = (end[0] - at[0]) * (c[0] - at[0]) + (end[1] - at[1]) * (c[1] - at[1]);
        if (!hm_tri_marks(t, e) || dot < 0)
            return true;
    }
    return hm_pred_orient(a, b, c) > 0;
}

/* May edge `e` get a node at c? On this side of it: no triangle folds, and a free edge keeps the
 * new node clear of what is there. */
static bool may_halve(const struct hm_domain *dom, const struct hm_lengths *l, int32_t e,
                      const struct hm_node *c, bool is_free)
{
    const struct hm_tri *t = dom->tri;
    int32_t apex = hm_tri_apex(t, e), next = hm_tri_next(e), prev = hm_tri_prev(e);
    const double at[2] = {c->x, c->y};
    if (apex == HM_TRI_INFINITY)
        return true;
    if (!keeps_left(dom, next, hm_tri_dest(t, e), at) ||
        !keeps_left(dom, prev, hm_tri_org(t, e), at))
        return false;
    if (!is_free)
        return true;
    return hm_node_distance2(&dom->node[dom->node_of[apex]], c) >= l->least * l->least &&
           !crowds(dom, next, at, l->clearance) && !crowds(dom, prev, at, l->clearance);
}

/* Put c on an edge. A fixed edge becomes two. */
static enum hm_err halve(struct hm_domain *dom, const struct longedge *long_edge, struct hm_node c,
                         struct hm_diag *d)
{
    int32_t number = (int32_t)dom->nnodes;
    if (long_edge->fixed < 0)
        return hm_domain_add_node(dom, c, d);
    struct hm_domain_edge *edge = &dom->edge[long_edge->fixed], second = *edge;
    c.flags = HM_NODE_FIXED | (edge->marks & HM_EDGE_BREAKLINE ? 0 : HM_NODE_NEW);
    edge->b = second.a = number;
    enum hm_err err = hm_domain_add_node(dom, c, d);
    return err ? err : hm_domain_add_edge(dom, second, d);
}

enum hm_err hm_subdivide_edges(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                               int64_t *n, struct hm_diag *d)
{
    struct longedges list = {0};
    *n = 0;
    enum hm_err err = hm_domain_triangulate(dom, threads, d);
    if (!err)
        err = find_long(dom, l->most * l->most, &list, d);
    bool *busy = err ? NULL : hm_alloc0((size_t)hm_tri_triangles(dom->tri), sizeof *busy);
    if (!err && !busy)
        err = hm_fail_memory(d);
    for (size_t k = 0; !err && k < list.n; k++) {
        const struct longedge *edge = &list.v[k];
        int32_t twin = hm_tri_twin(dom->tri, edge->e);
        struct hm_node c = centre(dom, (int32_t[2]){edge->a, edge->b}, 2);
        bool is_free = edge->fixed < 0;
        if (busy[edge->e / 3] || busy[twin / 3] || !may_halve(dom, l, edge->e, &c, is_free) ||
            !may_halve(dom, l, twin, &c, is_free))
            continue;
        busy[edge->e / 3] = busy[twin / 3] = true;
        err = halve(dom, edge, c, d);
        ++*n;
    }
    if (*n > 0)
        hm_domain_changed(dom);
    free(busy);
    free(list.v);
    return err;
}
