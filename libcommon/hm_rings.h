/* hm_rings: which of many closed lines holds a point. Layer 4.
 *
 * As hm_polygon_side, exactly, but in time that hardly grows with the number of rings and of their
 * vertices. Read-only queries: threads may share it.
 */
#ifndef HM_RINGS_H
#define HM_RINGS_H

#include "hm_line.h"

struct hm_rings;

/* n closed lines of three vertices or more; what they hold is copied. n = 0 is allowed. */
enum hm_err hm_rings_build(struct hm_rings **r, const struct hm_line *ring, size_t n,
                           struct hm_diag *d);
void hm_rings_free(struct hm_rings *r);

/* The last of the rings with (x, y) inside or on it; -1 when there is none. */
int64_t hm_rings_find(const struct hm_rings *r, double x, double y);

#endif
