/* hm_grid: heights and other values at the nodes of a lattice. Layer 3.
 *
 * Begins life as `= {0}`, owns what its pointers hold, and is emptied by hm_grid_free.
 */
#ifndef HM_GRID_H
#define HM_GRID_H

#include "hm_header.h"

/* Band b of node (i, j) is v[(j*nx + i)*bands + b]; band 0 is z unless fields say otherwise; NaN is
 * nodata. */
struct hm_grid {
    struct hm_header header;
    double *v;
    size_t bands;
};

/* A grid of the lattice and fields of h, which is taken over; all nodata. */
enum hm_err hm_grid_init(struct hm_grid *g, struct hm_header *h, struct hm_diag *d);
void hm_grid_free(struct hm_grid *g);

#endif
