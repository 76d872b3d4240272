#include "hm_tri_worklist.h"

#include <string.h>

void hm_tri_worklist_init(struct hm_tri_worklist *w, bool newest_first)
{
    w->newest_first = newest_first;
    w->block = NULL;
    w->n = w->cap = 0;
    w->free = HM_TRI_NO_BLOCK;
    w->lowest = HM_TRI_LISTS;
    for (int i = 0; i < HM_TRI_LISTS; i++)
        w->list[i].head = HM_TRI_NO_BLOCK;
}

/* Exponent and the first two bits behind the point, as they stand in the double: ordered as the
 * lengths are. */
static int list_of(double length2)
{
    uint64_t bits;
    memcpy(&bits, &length2, sizeof bits);
    uint64_t list = bits >> 50;
    return list < HM_TRI_LISTS ? (int)list : HM_TRI_LISTS - 1;
}

static bool take_block(struct hm_tri_worklist *w, int32_t before, int32_t *block)
{
    *block = w->free;
    if (*block != HM_TRI_NO_BLOCK) {
        w->free = w->block[*block].next;
    } else {
        if (w->n == INT32_MAX || !hm_grow(&w->block, &w->cap, w->n + 1, sizeof *w->block))
            return false;
        *block = (int32_t)w->n++;
    }
    w->block[*block].next = HM_TRI_NO_BLOCK;
    w->block[*block].before = before;
    if (before != HM_TRI_NO_BLOCK)
        w->block[before].next = *block;
    return true;
}

static void give_block(struct hm_tri_worklist *w, int32_t block)
{
    w->block[block].next = w->free;
    w->free = block;
}

enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d)
{
    int i = list_of(length2);
    int32_t block;
    bool empty = w->list[i].head == HM_TRI_NO_BLOCK;
    if (empty || w->list[i].end == HM_TRI_BLOCK) {
        if (!take_block(w, empty ? HM_TRI_NO_BLOCK : w->list[i].tail, &block))
            return hm_fail_memory(d);
        w->list[i].tail = block;
        w->list[i].end = 0;
    }
    if (empty) {
        w->list[i].head = w->list[i].tail;
        w->list[i].first = 0;
    }
    w->block[w->list[i].tail].work[w->list[i].end++] = work;
    w->lowest = i < w->lowest ? i : w->lowest;
    return HM_OK;
}

/* Blocks at either end that have nothing left. */
static void give_spent(struct hm_tri_worklist *w, int i)
{
    int32_t head = w->list[i].head, tail = w->list[i].tail;
    if (head == tail) {
        if (w->list[i].first == w->list[i].end) {
            w->list[i].head = HM_TRI_NO_BLOCK;
            give_block(w, head);
        }
    } else if (w->list[i].first == HM_TRI_BLOCK) {
        w->list[i].head = w->block[head].next;
        w->list[i].first = 0;
        give_block(w, head);
    } else if (w->list[i].end == 0) {
        w->list[i].tail = w->block[tail].before;
        w->list[i].end = HM_TRI_BLOCK;
        give_block(w, tail);
    }
}

bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work)
{
    while (w->lowest < HM_TRI_LISTS && w->list[w->lowest].head == HM_TRI_NO_BLOCK)
        w->lowest++;
    if (w->lowest == HM_TRI_LISTS)
        return false;
    int i = w->lowest;
    if (w->newest_first)
        *work = w->block[w->list[i].tail].work[--w->list[i].end];
    else
        *work = w->block[w->list[i].head].work[w->list[i].first++];
    give_spent(w, i);
    return true;
}
