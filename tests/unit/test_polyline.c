/* Polylines and the segment index, against counting by hand and against looking at everything. */
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_pred.h"
#include "hm_segindex.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static uint64_t seed = 20240607;

static double chance(void) /* 0 .. 1, the same numbers in every run */
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

static struct hm_line line_of(double *xyz, size_t n, bool closed)
{
    return (struct hm_line){.attrs = "", .xyz = xyz, .n = n, .closed = closed};
}

static void test_length(void)
{
    double bend[] = {0, 0, 1, 3, 4, 2, 3, 10, NAN};
    struct hm_line open = line_of(bend, 3, false), ring = line_of(bend, 3, true);
    double p[3];
    near(hm_polyline_length(&open), 11, 0, "length of an open line");
    near(hm_polyline_length(&ring), 11 + hypot(3, 10), 1e-15, "length of a closed line");
    hm_polyline_at(&open, 2.5, p);
    ok(p[0] == 1.5 && p[1] == 2 && p[2] == 1.5, "a point half way along a piece");
    hm_polyline_at(&open, 5, p);
    ok(p[2] == 2, "a vertex keeps its z beside a missing one");
    hm_polyline_at(&open, 99, p);
    ok(p[0] == 3 && p[1] == 10, "beyond the end: the end");
    hm_polyline_at(&ring, hm_polyline_length(&ring) + 5, p);
    ok(fabs(p[0] - 3) < 1e-12 && fabs(p[1] - 4) < 1e-12, "a closed line goes around");
}

