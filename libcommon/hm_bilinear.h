/* hm_bilinear: the value of a grid between its nodes. Layer 4. */
#ifndef HM_BILINEAR_H
#define HM_BILINEAR_H

#include "hm_grid.h"

/* Of a band at x, y: bilinear in the cell that holds it; NaN outside and beside nodata. On a line
 * of nodes only those on it count. */
double hm_bilinear(const struct hm_grid *g, size_t band, double x, double y);

#endif
