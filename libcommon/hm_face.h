/* hm_face: a regular mesh cut out by closed loops, the paper's face technology (section 5.3).
 * Layer 6.
 *
 * Lines with `face=NAME`, closed, are loops round what stays of surface NAME; with `hole=1` besides
 * round what goes. A node is inside when it lies in some loop (or there is none) and in no hole;
 * the border of a loop counts as inside. Elements with any node outside are dropped.
 */
#ifndef HM_FACE_H
#define HM_FACE_H

#include "hm_mesh.h"
#include "hm_rough.h"

struct hm_face {
    struct hm_line loop; /* closed; its vertices are those of the line it was made from */
    int32_t surface;     /* number of the surface that it cuts */
    bool hole;
    double lo[2], hi[2]; /* box of the loop */
};

/* All face loops in n sets of lines; the sets must outlive them. *faces is malloc'd. HM_EGEOM with
 * the place when a loop is open, crosses itself or names no surface of the list. A line whose last
 * vertex repeats its first counts as closed. */
enum hm_err hm_face_collect(const struct hm_lines *sets, size_t n, const struct hm_rough *list,
                            size_t count, struct hm_face **faces, size_t *nfaces,
                            struct hm_diag *d);

struct hm_face_cut {
    int64_t dropped; /* elements outside */
    int64_t pinched; /* elements dropped besides, where the rest hung together in a node only */
};

/* Cut the mesh of a surface by its loops; unused nodes go. By the paper's rule elements go when any
 * node is outside; with `centre`, when their centre is. HM_EGEOM when nothing is left. */
enum hm_err hm_face_apply(struct hm_mesh *mesh, const struct hm_rough *surface,
                          const struct hm_face *faces, size_t nfaces, bool centre,
                          struct hm_face_cut *cut, struct hm_diag *d);

/* Keep only the elements marked, as a further cut: adds to *cut. */
enum hm_err hm_face_keep(struct hm_mesh *mesh, const bool *keep, struct hm_face_cut *cut,
                         struct hm_diag *d);

/* Is a place (x, y) inside what the loops leave of a surface, by its number? */
bool hm_face_is_inside(const double *xy, int32_t surface, const struct hm_face *faces, size_t n);

#endif
