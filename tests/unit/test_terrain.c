/* hm_terrain: exact on planes, right about gaps, borders and the nearest measurement; the same
 * however the measurements come. hm_tin and hm_plane_height, on which it stands. */
#include "hm_plane.h"
#include "hm_terrain.h"
#include "hm_tin.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

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

/* Of points alone; p may be NULL. */
static struct hm_terrain *terrain_of(struct hm_points *p, size_t n, double gap,
                                     struct hm_terrain_counts *counts)
{
    struct hm_terrain *t = NULL;
    struct hm_inputs in = {.points = p, .npoints = n};
    hm_terrain_build(&t, &in, gap, 2, counts, NULL);
    return t;
}

static void test_points(void)
{
    struct hm_terrain_counts counts;
    struct hm_points p;
    struct hm_terrain *t;
    int32_t hint = 0;
    start(&p);
    for (int i = 0; i < 2000; i++) {
        double x = 100 * uniform(), y = 100 * uniform();
        add_point(&p, x, y, plane(x, y));
    }
    add_point(&p, 50, 50, NAN);
    t = terrain_of(NULL, 0, 0, &counts);
    ok(t && isnan(hm_terrain_z_nearest(t, 0, 0, &hint)), "without points it knows nothing");
    hm_terrain_free(t);
    t = terrain_of(&p, 1, 0, &counts);
    ok(t && counts.without_z == 1 && counts.duplicates == 0, "one point has no height");
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
    struct hm_terrain_counts counts;
    struct hm_points p;
    struct hm_terrain *t;
    int32_t hint = 0;
    start(&p);
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 20; j++) /* 1 m apart, and a gap of 11 m */
            add_point(&p, i < 10 ? i : i + 10, j + 0.01 * i, i < 10 ? 1 : 2);
    t = terrain_of(&p, 1, 3, &counts);
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
    struct hm_terrain_counts counts;
    struct hm_inputs in = {.grid = &g, .ngrids = 1};
    hm_terrain_build(&t, &in, 0, 1, &counts, NULL);
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
    hm_terrain_free(t);
    in.points = &p;
    in.npoints = 1;
    hm_terrain_build(&t, &in, 0, 1, &counts, NULL);
    near(hm_terrain_z(t, 110, 47, &hint), 7, 0, "measurements where the grid knows nothing");
    near(hm_terrain_z(t, 112, 50, &hint), plane(112, 50), 1e-12, "the grid where it does");
    hm_terrain_free(t);
    hm_points_free(&p);
    hm_grid_free(&g);
}

/* The same survey in parts, in any order: an L and the square cut out of it, points thrown together
 * at random, all of them backwards; with places measured twice and thrice. */
static void test_parts(void)
{
    enum { N = 900, PLACES = 5000 };
    double xyz[N][3];
    struct hm_points part[3][3];
    struct hm_terrain *t[3];
    struct hm_terrain_counts counts[3];
    for (int k = 0; k < N; k++) {
        xyz[k][0] = 5e5 + floor(60 * uniform()) / 2; /* many share a place */
        xyz[k][1] = 6e6 + floor(60 * uniform()) / 2;
        xyz[k][2] = 100 * uniform();
    }
    for (int way = 0; way < 3; way++) {
        for (int k = 0; k < 3; k++)
            start(&part[way][k]);
        for (int i = 0; i < N; i++) {
            const double *p = xyz[way == 2 ? N - 1 - i : i];
            int square = p[0] > 5e5 + 10 && p[1] > 6e6 + 10;
            int into = way == 0 ? 0 : way == 1 ? square : (int)(3 * uniform());
            hm_points_append(&part[way][into], p, NULL);
        }
        t[way] = terrain_of(part[way], 3, way == 0 ? 0 : 1e9, &counts[way]);
    }
    int differ = 0;
    int32_t hint[3] = {0};
    for (int k = 0; k < PLACES; k++) {
        double x = 5e5 - 5 + 40 * uniform(), y = 6e6 - 5 + 40 * uniform(), z[3];
        for (int way = 0; way < 3; way++)
            z[way] = hm_terrain_z_nearest(t[way], x, y, &hint[way]);
        differ += z[0] != z[1] || z[0] != z[2];
    }
    ok(differ == 0, "the same heights, to the last bit, however the points come");
    ok(counts[0].duplicates > 50 && counts[1].duplicates == counts[0].duplicates &&
           counts[2].duplicates == counts[0].duplicates,
       "and as many at the place of another");
    for (int way = 0; way < 3; way++) {
        hm_terrain_free(t[way]);
        for (int k = 0; k < 3; k++)
            hm_points_free(&part[way][k]);
    }
}

static void test_shared_places(void)
{
    const double xyz[] = {0, 0, 1, 4, 0, 1, 0, 4, 1, 4, 4, 1, 0, 0, 2, 0, 0, 6, 4, 4, 3};
    struct hm_tin tin;
    hm_tin_build(&tin, xyz, 7, 1, NULL);
    ok(tin.z[hm_tri_of_input(tin.tri, 0)] == 3 && tin.z[hm_tri_of_input(tin.tri, 3)] == 2 &&
           tin.z[hm_tri_of_input(tin.tri, 1)] == 1,
       "points at one place count by their mean");
    hm_tin_free(&tin);
}

/* Of all triangles, slivers too: at a corner its height, never beyond the corners' heights, and
 * the same whichever corner comes first. */
static void test_plane(void)
{
    int turned = 0, beyond = 0, corner = 0;
    for (int k = 0; k < 20000; k++) {
        double p[3][2], z[3], at[2] = {0}, share = 0;
        for (int i = 0; i < 3; i++) {
            p[i][0] = 545000 + uniform();
            p[i][1] = k % 2 ? 5972000 + uniform() : 5972000 + p[i][0] / 4 + 1e-9 * uniform();
            z[i] = 20 * uniform();
        }
        for (int i = 0; i < 3; i++) {
            double w = i == 2 ? 1 - share : (1 - share) * uniform();
            share += w;
            at[0] += w * (p[i][0] - p[0][0]);
            at[1] += w * (p[i][1] - p[0][1]);
        }
        at[0] += p[0][0];
        at[1] += p[0][1];
        double h = hm_plane_height(p[0], p[1], p[2], z, at);
        const double z1[3] = {z[1], z[2], z[0]}, z2[3] = {z[2], z[0], z[1]};
        const double back[3] = {z[0], z[2], z[1]};
        turned += h != hm_plane_height(p[1], p[2], p[0], z1, at) ||
                  h != hm_plane_height(p[2], p[0], p[1], z2, at) ||
                  (k % 2 && fabs(h - hm_plane_height(p[0], p[2], p[1], back, at)) > 1e-6);
        beyond += h < fmin(z[0], fmin(z[1], z[2])) || h > fmax(z[0], fmax(z[1], z[2]));
        for (int i = 0; i < 3; i++)
            corner += hm_plane_height(p[0], p[1], p[2], z, p[i]) != z[i];
    }
    ok(turned == 0, "one height however the triangle is turned");
    ok(beyond == 0, "between the heights of its corners");
    ok(corner == 0, "at a corner the corner's");
}

int main(void)
{
    test_points();
    test_gap();
    test_grid();
    test_parts();
    test_shared_places();
    test_plane();
    return done();
}
