/* hm_regular_mesh: the nodes and elements of hm_regular.h. */
#include "hm_meshedges.h"
#include "hm_pred.h"
#include "hm_regular.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

enum shape { /* of a cell with the corners a b c e, counter-clockwise */
             CUT_AC,
             CUT_BE,
             QUAD,
             FOLDED
};

struct weave {
    struct hm_regular *s;
    const struct hm_rough *rough;
    struct hm_mesh *mesh;
    size_t nu, nv; /* elements along and across */
    bool quads, alternating;
    unsigned char *shape; /* a cell: i * nv + j */
};

static double parameter_u(const struct weave *w, double i)
{
    return i * (double)(w->s->surface.n - 1) / (double)w->nu;
}

static double parameter_v(const struct weave *w, double j)
{
    return j * (double)(w->s->surface.m - 1) / (double)w->nv;
}

/* Nodes are numbered section by section, for a narrow band of the solver's matrix. */
static struct hm_node *node_at(const struct weave *w, size_t i, size_t j)
{
    return &w->mesh->node[i * (w->nv + 1) + j];
}

/* --- how many --- */

static double way(const struct hm_bsurf *s, double u0, double v0, double u1, double v1)
{
    double a[3], b[3];
    hm_bspline_eval(s, u0, v0, a, NULL, NULL);
    hm_bspline_eval(s, u1, v1, b, NULL, NULL);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Numbers of elements by the mean length of the banks and the mean width, over the Greville lines.
 */
static enum hm_err count_elements(struct weave *w, struct hm_diag *d)
{
    const struct hm_bsurf *s = &w->s->surface;
    double length = 0, width = 0;
    for (size_t i = 0; i + 1 < s->n; i++)
        for (int side = 0; side < 2; side++) {
            double v = side ? (double)(s->m - 1) : 0;
            length += way(s, (double)i, v, (double)i + 1, v) / 2;
        }
    for (size_t i = 0; i < s->n; i++)
        for (size_t j = 0; j + 1 < s->m; j++)
            width += way(s, (double)i, (double)j, (double)i, (double)j + 1) / (double)s->n;
    double nu = fmax(1, floor(length / w->rough->size.elem_along + 0.5));
    double nv = fmax(1, floor(width / w->rough->size.elem_across + 0.5));
    if (!((nu + 1) * (nv + 1) < INT32_MAX / 2))
        return hm_fail(
            d, HM_ENOMEM, "elements of %g by %g m are too many for surface '%s' (%.4g by %.4g m)",
            w->rough->size.elem_along, w->rough->size.elem_across, w->rough->name, length, width);
    w->nu = (size_t)nu;
    w->nv = (size_t)nv;
    return HM_OK;
}

/* --- nodes --- */

static bool on_breakline(const struct weave *w, size_t i, size_t j)
{
    if (j > 0 && j < w->nv)
        return false;
    const bool *snapped = w->s->snapped[j == 0 ? HM_RIGHT : HM_LEFT];
    double u = parameter_u(w, (double)i);
    return snapped[(size_t)floor(u)] && snapped[(size_t)ceil(u)];
}

static void make_section(void *arg, size_t i)
{
    struct weave *w = arg;
    for (size_t j = 0; j <= w->nv; j++) {
        double p[3];
        hm_bspline_eval(&w->s->surface, parameter_u(w, (double)i), parameter_v(w, (double)j), p,
                        NULL, NULL);
        *node_at(w, i, j) = (struct hm_node){.x = p[0],
                                             .y = p[1],
                                             .z = p[2],
                                             .flags = on_breakline(w, i, j) ? HM_NODE_BREAKLINE : 0,
                                             .owner = w->rough->number};
    }
}

/* --- elements --- */

static double apart2(const struct hm_node *a, const struct hm_node *b)
{
    double dx = b->x - a->x, dy = b->y - a->y;
    return dx * dx + dy * dy;
}

static bool turns_left(const struct hm_node *a, const struct hm_node *b, const struct hm_node *c)
{
    return hm_pred_orient(&a->x, &b->x, &c->x) > 0;
}

/* The diagonal of a cell that may be cut along either. */
static enum shape choose_diagonal(const struct weave *w, size_t i, size_t j,
                                  const struct hm_node *const c[4])
{
    bool first = i == 0, last = i + 1 == w->nu, right = j == 0, left = j + 1 == w->nv;
    if ((first && right) || (last && left))
        return CUT_AC;
    if ((last && right) || (first && left))
        return CUT_BE;
    if (w->alternating)
        return (i + j) % 2 == 0 ? CUT_AC : CUT_BE;
    double p[3];
    hm_bspline_eval(&w->s->surface, parameter_u(w, (double)i + 0.5),
                    parameter_v(w, (double)j + 0.5), p, NULL, NULL);
    double ac = fabs((c[0]->z + c[2]->z) / 2 - p[2]), be = fabs((c[1]->z + c[3]->z) / 2 - p[2]);
    if (fabs(ac - be) >= HM_REGULAR_FIT)
        return ac < be ? CUT_AC : CUT_BE;
    /* a hair in favour of one, or rounding would choose in a straight channel */
    return apart2(c[0], c[2]) <= (1 + 1e-9) * apart2(c[1], c[3]) ? CUT_AC : CUT_BE;
}

static enum shape shape_cell(const struct weave *w, size_t i, size_t j)
{
    const struct hm_node *c[4] = {node_at(w, i, j), node_at(w, i + 1, j), node_at(w, i + 1, j + 1),
                                  node_at(w, i, j + 1)};
    bool ac = turns_left(c[0], c[1], c[2]) && turns_left(c[0], c[2], c[3]);
    bool be = turns_left(c[0], c[1], c[3]) && turns_left(c[1], c[2], c[3]);
    if (ac && be)
        return w->quads ? QUAD : choose_diagonal(w, i, j, c);
    return ac ? CUT_AC : be ? CUT_BE : FOLDED;
}

static void shape_column(void *arg, size_t i)
{
    struct weave *w = arg;
    for (size_t j = 0; j < w->nv; j++)
        w->shape[i * w->nv + j] = (unsigned char)shape_cell(w, i, j);
}

static enum hm_err add(struct weave *w, size_t a, size_t b, size_t c, int64_t e, struct hm_diag *d)
{
    struct hm_elem elem = {{(int32_t)a, (int32_t)b, (int32_t)c, (int32_t)e}, w->rough->number};
    return hm_mesh_add_elem(w->mesh, elem, d);
}

static enum hm_err add_cell(struct weave *w, size_t i, size_t j, struct hm_diag *d)
{
    size_t a = i * (w->nv + 1) + j, b = a + w->nv + 1, c = b + 1, e = a + 1;
    enum shape shape = w->shape[i * w->nv + j];
    if (shape == FOLDED) {
        const struct hm_node *n = w->mesh->node;
        return hm_fail_at(d, HM_EGEOM, (n[a].x + n[c].x) / 2, (n[a].y + n[c].y) / 2,
                          "the mesh on surface '%s' folds here: draw its banks more smoothly, or "
                          "lay control points farther apart",
                          w->rough->name);
    }
    if (shape == QUAD)
        return add(w, a, b, c, (int64_t)e, d);
    w->s->concave += w->quads;
    enum hm_err err = shape == CUT_AC ? add(w, a, b, c, -1, d) : add(w, a, b, e, -1, d);
    if (err)
        return err;
    return shape == CUT_AC ? add(w, a, c, e, -1, d) : add(w, b, c, e, -1, d);
}

static enum hm_err add_elements(struct weave *w, int threads, struct hm_diag *d)
{
    w->shape = hm_alloc(w->nu * w->nv, sizeof *w->shape);
    if (!w->shape)
        return hm_fail_memory(d);
    hm_thread_for(threads, w->nu, shape_column, w);
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < w->nu; i++)
        for (size_t j = 0; !err && j < w->nv; j++)
            err = add_cell(w, i, j, d);
    free(w->shape);
    return err;
}

