/* hm_assemble_heights: heights of nodes that came without. See hm_assemble_private.h.
 *
 * Where a breakline meets an outline or another line it has a node of its own, at the line's
 * height: linear between the vertices on both sides, of which one may lie outside. Where several
 * lines meet the mean of theirs counts. All else has the height of the terrain.
 */
#include "hm_assemble_private.h"

#include <math.h>

/* How straight a way has to be, as a cosine: pieces of one segment are, but for rounding. */
#define STRAIGHT 0.999

static bool is_breakline(const struct hm_build *b, int32_t e)
{
    return (hm_tri_marks(b->tri, e) & HM_EDGE_BREAKLINE) != 0;
}

/* Was a vertex given as one of a breakline or regular mesh? */
static bool is_given(const struct hm_build *b, int32_t v)
{
    int64_t input = hm_tri_input(b->tri, v);
    return input >= 0 && input < (int64_t)b->first_point;
}

static double cosine(const double *at, const double *from, const double *to)
{
    double u[2] = {at[0] - from[0], at[1] - from[1]}, w[2] = {to[0] - at[0], to[1] - at[1]};
    return (u[0] * w[0] + u[1] * w[1]) / (hypot(u[0], u[1]) * hypot(w[0], w[1]));
}

/* The breakline edge that goes straight on from `from` at `at`, or HM_TRI_NONE. */
static int32_t go_on(const struct hm_build *b, int32_t from, int32_t at)
{
    const struct hm_tri *t = b->tri;
    int32_t first = hm_tri_edge_from(t, at), e = first, best = HM_TRI_NONE;
    double straight = STRAIGHT;
    do {
        int32_t to = hm_tri_dest(t, e);
        if (to != HM_TRI_INFINITY && to != from && is_breakline(b, e)) {
            double here = cosine(hm_tri_xy(t, at), hm_tri_xy(t, from), hm_tri_xy(t, to));
            if (here > straight) {
                straight = here;
                best = e;
            }
        }
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return best;
}

/* The first given vertex straight on along breakline edge e, or HM_TRI_NONE. */
static int32_t end_of(const struct hm_build *b, int32_t e)
{
    const struct hm_tri *t = b->tri;
    while (e != HM_TRI_NONE && !is_given(b, hm_tri_dest(t, e)))
        e = go_on(b, hm_tri_org(t, e), hm_tri_dest(t, e));
    return e == HM_TRI_NONE ? HM_TRI_NONE : hm_tri_dest(t, e);
}

/* The height at v between two given vertices; NaN when one of them has none. */
static double between(const struct hm_build *b, int32_t v, int32_t from, int32_t to)
{
    const double *at = hm_tri_xy(b->tri, v);
    const struct hm_node *one = &b->node[hm_tri_input(b->tri, from)];
    const struct hm_node *other = &b->node[hm_tri_input(b->tri, to)];
    double before = hypot(at[0] - one->x, at[1] - one->y);
    double after = hypot(at[0] - other->x, at[1] - other->y);
    return one->z + before / (before + after) * (other->z - one->z);
}

/* The height that the breaklines through a vertex have there; NaN when there is none. */
static double line_height(const struct hm_build *b, int32_t v)
{
    const struct hm_tri *t = b->tri;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    double sum = 0;
    int n = 0;
    do {
        int32_t on = !is_breakline(b, e) ? HM_TRI_NONE : go_on(b, hm_tri_dest(t, e), v);
        if (on != HM_TRI_NONE && hm_tri_dest(t, e) < hm_tri_dest(t, on)) {
            int32_t from = end_of(b, e), to = end_of(b, on);
            double z = from == HM_TRI_NONE || to == HM_TRI_NONE ? NAN : between(b, v, from, to);
            if (isfinite(z)) {
                sum += z;
                n++;
            }
        }
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return n > 0 ? sum / n : NAN;
}

/* In the order of the vertices, which are neighbours. */
enum hm_err hm_build_heights(const struct hm_build *b, struct hm_domain *dom, struct hm_diag *d)
{
    int32_t hint = 0;
    for (int32_t v = 0; v < hm_tri_vertices(b->tri); v++) {
        struct hm_node *node = dom->node_of[v] < 0 ? NULL : &dom->node[dom->node_of[v]];
        if (!node || isfinite(node->z))
            continue;
        int64_t input = hm_tri_input(b->tri, v);
        bool measured = input >= (int64_t)b->first_point && input < (int64_t)b->end_points;
        node->z = measured || is_given(b, v) ? NAN : line_height(b, v);
        if (!isfinite(node->z))
            node->z = hm_terrain_z_nearest(b->in->terrain, node->x, node->y, &hint);
        if (!isfinite(node->z))
            return hm_fail_at(
                d, HM_EGEOM, node->x, node->y,
                "nothing tells the height of a node: no measurement, grid or line has one");
    }
    return HM_OK;
}
