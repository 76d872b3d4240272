/* hm_lineedit: changes of one line in its own memory. Layer 6. */
#ifndef HM_LINEEDIT_H
#define HM_LINEEDIT_H

#include "hm_line.h"

/* Take out vertices at the same x, y as the one before. A closed line with fewer than three
 * vertices left becomes an open one. */
void hm_lineedit_tidy(struct hm_line *line);

/* Smooth in rounds: each vertex moves to the mean of itself (½) and its neighbours (¼ each), but
 * never further than `most` (metres) from where it was at first; so does z, without limit. The ends
 * of an open line stay. */
enum hm_err hm_lineedit_smooth(struct hm_line *line, double most, struct hm_diag *d);

#endif
