#include "hm_meshstat.h"

#include "hm_elem.h"
#include "hm_meshcheck.h"

#include <math.h>
#include <stdlib.h>

static void keep_least(struct hm_measure *m, struct hm_measure new)
{
    if (isnan(m->value) || new.value < m->value)
        *m = new;
}

static void keep_most(struct hm_measure *m, struct hm_measure new)
{
    if (isnan(m->value) || new.value > m->value)
        *m = new;
}

/* Put it into the list of the worst, smallest first; of equals the earlier element stays ahead. */
static void keep_worst(struct hm_meshstat *s, struct hm_measure new)
{
    size_t k = s->nworst;
    if (k == HM_MESHSTAT_WORST && !(new.value < s->worst[--k].value))
        return;
    for (; k > 0 && new.value < s->worst[k - 1].value; k--)
        s->worst[k] = s->worst[k - 1];
    s->worst[k] = new;
    if (s->nworst < HM_MESHSTAT_WORST)
        s->nworst++;
}

static void add_element(struct hm_meshstat *s, const struct hm_mesh *m, const struct hm_elem *e)
{
    double xy[4][2], x = 0, y = 0, least, most;
    int corners = hm_elem_xy(m, e, xy);
    for (int i = 0; i < corners; i++) {
        x += xy[i][0] / corners;
        y += xy[i][1] / corners;
    }
    double area = hm_elem_area(m, e), ratio = hm_elem_edge_ratio(m, e);
    hm_elem_angles(m, e, &least, &most);
    if (corners == 3)
        s->triangles++;
    else
        s->quads++;
    s->area += area;
    s->edge_ratio_mean += ratio;
    keep_least(&s->area_least, (struct hm_measure){area, x, y});
    keep_most(&s->area_most, (struct hm_measure){area, x, y});
    keep_least(&s->angle_least, (struct hm_measure){least, x, y});
    keep_most(&s->angle_most, (struct hm_measure){most, x, y});
    keep_most(&s->edge_ratio, (struct hm_measure){ratio, x, y});
    keep_worst(s, (struct hm_measure){least, x, y});
    for (int k = 0; k < 3; k++)
        s->below[k] += least < 10 * (k + 1);
    int bin = least > 0 ? (int)(least / 5) : 0;
    s->histogram[bin < HM_MESHSTAT_BINS ? bin : HM_MESHSTAT_BINS - 1]++;
}

static enum hm_err add_neighbours(struct hm_meshstat *s, const struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_mesh_edge *edge;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edge, &n, d);
    if (err)
        return err;
    for (size_t k = 0; k < n; k++) {
        if (edge[k].right < 0)
            continue;
        double a = fabs(hm_elem_area(m, &m->elem[edge[k].left]));
        double b = fabs(hm_elem_area(m, &m->elem[edge[k].right]));
        double ratio = fmax(a, b) / fmin(a, b);
        const struct hm_node *p = &m->node[edge[k].a], *q = &m->node[edge[k].b];
        s->neighbours++;
        s->jumps += ratio > 2;
        keep_most(&s->area_ratio, (struct hm_measure){ratio, (p->x + q->x) / 2, (p->y + q->y) / 2});
    }
    free(edge);
    return HM_OK;
}

enum hm_err hm_meshstat_run(const struct hm_mesh *m, struct hm_meshstat *s, struct hm_diag *d)
{
    const struct hm_measure none = {NAN, NAN, NAN};
    *s = (struct hm_meshstat){.nodes = m->nnodes,
                              .area_least = none,
                              .area_most = none,
                              .angle_least = none,
                              .angle_most = none,
                              .edge_ratio = none,
                              .area_ratio = none};
    for (size_t k = 0; k < m->nelems; k++)
        add_element(s, m, &m->elem[k]);
    s->edge_ratio_mean /= (double)m->nelems;
    return add_neighbours(s, m, d);
}

double hm_meshstat_percent(const struct hm_meshstat *s, int64_t count)
{
    size_t n = s->triangles + s->quads;
    return n ? 100 * (double)count / (double)n : NAN;
}
