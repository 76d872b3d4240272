/* hm_mask: the nodes of a grid within closed lines. Layer 6. */
#ifndef HM_MASK_H
#define HM_MASK_H

#include "hm_data.h"

/* in[j * nx + i]: is node (i, j) of the lattice within an outline, and in no hole? Holes are the
 * lines with the attribute hole=1; without any outline all is within. Open lines are HM_EGEOM. A
 * node just on a line is on its right or upper side. */
enum hm_err hm_mask(bool *in, const struct hm_lattice *l, const struct hm_lines *lines,
                    struct hm_diag *d);

#endif
