/* bsgrid: points to an analysis grid on a B-spline surface. */
#include "bsgrid/bsgrid.h"
#include "hm_num.h"
#include "hm_output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct command cmd = {.spacing = 1, .degree = 2, .iterations = 1, .over = 1, .blunders = 6};

static const struct hm_option options[] = {
    {'d', "spacing", "M", HM_OPT_POSITIVE, &cmd.spacing,
     .help = "distance of the nodes, m (default 1)"},
    {'R', "region", "W/E/S/N", HM_OPT_TEXT, &cmd.region,
     .help = "window to grid (default: all that the points cover)"},
    {'m', "method", "NAME", HM_OPT_CHOICE, &cmd.method,
     .help = "start grid: by triangles, means or medians of cells (default tin)",
     .choices = "tin|mean|median"},
    {'k', "degree", "K", HM_OPT_NATURAL, &cmd.degree,
     .help = "degree of the surface: 1, 2 or 3 (default 2)"},
    {'n', "iterations", "N", HM_OPT_NATURAL, &cmd.iterations,
     .help = "iterations of dragging (default 1; fewer smooth more)"},
    {'t', "tolerance", "M", HM_OPT_POSITIVE, &cmd.tolerance,
     .help = "end dragging once no control point moves by more, m (default 0)"},
    {'f', "fit", "NAME", HM_OPT_CHOICE, &cmd.fit,
     .help = "drag towards the start grid or the points themselves (default grid)",
     .choices = "grid|points"},
    {'g', "gap", "M", HM_OPT_POSITIVE, &cmd.gap,
     .help = "wider gaps between points stay empty, m (default 10 spacings)",
     .given = &cmd.gap_given},
    {'O', "oversample", "N", HM_OPT_NATURAL, &cmd.over,
     .help = "write the surface N times as fine as the nodes (default 1)"},
    {'c', "classes", "N[,...]", HM_OPT_TEXT, &cmd.classes,
     .help = "take only points of these classes"},
    {0, "returns", "NAME", HM_OPT_CHOICE, &cmd.returns,
     .help = "take only these returns of a pulse (default all)", .choices = "all|first|last|only"},
    {'B', "blunders", "K", HM_OPT_POSITIVE, &cmd.blunders,
     .help = "leave out points over K robust standard deviations off the surface",
     .given = &cmd.blunders_given},
    {0, "clean", "FILE", HM_OPT_TEXT, &cmd.clean,
     .help = "write the points without blunders to FILE (-B 6, if not given)", .silent = true},
    {0, "mask", "FILE", HM_OPT_TEXT, &cmd.mask,
     .help = "leave nodes empty outside of these closed lines", .silent = true},
    {0, "derivatives", NULL, HM_OPT_FLAG, &cmd.derivatives,
     .help = "add the bands dzdx and dzdy, for slope -m bspline"},
    {0, "count", NULL, HM_OPT_FLAG, &cmd.count,
     .help = "add the band count: points in the node's cell"},
    {0, "density", NULL, HM_OPT_FLAG, &cmd.density,
     .help = "add the band density: points a square metre in the 3 x 3 cells around"},
    {0, "single", NULL, HM_OPT_FLAG, &cmd.single,
     .help = "write a binary grid of single precision, half as long"},
    {0}};

static const struct hm_program program = {
    .name = "bsgrid",
    .purpose = "points → analysis grid on a B-spline surface",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_POINTS,
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
    if (cmd.over < 1 || cmd.over > 100)
        hm_cli_die(cli, "-O: from 1 to 100 nodes for one");
    if (cmd.single)
        hm_cli_set_single(cli);
    if (cmd.clean)
        hm_cli_check(cli, hm_output_check(cmd.clean, &d), &d);
    cmd.blunders_given = cmd.blunders_given || cmd.clean;
    if (!cmd.gap_given)
        cmd.gap = 10 * cmd.spacing;
    if (cmd.region)
        parse_region(cli, &s);
    if (cmd.classes)
        parse_classes(cli, &s);
    s.hold = cmd.method != MEAN || cmd.blunders_given;
    if (!s.hold)
        hm_cli_check(cli, hm_cellmean_new(&s.cells, cmd.spacing, cmd.fit == FIT_POINTS, &d), &d);
    return s;
}

static void say_what_was_mended(struct hm_cli *cli, const struct survey *s)
{
    hm_cli_mended_points(cli, s->without_z, s->duplicates);
    hm_cli_mended(cli, s->blunders, "%s left out", hm_cli_counted(s->blunders, "blunder").text);
    if (s->in_gaps > 0)
        hm_cli_say(cli, "%s in gaps over %g m (-g) left empty",
                   hm_cli_counted(s->in_gaps, "node").text, cmd.gap);
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
    struct hm_bsurf b = make_clean_surface(cli, &s);
    say_what_was_mended(cli, &s);
    if (cmd.clean)
        write_clean(cli, &s);
    write_grid(cli, &s, &b);
    hm_bsurf_free(&b);
    hm_cellmean_free(s.cells);
    free(s.xyz);
    return hm_cli_finish(cli);
}
