/* hm_settle: see hm_settle.h. */
#include "hm_settle.h"

#include "hm_buckets.h"
#include "hm_pred.h"
#include "hm_star.h"

#include <math.h>
#include <stdlib.h>

/* An angle that is good enough, degrees. */
#define GOOD_ANGLE 30

/* The shortest way worth going, as part of the shortest edge. */
#define LEAST_WAY 0.01

struct settle {
    struct hm_domain *dom;
    struct hm_tri *t;
    const struct hm_settle_options *o;
    struct hm_diag *d;
    struct hm_star_rules rules;
    struct hm_buckets bucket;
    bool *stirred; /* by vertex: something around it has changed since it was looked at */
    int32_t hint;
};

static struct hm_node *node_at(const struct settle *w, int32_t v)
{
    return &w->dom->node[w->dom->node_of[v]];
}

static bool is_free(const struct settle *w, int32_t v)
{
    return w->dom->node_of[v] >= 0 && !(node_at(w, v)->flags & HM_NODE_FIXED);
}

/* --- how far the measurements are --- */

/* The plane of a triangle with its vertex at p: height z + dzdx (x - p.x) + dzdy (y - p.y). */
struct plane {
    double dzdx, dzdy;
};

static struct plane plane_of(const double *p, const struct hm_node *a, const struct hm_node *b)
{
    double ux = a->x - p[0], uy = a->y - p[1], uz = a->z - p[2];
    double wx = b->x - p[0], wy = b->y - p[1], wz = b->z - p[2], det = ux * wy - uy * wx;
    return (struct plane){(uz * wy - wz * uy) / det, (wz * ux - uz * wx) / det};
}

/* How far measurements are from the mesh. */
struct misfit {
    double worst, squares;
};

/* Of those in the star that the buckets looked at, with its vertex at p (x, y, z); moved: it is
 * elsewhere, so they may be in other triangles. */
static struct misfit measure(const struct settle *w, const double *p, bool moved)
{
    const struct hm_buckets *b = &w->bucket;
    struct plane plane[HM_STAR_MOST];
    struct misfit is = {0, 0};
    for (size_t k = 0; k < b->n_star; k++)
        plane[k] = plane_of(p, node_at(w, hm_tri_dest(w->t, b->star[k])),
                            node_at(w, hm_tri_apex(w->t, b->star[k])));
    for (size_t k = 0; k < b->n_star; k++)
        for (int32_t c = b->first[b->star[k] / 3]; c != HM_NOBODY; c = b->next[c]) {
            const double *m = hm_buckets_at(b, c);
            const struct plane *in = &plane[moved ? hm_buckets_sector(b, p, m) : k];
            double off = m[2] - p[2] - in->dzdx * (m[0] - p[0]) - in->dzdy * (m[1] - p[1]);
            is.worst = fabs(off) > is.worst ? fabs(off) : is.worst;
            is.squares += off * off;
        }
    return is;
}

/* --- one node --- */

/* Would an edge of the star flip with its vertex at p? */
static bool would_flip(const struct settle *w, const double *p)
{
    const struct hm_buckets *b = &w->bucket;
    for (size_t k = 0; k < b->n_star; k++) {
        int32_t e = b->star[k], far = hm_tri_next(e);
        const double *from = hm_tri_xy(w->t, hm_tri_dest(w->t, e));
        const double *to = hm_tri_xy(w->t, hm_tri_apex(w->t, e));
        const double *after = hm_tri_xy(w->t, hm_tri_apex(w->t, b->star[(k + 1) % b->n_star]));
        int32_t beyond = hm_tri_apex(w->t, hm_tri_twin(w->t, far));
        if (hm_pred_incircle_unique(p, from, to, after) > 0 ||
            (!hm_tri_marks(w->t, far) && beyond != HM_TRI_INFINITY &&
             hm_pred_incircle_unique(p, from, to, hm_tri_xy(w->t, beyond)) > 0))
            return true;
    }
    return false;
}

static void mean_of_neighbours(const struct settle *w, double mean[2])
{
    const struct hm_buckets *b = &w->bucket;
    mean[0] = mean[1] = 0;
    for (size_t k = 0; k < b->n_star; k++)
        for (int i = 0; i < 2; i++)
            mean[i] += hm_tri_xy(w->t, hm_tri_dest(w->t, b->star[k]))[i] / (double)b->n_star;
}

