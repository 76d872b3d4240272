/* hm_seam: filling the gap between two meshes with triangles. Layer 6.
 *
 * The gap is what the elements cut away from the lower mesh covered beyond the higher one. It is
 * filled by constrained Delaunay triangulation between the two borders, without a new node on
 * either. Where it is wide, and along its outer sides, nodes of the lower mesh that lost their
 * elements are used again. Inside they are moved, taken out, or others put in, where that makes
 * better angles (hm_infill), with the heights of the lower mesh's surface.
 */
#ifndef HM_SEAM_H
#define HM_SEAM_H

#include "hm_outline.h"

struct hm_seam_triangle {
    int32_t node[3]; /* counter-clockwise; a node of the higher mesh, or ~node of the lower, or
                        ~(nodes of the lower + k) for new node k */
    int32_t region;  /* of the lower mesh's element that was there */
    double angle;    /* the smallest, degrees */
};

struct hm_seam {
    struct hm_seam_triangle *triangle;
    size_t n, cap;
    struct hm_node *node; /* new, inside the gap, on the lower mesh's surface */
    size_t nnodes, node_cap;
    int64_t widened; /* mouths of the lower mesh, widened to nodes beside them */
};

/* Fill the gap that elements `gone` of the lower mesh leave. Each mesh is given by its border, with
 * the location in it. */
enum hm_err hm_seam_fill(struct hm_seam *seam, const struct hm_border *higher,
                         const struct hm_locate *in_higher, const struct hm_border *lower,
                         const struct hm_locate *in_lower, const bool *gone, struct hm_diag *d);
void hm_seam_free(struct hm_seam *seam);

#endif
