/* hm_hull: against the definition. */
#include "hm_hull.h"
#include "hm_pred.h"
#include "tap.h"

#include <stdlib.h>

static uint64_t state = 7;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

/* Strictly convex, counter-clockwise, and no point outside. */
static bool is_hull(const double *xy, size_t n, const size_t *hull, size_t nhull)
{
    for (size_t k = 0; k < nhull; k++) {
        const double *a = xy + 2 * hull[k], *b = xy + 2 * hull[(k + 1) % nhull];
        if (hm_pred_orient(a, b, xy + 2 * hull[(k + 2) % nhull]) <= 0)
            return false;
        for (size_t i = 0; i < n; i++)
            if (hm_pred_orient(a, b, xy + 2 * i) < 0)
                return false;
    }
    return true;
}

static void test(const double *xy, size_t n, size_t want, const char *what)
{
    size_t *hull, nhull;
    bool good = hm_hull_build(xy, n, 2, &hull, &nhull, NULL) == HM_OK;
    ok(good && is_hull(xy, n, hull, nhull) && (want == 0 || want == nhull), "%s", what);
    free(hull);
}

int main(void)
{
    enum { N = 3000 };
    static double xy[2 * N];
    for (int i = 0; i < 2 * N; i++)
        xy[i] = uniform();
    test(xy, N, 0, "random points");
    for (int i = 0; i < 2 * N; i++)
        xy[i] = floor(40 * xy[i]); /* many equal, many on the border */
    for (int i = 0; i < 4; i++) {
        xy[2 * i] = i % 2 ? 40 : -1;
        xy[2 * i + 1] = i / 2 ? 40 : -1;
    }
    test(xy, N, 4, "a lattice with duplicates has four corners");
    for (int i = 0; i < N; i++) {
        xy[2 * i] = 500000 + cos(i);
        xy[2 * i + 1] = 5000000 + sin(i);
    }
    test(xy, N, 0, "points on a circle far from the origin");
    size_t *hull, n;
    struct hm_diag d = {0};
    for (int i = 0; i < N; i++)
        xy[2 * i + 1] = 2 * (xy[2 * i] = i);
    ok(hm_hull_build(xy, N, 2, &hull, &n, &d) == HM_EGEOM && !hull, "all on a line: %s", d.text);
    for (int i = 0; i < 2 * N; i++)
        xy[i] = 1;
    ok(hm_hull_build(xy, N, 2, &hull, &n, NULL) == HM_EGEOM && !hull, "all equal");
    ok(hm_hull_build(xy, 0, 2, &hull, &n, NULL) == HM_EGEOM && !hull, "none");
    return done();
}
