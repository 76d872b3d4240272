/* bsgrid: points to an analysis grid on a B-spline surface. */
#include "hm_anchor.h"
#include "hm_batch.h"
#include "hm_bspline.h"
#include "hm_cellmean.h"
#include "hm_cli.h"
#include "hm_gapfill.h"
#include "hm_gridtin.h"
#include "hm_lspia.h"
#include "hm_num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TIN, MEAN };
enum { FIT_GRID, FIT_POINTS };

static struct {
    double spacing;
    const char *region, *classes;
    int method, degree, iterations, fit;
    double gap;
    bool gap_given, derivatives;
} cmd = {.spacing = 1, .degree = 2, .iterations = 1};

static const struct hm_option options[] = {
    {'d', "spacing", "M", HM_OPT_POSITIVE, &cmd.spacing,
     .help = "distance of the nodes, m (default 1)"},
    {'R', "region", "W/E/S/N", HM_OPT_TEXT, &cmd.region,
     .help = "window to grid (default: all that the points cover)"},
    {'m', "method", "NAME", HM_OPT_CHOICE, &cmd.method,
     .help = "start grid: linear in triangles, or means of cells (default tin)",
     .choices = "tin|mean"},
    {'k', "degree", "K", HM_OPT_NATURAL, &cmd.degree,
     .help = "degree of the surface: 1, 2 or 3 (default 2)"},
    {'n', "iterations", "N", HM_OPT_NATURAL, &cmd.iterations,
     .help = "iterations of dragging (default 1; fewer smooth more)"},
    {'f', "fit", "NAME", HM_OPT_CHOICE, &cmd.fit,
     .help = "drag towards the start grid or the points themselves (default grid)",
     .choices = "grid|points"},
    {'g', "gap", "M", HM_OPT_POSITIVE, &cmd.gap,
     .help = "wider gaps between points stay empty, m (default 10 spacings)",
     .given = &cmd.gap_given},
    {'c', "classes", "N[,...]", HM_OPT_TEXT, &cmd.classes,
     .help = "take only points of these classes"},
    {0, "derivatives", NULL, HM_OPT_FLAG, &cmd.derivatives,
     .help = "add the bands dzdx and dzdy, for slope -m bspline"},
    {0}};

static const struct hm_program program = {
    .name = "bsgrid",
    .purpose = "points → analysis grid on a B-spline surface",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_POINTS,
};

enum { CLASSES = 256 };

/* The points, as far as the method needs them. */
struct survey {
    double window[4]; /* w, e, s, n as asked, when there is one */
    bool has_window;
    struct hm_anchor out;   /* the nodes asked for (with a window) */
    struct hm_anchor nodes; /* those with their surroundings */
    double reach[4];        /* points beyond are of no use */
    bool wanted[CLASSES];   /* -c */
    double *xyz;            /* tin, or dragging to points: the points themselves */
    size_t n, cap;
    struct hm_cellmean *cells; /* mean */
    double box[4];             /* extent of the points used */
    int64_t used, without_z;
};

/* --- what the user asked --- */

static void parse_classes(struct hm_cli *cli, struct survey *s)
{
    double value[CLASSES];
    size_t n = hm_num_parse_list(cmd.classes, ',', value, CLASSES);
    bool good = n > 0;
    for (size_t k = 0; good && k < n; k++) {
        good = value[k] >= 0 && value[k] < CLASSES && value[k] == floor(value[k]);
        if (good)
            s->wanted[(int)value[k]] = true;
    }
    if (!good)
        hm_cli_die(cli, "-c: classes are numbers from 0 to 255, as in 2,9; got '%s'", cmd.classes);
}

