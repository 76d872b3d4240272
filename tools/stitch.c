/* stitch: meshes → one conforming mesh. Regular meshes that overlap are cut by priority and the gap
 * is filled; the others are joined to them by their common nodes. */
#include "hm_cli.h"
#include "hm_elem.h"
#include "hm_face.h"
#include "hm_material.h"
#include "hm_meshcheck.h"
#include "hm_misfit.h"
#include "hm_owners.h"
#include "hm_rcm.h"
#include "hm_stitch.h"
#include "hm_strings.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates of foreign meshes are often rounded to centimetres. */
static const double foreign_tolerance = 0.01;

static struct {
    double buffer;
    bool has_buffer;
    double tolerance;
    bool has_tolerance;
    bool components;
    bool renumber;
    const char *name;
    double gap, misfit;
} cmd;

static const struct hm_option options[] = {
    {'w', "buffer", "M", HM_OPT_NUMBER, &cmd.buffer,
     .help = "cut elements nearer than this to a mesh before, m (default 0.4 edges)",
     .given = &cmd.has_buffer},
    {'T', "tolerance", "M", HM_OPT_NUMBER, &cmd.tolerance,
     .help = "join nodes that are this near, m (default 0; 0.01 without a role)",
     .given = &cmd.has_tolerance},
    {'c', "components", NULL, HM_OPT_FLAG, &cmd.components,
     .help = "the result may be in several pieces"},
    {'g', "gap", "M", HM_OPT_POSITIVE, &cmd.gap,
     .help = "measurements farther apart tell no height, m (default 5 elements)"},
    {'m', "misfit", "M", HM_OPT_POSITIVE, &cmd.misfit,
     .help = "give up elements that miss the terrain by more, root mean square, m"},
    {'r', "renumber", NULL, HM_OPT_FLAG, &cmd.renumber,
     .help = "renumber for a small bandwidth (reverse Cuthill-McKee)"},
    {'N', "name", "NAME", HM_OPT_TEXT, &cmd.name,
     .help = "name of the result (default: that of the first mesh)"},
    {0}};

static const struct hm_program program = {
    .name = "stitch",
    .purpose = "meshes, in order of priority, and lines with string= or region= → one mesh",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_MESH | HM_POINTS | HM_GRID | HM_LINES,
    .without = "p", /* a mesh is written exactly */
};

static const char *role_of(const struct hm_mesh *m)
{
    const char *role = hm_header_get(&m->header, "role");
    return role ? role : "";
}

static bool is_regular(const struct hm_mesh *m)
{
    return !strcmp(role_of(m), "regular");
}

static const char *name_of(const struct hm_mesh *m)
{
    const char *name = hm_header_get(&m->header, "name");
    return name && *name ? name : "a mesh without name";
}

/* Beyond that the surfaces know more than a triangle across the water: as bsmesh has it. */
static double usual_gap(const struct hm_inputs *in)
{
    double longest = 0;
    for (size_t i = 0; i < in->nmeshes; i++)
        for (size_t k = 0; k < in->mesh[i].nelems && is_regular(&in->mesh[i]); k++)
            longest = fmax(longest, hm_elem_mean_edge(&in->mesh[i], &in->mesh[i].elem[k]));
    return 5 * longest;
}

/* The terrain, for nodes in gaps and for misfits; NULL when there is none, or it is not needed. */
static struct hm_terrain *build_terrain(struct hm_cli *cli, const struct hm_inputs *in)
{
    size_t regular = 0;
    for (size_t i = 0; i < in->nmeshes; i++)
        regular += is_regular(&in->mesh[i]);
    bool known = in->npoints + in->ngrids > 0;
    if (cmd.misfit > 0 && !known)
        hm_cli_die(cli, "--misfit needs the terrain: measurements or a grid");
    if (cmd.misfit > 0 && regular < in->nmeshes)
        hm_cli_die(cli, "--misfit is for regular meshes alone, before trimesh fills the holes");
    if (!known || (regular < 2 && !(cmd.misfit > 0)))
        return NULL;
    struct hm_terrain *terrain;
    struct hm_terrain_counts counts;
    struct hm_diag d = {0};
    double gap = cmd.gap > 0 ? cmd.gap : usual_gap(in);
    hm_cli_check(cli, hm_terrain_build(&terrain, in, gap, hm_cli_threads(cli), &counts, &d), &d);
    hm_cli_mended_points(cli, counts.without_z, counts.duplicates);
    return terrain;
}

