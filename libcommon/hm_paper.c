/* hm_paper: see hm_paper.h. */
#include "hm_paper.h"

#include "hm_coarsen.h"
#include "hm_smooth.h"
#include "hm_subdivide.h"

#include <math.h>

/* Coarsening and refinement agree after two or three turns; the cap is for bounds so near to each
 * other that they never would. */
enum { MOST_TURNS = 12, BOLD_TURNS = 2, FEW = 50 /* of so many nodes one */ };

/* Angle (degrees) below which smoothing must not make a triangle worse. */
#define GOOD_ANGLE 30.0

struct work {
    struct hm_domain *dom;
    const struct hm_paper_options *o;
    struct hm_lengths bounds; /* as they count in this turn */
    struct hm_paper_left *left;
};

typedef enum hm_err (*round_fn)(struct hm_domain *dom, const struct hm_lengths *l, int threads,
                                int64_t *n, struct hm_diag *d);

static enum hm_err watch(const struct work *w, const char *what, struct hm_diag *d)
{
    if (!w->o->watch)
        return HM_OK;
    enum hm_err err = hm_domain_triangulate(w->dom, w->o->threads, d);
    return err ? err : w->o->watch(w->o->arg, w->dom, what, d);
}

static enum hm_err go(struct work *w, round_fn round, const char *what, int64_t *n,
                      struct hm_diag *d)
{
    enum hm_err err = round(w->dom, &w->bounds, w->o->threads, n, d);
    if (err || *n == 0)
        return err;
    w->left->rounds++;
    return watch(w, what, d);
}

/* Clear the fixed edges; then whole triangles while they are many, and single edges, until there is
 * nothing left; *n: changes. */
static enum hm_err coarsen(struct work *w, int64_t *n, struct hm_diag *d)
{
    int64_t near, triangles = 0, edges = 0;
    enum hm_err err = HM_OK;
    *n = 0;
    do {
        err = go(w, hm_coarsen_clear, "clear fixed edges", &near, d);
        *n += err ? 0 : near;
        do {
            if (!err)
                err = go(w, hm_coarsen_triangles, "coarsen triangles", &triangles, d);
            *n += err ? 0 : triangles;
        } while (!err && triangles > (int64_t)w->dom->nnodes / FEW);
        if (!err)
            err = go(w, hm_coarsen_edges, "coarsen edges", &edges, d);
        *n += err ? 0 : edges;
    } while (!err && triangles + edges > 0);
    return err;
}

/* The same the other way. Once few triangles are too large as a whole, halving edges does for them
 * too. */
static enum hm_err refine(struct work *w, int64_t *n, struct hm_diag *d)
{
    int64_t triangles = INT64_MAX, edges = 0;
    enum hm_err err = HM_OK;
    *n = 0;
    do {
        if (triangles > (int64_t)w->dom->nnodes / FEW)
            err = go(w, hm_subdivide_triangles, "refine triangles", &triangles, d);
        else
            triangles = 0;
        if (!err)
            err = go(w, hm_subdivide_edges, "refine edges", &edges, d);
        *n += err ? 0 : triangles + edges;
    } while (!err && triangles + edges > 0);
    return err;
}

/* In the first turns coarsening may make edges over the maximum, which refinement then halves;
 * later it may not, or they could go on for ever. */
static enum hm_err take_turns(struct work *w, struct hm_diag *d)
{
    for (int turn = 0; turn < MOST_TURNS; turn++) {
        int64_t coarser, finer;
        w->bounds = w->o->bounds;
        if (turn < BOLD_TURNS)
            w->bounds.most = INFINITY;
        enum hm_err err = coarsen(w, &coarser, d);
        if (err || (turn > 0 && coarser == 0))
            return err;
        w->bounds = w->o->bounds;
        err = refine(w, &finer, d);
        if (err || finer == 0)
            return err;
    }
    return HM_OK;
}

