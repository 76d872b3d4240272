/* hm_export: objects written in the formats of other programs. Layer 6.
 *
 * Blanks separate, never tabs; lines end with LF. Numbers are the shortest that read back exactly,
 * or rounded to `decimals` places (0: exact).
 */
#ifndef HM_EXPORT_H
#define HM_EXPORT_H

#include "hm_grid.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_writer.h"

/* SMS 2dm: MESH2D, MESHNAME, ND id x y z, E3T id a b c material, E4Q …; ids from 1. Keys `#string
 * name n n …` of the header become node strings (NS). The region is the material number; 2dm has no
 * material 0, so region 0 becomes the number behind the largest region, and a card at the end, MAT
 * number "region 0", says so to the reader. HM_EGEOM names a node without height. */
enum hm_err hm_export_2dm(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* ESRI ASCII grid of one band: north first, nodata -9999 (a longer row of nines when a height is
 * just that). HM_EARG when the cells are not square, or the grid has a single row or column. */
enum hm_err hm_export_asc(const struct hm_grid *g, size_t band, int decimals, struct hm_writer *w,
                          struct hm_diag *d);

/* A line "x y z" each; rows without z are left out and counted. */
enum hm_err hm_export_xyz(const double *rows, size_t n, size_t stride, int decimals,
                          int64_t *left_out, struct hm_writer *w, struct hm_diag *d);

/* GMT multisegment: "> attributes", a line "x y z" a vertex; the first vertex of a closed line is
 * repeated at its end. */
enum hm_err hm_export_gmt(const struct hm_line *line, int decimals, struct hm_writer *w,
                          struct hm_diag *d);

#endif
