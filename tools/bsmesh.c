/* bsmesh: rough banks, breaklines and terrain → a regular mesh a surface, on B-spline surfaces. */
#include "hm_axis.h"
#include "hm_cli.h"
#include "hm_facefit.h"
#include "hm_output.h"
#include "hm_regular.h"
#include "hm_rough.h"
#include "hm_snap.h"
#include "hm_terrain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct {
    const char *control, *elements; /* ALONG/ACROSS, as given */
    double snap;
    bool has_snap;
    bool quads, orthogonal;
    int diagonal; /* index of the choice */
    double bend;
    int degree; /* index of the choice: degree - 1 */
    int iterations;
    double gap;
    bool fit;
    const char *surface, *net;
} cmd = {.degree = 1, .iterations = 5};

static const struct hm_option options[] = {
    {'c', "control", "ALONG/ACROSS", HM_OPT_TEXT, &cmd.control,
     .help = "distance of control points, m; across also as fractions: 0,.1,.5,.9,1"},
    {'n', "snap", "M", HM_OPT_NUMBER, &cmd.snap,
     .help = "farthest move of a control point to a breakline, m (default ALONG)",
     .given = &cmd.has_snap},
    {'e', "elements", "ALONG/ACROSS", HM_OPT_TEXT, &cmd.elements,
     .help = "length of the elements, m"},
    {'Q', "quads", NULL, HM_OPT_FLAG, &cmd.quads, .help = "quadrilaterals instead of triangles"},
    {'d', "diagonal", NULL, HM_OPT_CHOICE, &cmd.diagonal,
     .help = "how cells are cut in two (default terrain: what fits it better)",
     .choices = "terrain|alternating"},
    {'O', "orthogonal", NULL, HM_OPT_FLAG, &cmd.orthogonal,
     .help = "shift control points until sections cross the river squarely"},
    {'B', "bend", "DEGREES", HM_OPT_NUMBER, &cmd.bend,
     .help = "control points so dense that banks turn by no more between two"},
    {'k', "degree", "K", HM_OPT_CHOICE, &cmd.degree, .help = "degree of the surface (default 2)",
     .choices = "1|2|3"},
    {'i', "iterations", "N", HM_OPT_NATURAL, &cmd.iterations,
     .help = "iterations of dragging to the terrain (default 5; fewer smooth more)"},
    {'g', "gap", "M", HM_OPT_POSITIVE, &cmd.gap,
     .help = "wider gaps between points give no height, m (default 5 ALONG)"},
    {'F', "fit-face", NULL, HM_OPT_FLAG, &cmd.fit,
     .help = "move the nodes of a cut onto the face loop"},
    {0, "net", "FILE", HM_OPT_TEXT, &cmd.net,
     .help = "write the control points, and how they moved, there"},
    {'s', "surface", "NAME", HM_OPT_TEXT, &cmd.surface,
     .help = "make only this surface (default: all)"},
    {0}};

static const struct hm_program program = {
    .name = "bsmesh",
    .purpose = "rough banks, breaklines and terrain → regular meshes on B-spline surfaces",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_LINES | HM_POINTS | HM_GRID,
    .without = "p", /* a mesh is written exactly */
};

/* What all surfaces share. */
struct job {
    struct hm_inputs in;
    struct hm_rough *rough;
    size_t nrough;
    struct hm_face *face;
    size_t nfaces;
    struct hm_breaklines *breaklines;
    struct hm_lines banks; /* of axes */
    struct hm_lines net;   /* control points, when they are wanted */
    struct hm_terrain *terrain;
    struct hm_regular_how how;
};

static struct hm_rough_size read_sizes(struct hm_cli *cli)
{
    struct hm_rough_size size = {.snap = -1};
    struct hm_diag d = {0};
    if (cmd.control)
        hm_cli_check(cli, hm_rough_parse_control(cmd.control, &size, &d), &d);
    if (cmd.elements)
        hm_cli_check(cli, hm_rough_parse_elements(cmd.elements, &size, &d), &d);
    if (cmd.has_snap && cmd.snap < 0)
        hm_cli_die(cli, "--snap must not be negative");
    if (!(cmd.bend >= 0 && cmd.bend <= 180))
        hm_cli_die(cli, "--bend: an angle is from 0 to 180 degrees");
    size.bend = cmd.bend;
    if (cmd.has_snap)
        size.snap = cmd.snap;
    return size;
}

/* Banks for surfaces that have an axis only. */
static void find_banks(struct hm_cli *cli, struct job *job, const struct hm_rough_size *size)
{
    struct hm_diag d = {0};
    struct hm_axis *axis;
    size_t n;
    hm_cli_check(cli,
                 hm_axis_banks(job->breaklines, job->in.lines, job->in.nlines, size->along,
                               &job->banks, &axis, &n, &d),
                 &d);
    for (size_t k = 0; k < n; k++)
        if (axis[k].by_width == 0)
            hm_cli_say(cli, "%s: both banks found from the axis, at all of %zu places",
                       axis[k].name, axis[k].places);
        else
            hm_cli_say(cli,
                       "%s: banks found from the axis at %zu of %zu places; at %zu the half-width "
                       "holds, the first beside %.10g %.10g",
                       axis[k].name, axis[k].places - axis[k].by_width, axis[k].places,
                       axis[k].by_width, axis[k].by_width_at[0], axis[k].by_width_at[1]);
    free(axis);
}

