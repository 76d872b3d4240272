/* grid.c: the surface as a grid, with what else is known of its nodes. */
#include "bsgrid.h"
#include "hm_bsample.h"
#include "hm_mask.h"

#include <math.h>
#include <stdlib.h>

/* --- what is known of the nodes beside their heights --- */

struct extras {
    double *count; /* of the cells of `cells`, or NULL */
    struct hm_anchor cells;
    bool *in; /* a node written: within the mask; or NULL */
};

static void read_mask(struct hm_cli *cli, const struct survey *s, struct extras *e)
{
    struct hm_lines lines = {0};
    struct hm_reader *r;
    struct hm_header h;
    struct hm_diag d = {0};
    struct hm_lattice l = hm_anchor_lattice(&s->fine);
    hm_cli_check(cli, hm_reader_open(&r, cmd.mask, &d), &d);
    hm_cli_check(cli, hm_reader_next(r, &h, &d), &d);
    if (h.kind != HM_LINES)
        hm_cli_die(cli, "%s: --mask needs lines", cmd.mask);
    hm_cli_check(cli, hm_lines_read(&lines, r, &h, &d), &d);
    e->in = hm_alloc(s->fine.nx * s->fine.ny, sizeof *e->in);
    hm_cli_check(cli, e->in ? hm_mask(e->in, &l, &lines, &d) : hm_fail_memory(&d), &d);
    hm_lines_free(&lines);
    hm_reader_close(r);
}

static struct extras make_extras(struct hm_cli *cli, const struct survey *s)
{
    struct extras e = {.cells = s->out};
    if (cmd.mask)
        read_mask(cli, s, &e);
    if (cmd.count || cmd.density) {
        struct hm_cellmean *cells = s->hold ? sum_cells(cli, s) : s->cells;
        hm_anchor_grow(&e.cells, 2); /* neighbours, also of a node beyond the last of `out` */
        e.count = need(cli, e.cells.nx * e.cells.ny, sizeof *e.count);
        hm_cellmean_counts(cells, &e.cells, e.count);
        if (s->hold)
            hm_cellmean_free(cells);
    }
    return e;
}

/* Points in the cells within `reach` of the cell (i, j), numbered over the whole lattice. */
static double count_around(const struct extras *e, int64_t i, int64_t j, int64_t reach)
{
    double sum = 0;
    for (int64_t b = j - reach; b <= j + reach; b++)
        for (int64_t a = i - reach; a <= i + reach; a++)
            sum += e->count[(size_t)(b - e->cells.j0) * e->cells.nx + (size_t)(a - e->cells.i0)];
    return sum;
}

/* --- the grid out --- */

static void begin_grid(struct hm_cli *cli, const struct survey *s)
{
    const struct {
        bool wanted;
        const char *name, *unit;
    } band[] = {{cmd.derivatives, "dzdx", "1"},
                {cmd.derivatives, "dzdy", "1"},
                {cmd.count, "count", "1"},
                {cmd.density, "density", "1/m2"}};
    struct hm_diag d = {0};
    struct hm_header h;
    hm_cli_check(cli, hm_header_init(&h, HM_GRID, &d), &d);
    h.lattice = hm_anchor_lattice(&s->fine);
    hm_cli_make_header(cli, &h);
    for (size_t k = 0; k < sizeof band / sizeof *band; k++)
        if (band[k].wanted)
            hm_cli_check(cli, hm_header_add_field(&h, band[k].name, band[k].unit, &d), &d);
    hm_cli_check(cli, hm_writer_begin(hm_cli_writer(cli), &h, &d), &d);
    hm_header_free(&h);
}

/* n / over, rounded down, for any sign */
static int64_t coarse(int64_t n)
{
    return (n >= 0 ? n : n - (cmd.over - 1)) / cmd.over;
}

/* A node written: number (i, j) of the fine lattice, between the nodes (a, b) and the next. */
struct place {
    int64_t i, j, a, b;
    bool on_column, on_row; /* it lies on a line of nodes: the next does not matter */
};

/* Heights between nodes count where all of them have data. */
static bool is_known(const struct hm_bsurf *s, const struct place *p)
{
    return hm_bsurf_has_data(s, p->a, p->b) &&
           (p->on_column || hm_bsurf_has_data(s, p->a + 1, p->b)) &&
           (p->on_row || hm_bsurf_has_data(s, p->a, p->b + 1)) &&
           (p->on_column || p->on_row || hm_bsurf_has_data(s, p->a + 1, p->b + 1));
}

/* The surface's slope means something only where the data tell it in both directions. */
static bool tells_slope(const struct hm_bsurf *s, const struct place *p)
{
    bool along = !p->on_column || hm_bsurf_has_data(s, p->a - 1, p->b) ||
                 hm_bsurf_has_data(s, p->a + 1, p->b);
    bool across =
        !p->on_row || hm_bsurf_has_data(s, p->a, p->b - 1) || hm_bsurf_has_data(s, p->a, p->b + 1);
    return along && across;
}

