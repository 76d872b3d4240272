#include "hm_cut.h"

#include "hm_elem.h"
#include "hm_plane.h"

#include <math.h>
#include <stdlib.h>

/* The two meshes, and how near is too near. */
struct sides {
    const struct hm_border *higher;
    const struct hm_locate *in_higher;
    const struct hm_mesh *lower;
    const struct hm_locate *in_lower;
    double buffer;
};

static bool overlaps(const struct sides *s, const struct hm_elem *e)
{
    const struct hm_mesh *higher = s->higher->mesh;
    struct hm_boxquery q = hm_boxtree_find(hm_locate_boxes(s->in_higher), hm_elem_box(s->lower, e));
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;)
        if (hm_elem_overlap(s->lower, e, higher, &higher->elem[i]))
            return true;
    return false;
}

/* Distance between an element and the segment a–b. */
static double distance(const struct hm_mesh *m, const struct hm_elem *e, const double *a,
                       const double *b)
{
    double p[4][2], middle[2], least = INFINITY;
    int n = hm_elem_xy(m, e, p);
    if (hm_elem_holds(m, e, a[0], a[1]))
        return 0;
    for (int i = 0; i < n; i++)
        least = fmin(least, hm_plane_gap(p[i], p[(i + 1) % n], a, b, middle));
    return least;
}

/* Does the way from p to its foot on a–b, shorter than `reach`, lead from the element through
 * ground of the lower mesh? */
static bool leads(const struct sides *s, const struct hm_elem *e, const double *p, const double *a,
                  const double *b, double reach)
{
    double t = hm_plane_foot(p, a, b);
    const double way[2] = {a[0] + t * (b[0] - a[0]) - p[0], a[1] + t * (b[1] - a[1]) - p[1]};
    bool ours = hypot(way[0], way[1]) < reach;
    for (int k = 1; ours && k < 4; k++) {
        double x = p[0] + way[0] * k / 4, y = p[1] + way[1] * k / 4;
        ours = !hm_elem_holds(s->lower, e, x, y) && hm_locate_element(s->in_lower, x, y) >= 0;
    }
    return ours;
}

/* Is the element nearer than `reach` to the border's edge a–b, by any of the ways that begin or end
 * in a corner? Not only by the shortest one: where a bank meets the border that may lead over the
 * ground beside the bank. */
static bool comes_near(const struct sides *s, const struct hm_elem *e, const double *a,
                       const double *b, double reach)
{
    double p[4][2];
    int n = hm_elem_xy(s->lower, e, p);
    bool near = false;
    for (int i = 0; i < n && !near; i++)
        near = leads(s, e, p[i], a, b, reach) || leads(s, e, a, p[i], p[(i + 1) % n], reach) ||
               leads(s, e, b, p[i], p[(i + 1) % n], reach);
    return near;
}

/* Is the element too near to the border? Sees, too, whether it touches it: then it is. A border
 * beyond ground that neither mesh covers, as between two channels side by side, is not near. */
static bool is_near(const struct sides *s, const struct hm_elem *e, bool *touches)
{
    double length = hm_elem_mean_edge(s->lower, e), touch = 1e-6 * length;
    double reach = s->buffer >= 0 ? s->buffer : HM_CUT_REACH * fmax(length, s->higher->longest);
    bool near = false, touched = false;
    struct hm_boxquery q = hm_boxtree_find(
        s->higher->tree, hm_box_grown(hm_elem_box(s->lower, e), fmax(reach, touch)));
    for (int32_t k; !touched && (k = hm_boxtree_next(&q)) >= 0;) {
        const double *a = hm_border_from(s->higher, (size_t)k);
        const double *b = hm_border_to(s->higher, (size_t)k);
        double own = HM_CUT_REACH * fmax(length, hm_border_length(s->higher, (size_t)k));
        touched = distance(s->lower, e, a, b) <= touch;
        near = near || touched || comes_near(s, e, a, b, s->buffer >= 0 ? s->buffer : own);
    }
    *touches |= touched;
    return near;
}

/* What the cut leaves of each element: the edges it opened, and the neighbours still there. */
struct rest {
    int8_t opened, neighbours;
};

static void count_rest(const struct hm_mesh_edge *edge, size_t nedges, const bool *gone,
                       struct rest *rest)
{
    for (size_t i = 0; i < nedges; i++) {
        int32_t l = edge[i].left, r = edge[i].right;
        if (r < 0 || (gone[l] && gone[r]))
            continue;
        if (gone[l] || gone[r]) {
            rest[gone[l] ? r : l].opened++;
        } else {
            rest[l].neighbours++;
            rest[r].neighbours++;
        }
    }
}

/* Mark the nodes from which more than one edge of the remaining boundary leaves, and that were in
 * order before. */
static void mark_pinched(const struct hm_mesh_edge *edge, size_t nedges, const bool *gone,
                         uint8_t *leaving, size_t nnodes)
{
    enum { ONCE = 1, PINCHED = 2, BEFORE = 4, TOUCHED = 8 };
    for (size_t i = 0; i < nnodes; i++)
        leaving[i] = 0;
    for (size_t i = 0; i < nedges; i++) {
        const struct hm_mesh_edge *e = &edge[i];
        bool left = !gone[e->left], right = e->right >= 0 && !gone[e->right];
        if (e->right < 0)
            leaving[e->a] |= leaving[e->a] & BEFORE ? TOUCHED : BEFORE;
        if (left == right)
            continue;
        uint8_t *at = &leaving[left ? e->a : e->b];
        *at |= *at & ONCE ? PINCHED : ONCE;
    }
    for (size_t i = 0; i < nnodes; i++)
        leaving[i] = (leaving[i] & (PINCHED | TOUCHED)) == PINCHED;
}

