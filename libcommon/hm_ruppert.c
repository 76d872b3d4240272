/* hm_ruppert: see hm_ruppert.h. */
#include "hm_ruppert.h"

struct sizes {
    const struct hm_domain *dom;
    double max_area;
};

static double bound(const struct sizes *s, int32_t region)
{
    double own = s->dom->zone[region - 1].max_area;
    return own > 0 ? own : s->max_area;
}

static double area_at(void *arg, double x, double y, int32_t region)
{
    (void)x;
    (void)y;
    return bound(arg, region);
}

/* Refuse what could only end when memory does: a node for each two triangles, which have two thirds
 * of their maximum area or less. */
static enum hm_err check_size(const struct sizes *s, struct hm_diag *d)
{
    const struct hm_domain *dom = s->dom;
    double nodes = 0;
    for (int32_t tri = 0; tri < hm_tri_triangles(dom->tri); tri++) {
        double area = hm_domain_area(dom, tri);
        double most = area > 0 ? bound(s, hm_tri_region(dom->tri, tri)) : 0;
        nodes += most > 0 ? 0.75 * area / most : 0;
    }
    if (nodes > (double)(INT32_MAX / 6))
        return hm_fail(d, HM_EARG, "the maximum area makes about %.2g nodes", nodes);
    return HM_OK;
}

enum hm_err hm_ruppert_reach(struct hm_domain *dom, const struct hm_ruppert_options *o,
                             struct hm_tri_refined *left, struct hm_diag *d)
{
    struct sizes sizes = {dom, o->max_area};
    const struct hm_tri_quality q = {.min_angle = o->min_angle,
                                     .area_at = area_at,
                                     .arg = &sizes,
                                     .whole = HM_EDGE_REGULAR,
                                     .outside = 0,
                                     .hull_marks = HM_EDGE_BORDER};
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (!err)
        err = check_size(&sizes, d);
    if (err)
        return err;
    int32_t first = hm_tri_vertices(dom->tri);
    err = hm_tri_refine(dom->tri, &q, left, d);
    return err ? err : hm_domain_adopt(dom, first, o->threads, d);
}
