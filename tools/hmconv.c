/* hmconv: any file → the project's streams, or a format of other programs; or what is in it.
 *
 * Streams take all kinds, object by object; the other formats take the objects of their kind.
 */
#include "hmconv/hmconv.h"

#include "hm_copy.h"
#include "hm_describe.h"
#include "hm_export.h"
#include "hm_import.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

static const struct format formats[] = {
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
    {"tsh", MESH, HM_MESH, hm_export_tsh, NO_QUADS | CRS_OF_UTM},
    {"medit", MESH, HM_MESH, hm_export_medit, NO_HEIGHTS | NO_CRS},
    {"srhgeom", MESH, HM_MESH, hm_export_srh, NO_REGIONS | NO_CRS},
    {"ele", MESH, HM_MESH, hm_export_ele, NO_QUADS | NO_STRINGS},
    {"node", PLANAR, HM_POINTS | HM_MESH, NULL, NO_CRS},
    {"poly", PLANAR, HM_POINTS | HM_LINES, NULL, NO_CRS},
    {"asc", GRID, HM_GRID, NULL, NO_CRS},
    {"prj", CRS, HM_ANY, NULL, 0},
    {"xyz", XYZ, HM_POINTS | HM_GRID, NULL, NO_CRS},
    {"csv", CSV, HM_POINTS | HM_GRID, NULL, NO_CRS},
    {"gmt", GMT, HM_LINES, NULL, NO_CRS},
    {"ogrgmt", FEATURES, HM_LINES, NULL, CRS_OF_EPSG},
    {"geojson", FEATURES, HM_POINTS | HM_LINES, NULL, 0},
    {"wkt", FEATURES, HM_POINTS | HM_LINES, NULL, NO_CRS}};
#define CHOICES                                                                                    \
    "text|binary|single|2dm|ugrid|geo|2d|gr3|fort14|slf|cli|vtk|vtu|msh|ply|tsh|medit|srhgeom|"    \
    "ele|node|poly|asc|prj|xyz|csv|gmt|ogrgmt|geojson|wkt"

static struct job job;
static int to;
static bool to_given;

