/* Breaklines against an analytic bank, and the bookkeeping of lines: chaining, saddles, borders. */
#include "hm_bsample.h"
#include "hm_bspline.h"
#include "hm_contour.h"
#include "hm_lineedit.h"
#include "hm_polyline.h"
#include "hm_release.h"
#include "hm_simplify.h"
#include "hm_slope.h"
#include "hm_uncross.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180;

/* --- lines of a grid --- */

static enum hm_err keep(void *arg, const struct hm_line *found, struct hm_diag *d)
{
    struct hm_line line = *found;
    line.attrs = (char[]){""};
    hm_lineedit_tidy(&line);
    return line.n > 1 ? hm_lines_append(arg, &line, d) : HM_OK;
}

static struct hm_lines trace(const struct hm_lattice *l, const double *slope, const double *z,
                             double limit, enum hm_contour_mode mode, enum hm_contour_saddle saddle)
{
    struct hm_lines lines = {0};
    struct hm_contour *c;
    struct hm_contour_rule rule = {limit, mode, saddle, keep, &lines};
    bool good = !hm_contour_new(&c, l, &rule, NULL);
    for (int64_t j = 0; good && j < l->ny; j++)
        good = !hm_contour_row(c, slope + j * l->nx, z + j * l->nx, NULL);
    if (!good || hm_contour_end(c, NULL))
        ok(false, "tracing");
    hm_contour_free(c);
    return lines;
}

/* --- the analytic bank: scheme.md's test of the paper's claim ---
 *
 * z = h / (1 + exp(-s / 3)) over the distance s across the bank, in cells; steepest 20 degrees. */

enum { SIZE = 81 };
static const double scale = 3, steepest = 20, limit = 8;

struct bank {
    struct hm_lattice l;
    double *z, *slope, nx, ny; /* unit vector across the bank */
};

static struct bank make_bank(double angle)
{
    struct bank b = {.l = {SIZE, SIZE, -40.3, -39.8, 1, 1}, .nx = cos(angle), .ny = sin(angle)};
    double height = 4 * scale * tan(steepest * degree), *gx = malloc(sizeof *gx * SIZE);
    double *gy = malloc(sizeof *gy * SIZE), *start = malloc(sizeof *start * SIZE * SIZE);
    struct hm_bsurf s;
    b.z = malloc(sizeof *b.z * SIZE * SIZE);
    b.slope = malloc(sizeof *b.slope * SIZE * SIZE);
    hm_bsurf_init(&s, 2, SIZE, SIZE, 1, NULL);
    for (int64_t j = 0; j < SIZE; j++)
        for (int64_t i = 0; i < SIZE; i++) {
            double x = b.l.x0 + (double)i, y = b.l.y0 + (double)j;
            start[j * SIZE + i] = height / (1 + exp(-(x * b.nx + y * b.ny) / scale));
            *hm_bsurf_at(&s, i, j) = start[j * SIZE + i];
        }
    hm_bspline_drag(&s, start, 1, 0, 1, NULL, NULL);
    struct hm_bsample *sample;
    hm_bsample_new(&sample, &s, 1, NULL);
    for (size_t j = 0; j < SIZE; j++)
        hm_bsample_row(sample, j, b.z + j * SIZE, NULL, NULL);
    hm_bsample_free(sample);
    for (size_t j = 0; j < SIZE; j++) {
        const double *const rows[3] = {j > 0 ? b.z + (j - 1) * SIZE : NULL, b.z + j * SIZE,
                                       j + 1 < SIZE ? b.z + (j + 1) * SIZE : NULL};
        hm_slope_gradient(HM_SLOPE_OVER_DISTANCE, rows, SIZE, 1, 1, gx, gy);
        for (size_t i = 0; i < SIZE; i++)
            b.slope[j * SIZE + i] = hm_slope_of(gx[i], gy[i], HM_SLOPE_DEGREE);
    }
    hm_bsurf_free(&s);
    free(start);
    free(gx);
    free(gy);
    return b;
}

struct error {
    double worst, sum, vertices, length, straight;
    bool steep_left;
};

