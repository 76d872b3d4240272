/* hm_ruppert: see hm_ruppert.h. */
#include "hm_ruppert.h"

#include <math.h>

/* About how many nodes the sizes make. Refuse what could only end when memory does. */
static enum hm_err check_size(const struct hm_sizes *s, double *nodes, struct hm_diag *d)
{
    *nodes = hm_sizes_nodes(s);
    if (*nodes > (double)(INT32_MAX / 6))
        return hm_fail(d, HM_EARG, "the maximum sizes make about %.2g nodes", *nodes);
    return HM_OK;
}

/* So many more than the sizes want come of lines or borders that nearly meet over a long way only:
 * a slip in the coordinates. */
static int64_t most_nodes(double wanted)
{
    return (int64_t)fmin(1e6 + 100 * wanted, INT32_MAX / 6);
}

/* Where the shortest edge is: between what nearly meets. */
static enum hm_err fail_near(const struct hm_domain *dom, int64_t most, struct hm_diag *d)
{
    const struct hm_tri *t = dom->tri;
    double least = INFINITY, x = 0, y = 0;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        if (!hm_domain_is_inside(dom, e / 3))
            continue;
        const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        if (length < least) {
            least = length;
            x = a[0];
            y = a[1];
        }
    }
    return hm_fail_at(d, HM_EGEOM, x, y,
                      "refinement ends nowhere: over %lld nodes, %.2g m apart at the least. Lines "
                      "or borders nearly meet",
                      (long long)most, least);
}

enum hm_err hm_ruppert_reach(struct hm_domain *dom, const struct hm_ruppert_options *o,
                             struct hm_tri_refined *left, struct hm_diag *d)
{
    struct hm_tri_quality q = {.min_angle = o->min_angle,
                               .max_area = o->sizes->max_area,
                               .max_edge = o->sizes->max_edge,
                               .arg = (void *)o->sizes,
                               .growth = o->growth,
                               .whole = HM_EDGE_REGULAR,
                               .outside = 0,
                               .hull_marks = HM_EDGE_BORDER};
    double wanted;
    if (!hm_sizes_are_equal(o->sizes)) {
        q.max_area = 0;
        q.area_at = hm_sizes_area;
    }
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (!err)
        err = check_size(o->sizes, &wanted, d);
    if (err)
        return err;
    int32_t first = hm_tri_vertices(dom->tri);
    q.most = most_nodes(wanted + (double)dom->nnodes);
    err = hm_tri_refine(dom->tri, &q, left, d);
    if (!err && left->capped)
        err = fail_near(dom, q.most, d);
    return err ? err : hm_domain_adopt(dom, first, d);
}
