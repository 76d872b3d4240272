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

/* The node of which the fine node n is part: n / over, rounded. */
static int64_t nearest(int64_t n)
{
    return coarse(n + cmd.over / 2);
}

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

/* The grid on its way out. */
struct flow {
    const struct survey *s;
    const struct hm_bsurf *b;
    struct extras e;
    struct rows rows;
    size_t empty, overflowed; /* nodes */
};

/* The bands of one node. */
static double *put_node(struct flow *f, const struct place *p, double *to)
{
    const struct hm_anchor *fine = &f->s->fine;
    size_t node = (size_t)(p->j - fine->j0) * fine->nx + (size_t)(p->i - fine->i0);
    size_t at = (size_t)(p->i - f->s->nodes.i0 * cmd.over);
    double z = f->rows.z[at];
    bool known = is_known(f->b, p) && (!f->e.in || f->e.in[node]);
    bool good = known && isfinite(z);
    *to++ = good ? z : NAN;
    f->empty += !good;
    f->overflowed += known && !good;
    if (cmd.derivatives) {
        bool tells = known && tells_slope(f->b, p);
        *to++ = tells ? f->rows.zu[at] / cmd.spacing : NAN;
        *to++ = tells ? f->rows.zv[at] / cmd.spacing : NAN;
    }
    if (cmd.count)
        *to++ = count_around(&f->e, nearest(p->i), nearest(p->j), 0);
    if (cmd.density)
        *to++ =
            count_around(&f->e, nearest(p->i), nearest(p->j), 1) / (9 * cmd.spacing * cmd.spacing);
    return to;
}

/* The bands of row j of the fine lattice. */
static void put_row(struct flow *f, int64_t j, double *to)
{
    const struct hm_anchor *fine = &f->s->fine, *nodes = &f->s->nodes;
    struct place p = {.i = fine->i0, .j = j, .a = coarse(fine->i0), .b = coarse(j) - nodes->j0};
    int64_t beyond = p.i - p.a * cmd.over; /* the line of nodes before */
    p.a -= nodes->i0;
    p.on_row = j % cmd.over == 0;
    for (size_t k = 0; k < fine->nx; k++, p.i++) {
        p.on_column = beyond == 0;
        to = put_node(f, &p, to);
        if (++beyond == cmd.over) {
            beyond = 0;
            p.a++;
        }
    }
}

static void say_nodes(struct hm_cli *cli, const struct flow *f)
{
    const struct hm_anchor *fine = &f->s->fine;
    hm_cli_say(cli, "%s, %zu x %zu nodes, %zu of them empty (nan)",
               hm_cli_counted(f->s->used, "point").text, fine->nx, fine->ny, f->empty);
    if (f->overflowed > 0)
        hm_cli_say(cli, "warning: the heights around %s are too large to reckon with",
                   hm_cli_counted((int64_t)f->overflowed, "node").text);
    else if (f->empty == fine->nx * fine->ny)
        hm_cli_say(cli, "warning: no node has a height: see the gap limit (-g), %s%s",
                   cmd.region ? "the window (-R), " : "",
                   cmd.mask ? "the mask" : "the spacing (-d)");
}

static void write_rows(struct hm_cli *cli, struct flow *f, struct hm_bsample *sample)
{
    struct hm_diag d = {0};
    const struct hm_anchor *fine = &f->s->fine, *nodes = &f->s->nodes;
    size_t bands = 1 + 2 * (size_t)cmd.derivatives + cmd.count + cmd.density;
    size_t width = (nodes->nx - 1) * (size_t)cmd.over + 1;
    double *z = need(cli, 3 * width, sizeof *z), *row = need(cli, fine->nx * bands, sizeof *row);
    f->rows = cmd.derivatives ? (struct rows){z, z + width, z + 2 * width} : (struct rows){.z = z};
    for (size_t k = 0; k < fine->ny; k++) {
        int64_t j = fine->j0 + (int64_t)k;
        hm_bsample_row(sample, (size_t)(j - nodes->j0 * cmd.over), f->rows.z, f->rows.zu,
                       f->rows.zv);
        put_row(f, j, row);
        hm_cli_check(cli, hm_writer_row(hm_cli_writer(cli), row, &d), &d);
        hm_cli_progress(cli, "writing", (double)(k + 1) / (double)fine->ny);
    }
    hm_cli_check(cli, hm_writer_end(hm_cli_writer(cli), &d), &d);
    free(z);
    free(row);
}

void write_grid(struct hm_cli *cli, const struct survey *s, const struct hm_bsurf *b)
{
    struct hm_diag d = {0};
    struct hm_bsample *sample;
    struct flow f = {.s = s, .b = b, .e = make_extras(cli, s)};
    hm_cli_check(cli, hm_bsample_new(&sample, b, cmd.over, &d), &d);
    begin_grid(cli, s);
    write_rows(cli, &f, sample);
    say_nodes(cli, &f);
    hm_bsample_free(sample);
    free(f.e.count);
    free(f.e.in);
}
