/* hm_cut: which elements of a mesh make room for another mesh. Layer 6.
 *
 * The paper's overlapping surfaces (5.2): of two regular meshes the one of lower priority loses the
 * elements that overlap the higher one or come nearer to it than a buffer.
 */
#ifndef HM_CUT_H
#define HM_CUT_H

#include "hm_border.h"
#include "hm_locate.h"

/* How near is near. A buffer of its own for every element and every edge of the higher mesh's
 * border: HM_CUT_REACH times the larger of the element's mean edge and that edge, so that the gap
 * suits triangles between both. */
#define HM_CUT_REACH 0.4

struct hm_cut {
    bool *gone;          /* of each element of the lower mesh */
    int64_t overlapping; /* elements that overlap the higher mesh, */
    int64_t near;        /* that come too near, and not over ground beyond both meshes, */
    int64_t loose;       /* or that would be left hanging by a node or a single edge */
    bool meets;          /* the meshes overlap, or touch (within 1e-6 of an element's edge) */
};

/* higher: the border of the higher mesh, and the location in it; lower: a mesh, and the location in
 * it. buffer: metres, or negative for the rule above. */
enum hm_err hm_cut_mark(struct hm_cut *cut, const struct hm_border *higher,
                        const struct hm_locate *in_higher, const struct hm_mesh *lower,
                        const struct hm_locate *in_lower, double buffer, struct hm_diag *d);
/* Where the gap cannot be filled at (x, y), cut more: all elements with a node not further from
 * there than the nearest one of those that stay, and `edges` of its element's edges. They count as
 * loose. HM_EGEOM when nothing is left to cut. */
enum hm_err hm_cut_more(struct hm_cut *cut, const struct hm_mesh *lower, double x, double y,
                        int edges, struct hm_diag *d);
/* Cut all elements at the nodes marked; they count as near. *more: how many. */
enum hm_err hm_cut_around(struct hm_cut *cut, const struct hm_mesh *lower, const bool *node,
                          int64_t *more, struct hm_diag *d);
void hm_cut_free(struct hm_cut *cut);

#endif