static const struct hm_option options[] = {
    {'t', "to", "FORMAT", HM_OPT_CHOICE, &to, .help = "what to write (default text)",
     .choices = CHOICES, .silent = true, .given = &to_given},
    {'i', "info", NULL, HM_OPT_FLAG, &job.info, .help = "say what the files hold instead",
     .silent = true},
    {'s', "split", NULL, HM_OPT_FLAG, &job.split, .help = "quadrilaterals of a mesh to triangles"},
    {0, "origin", "X,Y", HM_OPT_TEXT, &job.origin,
     .help = "mesh: subtract this from all coordinates"},
    {0, "datum", "H", HM_OPT_NUMBER, &job.datum,
     .help = "gr3, fort14, both ways: the height that depths count from (default 0)"},
    {0, "band", "NAME", HM_OPT_TEXT, &job.band,
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
    return !strcmp(job.to->name, name);
}

/* --- to streams --- */

/* Where the product goes: the output, or, with --precision, a file until all inputs were read,
 * since a mesh among them is an error then, and nothing is to be written. */
static int spool = -1;

static void open_product(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    struct hm_diag d = {0};
    if (!format.decimals || job.to->way != STREAM || job.info) {
        job.product = hm_cli_writer(cli);
        return;
    }
    spool = hm_cli_spool(cli);
    int copy = dup(spool);
    if (copy < 0)
        hm_cli_die(cli, "%s", strerror(errno));
    hm_cli_check(cli, hm_writer_open_fd(&job.product, copy, "what was read", format, &d), &d);
}

static void close_product(struct hm_cli *cli)
{
    char bytes[1 << 16];
    struct hm_diag d = {0};
    ssize_t n = 0;
    if (spool < 0)
        return;
    hm_cli_check(cli, hm_writer_close(&job.product, &d), &d);
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
    return err ? err : hm_copy_object(hm_cli_reader(cli), h, &job.product, 1, d);
}

/* The crs of the first object; the others have none but that. */
static enum hm_err export_crs(struct hm_cli *cli, const struct hm_header *h, struct hm_diag *d)
{
    static bool written;
    const char *crs = hm_header_get(h, "crs");
    if (!crs)
        hm_cli_die(cli, "%s: no crs is said", hm_reader_name(hm_cli_reader(cli)));
    enum hm_err err = written ? HM_OK : hm_export_prj(crs, job.product, d);
    written = true;
    return err;
}

/* --- one object after the other --- */

static enum hm_err convert(struct hm_cli *cli, struct hm_header *h, int64_t *left_out,
                           struct hm_diag *d)
{
    if (job.info)
        return hm_describe(hm_cli_reader(cli), h, job.product, d);
    hmconv_say_header(&job, h);
    switch (job.to->way) {
    case STREAM:
        return h->kind == HM_MESH && hmconv_changes_mesh(&job) ? hmconv_copy_mesh(&job, h, d)
                                                               : copy_object(cli, h, d);
    case XYZ:
    case CSV:
        return hmconv_table(&job, h, left_out, d);
    case GMT:
        return hmconv_lines(&job, d);
    case CRS:
        return export_crs(cli, h, d);
    case GRID:
        hmconv_say_columns(&job, h, 2, hmconv_band(&job, h) + 2);
        return hmconv_hold(&job, h, d);
    case PLANAR:
        if (is_format("poly"))
            hmconv_say_columns(&job, h, 3, 0);
        else
            hmconv_say_names(&job, h);
        return hmconv_hold(&job, h, d);
    default:
        return hmconv_hold(&job, h, d);
    }
}

static void choose_encoding(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    const char *name = job.to->name;
    enum way way = job.to->way;
    bool single = is_format("single"), binary = single || is_format("binary");
    if (format.binary && to_given && !binary)
        hm_cli_die(cli, "--binary and --to %s exclude each other", name);
    if (format.decimals && binary)
        hm_cli_die(cli, "--precision is for text, --to %s is not", name);
    if (format.decimals && (way == MESH || way == PLANAR))
        hm_cli_die(cli, "--precision would move the nodes of a mesh");
    format.binary |= binary;
    format.single = single;
    if (job.info)
        format = (struct hm_format){0};
    hm_cli_set_format(cli, format);
}

/* A file of the format holds one object. */
static bool holds_one(void)
{
    return !job.info && (job.to->way == MESH || job.to->way == GRID);
}

/* Is anything written when all inputs were read? */
static bool holds(void)
{
    return !job.info && job.to->way >= MESH;
}

/* Read all inputs, and write what need not wait; how many objects. */
static int64_t convert_all(struct hm_cli *cli)
{
    const char *name = job.to->name;
    int kinds = job.info ? HM_ANY : job.to->kinds;
    bool one = holds_one();
    int64_t count = 0, left_out = 0;
    struct hm_header h;
    while (hm_cli_next(cli, &h)) {
        struct hm_diag d = {0};
        const char *source = hm_reader_name(hm_cli_reader(cli)), *kind = hm_kind_name(h.kind);
        if (!((int)h.kind & kinds))
            hm_cli_say(cli, "%s: %s not written as %s", source, kind, name);
        else if (count++ && one)
            hm_cli_die(cli, "%s: a file of %s holds one %s, this is the second", source, name,
                       kind);
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
    job.cli = cli;
    job.to = &formats[to];
    choose_encoding(cli);
    open_product(cli);
    if (!convert_all(cli))
        hm_cli_die(cli, "nothing among the inputs that %s can hold", job.to->name);
    if (holds())
        hmconv_write_held(&job);
    close_product(cli);
    return hm_cli_finish(cli);
}
