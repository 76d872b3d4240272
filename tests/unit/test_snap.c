/* Control points snapped to breaklines of known shape. */
#include "hm_snap.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 500 };

struct scene {
    struct hm_lines set;
    struct hm_breaklines *b;
    double rough[3 * MOST], reach[MOST], xy[2 * MOST];
    bool moved[MOST];
    size_t n;
};

static void add_line(struct scene *s, const char *attrs, bool closed, const double *xyz, size_t n)
{
    struct hm_line line = {.attrs = strdup(attrs), .n = n, .closed = closed};
    line.xyz = malloc(n * 3 * sizeof *line.xyz);
    memcpy(line.xyz, xyz, n * 3 * sizeof *line.xyz);
    s->set.line = realloc(s->set.line, (s->set.n + 1) * sizeof line);
    s->set.line[s->set.n++] = line;
}

/* A breakline y = at + rise * sin(x / 20), from x0 to x1, a vertex every metre. */
static void add_wave(struct scene *s, const char *attrs, double x0, double x1, double at,
                     double rise)
{
    double xyz[3 * MOST];
    size_t n = (size_t)(x1 - x0) + 1;
    for (size_t i = 0; i < n; i++) {
        xyz[3 * i] = x0 + (double)i;
        xyz[3 * i + 1] = at + rise * sin(xyz[3 * i] / 20);
        xyz[3 * i + 2] = 1;
    }
    add_line(s, attrs, false, xyz, n);
}

/* A straight rough bank along the x axis, a control point every 10 m. */
static void straight_bank(struct scene *s, size_t n, double reach)
{
    s->n = n;
    for (size_t i = 0; i < n; i++) {
        s->rough[3 * i] = 10 * (double)i;
        s->rough[3 * i + 1] = s->rough[3 * i + 2] = 0;
        s->reach[i] = reach;
    }
}

static bool snap_it(struct scene *s, double ax, double ay)
{
    struct hm_diag d = {0};
    struct hm_bank bank = {s->n, s->rough, s->reach, {{ax, ay}, {ax, ay}}};
    return !hm_breaklines_build(&s->b, &s->set, 1, &d) &&
           !hm_snap_bank(s->b, &bank, s->xy, s->moved, &d);
}

static int count_moved(const struct scene *s)
{
    int n = 0;
    for (size_t i = 0; i < s->n; i++)
        n += s->moved[i];
    return n;
}

static void clear(struct scene *s)
{
    hm_breaklines_free(s->b);
    for (size_t k = 0; k < s->set.n; k++) {
        free(s->set.line[k].attrs);
        free(s->set.line[k].xyz);
    }
    free(s->set.line);
    memset(s, 0, sizeof *s);
}

static struct scene scene;

static void test_straight(void)
{
    struct scene *s = &scene;
    add_wave(s, "", -20, 220, 4, 0);
    add_wave(s, "surface=main side=left", -20, 220, 1, 0); /* a role: not a breakline */
    straight_bank(s, 21, 10);
    ok(snap_it(s, 0, 1) && s->b->n == 1, "lines with a role are no breaklines");
    double worst = 0;
    for (size_t i = 0; i < s->n; i++)
        worst = fmax(worst, hypot(s->xy[2 * i] - s->rough[3 * i], s->xy[2 * i + 1] - 4));
    near(worst, 0, 1e-12, "a parallel breakline: all points move straight to it");
    ok(count_moved(s) == 21, "all 21 moved");
    clear(s);
    add_wave(s, "", -20, 220, 10.5, 0);
    straight_bank(s, 21, 10);
    snap_it(s, 0, 1);
    ok(count_moved(s) == 0 && s->xy[2 * 7] == 70 && s->xy[2 * 7 + 1] == 0,
       "beyond the reach: all points stay");
    clear(s);
}

static void test_ends_slide(void)
{
    struct scene *s = &scene;
    add_wave(s, "", -20, 220, 3, 0);
    straight_bank(s, 21, 10);
    double c = sqrt(0.5);
    snap_it(s, c, c);
    near(s->xy[0], 3, 1e-12, "the end slides along a slanted section, x");
    near(s->xy[1], 3, 1e-12, "and y");
    clear(s);
}