static void parse_region(struct hm_cli *cli, struct survey *s)
{
    double *w = s->window;
    struct hm_diag d = {0};
    if (hm_num_parse_list(cmd.region, '/', w, 4) != 4 || w[0] > w[1] || w[2] > w[3])
        hm_cli_die(cli, "-R: a window is west/east/south/north; got '%s'", cmd.region);
    hm_cli_check(cli, hm_anchor_within(&s->out, cmd.spacing, w, &d), &d);
    s->has_window = true;
    /* what lies further off changes nothing in the window */
    double halo = cmd.iterations + 2 + 2 * ceil(cmd.gap / cmd.spacing);
    if (halo > 1e6)
        hm_cli_die(cli, "-R: the gap limit is over a million spacings");
    s->nodes = s->out;
    hm_anchor_grow(&s->nodes, (int64_t)halo);
    struct hm_lattice l = hm_anchor_lattice(&s->nodes);
    s->reach[0] = l.x0 - cmd.spacing / 2;
    s->reach[1] = l.x0 + ((double)l.nx - 0.5) * cmd.spacing;
    s->reach[2] = l.y0 - cmd.spacing / 2;
    s->reach[3] = l.y0 + ((double)l.ny - 0.5) * cmd.spacing;
}

static struct survey start_survey(struct hm_cli *cli)
{
    struct survey s = {.reach = {-INFINITY, INFINITY, -INFINITY, INFINITY},
                       .box = {INFINITY, -INFINITY, INFINITY, -INFINITY}};
    struct hm_diag d = {0};
    if (cmd.degree < 1 || cmd.degree > 3)
        hm_cli_die(cli, "-k: the degree is 1, 2 or 3");
    if (!cmd.gap_given)
        cmd.gap = 10 * cmd.spacing;
    if (cmd.region)
        parse_region(cli, &s);
    if (cmd.classes)
        parse_classes(cli, &s);
    if (cmd.method == MEAN)
        hm_cli_check(cli, hm_cellmean_new(&s.cells, cmd.spacing, cmd.fit == FIT_POINTS, &d), &d);
    return s;
}

/* --- points in --- */

static enum hm_err add_point(struct survey *s, const double *p, struct hm_diag *d)
{
    if (p[0] < s->reach[0] || p[0] > s->reach[1] || p[1] < s->reach[2] || p[1] > s->reach[3])
        return HM_OK;
    if (!isfinite(p[2])) {
        s->without_z++;
        return HM_OK;
    }
    s->used++;
    s->box[0] = fmin(s->box[0], p[0]);
    s->box[1] = fmax(s->box[1], p[0]);
    s->box[2] = fmin(s->box[2], p[1]);
    s->box[3] = fmax(s->box[3], p[1]);
    if (cmd.method == MEAN)
        return hm_cellmean_add(s->cells, p[0], p[1], p[2], d);
    if (!hm_grow(&s->xyz, &s->cap, 3 * (s->n + 1), sizeof *s->xyz))
        return hm_fail_memory(d);
    memcpy(s->xyz + 3 * s->n++, p, 3 * sizeof *p);
    return HM_OK;
}

static bool is_wanted(const struct survey *s, double class)
{
    return class >= 0 && class < CLASSES && s->wanted[(int)class];
}

static void read_points(struct hm_cli *cli, struct survey *s, const struct hm_header *h)
{
    struct hm_reader *r = hm_cli_reader(cli);
    int class = hm_header_field(h, "class");
    if (cmd.classes && class < 0)
        hm_cli_die(cli, "%s: -c needs a field class", hm_reader_name(r));
    struct hm_diag d = {0};
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_batch_read(&b, r, h, &d)))
        for (size_t k = 0; k < b.n && !err; k++) {
            const double *p = b.rows + k * h->nfields;
            if (!cmd.classes || is_wanted(s, p[class]))
                err = add_point(s, p, &d);
        }
    hm_cli_check(cli, err, &d);
    hm_batch_free(&b);
}

/* --- the start grid --- */

static double *need(struct hm_cli *cli, size_t count, size_t size)
{
    double *p = hm_alloc(count, size);
    if (!p)
        hm_cli_die(cli,
                   "out of memory for a grid of %zu nodes: a window (-R) or a larger spacing "
                   "(-d) would help",
                   count);
    return p;
}

