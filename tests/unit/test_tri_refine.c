/* Refinement: bounds are kept, what was there stays, small angles of the input end it all the same.
 */
#include "hm_pred.h"
#include "hm_tri_refine.h"
#include "tap.h"
#include "tri_points.h"

#include <string.h>

/* A closed outline of n points, everything beyond it region -1. */
static struct hm_tri *polygon(const double *xy, int n, int points)
{
    struct hm_tri *t;
    struct hm_tri_segment s[64];
    if (hm_tri_build(&t, xy, (size_t)points, 2, 1, NULL))
        exit(2);
    for (int i = 0; i < n; i++)
        s[i] = (struct hm_tri_segment){hm_tri_of_input(t, (size_t)i),
                                       hm_tri_of_input(t, (size_t)((i + 1) % n)), 1};
    int32_t beyond = 0;
    while (hm_tri_is_solid(t, beyond))
        beyond++;
    if (hm_tri_constrain(t, s, (size_t)n, NULL, NULL) || hm_tri_flood(t, beyond, 1, -1, NULL))
        exit(2);
    return t;
}

static double angle_at(const double *o, const double *a, const double *b)
{
    double ax = a[0] - o[0], ay = a[1] - o[1], bx = b[0] - o[0], by = b[1] - o[1];
    return fabs(atan2(ax * by - ay * bx, ax * bx + ay * by)) * 180 / acos(-1);
}

struct measure {
    int triangles;
    double area, smallest, largest, mark_length;
    double x, y; /* of the smallest angle */
};

static struct measure measure(const struct hm_tri *t, int32_t outside)
{
    struct measure m = {.smallest = 180};
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        if (!hm_tri_is_solid(t, e / 3))
            continue;
        const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
        const double *c = hm_tri_xy(t, hm_tri_apex(t, e));
        if (hm_tri_region(t, e / 3) == outside)
            continue;
        if (hm_tri_marks(t, e))
            m.mark_length += hypot(a[0] - b[0], a[1] - b[1]);
        m.triangles += e % 3 == 0;
        m.area += hm_area2(a, b, c) / 6;
        m.largest = fmax(m.largest, hm_area2(a, b, c) / 2);
        if (angle_at(c, a, b) < m.smallest) {
            m.smallest = angle_at(c, a, b);
            m.x = c[0];
            m.y = c[1];
        }
    }
    return m;
}

static bool is_sound(const struct hm_tri *t)
{
    struct hm_diag d = {0};
    bool good = !hm_tri_check_topology(t, &d) && !hm_tri_check_delaunay(t, &d);
    if (!good)
        printf("# %s (%.17g %.17g)\n", d.text, d.x, d.y);
    return good;
}

static const double shape[16] = {0, 0, 10, 0, 10, 4, 6, 4, 6, 6, 10, 6, 10, 10, 0, 10};

static void bounds(void)
{
    static const double angle[4] = {0, 20, 30, 33}, area[3] = {0, 0.5, 0.02};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            struct hm_tri *t = polygon(shape, 8, 8);
            struct hm_tri_quality q = {
                .min_angle = angle[i], .max_area = area[k], .outside = -1, .hull_marks = 1};
            struct hm_tri_refined done;
            bool good = !hm_tri_refine(t, &q, &done, NULL) && is_sound(t);
            struct measure m = measure(t, -1);
            good = good && done.small == 0 && done.large == 0 && !done.capped &&
                   m.smallest >= angle[i] - 1e-9 && (area[k] == 0 || m.largest <= area[k]) &&
                   fabs(m.area - 92) < 1e-9 && fabs(m.mark_length - 48) < 1e-9 &&
                   fabs(m.smallest - done.smallest) < 1e-6;
            ok(good, "angle %g, area %g: %d triangles, smallest angle %.1f", angle[i], area[k],
               m.triangles, m.smallest);
            hm_tri_free(t);
        }
}

/* Counts what is listed, and that it is where it says. */
struct list {
    const struct hm_tri *t;
    int given, other;
    double corner; /* smallest given angle */
    bool good;
};

static void note(void *arg, const struct hm_tri_sharp *s)
{
    struct list *list = arg;
    const double *p = hm_tri_xy(list->t, s->v);
    list->good = list->good && p[0] == s->x && p[1] == s->y;
    list->given += s->given;
    list->other += !s->given;
    if (s->given)
        list->corner = fmin(list->corner, s->angle);
}

