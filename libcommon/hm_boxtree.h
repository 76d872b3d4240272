/* hm_boxtree: which of many boxes meet a given one. Layer 2.
 *
 * A packed tree: the boxes in the order of a space-filling curve (hm_order), eight to a node, eight
 * nodes to the next. Unlike a bucket grid it does not mind elements of very different size.
 * Read-only once built: threads may share it.
 */
#ifndef HM_BOXTREE_H
#define HM_BOXTREE_H

#include "hm_base.h"

struct hm_boxtree;

struct hm_box {
    double lo[2], hi[2];
};

/* n <= INT32_MAX boxes of finite coordinates; they are copied. n = 0 is allowed. */
enum hm_err hm_boxtree_build(struct hm_boxtree **t, const struct hm_box *box, size_t n,
                             struct hm_diag *d);
void hm_boxtree_free(struct hm_boxtree *t);

/* All boxes that meet `box` (borders included), each once, in no particular order:
 *
 *     struct hm_boxquery q = hm_boxtree_find(t, box);
 *     for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;) …
 */
struct hm_boxquery {
    const struct hm_boxtree *tree;
    struct hm_box box;
    size_t level, at;
};
struct hm_boxquery hm_boxtree_find(const struct hm_boxtree *t, struct hm_box box);
int32_t hm_boxtree_next(struct hm_boxquery *q); /* -1 behind the last */

static inline struct hm_box hm_box_of(const double *a, const double *b)
{
    struct hm_box box;
    for (int k = 0; k < 2; k++) {
        box.lo[k] = a[k] < b[k] ? a[k] : b[k];
        box.hi[k] = a[k] < b[k] ? b[k] : a[k];
    }
    return box;
}

static inline void hm_box_add(struct hm_box *box, const double *p)
{
    for (int k = 0; k < 2; k++) {
        if (p[k] < box->lo[k])
            box->lo[k] = p[k];
        if (p[k] > box->hi[k])
            box->hi[k] = p[k];
    }
}

static inline bool hm_box_meets(const struct hm_box *a, const struct hm_box *b)
{
    return a->lo[0] <= b->hi[0] && b->lo[0] <= a->hi[0] && a->lo[1] <= b->hi[1] &&
           b->lo[1] <= a->hi[1];
}

/* The box grown by `reach` on every side. */
static inline struct hm_box hm_box_grown(struct hm_box box, double reach)
{
    for (int k = 0; k < 2; k++) {
        box.lo[k] -= reach;
        box.hi[k] += reach;
    }
    return box;
}

#endif