static void tell_stitched(struct hm_cli *cli, const char *name, const struct hm_stitched *s)
{
    int64_t cut = s->overlapping + s->near + s->loose;
    if (cut == 0 && s->joined.shared > 0)
        hm_cli_say(cli, "%s: joined by %lld common nodes", name, (long long)s->joined.shared);
    else if (cut == 0)
        hm_cli_say(cli, "%s: does not meet the meshes before it", name);
    else if (s->kept == 0)
        hm_cli_say(cli, "%s: nothing of it remains; %lld triangles where it went beyond", name,
                   (long long)s->filled);
    else
        hm_cli_say(cli,
                   "%s: %lld elements cut away (%lld overlap, %lld too near, %lld loose), %lld "
                   "kept; %lld triangles in the gap, with %lld of its nodes and %lld new ones",
                   name, (long long)cut, (long long)s->overlapping, (long long)s->near,
                   (long long)s->loose, (long long)s->kept, (long long)s->filled,
                   (long long)s->reused, (long long)s->fresh);
    if (s->widened > 0)
        hm_cli_say(cli, "%s: %s narrower than two edges of the meshes before it widened", name,
                   hm_cli_counted(s->widened, "mouth").text);
    if (s->npoor > 0)
        hm_cli_say(cli, "%s: an angle under %g degrees in %s of the gap:", name, HM_STITCH_POOR,
                   hm_cli_counted((int64_t)s->npoor, "triangle").text);
    for (size_t i = 0; i < s->npoor; i++)
        hm_cli_say(cli, "  %.1f degrees at %.10g %.10g", s->poor[i].angle, s->poor[i].centre[0],
                   s->poor[i].centre[1]);
}

static void add_regular(struct hm_cli *cli, struct hm_join *j, const struct hm_mesh *m,
                        const struct hm_terrain *terrain, int32_t *map)
{
    struct hm_diag d = {0};
    struct hm_stitched s;
    bool first = j->mesh.nelems == 0;
    double buffer = cmd.has_buffer ? cmd.buffer : -1;
    hm_cli_check(cli, hm_stitch_regular(j, m, buffer, terrain, map, &s, &d), &d);
    hm_cli_mended(cli, s.joined.unused, "%s: %lld nodes without an element were left out",
                  name_of(m), (long long)s.joined.unused);
    if (!first)
        tell_stitched(cli, name_of(m), &s);
    hm_stitched_free(&s);
}

static void add_other(struct hm_cli *cli, struct hm_join *j, const struct hm_mesh *m, int32_t *map)
{
    struct hm_diag d = {0};
    struct hm_joined joined = {0};
    bool first = j->mesh.nelems == 0, foreign = !*role_of(m);
    double tolerance = cmd.has_tolerance ? cmd.tolerance : foreign ? foreign_tolerance : 0;
    hm_cli_check(cli, hm_join_mesh(j, m, NULL, tolerance, map, &joined, &d), &d);
    hm_cli_mended(cli, joined.unused, "%s: %lld nodes without an element were left out", name_of(m),
                  (long long)joined.unused);
    if (!first)
        hm_cli_say(cli, "%s: joined by %lld common nodes", name_of(m), (long long)joined.shared);
    hm_cli_mended(cli, joined.matched, "%s: %lld of them matched within %g m, the furthest %.3g m",
                  name_of(m), (long long)joined.matched, tolerance, joined.furthest);
}

static void add_mesh(struct hm_cli *cli, struct hm_join *j, const struct hm_mesh *m,
                     const struct hm_terrain *terrain, struct hm_strings *strings)
{
    struct hm_diag d = {0};
    size_t before = strings->n;
    int32_t *map = hm_alloc(m->nnodes, sizeof *map);
    if (!map)
        hm_cli_die(cli, "out of memory");
    if (is_regular(m))
        add_regular(cli, j, m, terrain, map);
    else
        add_other(cli, j, m, map);
    hm_cli_check(cli, hm_strings_read(strings, m, &d), &d);
    hm_strings_renumber(strings, before, map);
    free(map);
}

/* Where nodes went whose mesh lost some: both lists are in one order. Free it. */
static int32_t *map_of_kept(struct hm_cli *cli, const double (*was)[2], size_t n,
                            const struct hm_mesh *m)
{
    int32_t *map = hm_alloc(n, sizeof *map);
    if (!map)
        hm_cli_die(cli, "out of memory");
    for (size_t i = 0, k = 0; i < n; i++) {
        bool kept = k < m->nnodes && m->node[k].x == was[i][0] && m->node[k].y == was[i][1];
        map[i] = kept ? (int32_t)k++ : -1;
    }
    return map;
}

