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

/* A grid on its way through. Some rows are held at a time, with one more on either side. */
struct stream {
    struct hm_lattice l;
    size_t nx, bands;       /* bands that come in */
    size_t z, gx, gy;       /* the bands of the height and, for bspline, of its derivatives */
    size_t added;           /* bands that go out in addition */
    size_t room;            /* rows that the buffers hold */
    int64_t base, held;     /* the first row held, and how many */
    int64_t from;           /* the first row to compute next */
    double *in, *height;    /* room rows */
    double *gradient, *out; /* room rows */
    struct hm_slope_second *second;
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
    struct stream s = {.l = h->lattice, .nx = (size_t)h->lattice.nx, .bands = h->nfields - 2};
    s.z = band_of(cli, h, "z");
    if (cmd.method == BSPLINE) {
        s.gx = band_of(cli, h, "dzdx");
        s.gy = band_of(cli, h, "dzdy");
    }
    s.added = 1 + (size_t)cmd.aspect + 2 * (size_t)cmd.curvature;
    size_t rows = NODES / s.nx;
    s.room = (rows < 1 ? 1 : rows > MOST_ROWS ? MOST_ROWS : rows) + 2;
    s.in = need(cli, s.room * s.nx, s.bands * sizeof *s.in);
    s.height = need(cli, s.room * s.nx, sizeof *s.height);
    s.gradient = need(cli, s.room * s.nx, 2 * sizeof *s.gradient);
    s.second = need(cli, cmd.curvature ? s.room * s.nx : 0, sizeof *s.second);
    s.out = need(cli, s.room * s.nx, (s.bands + s.added) * sizeof *s.out);
    return s;
}

static void close_stream(struct stream *s)
{
    free(s->in);
    free(s->height);
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

/* Read rows while there is room; true when the last has come. */
static bool fill(struct hm_cli *cli, struct stream *s)
{
    while (s->held < (int64_t)s->room) {
        struct hm_diag d = {0};
        double *row = s->in + (size_t)s->held * s->nx * s->bands;
        enum hm_err err = hm_reader_row(hm_cli_reader(cli), row, &d);
        if (err == HM_END)
            return true;
        hm_cli_check(cli, err, &d);
        double *height = s->height + (size_t)s->held * s->nx;
        for (size_t i = 0; i < s->nx; i++)
            height[i] = row[i * s->bands + s->z];
        s->held++;
    }
    return false;
}

static const double *height_row(const struct stream *s, int64_t row)
{
    bool known = row >= s->base && row < s->base + s->held;
    return known ? s->height + (size_t)(row - s->base) * s->nx : NULL;
}

static void take_gradient(const struct stream *s, int64_t row, double *gx, double *gy)
{
    if (cmd.method == BSPLINE) {
        const double *in = s->in + (size_t)(row - s->base) * s->nx * s->bands;
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

static void compute_row(void *arg, size_t k)
{
    const struct stream *s = arg;
    int64_t row = s->from + (int64_t)k;
    double *gx = s->gradient + k * 2 * s->nx, *gy = gx + s->nx;
    struct hm_slope_second *second = s->second + (cmd.curvature ? k * s->nx : 0);
    take_gradient(s, row, gx, gy);
    if (cmd.curvature) {
        const double *const z[3] = {height_row(s, row - 1), height_row(s, row),
                                    height_row(s, row + 1)};
        hm_slope_second(second_method(), z, s->nx, s->l.dx, s->l.dy, second);
    }
    const double *in = s->in + (size_t)(row - s->base) * s->nx * s->bands;
    double *out = s->out + k * s->nx * (s->bands + s->added);
    for (size_t i = 0; i < s->nx; i++) {
        for (size_t b = 0; b < s->bands; b++)
            *out++ = *in++;
        *out++ = hm_slope_of(gx[i], gy[i], (enum hm_slope_unit)cmd.unit);
        if (cmd.aspect)
            *out++ = hm_slope_aspect(gx[i], gy[i]);
        if (cmd.curvature) {
            *out++ = hm_slope_profile_curvature(gx[i], gy[i], &second[i]);
            *out++ = hm_slope_plan_curvature(gx[i], gy[i], &second[i]);
        }
    }
}

/* Compute and write the rows whose neighbours are held; keep the last two for what comes. */
static void put_rows(struct hm_cli *cli, struct stream *s, bool last)
{
    int64_t end = s->base + s->held - !last;
    size_t rows = end > s->from ? (size_t)(end - s->from) : 0;
    hm_thread_for(hm_cli_threads(cli), rows, compute_row, s);
    for (size_t k = 0; k < rows; k++) {
        struct hm_diag d = {0};
        const double *row = s->out + k * s->nx * (s->bands + s->added);
        hm_cli_check(cli, hm_writer_row(hm_cli_writer(cli), row, &d), &d);
    }
    s->from += (int64_t)rows;
    int64_t drop = s->from - 1 - s->base;
    if (drop > 0) {
        size_t keep = (size_t)(s->held - drop) * s->nx, gone = (size_t)drop * s->nx;
        memmove(s->height, s->height + gone, keep * sizeof *s->height);
        memmove(s->in, s->in + gone * s->bands, keep * s->bands * sizeof *s->in);
        s->base += drop;
        s->held -= drop;
    }
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
    bool last;
    do {
        last = fill(cli, &s);
        put_rows(cli, &s, last);
        hm_cli_progress(cli, "slope", (double)s.from / (double)s.l.ny);
    } while (!last);
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
