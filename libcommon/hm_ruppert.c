/* hm_ruppert: see hm_ruppert.h. */
#include "hm_ruppert.h"

/* Refuse what could only end when memory does. */
static enum hm_err check_size(const struct hm_sizes *s, struct hm_diag *d)
{
    double nodes = hm_sizes_nodes(s);
    if (nodes > (double)(INT32_MAX / 6))
        return hm_fail(d, HM_EARG, "the maximum sizes make about %.2g nodes", nodes);
    return HM_OK;
}

enum hm_err hm_ruppert_reach(struct hm_domain *dom, const struct hm_ruppert_options *o,
                             struct hm_tri_refined *left, struct hm_diag *d)
{
    const struct hm_tri_quality q = {.min_angle = o->min_angle,
                                     .max_edge = o->sizes->max_edge,
                                     .area_at = hm_sizes_area,
                                     .arg = (void *)o->sizes,
                                     .growth = o->growth,
                                     .whole = HM_EDGE_REGULAR,
                                     .outside = 0,
                                     .hull_marks = HM_EDGE_BORDER};
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (!err)
        err = check_size(o->sizes, d);
    if (err)
        return err;
    int32_t first = hm_tri_vertices(dom->tri);
    err = hm_tri_refine(dom->tri, &q, left, d);
    return err ? err : hm_domain_adopt(dom, first, o->threads, d);
}
