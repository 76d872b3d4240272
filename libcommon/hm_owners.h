/* hm_owners: the numbers of regular meshes, as nodes carry them, over several meshes. Layer 4.
 *
 * A mesh's header says `#owners main tributary`: owner 1 of a node means main, 2 tributary, 0 none.
 */
#ifndef HM_OWNERS_H
#define HM_OWNERS_H

#include "hm_mesh.h"

/* Number the owners of n meshes anew, so that they agree, in the order in which the meshes come;
 * *owners (malloc'd) becomes the `#owners` value for all of them, "" when there is none. The same
 * name is the same owner. An owner without a name in its header is called as its mesh, and a mesh
 * of role regular whose nodes have no owner gets one for all. HM_EFORMAT for a negative owner. */
enum hm_err hm_owners_join(struct hm_mesh *mesh, size_t n, char **owners, struct hm_diag *d);

#endif
