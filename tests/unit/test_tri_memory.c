/* Memory runs out at every single place in turn: an error each time, never a broken triangulation.
 */
#include <stdlib.h>

static long allowed; /* allocations until the one that fails; none fails after it */

static int refuse(void)
{
    return allowed-- == 0;
}

static void *meagre_malloc(size_t bytes)
{
    return refuse() ? NULL : malloc(bytes);
}

static void *meagre_calloc(size_t count, size_t bytes)
{
    return refuse() ? NULL : calloc(count, bytes);
}

static void *meagre_realloc(void *old, size_t bytes)
{
    return refuse() ? NULL : realloc(old, bytes);
}

/* The library's own memory functions, on these: defined here, they are not taken from the library.
 */
#define malloc meagre_malloc
#define calloc meagre_calloc
#define realloc meagre_realloc
#include "hm_base.c"
#undef malloc
#undef calloc
#undef realloc

#include "hm_tri_refine.h"
#include "tap.h"
#include "tri_points.h"

enum { N = 200 };

/* A few vertices by refinement, with a size for each place and gradation. */
static double area_at(void *arg, double x, double y, int32_t region)
{
    (void)arg, (void)y, (void)region;
    return x < 0.5 ? 0.002 : 0.01;
}

static enum hm_err refine(struct hm_tri *t, struct hm_diag *d)
{
    struct hm_tri_quality q = {.min_angle = 20,
                               .area_at = area_at,
                               .growth = 0.3,
                               .hull_marks = 1,
                               .outside = 7,
                               .most = 300};
    return hm_tri_refine(t, &q, NULL, d);
}

/* All that can be done to a triangulation; returns the first error, HM_OK when it got to the end.
 */
static enum hm_err exercise(struct hm_tri *t, const double *xy, struct hm_diag *d)
{
    struct hm_tri_segment s[12];
    for (int i = 0; i < 12; i++)
        s[i] = (struct hm_tri_segment){(37 * i + 5) % N, (53 * i + 111) % N, 1};
    int32_t tri[N], v = 0;
    enum hm_err err = hm_tri_locate_all(t, xy, N, 2, 1, tri, d);
    if (!err)
        err = hm_tri_constrain(t, s, 12, NULL, d);
    if (!err)
        err = hm_tri_flood(t, 0, 1, 3, d);
    struct hm_tri_components c;
    if (!err && !(err = hm_tri_components(t, 1, &c, d)))
        hm_tri_components_free(&c);
    if (!err)
        err = refine(t, d);
    for (int32_t e = 0; !err && e < 60; e++)
        err = hm_tri_unmark(t, e, 1, d);
    for (int i = 0; !err && i < 400; i++) {
        double x = 1.2 * uniform() - 0.1, y = 1.2 * uniform() - 0.1;
        enum hm_err done = HM_OK;
        if (i % 4 < 2)
            done = hm_tri_insert(t, x, y, HM_TRI_NONE, &v, d);
        else if (i % 4 == 2)
            done = hm_tri_remove(t, v, NULL);
        else
            done = hm_tri_move(t, v - 1, x, y, NULL);
        err = done == HM_ENOMEM ? done : HM_OK; /* refused edits are none of our business here */
    }
    for (int32_t e = 0; !err && e < 90; e++)
        if (hm_tri_org(t, e) >= 0 && hm_tri_dest(t, e) >= 0) {
            const double *p = hm_tri_xy(t, hm_tri_org(t, e)), *q = hm_tri_xy(t, hm_tri_dest(t, e));
            double x = (p[0] + q[0]) / 2, y = (p[1] + q[1]) / 2;
            err = hm_tri_split(t, e, x, y, &v, NULL) == HM_ENOMEM ? HM_ENOMEM : HM_OK;
        }
    return err;
}

int main(void)
{
    double *xy = tri_points(SET_UNIFORM, N);
    memmove(xy + 20, xy, 10 * sizeof *xy); /* some twice */
    uint64_t seed = tri_seed;
    long fails = 0, wrong = 0, broken = 0;
    for (bool complete = false; !complete; fails++) {
        struct hm_tri *t = NULL;
        struct hm_diag d = {0};
        tri_seed = seed;
        allowed = fails;
        enum hm_err err = hm_tri_build(&t, xy, N, 2, 1, &d);
        if (!err)
            err = exercise(t, xy, &d);
        complete = allowed >= 0;
        wrong += err != (complete ? HM_OK : HM_ENOMEM) || d.err == HM_EGEOM;
        allowed = -1;
        broken += t && hm_tri_check_topology(t, NULL);
        hm_tri_free(t);
    }
    ok(fails > 20, "%ld places where memory can run out", fails - 1);
    ok(wrong == 0, "each is reported as such");
    ok(broken == 0, "and leaves the triangulation sound");
    free(xy);
    return done();
}
