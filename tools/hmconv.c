/* hmconv: any file → the project's streams, or a format of other programs; or what is in it.
 *
 * Streams take all kinds, object by object; the other formats take the objects of their kind.
 */
#include "hm_batch.h"
#include "hm_cli.h"
#include "hm_copy.h"
#include "hm_crs.h"
#include "hm_describe.h"
#include "hm_export.h"
#include "hm_import.h"
#include "hm_num.h"
#include "hm_split.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum hm_err write_mesh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* What a format of meshes has no place for, or has otherwise. */
enum {
    NO_QUADS = 1,
    NO_STRINGS = 2,
    NO_REGIONS = 4,
    NO_HEIGHTS = 8,
    DEPTHS = 16,       /* positive down */
    FROM_ONE = 32,     /* no region 0 */
    SEVEN_PLACES = 64, /* behind the point */
    NO_CRS = 128,
    CRS_OF_EPSG = 256 /* that has a code */
};

/* How a format is written: as objects come, or held until all inputs were read, so that nothing is
 * written when one of them is broken. */
enum way {
    STREAM, /* the project's own */
    XYZ,
    CSV,
    GMT, /* as they come */
    MESH,
    GRID, /* one object, held */
    FEATURES,
    PLANAR /* all objects, held: for a GIS, for Triangle */
};

static const struct {
    const char *name;
    enum way way;
    int kinds; /* that it can hold */
    write_mesh *write;
    int lacks;
} formats[] = {
    {"text", STREAM, HM_ANY, NULL, 0},
    {"binary", STREAM, HM_ANY, NULL, 0},
    {"single", STREAM, HM_GRID, NULL, 0},
    {"2dm", MESH, HM_MESH, hm_export_2dm, NO_CRS},
    {"ugrid", MESH, HM_MESH, hm_export_ugrid, NO_STRINGS},
    {"geo", MESH, HM_MESH, hm_export_rma2, FROM_ONE | NO_CRS},
    {"2d", MESH, HM_MESH, hm_export_kalypso, FROM_ONE | NO_STRINGS | SEVEN_PLACES | NO_CRS},
    {"gr3", MESH, HM_MESH, hm_export_gr3, NO_REGIONS | DEPTHS | NO_CRS},
    {"fort14", MESH, HM_MESH, hm_export_gr3, NO_REGIONS | NO_QUADS | DEPTHS | NO_CRS},
    {"slf", MESH, HM_MESH, hm_export_slf, NO_REGIONS | NO_QUADS | NO_STRINGS | NO_CRS},
    {"cli", MESH, HM_MESH, hm_export_cli, NO_QUADS},
    {"vtk", MESH, HM_MESH, hm_export_vtk, NO_STRINGS | NO_CRS},
    {"vtu", MESH, HM_MESH, hm_export_vtu, NO_STRINGS | NO_CRS},
    {"msh", MESH, HM_MESH, hm_export_msh, NO_CRS},
    {"ply", MESH, HM_MESH, hm_export_ply, NO_STRINGS | NO_CRS},
    {"tsh", MESH, HM_MESH, hm_export_tsh, NO_QUADS},
    {"medit", MESH, HM_MESH, hm_export_medit, NO_HEIGHTS | NO_CRS},
    {"srhgeom", MESH, HM_MESH, hm_export_srh, NO_REGIONS | NO_CRS},
    {"ele", MESH, HM_MESH, hm_export_ele, NO_QUADS | NO_STRINGS},
    {"node", PLANAR, HM_POINTS | HM_MESH, NULL, NO_CRS},
    {"poly", PLANAR, HM_POINTS | HM_LINES, NULL, NO_CRS},
    {"asc", GRID, HM_GRID, NULL, NO_CRS},
    {"xyz", XYZ, HM_POINTS | HM_GRID, NULL, NO_CRS},
    {"csv", CSV, HM_POINTS | HM_GRID, NULL, NO_CRS},
    {"gmt", GMT, HM_LINES, NULL, NO_CRS},
    {"ogrgmt", FEATURES, HM_LINES, NULL, CRS_OF_EPSG},
    {"geojson", FEATURES, HM_POINTS | HM_LINES, NULL, 0},
    {"wkt", FEATURES, HM_POINTS | HM_LINES, NULL, NO_CRS}};
#define CHOICES                                                                                    \
    "text|binary|single|2dm|ugrid|geo|2d|gr3|fort14|slf|cli|vtk|vtu|msh|ply|tsh|medit|srhgeom|"    \
    "ele|node|poly|asc|xyz|csv|gmt|ogrgmt|geojson|wkt"

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
     .help = "gr3, fort14, both ways: the height that depths count from (default 0)"},
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

