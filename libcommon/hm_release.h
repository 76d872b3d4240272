/* hm_release: which lines no line that is still to come can meet. Layer 6.
 *
 * Lines that must not be made to cross are to be changed together. While lines come row by row that
 * would be all of them at the end; but a line may go as soon as neither an open line nor the rows
 * to come are near it, nor near a line near it, and so on. Near is what boxes around stretches of a
 * few vertices say.
 */
#ifndef HM_RELEASE_H
#define HM_RELEASE_H

#include "hm_boxtree.h"
#include "hm_line.h"

/* Move the settled lines of `held` to the end of `done`, in their order. `open` are the boxes of
 * all that may still come; every line, of both, may be moved by up to `reach`. */
enum hm_err hm_release(struct hm_lines *held, struct hm_lines *done, const struct hm_box *open,
                       size_t nopen, double reach, struct hm_diag *d);

#endif