/* Toe at 3, crest at 7 on the other side of the wandering rough line: stay on one. */
static void test_toe_and_crest(void)
{
    struct scene *s = &scene;
    add_wave(s, "", -20, 420, -2.5, 0);
    add_wave(s, "", -20, 420, 2.5, 0);
    straight_bank(s, 41, 10);
    for (size_t i = 0; i < s->n; i++)
        s->rough[3 * i + 1] = 0.9 * sin((double)i / 3) + 0.3;
    snap_it(s, 0, 1);
    int changes = 0;
    for (size_t i = 1; i < s->n; i++)
        changes += (s->xy[2 * i + 1] > 0) != (s->xy[2 * i - 1] > 0);
    ok(count_moved(s) == 41 && changes == 0, "between toe and crest: one of them (%d changes)",
       changes);
    ok(s->xy[1] > 0, "the nearer one");
    clear(s);
}

static void test_gap(void)
{
    struct scene *s = &scene;
    add_wave(s, "", -20, 72, 5, 0);
    add_wave(s, "", 118, 220, 5, 0);
    straight_bank(s, 21, 8);
    snap_it(s, 0, 1);
    ok(!s->moved[9] && !s->moved[10] && s->moved[6] && s->moved[13], "a gap in the breakline");
    near(s->xy[2 * 9 + 1], 5, 1e-9, "points in it are shifted as their neighbours are");
    near(s->xy[2 * 9], 90, 3, "and stay in their order");
    clear(s);
    add_wave(s, "", -20, 101, 5, 0);
    straight_bank(s, 31, 8);
    snap_it(s, 0, 1);
    ok(!s->moved[12] && s->xy[2 * 12 + 1] > 1 && s->xy[2 * 12 + 1] < 5, "behind its end: fading");
    ok(s->xy[2 * 17 + 1] == 0, "to nothing");
    clear(s);
}

static void test_crossing_line(void)
{
    struct scene *s = &scene;
    double ditch[] = {104, -40, 0, 104, 40, 0};
    add_wave(s, "", -20, 220, 5, 0);
    add_line(s, "", false, ditch, 2);
    straight_bank(s, 21, 8);
    snap_it(s, 0, 1);
    double worst = 0;
    for (size_t i = 0; i < s->n; i++)
        worst = fmax(worst, fabs(s->xy[2 * i + 1] - 5));
    near(worst, 0, 1e-12, "a breakline across the bank draws no point to it");
    clear(s);
}

/* A bend of radius 30 with the breakline inside it at 24, as a closed circle: feet crowd. */
static void test_bend(void)
{
    struct scene *s = &scene;
    enum { CORNERS = 200 };
    double circle[3 * CORNERS], pi = acos(-1);
    for (size_t i = 0; i < CORNERS; i++) {
        double a = 2 * pi * (double)i / CORNERS;
        circle[3 * i] = 24 * cos(a);
        circle[3 * i + 1] = 24 * sin(a);
        circle[3 * i + 2] = 0;
    }
    add_line(s, "limit=5 closed=1", true, circle, CORNERS);
    s->n = 19; /* a rough half circle with a kink in the middle: drawn with few clicks */
    for (size_t i = 0; i < s->n; i++) {
        double t = (double)i / 9;
        double corner[3][2] = {{30, 0}, {0, 33}, {-30, 0}};
        size_t k = i < 9 ? 0 : 1;
        t -= (double)k;
        for (int c = 0; c < 2; c++)
            s->rough[3 * i + (size_t)c] = corner[k][c] + t * (corner[k + 1][c] - corner[k][c]);
        s->reach[i] = 15;
    }
    ok(snap_it(s, 1, 0) && count_moved(s) == 19, "a bend: all points moved");
    double worst = 0, least = 99, most = 0, before = -1;
    for (size_t i = 0; i < s->n; i++) {
        double a = atan2(s->xy[2 * i + 1], s->xy[2 * i]);
        a += a < -1 ? 2 * pi : 0; /* the last point may lie a hair below the axis */
        worst = fmax(worst, fabs(hypot(s->xy[2 * i], s->xy[2 * i + 1]) - 24));
        if (i > 0) {
            least = fmin(least, a - before);
            most = fmax(most, a - before);
        }
        before = a;
    }
    ok(worst < 0.01, "onto the circle (%.4f m off)", worst);
    ok(least > 0, "forward all the way");
    ok(most < 3 * least, "at distances that differ by less than three (%.2f)", most / least);
    clear(s);
}

