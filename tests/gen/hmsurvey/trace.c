#include "trace.h"

#include "rng.h"

#include <math.h>

/* --- the truth --- */

static bool is_inside(const struct terrain *t, const double p[2], double margin)
{
    return p[0] >= margin && p[1] >= margin && p[0] <= t->w - margin && p[1] <= t->h - margin;
}

/* One break line of feature f, cut to where the surface has it. inner: the break at `half`. */
static void trace_break(FILE *out, const struct terrain *t, enum feature f, int side, bool inner)
{
    const struct section *section = &terrain_section[f];
    const bool toe = inner != (f == LEVEE);
    bool open = false;
    for (double s = 0; s < curve_end(&t->axis[f]); s = curve_advance(&t->axis[f], s, 1)) {
        double p[2];
        curve_offset(&t->axis[f], s, side * (inner ? section->half : terrain_edge(t, f, s, side)),
                     p);
        double z = terrain_feature(t, f, p[0], p[1]);
        if (!is_inside(t, p, 0) || fabs(terrain_z(t, p[0], p[1]) - z) > 1e-6) {
            open = false;
            continue;
        }
        if (!open)
            fprintf(out, "> kind=%s of=%s side=%s\n", toe ? "toe" : "crest", section->name,
                    side > 0 ? "left" : "right");
        open = true;
        fprintf(out, "%.4f %.4f %.4f\n", TERRAIN_EAST + p[0], TERRAIN_NORTH + p[1], z);
    }
}

void trace_truth(FILE *out, const struct terrain *t)
{
    for (enum feature f = MAIN; f < FEATURES; f++)
        for (int side = 1; side >= -1; side -= 2) {
            trace_break(out, t, f, side, true);
            trace_break(out, t, f, side, false);
        }
}

/* --- the rough lines --- */

/* First parameter from `s` on, in steps of a metre, at which the line `offset` left of the axis is
 * inside the domain less `margin`; or, with inside false, is not. */
static double find_border(const struct terrain *t, enum feature f, double s, double offset,
                          double margin, bool inside)
{
    for (; s < curve_end(&t->axis[f]); s = curve_advance(&t->axis[f], s, 1)) {
        double p[2];
        curve_offset(&t->axis[f], s, offset, p);
        if (is_inside(t, p, margin) == inside)
            return s;
    }
    return curve_end(&t->axis[f]);
}