static bool is_format(const char *name)
{
    return !strcmp(formats[cmd.to].name, name);
}

/* --- to streams --- */

/* Where the product goes: the output, or, with --precision, a file until all inputs were read,
 * since a mesh among them is an error then, and nothing is to be written. */
static struct hm_writer *product;
static int spool = -1;

static void open_product(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    struct hm_diag d = {0};
    if (!format.decimals || formats[cmd.to].way != STREAM || cmd.info) {
        product = hm_cli_writer(cli);
        return;
    }
    spool = hm_cli_spool(cli);
    int copy = dup(spool);
    if (copy < 0)
        hm_cli_die(cli, "%s", strerror(errno));
    hm_cli_check(cli, hm_writer_open_fd(&product, copy, "what was read", format, &d), &d);
}

static void close_product(struct hm_cli *cli)
{
    char bytes[1 << 16];
    struct hm_diag d = {0};
    ssize_t n = 0;
    if (spool < 0)
        return;
    hm_cli_check(cli, hm_writer_close(&product, &d), &d);
    if (lseek(spool, 0, SEEK_SET) == 0)
        while ((n = read(spool, bytes, sizeof bytes)) > 0)
            hm_cli_check(cli, hm_writer_bytes(hm_cli_writer(cli), bytes, (size_t)n, &d), &d);
    if (n < 0)
        hm_cli_die(cli, "%s", strerror(errno));
    close(spool);
}