/* One round: elements that hang by an edge or by nothing, and all around a pinched node, go. */
static int64_t drop_loose(const struct hm_mesh *m, const struct hm_mesh_edge *edge, size_t nedges,
                          struct hm_cut *cut, struct rest *rest, uint8_t *pinched)
{
    int64_t dropped = 0;
    for (size_t i = 0; i < m->nelems; i++)
        rest[i] = (struct rest){0};
    count_rest(edge, nedges, cut->gone, rest);
    mark_pinched(edge, nedges, cut->gone, pinched, m->nnodes);
    for (size_t i = 0; i < m->nelems; i++) {
        const struct hm_elem *e = &m->elem[i];
        int corners = hm_elem_corners(e);
        if (cut->gone[i])
            continue;
        bool loose = rest[i].opened >= corners - 1 || (rest[i].opened > 0 && !rest[i].neighbours);
        for (int k = 0; k < corners; k++)
            loose |= pinched[e->node[k]];
        cut->gone[i] = loose;
        dropped += loose;
    }
    return dropped;
}

static enum hm_err trim(const struct hm_mesh *m, struct hm_cut *cut, struct hm_diag *d)
{
    struct hm_mesh_edge *edge;
    size_t nedges;
    enum hm_err err = hm_mesh_edges(m, &edge, &nedges, d);
    if (err)
        return err;
    struct rest *rest = hm_alloc(m->nelems, sizeof *rest);
    uint8_t *pinched = hm_alloc(m->nnodes, sizeof *pinched);
    if (rest && pinched)
        for (int64_t n; (n = drop_loose(m, edge, nedges, cut, rest, pinched)) > 0;)
            cut->loose += n;
    else
        err = hm_fail_memory(d);
    free(edge);
    free(rest);
    free(pinched);
    return err;
}

enum hm_err hm_cut_mark(struct hm_cut *cut, const struct hm_border *higher,
                        const struct hm_locate *in_higher, const struct hm_mesh *lower,
                        const struct hm_locate *in_lower, double buffer, struct hm_diag *d)
{
    const struct sides s = {higher, in_higher, lower, in_lower, buffer};
    *cut = (struct hm_cut){.gone = hm_alloc0(lower->nelems, sizeof *cut->gone)};
    if (!cut->gone)
        return hm_fail_memory(d);
    for (size_t i = 0; i < lower->nelems; i++) {
        if (overlaps(&s, &lower->elem[i]))
            cut->overlapping++;
        else if (is_near(&s, &lower->elem[i], &cut->meets))
            cut->near++;
        else
            continue;
        cut->gone[i] = true;
    }
    cut->meets |= cut->overlapping > 0;
    enum hm_err err = cut->meets ? trim(lower, cut, d) : HM_OK;
    if (err)
        hm_cut_free(cut);
    return err;
}

/* Distance from (x, y) to the nearest corner of an element. */
static double corner_distance(const struct hm_mesh *m, const struct hm_elem *e, double x, double y)
{
    double least = INFINITY;
    for (int k = 0; k < hm_elem_corners(e); k++)
        least = fmin(least, hypot(m->node[e->node[k]].x - x, m->node[e->node[k]].y - y));
    return least;
}

enum hm_err hm_cut_more(struct hm_cut *cut, const struct hm_mesh *lower, double x, double y,
                        int edges, struct hm_diag *d)
{
    double least = INFINITY, edge = 0;
    for (size_t i = 0; i < lower->nelems; i++) {
        if (cut->gone[i] || corner_distance(lower, &lower->elem[i], x, y) >= least)
            continue;
        least = corner_distance(lower, &lower->elem[i], x, y);
        edge = hm_elem_mean_edge(lower, &lower->elem[i]);
    }
    if (least == INFINITY)
        return hm_fail_at(d, HM_EGEOM, x, y, "the gap between the meshes cannot be filled");
    for (size_t i = 0; i < lower->nelems; i++)
        if (!cut->gone[i] &&
            corner_distance(lower, &lower->elem[i], x, y) <= least + edges * edge) {
            cut->gone[i] = true;
            cut->loose++;
        }
    return trim(lower, cut, d);
}

enum hm_err hm_cut_around(struct hm_cut *cut, const struct hm_mesh *lower, const bool *node,
                          int64_t *more, struct hm_diag *d)
{
    *more = 0;
    for (size_t i = 0; i < lower->nelems; i++)
        for (int k = 0; !cut->gone[i] && k < hm_elem_corners(&lower->elem[i]); k++)
            if (node[lower->elem[i].node[k]]) {
                cut->gone[i] = true;
                ++*more;
            }
    cut->near += *more;
    return *more > 0 ? trim(lower, cut, d) : HM_OK;
}

void hm_cut_free(struct hm_cut *cut)
{
    free(cut->gone);
    *cut = (struct hm_cut){0};
}
