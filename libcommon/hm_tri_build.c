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

/* Number the different points in their order; key[v] becomes the key of vertex v. */
static enum hm_err take_vertices(struct hm_tri *t, const double *xy, size_t stride,
                                 const struct hm_order_item *item, uint32_t *key, struct hm_diag *d)
{
    size_t n = t->n_input;
    t->xy = hm_alloc(2 * n, sizeof *t->xy);
    t->input = hm_alloc(n, sizeof *t->input);
    t->of_input = hm_alloc(n, sizeof *t->of_input);
    if (!t->xy || !t->input || !t->of_input)
        return hm_fail_memory(d);
    int32_t count = 0;
    double *q = t->xy;
    for (size_t i = 0; i < n; i++) {
        const double *p = xy + item[i].index * stride;
        if (count == 0 || p[0] != q[-2] || p[1] != q[-1]) {
            key[count] = item[i].key;
            t->input[count++] = (int32_t)item[i].index;
            *q++ = p[0];
            *q++ = p[1];
        }
        t->of_input[item[i].index] = count - 1;
    }
    t->vertices = count;
    t->cap_vertices = n;
    t->duplicates = n - (size_t)count;
    return HM_OK;
}

static enum hm_err order_vertices(struct hm_tri *t, const double *xy, size_t stride, uint32_t *key,
                                  int threads, struct hm_diag *d)
{
    (void)threads;
    struct hm_order_item *item = hm_alloc(t->n_input, sizeof *item);
    enum hm_err err = item ? hm_order_points(xy, t->n_input, stride, item, d) : hm_fail_memory(d);
    if (!err)
        err = take_vertices(t, xy, stride, item, key, d);
    free(item);
    return err;
}

static enum hm_err triangulate(struct hm_tri *t, uint32_t *key, int threads, struct hm_diag *d)
{
    if (t->vertices < 3)
        return hm_fail(d, HM_EGEOM, "all points are at %s",
                       t->vertices < 2 ? "one place" : "two places");
    t->triangles = 2 * t->vertices - 2;
    t->cap_triangles = (size_t)t->triangles;
    t->half = hm_alloc(3 * t->cap_triangles, sizeof *t->half);
    if (!t->half)
        return hm_fail_memory(d);
    int32_t ghost = hm_tri_conquer(t->half, t->xy, t->vertices, key, threads);
    if (hm_tri_apex_of(t, t->half[ghost].twin) == HM_TRI_INFINITY)
        return hm_fail(d, HM_EGEOM, "all points are on one line");
    return HM_OK;
}

static enum hm_err find_edges(struct hm_tri *t, struct hm_diag *d)
{
    t->edge = hm_alloc(t->cap_vertices, sizeof *t->edge);
    if (!t->edge)
        return hm_fail_memory(d);
    for (int32_t e = 0; e < 3 * t->triangles; e++)
        if (t->half[e].org != HM_TRI_INFINITY)
            t->edge[t->half[e].org] = e;
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
    uint32_t *key = hm_alloc(n, sizeof *key);
    if (!t || !key) {
        free(t);
        free(key);
        return hm_fail_memory(d);
    }
    t->free = HM_TRI_NONE;
    t->n_input = n;
    err = order_vertices(t, xy, stride, key, threads, d);
    if (!err)
        err = triangulate(t, key, threads, d);
    free(key);
    if (!err)
        err = find_edges(t, d);
    if (err)
        hm_tri_free(t);
    else
        *out = t;
    return err;
}
