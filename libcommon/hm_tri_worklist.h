/* hm_tri_worklist: triangles to be refined, those with the shortest edges first. Layer 2.
 * Internal to hm_tri_refine.c.
 *
 * Lists of equal priority, four to a doubling of the length, first in first out: nearly sorted, at
 * the cost of a queue. A list is a chain of blocks, so that its items lie one behind the other.
 */
#ifndef HM_TRI_WORKLIST_H
#define HM_TRI_WORKLIST_H

#include "hm_base.h"

/* A triangle by its shortest edge, and its corners from there; it is gone when the edge has others.
 */
struct hm_tri_work {
    int32_t e, v[3];
};

enum {
    HM_TRI_BLOCK = 63,
    HM_TRI_LISTS = 8192 /* four for each power of two that the square of a length can be near */
};

struct hm_tri_worklist {
    struct block {
        struct hm_tri_work work[HM_TRI_BLOCK];
        int32_t next; /* in its list, or in that of free blocks */
    } * block;
    size_t n, cap;
    int32_t free;
    struct {
        int32_t head, tail; /* blocks; none: it is empty */
        int32_t first, end; /* first item in the head, behind the last one in the tail */
    } list[HM_TRI_LISTS];
    int lowest; /* no list below has items */
};

void hm_tri_worklist_init(struct hm_tri_worklist *w);
enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d);
bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work);

/* The work some places behind the one popped last, or NULL: to fetch it from memory in time. */
const struct hm_tri_work *hm_tri_worklist_soon(const struct hm_tri_worklist *w);

#endif
