/* The inside of a polygon whose border stays: what hm_infill makes of it. */
#include "hm_infill.h"
#include "hm_plane.h"
#include "tap.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = 200, IN = 2 };

struct scene {
    double xy[MOST][2];
    size_t n, border; /* points; the first of them are the border, in order */
    struct hm_tri *t;
};

static void add(struct scene *s, double x, double y)
{
    s->xy[s->n][0] = x;
    s->xy[s->n++][1] = y;
}

static bool triangulate(struct scene *s)
{
    struct hm_tri_segment segment[MOST];
    if (hm_tri_build(&s->t, &s->xy[0][0], s->n, 2, 1, NULL))
        return false;
    for (size_t i = 0; i < s->border; i++)
        segment[i] = (struct hm_tri_segment){hm_tri_of_input(s->t, i),
                                             hm_tri_of_input(s->t, (i + 1) % s->border), 1};
    int32_t middle;
    return !hm_tri_constrain(s->t, segment, s->border, NULL, NULL) &&
           (middle = hm_tri_locate(s->t, 20, 4, NULL)) != HM_TRI_NONE &&
           !hm_tri_flood(s->t, middle, 1, IN, NULL);
}

static bool is_in(const struct scene *s, int32_t k)
{
    return hm_tri_is_solid(s->t, k) && hm_tri_region(s->t, k) == IN;
}

static double least_angle(const struct scene *s, double *area)
{
    double least = 180;
    *area = 0;
    for (int32_t k = 0; k < hm_tri_triangles(s->t); k++) {
        if (!is_in(s, k))
            continue;
        const double *a = hm_tri_xy(s->t, hm_tri_org(s->t, 3 * k)),
                     *b = hm_tri_xy(s->t, hm_tri_dest(s->t, 3 * k)),
                     *c = hm_tri_xy(s->t, hm_tri_apex(s->t, 3 * k));
        least = fmin(least, fmin(hm_plane_angle(a, b, c),
                                 fmin(hm_plane_angle(b, c, a), hm_plane_angle(c, a, b))));
        *area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    }
    return least;
}

/* The border is as it was: each of its edges there and constrained. */
static bool border_stands(const struct scene *s)
{
    bool good = true;
    for (size_t i = 0; i < s->border; i++) {
        int32_t a = hm_tri_of_input(s->t, i), b = hm_tri_of_input(s->t, (i + 1) % s->border);
        int32_t e = hm_tri_edge_between(s->t, a, b);
        good = good && e != HM_TRI_NONE && hm_tri_marks(s->t, e) &&
               hm_plane_same(hm_tri_xy(s->t, a), s->xy[i]);
    }
    return good;
}

/* A strip 40 by 8, with a node every 10 m below and every 2 m above. */
static void strip(struct scene *s)
{
    *s = (struct scene){0};
    for (int i = 0; i <= 4; i++)
        add(s, 10 * i, 0);
    for (int i = 20; i >= 0; i--)
        add(s, 2 * i, 8);
    s->border = s->n;
}

static void compare(struct scene *s, double angle, double least, const char *what)
{
    double before, after, area, area_after;
    ok(triangulate(s), "%s: triangulated", what);
    before = least_angle(s, &area);
    ok(hm_infill_improve(s->t, IN, angle, NULL) == HM_OK, "%s: improved", what);
    after = least_angle(s, &area_after);
    ok(after >= least && after >= before, "%s: smallest angle %.1f, was %.1f", what, after, before);
    near(area_after, area, 1e-9 * area, "the same ground");
    ok(border_stands(s), "the border stays");
    ok(!hm_tri_check_topology(s->t, NULL) && !hm_tri_check_delaunay(s->t, NULL),
       "constrained Delaunay");
    hm_tri_free(s->t);
}

int main(void)
{
    struct scene s;
    strip(&s);
    compare(&s, 25, 20, "from coarse to fine");
    strip(&s);
    for (int i = 0; i < 60; i++) /* far too many, some of them close to the border */
        add(&s, 1 + 0.63 * i, 0.05 + fmod(2.7 * i, 7.9));
    compare(&s, 25, 15, "crowded");
    strip(&s);
    add(&s, 20, 4);
    compare(&s, 0, 0, "nothing asked");
    strip(&s);
    triangulate(&s);
    int32_t vertices = hm_tri_vertices(s.t);
    hm_infill_improve(s.t, IN + 1, 25, NULL);
    ok(hm_tri_vertices(s.t) == vertices, "elsewhere: nothing is touched");
    hm_tri_free(s.t);
    return done();
}
