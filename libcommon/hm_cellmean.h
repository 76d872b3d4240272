/* hm_cellmean: the mean height of the points in each cell of an anchored lattice. Layer 6.
 *
 * Memory is for the cells that hold points, in tiles, whatever the number of points; the extent
 * need not be known before. The cell of a node is one spacing wide, the node in the middle; a point
 * on a border between cells belongs to the upper or right one.
 */
#ifndef HM_CELLMEAN_H
#define HM_CELLMEAN_H

#include "hm_anchor.h"

struct hm_cellmean;

/* With `places` the mean places are kept, too. */
enum hm_err hm_cellmean_new(struct hm_cellmean **c, double spacing, bool places, struct hm_diag *d);
void hm_cellmean_free(struct hm_cellmean *c);

/* Add n points x, y, z with heights. HM_EGEOM when one is so far off that cells have no numbers
 * there. */
enum hm_err hm_cellmean_add(struct hm_cellmean *c, const double *xyz, size_t n, struct hm_diag *d);

/* Means of the nodes of `a`, row after row: z has a->nx * a->ny numbers, NaN where no point was. */
void hm_cellmean_get(const struct hm_cellmean *c, const struct hm_anchor *a, double *z);

/* Number of points in the cells of the nodes of `a`. */
void hm_cellmean_counts(const struct hm_cellmean *c, const struct hm_anchor *a, double *count);

/* The mean points themselves, x, y, z, of the cells of `a` that hold any, tile by tile as the tiles
 * were met. *xyz is malloc'd. Needs `places`. */
enum hm_err hm_cellmean_points(const struct hm_cellmean *c, const struct hm_anchor *a, double **xyz,
                               size_t *n, struct hm_diag *d);

#endif
