/* breaklines: lines where the slope of the ground passes a limit, or where it bends most, from a
 * grid, row by row. */
#include "hm_attr.h"
#include "hm_cli.h"
#include "hm_contour.h"
#include "hm_lineedit.h"
#include "hm_num.h"
#include "hm_polyline.h"
#include "hm_release.h"
#include "hm_ridge.h"
#include "hm_simplify.h"
#include "hm_slope.h"
#include "hm_uncross.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 89.99994 degrees: beyond it a percentage is a slip of the pen. */
#define STEEPEST_PERCENT 1e8

/* So many are held before it is worth while to see which lines are settled. */
enum { MANY_VERTICES = 1 << 16 };

/* Modes beyond those of hm_contour. */
enum { CURVATURE = HM_CONTOUR_NODE + 1 };

static struct {
    const char *limits; /* NULL: by the mode */
    int mode, saddle;
    const char *slope_file;
    double least; /* metres */
    double simplify, resample, smooth;
    bool least_given, smooth_given, resampled, simplified;
} cmd;

static const struct hm_option options[] = {
    {'s', "limit", "LIMIT[,...]", HM_OPT_TEXT, &cmd.limits,
     .help = "limits, degrees or 10% (default 11); curvature: 1/m (0.06)"},
    {'m', "mode", "NAME", HM_OPT_CHOICE, &cmd.mode,
     .help = "border of the steep, or ridges of curvature (default interp)",
     .choices = "interp|node|curvature"},
    {'x', "saddle", "NAME", HM_OPT_CHOICE, &cmd.saddle,
     .help = "vertices: the crossings of a cell, or their mean (default split)",
     .choices = "split|mean"},
    {'l', "min-length", "M", HM_OPT_NUMBER, &cmd.least,
     .help = "drop shorter lines, m (default 20 spacings)", .given = &cmd.least_given},
    {'w', "smooth", "M", HM_OPT_NUMBER, &cmd.smooth,
     .help = "smooth; no vertex moves further than this, m (default half a spacing)",
     .given = &cmd.smooth_given},
    {'e', "simplify", "M", HM_OPT_POSITIVE, &cmd.simplify,
     .help = "leave out vertices; the line moves no further than this, m",
     .given = &cmd.simplified},
    {'r', "resample", "M", HM_OPT_POSITIVE, &cmd.resample,
     .help = "put vertices at this distance, m", .given = &cmd.resampled},
    {0, "slope", "FILE", HM_OPT_TEXT, &cmd.slope_file,
     .help = "take the slope from this grid, only the heights from the operands", .silent = true},
    {0}};

static const struct hm_program program = {
    .name = "breaklines",
    .purpose = "grid with slope → lines where the slope passes a limit, or bends most",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_GRID,
};

struct tool;

/* Lines of one limit, and with curvature of one kind. */
struct strand {
    const struct limit *limit;
    const char *kind; /* "crest", "toe"; NULL: by slope */
};

struct limit {
    struct tool *tool;
    char text[HM_NUM_CHARS + 2]; /* as the user wrote it */
    double value;
    bool percent;
    struct strand strand[HM_RIDGE_KINDS];
    struct hm_contour *contour; /* by slope, */
    struct hm_ridge *ridge;     /* or by curvature */
};

struct tool {
    struct hm_cli *cli;
    struct limit *limit;
    size_t nlimits;
    struct hm_lattice lattice; /* of this grid */
    double least, smooth;      /* metres, in this grid */
    struct hm_lines held;      /* lines to be changed, once none can come near them */
    size_t held_vertices;
    size_t enough;       /* of them, to see which are settled */
    size_t back, follow; /* vertices not smoothed, pieces not resampled */
    int64_t found, found_vertices, dropped, written, written_vertices;
    struct hm_lattice *traced; /* the lattices of the grids so far */
    size_t ntraced, traced_cap;
    size_t plain; /* grids without slope that were left out */
};

/* A grid to read rows of: z or slope, picked from its bands. */
struct source {
    struct hm_reader *reader;
    size_t bands, nx, band;
    double *row;
};

static void *need(struct hm_cli *cli, size_t count, size_t size)
{
    void *p = hm_alloc0(count, size);
    if (!p)
        hm_cli_die(cli, "out of memory");
    return p;
}

/* --- what the user asked --- */