/* How far the curve, shifted by offset, leaves the chord between two of its places. */
static double chord_sag(const struct curve *c, double offset, double from, double to)
{
    double a[2], b[2], most = 0;
    curve_offset(c, from, offset, a);
    curve_offset(c, to, offset, b);
    double dx = b[0] - a[0], dy = b[1] - a[1], length = sqrt(dx * dx + dy * dy);
    for (int k = 1; k < 8; k++) {
        double p[2];
        curve_offset(c, from + (to - from) * k / 8, offset, p);
        most = fmax(most, fabs(dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / length);
    }
    return most;
}

static void print_vertex(FILE *out, const double p[2])
{
    fprintf(out, "%.1f %.1f\n", TERRAIN_EAST + p[0], TERRAIN_NORTH + p[1]);
}

/* How a user follows a line: from and to, the distance from the axis, how well. */
struct click {
    double from, to;  /* parameters */
    double offset;    /* metres left of the axis */
    double longest;   /* metres from click to click */
    double near, far; /* metres that a click lies beside the line, at least and at most */
};

static void click_line(FILE *out, const struct curve *c, const struct click *k, struct rng *rng)
{
    for (double s = k->from, next; s <= k->to; s = next) {
        double p[2], step = k->longest * rng_uniform(rng, 0.7, 1);
        curve_offset(c, s, k->offset + rng_sign(rng) * rng_uniform(rng, k->near, k->far), p);
        print_vertex(out, p);
        /* a user clicks more often in a bend, and does not leave a short rest at the end */
        do {
            next = fmin(k->to, curve_advance(c, s, step));
            step *= 0.85;
        } while (chord_sag(c, k->offset, s, next) > 1.5);
        if (curve_advance(c, next, step / 2) > k->to)
            next = k->to;
        if (s >= k->to)
            break;
    }
}

/* Both banks of a river as a surface, from border to border, each end `margin` inside the domain; a
 * mouth reaches into the bed of the main river, so that the two surfaces overlap. */
static void click_river(FILE *out, const struct terrain *t, enum feature f, double margin,
                        struct rng *rng)
{
    const struct section *section = &terrain_section[f];
    const double crest = section->half + section->run * section->height;
    const double mouth = curve_advance(&t->axis[f], curve_end(&t->axis[f]), -7);
    for (int side = 1; side >= -1; side -= 2) {
        double from = find_border(t, f, 0, side * crest, margin, true);
        double to = fmin(mouth, find_border(t, f, from, side * crest, margin, false));
        struct click k = {from, to, side * crest, 100, 1, 3};
        fprintf(out, "> surface=%s side=%s\n", section->name, side > 0 ? "left" : "right");
        click_line(out, &t->axis[f], &k, rng);
    }
}

/* A piece of the levee's slope: a surface with overhang, and the loop along its toes as the face.
 */
static void click_levee(FILE *out, const struct terrain *t, struct rng *rng)
{
    const struct curve *axis = &t->axis[LEVEE];
    const struct section *section = &terrain_section[LEVEE];
    const double toe = section->half + section->run * section->height;
    double from = find_border(t, LEVEE, 0, 0, 30, true);
    from = curve_advance(axis, from, 0.12 * t->w);
    double to = curve_advance(axis, from, 0.5 * t->w);
    for (int side = 1; side >= -1; side -= 2) {
        struct click k = {from, to, side * (toe + 4), 60, 0, 0.5};
        fprintf(out, "> surface=levee side=%s snap=0\n", side > 0 ? "left" : "right");
        click_line(out, axis, &k, rng);
    }
    fprintf(out, "> face=levee closed=1\n");
    double inner = curve_advance(axis, from, 8), outer = curve_advance(axis, to, -8), p[2];
    for (double s = inner; s < outer; s = curve_advance(axis, s, 12)) {
        curve_offset(axis, s, -toe - 0.3, p);
        print_vertex(out, p);
    }
    for (double s = outer; s > inner; s = curve_advance(axis, s, -12)) {
        curve_offset(axis, s, toe + 0.3, p);
        print_vertex(out, p);
    }
}

/* A boundary string, drawn across the river's end `margin` inside the domain, at parameter s of the
 * axis, a little wider than the river. */
static void click_string(FILE *out, const struct terrain *t, enum feature f, double s,
                         double margin, const char *name)
{
    const struct section *section = &terrain_section[f];
    const double half = section->half + section->run * section->height + 2;
    double axis[2];
    curve_offset(&t->axis[f], s, 0, axis);
    const bool west = axis[0]<margin + 2, east = axis[0] + margin + 2> t->w;
    fprintf(out, "> string=%s\n", name);
    for (int side = 1; side >= -1; side -= 2) {
        double p[2];
        curve_offset(&t->axis[f], s, side * half, p);
        if (west || east)
            p[0] = west ? margin : t->w - margin;
        else
            p[1] = t->h - margin;
        print_vertex(out, p);
    }
}

/* The outline lies further inside than the ends of the rivers: their meshes reach through it, and
 * so the ends of the rivers are where water enters and leaves the model. */
void trace_rough(FILE *out, const struct terrain *t, uint64_t seed)
{
    struct rng rng = {seed ^ 0x2545f491};
    const double end = 6, outline = 14;
    click_river(out, t, MAIN, end, &rng);
    click_river(out, t, TRIBUTARY, end, &rng);
    click_levee(out, t, &rng);

    fprintf(out, "> boundary=1 closed=1\n");
    print_vertex(out, (double[]){outline, outline});
    print_vertex(out, (double[]){t->w - outline, outline});
    print_vertex(out, (double[]){t->w - outline, t->h - outline});
    print_vertex(out, (double[]){outline, t->h - outline});
    double begin = find_border(t, MAIN, 0, 0, end, true);
    click_string(out, t, MAIN, begin, end, "inflow");
    click_string(out, t, TRIBUTARY, find_border(t, TRIBUTARY, 0, 0, end, true), end,
                 "inflow_tributary");
    click_string(out, t, MAIN, find_border(t, MAIN, begin, 0, end, false), end, "outflow");
}
