#include "hm_order.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

/* The first 11 bits of a key choose one of 2048 buckets; a bucket fits into the cache, and its
 * other 21 bits are sorted there in three passes over 7 bits each. */
enum { CELL_BITS = 16, BUCKETS = 2048, TAIL_BITS = 21, PASS_BITS = 7, PASSES = 3 };
enum { DIGITS = 1 << PASS_BITS, FEW = 48, CHUNKS = 32 };

struct box {
    double min[2], max[2];
};

static const struct box nothing = {.min = {INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY}};

static void box_add(struct box *b, const double *p)
{
    if (!isfinite(p[0]) || !isfinite(p[1]))
        return;
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
    struct box box = nothing;
    for (size_t i = 0; i < n; i++)
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
    for (int k = 0; k < 2; k++) {
        double at = (p[k] * f->pre - f->min[k]) * f->scale[0] * f->scale[1];
        cell[k] = at >= 0x1p16 ? 0xffff : at > 0 ? (uint32_t)at : 0; /* NaN goes anywhere */
    }
    return spread(cell[0]) | spread(cell[1]) << 1;
}

/* Stable sort by the last 21 bits of the keys, from `from` to `to`; `from` is lost. */
static void sort_tails(struct hm_order_item *from, struct hm_order_item *to, size_t n)
{
    size_t count[PASSES][DIGITS] = {{0}};
    for (size_t i = 0; i < n; i++)
        for (int pass = 0; pass < PASSES; pass++)
            count[pass][from[i].key >> pass * PASS_BITS & (DIGITS - 1)]++;
    for (int pass = 0; pass < PASSES; pass++) {
        size_t sum = 0, *at = count[pass];
        for (int k = 0; k < DIGITS; k++) {
            size_t here = at[k];
            at[k] = sum;
            sum += here;
        }
        for (size_t i = 0; i < n; i++)
            to[at[from[i].key >> pass * PASS_BITS & (DIGITS - 1)]++] = from[i];
        struct hm_order_item *swap = from;
        from = to;
        to = swap;
    } /* an odd number of passes: the last wrote where the first did */
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

struct sort {
    const double *xy;
    size_t n, stride;
    enum hm_order_how how;
    struct hm_order_item *item, *other;
    struct hm_order_frame frame;
    struct box box[CHUNKS];
    size_t (*count)[BUCKETS]; /* of a chunk's points; then where its next in a bucket goes */
    size_t start[BUCKETS + 1];
};

static size_t chunk_start(const struct sort *s, size_t chunk)
{
    return s->n / CHUNKS * chunk + (s->n % CHUNKS) * chunk / CHUNKS;
}

static size_t bucket_of(uint32_t key)
{
    return key >> TAIL_BITS;
}

static const double *point(const struct sort *s, uint32_t index)
{
    return s->xy + index * s->stride;
}

static void part_cell(const struct sort *s, struct hm_order_item *item, struct hm_order_item *other,
                      size_t n);

/* Points of one cell next to each other are parted further, on and on. */
static void part_cells(const struct sort *s, struct hm_order_item *item,
                       struct hm_order_item *other, size_t n)
{
    for (size_t i = 0, end; i < n; i = end) {
        for (end = i + 1; end < n && item[end].key == item[i].key;)
            end++;
        if (end - i > 1)
            part_cell(s, item + i, other, end - i);
    }
}

/* By the whole key. */
static void sort_cell(struct hm_order_item *item, struct hm_order_item *other, size_t n)
{
    if (n <= FEW) {
        insertion_sort(item, n);
        return;
    }
    sort_tails(item, other, n);
    size_t count[BUCKETS] = {0}, sum = 0;
    for (size_t i = 0; i < n; i++)
        count[bucket_of(other[i].key)]++;
    for (int k = 0; k < BUCKETS; k++) {
        size_t here = count[k];
        count[k] = sum;
        sum += here;
    }
    for (size_t i = 0; i < n; i++)
        item[count[bucket_of(other[i].key)]++] = other[i];
}

/* Order the points of one cell, which are n of equal key, in a frame of their own; depth is limited
 * by the exponents of double: every level parts the most distant by 15 bits at least. */
static void part_cell(const struct sort *s, struct hm_order_item *item, struct hm_order_item *other,
                      size_t n)
{
    struct box box = nothing;
    for (size_t i = 0; i < n; i++)
        box_add(&box, point(s, item[i].index));
    if (box.min[0] == box.max[0] && box.min[1] == box.max[1])
        return;
    struct hm_order_frame frame = frame_of(&box);
    uint32_t key = item[0].key;
    for (size_t i = 0; i < n; i++)
        item[i].key = hm_order_key(&frame, point(s, item[i].index));
    sort_cell(item, other, n);
    part_cells(s, item, other, n);
    for (size_t i = 0; i < n; i++)
        item[i].key = key;
}

/* The steps of the sort, a chunk of the points or a bucket at a time. */

static void find_box(void *pointer, size_t chunk)
{
    struct sort *s = pointer;
    s->box[chunk] = nothing;
    for (size_t i = chunk_start(s, chunk); i < chunk_start(s, chunk + 1); i++)
        box_add(&s->box[chunk], s->xy + i * s->stride);
}

static void find_keys(void *pointer, size_t chunk)
{
    struct sort *s = pointer;
    size_t *count = s->count[chunk];
    for (size_t i = chunk_start(s, chunk); i < chunk_start(s, chunk + 1); i++) {
        uint32_t key = hm_order_key(&s->frame, s->xy + i * s->stride);
        s->item[i] = (struct hm_order_item){.key = key, .index = (uint32_t)i};
        count[bucket_of(key)]++;
    }
}

static void fill_buckets(void *pointer, size_t chunk)
{
    struct sort *s = pointer;
    size_t *next = s->count[chunk];
    for (size_t i = chunk_start(s, chunk); i < chunk_start(s, chunk + 1); i++)
        s->other[next[bucket_of(s->item[i].key)]++] = s->item[i];
}

static void sort_bucket(void *pointer, size_t bucket)
{
    struct sort *s = pointer;
    size_t begin = s->start[bucket], n = s->start[bucket + 1] - begin;
    if (n == 0)
        return;
    sort_tails(s->other + begin, s->item + begin, n);
    if (s->how == HM_ORDER_FINE)
        part_cells(s, s->item + begin, s->other + begin, n);
}

/* From counts to places: bucket by bucket, in each chunk by chunk, so that the sort is stable. */
static void place_buckets(struct sort *s)
{
    size_t sum = 0;
    for (int k = 0; k < BUCKETS; k++) {
        s->start[k] = sum;
        for (int chunk = 0; chunk < CHUNKS; chunk++) {
            size_t here = s->count[chunk][k];
            s->count[chunk][k] = sum;
            sum += here;
        }
    }
    s->start[BUCKETS] = sum;
}

enum hm_err hm_order_sort(const double *xy, size_t n, size_t stride, enum hm_order_how how,
                          int threads, struct hm_order_item *item, struct hm_order_item *other,
                          struct hm_diag *d)
{
    struct sort s = {.xy = xy, .n = n, .stride = stride, .how = how, .item = item, .other = other};
    if (n == 0)
        return HM_OK;
    s.count = hm_alloc0(CHUNKS, sizeof *s.count);
    if (!s.count)
        return hm_fail_memory(d);
    hm_thread_for(threads, CHUNKS, find_box, &s);
    struct box box = nothing;
    for (int chunk = 0; chunk < CHUNKS; chunk++) {
        box_add(&box, s.box[chunk].min);
        box_add(&box, s.box[chunk].max);
    }
    s.frame = frame_of(&box);
    hm_thread_for(threads, CHUNKS, find_keys, &s);
    place_buckets(&s);
    hm_thread_for(threads, CHUNKS, fill_buckets, &s);
    hm_thread_for(threads, BUCKETS, sort_bucket, &s);
    free(s.count);
    return HM_OK;
}
