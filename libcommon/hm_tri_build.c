/* hm_tri_build: from input points to a triangulation. */
#include "hm_tri_topology.h"

#include "hm_order.h"

#include <math.h>
#include <stdlib.h>

static enum hm_err check_input(const double *xy, size_t n, size_t stride, struct hm_diag *d)
{
    if (n > INT32_MAX / 6)
        return hm_fail(d, HM_ENOMEM, "%zu points are too many for one triangulation", n);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(xy[i * stride]) || !isfinite(xy[i * stride + 1]))
            return hm_fail(d, HM_EGEOM, "coordinates of point %zu are not finite", i);
    if (n < 3)
        return hm_fail(d, HM_EGEOM, "a triangulation needs at least three points");
    return HM_OK;
}

/* Memory is used twice, so that the peak is what the triangulation itself takes: the sort runs in
 * the array of the triangles, and that of of_input holds the keys of the vertices until the
 * triangles are there. Equal points, of which there are few or none, are noted in a list meanwhile.
 */
struct build {
    struct hm_tri *t;
    struct hm_order_item *item;
    struct twin {
        uint32_t index;
        int32_t v;
    } * twin;
    size_t twins, cap;
};

/* Number the different points in their order. */
static enum hm_err take_vertices(struct build *b, const double *xy, size_t stride, uint32_t *key,
                                 struct hm_diag *d)
{
    struct hm_tri *t = b->t;
    int32_t count = 0;
    double *q = t->xy;
    for (size_t i = 0; i < t->n_input; i++) {
        uint32_t index = b->item[i].index;
        const double *p = xy + index * stride;
        if (count > 0 && p[0] == q[-2] && p[1] == q[-1]) {
            if (!hm_grow(&b->twin, &b->cap, b->twins + 1, sizeof *b->twin))
                return hm_fail_memory(d);
            b->twin[b->twins++] = (struct twin){index, count - 1};
            continue;
        }
        key[count] = b->item[i].key;
        t->input[count++] = (int32_t)index;
        *q++ = p[0];
        *q++ = p[1];
    }
    t->vertices = count;
    t->duplicates = b->twins;
    return HM_OK;
}

static enum hm_err allocate(struct hm_tri *t, struct hm_diag *d)
{
    size_t n = t->n_input;
    t->half = hm_alloc(6 * n, sizeof *t->half);
    t->xy = hm_alloc(2 * n, sizeof *t->xy);
    t->input = hm_alloc(n, sizeof *t->input);
    t->of_input = hm_alloc(n, sizeof *t->of_input);
    t->cap_vertices = n;
    t->cap_triangles = 2 * n;
    return t->half && t->xy && t->input && t->of_input ? HM_OK : hm_fail_memory(d);
}

static enum hm_err triangulate(struct hm_tri *t, uint32_t *key, int threads, struct hm_diag *d)
{
    if (t->vertices < 3)
        return hm_fail(d, HM_EGEOM, "all points are at %s",
                       t->vertices < 2 ? "one place" : "two places");
    t->triangles = 2 * t->vertices - 2;
    int32_t ghost = hm_tri_conquer(t->half, t->xy, t->vertices, key, threads);
    if (hm_tri_apex_of(t, t->half[ghost].twin) == HM_TRI_INFINITY)
        return hm_fail(d, HM_EGEOM, "all points are on one line");
    return HM_OK;
}

static enum hm_err build(struct build *b, const double *xy, size_t stride, int threads,
                         struct hm_diag *d)
{
    struct hm_tri *t = b->t;
    enum hm_err err = allocate(t, d);
    if (err)
        return err;
    uint32_t *key = (uint32_t *)t->of_input;
    b->item = (struct hm_order_item *)(void *)t->half;
    err = hm_order_sort(xy, t->n_input, stride, HM_ORDER_FINE, threads, b->item,
                        b->item + t->n_input, d);
    if (!err)
        err = take_vertices(b, xy, stride, key, d);
    if (!err)
        err = triangulate(t, key, threads, d);
    if (err)
        return err;
    for (int32_t v = 0; v < t->vertices; v++)
        t->of_input[t->input[v]] = v;
    for (size_t i = 0; i < b->twins; i++)
        t->of_input[b->twin[i].index] = b->twin[i].v;
    return HM_OK;
}

enum hm_err hm_tri_build(struct hm_tri **out, const double *xy, size_t n, size_t stride,
                         int threads, struct hm_diag *d)
{
    *out = NULL;
    enum hm_err err = check_input(xy, n, stride, d);
    if (err)
        return err;
    struct hm_tri *t = hm_alloc0(1, sizeof *t);
    if (!t)
        return hm_fail_memory(d);
    t->free = HM_TRI_NONE;
    t->n_input = n;
    struct build b = {.t = t};
    err = build(&b, xy, stride, threads, d);
    free(b.twin);
    if (err)
        hm_tri_free(t);
    else
        *out = t;
    return err;
}
