/* hm_tri_build: from input points to a triangulation. */
#include "hm_tri_topology.h"

#include "hm_order.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

static enum hm_err check_input(const double *xy, size_t n, size_t stride, struct hm_diag *d)
{
    if (n > HM_TRI_MOST_VERTICES)
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
struct equal {
    int32_t input, v;
};

struct build {
    struct hm_tri *t;
    const double *xy;
    size_t stride;
    int threads;
    struct hm_order_item *item;
    uint32_t *key;
    struct equal *equal;
    size_t equals, cap;
};

enum { CHUNK = 1 << 15 };

/* The points in their order, a chunk of them; equal ones still are side by side. */
static void gather(void *pointer, size_t chunk)
{
    struct build *b = pointer;
    struct hm_tri *t = b->t;
    size_t end = (chunk + 1) * CHUNK < t->n_input ? (chunk + 1) * CHUNK : t->n_input;
    for (size_t i = chunk * CHUNK; i < end; i++) {
        struct hm_order_item item = b->item[i];
        t->xy[2 * i] = b->xy[item.index * b->stride];
        t->xy[2 * i + 1] = b->xy[item.index * b->stride + 1];
        t->input[i] = (int32_t)item.index;
        b->key[i] = item.key;
    }
}

/* Keep the first of equal points. */
static enum hm_err merge_equal(struct build *b, struct hm_diag *d)
{
    struct hm_tri *t = b->t;
    size_t n = 0;
    for (size_t i = 0; i < t->n_input; i++) {
        const double *p = t->xy + 2 * i;
        if (n > 0 && p[0] == t->xy[2 * n - 2] && p[1] == t->xy[2 * n - 1]) {
            if (!hm_grow(&b->equal, &b->cap, b->equals + 1, sizeof *b->equal))
                return hm_fail_memory(d);
            b->equal[b->equals++] = (struct equal){t->input[i], (int32_t)n - 1};
        } else {
            t->xy[2 * n] = p[0];
            t->xy[2 * n + 1] = p[1];
            t->input[n] = t->input[i];
            b->key[n++] = b->key[i];
        }
    }
    t->vertices = t->built = (int32_t)n;
    t->duplicates = b->equals;
    return HM_OK;
}

/* With room for a few vertices more, which costs no memory while nobody writes there: the handful
 * that crossing constraints make shall not move a million. */
static enum hm_err allocate(struct hm_tri *t, struct hm_diag *d)
{
    size_t n = t->n_input, room = n + n / 32 + 16;
    if (room > HM_TRI_MOST_VERTICES)
        room = HM_TRI_MOST_VERTICES;
    t->half = hm_alloc(6 * room, sizeof *t->half);
    t->xy = hm_alloc(2 * room, sizeof *t->xy);
    t->input = hm_alloc(room, sizeof *t->input);
    t->of_input = hm_alloc(n, sizeof *t->of_input);
    t->cap_vertices = room;
    t->cap_triangles = 2 * room;
    return t->half && t->xy && t->input && t->of_input ? HM_OK : hm_fail_memory(d);
}

static enum hm_err triangulate(const struct build *b, struct hm_diag *d)
{
    struct hm_tri *t = b->t;
    if (t->vertices < 3)
        return hm_fail(d, HM_EGEOM, "all points are at %s",
                       t->vertices < 2 ? "one place" : "two places");
    t->triangles = 2 * t->vertices - 2;
    int32_t ghost = hm_tri_conquer(t->half, t->xy, t->vertices, b->key, b->threads);
    if (hm_tri_apex_of(t, t->half[ghost].twin) == HM_TRI_INFINITY)
        return hm_fail(d, HM_EGEOM, "all points are on one line");
    return HM_OK;
}

static enum hm_err build(struct build *b, struct hm_diag *d)
{
    struct hm_tri *t = b->t;
    enum hm_err err = allocate(t, d);
    if (err)
        return err;
    b->key = (uint32_t *)t->of_input;
    b->item = (struct hm_order_item *)(void *)t->half;
    err = hm_order_sort(b->xy, t->n_input, b->stride, HM_ORDER_FINE, b->threads, b->item,
                        b->item + t->n_input, d);
    if (err)
        return err;
    hm_thread_for(b->threads, (t->n_input + CHUNK - 1) / CHUNK, gather, b);
    t->frame = hm_order_frame(t->xy, t->n_input, 2);
    err = merge_equal(b, d);
    if (!err)
        err = triangulate(b, d);
    if (err)
        return err;
    for (int32_t v = 0; v < t->vertices; v++)
        t->of_input[t->input[v]] = v;
    for (size_t i = 0; i < b->equals; i++)
        t->of_input[b->equal[i].input] = b->equal[i].v;
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
    struct build b = {.t = t, .xy = xy, .stride = stride, .threads = threads};
    err = build(&b, d);
    free(b.equal);
    if (err)
        hm_tri_free(t);
    else
        *out = t;
    return err;
}
