/* Vertices put in, split off, taken out and moved: the triangulation must be the one that is built
 * from the points that are left, and sound after every step. */
#include "hm_pred.h"
#include "hm_tri_topology.h"
#include "tap.h"
#include "tri_points.h"

#include <string.h>

static bool is_sound(const struct hm_tri *t)
{
    struct hm_diag d = {0};
    bool good = !hm_tri_check_topology(t, &d) && !hm_tri_check_delaunay(t, &d);
    if (!good)
        printf("# %s (%.17g %.17g)\n", d.text, d.x, d.y);
    return good;
}

static int count_solid(const struct hm_tri *t)
{
    int n = 0;
    for (int32_t k = 0; k < hm_tri_triangles(t); k++)
        n += hm_tri_is_solid(t, k);
    return n;
}

/* Is t what would be built from its vertices? */
static bool is_as_built(const struct hm_tri *t)
{
    int32_t n = hm_tri_vertices(t), m = 0;
    double *xy = malloc(2 * (size_t)n * sizeof *xy);
    int32_t *number = malloc((size_t)n * sizeof *number);
    for (int32_t v = 0; v < n; v++)
        if (hm_tri_is_used(t, v)) {
            number[v] = m;
            memcpy(xy + 2 * m++, hm_tri_xy(t, v), 2 * sizeof *xy);
        }
    struct hm_tri *u = NULL;
    bool good = !hm_tri_build(&u, xy, (size_t)m, 2, 1, NULL) && count_solid(u) == count_solid(t);
    for (int32_t e = 0; good && e < 3 * hm_tri_triangles(t); e++)
        if (hm_tri_is_solid(t, e / 3)) {
            int32_t a = hm_tri_of_input(u, (size_t)number[hm_tri_org(t, e)]);
            int32_t b = hm_tri_of_input(u, (size_t)number[hm_tri_dest(t, e)]);
            int32_t f = hm_tri_edge_between(u, a, b);
            good = f != HM_TRI_NONE &&
                   hm_tri_apex(u, f) == hm_tri_of_input(u, (size_t)number[hm_tri_apex(t, e)]);
        }
    hm_tri_free(u);
    free(xy);
    free(number);
    return good;
}

static void one_by_one(void)
{
    for (int set = 0; set < SETS; set++) {
        enum { N = 400 };
        double *xy = tri_points((enum tri_set)set, N);
        struct hm_tri *t = NULL;
        int first = 3;
        while (first < N && hm_tri_build(&t, xy, (size_t)first, 2, 1, NULL))
            first++;
        bool good = t != NULL;
        int32_t v;
        for (int i = first; good && i < N; i++) {
            good = !hm_tri_insert(t, xy[2 * i], xy[2 * i + 1], HM_TRI_NONE, &v, NULL) &&
                   hm_tri_xy(t, v)[0] == xy[2 * i] && hm_tri_xy(t, v)[1] == xy[2 * i + 1];
            if (good && i % 16 == 0)
                good = is_sound(t);
        }
        ok(good && is_sound(t) && is_as_built(t), "%s: put in one by one", tri_set_name[set]);
        int removed = 0, moved = 0;
        for (int i = 0; good && i < N / 2; i++) {
            v = (int32_t)(draw() % (uint64_t)hm_tri_vertices(t));
            if (!hm_tri_is_used(t, v))
                continue;
            if (i % 2) {
                removed += !hm_tri_remove(t, v, NULL);
            } else {
                int k = (int)(draw() % N);
                double x = (hm_tri_xy(t, v)[0] + xy[2 * k]) / 2;
                moved += !hm_tri_move(t, v, x, (hm_tri_xy(t, v)[1] + xy[2 * k + 1]) / 2, NULL);
            }
            good = is_sound(t);
        }
        ok(good && is_as_built(t), "%s: %d taken out, %d moved", tri_set_name[set], removed, moved);
        hm_tri_free(t);
        free(xy);
    }
}