/* Rows of the surface: heights and derivatives. */
struct rows {
    double *z, *zu, *zv;
};

/* What became of the nodes. */
struct nodes {
    size_t empty, overflowed;
};

/* The bands of one node, of which `at` is the place in the rows. */
static double *put_node(const struct survey *s, const struct hm_bsurf *b, const struct extras *e,
                        const struct rows *r, const struct place *p, size_t at, double *to,
                        struct nodes *nodes)
{
    size_t node = (size_t)(p->j - s->fine.j0) * s->fine.nx + (size_t)(p->i - s->fine.i0);
    bool known = is_known(b, p) && (!e->in || e->in[node]);
    *to++ = known && isfinite(r->z[at]) ? r->z[at] : NAN;
    nodes->empty += !known || !isfinite(r->z[at]);
    nodes->overflowed += known && !isfinite(r->z[at]);
    if (cmd.derivatives) {
        bool tells = known && tells_slope(b, p);
        *to++ = tells ? r->zu[at] / cmd.spacing : NAN;
        *to++ = tells ? r->zv[at] / cmd.spacing : NAN;
    }
    int64_t i = coarse(p->i + cmd.over / 2), j = coarse(p->j + cmd.over / 2);
    if (cmd.count)
        *to++ = count_around(e, i, j, 0);
    if (cmd.density)
        *to++ = count_around(e, i, j, 1) / (9 * cmd.spacing * cmd.spacing);
    return to;
}

static void say_odd_nodes(struct hm_cli *cli, const struct survey *s, const struct nodes *n)
{
    if (n->overflowed > 0)
        hm_cli_say(cli, "warning: the heights around %s are too large to reckon with",
                   hm_cli_counted((int64_t)n->overflowed, "node").text);
    else if (n->empty == s->fine.nx * s->fine.ny)
        hm_cli_say(cli, "warning: no node has a height: see the gap limit (-g), %s%s",
                   cmd.region ? "the window (-R), " : "",
                   cmd.mask ? "the mask" : "the spacing (-d)");
}

static void write_rows(struct hm_cli *cli, const struct survey *s, const struct hm_bsurf *b,
                       const struct extras *e, struct hm_bsample *sample)
{
    struct hm_diag d = {0};
    size_t bands = 1 + 2 * (size_t)cmd.derivatives + cmd.count + cmd.density;
    struct nodes nodes = {0};
    size_t width = (s->nodes.nx - 1) * (size_t)cmd.over + 1;
    double *z = need(cli, 3 * width, sizeof *z), *row = need(cli, s->fine.nx * bands, sizeof *row);
    struct rows r = {z, cmd.derivatives ? z + width : NULL, cmd.derivatives ? z + 2 * width : NULL};
    struct place p;
    for (p.j = s->fine.j0; p.j < s->fine.j0 + (int64_t)s->fine.ny; p.j++) {
        hm_bsample_row(sample, (size_t)(p.j - s->nodes.j0 * cmd.over), r.z, r.zu, r.zv);
        p.b = coarse(p.j) - s->nodes.j0;
        p.on_row = p.j % cmd.over == 0;
        double *to = row;
        for (p.i = s->fine.i0; p.i < s->fine.i0 + (int64_t)s->fine.nx; p.i++) {
            p.a = coarse(p.i) - s->nodes.i0;
            p.on_column = p.i % cmd.over == 0;
            size_t at = (size_t)(p.i - s->nodes.i0 * cmd.over);
            to = put_node(s, b, e, &r, &p, at, to, &nodes);
        }
        hm_cli_check(cli, hm_writer_row(hm_cli_writer(cli), row, &d), &d);
        hm_cli_progress(cli, "writing", (double)(p.j - s->fine.j0 + 1) / (double)s->fine.ny);
    }
    hm_cli_check(cli, hm_writer_end(hm_cli_writer(cli), &d), &d);
    hm_cli_say(cli, "%s, %zu x %zu nodes, %zu of them empty (nan)",
               hm_cli_counted(s->used, "point").text, s->fine.nx, s->fine.ny, nodes.empty);
    say_odd_nodes(cli, s, &nodes);
    free(z);
    free(row);
}

void write_grid(struct hm_cli *cli, const struct survey *s, const struct hm_bsurf *b)
{
    struct hm_diag d = {0};
    struct hm_bsample *sample;
    struct extras e = make_extras(cli, s);
    hm_cli_check(cli, hm_bsample_new(&sample, b, cmd.over, &d), &d);
    begin_grid(cli, s);
    write_rows(cli, s, b, &e, sample);
    hm_bsample_free(sample);
    free(e.count);
    free(e.in);
}