/* Give up the elements that miss the terrain. */
static void drop_misfits(struct hm_cli *cli, struct hm_mesh *m, const struct hm_terrain *terrain,
                         struct hm_strings *strings)
{
    struct hm_diag d = {0};
    struct hm_face_cut cut = {0};
    size_t elements = m->nelems, nodes = m->nnodes;
    bool *keep = hm_alloc(elements, sizeof *keep);
    double(*was)[2] = hm_alloc(nodes, sizeof *was);
    if (!keep || !was)
        hm_cli_die(cli, "out of memory");
    for (size_t i = 0; i < nodes; i++)
        memcpy(was[i], hm_mesh_xy(m, (int32_t)i), sizeof was[i]);
    hm_cli_check(cli, hm_misfit_mark(m, terrain, cmd.misfit, hm_cli_threads(cli), keep, &d), &d);
    hm_cli_check(cli, hm_face_keep(m, keep, &cut, &d), &d);
    hm_cli_say(cli,
               "%lld of %zu elements given up where they miss the terrain by more than %g m, and "
               "around",
               (long long)(cut.dropped + cut.pinched), elements, cmd.misfit);
    int32_t *map = map_of_kept(cli, was, nodes, m);
    hm_strings_renumber(strings, 0, map);
    free(map);
    free(was);
    free(keep);
}

/* Regular meshes first, whatever their place: the others were made around them. */
static void join_all(struct hm_cli *cli, const struct hm_inputs *in, struct hm_join *j,
                     struct hm_strings *strings)
{
    hm_cli_stage(cli, "the terrain");
    struct hm_terrain *terrain = build_terrain(cli, in);
    size_t done = 0;
    for (int regular = 1; regular >= 0; regular--)
        for (size_t i = 0; i < in->nmeshes; i++) {
            if (is_regular(&in->mesh[i]) != regular)
                continue;
            hm_cli_progress(cli, "meshes", (double)done++ / (double)in->nmeshes);
            add_mesh(cli, j, &in->mesh[i], terrain, strings);
        }
    if (cmd.misfit > 0)
        drop_misfits(cli, &j->mesh, terrain, strings);
    hm_terrain_free(terrain);
}

/* Faults that no joining mends, and that cutting could trip over, are found while it is still known
 * which mesh has them. Loops that touch, pieces and spare nodes may yet come right. */
static void check_inputs(struct hm_cli *cli, const struct hm_inputs *in)
{
    struct hm_meshcheck c;
    for (size_t i = 0; in->nmeshes > 1 && i < in->nmeshes; i++) {
        struct hm_diag d = {0};
        hm_cli_check(cli, hm_meshcheck_run(&in->mesh[i], &c, &d), &d);
        c.count[HM_FAULT_ISOLATED] = c.count[HM_FAULT_TOUCH] = 0;
        snprintf(d.source, sizeof d.source, "mesh %zu of %zu (%.200s)", i + 1, in->nmeshes,
                 name_of(&in->mesh[i]));
        hm_cli_check(cli, hm_meshcheck_verdict(&c, true, &d), &d);
    }
}

/* Nothing that breaks a rule is written. */
static void check_result(struct hm_cli *cli, const struct hm_mesh *m, const struct hm_inputs *in)
{
    struct hm_diag d = {0};
    struct hm_meshcheck c;
    if (m->nelems == 0)
        hm_cli_die(cli, "the mesh has no elements");
    hm_cli_check(cli, hm_meshcheck_run(m, &c, &d), &d);
    if (c.count[HM_FAULT_OVERLAP] > 0 && in->nmeshes > 1)
        hm_cli_say(cli, "only meshes with the role regular make room for each other");
    if (c.count[HM_FAULT_COMPONENTS] > 0 && !cmd.components)
        hm_cli_say(cli, "the meshes do not all meet; --components allows several pieces");
    hm_cli_check(cli, hm_meshcheck_verdict(&c, cmd.components, &d), &d);
}

/* Materials inside closed lines with region=N. */
static void give_materials(struct hm_cli *cli, const struct hm_inputs *in, struct hm_mesh *m)
{
    struct hm_diag d = {0};
    struct hm_material *list;
    size_t n;
    hm_cli_check(cli, hm_material_collect(in->lines, in->nlines, &list, &n, &d), &d);
    hm_material_apply(m, list, n);
    for (size_t i = 0; i < n; i++)
        hm_cli_say(cli, "region %d: given to %lld elements", list[i].region,
                   (long long)list[i].elements);
    free(list);
}