/* A corner over the bound forces nothing; one under it is spared and listed, and it alone. */
static void corners(void)
{
    for (int degrees = 24; degrees <= 60; degrees += 4) {
        double a = degrees * acos(-1) / 180;
        const double xy[6] = {0, 0, 10, 0, 9.3 * cos(a), 9.3 * sin(a)};
        struct hm_tri *t = polygon(xy, 3, 3);
        struct list list = {.t = t, .corner = 180, .good = true};
        struct hm_tri_quality q = {.min_angle = 30,
                                   .max_area = 0.3,
                                   .outside = -1,
                                   .hull_marks = 1,
                                   .sharp = note,
                                   .sharp_arg = &list,
                                   .most = 20000};
        struct hm_tri_refined done;
        bool good = !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) && list.good &&
                    !done.capped && list.given == done.given &&
                    list.given + list.other == done.small;
        ok(good && (degrees > 30 ? done.small == 0
                                 : done.given == 1 && fabs(list.corner - degrees) < 1e-9),
           "a corner of %d degrees: %d listed, %d near it", degrees, list.given, list.other);
        hm_tri_free(t);
    }
}

/* A needle of 3 degrees: refinement ends, and only triangles at the needle's point are small. */
static void needle(void)
{
    const double xy[10] = {0, 0, 20, 0, 20, 12, 8, 12, 20, 20 * tan(3 * acos(-1) / 180)};
    struct hm_tri *t = polygon(xy, 4, 5);
    struct hm_tri_segment s = {hm_tri_of_input(t, 0), hm_tri_of_input(t, 4), 2};
    struct hm_tri_quality q = {
        .min_angle = 30, .max_area = 0.1, .outside = -1, .hull_marks = 1, .most = 20000};
    struct hm_tri_refined done;
    bool good = !hm_tri_constrain(t, &s, 1, NULL, NULL) && !hm_tri_refine(t, &q, &done, NULL) &&
                is_sound(t);
    ok(good && !done.capped, "a needle of 3 degrees: %lld vertices, %lld small triangles",
       (long long)(done.on_segments + done.inside), (long long)done.small);
    int far = 0;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++)
        if (hm_tri_is_solid(t, e / 3) && hm_tri_region(t, e / 3) != -1) {
            const double *c = hm_tri_xy(t, hm_tri_apex(t, e));
            double here =
                angle_at(c, hm_tri_xy(t, hm_tri_org(t, e)), hm_tri_xy(t, hm_tri_dest(t, e)));
            far += here < 25 && c[1] > 1.2 * xy[9];
        }
    ok(far == 0 && done.smallest > 2.9, "all of them in the needle, none under its own angle");
    hm_tri_free(t);
}

static double finer_to_the_left(void *arg, double x, double y, int32_t region)
{
    (void)y;
    (void)region;
    return *(double *)arg * (0.01 + x * x / 50);
}

static void sizes(void)
{
    struct hm_tri *t = polygon(shape, 8, 8);
    double factor = 0.5;
    struct hm_tri_quality q = {.min_angle = 25,
                               .outside = -1,
                               .hull_marks = 1,
                               .area_at = finer_to_the_left,
                               .arg = &factor};
    struct hm_tri_refined done;
    bool good = !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) && !done.large && !done.small;
    ok(good, "a size that varies over space: %d triangles", measure(t, -1).triangles);
    hm_tri_free(t);
    t = polygon(shape, 8, 8);
    q.most = 100;
    good = !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) && done.capped &&
           done.on_segments + done.inside <= 100 && done.large > 0;
    ok(good, "the cap holds, and is told");
    hm_tri_free(t);
}

