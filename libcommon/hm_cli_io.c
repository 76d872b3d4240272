#define _GNU_SOURCE
#include "hm_cli_private.h"

#include "hm_copy.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- output --- */

struct hm_writer *hm_cli_writer(struct hm_cli *cli)
{
    if (!cli->writer) {
        struct hm_diag d = {0};
        bool terminal = !strcmp(cli->output, "-") && isatty(STDOUT_FILENO);
        if (cli->binary && terminal)
            hm_cli_die(cli, "a binary stream does not go to a terminal; use -o or a pipe");
        hm_cli_check(cli, hm_writer_open(&cli->writer, cli->output, hm_cli_format(cli), &d), &d);
    }
    return cli->writer;
}

/* --- --keep: inputs to the output, and to a spool from which the tool then reads them --- */

static enum hm_err copy_operand(const char *path, bool strict, struct hm_writer *to[2],
                                struct hm_diag *d)
{
    struct hm_reader *r;
    enum hm_err err = hm_reader_open(&r, path, d);
    if (err)
        return err;
    hm_reader_strict(r, strict);
    struct hm_header h;
    while (!(err = hm_reader_next(r, &h, d))) {
        err = hm_copy_object(r, &h, to, 2, d);
        hm_header_free(&h);
        if (err)
            break;
    }
    hm_reader_close(r);
    return err == HM_END ? HM_OK : err;
}

int hm_cli_spool(struct hm_cli *cli)
{
    const char *folder = getenv("TMPDIR");
    char *path;
    if (asprintf(&path, "%s/hm-spool-XXXXXX", folder && *folder ? folder : "/tmp") < 0)
        hm_cli_die(cli, "out of memory");
    int fd = mkstemp(path);
    if (fd < 0 || unlink(path))
        hm_cli_die(cli, "%s: %s", path, strerror(errno));
    free(path);
    return fd;
}

/* What the spool stands for, in messages: "standard input, bank.hm". */
static char *operand_names(struct hm_cli *cli)
{
    char *names = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&names, &size);
    for (size_t k = 0; f && k < cli->noperands; k++) {
        const char *name = cli->operands[k];
        fprintf(f, "%s%s", k > 0 ? ", " : "", strcmp(name, "-") ? name : "standard input");
    }
    if (!f || fclose(f))
        hm_cli_die(cli, "out of memory");
    return names;
}

static void keep_inputs(struct hm_cli *cli)
{
    char *name = operand_names(cli);
    struct hm_diag d = {0};
    struct hm_writer *to[2] = {hm_cli_writer(cli), NULL};
    int spool = hm_cli_spool(cli), copy = dup(spool);
    if (copy < 0)
        hm_cli_die(cli, "%s: %s", name, strerror(errno));
    enum hm_err err = hm_writer_open_fd(&to[1], copy, name, (struct hm_format){.binary = true}, &d);
    for (; cli->opened < cli->noperands && !err; cli->opened++)
        err = copy_operand(cli->operands[cli->opened], cli->strict, to, &d);
    if (!err)
        err = hm_writer_close(&to[1], &d);
    else
        hm_writer_abandon(to[1]);
    hm_cli_check(cli, err, &d);
    if (lseek(spool, 0, SEEK_SET))
        hm_cli_die(cli, "%s: %s", name, strerror(errno));
    hm_cli_check(cli, hm_reader_open_fd(&cli->reader, spool, name, &d), &d);
    free(name);
}

/* --- input --- */

/* Open the next operand, or with --keep what was copied of all of them; false behind the last. */
static bool open_operand(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    if (cli->opened == cli->noperands)
        return false;
    if (cli->keep)
        keep_inputs(cli);
    else
        hm_cli_check(cli, hm_reader_open(&cli->reader, cli->operands[cli->opened++], &d), &d);
    hm_reader_strict(cli->reader, cli->strict);
    hm_reader_threads(cli->reader, cli->threads);
    hm_reader_foreign(cli->reader, cli->program->foreign);
    cli->dropped = 0;
    return true;
}

static void close_operand(struct hm_cli *cli)
{
    hm_reader_close(cli->reader);
    cli->reader = NULL;
}

/* The scheme knows no unit: 0.10 m of a threshold are 0.10 ft among feet. Said once. */
static void note_units(struct hm_cli *cli, const struct hm_header *h)
{
    char unit[16];
    hm_header_unit(h, 0, unit, sizeof unit);
    if (!cli->units_said && strcmp(unit, "m"))
        hm_cli_say(cli,
                   "coordinates are in %s, and so are all lengths and limits (georef -t same "
                   "converts)",
                   unit);
    cli->units_said = cli->units_said || strcmp(unit, "m");
}

