/* hm_coarsen and hm_smooth in the corner cases that whole meshes hardly ever come to. */
#include "hm_coarsen.h"
#include "hm_pred.h"
#include "hm_smooth.h"
#include "tap.h"

static uint64_t state = 11;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static void add_node(struct hm_domain *dom, double x, double y, int32_t flags)
{
    hm_domain_add_node(dom, (struct hm_node){.x = x, .y = y, .flags = flags}, NULL);
}

/* The first n nodes are the outline, counter-clockwise. */
static void close_outline(struct hm_domain *dom, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        hm_domain_add_edge(
            dom, (struct hm_domain_edge){i, (i + 1) % n, HM_EDGE_BORDER, 0, HM_OUTSIDE, 0}, NULL);
}

enum { MOST = 64 };

/* The neighbours of a node, counter-clockwise; how many. */
static int star_of(const struct hm_domain *dom, int32_t node, struct hm_node *link)
{
    const struct hm_tri *t = dom->tri;
    int32_t first = hm_tri_edge_from(t, dom->vertex_of[node]), e = first;
    int n = 0;
    do {
        link[n++] = dom->node[dom->node_of[hm_tri_dest(t, e)]];
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first && n < MOST);
    return n;
}

/* One free node among fixed ones: where the mean of its neighbours lies beyond an edge opposite, it
 * may not go, since a triangle would turn over. */
static void test_no_turning_over(void)
{
    enum { TRIALS = 2000, FIXED = 16, FREE = 4 + FIXED };
    const struct hm_lengths l = {.least = 0.01, .most = 1000};
    int moved = 0, over = 0, beyond = 0;
    for (int k = 0; k < TRIALS; k++) {
        struct hm_domain dom = {0};
        struct hm_node link[MOST], mean = {0};
        int64_t n;
        add_node(&dom, 0, 0, HM_NODE_FIXED);
        add_node(&dom, 100, 0, HM_NODE_FIXED);
        add_node(&dom, 100, 100, HM_NODE_FIXED);
        add_node(&dom, 0, 100, HM_NODE_FIXED);
        close_outline(&dom, 4);
        for (int i = 0; i < FIXED; i++) /* flat: stars get long, and not convex */
            add_node(&dom, 2 + 96 * uniform(), 45 + 10 * uniform(), HM_NODE_FIXED);
        add_node(&dom, 2 + 96 * uniform(), 45 + 10 * uniform(), 0);
        hm_domain_triangulate(&dom, 1, NULL);
        int degree = star_of(&dom, FREE, link);
        for (int i = 0; i < degree; i++) {
            mean.x += link[i].x / degree;
            mean.y += link[i].y / degree;
        }
        hm_smooth_pass(&dom, &l, 0, 1, &n, NULL);
        moved += n > 0;
        for (int i = 0; i < degree; i++) {
            const double *a = &link[i].x, *b = &link[(i + 1) % degree].x;
            beyond += hm_pred_orient(a, b, &mean.x) <= 0;
            over += hm_pred_orient(a, b, &dom.node[FREE].x) <= 0;
        }
        hm_domain_free(&dom);
    }
    ok(moved > TRIALS / 2, "free nodes move: %d of %d", moved, TRIALS);
    ok(beyond > 10, "the mean is beyond an edge opposite in %d cases", beyond);
    ok(over == 0, "but no triangle turns over: %d", over);
}

/* Coordinates so large that they are whole numbers: the centre of a flat triangle, or the middle of
 * an edge, is rounded by as much as the triangle is high. It may not leave the outline. */
static void test_centres_stay_inside(int size)
{
    enum { TRIALS = 4000, FREE = 4 };
    const double x0 = 0x1p52, y0 = 0x1p52;
    const struct hm_lengths l = {.least = 1e3, .most = 1e6};
    int64_t collapsed = 0;
    int outside = 0, failed = 0;
    for (int k = 0; k < TRIALS; k++) {
        struct hm_domain dom = {0};
        double slope = floor(9 * uniform());
        int64_t n;
        /* corners too far off to be collapsed onto */
        add_node(&dom, x0 - 5000, y0 - 1000 * slope - 3, HM_NODE_FIXED);
        add_node(&dom, x0 + 5000, y0 + 1000 * slope + 1, HM_NODE_FIXED);
        add_node(&dom, x0 + 5000, y0 + 90000, HM_NODE_FIXED);
        add_node(&dom, x0 - 5000, y0 + 90000, HM_NODE_FIXED);
        close_outline(&dom, 4);
        while (dom.nnodes < 4 + FREE) { /* on the lowest whole numbers above the outline */
            double x = x0 + floor(12 * uniform()), y = y0 + floor((x - x0) * slope / 5) - 4;
            bool taken = false;
            while (hm_pred_orient(&dom.node[0].x, &dom.node[1].x, (double[2]){x, y}) <= 0)
                y++;
            for (size_t i = 0; i < dom.nnodes; i++)
                taken = taken || (dom.node[i].x == x && dom.node[i].y == y);
            if (!taken)
                add_node(&dom, x, y, 0);
        }
        enum hm_err err = size == 3 ? hm_coarsen_triangles(&dom, &l, 1, &n, NULL)
                                    : hm_coarsen_edges(&dom, &l, 1, &n, NULL);
        failed += err != HM_OK;
        collapsed += n;
        for (size_t i = 4; !err && i < dom.nnodes; i++)
            outside += hm_pred_orient(&dom.node[0].x, &dom.node[1].x, &dom.node[i].x) <= 0;
        hm_domain_free(&dom);
    }
    ok(failed == 0 && collapsed > TRIALS / 10, "%s collapse: %lld",
       size == 3 ? "triangles" : "edges", (long long)collapsed);
    ok(outside == 0, "none of them to beyond the outline: %d", outside);
}

int main(void)
{
    test_no_turning_over();
    test_centres_stay_inside(3);
    test_centres_stay_inside(2);
    return done();
}
