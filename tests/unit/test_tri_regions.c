/* Regions: floods, components, and constraints let go. */
#include "hm_pred.h"
#include "hm_tri.h"
#include "tap.h"
#include "tri_points.h"

static bool is_sound(const struct hm_tri *t)
{
    struct hm_diag d = {0};
    bool good = !hm_tri_check_topology(t, &d) && !hm_tri_check_delaunay(t, &d);
    if (!good)
        printf("# %s (%.17g %.17g)\n", d.text, d.x, d.y);
    return good;
}

static double area2(const struct hm_tri *t, int32_t k)
{
    return hm_area2(hm_tri_xy(t, hm_tri_org(t, 3 * k)), hm_tri_xy(t, hm_tri_dest(t, 3 * k)),
                    hm_tri_xy(t, hm_tri_apex(t, 3 * k)));
}

/* A square with a square hole: a region, its component, and a side of it let go. */
static void pond(void)
{
    static const double xy[16] = {0, 0, 9, 0, 9, 9, 0, 9, 3, 3, 6, 3, 6, 6, 3, 6};
    struct hm_tri *t;
    struct hm_tri_segment s[4];
    if (hm_tri_build(&t, xy, 8, 2, 1, NULL))
        exit(2);
    for (int i = 0; i < 4; i++)
        s[i] = (struct hm_tri_segment){hm_tri_of_input(t, (size_t)(4 + i)),
                                       hm_tri_of_input(t, (size_t)(4 + (i + 1) % 4)), 1};
    bool good = !hm_tri_constrain(t, s, 4, NULL, NULL) &&
                !hm_tri_flood(t, hm_tri_locate(t, 4, 5, NULL), 1, 5, NULL);
    double area[2] = {0, 0};
    for (int32_t k = 0; k < hm_tri_triangles(t); k++)
        if (hm_tri_is_solid(t, k))
            area[hm_tri_region(t, k) == 5] += area2(t, k);
    ok(good && area[0] == 2 * 72 && area[1] == 2 * 9, "a region is what its constraints enclose");

    struct hm_tri_components c;
    good = !hm_tri_components(t, 1, &c, NULL) && c.n == 2;
    for (int32_t k = 0; good && k < hm_tri_triangles(t); k++)
        good = c.of[k] == (hm_tri_region(t, k) == 5);
    double p[2];
    hm_tri_centre(t, c.largest[1], p);
    ok(good && c.of[hm_tri_locate(t, p[0], p[1], NULL)] == 1 && area2(t, c.largest[0]) == 27,
       "and a component; the other one hangs together with the outside");
    hm_tri_components_free(&c);
    good = !hm_tri_components(t, 2, &c, NULL) && c.n == 1;
    ok(good, "of which there is one when other marks stop");
    hm_tri_components_free(&c);

    int32_t e = hm_tri_edge_between(t, s[0].a, s[0].b);
    good = !hm_tri_unmark(t, e, 2, NULL) && hm_tri_marks(t, e) == 1;
    good = good && !hm_tri_unmark(t, e, 1, NULL) && hm_tri_marks(t, e) == 0 &&
           !hm_tri_flood(t, hm_tri_locate(t, 4, 5, NULL), 1, 6, NULL);
    for (int32_t k = 0; k < hm_tri_triangles(t); k++)
        good = good && hm_tri_region(t, k) == 6;
    ok(good, "a gap lets the flood out, to beyond the hull");
    hm_tri_free(t);
}

/* One point triangulated without constraints, and a hull all of constraints. */
static void closed_hull(void)
{
    static const double xy[8] = {0, 0, 4, 0, 0, 4, 1, 1};
    struct hm_tri *t;
    struct hm_tri_components c;
    if (hm_tri_build(&t, xy, 4, 2, 1, NULL))
        exit(2);
    bool good = true;
    for (size_t i = 0; i < 3; i++) {
        struct hm_tri_segment s = {hm_tri_of_input(t, i), hm_tri_of_input(t, (i + 1) % 3), 8};
        good = good && !hm_tri_constrain(t, &s, 1, NULL, NULL);
    }
    good = good && !hm_tri_remove(t, hm_tri_of_input(t, 3), NULL);
    good = good && !hm_tri_components(t, 8, &c, NULL) && c.n == 2 && c.largest[0] == HM_TRI_NONE;
    int free_slots = 0;
    for (int32_t k = 0; good && k < hm_tri_triangles(t); k++)
        free_slots += c.of[k] == HM_TRI_NONE;
    ok(good && free_slots == 2 && area2(t, c.largest[1]) == 16,
       "ghosts alone have no largest triangle, free slots no component");
    hm_tri_components_free(&c);
    hm_tri_free(t);
}

