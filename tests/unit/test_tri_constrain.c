/* Constraints: small dirty drawings, checked after every step by what must hold of any result.
 *
 *     test_tri_constrain [drawings [seed]]
 */
#include "hm_pred.h"
#include "hm_tri.h"
#include "tap.h"
#include "tri_points.h"

#include <string.h>

enum { MOST_POINTS = 40, MOST_SEGMENTS = 30 };

struct drawing {
    double xy[2 * MOST_POINTS];
    int points, segments;
    int ends[MOST_SEGMENTS][2];
    double slack; /* how far rounding may move a constraint */
};

static void on_small_grid(struct drawing *g)
{
    int range = 2 + (int)(draw() % 8);
    for (int i = 0; i < 2 * g->points; i++)
        g->xy[i] = (double)(draw() % (uint64_t)range);
    g->slack = 1e-13;
}

/* Where doubles are whole numbers: every intersection moves by up to half of one. */
static void on_coarse_doubles(struct drawing *g)
{
    int range = 4 + (int)(draw() % 60);
    for (int i = 0; i < 2 * g->points; i++)
        g->xy[i] = 0x1p52 + (double)(draw() % (uint64_t)range);
    g->slack = 12;
}

static void anywhere(struct drawing *g)
{
    for (int i = 0; i < 2 * g->points; i++)
        g->xy[i] = uniform();
    g->slack = 1e-14;
}

static void along_a_line(struct drawing *g)
{
    for (int i = 0; i < g->points; i++) {
        g->xy[2 * i] = 545000 + 100 * uniform();
        g->xy[2 * i + 1] = 0.7 * g->xy[2 * i] + (double)(draw() % 5) * 1e-10;
    }
    g->slack = 1e-8;
}

static void of_all_sizes(struct drawing *g)
{
    double scale = draw() % 2 ? 1e300 : 1e-300;
    for (int i = 0; i < 2 * g->points; i++)
        g->xy[i] = (double)(draw() % 100) * scale;
    g->slack = 1e-12 * scale;
}

/* The distance of p from the segment a b. */
static double distance(const double *p, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], scale = fmax(fabs(dx), fabs(dy));
    double ux = dx / scale, uy = dy / scale, px = (p[0] - a[0]) / scale, py = (p[1] - a[1]) / scale;
    double part = fmin(fmax((px * ux + py * uy) / (ux * ux + uy * uy), 0), 1);
    return scale * hypot(px - part * ux, py - part * uy);
}

/* The edges with segment i's mark lead from its one end to the other, near the true line. */
static bool is_chain(const struct hm_tri *t, const struct drawing *g, int i)
{
    int32_t n = hm_tri_vertices(t), a = hm_tri_of_input(t, (size_t)g->ends[i][0]);
    int32_t b = hm_tri_of_input(t, (size_t)g->ends[i][1]);
    bool *seen = calloc((size_t)n, sizeof *seen);
    seen[a] = true;
    for (bool more = true; more;) {
        more = false;
        for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
            if (hm_tri_org(t, e) < 0 || hm_tri_dest(t, e) < 0 || !(hm_tri_marks(t, e) & 1 << i))
                continue;
            if (seen[hm_tri_org(t, e)] && !seen[hm_tri_dest(t, e)])
                seen[hm_tri_dest(t, e)] = more = true;
        }
    }
    bool good = seen[b];
    for (int32_t v = 0; v < n && a != b; v++)
        if (seen[v] && distance(hm_tri_xy(t, v), hm_tri_xy(t, a), hm_tri_xy(t, b)) > g->slack) {
            good = false;
            printf("# segment %d: %g off\n", i,
                   distance(hm_tri_xy(t, v), hm_tri_xy(t, a), hm_tri_xy(t, b)));
        }
    free(seen);
    return good;
}

static bool is_sound(const struct hm_tri *t)
{
    struct hm_diag d = {0};
    bool good = !hm_tri_check_topology(t, &d) && !hm_tri_check_delaunay(t, &d);
    if (!good)
        printf("# %s (%.17g %.17g)\n", d.text, d.x, d.y);
    return good;
}

