/* Delaunay triangulation and location: topology, the empty circle, uniqueness, ugly point sets. */
#include "hm_pred.h"
#include "hm_tri.h"
#include "tap.h"
#include "tri_points.h"

#include <string.h>

static bool sound(const struct hm_tri *t)
{
    struct hm_diag d = {0};
    bool good = !hm_tri_check_topology(t, &d) && !hm_tri_check_delaunay(t, &d);
    if (!good)
        printf("# %s (%.17g %.17g)\n", d.text, d.x, d.y);
    return good;
}

static bool same(const struct hm_tri *a, const struct hm_tri *b)
{
    if (hm_tri_triangles(a) != hm_tri_triangles(b) || hm_tri_vertices(a) != hm_tri_vertices(b))
        return false;
    for (int32_t v = 0; v < hm_tri_vertices(a); v++)
        if (memcmp(hm_tri_xy(a, v), hm_tri_xy(b, v), 2 * sizeof(double)))
            return false;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(a); e++)
        if (hm_tri_org(a, e) != hm_tri_org(b, e) || hm_tri_twin(a, e) != hm_tri_twin(b, e))
            return false;
    return true;
}

static void shuffle(double *xy, int n)
{
    for (int i = n - 1; i > 0; i--) {
        int k = (int)(draw() % (uint64_t)(i + 1));
        double p[2];
        memcpy(p, xy + 2 * i, sizeof p);
        memcpy(xy + 2 * i, xy + 2 * k, sizeof p);
        memcpy(xy + 2 * k, p, sizeof p);
    }
}

/* Every input point is at its vertex, and the vertex names the first of those there. */
static bool inputs_agree(const struct hm_tri *t, const double *xy, int n)
{
    size_t merged = 0;
    for (int i = 0; i < n; i++) {
        int32_t v = hm_tri_of_input(t, (size_t)i);
        const double *p = hm_tri_xy(t, v);
        int64_t first = hm_tri_input(t, v);
        if (p[0] != xy[2 * i] || p[1] != xy[2 * i + 1] || first > i)
            return false;
        merged += first != i;
    }
    return merged == hm_tri_duplicates(t);
}

static void ugly_sets(void)
{
    for (int set = 0; set < SETS; set++) {
        bool good = true, unique = true, inputs = true;
        for (int n = 3; good && n < 3000; n += 1 + n / 2) {
            double *xy = tri_points((enum tri_set)set, n);
            struct hm_tri *t = NULL, *u = NULL;
            struct hm_diag d = {0};
            enum hm_err err = hm_tri_build(&t, xy, (size_t)n, 2, 1, &d);
            if (err == HM_EGEOM && n < 20) { /* few points may well lie on a line */
                free(xy);
                continue;
            }
            good = !err && sound(t);
            inputs = inputs && !err && inputs_agree(t, xy, n);
            shuffle(xy, n);
            unique = unique && !hm_tri_build(&u, xy, (size_t)n, 2, 2, &d) && same(t, u);
            hm_tri_free(t);
            hm_tri_free(u);
            free(xy);
        }
        ok(good && inputs, "%s: topology and Delaunay", tri_set_name[set]);
        ok(unique, "%s: the same from any order and on two threads", tri_set_name[set]);
    }
}

/* Small sets, by the definition: no vertex inside any circumcircle; and nothing is left out. */
static void empty_circles(void)
{
    int wrong = 0, built = 0;
    for (int round = 0; round < 3000; round++) {
        double xy[24];
        int n = 3 + (int)(draw() % 10), range = 2 + (int)(draw() % 5);
        for (int i = 0; i < 2 * n; i++)
            xy[i] = (double)(draw() % (uint64_t)range);
        struct hm_tri *t;
        if (hm_tri_build(&t, xy, (size_t)n, 2, 1, NULL))
            continue;
        built++;
        wrong += !sound(t);
        for (int32_t k = 0; k < hm_tri_triangles(t); k++)
            for (int32_t v = 0; hm_tri_is_solid(t, k) && v < hm_tri_vertices(t); v++)
                wrong += hm_pred_incircle_unique(hm_tri_xy(t, hm_tri_org(t, 3 * k)),
                                                 hm_tri_xy(t, hm_tri_dest(t, 3 * k)),
                                                 hm_tri_xy(t, hm_tri_apex(t, 3 * k)),
                                                 hm_tri_xy(t, v)) > 0;
        hm_tri_free(t);
    }
    ok(wrong == 0 && built > 2000, "no vertex in a circumcircle, %d small sets", built);
}

static enum hm_err build_error(const double *xy, int n)
{
    struct hm_tri *t;
    struct hm_diag d = {0};
    enum hm_err err = hm_tri_build(&t, xy, (size_t)n, 2, 1, &d);
    if (err != d.err || (err && (t || !d.text[0])))
        return HM_EIO;
    hm_tri_free(t);
    return err;
}