static void lengths(void)
{
    for (int angle = 0; angle <= 30; angle += 15) {
        struct hm_tri *t = polygon(shape, 8, 8);
        const double wanted = 0.3;
        struct hm_tri_quality q = {
            .min_angle = angle, .max_edge = wanted, .outside = -1, .hull_marks = 1, .most = 100000};
        struct hm_tri_refined done;
        bool good =
            !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) && !done.large && !done.capped;
        double longest = 0;
        for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
            if (!hm_tri_is_solid(t, e / 3) || hm_tri_region(t, e / 3) == -1)
                continue;
            const double *a = hm_tri_xy(t, hm_tri_org(t, e)), *b = hm_tri_xy(t, hm_tri_dest(t, e));
            longest = fmax(longest, hypot(b[0] - a[0], b[1] - a[1]));
        }
        ok(good && longest <= wanted && longest > wanted / 2, "%d degrees, no edge over %g: %.3f",
           angle, wanted, longest);
        hm_tri_free(t);
    }
}

/* Beside a short edge triangles are small, and grow with the way from it: no slower would be
 * needed, no faster is allowed. Sizes go along edges, which are a detour of a quarter at most here.
 */
static void growth(void)
{
    const double xy[12] = {0, 0, 100, 0, 100, 100, 0, 100, 50, 50, 50.1, 50};
    int before = 0;
    for (int i = 0; i < 3; i++) {
        double rate = (double[]){0, 0.4, 0.15}[i];
        struct hm_tri *t = polygon(xy, 4, 6);
        struct hm_tri_quality q = {
            .min_angle = 20, .growth = rate, .outside = -1, .hull_marks = 1, .most = 100000};
        struct hm_tri_refined done;
        bool good = !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) && !done.capped &&
                    done.small == 0 && done.large == 0;
        double worst = 0;
        int triangles = 0;
        for (int32_t k = 0; k < hm_tri_triangles(t); k++) {
            if (!hm_tri_is_solid(t, k) || hm_tri_region(t, k) == -1)
                continue;
            double way = 0;
            const double *p[3];
            for (int j = 0; j < 3; j++) {
                p[j] = hm_tri_xy(t, hm_tri_org(t, 3 * k + j));
                way += hypot(p[j][0] - 50, p[j][1] - 50) / 3;
            }
            double edge = sqrt(hm_area2(p[0], p[1], p[2]) / 2 / 0.433);
            worst = fmax(worst, edge / (0.1 + 1.25 * rate * way));
            triangles++;
        }
        ok(good && (i == 0 || (worst <= 1 && triangles > 2 * before)),
           "growth %g: %d triangles, %.2f of what is allowed", rate, triangles, worst);
        before = triangles;
        hm_tri_free(t);
    }
}

/* Constraints that must stay in one piece: the long bottom edge of the shape. */
static void whole(void)
{
    struct hm_tri *t = polygon(shape, 8, 8);
    int32_t a = hm_tri_of_input(t, 0), b = hm_tri_of_input(t, 1);
    struct hm_tri_segment s = {a, b, 2};
    struct hm_tri_quality q = {
        .min_angle = 25, .max_area = 0.1, .whole = 2, .outside = -1, .hull_marks = 1};
    struct hm_tri_refined done;
    bool good = !hm_tri_constrain(t, &s, 1, NULL, NULL) && !hm_tri_refine(t, &q, &done, NULL) &&
                is_sound(t) && hm_tri_edge_between(t, a, b) != HM_TRI_NONE;
    ok(good && done.on_segments > 0, "an edge stays whole, others are split: %lld on them",
       (long long)done.on_segments);
    int far = 0;
    for (int32_t k = 0; k < hm_tri_triangles(t); k++) {
        if (!hm_tri_is_solid(t, k) || hm_tri_region(t, k) == -1)
            continue;
        const double *p[3];
        bool near = false;
        for (int i = 0; i < 3; i++) {
            p[i] = hm_tri_xy(t, hm_tri_org(t, 3 * k + i));
            near = near || p[i][1] < 10 / 3.0;
        }
        double least = fmin(angle_at(p[0], p[1], p[2]),
                            fmin(angle_at(p[1], p[2], p[0]), angle_at(p[2], p[0], p[1])));
        far += !near && (least < 25 || hm_area2(p[0], p[1], p[2]) > 0.2);
    }
    ok(far == 0 && done.small + done.large > 0, "what is left bad is at it: %lld small, %lld large",
       (long long)done.small, (long long)done.large);
    hm_tri_free(t);
}

