/* Parts of hm_meshcheck. Layer 4. */
#ifndef HM_MESHCHECK_PRIVATE_H
#define HM_MESHCHECK_PRIVATE_H

#include "hm_meshcheck.h"

/* A quick way to know, from the boundary alone, that no elements overlap: *plain is true then. When
 * it is false they may or may not. For a mesh of convex counter-clockwise elements, without edges
 * that are used wrongly, nodes at one place, or loops that touch. */
enum hm_err hm_meshcheck_plain(const struct hm_mesh *m, const struct hm_mesh_edge *edge, size_t n,
                               bool *plain, struct hm_diag *d);

#endif
