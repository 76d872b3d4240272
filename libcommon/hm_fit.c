/* hm_fit: see hm_fit.h. */
#include "hm_fit.h"

#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_STEPS = 200 };
#define HOLD 0.1   /* measurements that the old height of a node is worth */
#define SMALL 1e-9 /* part of the residual at which the iteration ends */

/* What the measurements in a triangle say of its corners: sums of products of their weights, and of
 * weights times what the mesh misses. */
struct element {
    int32_t node[3];
    double square[3], product[3]; /* product[k]: of corners k and k + 1 */
    double missed[3];
};

struct fit {
    struct hm_domain *dom;
    struct element *element; /* by triangle */
    size_t n_elements;
    bool *fixed;                         /* by node */
    double *change, *rest, *way, *image; /* by node: of the conjugate gradients */
};

/* Barycentric coordinates, and how far p is above the triangle. */
static double weigh(const struct fit *f, const int32_t node[3], const double *p, double w[3])
{
    const double *at[3];
    double missed = p[2];
    for (int k = 0; k < 3; k++)
        at[k] = &f->dom->node[node[k]].x;
    double whole = hm_area2(at[0], at[1], at[2]);
    w[1] = hm_area2(at[0], p, at[2]) / whole;
    w[2] = hm_area2(at[0], at[1], p) / whole;
    w[0] = 1 - w[1] - w[2];
    for (int k = 0; k < 3; k++)
        missed -= w[k] * at[k][2];
    return missed;
}

static enum hm_err gather(struct fit *f, const double *xyz, size_t n, int threads,
                          struct hm_diag *d)
{
    const struct hm_domain *dom = f->dom;
    int32_t *tri = hm_alloc(n, sizeof *tri);
    f->n_elements = (size_t)hm_tri_triangles(dom->tri);
    f->element = hm_alloc0(f->n_elements, sizeof *f->element);
    if (!tri || !f->element) {
        free(tri);
        return hm_fail_memory(d);
    }
    enum hm_err err = hm_tri_locate_all(dom->tri, xyz, n, 3, threads, tri, d);
    for (size_t k = 0; k < f->n_elements; k++)
        if (hm_domain_is_inside(dom, (int32_t)k))
            hm_domain_corners(dom, (int32_t)k, f->element[k].node);
    for (size_t i = 0; !err && i < n; i++) {
        if (tri[i] == HM_TRI_NONE || !hm_domain_is_inside(dom, tri[i]))
            continue;
        struct element *e = &f->element[tri[i]];
        double w[3], missed = weigh(f, e->node, xyz + 3 * i, w);
        for (int k = 0; k < 3 && isfinite(missed); k++) {
            e->square[k] += w[k] * w[k];
            e->product[k] += w[k] * w[(k + 1) % 3];
            e->missed[k] += w[k] * missed;
        }
    }
    free(tri);
    return err;
}

/* image = (normal matrix) way, on the nodes that are free. */
static void apply(struct fit *f)
{
    for (size_t i = 0; i < f->dom->nnodes; i++)
        f->image[i] = HOLD * f->way[i];
    for (size_t t = 0; t < f->n_elements; t++) {
        const struct element *e = &f->element[t];
        for (int k = 0; k < 3; k++) {
            int32_t a = e->node[k], b = e->node[(k + 1) % 3];
            f->image[a] += e->square[k] * f->way[a] + e->product[k] * f->way[b];
            f->image[b] += e->product[k] * f->way[a];
        }
    }
    for (size_t i = 0; i < f->dom->nnodes; i++)
        if (f->fixed[i])
            f->image[i] = 0;
}

static double dot(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Conjugate gradients (Hestenes & Stiefel 1952) for the changes of the heights. */
static void solve(struct fit *f)
{
    size_t n = f->dom->nnodes;
    for (size_t t = 0; t < f->n_elements; t++)
        for (int k = 0; k < 3; k++)
            f->rest[f->element[t].node[k]] += f->element[t].missed[k];
    for (size_t i = 0; i < n; i++)
        f->way[i] = f->rest[i] = f->fixed[i] ? 0 : f->rest[i];
    double first = dot(f->rest, f->rest, n), now = first;
    for (int step = 0; step < MOST_STEPS && now > SMALL * SMALL * first; step++) {
        apply(f);
        double part = now / dot(f->way, f->image, n), before = now;
        for (size_t i = 0; i < n; i++) {
            f->change[i] += part * f->way[i];
            f->rest[i] -= part * f->image[i];
        }
        now = dot(f->rest, f->rest, n);
        for (size_t i = 0; i < n; i++)
            f->way[i] = f->rest[i] + now / before * f->way[i];
    }
}

static enum hm_err prepare(struct fit *f, struct hm_diag *d)
{
    struct hm_domain *dom = f->dom;
    double *all = hm_alloc0(dom->nnodes, 4 * sizeof *all);
    f->change = all;
    f->fixed = hm_alloc0(dom->nnodes, sizeof *f->fixed);
    if (!all || !f->fixed)
        return hm_fail_memory(d);
    f->rest = all + dom->nnodes;
    f->way = f->rest + dom->nnodes;
    f->image = f->way + dom->nnodes;
    for (size_t k = 0; k < dom->nedges; k++)
        if (dom->edge[k].marks & (HM_EDGE_BREAKLINE | HM_EDGE_REGULAR))
            f->fixed[dom->edge[k].a] = f->fixed[dom->edge[k].b] = true;
    return HM_OK;
}

enum hm_err hm_fit_heights(struct hm_domain *dom, const double *xyz, size_t n, int threads,
                           struct hm_diag *d)
{
    struct fit f = {.dom = dom};
    enum hm_err err = prepare(&f, d);
    if (!err)
        err = gather(&f, xyz, n, threads, d);
    if (!err)
        solve(&f);
    for (size_t i = 0; !err && i < dom->nnodes; i++)
        dom->node[i].z += f.change[i];
    free(f.element);
    free(f.fixed);
    free(f.change);
    return err;
}
