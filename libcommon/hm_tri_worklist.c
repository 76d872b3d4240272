#include "hm_tri_worklist.h"

#include <string.h>

enum { NONE = -1, AHEAD = 4 };

void hm_tri_worklist_init(struct hm_tri_worklist *w)
{
    w->block = NULL;
    w->n = w->cap = 0;
    w->free = NONE;
    w->lowest = HM_TRI_LISTS;
    for (int i = 0; i < HM_TRI_LISTS; i++)
        w->list[i].head = NONE;
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

static bool take_block(struct hm_tri_worklist *w, int32_t *block)
{
    *block = w->free;
    if (*block != NONE) {
        w->free = w->block[*block].next;
    } else {
        if (w->n == INT32_MAX || !hm_grow(&w->block, &w->cap, w->n + 1, sizeof *w->block))
            return false;
        *block = (int32_t)w->n++;
    }
    w->block[*block].next = NONE;
    return true;
}

enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d)
{
    int i = list_of(length2);
    int32_t block;
    if (w->list[i].head == NONE) {
        if (!take_block(w, &block))
            return hm_fail_memory(d);
        w->list[i].head = w->list[i].tail = block;
        w->list[i].first = w->list[i].end = 0;
    } else if (w->list[i].end == HM_TRI_BLOCK) {
        if (!take_block(w, &block))
            return hm_fail_memory(d);
        w->block[w->list[i].tail].next = block;
        w->list[i].tail = block;
        w->list[i].end = 0;
    }
    w->block[w->list[i].tail].work[w->list[i].end++] = work;
    w->lowest = i < w->lowest ? i : w->lowest;
    return HM_OK;
}

bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work)
{
    while (w->lowest < HM_TRI_LISTS && w->list[w->lowest].head == NONE)
        w->lowest++;
    if (w->lowest == HM_TRI_LISTS)
        return false;
    int i = w->lowest;
    int32_t head = w->list[i].head;
    *work = w->block[head].work[w->list[i].first++];
    bool last = head == w->list[i].tail && w->list[i].first == w->list[i].end;
    if (last || w->list[i].first == HM_TRI_BLOCK) {
        w->list[i].head = last ? NONE : w->block[head].next;
        w->list[i].first = 0;
        w->block[head].next = w->free;
        w->free = head;
    }
    return true;
}

const struct hm_tri_work *hm_tri_worklist_soon(const struct hm_tri_worklist *w)
{
    int i = w->lowest;
    if (i == HM_TRI_LISTS || w->list[i].head == NONE)
        return NULL;
    int32_t at = w->list[i].first + AHEAD;
    int32_t end = w->list[i].head == w->list[i].tail ? w->list[i].end : HM_TRI_BLOCK;
    return at < end ? &w->block[w->list[i].head].work[at] : NULL;
}
