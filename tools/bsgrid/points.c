/* points.c: the points that bsgrid takes, and the lattices for them. */
#include "bsgrid.h"
#include "hm_batch.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void widen(struct spread *s, const double *p)
{
    if (s->over == NOWHERE) {
        memcpy(s->a, p, sizeof s->a);
        s->over = ONE_PLACE;
    } else if (s->over == ONE_PLACE && (p[0] != s->a[0] || p[1] != s->a[1])) {
        memcpy(s->b, p, sizeof s->b);
        s->over = ONE_LINE;
    } else if (s->over == ONE_LINE && hm_pred_orient(s->a, s->b, p) != 0) {
        s->over = AN_AREA;
    }
}

/* Columns of what decides whether a point is taken; -1: does not matter. */
struct filter {
    int class, number, of; /* number of the return, of so many */
};

static struct filter make_filter(struct hm_cli *cli, const struct hm_header *h)
{
    struct filter f = {-1, -1, -1};
    const char *name = hm_reader_name(hm_cli_reader(cli));
    if (cmd.classes && (f.class = hm_header_field(h, "class")) < 0)
        hm_cli_die(cli, "%s: -c needs a field class", name);
    if (cmd.returns == ALL)
        return f;
    f.number = hm_header_field(h, "return");
    f.of = hm_header_field(h, "returns");
    if (f.number < 0 || f.of < 0)
        hm_cli_die(cli, "%s: --returns needs the fields return and returns", name);
    return f;
}

static bool is_class_wanted(const struct survey *s, double class)
{
    return class >= 0 && class < CLASSES && s->wanted[(int)class];
}

static bool is_wanted(const struct survey *s, const struct filter *f, const double *p)
{
    if (f->class >= 0 && !is_class_wanted(s, p[f->class]))
        return false;
    return cmd.returns == ALL || (cmd.returns == FIRST  ? p[f->number] == 1
                                  : cmd.returns == LAST ? p[f->number] == p[f->of]
                                                        : p[f->of] == 1);
}

/* Bring the points that count to the front of a batch, x, y, z each; returns their number. */
static size_t pick_points(struct survey *s, const struct filter *f, double *rows, size_t n,
                          size_t nfields)
{
    const double *w = s->reach;
    double *to = rows;
    bool all = f->class < 0 && cmd.returns == ALL;
    for (const double *p = rows; p < rows + n * nfields; p += nfields) {
        double x = p[0], y = p[1], z = p[2]; /* `to` may be p */
        if (x < w[0] || x > w[1] || y < w[2] || y > w[3] || !(all || is_wanted(s, f, p)))
            continue;
        if (!isfinite(z)) {
            s->without_z++;
            continue;
        }
        to[0] = x;
        to[1] = y;
        to[2] = z;
        to += 3;
    }
    return (size_t)(to - rows) / 3;
}

/* Extent and spread of the survey, with these points. */
static void measure_points(struct survey *s, const double *xyz, size_t n)
{
    double w = s->box[0], e = s->box[1], south = s->box[2], north = s->box[3];
    for (const double *p = xyz; p < xyz + 3 * n; p += 3) {
        w = p[0] < w ? p[0] : w;
        e = p[0] > e ? p[0] : e;
        south = p[1] < south ? p[1] : south;
        north = p[1] > north ? p[1] : north;
    }
    memcpy(s->box, (const double[]){w, e, south, north}, sizeof s->box);
    for (size_t k = 0; k < n && s->spread.over != AN_AREA; k++)
        widen(&s->spread, xyz + 3 * k);
    s->used += (int64_t)n;
}

static enum hm_err add_points(struct survey *s, const double *xyz, size_t n, struct hm_diag *d)
{
    if (n == 0)
        return HM_OK;
    measure_points(s, xyz, n);
    if (!s->hold)
        return hm_cellmean_add(s->cells, xyz, n, d);
    if (!hm_grow(&s->xyz, &s->cap, 3 * (s->n + n), sizeof *s->xyz))
        return hm_fail_memory(d);
    memcpy(s->xyz + 3 * s->n, xyz, 3 * n * sizeof *xyz);
    s->n += n;
    return HM_OK;
}

/* The points of one object on their way. */
struct flow {
    struct hm_cli *cli;
    struct survey *survey;
    struct filter filter;
    size_t nfields;
};

static enum hm_err take_batch(void *arg, struct hm_batch *b, struct hm_diag *d)
{
    const struct flow *f = arg;
    size_t n = pick_points(f->survey, &f->filter, b->rows, b->n, f->nfields);
    hm_cli_progress_points(f->cli, b->n);
    return add_points(f->survey, b->rows, n, d);
}

void read_points(struct hm_cli *cli, struct survey *s, const struct hm_header *h)
{
    struct flow f = {cli, s, make_filter(cli, h), h->nfields};
    struct hm_diag d = {0};
    hm_cli_check(cli, hm_batch_each(hm_cli_reader(cli), h, hm_cli_threads(cli), take_batch, &f, &d),
                 &d);
}

/* Points that span no area tell no surface. */
static void check_spread(struct hm_cli *cli, const struct survey *s)
{
    const char *where = s->has_window ? " in the window" : "";
    if (s->used == 0)
        hm_cli_die(cli, "no points with a height%s%s", where,
                   cmd.classes || cmd.returns != ALL ? " that -c and --returns let pass" : "");
    if (s->spread.over == AN_AREA)
        return;
    hm_cli_die(cli, "the points tell no surface: %s%s",
               s->used == 1                  ? "there is only one"
               : s->spread.over == ONE_PLACE ? "all lie at one place"
                                             : "all lie on one line",
               where);
}

void place_nodes(struct hm_cli *cli, struct survey *s)
{
    struct hm_diag d = {0};
    check_spread(cli, s);
    if (!s->has_window) {
        enum hm_err err = cmd.method != TIN ? hm_anchor_touching(&s->nodes, cmd.spacing, s->box, &d)
                                            : hm_anchor_within(&s->nodes, cmd.spacing, s->box, &d);
        hm_cli_check(cli, err, &d);
        s->out = s->nodes;
    }
    if (s->nodes.nx < 2 || s->nodes.ny < 2)
        hm_cli_die(cli,
                   "the points cover %zu x %zu nodes at a spacing of %g: at least 2 x 2 are "
                   "needed",
                   s->nodes.nx, s->nodes.ny, cmd.spacing);
    s->fine = (struct hm_anchor){cmd.spacing / cmd.over, s->out.i0 * cmd.over, s->out.j0 * cmd.over,
                                 (s->out.nx - 1) * (size_t)cmd.over + 1,
                                 (s->out.ny - 1) * (size_t)cmd.over + 1};
    if (s->has_window) /* nodes between the outermost of `out` and the window's border */
        hm_cli_check(cli, hm_anchor_within(&s->fine, cmd.spacing / cmd.over, s->window, &d), &d);
}
