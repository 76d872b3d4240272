/* hm_facefit: the border of a mesh that was cut by loops, moved onto these. Layer 6.
 *
 * Where whole elements go, a cut is a staircase. Its nodes move to the nearest place on the loop,
 * as far as the elements around stay in shape.
 */
#ifndef HM_FACEFIT_H
#define HM_FACEFIT_H

#include "hm_face.h"

struct hm_facefit {
    int64_t moved;   /* nodes of the cut that lie on a loop now */
    double furthest; /* the largest such move, m */
    int64_t off;     /* nodes of the cut that could not be moved all the way */
    int64_t filled;  /* triangles put into notches that remained */
};

/* Cut the mesh (hm_face_apply, by the centres of elements), and move the nodes of the cut; elements
 * with one that stays outside go too. Nodes of the border from before stay where they are inside
 * the loops. A node moves no further than an
 * edge, and only so far that no angle around it gets under 12 degrees or, if it is smaller, under
 * what it was. Heights are those of the mesh before the cut. */
enum hm_err hm_facefit_apply(struct hm_mesh *mesh, const struct hm_rough *surface,
                             const struct hm_face *faces, size_t n, struct hm_face_cut *cut,
                             struct hm_facefit *fit, struct hm_diag *d);

/* Fill the notches in the border of such a mesh: a triangle on two neighbouring edges, where it has
 * no angle under `least_angle` degrees, and its third edge lies inside the loops or hardly outside.
 */
enum hm_err hm_facefit_fill(struct hm_mesh *mesh, int32_t surface, const struct hm_face *faces,
                            size_t n, double least_angle, int64_t *filled, struct hm_diag *d);

#endif
