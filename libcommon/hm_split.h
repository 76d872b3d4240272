/* hm_split: quadrilaterals cut into triangles, for those who have none. Layer 4. */
#ifndef HM_SPLIT_H
#define HM_SPLIT_H

#include "hm_mesh.h"

/* Cut every quadrilateral along its shorter diagonal (the one from its first corner when they are
 * equal), or along the only one that lies inside; the triangles take its place in the order and its
 * region. *count says how many. */
enum hm_err hm_split_quads(struct hm_mesh *m, int64_t *count, struct hm_diag *d);

#endif
