#include "hm_describe.h"

#include "hm_batch.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The range of one column. */
struct range {
    double least, most;
    int64_t missing;
};

static void widen(struct range *r, double v)
{
    if (isnan(v))
        r->missing++;
    else if (r->least > r->most)
        r->least = r->most = v;
    else if (v < r->least)
        r->least = v;
    else if (v > r->most)
        r->most = v;
}

static struct range *new_ranges(size_t n)
{
    struct range *r = hm_alloc(n, sizeof *r);
    for (size_t k = 0; r && k < n; k++)
        r[k] = (struct range){1, 0, 0};
    return r;
}

static enum hm_err say_range(struct hm_writer *w, const char *name, const struct range *r,
                             struct hm_diag *d)
{
    char least[HM_NUM_CHARS], most[HM_NUM_CHARS];
    enum hm_err err;
    if (r->least > r->most)
        return hm_writer_printf(w, d, "  %-8s no values\n", name);
    least[hm_num_print(least, r->least)] = 0;
    most[hm_num_print(most, r->most)] = 0;
    err = hm_writer_printf(w, d, "  %-8s %s .. %s", name, least, most);
    if (!err && r->missing)
        err = hm_writer_printf(w, d, ", %lld missing", (long long)r->missing);
    return err ? err : hm_writer_printf(w, d, "\n");
}

static enum hm_err say_ranges(struct hm_writer *w, const struct hm_header *h, size_t first,
                              const struct range *r, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = first; k < h->nfields && !err; k++)
        err = say_range(w, h->fields[k], &r[k], d);
    return err;
}

static enum hm_err describe_points(struct hm_reader *r, const struct hm_header *h,
                                   struct hm_writer *w, struct hm_diag *d)
{
    struct hm_batch b = {0};
    struct range *range = new_ranges(h->nfields);
    int64_t count = 0;
    enum hm_err err = range ? HM_OK : hm_fail_memory(d);
    while (!err && !(err = hm_batch_read(&b, r, h, d))) {
        count += (int64_t)b.n;
        for (size_t k = 0; k < b.n * h->nfields; k++)
            widen(&range[k % h->nfields], b.rows[k]);
    }
    if (err == HM_END)
        err = hm_writer_printf(w, d, "  points   %lld\n", (long long)count);
    if (!err)
        err = say_ranges(w, h, 0, range, d);
    hm_batch_free(&b);
    free(range);
    return err;
}

static enum hm_err say_lattice(struct hm_writer *w, const struct hm_lattice *l, struct hm_diag *d)
{
    const double value[] = {l->dx, l->dy,
                            l->x0, l->x0 + (double)(l->nx - 1) * l->dx,
                            l->y0, l->y0 + (double)(l->ny - 1) * l->dy};
    char text[6][HM_NUM_CHARS];
    for (int k = 0; k < 6; k++)
        text[k][hm_num_print(text[k], value[k])] = 0;
    return hm_writer_printf(
        w, d,
        "  nodes    %lld x %lld\n  step     %s %s\n  x        %s .. %s\n  y        %s .. %s\n",
        (long long)l->nx, (long long)l->ny, text[0], text[1], text[2], text[3], text[4], text[5]);
}

static enum hm_err describe_grid(struct hm_reader *r, const struct hm_header *h,
                                 struct hm_writer *w, struct hm_diag *d)
{
    size_t bands = h->nfields - 2, width = (size_t)h->lattice.nx * bands;
    double *row = hm_alloc(width, sizeof *row);
    struct range *range = new_ranges(h->nfields);
    enum hm_err err = row && range ? HM_OK : hm_fail_memory(d);
    while (!err && !(err = hm_reader_row(r, row, d)))
        for (size_t k = 0; k < width; k++)
            widen(&range[2 + k % bands], row[k]);
    if (err == HM_END)
        err = say_lattice(w, &h->lattice, d);
    if (!err)
        err = say_ranges(w, h, 2, range, d);
    free(row);
    free(range);
    return err;
}

static enum hm_err describe_lines(struct hm_reader *r, struct hm_writer *w, struct hm_diag *d)
{
    struct range range[3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    int64_t lines = 0, closed = 0, vertices = 0;
    struct hm_line line;
    enum hm_err err;
    while (!(err = hm_reader_line(r, &line, d))) {
        lines++;
        closed += line.closed;
        vertices += (int64_t)line.n;
        for (size_t k = 0; k < 3 * line.n; k++)
            widen(&range[k % 3], line.xyz[k]);
    }
    if (err == HM_END)
        err = hm_writer_printf(w, d, "  lines    %lld, %lld closed, %lld vertices\n",
                               (long long)lines, (long long)closed, (long long)vertices);
    static const char *const names[] = {"x", "y", "z"};
    for (int k = 0; k < 3 && !err; k++)
        err = say_range(w, names[k], &range[k], d);
    return err;
}

static enum hm_err describe_mesh(struct hm_reader *r, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_mesh m = {0};
    struct range x = {1, 0, 0}, y = x, z = x, region = x;
    size_t triangles = 0;
    enum hm_err err = hm_reader_mesh(r, &m, d);
    for (size_t k = 0; k < m.nnodes && !err; k++) {
        widen(&x, m.node[k].x);
        widen(&y, m.node[k].y);
        widen(&z, m.node[k].z);
    }
    for (size_t k = 0; k < m.nelems && !err; k++) {
        triangles += hm_elem_corners(&m.elem[k]) == 3;
        widen(&region, m.elem[k].region);
    }
    if (!err)
        err =
            hm_writer_printf(w, d, "  nodes    %zu\n  elements %zu triangles, %zu quadrilaterals\n",
                             m.nnodes, triangles, m.nelems - triangles);
    if (!err)
        err = say_range(w, "x", &x, d);
    if (!err)
        err = say_range(w, "y", &y, d);
    if (!err)
        err = say_range(w, "z", &z, d);
    if (!err)
        err = say_range(w, "region", &region, d);
    hm_mesh_free(&m);
    return err;
}

enum hm_err hm_describe(struct hm_reader *r, const struct hm_header *h, struct hm_writer *w,
                        struct hm_diag *d)
{
    enum hm_err err = hm_writer_printf(w, d, "%s: %s\n", hm_reader_name(r), hm_kind_name(h->kind));
    if (!err)
        err = h->kind == HM_POINTS  ? describe_points(r, h, w, d)
              : h->kind == HM_GRID  ? describe_grid(r, h, w, d)
              : h->kind == HM_LINES ? describe_lines(r, w, d)
                                    : describe_mesh(r, w, d);
    for (size_t k = 0; k < h->nkeys && !err; k++)
        err = hm_writer_printf(w, d, "  %-8s %s\n", h->keys[k].name, h->keys[k].value);
    for (size_t k = 0; k < h->nhistory && !err; k++)
        err = hm_writer_printf(w, d, "  %-8s %s\n", k ? "" : "history", h->history[k]);
    return err;
}
