/* hmconv: any file → the project's streams, or a format of other programs; or what is in it.
 *
 * Streams take all kinds, object by object; the other formats take the objects of their kind.
 */
#include "hm_batch.h"
#include "hm_cli.h"
#include "hm_copy.h"
#include "hm_describe.h"
#include "hm_export.h"

#include <stdlib.h>

enum format { TEXT, BINARY, SINGLE, MESH_2DM, GRID_ASC, TABLE_XYZ, LINES_GMT };

static const struct {
    const char *name;
    int kinds; /* that it can hold */
    bool one;  /* a file of it holds one object */
} formats[] = {
    [TEXT] = {"text", HM_ANY, false},      [BINARY] = {"binary", HM_ANY, false},
    [SINGLE] = {"single", HM_GRID, false}, [MESH_2DM] = {"2dm", HM_MESH, true},
    [GRID_ASC] = {"asc", HM_GRID, true},   [TABLE_XYZ] = {"xyz", HM_POINTS | HM_GRID, false},
    [LINES_GMT] = {"gmt", HM_LINES, false}};

static struct {
    int format;
    bool format_given, info;
    const char *band;
} cmd;

static const struct hm_option options[] = {
    {'t', "to", NULL, HM_OPT_CHOICE, &cmd.format, .help = "what to write (default text)",
     .choices = "text|binary|single|2dm|asc|xyz|gmt", .silent = true, .given = &cmd.format_given},
    {'i', "info", NULL, HM_OPT_FLAG, &cmd.info, .help = "say what the files hold instead",
     .silent = true},
    {0, "band", "NAME", HM_OPT_TEXT, &cmd.band,
     .help = "asc, xyz: this band of a grid (default the first)", .silent = true},
    {0}};

static const struct hm_program program = {.name = "hmconv",
                                          .purpose = "any file → another format of its kind",
                                          .operands = "[file ...]",
                                          .options = options,
                                          .needs = HM_ANY,
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

static void write_held(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    struct hm_writer *w = hm_cli_writer(cli);
    int decimals = hm_cli_format(cli).decimals;
    if (cmd.format == MESH_2DM)
        hm_cli_check(cli, hm_export_2dm(&held.mesh, w, &d), &d);
    else
        hm_cli_check(cli, hm_export_asc(&held.grid, held.band, decimals, w, &d), &d);
    hm_mesh_free(&held.mesh);
    hm_grid_free(&held.grid);
}

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
    switch ((enum format)cmd.format) {
    case MESH_2DM:
    case GRID_ASC:
        return hold(cli, h, d);
    case TABLE_XYZ:
        return h->kind == HM_GRID ? export_nodes(cli, r, h, left_out, d)
                                  : export_points(cli, r, h, left_out, d);
    case LINES_GMT:
        return export_lines(cli, r, d);
    default:
        return copy_object(cli, h, d);
    }
}

static void choose_encoding(struct hm_cli *cli)
{
    struct hm_format format = hm_cli_format(cli);
    const char *name = formats[cmd.format].name;
    bool binary = cmd.format == BINARY || cmd.format == SINGLE;
    if (format.binary && cmd.format_given && !binary)
        hm_cli_die(cli, "--binary and --to %s exclude each other", name);
    if (format.decimals && binary)
        hm_cli_die(cli, "--precision is for text, --to %s is not", name);
    if (format.decimals && cmd.format == MESH_2DM)
        hm_cli_die(cli, "--precision would move the nodes of a mesh");
    format.binary |= binary;
    format.single = cmd.format == SINGLE;
    if (cmd.info)
        format = (struct hm_format){0};
    hm_cli_set_format(cli, format);
}

/* Read all inputs, and write what need not wait; how many objects. */
static int64_t convert_all(struct hm_cli *cli)
{
    const char *name = formats[cmd.format].name;
    int kinds = cmd.info ? HM_ANY : formats[cmd.format].kinds;
    bool one = !cmd.info && formats[cmd.format].one;
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
        hm_cli_die(cli, "nothing among the inputs that %s can hold", formats[cmd.format].name);
    if (!cmd.info && formats[cmd.format].one)
        write_held(cli);
    return hm_cli_finish(cli);
}
