#include "hm_boxtree.h"

#include <stdlib.h>

enum { FAN = 8, MOST_LEVELS = 12 }; /* 8^11 > INT32_MAX */

struct hm_boxtree {
    size_t levels;
    size_t count[MOST_LEVELS];       /* boxes a level; the last has one */
    struct hm_box *box[MOST_LEVELS]; /* level 0: the items in curve order; all in one block */
    int32_t *item;                   /* number of each box of level 0 */
};

/* Distance along the Hilbert curve through a 65,536 × 65,536 lattice: of each quadrant from
 * the coarsest its rank, then the quadrant turned so that the next finer curve runs through it. */
static uint32_t hilbert(uint32_t x, uint32_t y)
{
    uint32_t distance = 0;
    for (uint32_t s = 1u << 15; s > 0; s >>= 1) {
        uint32_t rx = (x & s) != 0, ry = (y & s) != 0;
        distance += s * s * ((3 * rx) ^ ry);
        if (!ry) {
            if (rx) {
                x = ~x;
                y = ~y;
            }
            uint32_t swap = x;
            x = y;
            y = swap;
        }
    }
    return distance;
}

static int by_value(const void *pa, const void *pb)
{
    uint64_t a = *(const uint64_t *)pa, b = *(const uint64_t *)pb;
    return (a > b) - (a < b);
}

static uint32_t lattice(double value, double lo, double hi)
{
    double part = (value - lo) / (hi - lo); /* NaN when all is in one place or too far apart */
    return part > 0 ? (uint32_t)(part * 65535) : 0;
}

/* Numbers of the boxes in curve order. */
static bool sort_items(int32_t *item, const struct hm_box *box, size_t n)
{
    uint64_t *key = hm_alloc(n, sizeof *key);
    if (!key)
        return false;
    struct hm_box all = box[0];
    for (size_t i = 1; i < n; i++) {
        hm_box_add(&all, box[i].lo);
        hm_box_add(&all, box[i].hi);
    }
    for (size_t i = 0; i < n; i++) {
        uint32_t at[2];
        for (int k = 0; k < 2; k++)
            at[k] = lattice((box[i].lo[k] / 2 + box[i].hi[k] / 2), all.lo[k], all.hi[k]);
        key[i] = (uint64_t)hilbert(at[0], at[1]) << 32 | i;
    }
    qsort(key, n, sizeof *key, by_value);
    for (size_t i = 0; i < n; i++)
        item[i] = (int32_t)(key[i] & UINT32_MAX);
    free(key);
    return true;
}

/* The nodes of a level from those of the level below. */
static void gather(const struct hm_box *below, size_t n, struct hm_box *node)
{
    for (size_t i = 0; i < n; i++) {
        if (i % FAN == 0) {
            node[i / FAN] = below[i];
        } else {
            hm_box_add(&node[i / FAN], below[i].lo);
            hm_box_add(&node[i / FAN], below[i].hi);
        }
    }
}

enum hm_err hm_boxtree_build(struct hm_boxtree **tree, const struct hm_box *box, size_t n,
                             struct hm_diag *d)
{
    *tree = NULL;
    struct hm_boxtree *t = hm_alloc0(1, sizeof *t);
    if (!t)
        return hm_fail_memory(d);
    size_t total = 0;
    for (size_t count = n; n > 0; count = (count + FAN - 1) / FAN) {
        t->count[t->levels++] = count;
        total += count;
        if (count == 1)
            break;
    }
    t->item = hm_alloc(n, sizeof *t->item);
    t->box[0] = hm_alloc(total, sizeof *t->box[0]);
    if (!t->item || !t->box[0] || (n > 0 && !sort_items(t->item, box, n))) {
        hm_boxtree_free(t);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < n; i++)
        t->box[0][i] = box[t->item[i]];
    for (size_t level = 1; level < t->levels; level++) {
        t->box[level] = t->box[level - 1] + t->count[level - 1];
        gather(t->box[level - 1], t->count[level - 1], t->box[level]);
    }
    *tree = t;
    return HM_OK;
}

void hm_boxtree_free(struct hm_boxtree *t)
{
    if (!t)
        return;
    free(t->item);
    free(t->box[0]);
    free(t);
}

struct hm_boxquery hm_boxtree_find(const struct hm_boxtree *t, struct hm_box box)
{
    size_t top = t->levels > 0 ? t->levels - 1 : 0;
    return (struct hm_boxquery){.tree = t, .box = box, .level = top};
}

/* To the next box that is not below the present one: a sibling, or one of an ancestor's. */
static void step(struct hm_boxquery *q)
{
    q->at++;
    while (q->level + 1 < q->tree->levels &&
           (q->at % FAN == 0 || q->at == q->tree->count[q->level])) {
        q->at = (q->at - 1) / FAN + 1;
        q->level++;
    }
}

int32_t hm_boxtree_next(struct hm_boxquery *q)
{
    const struct hm_boxtree *t = q->tree;
    while (q->level < t->levels && q->at < t->count[q->level]) {
        size_t at = q->at;
        if (!hm_box_meets(&t->box[q->level][at], &q->box)) {
            step(q);
        } else if (q->level > 0) {
            q->level--;
            q->at *= FAN;
        } else {
            step(q);
            return t->item[at];
        }
    }
    return -1;
}
