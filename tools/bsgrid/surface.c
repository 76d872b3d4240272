/* surface.c: from points to the dragged surface. */
#include "bsgrid.h"
#include "hm_blunder.h"
#include "hm_cellsort.h"
#include "hm_gapfill.h"
#include "hm_gridtin.h"
#include "hm_lspia.h"

#include <stdlib.h>
#include <string.h>

/* --- the start grid --- */

static void start_by_triangles(struct hm_cli *cli, struct survey *s, double *z)
{
    struct hm_diag d = {0};
    struct hm_tin tin;
    struct hm_gridtin_count count;
    int threads = hm_cli_threads(cli);
    hm_cli_check(cli, hm_tin_build(&tin, s->xyz, s->n, threads, &d), &d);
    hm_cli_check(cli, hm_gridtin(z, &s->nodes, &tin, cmd.gap, threads, &count, &d), &d);
    s->duplicates = (int64_t)hm_tri_duplicates(tin.tri);
    s->in_gaps = s->has_window ? 0 : (int64_t)count.gap;
    hm_tin_free(&tin);
}

struct hm_cellmean *sum_cells(struct hm_cli *cli, const struct survey *s)
{
    struct hm_cellmean *cells;
    struct hm_diag d = {0};
    hm_cli_check(cli, hm_cellmean_new(&cells, cmd.spacing, false, &d), &d);
    hm_cli_check(cli, hm_cellmean_add(cells, s->xyz, s->n, &d), &d);
    return cells;
}

static void start_by_medians(struct hm_cli *cli, const struct survey *s, double *z)
{
    struct hm_cellsort cells;
    struct hm_diag d = {0};
    hm_cli_check(cli, hm_cellsort_make(&cells, &s->nodes, s->xyz, s->n, &d), &d);
    hm_cli_check(cli, hm_cellsort_medians(&cells, s->xyz, z, &d), &d);
    hm_cellsort_free(&cells);
}

static void start_by_means(struct hm_cli *cli, struct survey *s, double *z)
{
    bool again = cmd.fit == FIT_POINTS || cmd.count || cmd.density;
    struct hm_cellmean *cells = s->hold ? sum_cells(cli, s) : s->cells;
    hm_cellmean_get(cells, &s->nodes, z);
    if (!s->hold && again)
        return;
    hm_cellmean_free(cells);
    s->cells = NULL;
}

static double *make_start(struct hm_cli *cli, struct survey *s)
{
    struct hm_diag d = {0};
    double *z = need(cli, s->nodes.nx * s->nodes.ny, sizeof *z);
    if (cmd.method == TIN) {
        start_by_triangles(cli, s, z);
        return z;
    }
    if (cmd.method == MEAN)
        start_by_means(cli, s, z);
    else
        start_by_medians(cli, s, z);
    hm_cli_check(
        cli,
        hm_gapfill(z, s->nodes.nx, s->nodes.ny, cmd.gap / cmd.spacing, hm_cli_threads(cli), &d),
        &d);
    return z;
}

/* --- the surface --- */

static void drag_to_points(struct hm_cli *cli, const struct survey *s, struct hm_bsurf *b)
{
    struct hm_diag d = {0};
    double rest = 0, *xyz = s->xyz;
    size_t n = s->n;
    if (!s->hold)
        hm_cli_check(cli, hm_cellmean_points(s->cells, &s->nodes, &xyz, &n, &d), &d);
    hm_cli_check(cli,
                 hm_lspia(b, &s->nodes, xyz, n, cmd.iterations, cmd.tolerance, hm_cli_threads(cli),
                          &rest, &d),
                 &d);
    if (hm_cli_verbose(cli))
        hm_cli_say(cli, "root mean square of the points' residuals: %.4g m", rest);
    if (!s->hold)
        free(xyz);
}