static void read_lines(struct hm_cli *cli, struct job *job)
{
    struct hm_rough_size size = read_sizes(cli);
    struct hm_diag d = {0};
    const struct hm_inputs *in = &job->in;
    struct hm_lines *sets = hm_alloc(in->nlines + 1, sizeof *sets);
    if (!sets)
        hm_cli_die(cli, "out of memory");
    hm_cli_check(cli, hm_breaklines_build(&job->breaklines, in->lines, in->nlines, &d), &d);
    find_banks(cli, job, &size);
    for (size_t k = 0; k < in->nlines; k++)
        sets[k] = in->lines[k];
    sets[in->nlines] = job->banks;
    hm_cli_check(cli, hm_rough_collect(sets, in->nlines + 1, &size, &job->rough, &job->nrough, &d),
                 &d);
    free(sets);
    if (job->nrough == 0)
        hm_cli_die(cli, "no rough banks among the lines: give them as lines with the attributes "
                        "surface=NAME side=left and surface=NAME side=right");
    hm_cli_check(cli,
                 hm_face_collect(in->lines, in->nlines, job->rough, job->nrough, &job->face,
                                 &job->nfaces, &d),
                 &d);
    bool found = !cmd.surface;
    for (size_t k = 0; k < job->nrough; k++)
        found = found || !strcmp(job->rough[k].name, cmd.surface);
    if (!found)
        hm_cli_die(cli, "there is no surface '%s' among the lines", cmd.surface);
}

static bool is_wanted(const struct hm_rough *r)
{
    return !cmd.surface || !strcmp(cmd.surface, r->name);
}

static void build_terrain(struct hm_cli *cli, struct job *job)
{
    struct hm_diag d = {0};
    struct hm_terrain_counts counts;
    double gap = cmd.gap;
    for (size_t k = 0; k < job->nrough && !(cmd.gap > 0); k++)
        if (is_wanted(&job->rough[k]))
            gap = fmax(gap, 5 * job->rough[k].size.along);
    if (job->in.npoints + job->in.ngrids == 0)
        hm_cli_die(cli, "no terrain: measurements (points) or a grid are needed for the heights");
    job->how.gap = gap;
    hm_cli_check(cli, hm_terrain_build(&job->terrain, &job->in, gap, job->how.threads, &counts, &d),
                 &d);
    hm_cli_mended_points(cli, counts.without_z, counts.duplicates);
}

static void tell_moves(struct hm_cli *cli, const struct job *job, const struct hm_rough *rough,
                       const struct hm_regular *s)
{
    size_t n = s->surface.n;
    if (rough->size.snap == 0)
        hm_cli_say(cli, "%s: banks as drawn, not moved to breaklines (snap=0)", rough->name);
    else if (job->breaklines->n == 0)
        hm_cli_say(cli, "%s: no breaklines to move the banks to", rough->name);
    else if (s->moved > 0)
        hm_cli_say(cli,
                   "%s: %zu of %zu control points on the banks moved to a breakline, %zu not; the "
                   "largest move is %.2f m, at %.10g %.10g",
                   rough->name, s->moved, 2 * n, 2 * n - s->moved, s->largest, s->largest_at[0],
                   s->largest_at[1]);
    else
        hm_cli_say(cli, "%s: no control point of %zu found a breakline within %g m", rough->name,
                   2 * n, rough->size.snap);
}

static void tell(struct hm_cli *cli, const struct job *job, const struct hm_rough *rough,
                 const struct hm_regular *s, const struct hm_face_cut *cut,
                 const struct hm_facefit *fit, const struct hm_mesh *mesh)
{
    size_t n = s->surface.n, m = s->surface.m;
    tell_moves(cli, job, rough, s);
    hm_cli_mended(cli, (int64_t)s->unknown,
                  "%s: %zu of %zu control points without terrain take z from those around them, "
                  "the first at %.10g %.10g",
                  rough->name, s->unknown, n * m, s->unknown_at[0], s->unknown_at[1]);
    hm_cli_mended(cli, s->concave,
                  "%s: %lld cells that are not strictly convex were cut into triangles",
                  rough->name, (long long)s->concave);
    if (cut->dropped > 0)
        hm_cli_say(cli, "%s: %lld elements outside the face dropped", rough->name,
                   (long long)cut->dropped);
    if (fit->moved + fit->off > 0)
        hm_cli_say(cli,
                   "%s: %lld nodes of the cut moved onto the face loop, the furthest %.2f m; %lld "
                   "stay beside it; %lld notches filled",
                   rough->name, (long long)fit->moved, fit->furthest, (long long)fit->off,
                   (long long)fit->filled);
    hm_cli_mended(cli, cut->pinched, "%s: %lld more where elements hung together in one node only",
                  rough->name, (long long)cut->pinched);
    hm_cli_say(cli, "%s: %zu by %zu control points, %zu nodes, %zu elements", rough->name, n, m,
               mesh->nnodes, mesh->nelems);
}

