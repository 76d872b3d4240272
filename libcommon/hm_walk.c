#include "hm_walk.h"

#include "hm_plane.h"
#include "hm_pred_inline.h"

#include <stdlib.h>

enum { MOST_STEPS = 64, NOTHING = -1, FAULT = -2 };

struct hm_walk {
    const struct hm_mesh *mesh;
    struct hm_locate *locate;
    bool plane;
    int32_t (*beside)[4]; /* of each element, across the edge that begins at corner k; or NOTHING,
                             on the border of the mesh, or FAULT */
    bool *border;         /* of each node: on the border of the mesh */
};

/* The corner of an element at which the edge from a begins. */
static int corner_of(const struct hm_elem *e, int32_t a)
{
    int k = 0;
    while (e->node[k] != a)
        k++;
    return k;
}

static void enter(struct hm_walk *w, const struct hm_mesh_edge *edge)
{
    const struct hm_elem *elem = w->mesh->elem;
    w->beside[edge->left][corner_of(&elem[edge->left], edge->a)] = edge->right;
    if (edge->right >= 0)
        w->beside[edge->right][corner_of(&elem[edge->right], edge->b)] = edge->left;
    else if (edge->right == NOTHING)
        w->border[edge->a] = w->border[edge->b] = true;
}

enum hm_err hm_walk_build(struct hm_walk **walk, const struct hm_mesh *mesh,
                          const struct hm_mesh_edge *edge, size_t nedges, bool plane,
                          struct hm_diag *d)
{
    *walk = NULL;
    struct hm_walk *w = hm_alloc0(1, sizeof *w);
    if (!w)
        return hm_fail_memory(d);
    w->mesh = mesh;
    w->plane = plane;
    w->beside = hm_alloc(mesh->nelems, sizeof *w->beside);
    w->border = hm_alloc0(mesh->nnodes, sizeof *w->border);
    enum hm_err err =
        w->beside && w->border ? hm_locate_build(&w->locate, mesh, d) : hm_fail_memory(d);
    if (err) {
        hm_walk_free(w);
        return err;
    }
    for (size_t i = 0; i < mesh->nelems; i++)
        for (int k = 0; k < 4; k++)
            w->beside[i][k] = FAULT;
    for (size_t i = 0; i < nedges; i++)
        enter(w, &edge[i]);
    *walk = w;
    return HM_OK;
}

void hm_walk_free(struct hm_walk *w)
{
    if (!w)
        return;
    hm_locate_free(w->locate);
    free(w->beside);
    free(w->border);
    free(w);
}

/* The edge of element e, by its first corner, that has p most clearly outside; -1 when p is
 * strictly inside, -2 when it lies on the border of e. */
static int way_out(const struct hm_mesh *m, const struct hm_elem *e, const double *p)
{
    int corners = hm_elem_corners(e), out = -1;
    for (int k = 0; k < corners; k++) {
        const double *a = hm_mesh_xy(m, e->node[k]);
        const double *b = hm_mesh_xy(m, e->node[k + 1 < corners ? k + 1 : 0]);
        int side = hm_pred_orient_fast(a, b, p);
        if (side < 0)
            return k;
        if (side == 0)
            out = -2;
    }
    return out;
}

int64_t hm_walk_element(const struct hm_walk *w, double px, double py, int32_t *hint)
{
    const double p[2] = {px, py};
    int32_t e = *hint;
    if (w->plane && e >= 0 && (size_t)e < w->mesh->nelems)
        for (int step = 0; step < MOST_STEPS && e >= 0; step++) {
            int k = way_out(w->mesh, &w->mesh->elem[e], p);
            if (k == -1)
                return *hint = e;
            if (k < 0)
                break;
            e = w->beside[e][k];
        }
    int64_t found = hm_locate_element(w->locate, px, py);
    if (found >= 0)
        *hint = (int32_t)found;
    return found;
}

bool hm_walk_on_border(const struct hm_walk *w, int64_t e, double px, double py)
{
    const struct hm_elem *elem = &w->mesh->elem[e];
    const double p[2] = {px, py};
    int corners = hm_elem_corners(elem);
    for (int k = 0; k < corners; k++) {
        int32_t a = elem->node[k], b = elem->node[k + 1 < corners ? k + 1 : 0];
        if (w->border[a] && hm_plane_same(hm_mesh_xy(w->mesh, a), p))
            return true;
        if (w->beside[e][k] == NOTHING &&
            hm_plane_holds(p, hm_mesh_xy(w->mesh, a), hm_mesh_xy(w->mesh, b)))
            return true;
    }
    return false;
}

const struct hm_boxtree *hm_walk_boxes(const struct hm_walk *w)
{
    return hm_locate_boxes(w->locate);
}