/* A noisy breakline in fragments, two of them overlapping. */
static void test_fragments(void)
{
    struct scene *s = &scene;
    add_wave(s, "", -20, 83, 4, 1.5);
    add_wave(s, "", 79, 160, 4.4, 1.5);
    add_wave(s, "", 164, 330, 4.1, 1.5);
    straight_bank(s, 31, 9);
    snap_it(s, 0, 1);
    double worst = 0;
    for (size_t i = 0; i < s->n; i++)
        worst = fmax(worst, fabs(s->xy[2 * i + 1] - 4.2 - 1.5 * sin(s->xy[2 * i] / 20)));
    ok(count_moved(s) >= 30 && worst < 0.3, "fragments end to end: %d moved, %.2f m off",
       count_moved(s), worst);
    clear(s);
}

/* One breakline along a toe, round the end of the bank and back along the crest, which cross the
 * rough line in turn: points on it must not glide round its end. */
static void test_hairpin(void)
{
    struct scene *s = &scene;
    enum { SIDE = 151 };
    double xyz[2 * SIDE * 3];
    for (int i = 0; i < SIDE; i++) {
        double x = 2.0 * i, *toe = xyz + 3 * i, *crest = xyz + 3 * (2 * SIDE - 1 - i);
        toe[0] = crest[0] = x;
        double t = fmin(1, fmax(0, (x - 100) / 100)); /* the two cross half way */
        toe[1] = 1 + 6 * t;
        crest[1] = 7 - 6 * t;
        toe[2] = crest[2] = 0;
    }
    add_line(s, "", false, xyz, 2 * SIDE);
    straight_bank(s, 30, 8);
    snap_it(s, 0, 1);
    double least = 99;
    for (size_t i = 1; i < s->n; i++)
        least = fmin(least, s->xy[2 * i] - s->xy[2 * i - 2]);
    ok(least > 2, "toe and crest in one line: forward all the way (%.2f)", least);
    clear(s);
}

/* A breakline y = at from x0 to x1, or back: as `breaklines` makes them, steep on the left. */
static void add_sided(struct scene *s, double x0, double x1, double at)
{
    double xyz[3 * MOST], step = x1 > x0 ? 1 : -1;
    size_t n = (size_t)fabs(x1 - x0) + 1;
    for (size_t i = 0; i < n; i++) {
        xyz[3 * i] = x0 + step * (double)i;
        xyz[3 * i + 1] = at;
        xyz[3 * i + 2] = 1;
    }
    add_line(s, "limit=8", false, xyz, n);
}

/* A left bank going east, the river south of it: the crest runs west, the toe, nearer to the river,
 * east. Between two pieces of crest there is a gap. */
static void test_sides(void)
{
    struct scene *s = &scene;
    for (int round = 0; round < 2; round++) {
        bool sided = round == 1;
        add_sided(s, sided ? 165 : -20, sided ? -20 : 165, 2);
        add_sided(s, sided ? 420 : 205, sided ? 205 : 420, 2);
        add_sided(s, -20, 420, -1.5);
        straight_bank(s, 41, 6);
        for (size_t i = 0; i < s->n; i++)
            s->rough[3 * i + 1] = 1.6;
        snap_it(s, 0, 1);
        int toe = 0;
        for (size_t i = 0; i < s->n; i++)
            toe += s->moved[i] && s->xy[2 * i + 1] < 0;
        ok(sided ? toe == 0 : toe > 0, "%s: %d points on the toe",
           sided ? "sides known, the bank stays on the crest" : "not known, it goes over", toe);
        clear(s);
    }
    add_sided(s, 220, -20, 2); /* a rough line that goes from the crest's middle to the toe's */
    add_sided(s, -20, 420, -4);
    straight_bank(s, 41, 6);
    for (size_t i = 0; i < s->n; i++)
        s->rough[3 * i + 1] = i < 18 ? 2 : -4;
    snap_it(s, 0, 1);
    ok(s->moved[8] && s->xy[2 * 8 + 1] == 2 && s->moved[35] && s->xy[2 * 35 + 1] == -4,
       "where the rough line goes over, so does the bank");
    clear(s);
}

int main(void)
{
    test_sides();
    test_straight();
    test_ends_slide();
    test_toe_and_crest();
    test_gap();
    test_crossing_line();
    test_bend();
    test_fragments();
    test_hairpin();
    return done();
}
