/* trimesh: points, lines and regular meshes → the irregular mesh around them.
 *
 * Section 6 of the paper. Assembles the domain (hm_assemble), brings its edges between two lengths
 * (hm_paper), takes the heights of what is new from the terrain, writes one mesh.
 */
#include "hm_assemble.h"
#include "hm_cli.h"
#include "hm_elem.h"
#include "hm_even.h"
#include "hm_fence.h"
#include "hm_fit.h"
#include "hm_greedy.h"
#include "hm_owners.h"
#include "hm_paper.h"
#include "hm_plane.h"
#include "hm_ruppert.h"
#include "hm_settle.h"
#include "hm_trim.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum method { DELAUNAY, PAPER, QUALITY, TERRAIN };
enum elevation { Z_TERRAIN, Z_MEAN, Z_FIT };
enum line_z { LINE_GIVEN, LINE_TERRAIN };

enum {
    MOST_ANGLE = 34, /* degrees; refinement need not end beyond */
    MOST_TURNS = 8   /* of insertion and refinement */
};

/* What the regular meshes keep clear at least (m): lidar's own resolution. */
#define LEAST_CLEARANCE 0.001

/* Sizes of a grid grow by no more than this a unit of the way. */
#define GRID_GROWTH 0.3

static struct {
    int method, elevation, line_z;
    double min_edge, max_edge, min_angle, max_area, gradation, max_error, clearance;
    int max_nodes;
    bool min_given, max_given, angle_given, area_given, gradation_given, error_given, nodes_given,
        clearance_given, smooth_given;
    int smooth;
    const char *sizes, *steps;
} cmd = {.method = PAPER, .min_angle = 20, .gradation = 2, .smooth = 5};

static const struct hm_option options[] = {
    {'m', "method", "METHOD", HM_OPT_CHOICE, &cmd.method,
     .help = "points; edges -l to -L; angles over -q; errors to -e (default paper)",
     .choices = "delaunay|paper|quality|terrain"},
    {'l', "min-edge", "M", HM_OPT_POSITIVE, &cmd.min_edge, .help = "minimum edge length, m",
     .given = &cmd.min_given},
    {'L', "max-edge", "M", HM_OPT_POSITIVE, &cmd.max_edge,
     .help = "maximum edge length, m (default with paper: 2.5 times the minimum)",
     .given = &cmd.max_given},
    {'q', "min-angle", "DEGREES", HM_OPT_NUMBER, &cmd.min_angle,
     .help = "minimum angle, at most 34 degrees (default 20)", .given = &cmd.angle_given},
    {'a', "max-area", "M2", HM_OPT_POSITIVE, &cmd.max_area,
     .help = "maximum area of an element, m2 (default: any)", .given = &cmd.area_given},
    {'s', "sizes", "FILE", HM_OPT_TEXT, &cmd.sizes,
     .help = "maximum edge lengths by place, m: this grid", .silent = true},
    {'g', "gradation", "RATIO", HM_OPT_NUMBER, &cmd.gradation,
     .help = "largest ratio of areas of neighbours, or 0 (default 2, terrain 0)",
     .given = &cmd.gradation_given},
    {'e', "max-error", "M", HM_OPT_POSITIVE, &cmd.max_error,
     .help = "maximum vertical error at measurements, m (default: as -N allows)",
     .given = &cmd.error_given},
    {'N', "max-nodes", "N", HM_OPT_NATURAL, &cmd.max_nodes,
     .help = "maximum number of nodes, before refinement (default: as -e wants)",
     .given = &cmd.nodes_given},
    {'i', "smooth", "N", HM_OPT_NATURAL, &cmd.smooth,
     .help = "passes of Laplace smoothing (default 5)", .given = &cmd.smooth_given},
    {'z', "elevation", "FROM", HM_OPT_CHOICE, &cmd.elevation,
     .help = "heights: the terrain, neighbours' mean, or fitted (default terrain)",
     .choices = "terrain|mean|fit"},
    {'C', "clearance", "M", HM_OPT_POSITIVE, &cmd.clearance,
     .help = "cut off what is nearer to a regular mesh, m (default half of -l)",
     .given = &cmd.clearance_given},
    {0, "line-z", "FROM", HM_OPT_CHOICE, &cmd.line_z,
     .help = "heights of breaklines: their own, or the terrain's (default given)",
     .choices = "given|terrain"},
    {0, "steps", "DIR", HM_OPT_TEXT, &cmd.steps,
     .help = "write the mesh after every round into DIR", .silent = true},
    {0}};