enum hm_err hm_regular_mesh(struct hm_regular *s, const struct hm_rough *rough,
                            const struct hm_regular_how *how, struct hm_mesh *mesh,
                            struct hm_diag *d)
{
    struct weave w = {
        .s = s, .rough = rough, .mesh = mesh, .quads = how->quads, .alternating = how->alternating};
    enum hm_err err = count_elements(&w, d);
    if (err)
        return err;
    size_t nodes = (w.nu + 1) * (w.nv + 1);
    if (!hm_grow(&mesh->node, &mesh->node_cap, nodes, sizeof *mesh->node))
        return hm_fail_memory(d);
    mesh->nnodes = nodes;
    hm_thread_for(how->threads, w.nu + 1, make_section, &w);
    return add_elements(&w, how->threads, d);
}

enum hm_err hm_regular_flag_border(struct hm_mesh *mesh, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n;
    enum hm_err err = hm_mesh_edges(mesh, &edge, &n, d);
    for (size_t k = 0; !err && k < n; k++)
        if (edge[k].right < 0) {
            mesh->node[edge[k].a].flags |= HM_NODE_BOUNDARY | HM_NODE_FIXED;
            mesh->node[edge[k].b].flags |= HM_NODE_BOUNDARY | HM_NODE_FIXED;
        }
    free(edge);
    return err;
}
