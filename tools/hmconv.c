/* hmconv: any file → the project's streams, or a format of other programs; or what is in it.
 *
 * Streams take all kinds, object by object; the other formats take the objects of their kind.
 */
#include "hm_batch.h"
#include "hm_cli.h"
#include "hm_copy.h"
#include "hm_describe.h"
#include "hm_export.h"
#include "hm_import.h"
#include "hm_num.h"
#include "hm_split.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum hm_err write_mesh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* What a format of meshes has no place for, or has otherwise. */
enum {
    NO_QUADS = 1,
    NO_STRINGS = 2,
    NO_REGIONS = 4,
    NO_HEIGHTS = 8,
    DEPTHS = 16,      /* positive down */
    FROM_ONE = 32,    /* no region 0 */
    SEVEN_PLACES = 64 /* behind the point */
};

enum format { TEXT, BINARY, SINGLE, MESH, GRID_ASC, TABLE_XYZ, LINES_GMT };

static const struct {
    const char *name;
    enum format format;
    int kinds; /* that it can hold */
    write_mesh *write;
    int lacks;
} formats[] = {{"text", TEXT, HM_ANY, NULL, 0},
               {"binary", BINARY, HM_ANY, NULL, 0},
               {"single", SINGLE, HM_GRID, NULL, 0},
               {"2dm", MESH, HM_MESH, hm_export_2dm, 0},
               {"ugrid", MESH, HM_MESH, hm_export_ugrid, NO_STRINGS},
               {"geo", MESH, HM_MESH, hm_export_rma2, FROM_ONE},
               {"2d", MESH, HM_MESH, hm_export_kalypso, FROM_ONE | NO_STRINGS | SEVEN_PLACES},
               {"gr3", MESH, HM_MESH, hm_export_gr3, NO_REGIONS | DEPTHS},
               {"fort14", MESH, HM_MESH, hm_export_gr3, NO_REGIONS | NO_QUADS | DEPTHS},
               {"slf", MESH, HM_MESH, hm_export_slf, NO_REGIONS | NO_QUADS | NO_STRINGS},
               {"cli", MESH, HM_MESH, hm_export_cli, NO_QUADS},
               {"vtk", MESH, HM_MESH, hm_export_vtk, NO_STRINGS},
               {"vtu", MESH, HM_MESH, hm_export_vtu, NO_STRINGS},
               {"msh", MESH, HM_MESH, hm_export_msh, 0},
               {"ply", MESH, HM_MESH, hm_export_ply, NO_STRINGS},
               {"tsh", MESH, HM_MESH, hm_export_tsh, NO_QUADS},
               {"medit", MESH, HM_MESH, hm_export_medit, NO_HEIGHTS},
               {"srhgeom", MESH, HM_MESH, hm_export_srh, NO_REGIONS},
               {"asc", GRID_ASC, HM_GRID, NULL, 0},
               {"xyz", TABLE_XYZ, HM_POINTS | HM_GRID, NULL, 0},
               {"gmt", LINES_GMT, HM_LINES, NULL, 0}};
#define CHOICES                                                                                    \
    "text|binary|single|2dm|ugrid|geo|2d|gr3|fort14|slf|cli|vtk|vtu|msh|ply|tsh|medit|srhgeom|"    \
    "asc|xyz|gmt"

static struct {
    int to;
    bool to_given, info, split;
    const char *band, *origin;
    double datum;
} cmd;

static const struct hm_option options[] = {
    {'t', "to", "FORMAT", HM_OPT_CHOICE, &cmd.to, .help = "what to write (default text)",
     .choices = CHOICES, .silent = true, .given = &cmd.to_given},
    {'i', "info", NULL, HM_OPT_FLAG, &cmd.info, .help = "say what the files hold instead",
     .silent = true},
    {'s', "split", NULL, HM_OPT_FLAG, &cmd.split, .help = "quadrilaterals of a mesh to triangles"},
    {0, "origin", "X,Y", HM_OPT_TEXT, &cmd.origin,
     .help = "mesh: subtract this from all coordinates"},
    {0, "datum", "H", HM_OPT_NUMBER, &cmd.datum,
     .help = "gr3, fort14: the height that depths are counted from (default 0)", .silent = true},
    {0, "band", "NAME", HM_OPT_TEXT, &cmd.band,
     .help = "asc, xyz: this band of a grid (default the first)", .silent = true},
    {0}};