/* The true lines lie at s = ±3 ln(f / (1 - f)), where 4 f (1 - f) tan 20° = tan limit. */
static void measure(const struct bank *b, const struct hm_lines *lines, struct error *e)
{
    double part = tan(limit * degree) / tan(steepest * degree);
    double f = (1 + sqrt(1 - part)) / 2, s_true = scale * log(f / (1 - f));
    for (size_t k = 0; k < lines->n; k++) {
        const struct hm_line *line = &lines->line[k];
        const double *first = line->xyz, *last = line->xyz + 3 * (line->n - 1);
        for (size_t v = 0; v < line->n; v++) {
            const double *p = line->xyz + 3 * v;
            if (fmax(fabs(p[0]), fabs(p[1])) > 36) /* one-sided slopes at the border of the grid */
                continue;
            double away = fabs(fabs(p[0] * b->nx + p[1] * b->ny) - s_true);
            e->worst = fmax(e->worst, away);
            e->sum += away;
            e->vertices++;
        }
        e->length += hm_polyline_length(line);
        e->straight += hypot(last[0] - first[0], last[1] - first[1]);
        /* the bank's middle is on the left */
        double side = (last[0] - first[0]) * (0 - first[1]) - (last[1] - first[1]) * (0 - first[0]);
        e->steep_left = e->steep_left && side > 0;
    }
}