/* The strings that are still whole, and those that lines with string=NAME ask for. */
static void find_strings(struct hm_cli *cli, const struct hm_inputs *in, const struct hm_mesh *m,
                         struct hm_strings *strings)
{
    struct hm_diag d = {0};
    int64_t dropped = 0;
    char *name = NULL;
    if (strings->n > 0)
        hm_cli_check(cli, hm_strings_drop_broken(strings, m, &dropped, &name, &d), &d);
    hm_cli_mended(cli, dropped, "%s that no longer run along the boundary dropped, first '%s'",
                  hm_cli_counted(dropped, "string").text, name ? name : "");
    free(name);
    size_t kept = strings->n;
    if (in->nlines > 0)
        hm_cli_check(cli, hm_strings_find(strings, m, in->lines, in->nlines, &kept, &d), &d);
    for (size_t i = kept; i < strings->n; i++)
        hm_cli_say(cli, "string %s: %s of the boundary", strings->string[i].name,
                   hm_cli_counted((int64_t)strings->string[i].n - 1, "edge").text);
}

static void renumber(struct hm_cli *cli, struct hm_mesh *m, struct hm_strings *strings)
{
    struct hm_diag d = {0};
    int64_t before = hm_rcm_bandwidth(m);
    int32_t *number = hm_alloc(m->nnodes, sizeof *number);
    if (!number)
        hm_cli_die(cli, "out of memory");
    hm_cli_check(cli, hm_rcm_renumber(m, number, &d), &d);
    hm_strings_renumber(strings, 0, number);
    free(number);
    hm_cli_say(cli, "bandwidth %lld, was %lld", (long long)hm_rcm_bandwidth(m), (long long)before);
}

static void write_mesh(struct hm_cli *cli, struct hm_mesh *m, const struct hm_inputs *in,
                       const char *owners, const struct hm_strings *strings)
{
    struct hm_diag d = {0};
    bool regular = true;
    for (size_t i = 0; i < in->nmeshes; i++)
        regular = regular && is_regular(&in->mesh[i]);
    const char *name = cmd.name ? cmd.name : hm_header_get(&in->mesh[0].header, "name");
    hm_cli_check(cli, hm_header_init(&m->header, HM_MESH, &d), &d);
    hm_cli_check(cli, hm_header_set(&m->header, "name", name, &d), &d);
    hm_cli_check(cli, hm_header_set(&m->header, "role", regular ? "regular" : "hybrid", &d), &d);
    hm_cli_check(cli, hm_header_set(&m->header, "owners", *owners ? owners : NULL, &d), &d);
    hm_cli_make_header(cli, &m->header);
    hm_cli_check(cli, hm_strings_write(strings, &m->header, &d), &d);
    hm_cli_check(cli, hm_mesh_write(m, hm_cli_writer(cli), &d), &d);
}

static void check_options(struct hm_cli *cli)
{
    if (cmd.has_buffer && cmd.buffer < 0)
        hm_cli_die(cli, "--buffer must not be negative");
    if (cmd.has_tolerance && cmd.tolerance < 0)
        hm_cli_die(cli, "--tolerance must not be negative");
    for (const char *c = cmd.name; c && (*c || c == cmd.name); c++)
        if (*c == 0 || iscntrl((unsigned char)*c))
            hm_cli_die(cli, "--name: a name is not empty and has no control characters");
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct hm_inputs in = {0};
    struct hm_join join = {0};
    struct hm_strings strings = {0};
    char *owners;
    struct hm_diag d = {0};
    check_options(cli);
    hm_cli_read_all(cli, &in);
    if (in.nmeshes == 0)
        hm_cli_die(cli, "no mesh among the operands");
    check_inputs(cli, &in);
    hm_cli_check(cli, hm_owners_join(in.mesh, in.nmeshes, &owners, &d), &d);
    join_all(cli, &in, &join, &strings);
    hm_cli_stage(cli, "the checks");
    check_result(cli, &join.mesh, &in);
    hm_cli_check(cli, hm_join_flag_boundary(&join.mesh, &d), &d);
    give_materials(cli, &in, &join.mesh);
    find_strings(cli, &in, &join.mesh, &strings);
    if (cmd.renumber)
        renumber(cli, &join.mesh, &strings);
    write_mesh(cli, &join.mesh, &in, owners, &strings);
    hm_strings_free(&strings);
    hm_join_free(&join);
    free(owners);
    hm_inputs_free(&in);
    return hm_cli_finish(cli);
}