static const struct hm_program program = {
    .name = "trimesh",
    .purpose = "points, lines and regular meshes → the irregular mesh around them",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_ANY,
    .without = "p"}; /* a mesh is written exactly */

static void check_lengths(struct hm_cli *cli)
{
    if (cmd.method == PAPER && !cmd.min_given)
        hm_cli_die(cli, "-m paper needs a minimum edge length (-l)");
    if (cmd.method == PAPER && !cmd.max_given)
        cmd.max_edge = 2.5 * cmd.min_edge;
    if (cmd.max_edge > 0 && cmd.max_edge <= cmd.min_edge)
        hm_cli_die(cli, "the maximum edge (-L %g) must be more than the minimum (-l %g)",
                   cmd.max_edge, cmd.min_edge);
    if (cmd.max_edge > 0 && cmd.max_edge < 2 * cmd.min_edge)
        hm_cli_say(cli, "the maximum edge is under twice the minimum: not all edges can keep "
                        "to both");
}

static void check_angle(struct hm_cli *cli)
{
    if (!(cmd.min_angle >= 0 && cmd.min_angle <= MOST_ANGLE))
        hm_cli_die(cli, "a minimum angle of %g degrees: 0 to %d can be reached", cmd.min_angle,
                   MOST_ANGLE);
}

static void check_gradation(struct hm_cli *cli)
{
    if (cmd.method != QUALITY && !cmd.gradation_given)
        cmd.gradation = 0;
    if (cmd.gradation != 0 && !(cmd.gradation > 1))
        hm_cli_die(cli, "a gradation of %g: more than 1, or 0 for any", cmd.gradation);
}

/* An option that another method understands. */
static void refuse(struct hm_cli *cli, bool given, const char *option, const char *method)
{
    if (given)
        hm_cli_die(cli, "%s means nothing with -m %s", option, method);
}

static void make_steps_folder(struct hm_cli *cli)
{
    if (strlen(cmd.steps) > 4000)
        hm_cli_die(cli, "%s: name too long", cmd.steps);
    if ((mkdir(cmd.steps, 0777) && errno != EEXIST) || access(cmd.steps, W_OK | X_OK))
        hm_cli_die(cli, "%s: %s", cmd.steps, strerror(errno));
}

static void check_command(struct hm_cli *cli)
{
    static const char *const name[] = {"delaunay", "paper", "quality", "terrain"};
    const bool refines = cmd.method == QUALITY || cmd.method == TERRAIN;
    if (cmd.method == PAPER || cmd.method == TERRAIN)
        check_lengths(cli);
    refuse(cli, cmd.method != PAPER && cmd.steps, "--steps", name[cmd.method]);
    refuse(cli, cmd.method != PAPER && cmd.elevation == Z_MEAN, "-z mean", name[cmd.method]);
    refuse(cli, !refines && cmd.angle_given, "-q", name[cmd.method]);
    refuse(cli, !refines && cmd.area_given, "-a", name[cmd.method]);
    refuse(cli, !refines && cmd.sizes, "-s", name[cmd.method]);
    refuse(cli, !refines && cmd.gradation_given, "-g", name[cmd.method]);
    refuse(cli, cmd.method == QUALITY && cmd.min_given, "-l", name[cmd.method]);
    refuse(cli, cmd.method == DELAUNAY && cmd.min_given, "-l", name[cmd.method]);
    refuse(cli, cmd.method == DELAUNAY && cmd.max_given, "-L", name[cmd.method]);
    refuse(cli, (cmd.method == DELAUNAY || cmd.method == QUALITY) && cmd.smooth_given, "-i",
           name[cmd.method]);
    refuse(cli, cmd.method != TERRAIN && cmd.error_given, "-e", name[cmd.method]);
    refuse(cli, cmd.method != TERRAIN && cmd.nodes_given, "-N", name[cmd.method]);
    if (cmd.method == TERRAIN && !cmd.error_given && cmd.max_nodes == 0)
        hm_cli_die(cli, "-m terrain needs a maximum error (-e) or number of nodes (-N)");
    check_angle(cli);
    check_gradation(cli);
    if (cmd.steps)
        make_steps_folder(cli);
}

/* --- terrain --- */

/* The terrain, and its measurements where errors are measured at them or heights fitted to them. */
struct ground {
    struct hm_terrain *terrain;
    double *xyz;
    size_t n;
};

