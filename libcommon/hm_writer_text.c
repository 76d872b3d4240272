/* Writing the project's text: a record a line, `#end COUNT`. */
#include "hm_writer_private.h"

#include "hm_num.h"

#include <stdio.h>
#include <string.h>

static size_t print(char *to, double v, int decimals)
{
    return decimals ? hm_num_print_fixed(to, v, decimals) : hm_num_print(to, v);
}

/* n numbers with blanks between them, and the end of the line. */
static enum hm_err put_numbers(struct hm_writer *w, const double *v, size_t n, struct hm_diag *d)
{
    int decimals = w->format.decimals;
    for (size_t i = 0; i < n; i++) {
        char *to = hm_output_room(&w->out, HM_NUM_CHARS + 1, d);
        if (!to)
            return HM_EIO;
        size_t k = print(to, v[i], decimals);
        to[k++] = i + 1 < n ? ' ' : '\n';
        w->out.fill += k;
    }
    return HM_OK;
}

/* x of every column of a grid as text, once: it is exact whatever digits are asked for, since it
 * says which node a line is. */
static enum hm_err begin(struct hm_writer *w, struct hm_diag *d)
{
    const struct hm_lattice *l = &w->lattice;
    if (w->kind != HM_GRID)
        return HM_OK;
    size_t fill = 0, nx = (size_t)l->nx;
    if (!hm_grow(&w->column_end, &w->column_end_cap, nx, sizeof *w->column_end))
        return hm_fail_memory(d);
    for (size_t i = 0; i < nx; i++) {
        if (!hm_grow(&w->columns, &w->columns_cap, fill + HM_NUM_CHARS + 1, 1))
            return hm_fail_memory(d);
        fill += hm_num_print(w->columns + fill, l->x0 + (double)i * l->dx);
        w->columns[fill++] = ' ';
        w->column_end[i] = fill;
    }
    return HM_OK;
}

static enum hm_err put_points(struct hm_writer *w, const double *rows, size_t n, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < n && !err; i++)
        err = put_numbers(w, rows + i * w->nfields, w->nfields, d);
    return err;
}

static enum hm_err put_row(struct hm_writer *w, const double *row, struct hm_diag *d)
{
    size_t bands = w->nfields - 2, nx = (size_t)w->lattice.nx, from = 0;
    char y[HM_NUM_CHARS + 1];
    size_t ny = hm_num_print(y, w->lattice.y0 + (double)w->rows * w->lattice.dy);
    y[ny++] = ' ';
    for (size_t i = 0; i < nx; i++) {
        size_t k = w->column_end[i] - from;
        char *to = hm_output_room(&w->out, k + ny, d);
        if (!to)
            return HM_EIO;
        memcpy(to, w->columns + from, k);
        memcpy(to + k, y, ny);
        w->out.fill += k + ny;
        from = w->column_end[i];
        enum hm_err err = put_numbers(w, row + i * bands, bands, d);
        if (err)
            return err;
    }
    return HM_OK;
}

static enum hm_err put_line(struct hm_writer *w, const struct hm_line *line, const char *attrs,
                            struct hm_diag *d)
{
    enum hm_err err = hm_output_write(&w->out, *attrs ? "> " : ">", *attrs ? 2 : 1, d);
    if (!err)
        err = hm_output_write(&w->out, attrs, strlen(attrs), d);
    if (!err)
        err = hm_output_write(&w->out, "\n", 1, d);
    for (size_t i = 0; i < line->n && !err; i++)
        err = put_numbers(w, line->xyz + 3 * i, 3, d);
    return err;
}

/* Decimal digits of v, 0 or more. */
static size_t print_whole(char *to, int32_t v)
{
    char digits[12];
    size_t n = 0;
    do
        digits[n++] = (char)('0' + v % 10);
    while ((v /= 10) > 0);
    for (size_t i = 0; i < n; i++)
        to[i] = digits[n - 1 - i];
    return n;
}

/* The line of an element: its tag, corners and region. */
static enum hm_err put_elem(struct hm_writer *w, char tag, const int32_t *v, int n,
                            struct hm_diag *d)
{
    char *to = hm_output_room(&w->out, 96, d);
    if (!to)
        return HM_EIO;
    size_t k = 0;
    to[k++] = tag;
    for (int i = 0; i < n; i++) {
        to[k++] = ' ';
        k += print_whole(to + k, v[i]);
    }
    to[k++] = '\n';
    w->out.fill += k;
    return HM_OK;
}

static enum hm_err put_mesh(struct hm_writer *w, const struct hm_mesh *m, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < m->nnodes && !err; i++) {
        const struct hm_node *node = &m->node[i];
        double v[5] = {node->x, node->y, node->z, node->flags, node->owner};
        err = hm_output_write(&w->out, "v ", 2, d);
        if (!err)
            err = put_numbers(w, v, 5, d);
    }
    for (size_t i = 0; i < m->nelems && !err; i++) {
        const struct hm_elem *e = &m->elem[i];
        int corners = hm_elem_corners(e);
        int32_t v[5];
        memcpy(v, e->node, sizeof e->node);
        v[corners] = e->region;
        err = put_elem(w, corners == 3 ? 't' : 'q', v, corners + 1, d);
    }
    return err;
}

static enum hm_err put_end(struct hm_writer *w, struct hm_diag *d)
{
    char text[32];
    int n = snprintf(text, sizeof text, "#end %lld\n", (long long)w->records);
    return hm_output_write(&w->out, text, (size_t)n, d);
}

const struct hm_writer_form hm_writer_text = {.begin = begin,
                                              .points = put_points,
                                              .row = put_row,
                                              .line = put_line,
                                              .mesh = put_mesh,
                                              .end = put_end};