/* name, role, and the names of all surfaces, of which the k-th owns the nodes with owner k. */
static void make_header(struct hm_cli *cli, const struct job *job, const struct hm_rough *rough,
                        struct hm_header *h)
{
    struct hm_diag d = {0};
    char *owners = hm_alloc0(job->nrough, HM_ROUGH_NAME + 1), *end = owners;
    if (!owners)
        hm_cli_die(cli, "out of memory");
    for (size_t k = 0; k < job->nrough; k++)
        end += sprintf(end, "%s%s", k ? " " : "", job->rough[k].name);
    hm_cli_check(cli, hm_header_init(h, HM_MESH, &d), &d);
    hm_cli_make_header(cli, h);
    hm_cli_check(cli, hm_header_set(h, "name", rough->name, &d), &d);
    hm_cli_check(cli, hm_header_set(h, "role", "regular", &d), &d);
    hm_cli_check(cli, hm_header_set(h, "owners", owners, &d), &d);
    free(owners);
}

static void mesh_surface(struct hm_cli *cli, struct job *job, const struct hm_rough *rough,
                         struct hm_mesh *mesh)
{
    struct hm_diag d = {0};
    struct hm_regular s;
    struct hm_face_cut cut;
    struct hm_facefit fit = {0};
    hm_cli_check(cli, hm_regular_surface(&s, rough, job->breaklines, job->terrain, &job->how, &d),
                 &d);
    hm_cli_check(cli, hm_regular_mesh(&s, rough, &job->how, mesh, &d), &d);
    enum hm_err err = cmd.fit
                          ? hm_facefit_apply(mesh, rough, job->face, job->nfaces, &cut, &fit, &d)
                          : hm_face_apply(mesh, rough, job->face, job->nfaces, false, &cut, &d);
    hm_cli_check(cli, err, &d);
    hm_cli_check(cli, hm_regular_flag_border(mesh, &d), &d);
    tell(cli, job, rough, &s, &cut, &fit, mesh);
    if (cmd.net)
        hm_cli_check(cli, hm_regular_net(&s, rough->name, &job->net, &d), &d);
    make_header(cli, job, rough, &mesh->header);
    hm_regular_free(&s);
}

static void write_net(struct hm_cli *cli, struct job *job)
{
    struct hm_diag d = {0};
    struct hm_writer *w = NULL;
    hm_cli_check(cli, hm_header_init(&job->net.header, HM_LINES, &d), &d);
    hm_cli_make_header(cli, &job->net.header);
    hm_cli_check(cli, hm_writer_open(&w, cmd.net, hm_cli_format(cli), &d), &d);
    enum hm_err err = hm_lines_write(&job->net, w, &d);
    if (!err)
        err = hm_writer_close(&w, &d);
    if (err)
        hm_writer_abandon(w);
    hm_cli_check(cli, err, &d);
}

/* Nothing is written before the last surface has succeeded: what comes out is whole. */
static void mesh_all(struct hm_cli *cli, struct job *job)
{
    struct hm_diag d = {0};
    struct hm_mesh *mesh = hm_alloc0(job->nrough, sizeof *mesh);
    if (!mesh)
        hm_cli_die(cli, "out of memory");
    for (size_t k = 0; k < job->nrough; k++)
        if (is_wanted(&job->rough[k])) {
            hm_cli_progress(cli, "surfaces", (double)k / (double)job->nrough);
            mesh_surface(cli, job, &job->rough[k], &mesh[k]);
        }
    if (cmd.net)
        write_net(cli, job);
    for (size_t k = 0; k < job->nrough; k++) {
        if (is_wanted(&job->rough[k]))
            hm_cli_check(cli, hm_mesh_write(&mesh[k], hm_cli_writer(cli), &d), &d);
        hm_mesh_free(&mesh[k]);
    }
    free(mesh);
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct job job = {.how = {.degree = cmd.degree + 1,
                              .iterations = cmd.iterations,
                              .quads = cmd.quads,
                              .alternating = cmd.diagonal == 1,
                              .orthogonal = cmd.orthogonal,
                              .threads = hm_cli_threads(cli)}};
    struct hm_diag d = {0};
    if (cmd.net && !strcmp(cmd.net, "-"))
        hm_cli_die(cli, "--net: needs a file, standard output has the meshes");
    if (cmd.net)
        hm_cli_check(cli, hm_output_check(cmd.net, &d), &d);
    hm_cli_read_all(cli, &job.in);
    read_lines(cli, &job);
    hm_cli_stage(cli, "the terrain");
    build_terrain(cli, &job);
    mesh_all(cli, &job);
    hm_terrain_free(job.terrain);
    hm_breaklines_free(job.breaklines);
    hm_lines_free(&job.banks);
    hm_lines_free(&job.net);
    free(job.face);
    hm_rough_free(job.rough, job.nrough);
    hm_inputs_free(&job.in);
    return hm_cli_finish(cli);
}
