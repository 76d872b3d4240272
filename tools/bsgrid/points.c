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

static enum hm_err add_point(struct survey *s, const double *p, struct hm_diag *d)
{
    if (p[0] < s->reach[0] || p[0] > s->reach[1] || p[1] < s->reach[2] || p[1] > s->reach[3])
        return HM_OK;
    if (!isfinite(p[2])) {
        s->without_z++;
        return HM_OK;
    }
    s->used++;
    widen(&s->spread, p);
    s->box[0] = fmin(s->box[0], p[0]);
    s->box[1] = fmax(s->box[1], p[0]);
    s->box[2] = fmin(s->box[2], p[1]);
    s->box[3] = fmax(s->box[3], p[1]);
    if (!s->hold)
        return hm_cellmean_add(s->cells, p[0], p[1], p[2], d);
    if (!hm_grow(&s->xyz, &s->cap, 3 * (s->n + 1), sizeof *s->xyz))
        return hm_fail_memory(d);
    memcpy(s->xyz + 3 * s->n++, p, 3 * sizeof *p);
    return HM_OK;
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

static bool is_wanted(const struct survey *s, const struct filter *f, const double *p)
{
    if (f->class >= 0 &&
        !(p[f->class] >= 0 && p[f->class] < CLASSES && s->wanted[(int)p[f->class]]))
        return false;
    switch (cmd.returns) {
    case FIRST:
        return p[f->number] == 1;
    case LAST:
        return p[f->number] == p[f->of];
    case ONLY:
        return p[f->of] == 1;
    default:
        return true;
    }
}

void read_points(struct hm_cli *cli, struct survey *s, const struct hm_header *h)
{
    struct hm_reader *r = hm_cli_reader(cli);
    struct filter filter = make_filter(cli, h);
    struct hm_diag d = {0};
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_batch_read(&b, r, h, &d))) {
        for (size_t k = 0; k < b.n && !err; k++) {
            const double *p = b.rows + k * h->nfields;
            if (is_wanted(s, &filter, p))
                err = add_point(s, p, &d);
        }
        hm_cli_progress_points(cli, b.n);
    }
    hm_cli_check(cli, err, &d);
    hm_batch_free(&b);
}

/* Points that span no area tell no surface. */
static void check_spread(struct hm_cli *cli, const struct survey *s)
{
    const char *where = s->has_window ? " in the window" : "";
    if (s->used == 0)
        hm_cli_die(cli, "no points with a height%s", where);
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