static const struct hm_program program = {.name = "hmconv",
                                          .purpose = "any file → another format of its kind",
                                          .operands = "[file ...]",
                                          .options = options,
                                          .needs = HM_ANY,
                                          .foreign = hm_import_formats,
                                          .degrees_ok = true,
                                          .without = "K"};

/* --- to streams --- */

/* What came, in another encoding. That adds nothing to the history, but rounding does. */
static enum hm_err copy_object(struct hm_cli *cli, struct hm_header *h, struct hm_diag *d)
{
    struct hm_writer *w = hm_cli_writer(cli);
    enum hm_err err = HM_OK;
    if (hm_cli_format(cli).decimals)
        err = hm_header_add_history(h, hm_cli_history(cli), d);
    return err ? err : hm_copy_object(hm_cli_reader(cli), h, &w, 1, d);
}

/* --- to other formats --- */

/* Number of the band that the user asked for. */
static size_t find_band(struct hm_cli *cli, const struct hm_header *h)
{
    if (!cmd.band)
        return 0;
    int field = hm_header_field(h, cmd.band);
    if (field < 2)
        hm_cli_die(cli, "%s: no band '%s'", hm_reader_name(hm_cli_reader(cli)), cmd.band);
    return (size_t)field - 2;
}

/* What goes to a file of one object: held until all inputs are read, so that nothing is written
 * when one of them is broken or there is a second. */
static struct {
    struct hm_mesh mesh;
    struct hm_grid grid;
    size_t band;
} held;

static enum hm_err hold(struct hm_cli *cli, const struct hm_header *h, struct hm_diag *d)
{
    struct hm_header own = {0};
    enum hm_err err = hm_header_copy(&own, h, d);
    if (err)
        return err;
    if (h->kind == HM_MESH)
        return hm_mesh_read(&held.mesh, hm_cli_reader(cli), &own, d);
    held.band = find_band(cli, h);
    return hm_grid_read(&held.grid, hm_cli_reader(cli), &own, d);
}

/* --- meshes: what is changed on the way, and what is lost --- */

static void shift(struct hm_cli *cli, struct hm_mesh *m)
{
    double x, y;
    const char *s = cmd.origin, *end = s + strlen(s), *comma = hm_num_parse(s, end, &x);
    if (!comma || *comma != ',' || hm_num_parse(comma + 1, end, &y) != end || !isfinite(x) ||
        !isfinite(y))
        hm_cli_die(cli, "--origin: '%s' is not two numbers with a comma between", cmd.origin);
    for (size_t k = 0; k < m->nnodes; k++) {
        m->node[k].x -= x;
        m->node[k].y -= y;
    }
    const char *crs = hm_header_get(&m->header, "crs");
    char text[512];
    struct hm_diag d = {0};
    snprintf(text, sizeof text, "%s, from %s", crs ? crs : "", cmd.origin);
    if (crs) /* it is not that any more */
        hm_cli_check(cli, hm_header_set(&m->header, "crs", text, &d), &d);
}

static void split(struct hm_cli *cli, struct hm_mesh *m)
{
    struct hm_diag d = {0};
    int64_t count;
    hm_cli_check(cli, hm_split_quads(m, &count, &d), &d);
    if (count > 0)
        hm_cli_say(cli, "%s split into triangles", hm_cli_counted(count, "quadrilateral").text);
}

static int64_t count_strings(const struct hm_mesh *m)
{
    int64_t n = 0;
    for (size_t k = 0; k < m->header.nkeys; k++)
        n += !strcmp(m->header.keys[k].name, "string");
    return n;
}

