/* hm_tri_worklist: triangles to be refined, those with the shortest edges first. Layer 2.
 * Internal to hm_tri_refine.c.
 *
 * Lists of equal priority, four to a doubling of the length, first in first out: nearly sorted, at
 * the cost of a queue.
 */
#ifndef HM_TRI_WORKLIST_H
#define HM_TRI_WORKLIST_H

#include "hm_base.h"

/* A triangle by number and corners; it is gone when the number has others. */
struct hm_tri_work {
    int32_t tri, v[3];
    int64_t added; /* vertices when it was tried last; -1: never */
};

enum {
    HM_TRI_LISTS = 8704
}; /* four for each power of two that the square of a length can be near */

struct hm_tri_worklist {
    struct item {
        struct hm_tri_work work;
        int32_t next; /* in its list, or in that of free items */
    } * item;
    size_t n, cap;
    int32_t free;
    int32_t head[HM_TRI_LISTS], tail[HM_TRI_LISTS];
    int lowest; /* no list below has items */
};

void hm_tri_worklist_init(struct hm_tri_worklist *w);
enum hm_err hm_tri_worklist_push(struct hm_tri_worklist *w, struct hm_tri_work work, double length2,
                                 struct hm_diag *d);
bool hm_tri_worklist_pop(struct hm_tri_worklist *w, struct hm_tri_work *work);

#endif
