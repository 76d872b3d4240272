/* slope: adds the slope of the ground to a grid, row by row as it comes. */
#include "hm_cli.h"
#include "hm_slope.h"
#include "hm_thread.h"

#include <stdlib.h>
#include <string.h>

/* Methods beyond those of hm_slope. */
enum { BSPLINE = HM_SLOPE_STEEPEST + 1 };

static struct {
    int method;
    int unit;
    bool aspect, curvature, single;
} cmd;

static const struct hm_option options[] = {
    {'m', "method", "NAME", HM_OPT_CHOICE, &cmd.method,
     .help = "how the gradient is taken from the neighbours (default distance)",
     .choices = "distance|horn|zt|equal|simple|steepest|bspline"},
    {'u', "units", "NAME", HM_OPT_CHOICE, &cmd.unit, .help = "unit of the slope (default degree)",
     .choices = "degree|percent|radian"},
    {'a', "aspect", NULL, HM_OPT_FLAG, &cmd.aspect,
     .help = "add where the ground falls to, in degrees clockwise from north"},
    {'c', "curvature", NULL, HM_OPT_FLAG, &cmd.curvature,
     .help = "add the curvature along the fall and that of the contour, 1/m"},
    {0, "single", NULL, HM_OPT_FLAG, &cmd.single,
     .help = "write a binary grid of single precision, half as long"},
    {0}};

static const struct hm_program program = {
    .name = "slope",
    .purpose = "grid → the same grid with the slope of the ground",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_GRID,
};

/* A grid on its way through, some rows at a time. While these are computed, those before are
 * written and the next are read:
 *
 *     written | computed  |  read
 *     ────────┼───────────┼──────────
 *         from-slab     from     from + 1 + slab
 *
 * Rows in are kept in a ring, row j in place j mod room, with the one before and the one behind
 * those that are computed; rows out likewise.
 */
struct stream {
    struct hm_cli *cli;
    struct hm_lattice l;
    size_t nx, bands;    /* bands that come in */
    size_t z, gx, gy;    /* the bands of the height and, for bspline, of its derivatives */
    size_t added;        /* bands that go out in addition */
    int64_t slab, room;  /* rows at a time, rows in that are kept */
    int64_t read;        /* rows that have come in */
    int64_t from, to;    /* rows to compute */
    int64_t written;     /* rows that have gone out */
    double *in, *height; /* room rows; height is `in` when there is nothing else in it */
    double *gradient;    /* slab rows */
    double *out;         /* 2 slab rows */
    struct hm_slope_second *second; /* slab rows */
    enum hm_err err;                /* of reading and writing */
    struct hm_diag d;
};

static size_t band_of(struct hm_cli *cli, const struct hm_header *h, const char *name)
{
    int column = hm_header_field(h, name);
    if (column < 2)
        hm_cli_die(cli, "%s: the grid has no band %s%s", hm_reader_name(hm_cli_reader(cli)), name,
                   cmd.method == BSPLINE ? "; bsgrid --derivatives makes it" : "");
    return (size_t)column - 2;
}

static void *need(struct hm_cli *cli, size_t count, size_t size)
{
    void *p = hm_alloc(count, size);
    if (!p)
        hm_cli_die(cli, "out of memory");
    return p;
}

