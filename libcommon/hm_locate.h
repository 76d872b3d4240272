/* hm_locate: which element of a mesh holds a point, and the mesh's height there. Layer 4.
 *
 * Meshes of triangles and convex quadrilaterals, of any number of pieces, with holes; also invalid
 * ones (overlaps: the lowest element number wins). Read-only queries: threads may share an index.
 */
#ifndef HM_LOCATE_H
#define HM_LOCATE_H

#include "hm_data.h"

struct hm_locate;

/* The mesh must outlive the index. */
enum hm_err hm_locate_build(struct hm_locate **x, const struct hm_mesh *mesh, struct hm_diag *d);
void hm_locate_free(struct hm_locate *x);

/* The element with (px, py) inside or on its border (exactly), or -1. */
int64_t hm_locate_element(const struct hm_locate *x, double px, double py);

/* Height of an element at (px, py): linear in triangles, bilinear (isoparametric) in
 * quadrilaterals. */
double hm_elem_height(const struct hm_mesh *mesh, const struct hm_elem *e, double px, double py);

#endif