static bool run(const struct drawing *g, struct hm_tri_mends *mends)
{
    struct hm_tri *t;
    struct hm_diag d = {0};
    if (hm_tri_build(&t, g->xy, (size_t)g->points, 2, 1, &d))
        return d.err == HM_EGEOM;
    bool good = true;
    for (int i = 0; good && i < g->segments; i++) {
        struct hm_tri_segment s = {hm_tri_of_input(t, (size_t)g->ends[i][0]),
                                   hm_tri_of_input(t, (size_t)g->ends[i][1]), 1 << i};
        good = !hm_tri_constrain(t, &s, 1, mends, &d);
        if (!good)
            printf("# %s\n", d.text);
        good = good && is_sound(t);
    }
    for (int i = 0; good && i < g->segments; i++)
        good = is_chain(t, g, i);
    hm_tri_free(t);
    return good;
}

static void print(const struct drawing *g)
{
    for (int i = 0; i < g->points; i++)
        printf("# point %.17g %.17g\n", g->xy[2 * i], g->xy[2 * i + 1]);
    for (int i = 0; i < g->segments; i++)
        printf("# segment %d %d\n", g->ends[i][0], g->ends[i][1]);
}

static void dirty(void (*make)(struct drawing *), const char *name, int drawings)
{
    struct hm_tri_mends mends = {0};
    bool good = true;
    for (int k = 0; good && k < drawings; k++) {
        struct drawing g = {.points = 3 + (int)(draw() % (MOST_POINTS - 3))};
        make(&g);
        g.segments = (int)(draw() % MOST_SEGMENTS);
        for (int i = 0; i < g.segments; i++)
            for (int end = 0; end < 2; end++)
                g.ends[i][end] = (int)(draw() % (uint64_t)g.points);
        good = run(&g, &mends);
        if (!good)
            print(&g);
    }
    ok(good, "%d drawings %s: %lld crossings, %lld vertices on segments, %lld overlaps", drawings,
       name, (long long)mends.n[HM_TRI_CROSSING], (long long)mends.n[HM_TRI_ON_SEGMENT],
       (long long)mends.n[HM_TRI_OVERLAP]);
}

/* Many segments through a lattice, where every one runs over vertices. */
static void through_lattice(void)
{
    enum { SIDE = 60, N = SIDE * SIDE };
    double *xy = malloc(2 * N * sizeof *xy);
    for (int i = 0; i < N; i++)
        tri_point(SET_LATTICE, i, N, xy + 2 * i);
    struct hm_tri *t;
    struct hm_tri_mends mends = {0};
    bool good = !hm_tri_build(&t, xy, N, 2, 1, NULL);
    for (int i = 0; good && i < SIDE; i++) {
        struct hm_tri_segment s[2] = {
            {hm_tri_of_input(t, (size_t)i), hm_tri_of_input(t, (size_t)(N - 1 - i)), 1},
            {hm_tri_of_input(t, (size_t)(i * SIDE)), hm_tri_of_input(t, (size_t)(N - 1 - i * SIDE)),
             2}};
        good = !hm_tri_constrain(t, s, 2, &mends, NULL);
    }
    ok(good && is_sound(t), "120 segments through the middle of a lattice, %lld crossings",
       (long long)mends.n[HM_TRI_CROSSING]);
    hm_tri_free(t);
    free(xy);
}

/* One long segment over many triangles, among them vertices that stick out to it. */
static void long_segment(void)
{
    enum { N = 20000 };
    double *xy = tri_points(SET_UNIFORM, N);
    xy[0] = xy[1] = -1;
    xy[2] = 2;
    xy[3] = 2.1;
    struct hm_tri *t;
    bool good = !hm_tri_build(&t, xy, N, 2, 1, NULL);
    struct hm_tri_segment s = {hm_tri_of_input(t, 0), hm_tri_of_input(t, 1), 4};
    good = good && !hm_tri_constrain(t, &s, 1, NULL, NULL) && is_sound(t) &&
           hm_tri_edge_between(t, s.a, s.b) != HM_TRI_NONE;
    ok(good, "one segment through 20000 points");
    int32_t left = hm_tri_edge_between(t, s.a, s.b) / 3, count = 0, solid = 0;
    good = !hm_tri_flood(t, left, 4, 7, NULL);
    for (int32_t k = 0; k < hm_tri_triangles(t); k++)
        if (hm_tri_is_solid(t, k)) {
            count += hm_tri_region(t, k) == 7;
            solid++;
        }
    ok(good && count == solid, "flooded around its ends");
    hm_tri_free(t);
    free(xy);
}