/* A square with constrained diagonals and sides, and some points. */
static struct hm_tri *square(int points)
{
    double *xy = tri_points(SET_UNIFORM, points + 5);
    static const double corner[10] = {-1, -1, 2, -1, 2, 2, -1, 2, 0.3, 0.6};
    memcpy(xy, corner, sizeof corner);
    struct hm_tri *t;
    if (hm_tri_build(&t, xy, (size_t)points + 5, 2, 1, NULL))
        exit(2);
    for (size_t i = 0; i < 4; i++) {
        struct hm_tri_segment s[2] = {{hm_tri_of_input(t, i), hm_tri_of_input(t, (i + 1) % 4), 1},
                                      {hm_tri_of_input(t, i), hm_tri_of_input(t, 4), 2}};
        if (hm_tri_constrain(t, s, 2, NULL, NULL))
            exit(2);
    }
    free(xy);
    return t;
}

static double marked_length(const struct hm_tri *t, int32_t mark)
{
    double sum = 0;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++)
        if (hm_tri_org(t, e) >= 0 && hm_tri_dest(t, e) >= 0 && (hm_tri_marks(t, e) & mark)) {
            const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
            sum += hypot(a[0] - b[0], a[1] - b[1]) / 2;
        }
    return sum;
}

static void splits(void)
{
    struct hm_tri *t = square(200);
    double sides = marked_length(t, 1), spokes = marked_length(t, 2);
    bool good = true;
    int done = 0;
    for (int i = 0; good && i < 1000; i++) {
        int32_t edges = 3 * hm_tri_triangles(t), e = (int32_t)(draw() % (uint64_t)edges), v;
        while (i % 2 && !hm_tri_marks(t, e))
            e = (e + 1) % edges;
        int32_t a = hm_tri_org(t, e), b = hm_tri_dest(t, e), marks = hm_tri_marks(t, e);
        if (a < 0 || b < 0)
            continue;
        const double *p = hm_tri_xy(t, a), *q = hm_tri_xy(t, b);
        enum hm_err err = hm_tri_split(t, e, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, &v, NULL);
        good = (!err || err == HM_EGEOM) && is_sound(t);
        if (err || !marks)
            continue;
        done++;
        int32_t f = hm_tri_edge_between(t, a, v), g = hm_tri_edge_between(t, v, b);
        good = good && f != HM_TRI_NONE && g != HM_TRI_NONE && hm_tri_marks(t, f) == marks &&
               hm_tri_marks(t, g) == marks;
    }
    ok(good && done > 100, "edges split, %d of them constraints", done);
    near(marked_length(t, 1), sides, 1e-12, "the sides are as long as before");
    near(marked_length(t, 2), spokes, 1e-12, "the spokes too");
    int32_t v, e = hm_tri_edge_from(t, 0);
    while (hm_tri_dest(t, e) < 0 || hm_tri_org(t, e) < 0)
        e = hm_tri_next(e);
    ok(hm_tri_split(t, e, 1e6, 1e6, &v, NULL) == HM_EGEOM && is_sound(t),
       "an edge is not split far from itself");
    hm_tri_free(t);
}

static int32_t regions_of(const struct hm_tri *t, double *area)
{
    int32_t most = 0;
    for (int32_t k = 0; k < hm_tri_triangles(t); k++) {
        if (!hm_tri_is_solid(t, k))
            continue;
        int32_t r = hm_tri_region(t, k);
        area[r] += hm_area2(hm_tri_xy(t, hm_tri_org(t, 3 * k)), hm_tri_xy(t, hm_tri_dest(t, 3 * k)),
                            hm_tri_xy(t, hm_tri_apex(t, 3 * k)));
        most = r > most ? r : most;
    }
    return most;
}