/* Say what the format cannot hold. */
static void say_losses(struct hm_cli *cli, const struct hm_mesh *m, const char *name, int lacks)
{
    int64_t strings = count_strings(m), none = 0, some = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        none += m->elem[k].region == 0;
        some += m->elem[k].region != 0;
    }
    if ((lacks & NO_STRINGS) && strings > 0)
        hm_cli_say(cli, "%s has no node strings: %lld dropped", name, (long long)strings);
    if ((lacks & NO_REGIONS) && some > 0)
        hm_cli_say(cli, "%s has no materials: those of %lld elements dropped", name,
                   (long long)some);
    if ((lacks & FROM_ONE) && none > 0)
        hm_cli_say(cli, "%s has no material 0: %lld elements get the number behind the largest",
                   name, (long long)none);
    if (lacks & NO_HEIGHTS)
        hm_cli_say(cli, "%s has no heights: dropped", name);
    if (lacks & SEVEN_PLACES)
        hm_cli_say(cli, "%s has seven decimals", name);
}

static void write_mesh_as(struct hm_cli *cli, struct hm_mesh *m)
{
    struct hm_diag d = {0};
    int lacks = formats[cmd.to].lacks;
    for (size_t k = 0; k < m->nnodes; k++)
        if (!isfinite(m->node[k].z) && !(lacks & NO_HEIGHTS)) {
            hm_fail_at(&d, HM_EGEOM, m->node[k].x, m->node[k].y, "a node has no height");
            hm_cli_check(cli, HM_EGEOM, &d);
        }
    say_losses(cli, m, formats[cmd.to].name, lacks);
    for (size_t k = 0; k < m->nnodes && (lacks & DEPTHS); k++)
        m->node[k].z = cmd.datum - m->node[k].z;
    hm_cli_check(cli, formats[cmd.to].write(m, hm_cli_writer(cli), &d), &d);
}

/* A mesh of a stream is changed by what was asked alone. */
static void change_mesh(struct hm_cli *cli, struct hm_mesh *m)
{
    if (cmd.split || (formats[cmd.to].lacks & NO_QUADS))
        split(cli, m);
    if (cmd.origin)
        shift(cli, m);
}

static enum hm_err copy_mesh(struct hm_cli *cli, const struct hm_header *h, struct hm_diag *d)
{
    struct hm_mesh m = {0};
    struct hm_header own = {0};
    enum hm_err err = hm_header_copy(&own, h, d);
    if (!err)
        err = hm_mesh_read(&m, hm_cli_reader(cli), &own, d);
    if (!err)
        err = hm_header_add_history(&m.header, hm_cli_history(cli), d);
    if (!err) {
        change_mesh(cli, &m);
        err = hm_mesh_write(&m, hm_cli_writer(cli), d);
    }
    hm_mesh_free(&m);
    return err;
}

static void write_held(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    if (formats[cmd.to].format == MESH) {
        change_mesh(cli, &held.mesh);
        write_mesh_as(cli, &held.mesh);
    } else {
        int decimals = hm_cli_format(cli).decimals;
        hm_cli_check(cli, hm_export_asc(&held.grid, held.band, decimals, hm_cli_writer(cli), &d),
                     &d);
    }
    hm_mesh_free(&held.mesh);
    hm_grid_free(&held.grid);
}

/* --- points and lines --- */

static enum hm_err export_points(struct hm_cli *cli, struct hm_reader *r, const struct hm_header *h,
                                 int64_t *left_out, struct hm_diag *d)
{
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_batch_read(&b, r, h, d)))
        err = hm_export_xyz(b.rows, b.n, h->nfields, hm_cli_format(cli).decimals, left_out,
                            hm_cli_writer(cli), d);
    hm_batch_free(&b);
    return err;
}

