/* hm_trim: what is too near goes, the rest stays, and nothing comes to cross. */
#include "hm_assemble.h"
#include "hm_plane.h"
#include "hm_trim.h"
#include "tap.h"

#include <stdlib.h>

static uint64_t state = 5;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

/* --- by hand: lines in a square of 100 m, whose node 4 halves its east side --- */

static int32_t add_node(struct hm_domain *dom, double x, double y)
{
    hm_domain_add_node(dom, (struct hm_node){.x = x, .y = y, .flags = HM_NODE_FIXED}, NULL);
    return (int32_t)dom->nnodes - 1;
}

static void add_edge(struct hm_domain *dom, int32_t a, int32_t b, int32_t marks)
{
    int32_t right = marks == HM_EDGE_BORDER ? HM_OUTSIDE : 0;
    hm_domain_add_edge(dom, (struct hm_domain_edge){a, b, marks, 0, right, 0}, NULL);
}

enum { MEETING = 4 };

static void start(struct hm_domain *dom)
{
    *dom = (struct hm_domain){0};
    add_node(dom, 0, 0);
    add_node(dom, 100, 0);
    add_node(dom, 100, 100);
    add_node(dom, 0, 100);
    add_node(dom, 100, 50);
    const int32_t ring[] = {0, 1, MEETING, 2, 3, 0};
    for (int i = 0; i < 5; i++)
        add_edge(dom, ring[i], ring[i + 1], HM_EDGE_BORDER);
}

/* A breakline through n places; from the meeting node when that is wanted. */
static void add_line(struct hm_domain *dom, bool from_border, const double (*xy)[2], int n)
{
    int32_t last = MEETING;
    for (int i = 0; i < n; i++) {
        int32_t node = add_node(dom, xy[i][0], xy[i][1]);
        if (i > 0 || from_border)
            add_edge(dom, last, node, HM_EDGE_BREAKLINE);
        last = node;
    }
}

static int64_t trim(struct hm_domain *dom, double least)
{
    int64_t n = -1;
    struct hm_diag d = {0};
    ok(hm_trim_breaklines(dom, least, 1, &n, &d) == HM_OK && dom->tri, "trimmed %s", d.text);
    return n;
}

/* Is there a breakline's edge between these places? */
static bool has_edge(const struct hm_domain *dom, double ax, double ay, double bx, double by)
{
    for (size_t k = 0; k < dom->nedges; k++) {
        const struct hm_node *a = &dom->node[dom->edge[k].a], *b = &dom->node[dom->edge[k].b];
        if (dom->edge[k].marks == HM_EDGE_BREAKLINE &&
            ((a->x == ax && a->y == ay && b->x == bx && b->y == by) ||
             (a->x == bx && a->y == by && b->x == ax && b->y == ay)))
            return true;
    }
    return false;
}

static void test_meeting(void)
{
    struct hm_domain dom;
    start(&dom);
    add_line(&dom, true, (double[][2]){{98, 51}, {97, 53}, {60, 52}, {58, 52}, {30, 40}}, 5);
    ok(trim(&dom, 5) == 2, "two vertices are too near to where the line meets the outline");
    ok(has_edge(&dom, 100, 50, 60, 52), "it runs straight to the next");
    ok(has_edge(&dom, 60, 52, 58, 52) && has_edge(&dom, 58, 52, 30, 40), "and else as before");
    hm_domain_free(&dom);
}

static void test_ends(void)
{
    struct hm_domain dom;
    start(&dom);
    add_line(&dom, true, (double[][2]){{97, 52}}, 1);
    add_line(&dom, false, (double[][2]){{20, 3}, {50, 4}, {80, 7}, {90, 30}, {96, 31}}, 5);
    add_line(&dom, false, (double[][2]){{2, 60}, {4, 70}}, 2);
    add_line(&dom, false, (double[][2]){{40, 60}, {43, 60}, {46, 60}}, 3);
    ok(trim(&dom, 5) == 1 + 3 + 2, "a stub, loose ends near the outline, a line near it");
    ok(has_edge(&dom, 80, 7, 90, 30), "what is clear of it stays");
    ok(has_edge(&dom, 40, 60, 43, 60) && has_edge(&dom, 43, 60, 46, 60), "fine lines, too");
    ok(dom.nedges == 5 + 1 + 2, "and nothing else");
    hm_domain_free(&dom);
}

static void test_in_the_way(void)
{
    struct hm_domain dom;
    start(&dom);
    add_line(&dom, true, (double[][2]){{97, 54}, {80, 40}}, 2);
    add_line(&dom, false, (double[][2]){{90, 46}, {90, 30}}, 2);
    ok(trim(&dom, 6) == 0, "no line is drawn over another");
    hm_domain_free(&dom);
    start(&dom);
    add_line(&dom, true, (double[][2]){{97, 54}, {80, 40}}, 2);
    add_line(&dom, false, (double[][2]){{90, 44}, {90, 30}}, 2);
    ok(trim(&dom, 6) == 1, "nor kept from where there is room");
    hm_domain_free(&dom);
}