static void parse_limit(struct tool *t, const char *s, const char *end)
{
    struct limit *l = &t->limit[t->nlimits++];
    l->tool = t;
    const char *rest = hm_num_parse(s, end, &l->value);
    l->percent = rest && rest < end && *rest == '%';
    bool by_slope = cmd.mode != CURVATURE;
    double most = !by_slope ? INFINITY : l->percent ? STEEPEST_PERCENT : 90;
    bool good = rest && rest + l->percent == end && l->value > 0 && l->value < most &&
                (size_t)(end - s) < sizeof l->text && (by_slope || !l->percent);
    if (!good && !by_slope)
        hm_cli_die(t->cli, "-s: with -m curvature a limit is more than 0, in 1/m; got '%.*s'",
                   (int)(end - s), s);
    if (!good)
        hm_cli_die(t->cli,
                   "-s: a limit is more than 0 and less than 90 degrees, or a percentage "
                   "as 10%% (less than 1e8%%); got '%.*s'",
                   (int)(end - s), s);
    memcpy(l->text, s, (size_t)(end - s));
    for (const struct limit *other = t->limit; other < l; other++)
        if (other->value == l->value && other->percent == l->percent)
            hm_cli_die(t->cli, "-s: the limit %s is given twice", l->text);
}

static void parse_limits(struct tool *t)
{
    if (!cmd.limits)
        cmd.limits = cmd.mode == CURVATURE ? "0.06" : "11";
    t->limit = need(t->cli, strlen(cmd.limits) + 1, sizeof *t->limit);
    if (cmd.least < 0)
        hm_cli_die(t->cli, "--min-length: must not be less than 0, not %g", cmd.least);
    if (cmd.smooth < 0)
        hm_cli_die(t->cli, "--smooth: must not be less than 0, not %g", cmd.smooth);
    const char *s = cmd.limits, *end;
    do {
        end = s + strcspn(s, ",");
        parse_limit(t, s, end);
        s = end + 1;
    } while (*end);
}

/* --- grids in --- */

static enum hm_slope_unit unit_of(const struct hm_header *h, int column)
{
    char unit[16];
    hm_header_unit(h, (size_t)column, unit, sizeof unit);
    for (int u = HM_SLOPE_DEGREE; u <= HM_SLOPE_RADIAN; u++)
        if (!strcmp(unit, hm_slope_unit_name((enum hm_slope_unit)u)))
            return (enum hm_slope_unit)u;
    return HM_SLOPE_DEGREE;
}

static struct source make_source(struct hm_cli *cli, struct hm_reader *r, const struct hm_header *h,
                                 int column)
{
    struct source s = {r, h->nfields - 2, (size_t)h->lattice.nx, (size_t)column - 2, NULL};
    s.row = need(cli, s.nx * s.bands, sizeof *s.row);
    return s;
}

/* The next row into s->row; false behind the last. */
static bool next_row(struct hm_cli *cli, struct source *s)
{
    struct hm_diag d = {0};
    enum hm_err err = hm_reader_row(s->reader, s->row, &d);
    if (err == HM_END)
        return false;
    hm_cli_check(cli, err, &d);
    return true;
}

static void take_band(const struct source *s, size_t band, double *to)
{
    for (size_t i = 0; i < s->nx; i++)
        to[i] = s->row[i * s->bands + band];
}

static bool same_lattice(const struct hm_lattice *a, const struct hm_lattice *b)
{
    double near = 1e-3 * fmin(fabs(a->dx), fabs(a->dy));
    return a->nx == b->nx && a->ny == b->ny && fabs(a->x0 - b->x0) <= near &&
           fabs(a->y0 - b->y0) <= near && fabs(a->dx - b->dx) * (double)a->nx <= near &&
           fabs(a->dy - b->dy) * (double)a->ny <= near;
}

/* The slope: a band of the grid of heights, or the first grid of the file that the user named. */
static struct source open_slope(struct hm_cli *cli, const struct hm_header *heights,
                                enum hm_slope_unit *unit)
{
    struct hm_diag d = {0};
    struct hm_reader *r = hm_cli_reader(cli);
    if (!cmd.slope_file) {
        int column = hm_header_field(heights, "slope");
        *unit = unit_of(heights, column);
        return make_source(cli, r, heights, column);
    }
    hm_cli_check(cli, hm_reader_open(&r, cmd.slope_file, &d), &d);
    struct hm_header h;
    enum hm_err err = hm_reader_next(r, &h, &d);
    hm_cli_check(cli, err, &d);
    if (h.kind != HM_GRID)
        hm_cli_die(cli, "%s: not a grid", hm_reader_name(r));
    if (!same_lattice(&h.lattice, &heights->lattice))
        hm_cli_die(cli, "%s: its nodes are not those of the grid of heights (size, origin or step)",
                   hm_reader_name(r));
    int column = hm_header_field(&h, "slope") < 2 ? 2 : hm_header_field(&h, "slope");
    *unit = unit_of(&h, column);
    struct source s = make_source(cli, r, &h, column);
    hm_header_free(&h);
    return s;
}