static struct hm_terrain *build_terrain(struct hm_cli *cli, const struct hm_inputs *in)
{
    struct hm_diag d = {0};
    struct hm_terrain *terrain;
    struct hm_terrain_counts counts;
    hm_cli_check(cli, hm_terrain_build(&terrain, in, 0, hm_cli_threads(cli), &counts, &d), &d);
    hm_cli_mended_points(cli, counts.without_z, counts.duplicates);
    return terrain;
}

static struct ground build_ground(struct hm_cli *cli, const struct hm_inputs *in)
{
    struct hm_diag d = {0};
    struct ground ground = {.terrain = build_terrain(cli, in)};
    if (cmd.method != TERRAIN && cmd.elevation != Z_FIT)
        return ground;
    hm_cli_check(cli, hm_terrain_measurements(ground.terrain, &ground.xyz, &ground.n, &d), &d);
    if (ground.n == 0)
        hm_cli_die(cli, "%s needs measurements", cmd.method == TERRAIN ? "-m terrain" : "-z fit");
    return ground;
}

static void free_ground(struct ground *ground)
{
    hm_terrain_free(ground->terrain);
    free(ground->xyz);
}

/* --- the mesh around --- */

static void say_mend(void *cli, enum hm_tri_mend what, double x, double y)
{
    static const char *const name[HM_TRI_MENDS] = {"lines cross", "a node on a line",
                                                   "a piece drawn twice", "a piece without length"};
    hm_cli_say(cli, "%s at %.12g %.12g", name[what], x, y);
}

static void say_assembly(struct hm_cli *cli, const struct hm_assembly_counts *c)
{
    hm_cli_mended(cli, c->duplicates, "%s at a node of a line or a regular mesh left out",
                  hm_cli_counted(c->duplicates, "measurement").text);
    hm_cli_mended(cli, c->crossings + c->on_lines + c->overlaps + c->zero_length,
                  "lines mended: %s, %s on a line, %s drawn twice, %lld without length",
                  hm_cli_counted(c->crossings, "crossing").text,
                  hm_cli_counted(c->on_lines, "node").text,
                  hm_cli_counted(c->overlaps, "piece").text, (long long)c->zero_length);
    if (c->near_points > 0 && cmd.method < QUALITY)
        hm_cli_say(cli, "%s within %g m of a regular mesh's boundary left out",
                   hm_cli_counted(c->near_points, "measurement").text, cmd.clearance);
    if (c->outside_points > 0)
        hm_cli_say(cli, "%s outside the domain, for heights only",
                   hm_cli_counted(c->outside_points, "measurement").text);
    if (c->cut_lines > 0)
        hm_cli_say(cli, "%lld of %s cut: %.0f of %.0f m inside a regular mesh or within %g m of it",
                   (long long)c->cut_lines, hm_cli_counted(c->breaklines, "breakline").text,
                   c->near_length, c->length, cmd.clearance);
    if (c->outside_length > 0)
        hm_cli_say(cli, "%.0f of %.0f m of breaklines outside the domain left out",
                   c->outside_length, c->length);
    if (c->idle_holes > 0)
        hm_cli_say(cli, "%s outside the outline", hm_cli_counted(c->idle_holes, "hole").text);
    if (c->line_heights > 0)
        hm_cli_say(cli, "%s of breaklines with their height from the terrain",
                   hm_cli_counted(c->line_heights, "vertex").text);
    if (cmd.method == PAPER && c->median_segment > 0 && c->median_segment < cmd.min_edge / 2)
        hm_cli_say(
            cli,
            "half of the breaklines' segments are under %.3g m, which forces edges as short: "
            "resample them (breaklines -r %g)",
            c->median_segment, cmd.min_edge);
}

static void say_left(struct hm_cli *cli, const struct hm_paper_left *left)
{
    if (left->too_short > 0)
        hm_cli_say(cli, "%s under %g m left, %lld of them between fixed nodes",
                   hm_cli_counted(left->too_short, "edge").text, cmd.min_edge,
                   (long long)left->too_short_fixed);
    if (left->too_long > 0)
        hm_cli_say(cli, "%s over %g m left, %lld of them at regular meshes",
                   hm_cli_counted(left->too_long, "edge").text, cmd.max_edge,
                   (long long)left->too_long_regular);
    if (left->fixed_short + left->fixed_long > 0)
        hm_cli_say(cli, "%s under the minimum, %lld over the maximum",
                   hm_cli_counted(left->fixed_short, "fixed edge").text,
                   (long long)left->fixed_long);
}

