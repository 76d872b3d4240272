#include "hm_data.h"

/* A header that is written with the number of records that really follow. */
static enum hm_err begin_counted(struct hm_writer *w, const struct hm_header *h, size_t n,
                                 struct hm_diag *d)
{
    struct hm_header counted = *h; /* shares what h owns */
    if (h->count >= 0)
        counted.count = (int64_t)n;
    return hm_writer_begin(w, &counted, d);
}

/* --- points --- */

void hm_points_begin(struct hm_points *p, struct hm_header *h)
{
    *p = (struct hm_points){.header = *h, .stride = h->nfields};
    *h = (struct hm_header){0};
}

enum hm_err hm_points_more(struct hm_points *p, struct hm_reader *r, struct hm_diag *d)
{
    enum { AT_ONCE = 16384 };
    size_t n;
    if (!hm_grow(&p->v, &p->cap, (p->n + AT_ONCE) * p->stride, sizeof *p->v))
        return hm_fail_memory(d);
    enum hm_err err = hm_reader_points(r, p->v + p->n * p->stride, AT_ONCE, &n, d);
    p->n += n;
    return err;
}

enum hm_err hm_points_read(struct hm_points *p, struct hm_reader *r, struct hm_header *h,
                           struct hm_diag *d)
{
    enum hm_err err;
    hm_points_begin(p, h);
    while (!(err = hm_points_more(p, r, d)))
        ;
    return err == HM_END ? HM_OK : err;
}

enum hm_err hm_points_write(const struct hm_points *p, struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = begin_counted(w, &p->header, p->n, d);
    if (!err)
        err = hm_writer_points(w, p->v, p->n, d);
    return err ? err : hm_writer_end(w, d);
}

/* --- grids --- */

/* Row by row, so that memory grows with the rows that come, not with what the header says. */
enum hm_err hm_grid_read(struct hm_grid *g, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d)
{
    *g = (struct hm_grid){.header = *h, .bands = h->nfields - 2};
    *h = (struct hm_header){0};
    size_t row = (size_t)g->header.lattice.nx * g->bands, n = 0, cap = 0;
    for (;;) {
        /* one row more than the grid has: behind the last the reader gives none, but checks the end
         */
        if (!hm_grow(&g->v, &cap, n + row, sizeof *g->v))
            return hm_fail_memory(d);
        enum hm_err err = hm_reader_row(r, g->v + n, d);
        if (err)
            return err == HM_END ? HM_OK : err;
        n += row;
    }
}

enum hm_err hm_grid_write(const struct hm_grid *g, struct hm_writer *w, struct hm_diag *d)
{
    const struct hm_lattice *l = &g->header.lattice;
    enum hm_err err = begin_counted(w, &g->header, (size_t)(l->nx * l->ny), d);
    size_t row = (size_t)l->nx * g->bands;
    for (size_t j = 0; j < (size_t)l->ny && !err; j++)
        err = hm_writer_row(w, g->v + j * row, d);
    return err ? err : hm_writer_end(w, d);
}

/* --- lines --- */

enum hm_err hm_lines_read(struct hm_lines *l, struct hm_reader *r, struct hm_header *h,
                          struct hm_diag *d)
{
    *l = (struct hm_lines){.header = *h};
    *h = (struct hm_header){0};
    for (;;) {
        struct hm_line line;
        enum hm_err err = hm_reader_line(r, &line, d);
        if (!err)
            err = hm_lines_append(l, &line, d);
        if (err)
            return err == HM_END ? HM_OK : err;
    }
}

enum hm_err hm_lines_write(const struct hm_lines *l, struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = begin_counted(w, &l->header, l->n, d);
    for (size_t i = 0; i < l->n && !err; i++)
        err = hm_writer_line(w, &l->line[i], d);
    return err ? err : hm_writer_end(w, d);
}

/* --- meshes --- */

enum hm_err hm_mesh_read(struct hm_mesh *m, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d)
{
    *m = (struct hm_mesh){.header = *h};
    *h = (struct hm_header){0};
    return hm_reader_mesh(r, m, d);
}

enum hm_err hm_mesh_write(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = begin_counted(w, &m->header, m->nnodes + m->nelems, d);
    if (!err)
        err = hm_writer_mesh(w, m, d);
    return err ? err : hm_writer_end(w, d);
}
