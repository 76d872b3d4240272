#include "hm_facefit.h"

#include "hm_elem.h"
#include "hm_locate.h"
#include "hm_meshedges.h"
#include "hm_plane.h"
#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double least_angle = 12;

/* The elements around each node: elem[start[v]] .. elem[start[v + 1] - 1]. */
struct around {
    size_t *start;
    int32_t *elem;
};

static enum hm_err list_around(struct around *a, const struct hm_mesh *m, struct hm_diag *d)
{
    a->start = hm_alloc0(m->nnodes + 2, sizeof *a->start);
    a->elem = hm_alloc(4 * m->nelems, sizeof *a->elem);
    if (!a->start || !a->elem)
        return hm_fail_memory(d);
    for (size_t k = 0; k < m->nelems; k++)
        for (int c = 0; c < hm_elem_corners(&m->elem[k]); c++)
            a->start[m->elem[k].node[c] + 2]++;
    for (size_t v = 0; v < m->nnodes; v++)
        a->start[v + 2] += a->start[v + 1];
    for (size_t k = 0; k < m->nelems; k++)
        for (int c = 0; c < hm_elem_corners(&m->elem[k]); c++)
            a->elem[a->start[m->elem[k].node[c] + 1]++] = (int32_t)k;
    return HM_OK;
}

/* The smallest angle of the elements around v; 0 when one is not convex. */
static double angle_around(const struct hm_mesh *m, const struct around *a, size_t v)
{
    double least = 180;
    for (size_t i = a->start[v]; i < a->start[v + 1]; i++) {
        double small, large;
        if (!hm_elem_is_convex(m, &m->elem[a->elem[i]]))
            return 0;
        hm_elem_angles(m, &m->elem[a->elem[i]], &small, &large);
        least = fmin(least, small);
    }
    return least;
}

static double size_around(const struct hm_mesh *m, const struct around *a, size_t v)
{
    double sum = 0;
    for (size_t i = a->start[v]; i < a->start[v + 1]; i++)
        sum += hm_elem_mean_edge(m, &m->elem[a->elem[i]]);
    return sum / (double)(a->start[v + 1] - a->start[v]);
}

/* The place nearest to p on a loop of the surface, and its distance. */
static double nearest_place(const double *p, int32_t surface, const struct hm_face *faces, size_t n,
                            double place[2])
{
    double least = INFINITY;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; faces[k].surface == surface && i < hm_polyline_pieces(&faces[k].loop);
             i++) {
            const double *a = hm_polyline_from(&faces[k].loop, i);
            const double *b = hm_polyline_to(&faces[k].loop, i);
            double t = hm_plane_foot(p, a, b);
            const double at[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
            double apart = hypot(at[0] - p[0], at[1] - p[1]);
            if (apart < least) {
                least = apart;
                memcpy(place, at, sizeof at);
            }
        }
    return least;
}

/* Move node v to the place, or half way, or a quarter; returns which part. */
static double move_node(struct hm_mesh *m, const struct around *a, size_t v, const double place[2])
{
    struct hm_node *node = &m->node[v];
    const double x = node->x, y = node->y, floor = fmin(least_angle, angle_around(m, a, v));
    for (double part = 1; part > 0.2; part /= 2) {
        node->x = part == 1 ? place[0] : x + part * (place[0] - x);
        node->y = part == 1 ? place[1] : y + part * (place[1] - y);
        double angle = angle_around(m, a, v);
        if (angle > 0 && angle >= floor)
            return part;
    }
    node->x = x;
    node->y = y;
    return 0;
}

static enum hm_err mark_border(const struct hm_mesh *m, bool *border, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edge, &n, d);
    for (size_t k = 0; !err && k < n; k++)
        if (edge[k].right < 0)
            border[edge[k].a] = border[edge[k].b] = true;
    free(edge);
    return err;
}

/* A mesh as it is before the cut, its border nodes flagged here and there. */
static enum hm_err keep_whole(struct hm_mesh *m, struct hm_mesh *whole, struct hm_diag *d)
{
    bool *border = hm_alloc0(m->nnodes, sizeof *border);
    whole->node = hm_alloc(m->nnodes, sizeof *whole->node);
    whole->elem = hm_alloc(m->nelems, sizeof *whole->elem);
    enum hm_err err =
        border && whole->node && whole->elem ? mark_border(m, border, d) : hm_fail_memory(d);
    if (!err) {
        for (size_t v = 0; v < m->nnodes; v++)
            m->node[v].flags |= border[v] ? HM_NODE_BOUNDARY : 0;
        memcpy(whole->node, m->node, m->nnodes * sizeof *m->node);
        memcpy(whole->elem, m->elem, m->nelems * sizeof *m->elem);
        whole->nnodes = m->nnodes;
        whole->nelems = m->nelems;
    }
    free(border);
    return err;
}

/* Nodes of the cut: on the border now, and not before, unless outside the loops. */
static enum hm_err mark_cut(const struct hm_mesh *m, int32_t surface, const struct hm_face *faces,
                            size_t n, bool *cut, struct hm_diag *d)
{
    enum hm_err err = mark_border(m, cut, d);
    for (size_t v = 0; !err && v < m->nnodes; v++)
        cut[v] = cut[v] && !((m->node[v].flags & HM_NODE_BOUNDARY) &&
                             hm_face_is_inside(&m->node[v].x, surface, faces, n));
    return err;
}

static void set_height(struct hm_node *node, const struct hm_mesh *whole,
                       const struct hm_locate *where)
{
    int64_t e = hm_locate_element(where, node->x, node->y);
    if (e >= 0)
        node->z = hm_elem_height(whole, &whole->elem[e], node->x, node->y);
    node->flags &= ~HM_NODE_BREAKLINE;
}

