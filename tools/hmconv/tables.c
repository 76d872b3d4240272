/* Points, nodes of grids and lines, written as they come. */
#include "hmconv.h"

#include "hm_batch.h"
#include "hm_export.h"

#include <stdlib.h>
#include <string.h>

size_t hmconv_band(const struct job *j, const struct hm_header *h)
{
    if (!j->band)
        return 0;
    int field = hm_header_field(h, j->band);
    if (field < 2)
        hm_cli_die(j->cli, "%s: no band '%s'", hm_reader_name(hm_cli_reader(j->cli)), j->band);
    return (size_t)field - 2;
}

/* Points, or nodes, as rows of a table: x y z alone, or all columns under their names. */
static enum hm_err export_rows(const struct job *j, const double *rows, size_t n, size_t stride,
                               int64_t *left_out, struct hm_diag *d)
{
    int decimals = hm_cli_format(j->cli).decimals;
    return j->to->way == CSV ? hm_export_csv(rows, n, stride, decimals, j->product, d)
                             : hm_export_xyz(rows, n, stride, decimals, left_out, j->product, d);
}

static enum hm_err export_points(const struct job *j, struct hm_reader *r,
                                 const struct hm_header *h, int64_t *left_out, struct hm_diag *d)
{
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    if (j->to->way == XYZ)
        hmconv_say_columns(j, h, 3, 0);
    while (!err && !(err = hm_batch_read(&b, r, h, d)))
        err = export_rows(j, b.rows, b.n, h->nfields, left_out, d);
    hm_batch_free(&b);
    return err;
}

/* Nodes of a grid: with the band that was asked for, or in a table of columns with all. */
static enum hm_err export_nodes(const struct job *j, struct hm_reader *r, const struct hm_header *h,
                                int64_t *left_out, struct hm_diag *d)
{
    const struct hm_lattice *l = &h->lattice;
    bool all = j->to->way == CSV;
    size_t bands = h->nfields - 2, band = hmconv_band(j, h), kept = all ? bands : 1;
    double *row = hm_alloc((size_t)l->nx * bands, sizeof *row);
    double *node = hm_alloc(h->nfields, sizeof *node);
    enum hm_err err = row && node ? HM_OK : hm_fail_memory(d);
    if (!all)
        hmconv_say_columns(j, h, 2, band + 2);
    for (int64_t k = 0; !err && !(err = hm_reader_row(r, row, d)); k++)
        for (int64_t i = 0; i < l->nx && !err; i++) {
            node[0] = l->x0 + (double)i * l->dx;
            node[1] = l->y0 + (double)k * l->dy;
            memcpy(node + 2, row + (size_t)i * bands + (all ? 0 : band), kept * sizeof *node);
            err = export_rows(j, node, 1, 2 + kept, left_out, d);
        }
    free(row);
    free(node);
    return err;
}

/* The first object names the columns of a table; all others must have the same. */
static void name_columns(const struct job *j, const struct hm_header *h)
{
    static struct hm_header first;
    struct hm_diag d = {0};
    bool same = h->nfields == first.nfields;
    for (size_t k = 0; same && k < h->nfields; k++)
        same = !strcmp(h->fields[k], first.fields[k]);
    if (first.nfields > 0 && !same)
        hm_cli_die(j->cli, "%s: other columns than those of the table before",
                   hm_reader_name(hm_cli_reader(j->cli)));
    if (first.nfields > 0)
        return;
    hm_cli_check(j->cli, hm_header_copy(&first, h, &d), &d);
    hm_cli_check(j->cli, hm_export_csv_names(h->fields, h->nfields, j->product, &d), &d);
}

enum hm_err hmconv_table(const struct job *j, const struct hm_header *h, int64_t *left_out,
                         struct hm_diag *d)
{
    struct hm_reader *r = hm_cli_reader(j->cli);
    if (j->to->way == CSV)
        name_columns(j, h);
    return h->kind == HM_GRID ? export_nodes(j, r, h, left_out, d)
                              : export_points(j, r, h, left_out, d);
}

enum hm_err hmconv_lines(const struct job *j, struct hm_diag *d)
{
    struct hm_reader *r = hm_cli_reader(j->cli);
    struct hm_line line;
    enum hm_err err;
    while (!(err = hm_reader_line(r, &line, d)))
        if ((err = hm_export_gmt(&line, hm_cli_format(j->cli).decimals, j->product, d)))
            break;
    return err;
}
