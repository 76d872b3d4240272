/* hm_locate: which element of a mesh holds a point. Layer 4.
 *
 * Meshes of triangles and convex quadrilaterals, of any number of pieces, with holes; also invalid
 * ones (overlaps: the lowest element number wins). Read-only queries: threads may share an index.
 * The height there is hm_elem_height.
 */
#ifndef HM_LOCATE_H
#define HM_LOCATE_H

#include "hm_elem.h"

struct hm_locate;

/* The mesh must outlive the index. */
enum hm_err hm_locate_build(struct hm_locate **x, const struct hm_mesh *mesh, struct hm_diag *d);
void hm_locate_free(struct hm_locate *x);

/* The element with (px, py) inside or on its border (exactly), or -1. */
int64_t hm_locate_element(const struct hm_locate *x, double px, double py);

/* The elements' boxes, for other queries; belongs to the index. */
const struct hm_boxtree *hm_locate_boxes(const struct hm_locate *x);

#endif
