/* hm_sides: two meshes on either side of a gap that is to be filled. Layer 6.
 *
 * The higher one stays as it is; of the lower one elements are cut away to make room. Where nodes
 * of both are listed, number k of the lower mesh is written ~k.
 */
#ifndef HM_SIDES_H
#define HM_SIDES_H

#include "hm_border.h"
#include "hm_locate.h"

struct hm_sides {
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
#define HM_SIDES_CLEAR 0.25

static inline const double *hm_sides_xy(const struct hm_sides *s, int32_t node)
{
    return node >= 0 ? hm_mesh_xy(s->higher->mesh, node) : hm_mesh_xy(s->lower, ~node);
}

#endif
