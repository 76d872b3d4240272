/* hm_paper: the paper's way to an irregular mesh. Layer 6.
 *
 * Coarsening and refinement take turns until no free edge is under the minimum and none over the
 * maximum, or nothing more can be done about it; then the free nodes are smoothed.
 */
#ifndef HM_PAPER_H
#define HM_PAPER_H

#include "hm_domain.h"
#include "hm_lengths.h"

/* Called after every round that changed something, with the domain triangulated: for those who want
 * to watch. A failure ends all. */
typedef enum hm_err (*hm_paper_watch)(void *arg, const struct hm_domain *dom, const char *what,
                                      struct hm_diag *d);

struct hm_paper_options {
    struct hm_lengths bounds;
    int smooth; /* passes */
    int threads;
    hm_paper_watch watch; /* or NULL */
    void *arg;
};

/* What could not be reached: edges that are not fixed themselves. */
struct hm_paper_left {
    int64_t rounds;
    int64_t too_short, too_short_fixed; /* under the minimum; of these with two fixed ends */
    int64_t too_long, too_long_regular; /* over the maximum; at long edges of regular meshes */
    int64_t fixed_short, fixed_long;    /* fixed edges out of bounds */
};

/* HM_EARG when the bounds make no sense, or the mesh would have more nodes than can be. */
enum hm_err hm_paper_reach(struct hm_domain *dom, const struct hm_paper_options *o,
                           struct hm_paper_left *left, struct hm_diag *d);

#endif
