#include "hm_seam.h"

#include "hm_elem.h"
#include "hm_infill.h"
#include "hm_plane.h"
#include "hm_tri.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Triangles of the gap with an angle under this many degrees are mended where they can be. */
static const double good_angle = 25;

enum {
    MARK = 1, /* of all constraints */
    GAP = 1   /* region of the triangles that fill the gap */
};

/* All that belongs to one gap. */
struct gap {
    struct hm_sides s;
    struct hm_border rest;
    struct hm_mesh kept; /* the elements that stay, on the lower mesh's nodes */
    double *size;
    bool *used; /* nodes of kept elements */
    struct hm_outline sides;
    int32_t *slot[2]; /* input number of a node of the higher and of the lower mesh, or -1 */
    int32_t *node;    /* inputs of the triangulation: nodes as in hm_seam_triangle */
    double (*xy)[2];
    size_t n, cap, xy_cap;
    struct hm_tri_segment *segment;
    size_t nsegments, segment_cap;
    struct hm_tri *tri;
};

/* --- what there is: elements that stay, sizes, borders --- */

static enum hm_err measure(struct gap *g, const struct hm_mesh *lower, const bool *gone,
                           struct hm_diag *d)
{
    int32_t *elements = hm_alloc0(lower->nnodes, sizeof *elements);
    g->size = hm_alloc0(lower->nnodes, sizeof *g->size);
    g->used = hm_alloc0(lower->nnodes, sizeof *g->used);
    g->kept = (struct hm_mesh){.node = lower->node, .nnodes = lower->nnodes};
    g->kept.elem = hm_alloc(lower->nelems, sizeof *g->kept.elem);
    if (!elements || !g->size || !g->used || !g->kept.elem) {
        free(elements);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < lower->nelems; i++) {
        const struct hm_elem *e = &lower->elem[i];
        double length = hm_elem_mean_edge(lower, e);
        for (int k = 0; k < hm_elem_corners(e); k++) {
            g->size[e->node[k]] += length;
            elements[e->node[k]]++;
            g->used[e->node[k]] |= !gone[i];
        }
        if (!gone[i])
            g->kept.elem[g->kept.nelems++] = *e;
    }
    for (size_t i = 0; i < lower->nnodes; i++)
        if (elements[i] > 0)
            g->size[i] /= elements[i];
    free(elements);
    return HM_OK;
}

static enum hm_err prepare(struct gap *g, const struct hm_border *higher,
                           const struct hm_locate *in_higher, const struct hm_border *lower,
                           const struct hm_locate *in_lower, const bool *gone, struct hm_diag *d)
{
    enum hm_err err = measure(g, lower->mesh, gone, d);
    if (!err)
        err = hm_border_build(&g->rest, &g->kept, d);
    if (err)
        return err;
    g->s = (struct hm_sides){.higher = higher,
                             .in_higher = in_higher,
                             .lower = lower->mesh,
                             .in_lower = in_lower,
                             .gone = gone,
                             .outline = lower,
                             .rest = &g->rest,
                             .size = g->size,
                             .kept = g->used};
    return hm_outline_make(&g->sides, &g->s, d);
}

/* --- what the triangulation is made of --- */

static enum hm_err add_input(struct gap *g, int32_t node, struct hm_diag *d)
{
    int32_t *slot = node >= 0 ? &g->slot[0][node] : &g->slot[1][~node];
    if (*slot >= 0)
        return HM_OK;
    if (!hm_grow(&g->node, &g->cap, g->n + 1, sizeof *g->node) ||
        !hm_grow(&g->xy, &g->xy_cap, g->n + 1, sizeof *g->xy))
        return hm_fail_memory(d);
    memcpy(g->xy[g->n], hm_sides_xy(&g->s, node), sizeof g->xy[g->n]);
    g->node[g->n] = node;
    *slot = (int32_t)g->n++;
    return HM_OK;
}

static int32_t slot_of(const struct gap *g, int32_t node)
{
    return node >= 0 ? g->slot[0][node] : g->slot[1][~node];
}

static enum hm_err add_segment(struct gap *g, int32_t a, int32_t b, struct hm_diag *d)
{
    enum hm_err err = add_input(g, a, d);
    if (!err)
        err = add_input(g, b, d);
    if (!err && !hm_grow(&g->segment, &g->segment_cap, g->nsegments + 1, sizeof *g->segment))
        err = hm_fail_memory(d);
    if (!err)
        g->segment[g->nsegments++] =
            (struct hm_tri_segment){slot_of(g, a), slot_of(g, b), MARK}; /* inputs as yet */
    return err;
}

