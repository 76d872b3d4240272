#include "hm_order.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_BITS = 16, RADIX_BITS = 11, RADIX = 1 << RADIX_BITS, PASSES = 3, FEW = 48 };

struct box {
    double min[2], max[2];
};

static void box_add(struct box *b, const double *p)
{
    for (int k = 0; k < 2; k++) {
        b->min[k] = p[k] < b->min[k] ? p[k] : b->min[k];
        b->max[k] = p[k] > b->max[k] ? p[k] : b->max[k];
    }
}

/* The smallest power of two above the longer side gives 2^16 cells, so the side's two ends never
 * share a cell. Halving first keeps ±1e308 finite; two factors keep a side of 1e-320 finite. */
static struct hm_order_frame frame_of(const struct box *b)
{
    struct hm_order_frame f = {.pre = 1, .scale = {0, 0}};
    if (b->max[0] - b->min[0] > 0x1p1023 || b->max[1] - b->min[1] > 0x1p1023)
        f.pre = 0.5;
    double side = 0;
    for (int k = 0; k < 2; k++) {
        f.min[k] = b->min[k] * f.pre;
        side = fmax(side, b->max[k] * f.pre - f.min[k]);
    }
    if (side > 0) {
        int above;
        frexp(side, &above);
        int shift = CELL_BITS - above;
        f.scale[0] = ldexp(1, shift / 2);
        f.scale[1] = ldexp(1, shift - shift / 2);
    }
    return f;
}

struct hm_order_frame hm_order_frame(const double *xy, size_t n, size_t stride)
{
    struct box box = {.min = {xy[0], xy[1]}, .max = {xy[0], xy[1]}};
    for (size_t i = 1; i < n; i++)
        box_add(&box, xy + i * stride);
    return frame_of(&box);
}

/* The 16 bits of v at the even places. */
static uint32_t spread(uint32_t v)
{
    v = (v | v << 8) & 0x00ff00ff;
    v = (v | v << 4) & 0x0f0f0f0f;
    v = (v | v << 2) & 0x33333333;
    return (v | v << 1) & 0x55555555;
}

uint32_t hm_order_key(const struct hm_order_frame *f, const double *p)
{
    uint32_t cell[2];
    for (int k = 0; k < 2; k++)
        cell[k] = (uint32_t)((p[k] * f->pre - f->min[k]) * f->scale[0] * f->scale[1]);
    return spread(cell[0]) | spread(cell[1]) << 1;
}

/* Stable sort by key, in three passes over 11 bits each; `other` is room for as many. */
static void radix_sort(struct hm_order_item *item, struct hm_order_item *other, size_t n)
{
    size_t count[PASSES][RADIX] = {{0}};
    for (size_t i = 0; i < n; i++)
        for (int pass = 0; pass < PASSES; pass++)
            count[pass][item[i].key >> pass * RADIX_BITS & (RADIX - 1)]++;
    struct hm_order_item *from = item, *to = other;
    for (int pass = 0; pass < PASSES; pass++) {
        size_t sum = 0, *at = count[pass];
        for (int k = 0; k < RADIX; k++) {
            size_t here = at[k];
            at[k] = sum;
            sum += here;
        }
        for (size_t i = 0; i < n; i++)
            to[at[from[i].key >> pass * RADIX_BITS & (RADIX - 1)]++] = from[i];
        struct hm_order_item *swap = from;
        from = to;
        to = swap;
    }
    memcpy(item, other, n * sizeof *item); /* an odd number of passes ends in the other */
}

static void insertion_sort(struct hm_order_item *item, size_t n)
{
    for (size_t i = 1; i < n; i++) {
        struct hm_order_item moving = item[i];
        size_t k = i;
        for (; k > 0 && item[k - 1].key > moving.key; k--)
            item[k] = item[k - 1];
        item[k] = moving;
    }
}

struct points {
    const double *xy;
    size_t stride;
};

/* Order the points of one cell, which are n of equal key, in a frame of their own; depth is limited
 * by the exponents of double: every level parts the most distant by 15 bits at least. */
static void part_cell(const struct points *p, struct hm_order_item *item,
                      struct hm_order_item *other, size_t n)
{
    const double *first = p->xy + item[0].index * p->stride;
    struct box box = {.min = {first[0], first[1]}, .max = {first[0], first[1]}};
    for (size_t i = 1; i < n; i++)
        box_add(&box, p->xy + item[i].index * p->stride);
    if (box.min[0] == box.max[0] && box.min[1] == box.max[1])
        return;
    struct hm_order_frame frame = frame_of(&box);
    uint32_t key = item[0].key;
    for (size_t i = 0; i < n; i++)
        item[i].key = hm_order_key(&frame, p->xy + item[i].index * p->stride);
    if (n <= FEW)
        insertion_sort(item, n);
    else
        radix_sort(item, other, n);
    for (size_t i = 0, end; i < n; i = end) {
        for (end = i + 1; end < n && item[end].key == item[i].key;)
            end++;
        if (end - i > 1)
            part_cell(p, item + i, other, end - i);
    }
    for (size_t i = 0; i < n; i++)
        item[i].key = key;
}

static enum hm_err sort(const double *xy, size_t n, size_t stride, struct hm_order_item *item,
                        bool fine, struct hm_diag *d)
{
    if (n == 0)
        return HM_OK;
    struct hm_order_item *other = hm_alloc(n, sizeof *other);
    if (!other)
        return hm_fail_memory(d);
    struct hm_order_frame frame = hm_order_frame(xy, n, stride);
    for (size_t i = 0; i < n; i++)
        item[i] = (struct hm_order_item){.key = hm_order_key(&frame, xy + i * stride),
                                         .index = (uint32_t)i};
    radix_sort(item, other, n);
    struct points points = {.xy = xy, .stride = stride};
    for (size_t i = 0, end; fine && i < n; i = end) {
        for (end = i + 1; end < n && item[end].key == item[i].key;)
            end++;
        if (end - i > 1)
            part_cell(&points, item + i, other, end - i);
    }
    free(other);
    return HM_OK;
}

enum hm_err hm_order_points(const double *xy, size_t n, size_t stride, struct hm_order_item *item,
                            struct hm_diag *d)
{
    return sort(xy, n, stride, item, true, d);
}

enum hm_err hm_order_coarse(const double *xy, size_t n, size_t stride, struct hm_order_item *item,
                            struct hm_diag *d)
{
    return sort(xy, n, stride, item, false, d);
}