static void place_nodes(struct hm_cli *cli, struct survey *s)
{
    struct hm_diag d = {0};
    if (s->used == 0)
        hm_cli_die(cli, "no points with a height%s", s->has_window ? " in the window" : "");
    if (!s->has_window) {
        enum hm_err err = cmd.method == MEAN
                              ? hm_anchor_touching(&s->nodes, cmd.spacing, s->box, &d)
                              : hm_anchor_within(&s->nodes, cmd.spacing, s->box, &d);
        hm_cli_check(cli, err, &d);
        s->out = s->nodes;
    }
    if (s->nodes.nx < 2 || s->nodes.ny < 2)
        hm_cli_die(cli,
                   "the points cover %zu x %zu nodes at a spacing of %g: at least 2 x 2 are "
                   "needed",
                   s->nodes.nx, s->nodes.ny, cmd.spacing);
}

static void start_by_triangles(struct hm_cli *cli, const struct survey *s, double *z)
{
    struct hm_diag d = {0};
    struct hm_tin tin;
    struct hm_gridtin_count count;
    int threads = hm_cli_threads(cli);
    hm_cli_check(cli, hm_tin_build(&tin, s->xyz, s->n, threads, &d), &d);
    hm_cli_check(cli, hm_gridtin(z, &s->nodes, &tin, cmd.gap, threads, &count, &d), &d);
    hm_cli_mended_points(cli, 0, (int64_t)hm_tri_duplicates(tin.tri));
    if (!s->has_window && count.gap > 0)
        hm_cli_say(cli, "%zu nodes lie in gaps over %g m (-g) and stay empty", count.gap, cmd.gap);
    hm_tin_free(&tin);
}

static void start_by_means(struct hm_cli *cli, struct survey *s, double *z)
{
    struct hm_diag d = {0};
    hm_cellmean_get(s->cells, &s->nodes, z);
    if (cmd.fit == FIT_POINTS)
        hm_cli_check(cli, hm_cellmean_points(s->cells, &s->nodes, &s->xyz, &s->n, &d), &d);
    hm_cellmean_free(s->cells);
    s->cells = NULL;
    hm_cli_check(
        cli,
        hm_gapfill(z, s->nodes.nx, s->nodes.ny, cmd.gap / cmd.spacing, hm_cli_threads(cli), &d),
        &d);
}

/* --- the surface --- */

/* From x, y to parameters of the surface, in place. */
static void to_parameters(struct survey *s)
{
    struct hm_lattice l = hm_anchor_lattice(&s->nodes);
    for (size_t k = 0; k < s->n; k++) {
        s->xyz[3 * k] = (s->xyz[3 * k] - l.x0) / l.dx;
        s->xyz[3 * k + 1] = (s->xyz[3 * k + 1] - l.y0) / l.dy;
    }
}

/* The nodes become control points, and are dragged. */
static struct hm_bsurf drag(struct hm_cli *cli, struct survey *s, double *z)
{
    struct hm_bsurf b;
    struct hm_diag d = {0};
    size_t nx = s->nodes.nx, ny = s->nodes.ny;
    int threads = hm_cli_threads(cli);
    double rest = 0;
    hm_cli_check(cli, hm_bsurf_init(&b, cmd.degree, nx, ny, 1, &d), &d);
    for (size_t j = 0; j < ny; j++)
        memcpy(hm_bsurf_at(&b, 0, (int64_t)j), z + j * nx, nx * sizeof *z);
    hm_cli_check(cli, hm_bsurf_set_missing(&b, z, &d), &d);
    if (cmd.fit == FIT_POINTS) {
        to_parameters(s);
        hm_cli_check(cli, hm_lspia(&b, s->xyz, s->n, cmd.iterations, threads, &rest, &d), &d);
        if (hm_cli_verbose(cli))
            hm_cli_say(cli, "root mean square of the points' residuals: %.4g m", rest);
    } else {
        double *measure = hm_cli_verbose(cli) ? &rest : NULL;
        hm_cli_check(cli, hm_bspline_drag(&b, z, cmd.iterations, threads, measure, &d), &d);
        if (measure)
            hm_cli_say(cli, "largest distance from the start grid: %.4g m", rest);
    }
    return b;
}

