/* hm_terrain: exact on planes, right about gaps, borders and the nearest measurement. */
#include "hm_terrain.h"
#include "tap.h"

#include <stdlib.h>

static uint64_t state = 42;

static double uniform(void) /* [0, 1) */
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static double plane(double x, double y)
{
    return 3 + 0.25 * x - 0.5 * y;
}

static void add_point(struct hm_points *p, double x, double y, double z)
{
    hm_points_append(p, (double[3]){x, y, z}, NULL);
}

static void start(struct hm_points *p)
{
    *p = (struct hm_points){0};
    hm_header_init(&p->header, HM_POINTS, NULL);
}

static void test_points(void)
{
    struct hm_points p;
    struct hm_terrain *t;
    int32_t hint = 0;
    start(&p);
    for (int i = 0; i < 2000; i++) {
        double x = 100 * uniform(), y = 100 * uniform();
        add_point(&p, x, y, plane(x, y));
    }
    add_point(&p, 50, 50, NAN);
    ok(hm_terrain_new(&t, NULL) == HM_OK && hm_terrain_is_empty(t), "a new terrain is empty");
    ok(isnan(hm_terrain_z_nearest(t, 0, 0, &hint)), "an empty terrain knows nothing");
    ok(hm_terrain_add_points(t, &p, 0, 2, NULL) == HM_OK && !hm_terrain_is_empty(t),
       "points added");
    double worst = 0;
    for (int i = 0; i < 2000; i++) {
        double x = 5 + 90 * uniform(), y = 5 + 90 * uniform();
        worst = fmax(worst, fabs(hm_terrain_z(t, x, y, &hint) - plane(x, y)));
    }
    near(worst, 0, 1e-12, "a plane comes back");
    int exact = 0;
    for (size_t i = 0; i < 2000; i++)
        exact += hm_terrain_z(t, p.v[3 * i], p.v[3 * i + 1], &hint) == p.v[3 * i + 2];
    ok(exact == 2000, "measurements keep their height to the last bit");
    ok(isnan(hm_terrain_z(t, -50, 50, &hint)), "nothing is known outside");
    int wrong = 0;
    for (int k = 0; k < 200; k++) { /* against brute force */
        double x = 400 * uniform() - 150, y = 400 * uniform() - 150, best = INFINITY, z = 0;
        for (size_t i = 0; i < 2000; i++) {
            double dist = hypot(p.v[3 * i] - x, p.v[3 * i + 1] - y);
            if (dist < best) {
                best = dist;
                z = p.v[3 * i + 2];
            }
        }
        double inside = hm_terrain_z(t, x, y, &hint);
        wrong += hm_terrain_z_nearest(t, x, y, &hint) != (isnan(inside) ? z : inside);
    }
    ok(wrong == 0, "outside, the nearest measurement counts");
    hm_points_free(&p);
    hm_terrain_free(t);
}

static void test_gap(void)
{
    struct hm_points p;
    struct hm_terrain *t;
    int32_t hint = 0;
    start(&p);
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 20; j++) /* 1 m apart, and a gap of 11 m */
            add_point(&p, i < 10 ? i : i + 10, j + 0.01 * i, i < 10 ? 1 : 2);
    hm_terrain_new(&t, NULL);
    hm_terrain_add_points(t, &p, 3, 1, NULL);
    near(hm_terrain_z(t, 4.5, 4.5, &hint), 1, 0, "beside the gap");
    ok(isnan(hm_terrain_z(t, 14, 5, &hint)), "no height in a gap");
    near(hm_terrain_z_nearest(t, 13, 5, &hint), 1, 0, "the nearer side's height");
    near(hm_terrain_z_nearest(t, 16, 5, &hint), 2, 0, "the other side's");
    hm_terrain_free(t);
    hm_points_free(&p);
}

static void test_grid(void)
{
    struct hm_header h;
    struct hm_grid g = {0};
    struct hm_terrain *t;
    int32_t hint = 0;
    hm_header_init(&h, HM_GRID, NULL);
    h.lattice = (struct hm_lattice){11, 6, 100, 50, 2, -5}; /* north first */
    hm_grid_init(&g, &h, NULL);
    for (int j = 0; j < 6; j++)
        for (int i = 0; i < 11; i++)
            g.v[j * 11 + i] = plane(100 + 2 * i, 50 - 5 * j);
    hm_terrain_new(&t, NULL);
    hm_terrain_add_grid(t, &g, NULL);
    near(hm_terrain_z(t, 107.3, 41.9, &hint), plane(107.3, 41.9), 1e-12, "bilinear on a plane");
    near(hm_terrain_z(t, 120, 25, &hint), plane(120, 25), 1e-12, "the last corner");
    ok(isnan(hm_terrain_z(t, 120.001, 30, &hint)), "outside the lattice");
    near(hm_terrain_z_nearest(t, 500, 30, &hint), plane(120, 30), 1e-12, "nearest node");
    for (int j = 1; j < 5; j++)
        for (int i = 1; i < 10; i++)
            g.v[j * 11 + i] = NAN;
    ok(isnan(hm_terrain_z(t, 101, 47, &hint)), "no height beside nodata");
    near(hm_terrain_z_nearest(t, 110, 47, &hint), plane(110, 50), 1e-12, "nearest node with data");
    struct hm_points p;
    start(&p);
    add_point(&p, 0, 0, 7);
    add_point(&p, 200, 0, 7);
    add_point(&p, 100, 200, 7);
    hm_terrain_add_points(t, &p, 0, 1, NULL);
    near(hm_terrain_z(t, 110, 47, &hint), 7, 0, "the second source where the first knows nothing");
    near(hm_terrain_z(t, 112, 50, &hint), plane(112, 50), 1e-12, "the first where it does");
    hm_terrain_free(t);
    hm_points_free(&p);
    hm_grid_free(&g);
}

int main(void)
{
    test_points();
    test_gap();
    test_grid();
    return done();
}