/* One pass over the nodes marked; those that come to lie on the loop need no more. Returns how many
 * moved at all. */
static int64_t move_pass(struct hm_mesh *mesh, const struct around *around, int32_t surface,
                         const struct hm_face *faces, size_t n, bool *cut, struct hm_facefit *fit)
{
    int64_t moved = 0;
    fit->off = 0;
    for (size_t v = 0; v < mesh->nnodes; v++) {
        double place[2], part = 0;
        if (!cut[v])
            continue;
        double apart = nearest_place(hm_mesh_xy(mesh, (int32_t)v), surface, faces, n, place);
        if (apart <= size_around(mesh, around, v))
            part = move_node(mesh, around, v, place);
        cut[v] = part < 1;
        moved += part > 0;
        fit->off += part < 1;
        fit->moved += part == 1;
        fit->furthest = part == 1 ? fmax(fit->furthest, apart) : fit->furthest;
    }
    return moved;
}

/* Move the nodes of the cut; beside[v]: node v of it is left beside the loop. */
static enum hm_err move_cut(struct hm_mesh *mesh, const struct hm_locate *where,
                            const struct hm_mesh *whole, int32_t surface,
                            const struct hm_face *faces, size_t n, bool *beside,
                            struct hm_facefit *fit, struct hm_diag *d)
{
    enum { PASSES = 6 };
    struct around around = {0};
    fit->moved = 0;
    enum hm_err err = list_around(&around, mesh, d);
    if (!err)
        err = mark_cut(mesh, surface, faces, n, beside, d);
    for (size_t v = 0; !err && v < mesh->nnodes; v++)
        if (beside[v])
            mesh->node[v].z = NAN;
    for (int pass = 0; !err && pass < PASSES; pass++)
        if (move_pass(mesh, &around, surface, faces, n, beside, fit) == 0)
            break;
    for (size_t v = 0; !err && v < mesh->nnodes; v++)
        if (isnan(mesh->node[v].z))
            set_height(&mesh->node[v], whole, where);
    free(around.start);
    free(around.elem);
    return err;
}

/* Elements with a node left outside go: they are the teeth. *dropped: how many. */
static enum hm_err drop_teeth(struct hm_mesh *mesh, int32_t surface, const struct hm_face *faces,
                              size_t n, const bool *beside, struct hm_face_cut *cut,
                              int64_t *dropped, struct hm_diag *d)
{
    *dropped = 0;
    bool *keep = hm_alloc(mesh->nelems, sizeof *keep);
    if (!keep)
        return hm_fail_memory(d);
    for (size_t k = 0; k < mesh->nelems; k++) {
        keep[k] = true;
        for (int c = 0; c < hm_elem_corners(&mesh->elem[k]); c++) {
            int32_t v = mesh->elem[k].node[c];
            keep[k] =
                keep[k] && !(beside[v] && !hm_face_is_inside(&mesh->node[v].x, surface, faces, n));
        }
        *dropped += !keep[k];
    }
    enum hm_err err = *dropped > 0 ? hm_face_keep(mesh, keep, cut, d) : HM_OK;
    free(keep);
    return err;
}

/* Elements that are left without a neighbour go. */
static enum hm_err drop_lonely(struct hm_mesh *mesh, struct hm_face_cut *cut, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n;
    bool *keep = hm_alloc0(mesh->nelems, sizeof *keep);
    enum hm_err err = keep ? hm_mesh_edges(mesh, &edge, &n, d) : hm_fail_memory(d);
    for (size_t k = 0; !err && k < n; k++)
        if (edge[k].right >= 0)
            keep[edge[k].left] = keep[edge[k].right] = true;
    if (!err && mesh->nelems > 1)
        err = hm_face_keep(mesh, keep, cut, d);
    free(edge);
    free(keep);
    return err;
}

enum hm_err hm_facefit_apply(struct hm_mesh *mesh, const struct hm_rough *surface,
                             const struct hm_face *faces, size_t n, struct hm_face_cut *cut,
                             struct hm_facefit *fit, struct hm_diag *d)
{
    enum { ROUNDS = 3 };
    struct hm_mesh whole = {0};
    struct hm_locate *where = NULL;
    *fit = (struct hm_facefit){0};
    *cut = (struct hm_face_cut){0};
    enum hm_err err = keep_whole(mesh, &whole, d);
    bool *beside = hm_alloc(mesh->nnodes, sizeof *beside);
    if (!err)
        err = beside ? hm_locate_build(&where, &whole, d) : hm_fail_memory(d);
    if (!err)
        err = hm_face_apply(mesh, surface, faces, n, true, cut, d);
    int64_t dropped = cut->dropped;
    for (int round = 0; !err && dropped > 0 && round < ROUNDS; round++) {
        memset(beside, 0, mesh->nnodes * sizeof *beside);
        err = move_cut(mesh, where, &whole, surface->number, faces, n, beside, fit, d);
        if (!err && round + 1 < ROUNDS)
            err = drop_teeth(mesh, surface->number, faces, n, beside, cut, &dropped, d);
    }
    if (!err && cut->dropped > 0)
        err = drop_lonely(mesh, cut, d);
    if (!err && cut->dropped > 0 && mesh->nelems > 0)
        err = hm_facefit_fill(mesh, surface->number, faces, n, least_angle, &fit->filled, d);
    if (!err && mesh->nelems == 0)
        err = hm_fail(d, HM_EGEOM, "nothing of surface '%s' can be fitted to its face loop",
                      surface->name);
    hm_locate_free(where);
    hm_mesh_free(&whole);
    free(beside);
    return err;
}
