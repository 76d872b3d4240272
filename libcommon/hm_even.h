/* hm_even: elements beside each other of like areas. Layer 6.
 *
 * Refinement to a minimum angle leaves a few elements more than twice as large as a neighbour, and
 * at regular meshes some that are sharp. Here the free nodes around such a pair move, and where
 * that does not help new ones come. Elements of regular meshes count as neighbours. What fixed
 * nodes force stays.
 */
#ifndef HM_EVEN_H
#define HM_EVEN_H

#include "hm_sizes.h"

struct hm_even_options {
    double ratio;                 /* an element has at most so many times the area of another */
    double min_angle;             /* degrees: no angle gets smaller than this, or than it was */
    const struct hm_sizes *sizes; /* no element gets larger than this, or than it was */
    int threads;
};

struct hm_even_left {
    int64_t pairs, regular; /* still over the ratio; of these, at regular meshes */
    double worst, x, y;     /* the largest ratio, and the middle of the edge between */
};

/* The domain comes back triangulated; nodes that moved or are new are HM_NODE_NEW. */
enum hm_err hm_even_reach(struct hm_domain *dom, const struct hm_even_options *o,
                          struct hm_even_left *left, struct hm_diag *d);

#endif