static enum hm_err export_nodes(struct hm_cli *cli, struct hm_reader *r, const struct hm_header *h,
                                int64_t *left_out, struct hm_diag *d)
{
    const struct hm_lattice *l = &h->lattice;
    size_t bands = h->nfields - 2, band = find_band(cli, h);
    double *row = hm_alloc((size_t)l->nx * bands, sizeof *row);
    enum hm_err err = row ? HM_OK : hm_fail_memory(d);
    for (int64_t j = 0; !err && !(err = hm_reader_row(r, row, d)); j++)
        for (int64_t i = 0; i < l->nx && !err; i++) {
            double node[3] = {l->x0 + (double)i * l->dx, l->y0 + (double)j * l->dy,
                              row[(size_t)i * bands + band]};
            err = hm_export_xyz(node, 1, 3, hm_cli_format(cli).decimals, left_out,
                                hm_cli_writer(cli), d);
        }
    free(row);
    return err;
}

static enum hm_err export_lines(struct hm_cli *cli, struct hm_reader *r, struct hm_diag *d)
{
    struct hm_line line;
    enum hm_err err;
    while (!(err = hm_reader_line(r, &line, d)))
        if ((err = hm_export_gmt(&line, hm_cli_format(cli).decimals, hm_cli_writer(cli), d)))
            break;
    return err;
}

/* --- one object after the other --- */

static enum hm_err convert(struct hm_cli *cli, struct hm_header *h, int64_t *left_out,
                           struct hm_diag *d)
{
    struct hm_reader *r = hm_cli_reader(cli);
    if (cmd.info)
        return hm_describe(r, h, hm_cli_writer(cli), d);
    switch (formats[cmd.to].format) {
    case MESH:
    case GRID_ASC:
        return hold(cli, h, d);
    case TABLE_XYZ:
        return h->kind == HM_GRID ? export_nodes(cli, r, h, left_out, d)
                                  : export_points(cli, r, h, left_out, d);
    case LINES_GMT:
        return export_lines(cli, r, d);
    default:
        return h->kind == HM_MESH && (cmd.split || cmd.origin) ? copy_mesh(cli, h, d)
                                                               : copy_object(cli, h, d);
    }
}

static void choose_encoding(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    const char *name = formats[cmd.to].name;
    enum format to = formats[cmd.to].format;
    bool binary = to == BINARY || to == SINGLE;
    if (format.binary && cmd.to_given && !binary)
        hm_cli_die(cli, "--binary and --to %s exclude each other", name);
    if (format.decimals && binary)
        hm_cli_die(cli, "--precision is for text, --to %s is not", name);
    if (format.decimals && to == MESH)
        hm_cli_die(cli, "--precision would move the nodes of a mesh");
    format.binary |= binary;
    format.single = to == SINGLE;
    if (cmd.info)
        format = (struct hm_format){0};
    hm_cli_set_format(cli, format);
}

/* A file of the format holds one object. */
static bool holds_one(void)
{
    return !cmd.info && (formats[cmd.to].format == MESH || formats[cmd.to].format == GRID_ASC);
}

/* Read all inputs, and write what need not wait; how many objects. */
static int64_t convert_all(struct hm_cli *cli)
{
    const char *name = formats[cmd.to].name;
    int kinds = cmd.info ? HM_ANY : formats[cmd.to].kinds;
    bool one = holds_one();
    int64_t count = 0, left_out = 0;
    struct hm_header h;
    while (hm_cli_next(cli, &h)) {
        struct hm_diag d = {0};
        const char *source = hm_reader_name(hm_cli_reader(cli)), *kind = hm_kind_name(h.kind);
        if (!((int)h.kind & kinds))
            hm_cli_say(cli, "%s: %s not written as %s", source, kind, name);
        else if (count++ && one)
            hm_cli_die(cli, "%s: a %s file holds one %s, this is the second", source, name, kind);
        else
            hm_cli_check(cli, convert(cli, &h, &left_out, &d), &d);
        hm_header_free(&h);
    }
    if (left_out)
        hm_cli_say(cli, "%lld without height left out", (long long)left_out);
    return count;
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    choose_encoding(cli);
    if (!convert_all(cli))
        hm_cli_die(cli, "nothing among the inputs that %s can hold", formats[cmd.to].name);
    if (holds_one())
        write_held(cli);
    return hm_cli_finish(cli);
}