/* --- steps --- */

struct steps {
    struct hm_cli *cli;
    const struct hm_header *header;
    int n;
};

static enum hm_err write_step(void *arg, const struct hm_domain *dom, const char *what,
                              struct hm_diag *d)
{
    struct steps *s = arg;
    char path[4096];
    int dir = snprintf(path, sizeof path, "%s/%03d-", cmd.steps, ++s->n);
    snprintf(path + dir, sizeof path - (size_t)dir, "%s.hm", what);
    for (char *c = path + dir; *c; c++)
        if (*c == ' ')
            *c = '-';
    struct hm_mesh mesh = {0};
    struct hm_writer *w = NULL;
    enum hm_err err = hm_header_copy(&mesh.header, s->header, d);
    if (!err)
        err = hm_domain_mesh(dom, &mesh, d);
    if (!err)
        err = hm_writer_open(&w, path, hm_cli_format(s->cli), d);
    if (!err)
        err = hm_mesh_write(&mesh, w, d);
    if (!err)
        err = hm_writer_close(&w, d);
    else
        hm_writer_abandon(w);
    hm_mesh_free(&mesh);
    return err;
}

/* --- the product --- */

/* The header of the mesh. Owner number k is the k-th name of #owners. */
static void make_header(struct hm_cli *cli, struct hm_inputs *in, struct hm_header *h)
{
    struct hm_diag d = {0};
    hm_cli_check(cli, hm_header_init(h, HM_MESH, &d), &d);
    hm_cli_make_header(cli, h);
    hm_cli_check(cli, hm_header_set(h, "name", "floodplain", &d), &d);
    hm_cli_check(cli, hm_header_set(h, "role", "irregular", &d), &d);
    char *owners = NULL;
    hm_cli_check(cli, hm_owners_join(in->mesh, in->nmeshes, &owners, &d), &d);
    hm_cli_check(cli, hm_header_set(h, "owners", *owners ? owners : NULL, &d), &d);
    free(owners);
}

/* Half the minimum edge, or a quarter of the side of the largest element: of those beside regular
 * meshes, when no size is given. */
static void choose_clearance(struct hm_cli *cli, const struct hm_inputs *in)
{
    struct hm_diag d = {0};
    double side = cmd.max_edge > 0 ? cmd.max_edge : sqrt(cmd.max_area * 4 / sqrt(3));
    if (cmd.clearance_given)
        return;
    if (side == 0)
        hm_cli_check(cli, hm_fence_median_edge(in->mesh, in->nmeshes, &side, &d), &d);
    cmd.clearance = fmax(cmd.min_given ? cmd.min_edge / 2 : side / 4, LEAST_CLEARANCE);
}

static void assemble(struct hm_cli *cli, const struct hm_inputs *in,
                     const struct hm_terrain *terrain, struct hm_domain *dom)
{
    struct hm_diag d = {0};
    struct hm_assembly_counts counts;
    const struct hm_assembly assembly = {.points = in->points,
                                         .lines = in->lines,
                                         .meshes = in->mesh,
                                         .npoints = in->npoints,
                                         .nlines = in->nlines,
                                         .nmeshes = in->nmeshes,
                                         .terrain = terrain,
                                         .clearance = cmd.clearance,
                                         .heights_only =
                                             cmd.method == QUALITY || cmd.method == TERRAIN,
                                         .line_z_terrain = cmd.line_z == LINE_TERRAIN,
                                         .threads = hm_cli_threads(cli),
                                         .mended = hm_cli_verbose(cli) ? say_mend : NULL,
                                         .who = cli};
    hm_cli_check(cli, hm_assemble(&assembly, dom, &counts, &d), &d);
    say_assembly(cli, &counts);
    int64_t trimmed;
    hm_cli_check(cli, hm_trim_breaklines(dom, cmd.clearance, hm_cli_threads(cli), &trimmed, &d),
                 &d);
    if (trimmed > 0)
        hm_cli_say(cli,
                   "%s of breaklines left out: nearer than %g m to a crossing, loose ends to "
                   "an outline, or tips of spikes",
                   hm_cli_counted(trimmed, "vertex").text, cmd.clearance);
}

