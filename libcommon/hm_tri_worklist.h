/* hm_tri_worklist: triangles to be refined, those with the shortest edges first. Layer 2.
 * Internal to hm_tri_refine.c.
 *
 * Lists of equal priority, four to a doubling of the length: nearly sorted, at the cost of a queue.
 * A list is a chain of blocks, so that its items lie one behind the other.
 */
#ifndef HM_TRI_WORKLIST_H
#define HM_TRI_WORKLIST_H

#include "hm_base.h"

/* A triangle by its shortest edge, and its corners; it is gone when others stand there. */
struct hm_tri_work {
    int32_t e, v[3];
};

enum {
    HM_TRI_BLOCK = 63,
    HM_TRI_NO_BLOCK = -1,
    HM_TRI_LISTS = 8192 /* four for each power of two that the square of a length can be near */
};

struct hm_tri_worklist {
    bool newest_first; /* within a list; the oldest otherwise */
    struct block {
        struct hm_tri_work work[HM_TRI_BLOCK];
        int32_t next, before; /* in its list; next also in that of free blocks */
    } * block;
    size_t n, cap;
    int32_t free;
    struct {
        int32_t head, tail; /* blocks; none: it is empty */
        int32_t first, end; /* first item in the head, behind the last one in the tail */
    } list[HM_TRI_LISTS];
    int lowest; /* no list below has items; HM_TRI_LISTS: none has */
};

void hm_tri_worklist_init(struct hm_tri_worklist *w, bool newest_first);
enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d);
bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work);

/* The work that comes so many places after the next one, or NULL: to fetch it from memory in time.
 */
static inline const struct hm_tri_work *hm_tri_worklist_soon(const struct hm_tri_worklist *w,
                                                             int32_t after)
{
    int i = w->lowest;
    if (i == HM_TRI_LISTS || w->list[i].head == HM_TRI_NO_BLOCK)
        return NULL;
    bool only = w->list[i].head == w->list[i].tail;
    int32_t first = !w->newest_first || only ? w->list[i].first : 0;
    int32_t end = w->newest_first || only ? w->list[i].end : HM_TRI_BLOCK;
    int32_t at = w->newest_first ? end - 1 - after : first + after;
    int32_t block = w->newest_first ? w->list[i].tail : w->list[i].head;
    return at >= first && at < end ? &w->block[block].work[at] : NULL;
}

#endif