static enum hm_err add_border(struct gap *g, const struct hm_border *b, bool lower,
                              struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < b->n; i++) {
        int32_t from = b->loops.node[i], to = b->loops.node[b->next[i]];
        err = add_segment(g, lower ? ~from : from, lower ? ~to : to, d);
    }
    return err;
}

/* Is a node of the lower mesh, with its elements gone, good for the inside of the gap? */
static bool is_free(const struct gap *g, const struct hm_boxtree *sides, int32_t node)
{
    const double *p = hm_mesh_xy(g->s.lower, node), size = g->size[node];
    if (g->used[node] || size == 0 || g->slot[1][node] >= 0 ||
        hm_locate_element(g->s.in_higher, p[0], p[1]) >= 0 ||
        hm_border_is_near(g->s.higher, p, HM_SIDES_CLEAR, size))
        return false;
    struct hm_boxquery q =
        hm_boxtree_find(sides, hm_box_grown(hm_box_of(p, p), HM_SIDES_CLEAR * size));
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;) {
        const struct hm_outline_segment *side = &g->sides.segment[i];
        if (hm_plane_distance(p, hm_sides_xy(&g->s, side->a), hm_sides_xy(&g->s, side->b)) <
            HM_SIDES_CLEAR * size)
            return false;
    }
    return true;
}

/* The nodes of the lower mesh's old outline: they are used by the gap's outer sides, or not. */
static bool *outline_nodes(const struct gap *g)
{
    bool *outer = hm_alloc0(g->s.lower->nnodes, sizeof *outer);
    for (size_t i = 0; outer && i < g->s.outline->n; i++)
        outer[g->s.outline->loops.node[i]] = true;
    return outer;
}

static enum hm_err add_free_nodes(struct gap *g, struct hm_diag *d)
{
    struct hm_boxtree *sides = NULL;
    struct hm_box *box = hm_alloc(g->sides.n, sizeof *box);
    bool *outer = outline_nodes(g);
    enum hm_err err = box && outer ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; !err && i < g->sides.n; i++)
        box[i] = hm_box_of(hm_sides_xy(&g->s, g->sides.segment[i].a),
                           hm_sides_xy(&g->s, g->sides.segment[i].b));
    if (!err)
        err = hm_boxtree_build(&sides, box, g->sides.n, d);
    for (size_t i = 0; !err && i < g->s.lower->nnodes; i++)
        if (!outer[i] && is_free(g, sides, (int32_t)i))
            err = add_input(g, ~(int32_t)i, d);
    hm_boxtree_free(sides);
    free(box);
    free(outer);
    return err;
}

static enum hm_err clear_slots(struct gap *g, struct hm_diag *d)
{
    size_t n[2] = {g->s.higher->mesh->nnodes, g->s.lower->nnodes};
    for (int k = 0; k < 2; k++) {
        g->slot[k] = hm_alloc(n[k], sizeof *g->slot[k]);
        if (!g->slot[k])
            return hm_fail_memory(d);
        for (size_t i = 0; i < n[k]; i++)
            g->slot[k][i] = -1;
    }
    return HM_OK;
}

static enum hm_err triangulate(struct gap *g, struct hm_diag *d)
{
    enum hm_err err = clear_slots(g, d);
    if (!err)
        err = add_border(g, g->s.higher, false, d);
    if (!err)
        err = add_border(g, &g->rest, true, d);
    for (size_t i = 0; !err && i < g->sides.n; i++)
        err = add_segment(g, g->sides.segment[i].a, g->sides.segment[i].b, d);
    if (!err)
        err = add_free_nodes(g, d);
    if (!err)
        err = hm_tri_build(&g->tri, &g->xy[0][0], g->n, 2, 1, d);
    if (err)
        return err;
    for (size_t i = 0; i < g->nsegments; i++) {
        struct hm_tri_segment *s = &g->segment[i];
        s->a = hm_tri_of_input(g->tri, (size_t)s->a);
        s->b = hm_tri_of_input(g->tri, (size_t)s->b);
    }
    return hm_tri_constrain(g->tri, g->segment, g->nsegments, NULL, d);
}

/* --- which triangles fill the gap --- */