static void refusals(void)
{
    double xy[200] = {0};
    ok(build_error(xy, 0) == HM_EGEOM, "no points");
    for (int i = 0; i < 200; i++)
        xy[i] = 7;
    ok(build_error(xy, 1) == HM_EGEOM && build_error(xy, 100) == HM_EGEOM, "equal points");
    xy[50] = 8;
    ok(build_error(xy, 100) == HM_EGEOM, "two places");
    int wrong = 0;
    static const double step[5][2] = {{1, 0}, {0, 1}, {1, 1}, {-3, 2}, {1e-300, -1e-300}};
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < 100; i++) {
            xy[2 * i] = step[k][0] * (i * 37 % 100);
            xy[2 * i + 1] = step[k][1] * (i * 37 % 100);
        }
        for (int n = 3; n <= 100; n++)
            wrong += build_error(xy, n) != HM_EGEOM;
    }
    ok(wrong == 0, "points on a line");
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 200; i++)
            xy[i] = uniform();
        xy[2 * k + 51] = bad[k];
        wrong += build_error(xy, 100) != HM_EGEOM;
    }
    ok(wrong == 0, "coordinates that are not finite");
}

static bool holds(const struct hm_tri *t, int32_t tri, const double *p)
{
    for (int32_t e = 3 * tri; e < 3 * tri + 3; e++)
        if (hm_pred_orient(hm_tri_xy(t, hm_tri_org(t, e)), hm_tri_xy(t, hm_tri_dest(t, e)), p) < 0)
            return false;
    return true;
}

static void location(void)
{
    enum { N = 5000, QUERIES = 20000 };
    double *xy = tri_points(SET_LATTICE, N), *at = malloc(2 * QUERIES * sizeof *at);
    int32_t *tri = malloc(QUERIES * sizeof *tri), hint = HM_TRI_NONE;
    struct hm_tri *t;
    int wrong = 0, outside = 0;
    if (hm_tri_build(&t, xy, N, 2, 1, NULL) || !at || !tri)
        exit(2);
    for (int i = 0; i < 2 * QUERIES; i++) /* half of them on edges and vertices */
        at[i] = i % 4 < 2 ? 80 * uniform() - 4 : (double)(draw() % 80) - 4;
    wrong = hm_tri_locate_all(t, at, QUERIES, 2, 2, tri, NULL) != HM_OK;
    for (int i = 0; i < QUERIES; i++) {
        const double *p = at + 2 * i;
        int32_t k = hm_tri_locate(t, p[0], p[1], i % 2 ? &hint : NULL);
        /* 71 whole rows of 71, less the 41 that make it 5000 */
        bool in = p[0] >= 0 && p[1] >= 0 && p[0] <= 70 && p[1] <= 70;
        if (k == HM_TRI_NONE || tri[i] == HM_TRI_NONE) {
            outside++;
            wrong += k != tri[i] || (in && p[1] <= 69);
        } else {
            wrong += !in || !holds(t, k, p) || !holds(t, tri[i], p);
        }
    }
    ok(wrong == 0 && outside > 1000, "20000 points located, %d outside", outside);
    ok(hm_tri_locate(t, NAN, 0, NULL) == HM_TRI_NONE, "nowhere is nowhere");
    const double nowhere[14] = {NAN, 1,         1,     INFINITY, -INFINITY, NAN, 1,
                                1,   -INFINITY, 1e308, -1e308,   1e308,     5,   5};
    for (size_t n = 0; n <= 7; n++) { /* the first three alone too */
        int32_t there[7];
        wrong += hm_tri_locate_all(t, nowhere, n, 2, 1, there, NULL) != HM_OK;
        for (size_t i = 0; i < n; i++)
            wrong += (there[i] != HM_TRI_NONE) != (i == 3 || i == 6);
    }
    ok(wrong == 0, "nor is it in bulk");
    int gone = 0;
    for (int32_t v = 1000; v < 4800; v++)
        gone += !hm_tri_remove(t, v, NULL);
    for (int i = 0; i < 200; i++) { /* some come back, as the last */
        int32_t v;
        wrong += hm_tri_insert(t, 70 * uniform(), 69 * uniform(), HM_TRI_NONE, &v, NULL) != HM_OK;
    }
    for (int i = 0; i < QUERIES; i++) {
        const double *p = at + 2 * i;
        int32_t k = hm_tri_locate(t, p[0], p[1], NULL);
        wrong += (k == HM_TRI_NONE) != (tri[i] == HM_TRI_NONE) || (k >= 0 && !holds(t, k, p));
    }
    ok(wrong == 0 && gone > 3000, "found without a hint where vertices are gone");
    hm_tri_free(t);
    free(xy);
    free(at);
    free(tri);
}

static void edges_between(void)
{
    double *xy = tri_points(SET_UNIFORM, 500);
    struct hm_tri *t;
    int wrong = 0;
    if (hm_tri_build(&t, xy, 500, 2, 1, NULL))
        exit(2);
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        int32_t a = hm_tri_org(t, e), b = hm_tri_dest(t, e);
        if (a != HM_TRI_INFINITY && b != HM_TRI_INFINITY)
            wrong += hm_tri_edge_between(t, a, b) != e;
    }
    int found = 0;
    for (int32_t v = 1; v < 500; v++)
        found += hm_tri_edge_between(t, 0, v) != HM_TRI_NONE;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++)
        found -= hm_tri_org(t, e) == 0 && hm_tri_dest(t, e) != HM_TRI_INFINITY;
    ok(wrong == 0 && found == 0, "edges found by their ends");
    hm_tri_free(t);
    free(xy);
}

int main(void)
{
    ugly_sets();
    empty_circles();
    refusals();
    location();
    edges_between();
    return done();
}