static struct stream open_stream(struct hm_cli *cli, const struct hm_header *h)
{
    enum { NODES = 1 << 16, MOST_ROWS = 64 };
    struct stream s = {
        .cli = cli, .l = h->lattice, .nx = (size_t)h->lattice.nx, .bands = h->nfields - 2};
    s.z = band_of(cli, h, "z");
    if (cmd.method == BSPLINE) {
        s.gx = band_of(cli, h, "dzdx");
        s.gy = band_of(cli, h, "dzdy");
    }
    s.added = 1 + (size_t)cmd.aspect + 2 * (size_t)cmd.curvature;
    s.slab = NODES / h->lattice.nx;
    s.slab = s.slab < 1 ? 1 : s.slab > MOST_ROWS ? MOST_ROWS : s.slab;
    s.room = 2 * s.slab + 2;
    size_t room = (size_t)s.room * s.nx, slab = (size_t)s.slab * s.nx;
    s.in = need(cli, room, s.bands * sizeof *s.in);
    s.height = s.bands == 1 ? s.in : need(cli, room, sizeof *s.height);
    s.gradient = need(cli, slab, 2 * sizeof *s.gradient);
    s.second = need(cli, cmd.curvature ? slab : 0, sizeof *s.second);
    s.out = need(cli, 2 * slab, (s.bands + s.added) * sizeof *s.out);
    return s;
}

static void close_stream(struct stream *s)
{
    if (s->height != s->in)
        free(s->height);
    free(s->in);
    free(s->gradient);
    free(s->second);
    free(s->out);
}

static void add_band(struct hm_cli *cli, struct hm_header *h, const char *name, const char *unit)
{
    struct hm_diag d = {0};
    if (hm_header_field(h, name) >= 0)
        hm_cli_die(cli, "%s: the grid has a band %s already", hm_reader_name(hm_cli_reader(cli)),
                   name);
    hm_cli_check(cli, hm_header_add_field(h, name, unit, &d), &d);
}

static double *row_in(const struct stream *s, int64_t row)
{
    return s->in + (size_t)(row % s->room) * s->nx * s->bands;
}

static double *row_out(const struct stream *s, int64_t row)
{
    return s->out + (size_t)(row % (2 * s->slab)) * s->nx * (s->bands + s->added);
}

/* Heights of a row; NULL beyond the grid. */
static double *height_row(const struct stream *s, int64_t row)
{
    return row >= 0 && row < s->l.ny ? s->height + (size_t)(row % s->room) * s->nx : NULL;
}

static enum hm_err read_row(struct stream *s)
{
    double *in = row_in(s, s->read), *height = height_row(s, s->read);
    enum hm_err err = hm_reader_row(hm_cli_reader(s->cli), in, &s->d);
    for (size_t i = 0; height != in && !err && i < s->nx; i++)
        height[i] = in[i * s->bands + s->z];
    s->read += !err;
    return err;
}

/* Write what was computed before, and read as much as will be computed next. */
static void move_rows(struct stream *s)
{
    int64_t enough = s->to + 1 + s->slab < s->l.ny ? s->to + 1 + s->slab : s->l.ny;
    while (s->written < s->from && !s->err)
        s->err = hm_writer_row(hm_cli_writer(s->cli), row_out(s, s->written++), &s->d);
    while (s->read < enough && !s->err)
        s->err = read_row(s);
}

static void take_gradient(const struct stream *s, int64_t row, double *gx, double *gy)
{
    if (cmd.method == BSPLINE) {
        const double *in = row_in(s, row);
        for (size_t i = 0; i < s->nx; i++) {
            gx[i] = in[i * s->bands + s->gx];
            gy[i] = in[i * s->bands + s->gy];
        }
        return;
    }
    const double *const z[3] = {height_row(s, row - 1), height_row(s, row), height_row(s, row + 1)};
    hm_slope_gradient((enum hm_slope_method)cmd.method, z, s->nx, s->l.dx, s->l.dy, gx, gy);
}

/* Second derivatives are not among the bands of the surface: they come from its heights. */
static enum hm_slope_method second_method(void)
{
    return cmd.method == BSPLINE ? HM_SLOPE_OVER_DISTANCE : (enum hm_slope_method)cmd.method;
}