/* --- lines out --- */

static enum hm_err write_line(struct tool *t, const struct hm_line *line, struct hm_diag *d)
{
    struct hm_line out = *line;
    char number[HM_NUM_CHARS];
    number[hm_num_print_fixed(number, hm_polyline_length(line), 3)] = 0;
    out.attrs = hm_attr_set(line->attrs, "length", number);
    enum hm_err err =
        out.attrs ? hm_writer_line(hm_cli_writer(t->cli), &out, d) : hm_fail_memory(d);
    free(out.attrs);
    t->written++;
    t->written_vertices += (int64_t)out.n;
    return err;
}

/* Lines must not cross, so all are to be known before any of them changes. */
static bool changes_lines(const struct tool *t)
{
    return t->smooth > 0 || cmd.simplified || cmd.resampled;
}

/* A line as it was found: clean it, judge it, and let it out unless all are needed first. */
static enum hm_err take_line(void *arg, const struct hm_line *found, struct hm_diag *d)
{
    const struct strand *s = arg;
    struct tool *t = s->limit->tool;
    char attrs[sizeof s->limit->text + 24];
    snprintf(attrs, sizeof attrs, "%s%s%slimit=%s", s->kind ? "kind=" : "", s->kind ? s->kind : "",
             s->kind ? " " : "", s->limit->text);
    struct hm_line line = *found;
    line.attrs = attrs;
    hm_lineedit_tidy(&line);
    t->found++;
    t->found_vertices += (int64_t)line.n;
    if (line.n < 2 || hm_polyline_length(&line) < t->least) {
        t->dropped++;
        return HM_OK;
    }
    t->held_vertices += line.n;
    return changes_lines(t) ? hm_lines_append(&t->held, &line, d) : write_line(t, &line, d);
}

/* Smooth, simplify, resample, and let the lines out. */
static void change_lines(struct tool *t, struct hm_lines *lines)
{
    struct hm_diag d = {0};
    size_t back = 0, follow = 0;
    if (t->smooth > 0)
        hm_cli_check(t->cli, hm_uncross_smooth(lines, t->smooth, &back, &d), &d);
    if (cmd.simplified)
        hm_cli_check(t->cli, hm_simplify(lines, cmd.simplify, &d), &d);
    if (cmd.resampled)
        hm_cli_check(t->cli, hm_uncross_resample(lines, cmd.resample, &follow, &d), &d);
    for (size_t k = 0; k < lines->n; k++)
        if (hm_polyline_length(&lines->line[k]) < t->least)
            t->dropped++; /* now that it is smooth */
        else
            hm_cli_check(t->cli, write_line(t, &lines->line[k], &d), &d);
    t->back += back;
    t->follow += follow;
    hm_lines_free(lines);
}

/* How far changes of a line reach: vertices move, and chords cut corners. */
static double reach(const struct tool *t)
{
    return t->smooth + cmd.simplify + cmd.resample;
}

/* What may still come: the rows from a little before `row` on, and what the open lines have. */
static enum hm_err find_open(const struct tool *t, int64_t row, struct hm_box **box, size_t *n,
                             struct hm_diag *d)
{
    const struct hm_lattice *l = &t->lattice;
    size_t cap = 0;
    if (!hm_grow(box, &cap, *n + 1, sizeof **box))
        return hm_fail_memory(d);
    double y = l->y0 + (double)(row - HM_RIDGE_LAG) * l->dy;
    (*box)[(*n)++] = hm_box_of(
        (const double[]){l->x0, y},
        (const double[]){l->x0 + (double)(l->nx - 1) * l->dx, l->y0 + (double)(l->ny - 1) * l->dy});
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < t->nlimits && !err; k++)
        err = t->limit[k].ridge ? hm_ridge_open(t->limit[k].ridge, box, n, &cap, d)
                                : hm_contour_open(t->limit[k].contour, box, n, &cap, d);
    return err;
}

/* Let the lines out that are settled once `row` has been traced, when many are held. */
static void release_lines(struct tool *t, int64_t row)
{
    struct hm_diag d = {0};
    struct hm_lines done = {0};
    struct hm_box *open = NULL;
    size_t n = 0;
    if (!changes_lines(t) || t->held_vertices < t->enough)
        return;
    enum hm_err err = find_open(t, row, &open, &n, &d);
    if (!err)
        err = hm_release(&t->held, &done, open, n, reach(t), &d);
    hm_cli_check(t->cli, err, &d);
    free(open);
    change_lines(t, &done);
    t->held_vertices = 0;
    for (size_t k = 0; k < t->held.n; k++)
        t->held_vertices += t->held.line[k].n;
    t->enough = 2 * t->held_vertices + MANY_VERTICES;
}

