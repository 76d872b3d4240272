/* hm_ruppert: an irregular mesh with a minimum angle and a maximum size. Layer 6.
 *
 * Quality refinement of the domain (hm_tri_refine): breaklines, outlines and the borders of regions
 * may be split, boundaries of regular meshes never. The domain stays triangulated.
 */
#ifndef HM_RUPPERT_H
#define HM_RUPPERT_H

#include "hm_sizes.h"
#include "hm_tri_refine.h"

struct hm_ruppert_options {
    double min_angle; /* degrees; 0: any */
    double growth;    /* as that of hm_tri_quality; 0: any */
    const struct hm_sizes *sizes;
    int threads;
};

/* HM_EARG when a bound is out of range, or the mesh would have more nodes than can be. HM_EGEOM,
 * with the place, when lines so near to each other would make over a hundred times as many nodes as
 * the sizes want. */
enum hm_err hm_ruppert_reach(struct hm_domain *dom, const struct hm_ruppert_options *o,
                             struct hm_tri_refined *left, struct hm_diag *d);

#endif
