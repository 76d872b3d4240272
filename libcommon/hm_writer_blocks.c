/* Writing the project's binary: blocks of 65,536 records but for the last, so that the bytes do not
 * depend on how the records came in. */
#include "hm_writer_private.h"

#include "hm_block.h"

static enum hm_err put_head(struct hm_writer *w, const char *tag, uint64_t count, struct hm_diag *d)
{
    char head[HM_BLOCK_HEAD];
    memcpy(head, tag, 4);
    hm_block_put_u32(head + 4, 0);
    hm_block_put_u64(head + 8, count);
    return hm_output_write(&w->out, head, sizeof head, d);
}

/* Write the block that was being filled, if there is anything in it. */
static enum hm_err put_block(struct hm_writer *w, const char *tag, struct hm_diag *d)
{
    size_t n = w->block_n;
    w->block_n = 0;
    enum hm_err err = n > 0 ? put_head(w, tag, n, d) : HM_OK;
    return n > 0 && !err ? hm_output_write(&w->out, w->block, n * w->record, d) : err;
}

/* Where the next records of the block go, `most` or as many as it has room for; a full block is
 * written first. */
static enum hm_err next_records(struct hm_writer *w, const char *tag, size_t most, char **to,
                                size_t *n, struct hm_diag *d)
{
    *to = NULL;
    if (w->block_n == HM_BLOCK_RECORDS) {
        enum hm_err err = put_block(w, tag, d);
        if (err)
            return err;
    }
    *n = HM_BLOCK_RECORDS - w->block_n < most ? HM_BLOCK_RECORDS - w->block_n : most;
    if (!hm_grow(&w->block, &w->block_cap, (w->block_n + *n) * w->record, 1))
        return hm_fail_memory(d);
    *to = w->block + w->block_n * w->record;
    w->block_n += *n;
    return HM_OK;
}

static enum hm_err next_record(struct hm_writer *w, const char *tag, char **to, struct hm_diag *d)
{
    size_t one;
    return next_records(w, tag, 1, to, &one, d);
}

static enum hm_err begin(struct hm_writer *w, struct hm_diag *d)
{
    (void)d;
    w->block_n = 0;
    w->record = w->kind == HM_POINTS ? 8 * w->nfields
                : w->kind == HM_GRID ? (w->format.single ? 4u : 8u) * (w->nfields - 2)
                                     : 8 * 3;
    return HM_OK;
}

static enum hm_err put_points(struct hm_writer *w, const double *rows, size_t n, struct hm_diag *d)
{
    char *to;
    for (size_t i = 0, got; i < n; i += got) {
        enum hm_err err = next_records(w, "pnts", n - i, &to, &got, d);
        if (err)
            return err;
        hm_block_put_f64s(to, rows + i * w->nfields, got * w->nfields);
    }
    return HM_OK;
}

static enum hm_err put_row(struct hm_writer *w, const double *row, struct hm_diag *d)
{
    size_t bands = w->nfields - 2, nx = (size_t)w->lattice.nx;
    char *to;
    for (size_t i = 0, got; i < nx; i += got, row += got * bands) {
        enum hm_err err = next_records(w, "rows", nx - i, &to, &got, d);
        if (err)
            return err;
        if (w->format.single)
            for (size_t b = 0; b < got * bands; b++)
                hm_block_put_f32(to + 4 * b, (float)row[b]);
        else
            hm_block_put_f64s(to, row, got * bands);
    }
    return HM_OK;
}

static enum hm_err put_line(struct hm_writer *w, const struct hm_line *line, const char *attrs,
                            struct hm_diag *d)
{
    size_t n = strlen(attrs);
    enum hm_err err = put_head(w, "line", n, d);
    if (!err)
        err = hm_output_write(&w->out, attrs, n, d);
    for (size_t i = 0; i < line->n && !err; i++) {
        char *to;
        err = next_record(w, "vert", &to, d);
        if (!err)
            hm_block_put_f64s(to, line->xyz + 3 * i, 3);
    }
    return err ? err : put_block(w, "vert", d);
}

static enum hm_err put_nodes(struct hm_writer *w, const struct hm_mesh *m, struct hm_diag *d)
{
    w->record = 40;
    for (size_t i = 0; i < m->nnodes; i++) {
        const struct hm_node *node = &m->node[i];
        double xyz[3] = {node->x, node->y, node->z};
        char *to;
        enum hm_err err = next_record(w, "vert", &to, d);
        if (err)
            return err;
        hm_block_put_f64s(to, xyz, 3);
        hm_block_put_u64(to + 24, (uint64_t)node->flags);
        hm_block_put_u64(to + 32, (uint64_t)node->owner);
    }
    return put_block(w, "vert", d);
}

/* Elements keep their order: a block ends where triangles and quadrilaterals take turns. */
static enum hm_err put_elems(struct hm_writer *w, const struct hm_mesh *m, struct hm_diag *d)
{
    static const char *const tags[] = {"tri3", "quad"};
    int before = 3;
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < m->nelems && !err; i++) {
        const struct hm_elem *e = &m->elem[i];
        int corners = hm_elem_corners(e);
        char *to;
        if (corners != before)
            err = put_block(w, tags[before - 3], d);
        before = corners;
        w->record = 8 * (size_t)(corners + 1);
        if (!err)
            err = next_record(w, tags[corners - 3], &to, d);
        for (int k = 0; k < corners && !err; k++)
            hm_block_put_u64(to + 8 * k, (uint64_t)e->node[k]);
        if (!err)
            hm_block_put_u64(to + 8 * corners, (uint64_t)e->region);
    }
    return err ? err : put_block(w, tags[before - 3], d);
}

static enum hm_err put_mesh(struct hm_writer *w, const struct hm_mesh *m, struct hm_diag *d)
{
    enum hm_err err = put_nodes(w, m, d);
    return err ? err : put_elems(w, m, d);
}

static enum hm_err put_end(struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = put_block(w, w->kind == HM_POINTS ? "pnts" : "rows", d);
    return err ? err : put_head(w, "done", (uint64_t)w->records, d);
}

const struct hm_writer_form hm_writer_blocks = {.begin = begin,
                                                .points = put_points,
                                                .row = put_row,
                                                .line = put_line,
                                                .mesh = put_mesh,
                                                .end = put_end};
