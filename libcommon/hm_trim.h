/* hm_trim: the short ends of breaklines at outlines and crossings, and their spikes. Layer 6.
 *
 * Where a breakline meets an outline, a hole, a region or another breakline there is a node, as
 * near to the line's next vertex as chance will have it; and it may end just before an outline.
 * Both force tiny triangles. So vertices that are too near are left out: the line then runs
 * straight from the node to the vertex after, or ends sooner. Resampling makes a needle of the end
 * of a narrow tongue: its tip is left out, too.
 */
#ifndef HM_TRIM_H
#define HM_TRIM_H

#include "hm_domain.h"

/* Leave out vertices of breaklines nearer than `least` (m) to a node where their line meets
 * something, loose ends nearer than that to an outline or hole, and vertices at least so far from
 * both of their neighbours, which are nearer than that to each other. A vertex stays where the line
 * would meet anything without it. *n: how many went. The domain comes back triangulated. */
enum hm_err hm_trim_breaklines(struct hm_domain *dom, double least, int threads, int64_t *n,
                               struct hm_diag *d);

#endif
