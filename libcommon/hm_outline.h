/* hm_outline: the outer sides of the gap between two meshes that are stitched. Layer 6.
 *
 * Where elements of the lower mesh were cut away, its old outline (the river bank) remains the
 * outline of the union, up to the higher mesh. Where it meets the higher mesh's border there is no
 * node, and none may be added; there it ends in the first node of that border inside the lower
 * mesh's footprint, so that the filled gap stays within the union of the footprints. Only a mouth
 * with fewer than two such nodes is widened to the nodes beside it.
 */
#ifndef HM_OUTLINE_H
#define HM_OUTLINE_H

#include "hm_border.h"
#include "hm_locate.h"

/* The two meshes. Where nodes of both are listed, number k of the lower mesh is written ~k.
 */
struct hm_seam_sides {
    const struct hm_border *higher;
    const struct hm_locate *in_higher;
    const struct hm_mesh *lower;
    const struct hm_locate *in_lower;
    const bool *gone;                /* of lower's elements: cut away */
    const struct hm_border *outline; /* of the whole lower mesh */
    const struct hm_border *rest;    /* of the elements kept: a mesh that has lower's nodes */
    const double *size; /* of lower's nodes: mean edge of the elements around, 0 without any */
    const bool *kept;   /* of lower's nodes: an element kept uses it */
};

/* Nodes nearer to the higher border than this times the larger of their size and the border's edge
 * are not used for the gap. */
#define HM_SEAM_CLEAR 0.4

struct hm_seam_segment {
    int32_t a, b; /* nodes of the higher mesh, or ~node of the lower */
};

struct hm_outline {
    struct hm_seam_segment *segment;
    size_t n, cap;
    int64_t widened; /* mouths narrower than two edges of the higher border */
};

static inline const double *hm_seam_xy(const struct hm_seam_sides *s, int32_t node)
{
    return node >= 0 ? hm_mesh_xy(s->higher->mesh, node) : hm_mesh_xy(s->lower, ~node);
}

/* HM_EGEOM where no way from the outline to the higher mesh can be found. */
enum hm_err hm_outline_make(struct hm_outline *o, const struct hm_seam_sides *sides,
                            struct hm_diag *d);
void hm_outline_free(struct hm_outline *o);

#endif