static void test_resample(void)
{
    double bend[] = {0, 0, 0, 0, 0, 0, 3, 4, 5, 3, 10, 11}, *out;
    size_t n;
    struct hm_diag d = {0};
    struct hm_line line = line_of(bend, 4, false);
    ok(!hm_polyline_resample(&line, 2, &out, &n, &d) && n == 7, "11 m at 2 m: six pieces or five");
    double worst = 0;
    for (size_t i = 0; i < n; i++) {
        double at[3];
        hm_polyline_at(&line, 11.0 * (double)i / 6, at);
        worst = fmax(worst, hypot(at[0] - out[3 * i], at[1] - out[3 * i + 1]));
        worst = fmax(worst, fabs(out[3 * i + 2] - 11.0 * (double)i / 6));
    }
    near(worst, 0, 1e-14, "equal distances along the line, z carried");
    ok(!memcmp(out + 3 * (n - 1), bend + 9, 24), "the end is kept bit for bit");
    free(out);
    double square[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    struct hm_line ring = line_of(square, 4, true);
    ok(!hm_polyline_resample(&ring, 2, &out, &n, &d) && n == 8, "a ring does not repeat its start");
    ok(out[3 * 7] == 0 && out[3 * 7 + 1] == 2,
       "the last point of a ring lies on its closing piece");
    free(out);
    ok(!hm_polyline_resample(&ring, 100, &out, &n, &d) && n == 3, "a ring keeps three points");
    free(out);
    double same[] = {1, 1, 1, 1, 1, 1};
    line = line_of(same, 2, false);
    ok(hm_polyline_resample(&line, 1, &out, &n, &d) == HM_EGEOM && d.has_place && !out,
       "a line without length is refused, with its place");
}

static void test_polygon(void)
{
    double c[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 2, 2, 0, 0, 4, 0}; /* a notch from above */
    struct hm_line ring = line_of(c, 5, true);
    near(hm_polygon_area2(&ring), 24, 0, "twice the area, counter-clockwise");
    ok(hm_polygon_side(&ring, 2, 1) == 1, "inside");
    ok(hm_polygon_side(&ring, 2, 3) == -1, "in the notch: outside");
    ok(hm_polygon_side(&ring, 2, 2) == 0 && hm_polygon_side(&ring, 1, 0) == 0 &&
           hm_polygon_side(&ring, 3, 3) == 0 && hm_polygon_side(&ring, 4, 4) == 0,
       "on a corner, on a level side, on a slanted side");
    ok(hm_polygon_side(&ring, -1, 0) == -1 && hm_polygon_side(&ring, -1, 4) == -1 &&
           hm_polygon_side(&ring, 5, 2) == -1,
       "outside, level with corners");
    ok(hm_polygon_side(&ring, 3, nextafter(3, 4)) == -1 &&
           hm_polygon_side(&ring, 3, nextafter(3, 0)) == 1,
       "one bit beside a slanted side");
}

static bool crosses(double *xyz, size_t n, bool closed, double xy[2])
{
    struct hm_line line = line_of(xyz, n, closed);
    bool yes = false;
    struct hm_diag d = {0};
    ok(!hm_polyline_crosses_itself(&line, &yes, xy, &d), "a line of %zu points is looked at", n);
    return yes;
}

static void test_crossing(void)
{
    double xy[2], eight[] = {0, 0, 0, 4, 4, 0, 4, 0, 0, 0, 4, 0};
    ok(crosses(eight, 4, false, xy) && xy[0] == 2 && xy[1] == 2, "a loop crosses at 2 2");
    double bow[] = {0, 0, 0, 4, 4, 0, 4, 0, 0, 0, 4, 0};
    ok(crosses(bow, 4, true, xy), "a bow tie");
    double square[] = {0, 0, 0, 4, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    ok(!crosses(square, 5, true, xy), "a square with a doubled corner does not");
    double spike[] = {0, 0, 0, 4, 0, 0, 2, 0, 0, 2, 3, 0};
    ok(crosses(spike, 4, false, xy) && xy[0] == 4, "turning straight back does");
    double touch[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 2, 0, 0};
    ok(crosses(touch, 4, false, xy) && xy[0] == 2 && xy[1] == 0, "touching itself does");
    enum { N = 4000 };
    double *spiral = malloc(3 * N * sizeof *spiral);
    for (int i = 0; i < N; i++) {
        double r = 10 + 0.01 * i, a = 0.05 * i;
        spiral[3 * i] = r * cos(a);
        spiral[3 * i + 1] = r * sin(a);
        spiral[3 * i + 2] = 0;
    }
    ok(!crosses(spiral, N, false, xy), "a spiral does not");
    spiral[3 * (N / 2)] *= 1.2;
    spiral[3 * (N / 2) + 1] *= 1.2;
    ok(crosses(spiral, N, false, xy), "until a vertex strays over the next turn");
    free(spiral);
}

/* --- the index --- */

enum { SEGMENTS = 600 };

static void random_segments(struct hm_segment *s, int shape)
{
    for (int i = 0; i < SEGMENTS; i++) {
        double size = shape == 1 ? 100 : 3;
        double x = chance() * 100, y = shape == 2 ? 7 : chance() * 100;
        s[i] = (struct hm_segment){.a = {x, y, 1}, .line = i / 10, .piece = i % 10};
        s[i].b[0] = x + (chance() - 0.5) * size;
        s[i].b[1] = shape == 2 ? y : y + (chance() - 0.5) * size;
        s[i].b[2] = 2;
        if (i % 50 == 0)
            memcpy(s[i].b, s[i].a, sizeof s[i].a); /* some without length */
    }
}

static const struct hm_segment *look(const struct hm_segment *s, double x, double y, double reach,
                                     double *distance)
{
    const struct hm_segment *best = NULL;
    *distance = INFINITY;
    for (int i = 0; i < SEGMENTS; i++) {
        double t = hm_plane_foot((const double[]){x, y}, s[i].a, s[i].b);
        double r = hypot(s[i].a[0] + t * (s[i].b[0] - s[i].a[0]) - x,
                         s[i].a[1] + t * (s[i].b[1] - s[i].a[1]) - y);
        if (r <= reach && r < *distance) {
            *distance = r;
            best = &s[i];
        }
    }
    return best;
}

static void test_nearest(const struct hm_segindex *x, const struct hm_segment *s, const char *what)
{
    int wrong = 0;
    for (int i = 0; i < 500; i++) {
        double px = chance() * 300 - 100, py = chance() * 300 - 100, foot[3], got = 0, want;
        double reach = i % 3 == 0 ? INFINITY : chance() * 20;
        const struct hm_segment *a = hm_segindex_nearest(x, px, py, reach, foot, &got);
        const struct hm_segment *b = look(s, px, py, reach, &want);
        wrong += !a != !b || (a && fabs(got - want) > 1e-12 * want) ||
                 (a && fabs(hypot(foot[0] - px, foot[1] - py) - want) > 1e-12 * want);
    }
    ok(wrong == 0, "%s: nearest as by looking at all (%d wrong)", what, wrong);
}

struct heap {
    int n, last;
    bool ordered;
};

static bool count_visit(void *arg, const struct hm_segment *s)
{
    struct heap *h = arg;
    int number = s->line * 10 + s->piece;
    h->ordered = h->ordered && number > h->last;
    h->last = number;
    h->n++;
    return true;
}

static bool in_box(const struct hm_segment *s, const double lo[2], const double hi[2])
{
    const double *a = s->a, *b = s->b;
    double corner[5][2] = {
        {lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}, {lo[0], lo[1]}};
    double xy[2];
    if (a[0] >= lo[0] && a[0] <= hi[0] && a[1] >= lo[1] && a[1] <= hi[1])
        return true;
    for (int k = 0; k < 4; k++)
        if (hm_plane_meet_at(a, b, corner[k], corner[k + 1], xy))
            return true;
    return false;
}

static void test_box(const struct hm_segindex *x, const struct hm_segment *s, const char *what)
{
    int wrong = 0;
    for (int i = 0; i < 300; i++) {
        double lo[2], hi[2];
        for (int k = 0; k < 2; k++) {
            lo[k] = chance() * 120 - 10;
            hi[k] = lo[k] + chance() * (i % 2 ? 10 : 120);
        }
        struct heap h = {0, -1, true};
        hm_segindex_box(x, lo, hi, count_visit, &h);
        int want = 0;
        for (int k = 0; k < SEGMENTS; k++)
            want += in_box(&s[k], lo, hi);
        wrong += want != h.n || !h.ordered;
    }
    ok(wrong == 0, "%s: boxes as by looking at all, each once, in order (%d wrong)", what, wrong);
}

static void test_index(void)
{
    static const char *name[] = {"short segments", "long segments", "all on a line"};
    static struct hm_segment s[SEGMENTS];
    struct hm_segindex *x;
    struct hm_diag d = {0};
    for (int shape = 0; shape < 3; shape++) {
        random_segments(s, shape);
        ok(!hm_segindex_build(&x, s, SEGMENTS, &d), "an index of %s", name[shape]);
        test_nearest(x, s, name[shape]);
        test_box(x, s, name[shape]);
        hm_segindex_free(x);
    }
    double foot[3], r;
    ok(!hm_segindex_build(&x, NULL, 0, &d) && !hm_segindex_nearest(x, 0, 0, 1e9, foot, &r),
       "an empty index finds nothing");
    hm_segindex_free(x);
    struct hm_segment two[] = {{{0, 1, 0}, {2, 1, 0}, 5, 1}, {{0, -1, 0}, {2, -1, 0}, 5, 0}};
    ok(!hm_segindex_build(&x, two, 2, &d), "two in the wrong order");
    const struct hm_segment *got = hm_segindex_nearest(x, 1, 0, 1, foot, &r);
    ok(got && got->piece == 0 && r == 1, "ties go to the lowest number");
    hm_segindex_free(x);
}

static void test_meet(void)
{
    double a[] = {0, 0}, b[] = {4, 0}, c[] = {2, 1}, e[] = {2, 0}, f[] = {9, 0}, g[] = {5, 0};
    double up[] = {2, -3}, xy[2];
    ok(hm_plane_meet_at(a, b, c, up, xy) && xy[0] == 2 && xy[1] == 0, "crossing");
    ok(hm_plane_meet_at(a, b, c, e, xy), "touching from the side");
    ok(hm_plane_meet_at(a, b, e, f, xy), "overlapping on a line");
    ok(!hm_plane_meet_at(a, b, g, f, xy), "apart on a line");
    ok(!hm_plane_meet_at(a, b, c, f, xy), "apart");
    ok(hm_plane_meet_at(e, e, a, b, xy) && !hm_plane_meet_at(c, c, a, b, xy),
       "a point and a segment");
}

int main(void)
{
    test_length();
    test_resample();
    test_polygon();
    test_crossing();
    test_index();
    test_meet();
    return done();
}
