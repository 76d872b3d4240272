#include "hm_writer.h"

#include "hm_writer_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A writer on an output that was just opened, or could not be. */
static enum hm_err make(struct hm_writer **w, struct hm_output *out, struct hm_format format,
                        enum hm_err err, struct hm_diag *d)
{
    *w = err ? NULL : hm_alloc0(1, sizeof **w);
    if (err)
        return err;
    if (!*w) {
        hm_output_abandon(out);
        return hm_fail_memory(d);
    }
    (*w)->format = format;
    (*w)->out = *out;
    return HM_OK;
}

enum hm_err hm_writer_open(struct hm_writer **w, const char *path, struct hm_format format,
                           struct hm_diag *d)
{
    struct hm_output out = {0};
    *w = NULL;
    if (format.decimals < 0 || format.decimals > 17)
        return hm_fail(d, HM_EARG, "places behind the point: 1 to 17");
    return make(w, &out, format, hm_output_open(&out, path, d), d);
}

enum hm_err hm_writer_open_fd(struct hm_writer **w, int fd, const char *name,
                              struct hm_format format, struct hm_diag *d)
{
    struct hm_output out = {0};
    return make(w, &out, format, hm_output_open_fd(&out, fd, name, d), d);
}

static void release(struct hm_writer *w)
{
    free(w->columns);
    free(w->column_end);
    free(w->block);
    free(w);
}

enum hm_err hm_writer_close(struct hm_writer **w, struct hm_diag *d)
{
    struct hm_writer *old = *w;
    *w = NULL;
    if (!old)
        return HM_OK;
    enum hm_err err = HM_OK;
    if (old->kind) {
        err = hm_fail(d, HM_EARG, "an object was begun and not ended");
        hm_output_abandon(&old->out);
    } else {
        err = hm_output_close(&old->out, d);
    }
    release(old);
    return err;
}

void hm_writer_abandon(struct hm_writer *w)
{
    if (!w)
        return;
    hm_output_abandon(&w->out);
    release(w);
}

enum hm_err hm_writer_begin(struct hm_writer *w, const struct hm_header *h, struct hm_diag *d)
{
    enum hm_encoding encoding = !w->format.binary  ? HM_TEXT
                                : w->format.single ? HM_F32LE
                                                   : HM_F64LE;
    if (w->kind)
        return hm_fail(d, HM_EARG, "an object within an object");
    if (encoding == HM_F32LE && h->kind != HM_GRID)
        return hm_fail(d, HM_EARG, "single precision is for grids, not for %s",
                       hm_kind_name(h->kind));
    if (h->kind == HM_MESH && !w->format.binary && w->format.decimals)
        return hm_fail(d, HM_EARG, "a mesh is written exactly: fewer digits would move its nodes");
    if (h->kind == HM_GRID) {
        enum hm_err err = hm_headio_check_lattice(&h->lattice, h->nfields - 2, d);
        if (err)
            return err;
    }
    w->kind = h->kind;
    w->nfields = h->nfields;
    w->lattice = h->lattice;
    w->records = w->rows = 0;
    w->form = w->format.binary ? &hm_writer_blocks : &hm_writer_text;
    enum hm_err err = hm_headio_write(&w->out, h, encoding, d);
    return err ? err : w->form->begin(w, d);
}

static enum hm_err expect(const struct hm_writer *w, enum hm_kind kind, struct hm_diag *d)
{
    return w->kind == kind ? HM_OK : hm_fail(d, HM_EARG, "no %s was begun", hm_kind_name(kind));
}

enum hm_err hm_writer_points(struct hm_writer *w, const double *rows, size_t n, struct hm_diag *d)
{
    enum hm_err err = expect(w, HM_POINTS, d);
    w->records += (int64_t)n;
    return err ? err : w->form->points(w, rows, n, d);
}

enum hm_err hm_writer_row(struct hm_writer *w, const double *row, struct hm_diag *d)
{
    enum hm_err err = expect(w, HM_GRID, d);
    if (!err && w->rows == w->lattice.ny)
        err = hm_fail(d, HM_EARG, "more rows than the grid has");
    if (!err)
        err = w->form->row(w, row, d);
    w->records += w->lattice.nx;
    w->rows++;
    return err;
}

enum hm_err hm_writer_line(struct hm_writer *w, const struct hm_line *line, struct hm_diag *d)
{
    enum hm_err err = expect(w, HM_LINES, d);
    if (err || line->n == 0) /* no line, as the reader sees it */
        return err;
    w->records++;
    const char *attrs = line->attrs ? line->attrs : "";
    if (hm_attr_flag(attrs, "closed") == line->closed)
        return w->form->line(w, line, attrs, d);
    char *mended = hm_attr_set(attrs, "closed", line->closed ? "1" : NULL);
    err = mended ? w->form->line(w, line, mended, d) : hm_fail_memory(d);
    free(mended);
    return err;
}

enum hm_err hm_writer_mesh(struct hm_writer *w, const struct hm_mesh *mesh, struct hm_diag *d)
{
    enum hm_err err = expect(w, HM_MESH, d);
    w->records += (int64_t)(mesh->nnodes + mesh->nelems);
    return err ? err : w->form->mesh(w, mesh, d);
}

enum hm_err hm_writer_end(struct hm_writer *w, struct hm_diag *d)
{
    if (!w->kind)
        return hm_fail(d, HM_EARG, "no object was begun");
    if (w->kind == HM_GRID && w->rows < w->lattice.ny)
        return hm_fail(d, HM_EARG, "fewer rows than the grid has");
    enum hm_err err = w->form->end(w, d);
    w->kind = 0;
    return err;
}

enum hm_err hm_writer_bytes(struct hm_writer *w, const void *bytes, size_t n, struct hm_diag *d)
{
    return hm_output_write(&w->out, bytes, n, d);
}

enum hm_err hm_writer_printf(struct hm_writer *w, struct hm_diag *d, const char *format, ...)
{
    char small[512], *text = small;
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int n = vsnprintf(small, sizeof small, format, args);
    va_end(args);
    enum hm_err err = n < 0 ? hm_fail(d, HM_EARG, "text that cannot be formatted") : HM_OK;
    if (!err && (size_t)n >= sizeof small) {
        text = hm_alloc((size_t)n + 1, 1);
        if (text)
            vsnprintf(text, (size_t)n + 1, format, again);
        else
            err = hm_fail_memory(d);
    }
    va_end(again);
    if (!err)
        err = hm_output_write(&w->out, text, (size_t)n, d);
    if (text != small)
        free(text);
    return err;
}