/* --- one grid --- */

static void open_ridge(struct tool *t, struct limit *l, const struct hm_header *h)
{
    static const char *const kind[HM_RIDGE_KINDS] = {"crest", "toe"};
    struct hm_diag d = {0};
    struct hm_ridge_rule rule = {.limit = l->value, .take = take_line};
    for (int k = 0; k < HM_RIDGE_KINDS; k++) {
        l->strand[k] = (struct strand){l, kind[k]};
        rule.arg[k] = &l->strand[k];
    }
    hm_cli_check(t->cli, hm_ridge_new(&l->ridge, &h->lattice, &rule, &d), &d);
}

static void open_limits(struct tool *t, const struct hm_header *h, enum hm_slope_unit unit)
{
    for (size_t k = 0; k < t->nlimits; k++) {
        struct limit *l = &t->limit[k];
        struct hm_diag d = {0};
        if (cmd.mode == CURVATURE) {
            open_ridge(t, l, h);
            continue;
        }
        l->strand[0] = (struct strand){l, NULL};
        struct hm_contour_rule rule = {.mode = (enum hm_contour_mode)cmd.mode,
                                       .saddle = (enum hm_contour_saddle)cmd.saddle,
                                       .take = take_line,
                                       .arg = &l->strand[0]};
        rule.limit =
            hm_slope_convert(l->value, l->percent ? HM_SLOPE_PERCENT : HM_SLOPE_DEGREE, unit);
        hm_cli_check(t->cli, hm_contour_new(&l->contour, &h->lattice, &rule, &d), &d);
    }
}

static void close_limits(struct tool *t)
{
    for (size_t k = 0; k < t->nlimits; k++) {
        struct limit *l = &t->limit[k];
        struct hm_diag d = {0};
        hm_cli_check(t->cli, l->ridge ? hm_ridge_end(l->ridge, &d) : hm_contour_end(l->contour, &d),
                     &d);
        hm_contour_free(l->contour);
        hm_ridge_free(l->ridge);
        l->contour = NULL;
        l->ridge = NULL;
    }
}

static void trace_curvature(struct tool *t, struct source *heights, int64_t ny)
{
    struct hm_diag d = {0};
    double *z = need(t->cli, heights->nx, sizeof *z);
    for (int64_t j = 0; next_row(t->cli, heights); j++) {
        take_band(heights, heights->band, z);
        for (size_t k = 0; k < t->nlimits; k++)
            hm_cli_check(t->cli, hm_ridge_row(t->limit[k].ridge, z, &d), &d);
        release_lines(t, j);
        hm_cli_progress(t->cli, "breaklines", (double)j / (double)ny);
    }
    free(z);
}

static void trace_slope(struct tool *t, struct source *heights, struct source *slopes, int64_t ny)
{
    struct hm_cli *cli = t->cli;
    size_t nx = heights->nx;
    double *slope = need(cli, 2 * nx, sizeof *slope), *z = need(cli, 2 * nx, sizeof *z);
    struct hm_diag d = {0};
    for (int64_t j = 0; next_row(cli, heights); j++) {
        size_t at = (j & 1) ? nx : 0; /* contours keep the row before */
        take_band(heights, heights->band, z + at);
        if (slopes->reader != heights->reader && !next_row(cli, slopes))
            hm_cli_die(cli, "%s: too few rows", hm_reader_name(slopes->reader));
        take_band(slopes->reader == heights->reader ? heights : slopes, slopes->band, slope + at);
        for (size_t k = 0; k < t->nlimits; k++)
            hm_cli_check(cli, hm_contour_row(t->limit[k].contour, slope + at, z + at, &d), &d);
        release_lines(t, j);
        hm_cli_progress(cli, "breaklines", (double)j / (double)ny);
    }
    free(slope);
    free(z);
}

static void do_slope(struct tool *t, const struct hm_header *h, struct source *heights)
{
    enum hm_slope_unit unit;
    struct source slopes = open_slope(t->cli, h, &unit);
    open_limits(t, h, unit);
    trace_slope(t, heights, &slopes, h->lattice.ny);
    if (slopes.reader != heights->reader) {
        if (next_row(t->cli, &slopes))
            hm_cli_die(t->cli, "%s: too many rows", hm_reader_name(slopes.reader));
        hm_reader_close(slopes.reader);
    }
    free(slopes.row);
}