static bool is_near_corner(const struct settle *w, const struct hm_star *s, const double *p)
{
    double least = fmin(w->o->least, s->shortest);
    for (int k = 0; k < s->n; k++)
        if (hm_star_length2(p, s->corner[k]) < least * least)
            return true;
    return false;
}

/* May the vertex of the star be at p? */
static bool is_better(const struct settle *w, const struct hm_star *s, const double *p,
                      double before, const struct misfit *was)
{
    double now = hm_star_rate(&w->rules, s, p);
    if (!isfinite(now) || now > before || is_near_corner(w, s, p) || would_flip(w, p))
        return false;
    struct misfit is = measure(w, p, true);
    return is.worst <= fmax(was->worst, w->o->bound) && is.squares <= was->squares;
}

/* The vertex of the star has moved. */
static void stir(struct settle *w, int32_t v)
{
    for (size_t k = 0; k < w->bucket.n_star; k++) {
        int32_t u = hm_tri_dest(w->t, w->bucket.star[k]);
        w->stirred[u] = is_free(w, u);
    }
    w->stirred[v] = true;
}

static enum hm_err settle_vertex(struct settle *w, int32_t v, int64_t *moved)
{
    struct hm_star s;
    struct hm_node *node = node_at(w, v);
    enum hm_err err = hm_buckets_look(&w->bucket, v, w->d);
    if (err || !hm_star_look(&w->rules, v, &s))
        return err;
    double mean[2], before = hm_star_rate(&w->rules, &s, &node->x);
    mean_of_neighbours(w, mean);
    w->stirred[v] = false;
    double way[2] = {mean[0] - node->x, mean[1] - node->y};
    if (hypot(way[0], way[1]) < LEAST_WAY * s.shortest)
        return HM_OK;
    struct misfit was = measure(w, &node->x, false);
    for (double part = 1; part > 0.2; part /= 2) {
        double p[3] = {node->x + part * way[0], node->y + part * way[1], 0};
        p[2] = hm_terrain_z_nearest(w->o->terrain, p[0], p[1], &w->hint);
        if (!is_better(w, &s, p, before, &was))
            continue;
        err = hm_tri_move(w->t, v, p[0], p[1], w->d);
        if (err)
            return err;
        node->x = p[0];
        node->y = p[1];
        node->z = p[2];
        hm_buckets_deal(&w->bucket, p, HM_NOBODY);
        stir(w, v);
        ++*moved;
        return HM_OK;
    }
    return HM_OK;
}

/* --- all of them --- */

static enum hm_err go(struct settle *w, int64_t *moved)
{
    enum hm_err err = HM_OK;
    int32_t vertices = hm_tri_vertices(w->t);
    w->stirred = hm_alloc((size_t)vertices, sizeof *w->stirred);
    if (!w->stirred)
        return hm_fail_memory(w->d);
    for (int32_t v = 0; v < vertices; v++)
        w->stirred[v] = is_free(w, v);
    for (int pass = 0; !err && pass < w->o->passes; pass++) {
        int64_t before = *moved;
        for (int32_t v = 0; !err && v < vertices; v++)
            if (w->stirred[v])
                err = settle_vertex(w, v, moved);
        if (*moved == before)
            break;
    }
    return err;
}

enum hm_err hm_settle_reach(struct hm_domain *dom, const struct hm_settle_options *o,
                            int64_t *moved, struct hm_diag *d)
{
    *moved = 0;
    hm_domain_changed(dom); /* in spatial order again, whatever was inserted: near places are asked
                             * for one after the other */
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (err)
        return err;
    struct settle w = {.dom = dom, .t = dom->tri, .o = o, .d = d};
    err = hm_star_open(&w.rules, dom, o->ratio, GOOD_ANGLE, o->sizes, d);
    if (!err)
        err = hm_buckets_fill(&w.bucket, dom, o->xyz, o->n, o->threads, d);
    if (!err)
        err = go(&w, moved);
    hm_star_close(&w.rules);
    hm_buckets_free(&w.bucket);
    free(w.stirred);
    if (err)
        hm_domain_changed(dom);
    return err;
}
