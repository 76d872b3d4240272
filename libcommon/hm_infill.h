/* hm_infill: the inner vertices of a part of a triangulation, changed until its triangles are well
 * shaped. Layer 6.
 *
 * Between two meshes whose borders may not change there is room for new nodes inside only.
 */
#ifndef HM_INFILL_H
#define HM_INFILL_H

#include "hm_tri.h"

/* Improve the triangles of a region, where an angle is under `angle` (degrees). Vertices that are
 * on no constraint, and all triangles around them of the region, are moved or taken out,
 * and others are put in, each time only when the smallest angle around gets larger by a degree at
 * least. Constraints stay as they are; what is good stays, too. */
enum hm_err hm_infill_improve(struct hm_tri *t, int32_t region, double angle, struct hm_diag *d);

#endif