/* What came, in another encoding. That adds nothing to the history, but rounding does. */
static enum hm_err copy_object(struct hm_cli *cli, struct hm_header *h, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    if (hm_cli_format(cli).decimals && h->kind == HM_MESH)
        hm_cli_die(cli, "%s: --precision would move the nodes of a mesh",
                   hm_reader_name(hm_cli_reader(cli)));
    if (hm_cli_format(cli).decimals)
        err = hm_header_add_history(h, hm_cli_history(cli), d);
    return err ? err : hm_copy_object(hm_cli_reader(cli), h, &product, 1, d);
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

/* What is written when all inputs were read. */
static struct hm_inputs held;
static size_t held_band;

/* Some memory, or the end. */
static void *need(struct hm_cli *cli, void *memory)
{
    if (!memory)
        hm_cli_die(cli, "out of memory");
    return memory;
}

/* Depths below --datum, which the reader takes to be below 0, become heights. */
static bool has_depths(struct hm_cli *cli)
{
    const struct hm_foreign *found = hm_reader_found(hm_cli_reader(cli));
    return found && !strcmp(found->name, "gr3") && cmd.datum != 0;
}

static enum hm_err read_mesh(struct hm_cli *cli, struct hm_mesh *m, struct hm_header *h,
                             struct hm_diag *d)
{
    double datum = has_depths(cli) ? cmd.datum : 0;
    enum hm_err err = hm_mesh_read(m, hm_cli_reader(cli), h, d);
    for (size_t k = 0; k < m->nnodes && !err && datum != 0; k++)
        m->node[k].z += datum;
    return err;
}

static enum hm_err hold(struct hm_cli *cli, const struct hm_header *h, struct hm_diag *d)
{
    struct hm_header own = {0};
    struct hm_reader *r = hm_cli_reader(cli);
    enum hm_err err = hm_header_copy(&own, h, d);
    if (err)
        return err;
    switch (h->kind) {
    case HM_POINTS:
        return hm_points_read(need(cli, hm_inputs_add_points(&held)), r, &own, d);
    case HM_LINES:
        return hm_lines_read(need(cli, hm_inputs_add_lines(&held)), r, &own, d);
    case HM_GRID:
        held_band = find_band(cli, h);
        return hm_grid_read(need(cli, hm_inputs_add_grid(&held)), r, &own, d);
    default:
        return read_mesh(cli, need(cli, hm_inputs_add_mesh(&held)), &own, d);
    }
}

/* --- what is lost --- */

/* What a header says and the format cannot, each once. */
static void say_header_losses(struct hm_cli *cli, const struct hm_header *h)
{
    static bool crs_said, units_said;
    const char *crs = hm_header_get(h, "crs"), *name = formats[cmd.to].name;
    int lacks = formats[cmd.to].lacks;
    bool no_crs = (lacks & NO_CRS) || (crs && (lacks & CRS_OF_EPSG) && hm_crs_epsg(crs) == 0);
    char unit[16];
    hm_header_unit(h, 0, unit, sizeof unit);
    if (crs && no_crs && !crs_said)
        hm_cli_say(cli, "%s has no place for the crs: \"%s\" dropped", name, crs);
    if (strcmp(unit, "m") && !units_said && formats[cmd.to].way != STREAM)
        hm_cli_say(cli, "%s has no units: coordinates stay in %s", name, unit);
    crs_said |= crs && no_crs;
    units_said |= strcmp(unit, "m") != 0;
}

/* What becomes of columns behind the height, for Triangle. */
static void say_attributes(struct hm_cli *cli, const struct hm_header *h)
{
    for (size_t k = 3; k < h->nfields && is_format("node"); k++)
        hm_cli_say(cli, "%s: node has no names of columns: %s is attribute %zu",
                   hm_reader_name(hm_cli_reader(cli)), h->fields[k], k - 1);
}

/* Columns from `first` on, but for one, that the format has no place for. */
static void say_columns(struct hm_cli *cli, const struct hm_header *h, size_t first, size_t but)
{
    for (size_t k = first; k < h->nfields; k++)
        if (k != but)
            hm_cli_say(cli, "%s: %s has no place for the column %s: dropped",
                       hm_reader_name(hm_cli_reader(cli)), formats[cmd.to].name, h->fields[k]);
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
    hm_cli_check(cli, formats[cmd.to].write(m, product, &d), &d);
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
        err = read_mesh(cli, &m, &own, d);
    if (!err)
        err = hm_header_add_history(&m.header, hm_cli_history(cli), d);
    if (!err) {
        change_mesh(cli, &m);
        err = hm_mesh_write(&m, product, d);
    }
    hm_mesh_free(&m);
    return err;
}

/* Lines for a GIS, or for Triangle, and the points with them. */
static void write_features(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    int64_t lost = 0;
    int decimals = hm_cli_format(cli).decimals;
    enum hm_err err;
    if (is_format("ogrgmt"))
        err = hm_export_ogrgmt(&held, decimals, product, &d);
    else if (is_format("geojson"))
        err = hm_export_geojson(&held, decimals, &lost, product, &d);
    else
        err = hm_export_wkt(&held, decimals, &lost, product, &d);
    hm_cli_check(cli, err, &d);
    if (lost > 0)
        hm_cli_say(cli, "%s without a height at some vertex: all heights of it dropped",
                   hm_cli_counted(lost, "line").text);
}

static void write_planar(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    int64_t lost = 0;
    enum hm_err err;
    if (held.nmeshes > 1 || (held.nmeshes > 0 && held.npoints > 0))
        hm_cli_die(cli, "a node file holds points, or the nodes of one mesh, and no more");
    if (held.nmeshes > 0)
        change_mesh(cli, &held.mesh[0]);
    err = is_format("node") ? hm_export_node(&held, product, &d)
                            : hm_export_poly(&held, &lost, product, &d);
    hm_cli_check(cli, err, &d);
    if (lost > 0)
        hm_cli_say(cli, "%s dropped: another vertex at that place has another",
                   hm_cli_counted(lost, "height").text);
}

static void write_held(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    int decimals = hm_cli_format(cli).decimals;
    switch (formats[cmd.to].way) {
    case MESH:
        change_mesh(cli, &held.mesh[0]);
        write_mesh_as(cli, &held.mesh[0]);
        break;
    case GRID:
        hm_cli_check(cli, hm_export_asc(&held.grid[0], held_band, decimals, product, &d), &d);
        break;
    case FEATURES:
        write_features(cli);
        break;
    default:
        write_planar(cli);
        break;
    }
    hm_inputs_free(&held);
}

/* --- points and lines --- */

/* Points, or nodes, as rows of a table: x y z alone, or all columns under their names. */
static enum hm_err export_rows(struct hm_cli *cli, const double *rows, size_t n, size_t stride,
                               int64_t *left_out, struct hm_diag *d)
{
    int decimals = hm_cli_format(cli).decimals;
    return formats[cmd.to].way == CSV
               ? hm_export_csv(rows, n, stride, decimals, product, d)
               : hm_export_xyz(rows, n, stride, decimals, left_out, product, d);
}

static enum hm_err export_points(struct hm_cli *cli, struct hm_reader *r, const struct hm_header *h,
                                 int64_t *left_out, struct hm_diag *d)
{
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    if (formats[cmd.to].way == XYZ)
        say_columns(cli, h, 3, 0);
    while (!err && !(err = hm_batch_read(&b, r, h, d)))
        err = export_rows(cli, b.rows, b.n, h->nfields, left_out, d);
    hm_batch_free(&b);
    return err;
}

/* Nodes of a grid: with the band that was asked for, or in a table of columns with all. */
static enum hm_err export_nodes(struct hm_cli *cli, struct hm_reader *r, const struct hm_header *h,
                                int64_t *left_out, struct hm_diag *d)
{
    const struct hm_lattice *l = &h->lattice;
    bool all = formats[cmd.to].way == CSV;
    size_t bands = h->nfields - 2, band = find_band(cli, h), kept = all ? bands : 1;
    double *row = hm_alloc((size_t)l->nx * bands, sizeof *row);
    double *node = hm_alloc(h->nfields, sizeof *node);
    enum hm_err err = row && node ? HM_OK : hm_fail_memory(d);
    if (!all)
        say_columns(cli, h, 2, band + 2);
    for (int64_t j = 0; !err && !(err = hm_reader_row(r, row, d)); j++)
        for (int64_t i = 0; i < l->nx && !err; i++) {
            node[0] = l->x0 + (double)i * l->dx;
            node[1] = l->y0 + (double)j * l->dy;
            memcpy(node + 2, row + (size_t)i * bands + (all ? 0 : band), kept * sizeof *node);
            err = export_rows(cli, node, 1, 2 + kept, left_out, d);
        }
    free(row);
    free(node);
    return err;
}

/* The first object names the columns of a table; all others must have the same. */
static void name_columns(struct hm_cli *cli, const struct hm_header *h)
{
    static struct hm_header first;
    struct hm_diag d = {0};
    bool same = h->nfields == first.nfields;
    for (size_t k = 0; same && k < h->nfields; k++)
        same = !strcmp(h->fields[k], first.fields[k]);
    if (first.nfields > 0 && !same)
        hm_cli_die(cli, "%s: other columns than those of the table before",
                   hm_reader_name(hm_cli_reader(cli)));
    if (first.nfields > 0)
        return;
    hm_cli_check(cli, hm_header_copy(&first, h, &d), &d);
    hm_cli_check(cli, hm_export_csv_names(h->fields, h->nfields, product, &d), &d);
}

static enum hm_err export_lines(struct hm_cli *cli, struct hm_reader *r, struct hm_diag *d)
{
    struct hm_line line;
    enum hm_err err;
    while (!(err = hm_reader_line(r, &line, d)))
        if ((err = hm_export_gmt(&line, hm_cli_format(cli).decimals, product, d)))
            break;
    return err;
}

/* --- one object after the other --- */

static enum hm_err convert(struct hm_cli *cli, struct hm_header *h, int64_t *left_out,
                           struct hm_diag *d)
{
    struct hm_reader *r = hm_cli_reader(cli);
    enum way way = formats[cmd.to].way;
    if (cmd.info)
        return hm_describe(r, h, product, d);
    say_header_losses(cli, h);
    switch (way) {
    case STREAM:
        return h->kind == HM_MESH && (cmd.split || cmd.origin || has_depths(cli))
                   ? copy_mesh(cli, h, d)
                   : copy_object(cli, h, d);
    case XYZ:
    case CSV:
        if (way == CSV)
            name_columns(cli, h);
        return h->kind == HM_GRID ? export_nodes(cli, r, h, left_out, d)
                                  : export_points(cli, r, h, left_out, d);
    case GMT:
        return export_lines(cli, r, d);
    case GRID:
        say_columns(cli, h, 2, find_band(cli, h) + 2);
        return hold(cli, h, d);
    case PLANAR:
        say_attributes(cli, h);
        if (is_format("poly"))
            say_columns(cli, h, 3, 0);
        return hold(cli, h, d);
    default:
        return hold(cli, h, d);
    }
}

static void choose_encoding(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    const char *name = formats[cmd.to].name;
    enum way way = formats[cmd.to].way;
    bool single = is_format("single"), binary = single || is_format("binary");
    if (format.binary && cmd.to_given && !binary)
        hm_cli_die(cli, "--binary and --to %s exclude each other", name);
    if (format.decimals && binary)
        hm_cli_die(cli, "--precision is for text, --to %s is not", name);
    if (format.decimals && (way == MESH || way == PLANAR))
        hm_cli_die(cli, "--precision would move the nodes of a mesh");
    format.binary |= binary;
    format.single = single;
    if (cmd.info)
        format = (struct hm_format){0};
    hm_cli_set_format(cli, format);
}

/* A file of the format holds one object. */
static bool holds_one(void)
{
    return !cmd.info && (formats[cmd.to].way == MESH || formats[cmd.to].way == GRID);
}

/* Is anything written when all inputs were read? */
static bool holds(void)
{
    return !cmd.info && formats[cmd.to].way >= MESH;
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
    open_product(cli);
    if (!convert_all(cli))
        hm_cli_die(cli, "nothing among the inputs that %s can hold", formats[cmd.to].name);
    if (holds())
        write_held(cli);
    close_product(cli);
    return hm_cli_finish(cli);
}
