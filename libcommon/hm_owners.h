/* hm_owners: who owns the nodes of several meshes. Layer 4. */
#ifndef HM_OWNERS_H
#define HM_OWNERS_H

#include "hm_data.h"

/* Bring the owner numbers of n meshes together: *owners (malloc'd) becomes the `#owners` value for
 * all of them, "" when there is none. Meshes whose lists agree, as those of one bsmesh, keep their
 * numbers; those of a mesh with another list move behind the names so far, in its nodes too. */
enum hm_err hm_owners_join(struct hm_mesh *mesh, size_t n, char **owners, struct hm_diag *d);

#endif
