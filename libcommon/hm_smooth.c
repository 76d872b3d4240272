/* hm_smooth: see hm_smooth.h. */
#include "hm_smooth.h"
#include "hm_pred.h"

#include <math.h>

struct smooth {
    struct hm_domain *dom;
    const struct hm_lengths *l;
    double floor; /* cosine of the angle that is good enough */
};

/* The node at a vertex, where it is by now: the triangulation knows only where it was. */
static struct hm_node *node_at(const struct smooth *s, int32_t v)
{
    return &s->dom->node[s->dom->node_of[v]];
}

static double cosine(const double *at, const double *a, const double *b)
{
    double u[2] = {a[0] - at[0], a[1] - at[1]}, v[2] = {b[0] - at[0], b[1] - at[1]};
    return (u[0] * v[0] + u[1] * v[1]) / (hypot(u[0], u[1]) * hypot(v[0], v[1]));
}

/* The largest cosine (of the smallest angle) in the triangle a, b, p. */
static double worst_cosine(const double *a, const double *b, const double *p)
{
    return fmax(cosine(a, b, p), fmax(cosine(b, p, a), cosine(p, a, b)));
}

/* Is the length of an edge still within the bounds, or no farther from them than it was? */
static bool length_is_good(const struct hm_lengths *l, double now2, double before2)
{
    return now2 >= fmin(before2, l->least * l->least) && now2 <= fmax(before2, l->most * l->most);
}

/* What a place for vertex v does to the triangles around it: the largest cosine; 2 when it is not
 * to be had at all. `before`: where the vertex is. */
static double rate(const struct smooth *s, int32_t v, const double *at, const double *before)
{
    const struct hm_tri *t = s->dom->tri;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    double worst = -1;
    do {
        int32_t opposite = hm_tri_next(e);
        const double *a = &node_at(s, hm_tri_dest(t, e))->x, *b = &node_at(s, hm_tri_apex(t, e))->x;
        if (hm_pred_orient(a, b, at) <= 0)
            return 2;
        struct hm_node now = {.x = at[0], .y = at[1]}, was = {.x = before[0], .y = before[1]};
        const struct hm_node *other = node_at(s, hm_tri_dest(t, e));
        if (!length_is_good(s->l, hm_node_distance2(other, &now), hm_node_distance2(other, &was)))
            return 2;
        if (hm_tri_marks(t, opposite)) {
            double height = hm_area2(a, b, at), old = hm_area2(a, b, before);
            if (height < fmin(old, s->l->clearance * hypot(b[0] - a[0], b[1] - a[1])))
                return 2;
        }
        worst = fmax(worst, worst_cosine(a, b, at));
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return worst;
}

static struct hm_node mean_of_neighbours(const struct smooth *s, int32_t v)
{
    const struct hm_tri *t = s->dom->tri;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    struct hm_node mean = {0};
    int n = 0;
    do {
        const struct hm_node *w = node_at(s, hm_tri_dest(t, e));
        mean.x += w->x;
        mean.y += w->y;
        mean.z += w->z;
        n++;
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    mean.x /= n;
    mean.y /= n;
    mean.z /= n;
    return mean;
}

/* Move one vertex; how far. */
static double relax(const struct smooth *s, int32_t v)
{
    struct hm_node *node = node_at(s, v);
    struct hm_node mean = mean_of_neighbours(s, v);
    const double before[2] = {node->x, node->y};
    double old = rate(s, v, before, before);
    for (double part = 1; part > 0.2; part /= 2) {
        double at[2] = {before[0] + part * (mean.x - before[0]),
                        before[1] + part * (mean.y - before[1])};
        if (rate(s, v, at, before) > fmax(old, s->floor))
            continue;
        node->x = at[0];
        node->y = at[1];
        node->z += part * (mean.z - node->z);
        node->flags |= HM_NODE_NEW;
        return hypot(at[0] - before[0], at[1] - before[1]);
    }
    return 0;
}

enum hm_err hm_smooth_pass(struct hm_domain *dom, const struct hm_lengths *l, double angle,
                           int threads, int64_t *n, struct hm_diag *d)
{
    const double degree = 3.14159265358979323846 / 180;
    struct smooth s = {dom, l, cos(angle * degree)};
    *n = 0;
    enum hm_err err = hm_domain_triangulate(dom, threads, d);
    if (err)
        return err;
    for (int32_t v = 0; v < hm_tri_vertices(dom->tri); v++)
        if (dom->node_of[v] >= 0 && !(node_at(&s, v)->flags & HM_NODE_FIXED))
            *n += relax(&s, v) > l->least / 1000;
    hm_domain_changed(dom);
    return HM_OK;
}