static void test_spikes(void)
{
    const double spike[][2] = {{20, 20}, {20, 30}, {50, 31}, {20, 32}, {20, 42}};
    const double blunt[][2] = {{20, 60}, {20, 70}, {50, 73}, {20, 76}, {20, 86}};
    struct hm_domain dom;
    start(&dom);
    add_line(&dom, false, spike, 5);
    add_line(&dom, false, blunt, 5);
    ok(trim(&dom, 5) == 1, "the tip of a spike is left out");
    ok(has_edge(&dom, 20, 30, 20, 32) && !has_edge(&dom, 50, 31, 20, 32), "between its sides");
    ok(has_edge(&dom, 20, 70, 50, 73) && has_edge(&dom, 50, 73, 20, 76), "not of a wider one");
    hm_domain_free(&dom);
    start(&dom);
    add_line(&dom, false, spike, 5);
    add_line(&dom, false, (double[][2]){{19, 31}, {40, 31}}, 2);
    ok(trim(&dom, 5) == 0, "nor where a line runs in it");
    hm_domain_free(&dom);
}

/* --- a tangle: random lines across each other and the outline --- */

static void add_tangle(struct hm_lines *lines)
{
    double xyz[3 * 12];
    for (int k = 0; k < 14; k++) {
        double x = 100 * uniform(), y = 100 * uniform(), angle = 6.3 * uniform();
        for (int i = 0; i < 12; i++) {
            angle += uniform() - 0.5;
            x += 7 * cos(angle);
            y += 7 * sin(angle);
            xyz[3 * i] = x;
            xyz[3 * i + 1] = y;
            xyz[3 * i + 2] = 0;
        }
        hm_lines_append(lines, &(struct hm_line){.attrs = "", .xyz = xyz, .n = 12}, NULL);
    }
}

/* Do two fixed edges have more in common than an end? */
static bool is_crossed(const struct hm_domain *dom)
{
    for (size_t i = 0; i < dom->nedges; i++)
        for (size_t j = 0; j < i; j++) {
            const struct hm_domain_edge *e = &dom->edge[i], *f = &dom->edge[j];
            if (e->a != f->a && e->a != f->b && e->b != f->a && e->b != f->b &&
                hm_plane_meet(&dom->node[e->a].x, &dom->node[e->b].x, &dom->node[f->a].x,
                              &dom->node[f->b].x))
                return true;
        }
    return false;
}

/* Vertices with two breakline pieces, one of them short and at a node where more meets. */
static int64_t count_near(const struct hm_domain *dom, double least)
{
    int *degree = calloc(dom->nnodes, sizeof *degree);
    int64_t near = 0;
    for (size_t k = 0; k < dom->nedges; k++) {
        degree[dom->edge[k].a] += dom->edge[k].marks == HM_EDGE_BREAKLINE ? 1 : 3;
        degree[dom->edge[k].b] += dom->edge[k].marks == HM_EDGE_BREAKLINE ? 1 : 3;
    }
    for (size_t k = 0; k < dom->nedges; k++) {
        int32_t a = dom->edge[k].a, b = dom->edge[k].b;
        bool is_short = hm_node_distance2(&dom->node[a], &dom->node[b]) < least * least;
        near += is_short && (degree[a] > 2) != (degree[b] > 2);
    }
    free(degree);
    return near;
}

static void test_tangles(void)
{
    static double square[] = {0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0};
    int crossed = 0, failed = 0;
    int64_t before = 0, after = 0;
    for (int k = 0; k < 40; k++) {
        struct hm_lines lines = {0};
        struct hm_inputs in = {.lines = &lines, .nlines = 1};
        struct hm_terrain *terrain = NULL;
        struct hm_terrain_counts found;
        struct hm_assembly_counts counts;
        struct hm_domain dom = {0};
        int64_t n;
        hm_lines_append(&lines,
                        &(struct hm_line){
                            .attrs = "boundary=1 closed=1", .xyz = square, .n = 4, .closed = true},
                        NULL);
        add_tangle(&lines);
        hm_terrain_build(&terrain, &in, 0, 1, &found, NULL);
        const struct hm_assembly assembly = {
            .lines = &lines, .nlines = 1, .terrain = terrain, .clearance = 1, .threads = 1};
        failed += hm_assemble(&assembly, &dom, &counts, NULL) != HM_OK;
        before += count_near(&dom, 2);
        failed += hm_trim_breaklines(&dom, 2, 1, &n, NULL) != HM_OK;
        after += count_near(&dom, 2);
        crossed += is_crossed(&dom);
        hm_domain_free(&dom);
        hm_terrain_free(terrain);
        hm_lines_free(&lines);
    }
    ok(failed == 0 && crossed == 0, "in no tangle of lines one comes to cross another");
    ok(before > 500 && after < before / 10, "of %lld short ends %lld have no room",
       (long long)before, (long long)after);
}

int main(void)
{
    test_meeting();
    test_ends();
    test_in_the_way();
    test_spikes();
    test_tangles();
    return done();
}
