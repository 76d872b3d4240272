#include "hm_copy.h"

#include "hm_batch.h"
#include "hm_line.h"
#include "hm_mesh.h"

#include <stdlib.h>

struct copy {
    struct hm_reader *from;
    const struct hm_header *header;
    struct hm_writer **to;
    size_t n;
};

static enum hm_err copy_points(const struct copy *c, struct hm_diag *d)
{
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_batch_read(&b, c->from, c->header, d)))
        for (size_t k = 0; k < c->n && !err; k++)
            err = hm_writer_points(c->to[k], b.rows, b.n, d);
    hm_batch_free(&b);
    return err;
}

static enum hm_err copy_rows(const struct copy *c, struct hm_diag *d)
{
    const struct hm_header *h = c->header;
    double *row = hm_alloc((size_t)h->lattice.nx * (h->nfields - 2), sizeof *row);
    enum hm_err err = row ? HM_OK : hm_fail_memory(d);
    while (!err && !(err = hm_reader_row(c->from, row, d)))
        for (size_t k = 0; k < c->n && !err; k++)
            err = hm_writer_row(c->to[k], row, d);
    free(row);
    return err;
}

static enum hm_err copy_lines(const struct copy *c, struct hm_diag *d)
{
    struct hm_line line;
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_reader_line(c->from, &line, d)))
        for (size_t k = 0; k < c->n && !err; k++)
            err = hm_writer_line(c->to[k], &line, d);
    return err;
}

static enum hm_err copy_mesh(const struct copy *c, struct hm_diag *d)
{
    struct hm_mesh m = {0};
    enum hm_err err = hm_reader_mesh(c->from, &m, d);
    for (size_t k = 0; k < c->n && !err; k++)
        err = hm_writer_mesh(c->to[k], &m, d);
    hm_mesh_free(&m);
    return err;
}

enum hm_err hm_copy_object(struct hm_reader *r, const struct hm_header *h, struct hm_writer **to,
                           size_t n, struct hm_diag *d)
{
    const struct copy c = {r, h, to, n};
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < n && !err; k++)
        err = hm_writer_begin(to[k], h, d);
    if (!err)
        err = h->kind == HM_POINTS  ? copy_points(&c, d)
              : h->kind == HM_GRID  ? copy_rows(&c, d)
              : h->kind == HM_LINES ? copy_lines(&c, d)
                                    : copy_mesh(&c, d);
    if (err == HM_END)
        err = HM_OK;
    for (size_t k = 0; k < n && !err; k++)
        err = hm_writer_end(to[k], d);
    return err;
}