static void bring_to_lengths(struct hm_cli *cli, const struct hm_header *header,
                             struct hm_domain *dom)
{
    struct hm_diag d = {0};
    struct hm_paper_left left;
    struct steps steps = {.cli = cli, .header = header};
    struct hm_paper_options o = {
        .bounds = {.least = cmd.min_edge, .most = cmd.max_edge, .clearance = cmd.min_edge / 2},
        .smooth = cmd.smooth,
        .threads = hm_cli_threads(cli)};
    if (cmd.steps) {
        o.watch = write_step;
        o.arg = &steps;
        hm_cli_check(cli, write_step(&steps, dom, "start", &d), &d);
    }
    hm_cli_stage(cli, "the edges");
    hm_cli_check(cli, hm_paper_reach(dom, &o, &left, &d), &d);
    say_left(cli, &left);
}

/* The sizes asked for; those of a grid stay in it. */
static void read_sizes(struct hm_cli *cli, struct hm_grid *grid, struct hm_sizes *sizes)
{
    struct hm_diag d = {0};
    struct hm_reader *r;
    struct hm_header h;
    sizes->max_area = cmd.max_area;
    sizes->max_edge = cmd.max_edge;
    if (!cmd.sizes)
        return;
    hm_cli_check(cli, hm_reader_open(&r, cmd.sizes, &d), &d);
    hm_cli_check(cli, hm_reader_next(r, &h, &d), &d);
    if (h.kind != HM_GRID)
        hm_cli_die(cli, "%s: not a grid", cmd.sizes);
    int column = hm_header_field(&h, "size");
    sizes->band = column < 2 ? 0 : (size_t)column - 2;
    hm_cli_check(cli, hm_grid_read(grid, r, &h, &d), &d);
    hm_reader_close(r);
    hm_cli_check(cli, hm_sizes_limit(grid, sizes->band, GRID_GROWTH, &d), &d);
    sizes->grid = grid;
}

/* What refinement could not reach. */
struct refined {
    struct hm_tri_refined angles;
    struct hm_even_left pairs;
};

static bool refines(void)
{
    return cmd.method == QUALITY || cmd.angle_given || cmd.area_given || cmd.max_given ||
           cmd.sizes || cmd.gradation > 0;
}

/* Degrees; 0: any. */
static double least_angle(void)
{
    return cmd.method == QUALITY || (cmd.method == TERRAIN && cmd.angle_given) ? cmd.min_angle : 0;
}

/* Edges grow by the root of what areas may. */
static void refine(struct hm_cli *cli, struct hm_domain *dom, const struct hm_sizes *sizes,
                   struct refined *left)
{
    struct hm_diag d = {0};
    const struct hm_ruppert_options o = {.min_angle = least_angle(),
                                         .growth = cmd.gradation > 0 ? sqrt(cmd.gradation) - 1 : 0,
                                         .sizes = sizes,
                                         .threads = hm_cli_threads(cli)};
    const struct hm_even_options even = {.ratio = cmd.gradation,
                                         .min_angle = least_angle(),
                                         .sizes = sizes,
                                         .threads = hm_cli_threads(cli)};
    hm_cli_stage(cli, "angles and sizes");
    hm_cli_check(cli, hm_ruppert_reach(dom, &o, &left->angles, &d), &d);
    left->pairs = (struct hm_even_left){0};
    if (cmd.gradation > 0)
        hm_cli_check(cli, hm_even_reach(dom, &even, &left->pairs, &d), &d);
}

static void say_refined(struct hm_cli *cli, const struct refined *left)
{
    const struct hm_tri_refined *r = &left->angles;
    const struct hm_even_left *pairs = &left->pairs;
    if (r->large > 0 && (cmd.max_area > 0 || cmd.max_edge > 0 || cmd.sizes))
        hm_cli_say(cli, "%s over the maximum size left, at regular meshes",
                   hm_cli_counted(r->large, "element").text);
    if (pairs->pairs > 0)
        hm_cli_say(cli,
                   "%s of over %g times another's area left between fixed nodes, %lld at "
                   "regular meshes; the largest ratio, %.3g, at %.10g %.10g",
                   hm_cli_counted(pairs->pairs, "element").text, cmd.gradation,
                   (long long)pairs->regular, pairs->worst, pairs->x, pairs->y);
}