/* Without outer sides a component is gap when the middle of its largest triangle lies where
 * elements were cut away, and not in the higher mesh: so near nothing that rounding could matter.
 */
static bool is_gap(const struct gap *g, int32_t largest)
{
    double p[2];
    hm_tri_centre(g->tri, largest, p);
    int64_t was = hm_locate_element(g->s.in_lower, p[0], p[1]);
    return was >= 0 && g->s.gone[was] && hm_locate_element(g->s.in_higher, p[0], p[1]) < 0;
}

enum side { NO_SIDE, GAP_SIDE, OTHER_SIDE };

/* The outer sides have the gap on their left. They were put in last. */
static void note_sides(const struct gap *g, const int32_t *component, uint8_t *side)
{
    for (size_t i = g->nsegments - g->sides.n; i < g->nsegments; i++) {
        int32_t e = hm_tri_edge_between(g->tri, g->segment[i].a, g->segment[i].b);
        if (e == HM_TRI_NONE)
            continue; /* in pieces: others will say it */
        int32_t left = component[e / 3], right = component[hm_tri_twin(g->tri, e) / 3];
        if (left == right)
            continue;
        side[left] = GAP_SIDE;
        if (side[right] == NO_SIDE)
            side[right] = OTHER_SIDE;
    }
}

/* Give the triangles that fill the gap the region GAP. Component 0 is what hangs together with the
 * outside of the hull. */
static enum hm_err find_gap(const struct gap *g, struct hm_diag *d)
{
    struct hm_tri_components c;
    enum hm_err err = hm_tri_components(g->tri, MARK, &c, d);
    if (err)
        return err;
    uint8_t *side = hm_alloc0((size_t)c.n, sizeof *side);
    if (side)
        note_sides(g, c.of, side);
    else
        err = hm_fail_memory(d);
    for (int32_t i = 1; !err && i < c.n; i++)
        if (side[i] == NO_SIDE && is_gap(g, c.largest[i]))
            side[i] = GAP_SIDE;
    for (int32_t k = 0; !err && k < hm_tri_triangles(g->tri); k++)
        if (hm_tri_is_solid(g->tri, k) && c.of[k] > 0 && side[c.of[k]] == GAP_SIDE &&
            hm_tri_set_region(g->tri, k, GAP))
            err = hm_fail_memory(d);
    free(side);
    hm_tri_components_free(&c);
    return err;
}

/* --- what comes out --- */

static bool is_in_gap(const struct gap *g, int32_t k)
{
    return hm_tri_is_solid(g->tri, k) && hm_tri_region(g->tri, k) == GAP;
}

/* Do constraints that cross leave a corner of the gap that is no node of either mesh? */
static enum hm_err check_corners(const struct gap *g, struct hm_diag *d)
{
    for (int32_t e = 0; e < 3 * hm_tri_triangles(g->tri); e++) {
        if (!is_in_gap(g, e / 3) || hm_tri_input(g->tri, hm_tri_org(g->tri, e)) >= 0)
            continue;
        const double *at = hm_tri_xy(g->tri, hm_tri_org(g->tri, e));
        return hm_fail_at(d, HM_EGEOM, at[0], at[1],
                          "the sides of the gap cross each other; try another buffer");
    }
    return HM_OK;
}

static const struct hm_node *nearest_node(const struct hm_mesh *m, const double *p)
{
    const struct hm_node *best = m->node;
    for (size_t i = 1; i < m->nnodes; i++)
        if (hypot(m->node[i].x - p[0], m->node[i].y - p[1]) < hypot(best->x - p[0], best->y - p[1]))
            best = &m->node[i];
    return best;
}

/* A new node at vertex v, on the lower mesh's surface; or, where the gap goes beyond that, as high
 * as its nearest node. */
static enum hm_err add_new(const struct gap *g, int32_t v, struct hm_seam *seam, struct hm_diag *d)
{
    const struct hm_mesh *lower = g->s.lower;
    const double *p = hm_tri_xy(g->tri, v);
    int64_t was = hm_locate_element(g->s.in_lower, p[0], p[1]);
    const struct hm_elem *e = was >= 0 ? &lower->elem[was] : NULL;
    const struct hm_node *like = e ? &lower->node[e->node[0]] : nearest_node(lower, p);
    struct hm_node node = {p[0], p[1], like->z, 0, like->owner};
    if (e)
        node.z = hm_elem_height(lower, e, p[0], p[1]);
    if (!hm_grow(&seam->node, &seam->node_cap, seam->nnodes + 1, sizeof node))
        return hm_fail_memory(d);
    seam->node[seam->nnodes++] = node;
    return HM_OK;
}

