/* hm_smooth: Laplace smoothing of the free nodes. Layer 6. */
#ifndef HM_SMOOTH_H
#define HM_SMOOTH_H

#include "hm_domain.h"
#include "hm_lengths.h"

/* One pass: each free node moves to the mean of its neighbours, half way there or a quarter, or not
 * at all: when a triangle would turn over, or the smallest angle around get worse while it is under
 * `angle` (degrees), or an edge would leave the bounds of l or the node come nearer to a fixed edge
 * than the clearance. Moved nodes get the mean height and the flag HM_NODE_NEW. *n: nodes moved by
 * more than a thousandth of l->least. */
enum hm_err hm_smooth_pass(struct hm_domain *dom, const struct hm_lengths *l, double angle,
                           int threads, int64_t *n, struct hm_diag *d);

#endif
