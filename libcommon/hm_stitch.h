/* hm_stitch: a regular mesh stitched to what is there. Layer 6.
 *
 * The paper's 5.2, in order of priority: what is there stays as it is; the new mesh gives way.
 */
#ifndef HM_STITCH_H
#define HM_STITCH_H

#include "hm_join.h"
#include "hm_terrain.h"

/* A triangle in the gap with an angle under HM_STITCH_POOR degrees. */
#define HM_STITCH_POOR 15.0
struct hm_stitch_poor {
    double angle, centre[2];
};

struct hm_stitched {
    int64_t overlapping, near, loose; /* elements cut away: hm_cut */
    int64_t kept, filled;             /* elements of the mesh that stay; triangles in the gap */
    int64_t reused, fresh; /* nodes of elements cut away that the gap uses, and new ones */
    int64_t widened;       /* mouths wider than the mesh: hm_outline */
    struct hm_joined joined;
    struct hm_stitch_poor *poor; /* malloc'd: free with hm_stitched_free */
    size_t npoor, poor_cap;
};
void hm_stitched_free(struct hm_stitched *stitched);

/* Add `lower`; both meshes must be without fault but for pieces, loops that touch and spare nodes
 * (hm_meshcheck). Where it overlaps or touches what is there it is cut back by the buffer (metres;
 * negative: suited to the elements, hm_cut), and the gap is filled. A mesh that lies beside what is
 * there, with nodes in common, is joined by them, and one apart is added as it is. Nodes inside the
 * gap take their height from the terrain (may be NULL) where it knows one, else from `lower`.
 * map gets the new number of each node of `lower`, or -1. */
enum hm_err hm_stitch_regular(struct hm_join *j, const struct hm_mesh *lower, double buffer,
                              const struct hm_terrain *terrain, int32_t *map,
                              struct hm_stitched *stitched, struct hm_diag *d);

#endif
