#include "hm_boxtree.h"

#include "hm_order.h"

#include <stdlib.h>

enum { FAN = 8, MOST_LEVELS = 12 }; /* 8^11 > INT32_MAX */

struct hm_boxtree {
    size_t levels;
    size_t count[MOST_LEVELS];       /* boxes a level; the last has one */
    struct hm_box *box[MOST_LEVELS]; /* level 0: the items in curve order; all in one block */
    int32_t *item;                   /* number of each box of level 0 */
};

/* Numbers of the boxes in the order of their centres along the curve. */
static enum hm_err sort_items(int32_t *item, const struct hm_box *box, size_t n, struct hm_diag *d)
{
    double *centre = hm_alloc(n, 2 * sizeof *centre);
    struct hm_order_item *order = hm_alloc(n, 2 * sizeof *order); /* and room to sort */
    enum hm_err err = centre && order ? HM_OK : hm_fail_memory(d);
    if (!err) {
        for (size_t i = 0; i < n; i++)
            for (int k = 0; k < 2; k++)
                centre[2 * i + (size_t)k] = box[i].lo[k] / 2 + box[i].hi[k] / 2;
        err = hm_order_sort(centre, n, 2, HM_ORDER_COARSE, 1, order, order + n, d);
    }
    for (size_t i = 0; !err && i < n; i++)
        item[i] = (int32_t)order[i].index;
    free(centre);
    free(order);
    return err;
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
    enum hm_err err = t->item && t->box[0] ? sort_items(t->item, box, n, d) : hm_fail_memory(d);
    if (err) {
        hm_boxtree_free(t);
        return err;
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
