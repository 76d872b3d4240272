/* hm_outline: the outer sides of the gap between two meshes that are stitched. Layer 6.
 *
 * Where elements of the lower mesh were cut away, its old outline (the river bank) remains the
 * outline of the union, up to the higher mesh. Where it meets the higher mesh's border there is no
 * node, and none may be added; there it ends in the nearest node of that border. A mouth narrower
 * than two of its edges is widened to the nodes beside it. A piece that hardly looks out of the
 * higher mesh is left out.
 */
#ifndef HM_OUTLINE_H
#define HM_OUTLINE_H

#include "hm_sides.h"

struct hm_outline_segment {
    int32_t a, b; /* nodes of the higher mesh, or ~node of the lower */
};

struct hm_outline {
    struct hm_outline_segment *segment;
    size_t n, cap;
    int64_t widened; /* mouths narrower than two edges of the higher border */
};

/* HM_EGEOM where no way from the outline to the higher mesh can be found. */
enum hm_err hm_outline_make(struct hm_outline *o, const struct hm_sides *sides, struct hm_diag *d);
void hm_outline_free(struct hm_outline *o);

#endif
