/* hm_fence: what is cut off is just what is inside or too near, and no more. */
#include "hm_attr.h"
#include "hm_fence.h"
#include "hm_polyline.h"
#include "meshes.h"
#include "tap.h"

/* A mesh over [0, 40] × [0, 20]. */
static struct hm_mesh river;
static struct hm_fence *fence;

/* The shortest distance of (x, y) to that rectangle's border, negative inside. */
static double clear_of(double x, double y)
{
    double dx = fmax(fmax(-x, x - 40), 0), dy = fmax(fmax(-y, y - 20), 0);
    if (dx > 0 || dy > 0)
        return hypot(dx, dy);
    return -fmin(fmin(x, 40 - x), fmin(y, 20 - y));
}

static double least_clear(const struct hm_lines *l)
{
    double least = INFINITY;
    for (size_t k = 0; k < l->n; k++)
        for (int i = 0; i <= 1000; i++) {
            double xyz[3];
            hm_polyline_at(&l->line[k], hm_polyline_length(&l->line[k]) * i / 1000, xyz);
            least = fmin(least, clear_of(xyz[0], xyz[1]));
        }
    return least;
}

static double whole_length(const struct hm_lines *l)
{
    double length = 0;
    for (size_t k = 0; k < l->n; k++)
        length += hm_polyline_length(&l->line[k]);
    return length;
}

static void cut(double *xyz, size_t n, bool closed, struct hm_lines *out)
{
    struct hm_line line = {.attrs = "limit=8 closed=1", .xyz = xyz, .n = n, .closed = closed};
    *out = (struct hm_lines){0};
    hm_fence_cut(fence, &line, 2, out, NULL);
}

static void test_cut(void)
{
    struct hm_lines l;
    double across[] = {20, -30, 0, 20, 50, 8};
    cut(across, 2, false, &l);
    ok(l.n == 2, "a line across the mesh becomes two");
    near(whole_length(&l), 28 + 28, 1e-9, "cut at the clearance");
    near(l.line[0].xyz[5], 2.8, 1e-12, "heights along the line");
    hm_lines_free(&l);

    double corner[] = {-10, 31, 0, 50, -11, 0, 70, -11, 0};
    cut(corner, 3, false, &l);
    near(least_clear(&l), 2, 1e-9, "a slanting line ends at the clearance, not before");
    ok(l.n == 2 && !hm_attr_flag(l.line[0].attrs, "closed"), "open pieces are not called closed");
    hm_lines_free(&l);

    double along[] = {-20, 21.5, 0, 10, 21, 0, 30, 20.5, 0, 60, 21, 0};
    cut(along, 4, false, &l);
    ok(l.n == 2 && least_clear(&l) > 2 - 1e-9, "a line hugging the boundary is left out there");
    hm_lines_free(&l);

    double clear[] = {-20, 23, 0, 60, 23, 0};
    cut(clear, 2, false, &l);
    ok(l.n == 1 && l.line[0].n == 2 && l.line[0].xyz[3] == 60, "a clear line stays as it is");
    hm_lines_free(&l);

    double inside[] = {10, 10, 0, 30, 12, 0};
    cut(inside, 2, false, &l);
    ok(l.n == 0, "a line inside disappears");
    hm_lines_free(&l);

    double ring[] = {20, 40, 0, 20, 10, 0, 60, 10, 0, 60, 40, 0};
    cut(ring, 4, true, &l);
    ok(l.n == 1 && l.line[0].n == 5, "a closed line cut once is one piece across its start");
    near(whole_length(&l), 18 + 40 + 30 + 18, 1e-9, "of the right length");
    hm_lines_free(&l);

    double around[] = {-9, -9, 0, 49, -9, 0, 49, 29, 0, -9, 29, 0};
    cut(around, 4, true, &l);
    ok(l.n == 1 && l.line[0].closed, "a ring around the mesh stays closed");
    hm_lines_free(&l);
}

/* Twice the area that joined segments and the boundary, both with the ground left, enclose. */
static double shoelace(const struct hm_segment *s, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += s[k].a[0] * s[k].b[1] - s[k].b[0] * s[k].a[1];
    return sum;
}

static void test_join(void)
{
    struct hm_segment *s;
    size_t n;
    /* an outline that crosses the mesh at x = 11 and 29, between its nodes */
    double xyz[] = {11, 10, 0, 29, 10, 0, 29, 50, 0, 11, 50, 0};
    struct hm_line ring = {.xyz = xyz, .n = 4, .closed = true};
    hm_fence_join(fence, &ring, 0.5, &s, &n, NULL);
    int at_nodes = 0;
    for (size_t k = 0; k < n; k++)
        for (int end = 0; end < 2; end++) {
            const double *p = end ? s[k].b : s[k].a;
            at_nodes += p[1] == 20 && (p[0] == 10 || p[0] == 30);
        }
    ok(n == 3 && at_nodes == 2, "an outline across is bent to the nearest nodes");
    near(shoelace(s, n) - 20 * 20, 2 * (20 + 18) / 2.0 * 30, 1e-9, "and closed by the boundary");
    free(s);
    double touching[] = {9.8, 20.1, 0, 30.3, 20.2, 0, 20, 50, 0};
    ring = (struct hm_line){.xyz = touching, .n = 3, .closed = true};
    hm_fence_join(fence, &ring, 0.5, &s, &n, NULL);
    bool moved = false;
    for (size_t k = 0; k < n; k++)
        moved = moved || (s[k].a[0] == 30 && s[k].a[1] == 20);
    ok(moved, "vertices near the boundary move to its nodes");
    free(s);
}

int main(void)
{
    struct hm_diag d = {0};
    lattice(&river, 0, 40, 8, 0, 20, 4, true);
    ok(hm_fence_build(&fence, &river, 1, &d) == HM_OK, "fence of one mesh");
    ok(hm_fence_is_inside(fence, 20, 10) && !hm_fence_is_inside(fence, 20, 21), "inside, outside");
    ok(hm_fence_is_near(fence, 20, 21.5, 2) && !hm_fence_is_near(fence, 20, 22.5, 2), "near, not");
    test_cut();
    test_join();
    hm_fence_free(fence);

    struct hm_mesh two[2] = {0};
    lattice(&two[0], 0, 40, 8, 0, 20, 4, true);
    lattice(&two[1], 10, 20, 2, 5, 15, 2, false);
    ok(hm_fence_build(&fence, two, 2, &d) == HM_EGEOM && strstr(d.text, "stitch"),
       "a mesh within another is refused: %s", d.text);
    ok(hm_fence_build(&fence, NULL, 0, NULL) == HM_OK && !hm_fence_is_near(fence, 0, 0, 1e9),
       "a fence without meshes");
    hm_fence_free(fence);
    hm_mesh_free(&river);
    hm_mesh_free(&two[0]);
    hm_mesh_free(&two[1]);
    return done();
}