/* What vertex v is: a node of either mesh, or, when it was moved or put in, a new one. */
static enum hm_err node_of(const struct gap *g, int32_t v, int32_t *fresh, struct hm_seam *seam,
                           int32_t *node, struct hm_diag *d)
{
    int64_t input = hm_tri_input(g->tri, v);
    if (input >= 0 && hm_plane_same(g->xy[input], hm_tri_xy(g->tri, v))) {
        *node = g->node[input];
        return HM_OK;
    }
    enum hm_err err = HM_OK;
    if (fresh[v] < 0) {
        fresh[v] = (int32_t)seam->nnodes;
        err = add_new(g, v, seam, d);
    }
    *node = ~((int32_t)g->s.lower->nnodes + fresh[v]);
    return err;
}

static enum hm_err take_triangle(const struct gap *g, int32_t k, int32_t *fresh,
                                 struct hm_seam *seam, struct hm_diag *d)
{
    if (!hm_grow(&seam->triangle, &seam->cap, seam->n + 1, sizeof *seam->triangle))
        return hm_fail_memory(d);
    struct hm_seam_triangle *tri = &seam->triangle[seam->n++];
    double p[2];
    hm_tri_centre(g->tri, k, p);
    int64_t was = hm_locate_element(g->s.in_lower, p[0], p[1]);
    tri->region = g->s.lower->elem[was >= 0 ? was : 0].region;
    const int32_t corner[3] = {hm_tri_org(g->tri, 3 * k), hm_tri_dest(g->tri, 3 * k),
                               hm_tri_apex(g->tri, 3 * k)};
    const double *a = hm_tri_xy(g->tri, corner[0]), *b = hm_tri_xy(g->tri, corner[1]),
                 *c = hm_tri_xy(g->tri, corner[2]);
    tri->angle =
        fmin(hm_plane_angle(a, b, c), fmin(hm_plane_angle(b, c, a), hm_plane_angle(c, a, b)));
    enum hm_err err = HM_OK;
    for (int i = 0; !err && i < 3; i++)
        err = node_of(g, corner[i], fresh, seam, &tri->node[i], d);
    return err;
}

static enum hm_err take_gap(const struct gap *g, struct hm_seam *seam, struct hm_diag *d)
{
    int32_t n = hm_tri_vertices(g->tri);
    int32_t *fresh = hm_alloc((size_t)n, sizeof *fresh);
    if (!fresh)
        return hm_fail_memory(d);
    for (int32_t v = 0; v < n; v++)
        fresh[v] = -1;
    enum hm_err err = HM_OK;
    for (int32_t k = 0; !err && k < hm_tri_triangles(g->tri); k++)
        if (is_in_gap(g, k))
            err = take_triangle(g, k, fresh, seam, d);
    free(fresh);
    return err;
}

enum hm_err hm_seam_fill(struct hm_seam *seam, const struct hm_border *higher,
                         const struct hm_locate *in_higher, const struct hm_border *lower,
                         const struct hm_locate *in_lower, const bool *gone, struct hm_diag *d)
{
    *seam = (struct hm_seam){0};
    struct gap g = {0};
    enum hm_err err = prepare(&g, higher, in_higher, lower, in_lower, gone, d);
    if (!err)
        err = triangulate(&g, d);
    if (!err)
        err = find_gap(&g, d);
    if (!err)
        err = check_corners(&g, d);
    if (!err)
        err = hm_infill_improve(g.tri, GAP, good_angle, d);
    if (!err)
        err = take_gap(&g, seam, d);
    seam->widened = g.sides.widened;
    hm_tri_free(g.tri);
    hm_outline_free(&g.sides);
    hm_border_free(&g.rest);
    free(g.kept.elem);
    free(g.size);
    free(g.used);
    free(g.slot[0]);
    free(g.slot[1]);
    free(g.node);
    free(g.xy);
    free(g.segment);
    if (err)
        hm_seam_free(seam);
    return err;
}

void hm_seam_free(struct hm_seam *seam)
{
    free(seam->triangle);
    free(seam->node);
    *seam = (struct hm_seam){0};
}