/* Of the mesh as it is written: much gets better after refinement. */
static void say_angles(struct hm_cli *cli, const struct hm_mesh *m)
{
    const double want = least_angle(), rounding = 1e-9;
    const struct hm_node *apex = NULL;
    double smallest = 180;
    int64_t small = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        double least = 180;
        for (int i = 0; i < 3; i++) {
            const int32_t *n = m->elem[k].node;
            const struct hm_node *at = &m->node[n[i]];
            double angle =
                hm_plane_angle(&at->x, &m->node[n[(i + 1) % 3]].x, &m->node[n[(i + 2) % 3]].x);
            least = fmin(least, angle);
            apex = angle < smallest ? at : apex;
            smallest = fmin(smallest, angle);
        }
        small += least < want - rounding;
    }
    if (small > 0)
        hm_cli_say(cli,
                   "%s under %g degrees left, at small angles of the lines or at "
                   "regular meshes; the smallest, %.3g degrees, at %.10g %.10g",
                   hm_cli_counted(small, "element").text, want, smallest, apex->x, apex->y);
}

/* New and moved nodes get the terrain's height; in spatial order, so that each is near the last. */
static void lift(struct hm_cli *cli, const struct hm_terrain *terrain, struct hm_domain *dom)
{
    struct hm_diag d = {0};
    int32_t hint = 0, *order;
    hm_cli_check(cli, hm_domain_order(dom, &order, &d), &d);
    for (size_t k = 0; k < dom->nnodes; k++) {
        struct hm_node *node = &dom->node[order[k]];
        if (!(node->flags & HM_NODE_NEW))
            continue;
        node->z = hm_terrain_z_nearest(terrain, node->x, node->y, &hint);
        if (!isfinite(node->z))
            hm_cli_die(cli, "nothing tells the height at %.17g %.17g", node->x, node->y);
    }
    free(order);
}

/* --- meshes of angles and sizes, and of vertical errors --- */

static void bring_to_quality(struct hm_cli *cli, const struct hm_sizes *sizes,
                             struct hm_domain *dom)
{
    struct refined left;
    refine(cli, dom, sizes, &left);
    say_refined(cli, &left);
}

/* Insertion and refinement take turns, since each may undo a little of what the other did. */
static void take_turns(struct hm_cli *cli, const struct ground *ground,
                       const struct hm_greedy_options *o, const struct hm_sizes *sizes,
                       struct hm_domain *dom)
{
    struct hm_diag d = {0};
    struct refined left;
    struct hm_greedy_done done = {.inserted = 1};
    for (int turn = 0; turn < MOST_TURNS && done.inserted > 0; turn++) {
        refine(cli, dom, sizes, &left);
        lift(cli, ground->terrain, dom);
        done.inserted = 0;
        if (cmd.error_given && turn + 1 < MOST_TURNS)
            hm_cli_check(cli, hm_greedy_reach(dom, ground->xyz, ground->n, o, &done, &d), &d);
    }
    say_refined(cli, &left);
}

static void settle(struct hm_cli *cli, const struct ground *ground, const struct hm_sizes *sizes,
                   double bound, struct hm_domain *dom)
{
    struct hm_diag d = {0};
    const struct hm_settle_options o = {.terrain = ground->terrain,
                                        .xyz = ground->xyz,
                                        .n = ground->n,
                                        .bound = bound,
                                        .least = cmd.min_edge,
                                        .ratio = cmd.gradation,
                                        .sizes = sizes,
                                        .passes = cmd.smooth,
                                        .threads = hm_cli_threads(cli)};
    int64_t moved;
    hm_cli_stage(cli, "smoothing");
    hm_cli_check(cli, hm_settle_reach(dom, &o, &moved, &d), &d);
}

static void bring_to_error(struct hm_cli *cli, const struct ground *ground,
                           const struct hm_sizes *sizes, struct hm_domain *dom)
{
    struct hm_diag d = {0};
    struct hm_greedy_done done;
    const struct hm_greedy_options o = {.max_error = cmd.max_error,
                                        .max_nodes = cmd.max_nodes,
                                        .least = cmd.min_edge,
                                        .clearance = cmd.clearance,
                                        .threads = hm_cli_threads(cli)};
    hm_cli_stage(cli, "the vertical errors");
    hm_cli_check(cli, hm_greedy_reach(dom, ground->xyz, ground->n, &o, &done, &d), &d);
    if (done.refused > 0)
        hm_cli_say(cli, "%s too near to nodes or lines passed over",
                   hm_cli_counted(done.refused, "measurement").text);
    if (refines())
        take_turns(cli, ground, &o, sizes, dom);
    lift(cli, ground->terrain, dom);
    settle(cli, ground, sizes, fmax(cmd.max_error, done.error), dom);
}

