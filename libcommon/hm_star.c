/* hm_star: see hm_star.h. */
#include "hm_star.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

/* What makes a pair bad enough to be worked at, as part of the ratio: what is moved later may take
 * a little of it again. */
#define AIM 0.97

/* What the square of the cosine of an angle beyond the minimum counts, beside squares of logarithms
 * of ratios. */
#define SHARP 10

/* --- areas --- */

static int by_ends(const void *pa, const void *pb)
{
    const struct hm_star_side *a = pa, *b = pb;
    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return (a->b > b->b) - (a->b < b->b);
}

static enum hm_err list_sides(struct hm_star_rules *rules, struct hm_diag *d)
{
    const struct hm_domain *dom = rules->dom;
    rules->side = hm_alloc(dom->nedges, sizeof *rules->side);
    if (!rules->side)
        return hm_fail_memory(d);
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_domain_edge *edge = &dom->edge[k];
        int32_t a = dom->vertex_of[edge->a], b = dom->vertex_of[edge->b];
        if (edge->beside > 0)
            rules->side[rules->n_sides++] =
                (struct hm_star_side){a < b ? a : b, a < b ? b : a, edge->beside};
    }
    qsort(rules->side, rules->n_sides, sizeof *rules->side, by_ends);
    return HM_OK;
}

double hm_star_area(const struct hm_star_rules *rules, int32_t e)
{
    if (hm_domain_is_inside(rules->dom, e / 3))
        return hm_domain_area(rules->dom, e / 3);
    int32_t a = hm_tri_org(rules->dom->tri, e), b = hm_tri_dest(rules->dom->tri, e);
    const struct hm_star_side key = {a < b ? a : b, a < b ? b : a, 0};
    const struct hm_star_side *side =
        bsearch(&key, rules->side, rules->n_sides, sizeof key, by_ends);
    return side ? side->area : 0;
}

/* How much worse than wanted a pair of elements is; one alone never. */
static double excess(const struct hm_star_rules *rules, double one, double other)
{
    double ratio = fmax(one, other) / (fmin(one, other) * AIM * rules->ratio);
    return fmin(one, other) > 0 && ratio > 1 ? log(ratio) * log(ratio) : 0;
}

double hm_star_sharpest(const double *a, const double *b, const double *c)
{
    double l[3] = {hm_star_length2(a, b), hm_star_length2(b, c), hm_star_length2(c, a)};
    double least = fmin(l[0], fmin(l[1], l[2])), dot = (l[0] + l[1] + l[2]) / 2 - least;
    return dot * dot * least / (l[0] * l[1] * l[2]);
}

/* How much sharper than wanted a triangle is, on the scale of excess(). */
static double sharpness(const struct hm_star_rules *rules, const double *a, const double *b,
                        const double *c)
{
    double beyond = SHARP * fmax(hm_star_sharpest(a, b, c) - rules->cos2, 0);
    return beyond * beyond;
}

static double sharpness_left(const struct hm_star_rules *rules, int32_t e)
{
    const struct hm_tri *t = rules->dom->tri;
    return !hm_domain_is_inside(rules->dom, e / 3)
               ? 0
               : sharpness(rules, hm_tri_xy(t, hm_tri_org(t, e)), hm_tri_xy(t, hm_tri_dest(t, e)),
                           hm_tri_xy(t, hm_tri_apex(t, e)));
}

double hm_star_excess(const struct hm_star_rules *rules, int32_t e)
{
    int32_t twin = hm_tri_twin(rules->dom->tri, e);
    return excess(rules, hm_star_area(rules, e), hm_star_area(rules, twin)) +
           sharpness_left(rules, e) + sharpness_left(rules, twin);
}

/* The edge from v to its lowest neighbour: where to begin, whatever the triangles' numbers. */
static int32_t first_edge(const struct hm_tri *t, int32_t v)
{
    int32_t first = hm_tri_edge_from(t, v), e = first, best = first;
    do {
        if (hm_tri_dest(t, e) < hm_tri_dest(t, best))
            best = e;
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return best;
}

bool hm_star_look(const struct hm_star_rules *rules, int32_t v, struct hm_star *s)
{
    const struct hm_tri *t = rules->dom->tri;
    const struct hm_sizes *sizes = rules->sizes;
    int32_t first = first_edge(t, v), e = first;
    const double *at = hm_tri_xy(t, v);
    *s = (struct hm_star){.worst = rules->cos2, .shortest = INFINITY};
    s->longest = sizes->max_edge > 0 ? sizes->max_edge * sizes->max_edge : INFINITY;
    do {
        if (s->n == HM_STAR_MOST)
            return false;
        const double *a = hm_tri_xy(t, hm_tri_dest(t, e)), *b = hm_tri_xy(t, hm_tri_apex(t, e));
        double area = hm_area2(a, b, at) / 2, most; /* as hm_star_rate has them, to the last bit */
        most = hm_sizes_area((void *)sizes, (at[0] + a[0] + b[0]) / 3, (at[1] + a[1] + b[1]) / 3,
                             hm_tri_region(t, e / 3));
        s->corner[s->n] = a;
        s->most[s->n] = most > 0 ? fmax(most, area) : INFINITY;
        s->beyond[s->n++] = hm_star_area(rules, hm_tri_twin(t, hm_tri_next(e)));
        s->largest = fmax(s->largest, area);
        s->longest = fmax(s->longest, hm_star_length2(at, a));
        s->worst = fmax(s->worst, hm_star_sharpest(a, b, at));
        s->shortest = fmin(s->shortest, hm_star_length2(at, a));
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    s->corner[s->n] = s->corner[0];
    s->shortest = sqrt(s->shortest);
    return true;
}

double hm_star_rate(const struct hm_star_rules *rules, const struct hm_star *s, const double *p)
{
    double sum = 0, first = 0, last = 0;
    for (int k = 0; k < s->n; k++) {
        const double *a = s->corner[k], *b = s->corner[k + 1];
        double area = hm_area2(a, b, p) / 2;
        if (hm_pred_orient(a, b, p) <= 0 || area > s->most[k] ||
            hm_star_length2(a, p) > s->longest || hm_star_sharpest(a, b, p) > s->worst)
            return INFINITY;
        sum += excess(rules, area, s->beyond[k]) + sharpness(rules, a, b, p);
        if (k == 0)
            first = area;
        else
            sum += excess(rules, area, last);
        last = area;
    }
    return sum + excess(rules, first, last);
}

enum hm_err hm_star_open(struct hm_star_rules *rules, const struct hm_domain *dom, double ratio,
                         double min_angle, const struct hm_sizes *sizes, struct hm_diag *d)
{
    double cosine = cos(min_angle * acos(-1) / 180);
    *rules = (struct hm_star_rules){
        .dom = dom, .ratio = ratio > 0 ? ratio : INFINITY, .cos2 = cosine * cosine, .sizes = sizes};
    return list_sides(rules, d);
}

void hm_star_close(struct hm_star_rules *rules)
{
    free(rules->side);
}