/* A random drawing; some of its constraints in `marks` 2 instead of 1. */
static struct hm_tri *draw_lines(int points, int segments)
{
    double *xy = tri_points(SET_UNIFORM, points);
    struct hm_tri *t;
    if (!xy || hm_tri_build(&t, xy, (size_t)points, 2, 1, NULL))
        exit(2);
    for (int i = 0; i < segments; i++) {
        struct hm_tri_segment s = {(int32_t)(draw() % (uint64_t)points),
                                   (int32_t)(draw() % (uint64_t)points), 1 + i % 2};
        if (hm_tri_constrain(t, &s, 1, NULL, NULL))
            exit(2);
    }
    free(xy);
    return t;
}

/* Components by their definition: flooded one by one, each number from the lowest triangle. */
static void as_floods(void)
{
    int wrong = 0;
    int64_t components = 0;
    for (int round = 0; round < 200; round++) {
        struct hm_tri *t = draw_lines(60, round % 40);
        struct hm_tri_components c;
        int32_t stop = 1 + round % 3, n = 0, ghost = 0;
        wrong += hm_tri_components(t, stop, &c, NULL) != HM_OK;
        while (hm_tri_is_solid(t, ghost))
            ghost++;
        for (int32_t k = -1; k < hm_tri_triangles(t); k++) {
            int32_t start = k < 0 ? ghost : k;
            if (hm_tri_region(t, start) == 0)
                wrong += hm_tri_flood(t, start, stop, ++n, NULL) != HM_OK;
        }
        wrong += c.n != n;
        for (int32_t k = 0; k < hm_tri_triangles(t); k++) {
            wrong += c.of[k] != hm_tri_region(t, k) - 1;
            wrong += hm_tri_is_solid(t, k) && area2(t, k) > area2(t, c.largest[c.of[k]]);
        }
        components += n;
        hm_tri_components_free(&c);
        hm_tri_free(t);
    }
    ok(wrong == 0 && components > 2000, "%lld components, as flooded one by one",
       (long long)components);
}

/* Constraints let go one after the other: constrained Delaunay after each, and Delaunay at last. */
static void let_go(void)
{
    bool good = true;
    int gone = 0;
    for (int round = 0; good && round < 30; round++) {
        struct hm_tri *t = draw_lines(60, 30);
        for (int i = 0; good && i < 3000; i++) {
            int32_t e = (int32_t)(draw() % (uint64_t)(3 * hm_tri_triangles(t)));
            if (!hm_tri_marks(t, e))
                continue;
            gone++;
            good = !hm_tri_unmark(t, e, 3, NULL) && is_sound(t);
        }
        for (int32_t e = 0; good && e < 3 * hm_tri_triangles(t); e++)
            while (good && hm_tri_marks(t, e))
                good = !hm_tri_unmark(t, e, 3, NULL);
        for (int32_t k = 0; good && k < hm_tri_triangles(t); k++)
            for (int32_t v = 0; hm_tri_is_solid(t, k) && v < hm_tri_vertices(t); v++)
                good = good && hm_pred_incircle_unique(hm_tri_xy(t, hm_tri_org(t, 3 * k)),
                                                       hm_tri_xy(t, hm_tri_dest(t, 3 * k)),
                                                       hm_tri_xy(t, hm_tri_apex(t, 3 * k)),
                                                       hm_tri_xy(t, v)) <= 0;
        good = good && is_sound(t);
        hm_tri_free(t);
    }
    ok(good && gone > 1000, "%d constraints let go one by one: Delaunay again", gone);
}

int main(void)
{
    pond();
    closed_hull();
    as_floods();
    let_go();
    return done();
}