/* What the header adds to what was seen. A program that converts takes objects of different units,
 * so these are none that all have. */
static enum hm_err merge_header(struct hm_cli *cli, const struct hm_header *h, struct hm_diag *d)
{
    if (!cli->program->converts)
        return hm_header_merge(&cli->seen, h, d);
    struct hm_header unitless;
    enum hm_err err = hm_header_copy(&unitless, h, d);
    if (!err)
        err = hm_header_set(&unitless, "units", NULL, d);
    if (!err)
        err = hm_header_merge(&cli->seen, &unitless, d);
    hm_header_free(&unitless);
    return err;
}

static void note_header(struct hm_cli *cli, const struct hm_header *h)
{
    struct hm_diag d = {0};
    const struct hm_program *program = cli->program;
    const char *name = hm_reader_name(cli->reader);
    enum hm_err err = HM_OK;
    if (!cli->seen.kind)
        err = hm_header_init(&cli->seen, h->kind, &d);
    if (!err)
        err = merge_header(cli, h, &d);
    if (!err && !program->degrees_ok)
        err = hm_header_need_metres(h, &d);
    if (!err && !program->degrees_ok && !program->converts)
        err = hm_header_need_one_unit(h, &d);
    if (err && !d.source[0])
        snprintf(d.source, sizeof d.source, "%s", name);
    hm_cli_check(cli, err, &d);
    if (!program->degrees_ok && !program->converts)
        note_units(cli, h);
}

bool hm_cli_next(struct hm_cli *cli, struct hm_header *h)
{
    for (;;) {
        if (!cli->reader && !open_operand(cli))
            return false;
        struct hm_diag d = {0};
        enum hm_err err = hm_reader_next(cli->reader, h, &d);
        if (err == HM_END) {
            close_operand(cli);
            continue;
        }
        hm_cli_check(cli, err, &d);
        if (h->kind & (enum hm_kind)cli->program->needs) {
            note_header(cli, h);
            return true;
        }
        if (!(cli->dropped & (int)h->kind))
            hm_cli_say(cli, "%s: %s not used here", hm_reader_name(cli->reader),
                       hm_kind_name(h->kind));
        cli->dropped |= (int)h->kind;
        hm_header_free(h);
    }
}

struct hm_reader *hm_cli_reader(struct hm_cli *cli)
{
    return cli->reader;
}

/* --- all inputs at once --- */

void hm_cli_read_points(struct hm_cli *cli, struct hm_points *p, struct hm_header *h)
{
    struct hm_diag d = {0};
    enum hm_err err;
    hm_points_begin(p, h);
    for (size_t had = 0; !(err = hm_points_more(p, cli->reader, &d)); had = p->n)
        hm_cli_progress_points(cli, p->n - had);
    hm_cli_check(cli, err, &d);
}

/* What there was memory for. */
static void *got(struct hm_cli *cli, void *item)
{
    if (!item)
        hm_cli_die(cli, "out of memory");
    return item;
}

void hm_cli_read_all(struct hm_cli *cli, struct hm_inputs *in)
{
    *in = (struct hm_inputs){0};
    struct hm_header h;
    while (hm_cli_next(cli, &h)) {
        struct hm_diag d = {0};
        enum hm_err err = HM_OK;
        switch (h.kind) {
        case HM_POINTS:
            hm_cli_read_points(cli, got(cli, hm_inputs_add_points(in)), &h);
            break;
        case HM_GRID:
            err = hm_grid_read(got(cli, hm_inputs_add_grid(in)), cli->reader, &h, &d);
            break;
        case HM_LINES:
            err = hm_lines_read(got(cli, hm_inputs_add_lines(in)), cli->reader, &h, &d);
            break;
        default:
            err = hm_mesh_read(got(cli, hm_inputs_add_mesh(in)), cli->reader, &h, &d);
            break;
        }
        hm_cli_check(cli, err, &d);
    }
}

/* --- headers of products --- */

void hm_cli_make_header(struct hm_cli *cli, struct hm_header *h)
{
    struct hm_diag d = {0};
    enum hm_err err = HM_OK;
    if (cli->seen.kind)
        err = hm_header_merge(h, &cli->seen, &d);
    if (!err)
        err = hm_header_add_history(h, cli->history, &d);
    hm_cli_check(cli, err, &d);
}

void hm_cli_free_streams(struct hm_cli *cli)
{
    hm_reader_close(cli->reader);
    hm_writer_abandon(cli->writer);
    hm_header_free(&cli->seen);
    cli->reader = NULL;
    cli->writer = NULL;
}