static void test_bank(void)
{
    struct error interpolated = {.steep_left = true}, node = {.steep_left = true},
                 mean = {.steep_left = true};
    bool two = true, ratio = true;
    for (int k = 0; k < 10; k++) {
        struct bank b = make_bank((3 + 36 * k) * degree);
        struct error before = interpolated;
        struct hm_lines a =
            trace(&b.l, b.slope, b.z, limit, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
        struct hm_lines c = trace(&b.l, b.slope, b.z, limit, HM_CONTOUR_NODE, HM_CONTOUR_SPLIT);
        struct hm_lines m =
            trace(&b.l, b.slope, b.z, limit, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_MEAN);
        measure(&b, &a, &interpolated);
        measure(&b, &c, &node);
        measure(&b, &m, &mean);
        two = two && a.n == 2 && m.n == 2;
        ratio = ratio && interpolated.length - before.length <
                             1.02 * (interpolated.straight - before.straight);
        hm_lines_free(&a);
        hm_lines_free(&c);
        hm_lines_free(&m);
        free(b.z);
        free(b.slope);
    }
    printf("# interp: worst %.4f mean %.4f length ratio %.5f; node: worst %.3f mean %.3f length "
           "ratio %.3f; mean: worst %.4f\n",
           interpolated.worst, interpolated.sum / interpolated.vertices,
           interpolated.length / interpolated.straight, node.worst, node.sum / node.vertices,
           node.length / node.straight, mean.worst);
    ok(two, "a bank has a toe and a crest, each one line");
    ok(interpolated.worst < 0.1, "interpolated lines lie within 0.1 cells of the true ones");
    ok(ratio, "their length is within 2 %% of the true one at each angle");
    ok(mean.worst < 0.1, "so do the means of the cells' crossings");
    ok(node.sum / node.vertices >= 4 * interpolated.sum / interpolated.vertices,
       "the zigzag of node mode is at least four times as far off");
    ok(interpolated.steep_left && node.steep_left && mean.steep_left, "steep side on the left");
}

/* --- small grids --- */

static void test_peak(void)
{
    const double slope[] = {0, 0, 0, 0, 9, 0, 0, 0, 0}, z[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    struct hm_lattice up = {3, 3, 0, 0, 1, 1}, down = {3, 3, 0, 2, 1, -1};
    struct hm_lines a = trace(&up, slope, z, 3, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    ok(a.n == 1 && a.line[0].closed && a.line[0].n == 4, "a steep node is ringed by a closed line");
    ok(hm_polygon_area2(&a.line[0]) > 0, "counter-clockwise: the steep side on its left");
    bool exact = true;
    for (size_t k = 0; k < a.line[0].n; k++) {
        const double *p = a.line[0].xyz + 3 * k; /* z = x + 3 y, a third of the way */
        exact = exact && fabs(fabs(p[0] - 1) + fabs(p[1] - 1) - 2.0 / 3) < 1e-15 &&
                fabs(p[2] - p[0] - 3 * p[1]) < 1e-14;
    }
    ok(exact, "equation (8) gives x, y and z");
    struct hm_lines b = trace(&down, slope, z, 3, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    ok(b.n == 1 && hm_polygon_area2(&b.line[0]) > 0, "also when the grid comes north first");
    struct hm_lines c = trace(&up, slope, z, 9, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    ok(c.n == 0, "an exact hit on one node leaves no line of length 0");
    hm_lines_free(&a);
    hm_lines_free(&b);
    hm_lines_free(&c);
}

static void test_saddle(void)
{
    struct hm_lattice l = {2, 2, 0, 0, 1, 1};
    const double high[] = {9, 0, 0, 9}, low[] = {9, 4, 4, 9}, z[] = {0, 0, 0, 0};
    struct hm_lines a = trace(&l, high, z, 5, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    struct hm_lines b = trace(&l, low, z, 5, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    ok(a.n == 2 && b.n == 2, "a saddle gives two pieces");
    /* mean 4.5 < 5: the steep corners are apart; mean 6.5: the others are */
    bool apart = true, together = true;
    for (size_t k = 0; k < 2; k++) {
        const double *p = a.line[k].xyz, *q = b.line[k].xyz;
        apart = apart && fabs((p[0] + p[3]) / 2 - (p[1] + p[4]) / 2) < 1e-15;
        together = together && fabs((q[0] + q[3]) / 2 + (q[1] + q[4]) / 2 - 1) < 1e-15;
    }
    ok(apart, "steep corners are apart when the mean is not steep");
    ok(together, "and together when it is");
    hm_lines_free(&a);
    hm_lines_free(&b);
}

/* Pairs of pieces that cross, by brute force. */
static size_t count_crossings(const struct hm_lines *lines)
{
    size_t crossings = 0;
    for (size_t a = 0; a < lines->n; a++)
        for (size_t pa = 0; pa < hm_polyline_pieces(&lines->line[a]); pa++)
            for (size_t b = a; b < lines->n; b++)
                for (size_t pb = b == a ? pa + 1 : 0; pb < hm_polyline_pieces(&lines->line[b]);
                     pb++) {
                    const double *p = hm_polyline_from(&lines->line[a], pa);
                    const double *q = hm_polyline_to(&lines->line[a], pa);
                    const double *r = hm_polyline_from(&lines->line[b], pb);
                    const double *s = hm_polyline_to(&lines->line[b], pb);
                    double d1 = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
                    double d2 = (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
                    double d3 = (s[0] - r[0]) * (p[1] - r[1]) - (s[1] - r[1]) * (p[0] - r[0]);
                    double d4 = (s[0] - r[0]) * (q[1] - r[1]) - (s[1] - r[1]) * (q[0] - r[0]);
                    crossings += d1 * d2 < -1e-18 && d3 * d4 < -1e-18;
                }
    return crossings;
}

/* A long line with a bump over the end of each of many short ones, every 10 m. */
static struct hm_lines make_fence(void)
{
    enum { POSTS = 25, BUMP = 6 };
    struct hm_lines lines = {0};
    double rail[3 * POSTS * BUMP];
    for (int k = 0; k < POSTS; k++) {
        double x = 10 * k, post[] = {x + 5, 0, 1, x + 5, 0.4, 1, x + 5, 0.5 + 0.015 * k, 1};
        const double bump[BUMP][2] = {{0, 0.5}, {3, 0.4}, {4.6, 0.45},
                                      {4.9, 1}, {5.1, 1}, {5.5, 0.5}};
        for (int v = 0; v < BUMP; v++) {
            double *p = rail + 3 * (k * BUMP + v);
            p[0] = x + bump[v][0];
            p[1] = bump[v][1];
            p[2] = 1;
        }
        hm_lines_append(&lines, &(struct hm_line){(char[]){""}, post, 3, false}, NULL);
    }
    hm_lines_append(&lines, &(struct hm_line){(char[]){""}, rail, POSTS * BUMP, false}, NULL);
    return lines;
}

/* Smoothing and resampling far beyond the distance of the lines. */
static void test_uncross(void)
{
    struct hm_lines fence = make_fence(), *lines = &fence;
    struct hm_lines plain = {0}, smooth = {0}, equal = {0};
    size_t kept = 0, moved = 0, same = 0, longest = 0;
    double farthest = 0;
    for (size_t k = 0; k < lines->n; k++) {
        hm_lines_append(&plain, &lines->line[k], NULL);
        hm_lines_append(&smooth, &lines->line[k], NULL);
        hm_lines_append(&equal, &lines->line[k], NULL);
        hm_lineedit_smooth(&plain.line[k], 0.8, NULL);
    }
    ok(count_crossings(lines) == 0 && count_crossings(&plain) > 5,
       "plain smoothing makes lines cross");
    hm_uncross_smooth(&smooth, 0.8, &kept, NULL);
    for (size_t k = 0; k < lines->n; k++)
        for (size_t v = 0; v < 3 * lines->line[k].n; v += 3) {
            const double *p = smooth.line[k].xyz + v, *q = lines->line[k].xyz + v;
            double away = hypot(p[0] - q[0], p[1] - q[1]);
            farthest = fmax(farthest, away);
            moved += away > 0;
            same += away == 0;
        }
    ok(count_crossings(&smooth) == 0, "smoothed lines do not cross: %zu vertices kept", kept);
    ok(farthest <= 0.8 + 1e-12 && kept > 0 && moved > same / 2,
       "the others have moved, none too far (%zu of %zu)", moved, moved + same);
    hm_uncross_resample(&equal, 3, &kept, NULL);
    for (size_t k = 0; k < equal.n; k++)
        for (size_t v = 0; v < hm_polyline_pieces(&equal.line[k]); v++) {
            const double *p = hm_polyline_from(&equal.line[k], v),
                         *q = hm_polyline_to(&equal.line[k], v);
            longest += hypot(q[0] - p[0], q[1] - p[1]) > 4.5;
        }
    ok(count_crossings(&equal) == 0 && kept > 0, "resampled lines do not cross: %zu pieces kept",
       kept);
    ok(longest == 0, "their pieces are as long as told, or shorter");
    hm_lines_free(&plain);
    hm_lines_free(&smooth);
    hm_lines_free(&equal);
    hm_lines_free(&fence);
}

/* Lines end at nodata, and every crossing of an edge between known cells is in exactly one line. */
static void test_random(void)
{
    enum { NX = 57, NY = 43 };
    struct hm_lattice l = {NX, NY, 0, 0, 1, 1};
    static double slope[NX * NY];
    uint32_t seed = 12345;
    for (size_t k = 0; k < NX * NY; k++) {
        seed = seed * 1664525u + 1013904223u;
        slope[k] = seed >> 28 == 3 ? NAN : (double)(seed >> 24 & 15);
    }
    struct hm_lines lines = trace(&l, slope, slope, 7.5, HM_CONTOUR_INTERPOLATE, HM_CONTOUR_SPLIT);
    size_t pieces = 0, want = 0;
    bool heights = true;
    for (size_t k = 0; k < lines.n; k++) {
        pieces += hm_polyline_pieces(&lines.line[k]);
        for (size_t v = 0; v < lines.line[k].n; v++)
            heights = heights && fabs(lines.line[k].xyz[3 * v + 2] - 7.5) < 1e-12;
    }
    for (size_t j = 0; j + 1 < NY; j++)
        for (size_t i = 0; i + 1 < NX; i++) {
            const double *p = slope + j * NX + i;
            const double c[5] = {p[0], p[1], p[NX + 1], p[NX], p[0]};
            int crossings = 0;
            for (int k = 0; k < 4; k++)
                crossings += (c[k] >= 7.5) != (c[k + 1] >= 7.5);
            want += isnan(c[0] + c[1] + c[2] + c[3]) ? 0 : (size_t)crossings / 2;
        }
    ok(pieces == want && want > 1000, "random slopes with holes: no piece is lost (%zu)", want);
    ok(heights, "z is interpolated by the same weights");
    size_t crossings = 0;
    double tolerance = 0.4;
    struct hm_lines simple = {0};
    for (size_t k = 0; k < lines.n; k++)
        hm_lines_append(&simple, &lines.line[k], NULL);
    hm_simplify(&simple, tolerance, NULL);
    size_t left = 0, had = 0;
    for (size_t k = 0; k < simple.n; k++) {
        left += simple.line[k].n;
        had += lines.line[k].n;
    }
    crossings = count_crossings(&simple);
    ok(crossings == 0, "simplified lines do not cross");
    ok(left < had * 9 / 10, "but are simpler: %zu vertices of %zu", left, had);
    hm_lines_free(&lines);
    hm_lines_free(&simple);
}

/* --- joining pieces without direction --- */

static enum hm_err keep_any(void *arg, const struct hm_line *found, struct hm_diag *d)
{
    struct hm_line line = *found;
    line.attrs = (char[]){""};
    return hm_lines_append(arg, &line, d);
}

/* Pieces of one line in any order and direction give that line, either way round. */
static void test_join(bool closed)
{
    enum { N = 60 };
    struct hm_lines lines = {0};
    struct hm_chain *c;
    struct hm_joint joint[N];
    double at[N][3];
    size_t order[N], pieces = closed ? N : N - 1, bad = 0;
    uint32_t seed = 7;
    for (int run = 0; run < 200; run++) {
        hm_chain_new(&c, keep_any, &lines, NULL);
        for (size_t k = 0; k < N; k++) {
            hm_joint_clear(&joint[k]);
            at[k][0] = (double)k;
            at[k][1] = at[k][2] = 0;
            order[k] = k;
        }
        for (size_t k = pieces; k-- > 1;) {
            seed = seed * 1664525u + 1013904223u;
            size_t other = (seed >> 8) % (k + 1), swap = order[k];
            order[k] = order[other];
            order[other] = swap;
        }
        for (size_t k = 0; k < pieces; k++) {
            size_t a = order[k], b = (a + 1) % N;
            seed = seed * 1664525u + 1013904223u;
            bool turned = seed >> 31;
            hm_chain_join(c, &joint[turned ? b : a], &joint[turned ? a : b], at[turned ? b : a],
                          at[turned ? a : b], NULL);
        }
        for (size_t k = 0; k < N; k++)
            hm_chain_seal(c, &joint[k], NULL);
        bad += lines.n != 1 || lines.line[0].n != N || lines.line[0].closed != closed;
        for (size_t k = 1; lines.n == 1 && k < lines.line[0].n; k++) {
            double step = fabs(lines.line[0].xyz[3 * k] - lines.line[0].xyz[3 * k - 3]);
            bad += step != 1 && !(closed && step == N - 1);
        }
        hm_lines_free(&lines);
        hm_chain_free(c);
    }
    ok(bad == 0, "pieces in any order and direction are one %s line", closed ? "closed" : "open");
}

/* --- changes of a line --- */

static void test_smooth(void)
{
    double xyz[3 * 40], first[3 * 40], moved = 0, rough = 0, smooth = 0;
    for (int k = 0; k < 40; k++) {
        xyz[3 * k] = k;
        xyz[3 * k + 1] = k % 2 ? 0.3 : -0.3;
        xyz[3 * k + 2] = 5;
    }
    memcpy(first, xyz, sizeof xyz);
    struct hm_line line = {.xyz = xyz, .n = 40};
    rough = hm_polyline_length(&line);
    hm_lineedit_smooth(&line, 0.2, NULL);
    smooth = hm_polyline_length(&line);
    for (int k = 0; k < 40; k++)
        moved = fmax(moved, hypot(xyz[3 * k] - first[3 * k], xyz[3 * k + 1] - first[3 * k + 1]));
    ok(moved <= 0.2 + 1e-15, "smoothing moves no vertex further than told");
    ok(smooth < rough && xyz[0] == 0 && xyz[117] == 39, "it shortens a zigzag, ends stay");
}

/* The numbers of the lines of a set, from their first heights, as digits. */
static int digits_of(const struct hm_lines *lines)
{
    int digits = 0;
    for (size_t k = 0; k < lines->n; k++)
        digits = 10 * digits + (int)lines->line[k].xyz[2];
    return digits;
}

/* Lines 1 to 6 run north, at x = 0, 3, 6, 20, 26, 40; 5 is long, 6 is a corner whose box covers all
 * others. Something open is at x = -2. */
static void test_release(void)
{
    double at[] = {0, 3, 6, 20, 26};
    struct hm_lines held = {0}, done = {0};
    for (int k = 0; k < 5; k++) {
        double y = k == 4 ? 90 : 9, xyz[] = {at[k], 0, k + 1, at[k], y, k + 1};
        hm_lines_append(&held, &(struct hm_line){.xyz = xyz, .n = 2}, NULL);
    }
    double corner[3 * 100];
    for (int k = 0; k < 100; k++) {
        corner[3 * k] = k < 50 ? k - 10 : 40;
        corner[3 * k + 1] = k < 50 ? -20 : k - 70;
        corner[3 * k + 2] = 6;
    }
    hm_lines_append(&held, &(struct hm_line){.xyz = corner, .n = 100}, NULL);
    const struct hm_box open[] = {{{-2, 0}, {-2, 9}}, {{-99, 80}, {99, 99}}};
    hm_release(&held, &done, open, 2, 1.6, NULL);
    ok(digits_of(&held) == 1235 && digits_of(&done) == 46,
       "near something open, near a line that is, in the rows to come: not settled");
    hm_release(&held, &done, open, 1, 1.2, NULL);
    ok(digits_of(&held) == 1 && digits_of(&done) == 46235, "that depends on how far they reach");
    hm_release(&held, &done, NULL, 0, 1e9, NULL);
    ok(held.n == 0 && digits_of(&done) == 462351, "nothing open: all are settled");
    hm_lines_free(&held);
    hm_lines_free(&done);
}

int main(void)
{
    test_release();
    test_bank();
    test_peak();
    test_saddle();
    test_random();
    test_join(false);
    test_join(true);
    test_smooth();
    test_uncross();
    return done();
}