/* Random points, random constraints: whatever comes, it ends and is sound. */
static void random_drawings(void)
{
    bool good = true;
    int64_t added = 0, small = 0, capped = 0;
    for (int round = 0; good && round < 60; round++) {
        double xy[40];
        for (int i = 0; i < 40; i++)
            xy[i] = round % 2 ? uniform() : (double)(draw() % 12);
        struct hm_tri *t;
        if (hm_tri_build(&t, xy, 20, 2, 1, NULL))
            continue;
        for (int i = 0; good && i < 6; i++) {
            struct hm_tri_segment s = {hm_tri_of_input(t, draw() % 20),
                                       hm_tri_of_input(t, draw() % 20), 2};
            good = !hm_tri_constrain(t, &s, 1, NULL, NULL);
        }
        double before = measure(t, -2).area;
        struct hm_tri_quality q = {.min_angle = 25, .outside = -1, .hull_marks = 1, .most = 20000};
        struct hm_tri_refined done;
        good = good && !hm_tri_refine(t, &q, &done, NULL) && is_sound(t) &&
               fabs(measure(t, -1).area - before) < 1e-9 * before;
        added += done.on_segments + done.inside;
        small += done.small;
        capped += done.capped;
        hm_tri_free(t);
    }
    ok(good && capped == 0, "60 dirty drawings: %lld vertices added, %lld triangles small",
       (long long)added, (long long)small);
}

/* What is only as wide as rounding. Two points a last digit apart: beside them constraints cannot
 * be split, and vertices were put in and taken out for it without end. A hull edge whose triangle
 * has its apex next to one of its ends: its pieces could not be split, and what is there stayed
 * large.
 */
static void last_digits(void)
{
    const double xy[2][8] = {
        {3.0000000000000004, 0.8, 3, 0.8, 8.0000000000000018, 0.70000000000000007, 1, 0.4},
        {7.5, 6.5, 1, 7.2, 7.6, 3.2, 7.500003, 6.500001}};
    for (int i = 0; i < 2; i++) {
        struct hm_tri *t;
        struct hm_tri_quality q = {.outside = -1, .hull_marks = 8, .most = 20000};
        q.min_angle = i ? 0 : 24;
        q.max_edge = i ? 2.2 : 0;
        struct hm_tri_refined done;
        bool good = !hm_tri_build(&t, xy[i], 4, 2, 1, NULL) && !hm_tri_refine(t, &q, &done, NULL) &&
                    is_sound(t);
        ok(good && !done.capped && done.large == 0, "%s: %lld vertices added, %lld triangles large",
           i ? "an apex beside an end" : "two points as one",
           (long long)(done.on_segments + done.inside), (long long)done.large);
        hm_tri_free(t);
    }
}

static void refusals(void)
{
    struct hm_tri *t = polygon(shape, 8, 8);
    struct hm_tri_quality q = {.min_angle = 60, .hull_marks = 1};
    ok(hm_tri_refine(t, &q, NULL, NULL) == HM_EARG, "no angle of 60 degrees");
    q = (struct hm_tri_quality){.min_angle = NAN, .hull_marks = 1};
    ok(hm_tri_refine(t, &q, NULL, NULL) == HM_EARG, "nor one that is no number");
    q = (struct hm_tri_quality){.max_area = 1, .hull_marks = 0};
    ok(hm_tri_refine(t, &q, NULL, NULL) == HM_EARG, "the hull needs marks");
    hm_tri_free(t);
    q = (struct hm_tri_quality){.min_angle = 20, .hull_marks = 8};
    static const double scale[] = {1e-60, 1e-48, 1e48, 1e60};
    for (int i = 0; i < 4; i++) {
        double s = scale[i], xy[] = {0, 0, 10 * s, 0, 10 * s, s, 0, s};
        struct hm_tri_refined done;
        bool built = !hm_tri_build(&t, xy, 4, 2, 1, NULL), held = i == 1 || i == 2;
        enum hm_err err = built ? hm_tri_refine(t, &q, &done, NULL) : HM_ENOMEM;
        ok(err == (held ? HM_OK : HM_EGEOM) && (!held || done.smallest >= 20),
           "a rectangle %g long is %s", 10 * s, held ? "refined" : "refused");
        hm_tri_free(t);
    }
}

int main(void)
{
    bounds();
    corners();
    needle();
    sizes();
    lengths();
    growth();
    whole();
    random_drawings();
    last_digits();
    refusals();
    return done();
}