static void compute_row(const struct stream *s, int64_t row)
{
    size_t k = (size_t)(row - s->from), all = s->bands + s->added, nx = s->nx;
    double *gx = s->gradient + k * 2 * nx, *gy = gx + nx;
    struct hm_slope_second *second = s->second + (cmd.curvature ? k * nx : 0);
    take_gradient(s, row, gx, gy);
    if (cmd.curvature) {
        const double *const z[3] = {height_row(s, row - 1), height_row(s, row),
                                    height_row(s, row + 1)};
        hm_slope_second(second_method(), z, nx, s->l.dx, s->l.dy, second);
    }
    const double *in = row_in(s, row);
    double *out = row_out(s, row), *to = out;
    for (size_t i = 0; i < nx; i++, to += s->added)
        for (size_t b = 0; b < s->bands; b++)
            *to++ = *in++;
    to = out + s->bands;
    for (size_t i = 0; i < nx; i++)
        to[i * all] = hm_slope_of(gx[i], gy[i], (enum hm_slope_unit)cmd.unit);
    to++;
    for (size_t i = 0; cmd.aspect && i < nx; i++)
        to[i * all] = hm_slope_aspect(gx[i], gy[i]);
    to += cmd.aspect;
    for (size_t i = 0; cmd.curvature && i < nx; i++) {
        to[i * all] = hm_slope_profile_curvature(gx[i], gy[i], &second[i]);
        to[i * all + 1] = hm_slope_plan_curvature(gx[i], gy[i], &second[i]);
    }
}

/* Chunk 0 moves rows, the others compute one each. */
static void run_chunk(void *arg, size_t chunk)
{
    struct stream *s = arg;
    if (chunk == 0)
        move_rows(s);
    else
        compute_row(s, s->from + (int64_t)chunk - 1);
}

/* The first rows are read, then all are computed, then the last are written. */
static void pass_rows(struct stream *s)
{
    struct hm_team *team = hm_team_new(hm_cli_threads(s->cli));
    while (s->written < s->l.ny) {
        hm_team_for(team, 1 + (size_t)(s->to - s->from), run_chunk, s);
        hm_cli_check(s->cli, s->err, &s->d);
        hm_cli_progress(s->cli, "slope", (double)s->read / (double)s->l.ny);
        s->from = s->to;
        s->to = s->read < s->l.ny ? s->read - 1 : s->l.ny;
        s->to = s->to > s->from + s->slab ? s->from + s->slab : s->to;
    }
    hm_team_free(team);
}

static void do_grid(struct hm_cli *cli, struct hm_header *h)
{
    struct hm_diag d = {0};
    struct hm_writer *w = hm_cli_writer(cli);
    struct stream s = open_stream(cli, h);
    add_band(cli, h, "slope", hm_slope_unit_name((enum hm_slope_unit)cmd.unit));
    if (cmd.aspect)
        add_band(cli, h, "aspect", "degree");
    if (cmd.curvature) {
        add_band(cli, h, "profile", "1/m");
        add_band(cli, h, "plan", "1/m");
    }
    hm_cli_make_header(cli, h);
    hm_cli_check(cli, hm_writer_begin(w, h, &d), &d);
    pass_rows(&s);
    hm_cli_check(cli, hm_reader_row(hm_cli_reader(cli), s.in, &d), &d); /* there is an end */
    hm_cli_check(cli, hm_writer_end(w, &d), &d);
    close_stream(&s);
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct hm_header h;
    size_t done = 0, sloped = 0;
    if (cmd.single)
        hm_cli_set_single(cli);
    while (hm_cli_next(cli, &h)) {
        if (hm_header_field(&h, "slope") >= 0) {
            sloped++;
        } else {
            do_grid(cli, &h);
            done++;
        }
        hm_header_free(&h);
    }
    if (sloped > 0 && done == 0)
        hm_cli_die(cli, "no grid without a band slope: it is there already");
    if (sloped > 0)
        hm_cli_say(cli, "left out %s that had a band slope already",
                   hm_cli_counted((int64_t)sloped, "grid").text);
    if (done == 0)
        hm_cli_die(cli, "no grid in the input");
    return hm_cli_finish(cli);
}