/* What was not given depends on the spacing of the nodes; the border of nodes is a zigzag by
 * intent. */
static void use_lattice(struct tool *t, const struct hm_lattice *l)
{
    double dx = fabs(l->dx), dy = fabs(l->dy);
    t->lattice = *l;
    t->least = cmd.least_given ? cmd.least : 20 * fmax(dx, dy);
    t->smooth = cmd.smooth_given || cmd.mode == HM_CONTOUR_NODE ? cmd.smooth : fmin(dx, dy) / 2;
    t->held_vertices = 0;
    t->enough = MANY_VERTICES;
}

static void do_grid(struct tool *t, const struct hm_header *h)
{
    int column = hm_header_field(h, "z");
    if (column < 2)
        hm_cli_die(t->cli, "%s: the grid has no band z", hm_reader_name(hm_cli_reader(t->cli)));
    struct source heights = make_source(t->cli, hm_cli_reader(t->cli), h, column);
    use_lattice(t, &h->lattice);
    if (cmd.mode == CURVATURE) {
        open_limits(t, h, HM_SLOPE_DEGREE);
        trace_curvature(t, &heights, h->lattice.ny);
    } else {
        do_slope(t, h, &heights);
    }
    close_limits(t);
    change_lines(t, &t->held);
    free(heights.row);
}

/* Is this the grid to trace? A pipe with --keep brings the same ground twice: as bsgrid made it and
 * as slope completed it. */
static bool is_wanted(struct tool *t, const struct hm_header *h)
{
    const char *name = hm_reader_name(hm_cli_reader(t->cli));
    if (cmd.mode != CURVATURE && !cmd.slope_file && hm_header_field(h, "slope") < 2) {
        t->plain++;
        return false;
    }
    for (size_t k = 0; k < t->ntraced; k++)
        if (same_lattice(&t->traced[k], &h->lattice)) {
            hm_cli_say(t->cli, "%s: left out a second grid of the same nodes", name);
            return false;
        }
    if (!hm_grow(&t->traced, &t->traced_cap, t->ntraced + 1, sizeof *t->traced))
        hm_cli_die(t->cli, "out of memory");
    t->traced[t->ntraced++] = h->lattice;
    return true;
}

static void say_plain(const struct tool *t, bool any)
{
    if (t->plain > 0 && !any)
        hm_cli_die(t->cli, "no grid has a band slope: pipe it through slope, or give --slope");
    if (t->plain > 0)
        hm_cli_say(t->cli, "left out %s without a band slope",
                   hm_cli_counted((int64_t)t->plain, "grid").text);
}

static void begin_output(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    struct hm_header h;
    hm_cli_check(cli, hm_header_init(&h, HM_LINES, &d), &d);
    hm_cli_make_header(cli, &h);
    hm_cli_check(cli, hm_writer_begin(hm_cli_writer(cli), &h, &d), &d);
    hm_header_free(&h);
}

static void finish_output(struct tool *t)
{
    struct hm_diag d = {0};
    hm_cli_check(t->cli, hm_writer_end(hm_cli_writer(t->cli), &d), &d);
    if (t->back + t->follow > 0)
        hm_cli_say(t->cli, "%s not smoothed, %s not resampled: lines would cross",
                   hm_cli_counted((int64_t)t->back, "vertex").text,
                   hm_cli_counted((int64_t)t->follow, "piece").text);
    hm_cli_say(t->cli, "%s found (%s), %lld dropped (shorter than %g m), %lld written (%s)",
               hm_cli_counted(t->found, "line").text,
               hm_cli_counted(t->found_vertices, "vertex").text, (long long)t->dropped, t->least,
               (long long)t->written, hm_cli_counted(t->written_vertices, "vertex").text);
}

int main(int argc, char **argv)
{
    struct tool t = {.cli = hm_cli_start(&program, argc, argv)};
    parse_limits(&t);
    struct hm_header h;
    bool any = false;
    while (hm_cli_next(t.cli, &h)) {
        if (is_wanted(&t, &h)) {
            if (!any)
                begin_output(t.cli);
            any = true;
            do_grid(&t, &h);
        }
        hm_header_free(&h);
    }
    say_plain(&t, any);
    if (!any)
        hm_cli_die(t.cli, "no grid in the input");
    finish_output(&t);
    free(t.limit);
    free(t.traced);
    return hm_cli_finish(t.cli);
}