/* The nodes become control points, and are dragged. */
static struct hm_bsurf make_surface(struct hm_cli *cli, struct survey *s)
{
    struct hm_bsurf b;
    struct hm_diag d = {0};
    size_t nx = s->nodes.nx, ny = s->nodes.ny;
    hm_cli_stage(cli, "the start grid");
    double *z = make_start(cli, s), rest = 0;
    hm_cli_stage(cli, "dragging");
    hm_cli_check(cli, hm_bsurf_init(&b, cmd.degree, nx, ny, 1, &d), &d);
    for (size_t j = 0; j < ny; j++)
        memcpy(hm_bsurf_at(&b, 0, (int64_t)j), z + j * nx, nx * sizeof *z);
    hm_cli_check(cli, hm_bsurf_set_missing(&b, z, &d), &d);
    if (cmd.fit == FIT_POINTS) {
        drag_to_points(cli, s, &b);
    } else {
        double *measure = hm_cli_verbose(cli) ? &rest : NULL;
        hm_cli_check(
            cli,
            hm_bspline_drag(&b, z, cmd.iterations, cmd.tolerance, hm_cli_threads(cli), measure, &d),
            &d);
        if (measure)
            hm_cli_say(cli, "largest distance from the start grid: %.4g m", rest);
    }
    free(z);
    return b;
}

/* --- blunders --- */

/* Take the blunders out of the points; false when there is none. */
static bool drop_blunders(struct hm_cli *cli, struct survey *s, const struct hm_bsurf *b)
{
    const struct hm_blunder_rule rule = {cmd.blunders, 0.01};
    struct hm_diag d = {0};
    size_t found, kept = 0;
    double sigma;
    bool *bad = hm_alloc0(s->n, sizeof *bad);
    enum hm_err err = bad ? hm_blunder_find(b, &s->nodes, s->xyz, s->n, &rule, hm_cli_threads(cli),
                                            bad, &found, &sigma, &d)
                          : hm_fail_memory(&d);
    hm_cli_check(cli, err, &d);
    for (size_t k = 0; k < s->n; k++)
        if (!bad[k])
            memmove(s->xyz + 3 * kept++, s->xyz + 3 * k, 3 * sizeof *s->xyz);
    free(bad);
    s->n = kept;
    s->used -= (int64_t)found;
    s->blunders += (int64_t)found;
    if (hm_cli_verbose(cli))
        hm_cli_say(cli, "robust standard deviation of the residuals: %.4g m, %zu blunders", sigma,
                   found);
    return found > 0;
}

/* The surface without blunders: each round takes the worst out, whatever it hid is seen next. */
struct hm_bsurf make_clean_surface(struct hm_cli *cli, struct survey *s)
{
    enum { ROUNDS = 12 };
    struct hm_bsurf b = make_surface(cli, s);
    for (int k = 0; cmd.blunders_given && k < ROUNDS && drop_blunders(cli, s, &b); k++) {
        hm_bsurf_free(&b);
        b = make_surface(cli, s);
    }
    return b;
}

static bool is_within(const struct survey *s, const double *p)
{
    const double *w = s->window;
    return !s->has_window || (p[0] >= w[0] && p[0] <= w[1] && p[1] >= w[2] && p[1] <= w[3]);
}

void write_clean(struct hm_cli *cli, const struct survey *s)
{
    struct hm_diag d = {0};
    struct hm_header h;
    struct hm_writer *w;
    struct hm_format format = hm_cli_format(cli);
    format.single = false; /* that is for grids */
    hm_cli_check(cli, hm_header_init(&h, HM_POINTS, &d), &d);
    hm_cli_make_header(cli, &h);
    hm_cli_check(cli, hm_writer_open(&w, cmd.clean, format, &d), &d);
    hm_cli_check(cli, hm_writer_begin(w, &h, &d), &d);
    for (size_t k = 0; k < s->n; k++)
        if (is_within(s, s->xyz + 3 * k))
            hm_cli_check(cli, hm_writer_points(w, s->xyz + 3 * k, 1, &d), &d);
    hm_cli_check(cli, hm_writer_end(w, &d), &d);
    hm_cli_check(cli, hm_writer_close(&w, &d), &d);
    hm_header_free(&h);
}