static enum hm_err smooth(struct work *w, struct hm_diag *d)
{
    for (int pass = 0; pass < w->o->smooth; pass++) {
        int64_t moved;
        enum hm_err err =
            hm_smooth_pass(w->dom, &w->o->bounds, GOOD_ANGLE, w->o->threads, &moved, d);
        if (!err)
            err = watch(w, "smooth", d);
        if (err || moved == 0)
            return err;
    }
    return HM_OK;
}

/* Refuse what could only end when memory does: about one node for each 0.43 most², and one for each
 * `most` of a fixed edge. And ground so thin that its borders alone make a million nodes, a hundred
 * times those that its area needs: a slip in the coordinates. */
static enum hm_err check_size(const struct work *w, struct hm_diag *d)
{
    const struct hm_domain *dom = w->dom;
    double area = 0, length = 0, most = w->o->bounds.most;
    for (int32_t tri = 0; tri < hm_tri_triangles(dom->tri); tri++)
        area += hm_domain_area(dom, tri);
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_domain_edge *e = &dom->edge[k];
        length += sqrt(hm_node_distance2(&dom->node[e->a], &dom->node[e->b]));
    }
    double inner = area / (most * most) / 0.43, along = length / most;
    if (inner + along > (double)(INT32_MAX / 6) || (along > 1e6 && along > 100 * inner))
        return hm_fail(d, HM_EARG,
                       "a maximum edge of %g m makes about %.2g nodes on %.3g m2 and along %.3g m "
                       "of borders and lines",
                       most, inner + along, area, length);
    return HM_OK;
}

/* --- what is left --- */

static void judge(const struct work *w, int32_t e, double length2)
{
    const struct hm_domain *dom = w->dom;
    const struct hm_lengths *l = &w->o->bounds;
    struct hm_paper_left *left = w->left;
    int32_t org = dom->node_of[hm_tri_org(dom->tri, e)],
            dest = dom->node_of[hm_tri_dest(dom->tri, e)];
    bool is_short = length2<l->least * l->least, is_long = length2> l->most * l->most;
    if (hm_tri_marks(dom->tri, e)) {
        left->fixed_short += is_short;
        left->fixed_long += is_long;
        return;
    }
    bool fixed = dom->node[org].flags & dom->node[dest].flags & HM_NODE_FIXED;
    left->too_short += is_short;
    left->too_short_fixed += is_short && fixed;
    left->too_long += is_long;
    left->too_long_regular += is_long && (dom->node[org].owner > 0 || dom->node[dest].owner > 0);
}

static enum hm_err count_left(const struct work *w, struct hm_diag *d)
{
    struct hm_domain *dom = w->dom;
    enum hm_err err = hm_domain_triangulate(dom, w->o->threads, d);
    for (int32_t e = 0; !err && e < 3 * hm_tri_triangles(dom->tri); e++) {
        int32_t twin = hm_tri_twin(dom->tri, e);
        if (!hm_domain_is_inside(dom, e / 3) || (hm_domain_is_inside(dom, twin / 3) && twin < e))
            continue;
        judge(w, e,
              hm_node_distance2(&dom->node[dom->node_of[hm_tri_org(dom->tri, e)]],
                                &dom->node[dom->node_of[hm_tri_dest(dom->tri, e)]]));
    }
    return err;
}

enum hm_err hm_paper_reach(struct hm_domain *dom, const struct hm_paper_options *o,
                           struct hm_paper_left *left, struct hm_diag *d)
{
    struct work w = {.dom = dom, .o = o, .left = left};
    *left = (struct hm_paper_left){0};
    if (!(o->bounds.least > 0 && o->bounds.most > o->bounds.least))
        return hm_fail(d, HM_EARG, "minimum edge %g m, maximum edge %g m: the maximum must be more",
                       o->bounds.least, o->bounds.most);
    enum hm_err err = hm_domain_triangulate(dom, o->threads, d);
    if (!err)
        err = check_size(&w, d);
    if (!err)
        err = take_turns(&w, d);
    if (!err)
        err = smooth(&w, d);
    if (!err && o->smooth > 0) /* smoothing changes which nodes are neighbours */
        err = take_turns(&w, d);
    if (!err)
        err = count_left(&w, d);
    return err;
}
