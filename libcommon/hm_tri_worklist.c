#include "hm_tri_worklist.h"

#include <math.h>

enum { NONE = -1 };

void hm_tri_worklist_init(struct hm_tri_worklist *w)
{
    w->item = NULL;
    w->n = w->cap = 0;
    w->free = NONE;
    w->lowest = HM_TRI_LISTS;
    for (int i = 0; i < HM_TRI_LISTS; i++)
        w->head[i] = w->tail[i] = NONE;
}

static int list_of(double length2)
{
    int exponent;
    double part = frexp(length2, &exponent); /* 0.5 .. 1, exponent -1073 .. 1024 */
    int list = 4 * (exponent + 1074) + (int)(8 * part) - 4;
    return list < 0 ? 0 : list < HM_TRI_LISTS ? list : HM_TRI_LISTS - 1;
}

enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d)
{
    int32_t i = w->free;
    if (i != NONE) {
        w->free = w->item[i].next;
    } else {
        if (w->n == INT32_MAX || !hm_grow(&w->item, &w->cap, w->n + 1, sizeof *w->item))
            return hm_fail_memory(d);
        i = (int32_t)w->n++;
    }
    w->item[i].work = work;
    w->item[i].next = NONE;
    int list = list_of(length2);
    if (w->head[list] == NONE)
        w->head[list] = i;
    else
        w->item[w->tail[list]].next = i;
    w->tail[list] = i;
    w->lowest = list < w->lowest ? list : w->lowest;
    return HM_OK;
}

bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work)
{
    while (w->lowest < HM_TRI_LISTS && w->head[w->lowest] == NONE)
        w->lowest++;
    if (w->lowest == HM_TRI_LISTS)
        return false;
    int32_t i = w->head[w->lowest];
    *work = w->item[i].work;
    w->head[w->lowest] = w->item[i].next;
    w->item[i].next = w->free;
    w->free = i;
    return true;
}