/* What was told, kind by kind: how often and where last. */
struct told {
    int64_t n[HM_TRI_MENDS];
    double place[HM_TRI_MENDS][2];
};

static void note(void *who, enum hm_tri_mend what, double x, double y)
{
    struct told *told = who;
    told->n[what]++;
    told->place[what][0] = x;
    told->place[what][1] = y;
}

static void told_by_place(void)
{
    static const double xy[] = {0, 0, 8, 0, 8, 8, 0, 8, 6, 6, 20, 20};
    static const double want[HM_TRI_MENDS][2] = {{4, 4}, {6, 6}, {2, 6}, {20, 20}};
    struct hm_tri *t;
    struct told told = {0};
    struct hm_tri_mends mends = {.tell = note, .who = &told};
    if (hm_tri_build(&t, xy, 6, 2, 1, NULL))
        exit(2);
    int32_t v[6];
    for (int i = 0; i < 6; i++)
        v[i] = hm_tri_of_input(t, (size_t)i);
    const struct hm_tri_segment s[4] = {{v[0], v[2], 1}, /* over 6 6 */
                                        {v[1], v[3], 1}, /* crosses it at 4 4 */
                                        {v[5], v[5], 1},
                                        {v[3], v[1], 2}}; /* again, in two pieces; by 4 4 */
    bool good = !hm_tri_constrain(t, s, 3, &mends, NULL);
    good = good && mends.n[HM_TRI_OVERLAP] == 0 && mends.n[HM_TRI_ON_SEGMENT] == 1;
    good = good && !hm_tri_constrain(t, s + 3, 1, NULL, NULL);
    struct hm_tri_segment piece = {
        hm_tri_dest(t, hm_tri_edge_between(t, v[3], hm_tri_vertices(t) - 1)), v[3], 4};
    good = good && !hm_tri_constrain(t, &piece, 1, &mends, NULL);
    for (int k = 0; k < HM_TRI_MENDS; k++)
        good = good && mends.n[k] == 1 && told.n[k] == 1 && told.place[k][0] == want[k][0] &&
               told.place[k][1] == want[k][1];
    ok(good, "what is mended is told, each with its place");
    hm_tri_free(t);
}

static void refusals(void)
{
    static const double xy[] = {0, 0, 8, 0, 8, 8, 0, 8, 3, 4};
    struct hm_tri *t;
    if (hm_tri_build(&t, xy, 5, 2, 1, NULL))
        exit(2);
    int32_t gone = hm_tri_of_input(t, 4), a = hm_tri_of_input(t, 0), c = hm_tri_of_input(t, 2);
    bool good = !hm_tri_remove(t, gone, NULL);
    const struct hm_tri_segment bad[6] = {{a, c, 0},  {a, gone, 1},      {gone, gone, 1},
                                          {-1, a, 1}, {a, INT32_MAX, 1}, {INT32_MIN, INT32_MIN, 1}};
    for (int i = 0; i < 6; i++) {
        struct hm_diag d = {0};
        const struct hm_tri_segment s[2] = {{a, c, 1}, bad[i]};
        good = good && hm_tri_constrain(t, s, 2, NULL, &d) == HM_EARG && d.text[0];
    }
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++)
        good = good && hm_tri_marks(t, e) == 0;
    ok(good && is_sound(t), "no marks, vertices taken out, and what is no vertex: nothing is done");
    hm_tri_free(t);
}

int main(int argc, char **argv)
{
    int drawings = argc > 1 ? atoi(argv[1]) : 1000;
    if (argc > 2)
        tri_seed += 0x9e3779b97f4a7c15u * strtoull(argv[2], NULL, 10);
    dirty(on_small_grid, "on a small grid", drawings);
    dirty(anywhere, "anywhere", drawings);
    dirty(on_coarse_doubles, "where doubles are whole", drawings);
    dirty(along_a_line, "along a line", drawings);
    dirty(of_all_sizes, "of 1e300 and 1e-300", drawings / 4);
    through_lattice();
    long_segment();
    told_by_place();
    refusals();
    return done();
}