static void say_error(struct hm_cli *cli, const struct ground *ground, struct hm_domain *dom)
{
    struct hm_diag d = {0};
    struct hm_greedy_done done;
    hm_cli_check(cli, hm_greedy_look(dom, ground->xyz, ground->n, hm_cli_threads(cli), &done, &d),
                 &d);
    if (done.error > cmd.max_error)
        hm_cli_say(cli, "the largest vertical error left is %.3g m, at %.10g %.10g", done.error,
                   done.x, done.y);
}

/* A mesh over ground that nobody surveyed looks like any other: say how much of it there is. Gaps
 * are ten times as wide as points are apart as a rule, and wider than what elements bridge anyway.
 */
static void say_gaps(struct hm_cli *cli, const struct hm_terrain *terrain, const struct hm_mesh *m)
{
    const double worth_saying = 0.01; /* of the area */
    struct hm_diag d = {0};
    double spacing, whole = 0, empty = 0;
    int32_t hint = 0;
    hm_cli_check(cli, hm_terrain_spacing(terrain, &spacing, &d), &d);
    double gap = fmax(10 * spacing, cmd.method == PAPER ? 5 * cmd.max_edge : 0);
    for (size_t k = 0; k < m->nelems && spacing > 0; k++) {
        const int32_t *n = m->elem[k].node;
        double x = (m->node[n[0]].x + m->node[n[1]].x + m->node[n[2]].x) / 3;
        double y = (m->node[n[0]].y + m->node[n[1]].y + m->node[n[2]].y) / 3;
        double area = hm_elem_area(m, &m->elem[k]);
        whole += area;
        if (hm_terrain_is_gap(terrain, x, y, gap, &hint))
            empty += area;
    }
    if (empty > worth_saying * whole)
        hm_cli_say(cli,
                   "%.3g of %.3g m2 (%.0f %%) lie between measurements over %.3g m apart: an "
                   "outline (boundary=1) can leave them out",
                   empty, whole, 100 * empty / whole, gap);
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct hm_diag d = {0};
    struct hm_inputs in = {0};
    struct hm_domain dom = {0};
    struct hm_mesh mesh = {0};
    struct hm_grid grid = {0};
    struct hm_sizes sizes = {.dom = &dom};
    check_command(cli);
    read_sizes(cli, &grid, &sizes);
    hm_cli_read_all(cli, &in);
    make_header(cli, &in, &mesh.header);
    hm_cli_stage(cli, "the terrain");
    struct ground ground = build_ground(cli, &in);
    hm_cli_stage(cli, "points, lines and meshes");
    choose_clearance(cli, &in);
    assemble(cli, &in, ground.terrain, &dom);
    for (size_t k = 0; k < in.npoints; k++) /* the terrain has them */
        hm_points_free(&in.points[k]);
    if (cmd.method == PAPER)
        bring_to_lengths(cli, &mesh.header, &dom);
    if (cmd.method == QUALITY)
        bring_to_quality(cli, &sizes, &dom);
    if (cmd.method == TERRAIN)
        bring_to_error(cli, &ground, &sizes, &dom);
    hm_cli_stage(cli, "heights");
    if (cmd.elevation != Z_MEAN)
        lift(cli, ground.terrain, &dom);
    if (cmd.elevation == Z_FIT)
        hm_cli_check(cli, hm_fit_heights(&dom, ground.xyz, ground.n, hm_cli_threads(cli), &d), &d);
    if (cmd.method == TERRAIN)
        say_error(cli, &ground, &dom);
    hm_cli_check(cli, hm_domain_mesh(&dom, &mesh, &d), &d);
    say_angles(cli, &mesh);
    say_gaps(cli, ground.terrain, &mesh);
    hm_cli_check(cli, hm_mesh_write(&mesh, hm_cli_writer(cli), &d), &d);
    if (hm_cli_verbose(cli))
        hm_cli_say(cli, "%s, %s", hm_cli_counted((int64_t)mesh.nnodes, "node").text,
                   hm_cli_counted((int64_t)mesh.nelems, "element").text);
    hm_mesh_free(&mesh);
    hm_domain_free(&dom);
    hm_grid_free(&grid);
    free_ground(&ground);
    hm_inputs_free(&in);
    return hm_cli_finish(cli);
}
