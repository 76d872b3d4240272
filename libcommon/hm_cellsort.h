/* hm_cellsort: points in the cells of an anchored lattice. Layer 6.
 *
 * The cell of a node is one spacing wide, the node in the middle; a point on a border between cells
 * belongs to the upper or right one.
 */
#ifndef HM_CELLSORT_H
#define HM_CELLSORT_H

#include "hm_anchor.h"

struct hm_cellsort {
    size_t nx, ny;
    size_t *start; /* nx * ny + 1: the items of cell (i, j) begin at start[j * nx + i] */
    size_t *item;  /* numbers of points, ascending in each cell; those outside are in none */
};

/* Sort n points x, y, z. On failure there is nothing to free. */
enum hm_err hm_cellsort_make(struct hm_cellsort *c, const struct hm_anchor *a, const double *xyz,
                             size_t n, struct hm_diag *d);
void hm_cellsort_free(struct hm_cellsort *c);

/* The cell of a point: column and row; false when it is outside. */
bool hm_cellsort_cell(const struct hm_anchor *a, const double *xy, size_t *i, size_t *j);

/* Median heights: z has nx * ny numbers, NaN where no point is; of an even number the mean of the
 * two in the middle. */
enum hm_err hm_cellsort_medians(const struct hm_cellsort *c, const double *xyz, double *z,
                                struct hm_diag *d);

/* The median of v[n], n > 0, which changes order. */
double hm_cellsort_median(double *v, size_t n);

#endif