/* All edits inside a constrained frame: constraints stay, regions keep their area. */
static void within_constraints(void)
{
    struct hm_tri *t = square(300);
    static const double inside[4][2] = {{0.3, -0.9}, {1.9, 0.5}, {0.3, 1.9}, {-0.9, 0.5}};
    double before[5] = {0}, after[5] = {0}, spokes = marked_length(t, 2);
    bool good = true;
    for (int i = 0; i < 4; i++)
        good = good &&
               !hm_tri_flood(t, hm_tri_locate(t, inside[i][0], inside[i][1], NULL), 3, i + 1, NULL);
    good = good && regions_of(t, before) == 4 && before[0] == 0;
    int refused = 0, counts[3] = {0};
    for (int i = 0; good && i < 3000; i++) {
        int32_t v = (int32_t)(draw() % (uint64_t)hm_tri_vertices(t)), kind = (int32_t)(draw() % 3);
        double x = 3 * uniform() - 1, y = 3 * uniform() - 1;
        enum hm_err err = HM_EARG;
        if (kind == 0)
            err = hm_tri_insert(t, x, y, HM_TRI_NONE, &v, NULL);
        else if (hm_tri_is_used(t, v) && kind == 1)
            err = hm_tri_remove(t, v, NULL);
        else if (hm_tri_is_used(t, v))
            err = hm_tri_move(t, v, x, y, NULL);
        refused += err == HM_EARG;
        counts[kind] += !err;
        good = (!err || err == HM_EARG) && (i % 8 || is_sound(t));
    }
    ok(good && counts[2] > 50 && is_sound(t), "%d put in, %d out, %d moved, %d refused", counts[0],
       counts[1], counts[2], refused);
    regions_of(t, after);
    for (int i = 1; i < 5; i++)
        near(after[i], before[i], 1e-9, "the region keeps its area");
    near(marked_length(t, 2), spokes, 1e-12, "the constraints keep their length");
    hm_tri_free(t);
}

static void refusals(void)
{
    struct hm_tri *t = square(1);
    struct hm_diag d = {0};
    int32_t v, centre = hm_tri_of_input(t, 4), corner = hm_tri_of_input(t, 0);
    int32_t loose = hm_tri_of_input(t, 5);
    ok(hm_tri_insert(t, NAN, 0, HM_TRI_NONE, &v, &d) == HM_EGEOM && d.text[0], "NaN is no place");
    ok(hm_tri_remove(t, centre, NULL) == HM_EARG && hm_tri_remove(t, corner, NULL) == HM_EARG &&
           hm_tri_remove(t, -1, NULL) == HM_EARG && hm_tri_remove(t, 99, NULL) == HM_EARG,
       "constraints, the hull and what is no vertex stay");
    ok(hm_tri_move(t, loose, 5, 5, NULL) == HM_EARG &&
           hm_tri_move(t, loose, -1, -1, NULL) == HM_EARG,
       "no move beyond the hull or onto another");
    ok(hm_tri_move(t, -1, 0, 0, NULL) == HM_EARG && hm_tri_move(t, 99, 0, 0, NULL) == HM_EARG &&
           hm_tri_move(t, INT32_MIN, 0, 0, NULL) == HM_EARG &&
           hm_tri_move(t, loose, NAN, 0, NULL) == HM_EARG,
       "nor of what is no vertex, nor to nowhere");
    ok(!hm_tri_insert(t, -1, -1, HM_TRI_NONE, &v, NULL) && v == corner, "a vertex there is found");
    ok(is_sound(t) && !hm_tri_remove(t, loose, NULL) && !hm_tri_is_used(t, loose) && is_sound(t),
       "all as it was");
    ok(hm_tri_remove(t, loose, NULL) == HM_EARG && hm_tri_move(t, loose, 0, 0, NULL) == HM_EARG,
       "what is out is neither taken out again nor moved");
    hm_tri_free(t);
}

/* Numbers of vertices, those taken out included, and of half-edges come to an end. */
static void limits(void)
{
    struct hm_tri *t = square(1);
    struct hm_diag d = {0};
    ok(hm_tri_need_vertices(t, HM_TRI_MOST_VERTICES, &d) == HM_ENOMEM && strstr(d.text, "vertices"),
       "no more vertices than there are numbers");
    d = (struct hm_diag){0};
    ok(hm_tri_need_triangles(t, HM_TRI_MOST_TRIANGLES, &d) == HM_ENOMEM &&
           strstr(d.text, "triangles"),
       "no more triangles than there are numbers of half-edges");
    hm_tri_free(t);
}

int main(void)
{
    one_by_one();
    splits();
    within_constraints();
    refusals();
    limits();
    return done();
}