/* --- the grid out --- */

static void begin_grid(struct hm_cli *cli, const struct survey *s)
{
    struct hm_diag d = {0};
    struct hm_header h;
    hm_cli_check(cli, hm_header_init(&h, HM_GRID, &d), &d);
    h.lattice = hm_anchor_lattice(&s->out);
    hm_cli_make_header(cli, &h);
    if (cmd.derivatives) {
        hm_cli_check(cli, hm_header_add_field(&h, "dzdx", "1", &d), &d);
        hm_cli_check(cli, hm_header_add_field(&h, "dzdy", "1", &d), &d);
    }
    hm_cli_check(cli, hm_writer_begin(hm_cli_writer(cli), &h, &d), &d);
    hm_header_free(&h);
}

/* The surface's slope means something only where the data tell it in both directions. */
static bool tells_slope(const struct hm_bsurf *b, int64_t i, int64_t j)
{
    return hm_bsurf_has_data(b, i, j) &&
           (hm_bsurf_has_data(b, i - 1, j) || hm_bsurf_has_data(b, i + 1, j)) &&
           (hm_bsurf_has_data(b, i, j - 1) || hm_bsurf_has_data(b, i, j + 1));
}

static void write_grid(struct hm_cli *cli, const struct survey *s, const struct hm_bsurf *b)
{
    struct hm_diag d = {0};
    size_t bands = cmd.derivatives ? 3 : 1, empty = 0;
    int64_t left = s->out.i0 - s->nodes.i0, bottom = s->out.j0 - s->nodes.j0;
    double *z = need(cli, 3 * b->n, sizeof *z), *zu = z + b->n, *zv = zu + b->n;
    double *row = need(cli, s->out.nx * bands, sizeof *row);
    for (int64_t j = bottom; j < bottom + (int64_t)s->out.ny; j++) {
        hm_bspline_row(b, (size_t)j, z, cmd.derivatives ? zu : NULL, cmd.derivatives ? zv : NULL);
        double *to = row;
        for (int64_t i = left; i < left + (int64_t)s->out.nx; i++) {
            bool known = hm_bsurf_has_data(b, i, j);
            *to++ = known ? z[i] : NAN;
            if (cmd.derivatives) {
                bool tells = tells_slope(b, i, j);
                *to++ = tells ? zu[i] / cmd.spacing : NAN;
                *to++ = tells ? zv[i] / cmd.spacing : NAN;
            }
            empty += !known;
        }
        hm_cli_check(cli, hm_writer_row(hm_cli_writer(cli), row, &d), &d);
    }
    hm_cli_check(cli, hm_writer_end(hm_cli_writer(cli), &d), &d);
    hm_cli_say(cli, "%lld points, %zu x %zu nodes, %zu of them empty (nan)", (long long)s->used,
               s->out.nx, s->out.ny, empty);
    free(z);
    free(row);
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct survey s = start_survey(cli);
    struct hm_header h;
    while (hm_cli_next(cli, &h)) {
        read_points(cli, &s, &h);
        hm_header_free(&h);
    }
    place_nodes(cli, &s);
    hm_cli_mended_points(cli, s.without_z, 0);
    double *z = need(cli, s.nodes.nx * s.nodes.ny, sizeof *z);
    if (cmd.method == MEAN)
        start_by_means(cli, &s, z);
    else
        start_by_triangles(cli, &s, z);
    struct hm_bsurf b = drag(cli, &s, z);
    free(z);
    begin_grid(cli, &s);
    write_grid(cli, &s, &b);
    hm_bsurf_free(&b);
    free(s.xyz);
    return hm_cli_finish(cli);
}
