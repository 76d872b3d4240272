/* hm_gapfill: heights for the nodes of a grid that got no measurement. Layer 1. */
#ifndef HM_GAPFILL_H
#define HM_GAPFILL_H

#include "hm_base.h"

/* Fill NaN nodes of z (ny rows of nx) that lie between nodes with data: linearly along the row, the
 * column and both diagonals, as far as these have data on either side that are at most `gap` cells
 * apart; the nearer pair weighs more. Exact on planes. Nodes beside the data stay NaN, as do those
 * in wider gaps. */
enum hm_err hm_gapfill(double *z, size_t nx, size_t ny, double gap, int threads, struct hm_diag *d);

#endif
