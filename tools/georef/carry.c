/* The places of an object, carried from one system to another. */
#include "georef.h"

#include "hm_batch.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK = 2048 }; /* rows that a thread does at a time */

struct job {
    const struct plan *plan;
    double *rows;
    size_t n, stride;
    struct hm_diag *failed; /* of each chunk */
};

/* x y and z, each times num / den. */
static void scale(double *rows, size_t n, size_t stride, const double num[2], const double den[2])
{
    if (num[0] == den[0] && num[1] == den[1])
        return;
    for (size_t i = 0; i < n; i++) {
        double *row = rows + i * stride;
        row[0] = row[0] * num[0] / den[0];
        row[1] = row[1] * num[0] / den[0];
        row[2] = row[2] * num[1] / den[1];
    }
}

static void to_metres(const struct plan *p, double *rows, size_t n, size_t stride)
{
    scale(rows, n, stride, (double[2]){p->in_xy->num, p->in_z->num},
          (double[2]){p->in_xy->den, p->in_z->den});
}

static void from_metres(const struct plan *p, double *rows, size_t n, size_t stride)
{
    scale(rows, n, stride, (double[2]){p->out_xy->den, p->out_z->den},
          (double[2]){p->out_xy->num, p->out_z->num});
}

/* Heights from one zero to the other, at places that are in longitude and latitude once inverse has
 * been over a copy of them. */
static enum hm_err lift(const struct plan *p, const struct hm_geod *inverse, double *rows, size_t n,
                        size_t stride, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < n && !err; i++) {
        double *row = rows + i * stride, at[3] = {row[0], row[1], row[2]}, height = 0;
        if (inverse)
            err = hm_geod_inverse(inverse, at, 1, 3, d);
        if (!err)
            err = hm_geoid_height(&height, p->geoid, at[0], at[1], d);
        row[2] += p->geoid_sign * height;
    }
    return err;
}

/* Streams hold no infinite numbers: 1e308 m are none in feet. */
static enum hm_err check_finite(const double *rows, size_t n, size_t stride, struct hm_diag *d)
{
    for (size_t i = 0; i < n; i++) {
        const double *row = rows + i * stride;
        if (!isfinite(row[0]) || !isfinite(row[1]) || isinf(row[2]))
            return hm_fail_at(d, HM_EGEOM, row[0], row[1], "a number grows beyond all doubles");
    }
    return HM_OK;
}

static enum hm_err carry_rows(const struct plan *p, double *rows, size_t n, size_t stride,
                              struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    bool stays = p->from == p->to; /* both NULL, or the geoid alone needs longitude and latitude */
    to_metres(p, rows, n, stride);
    if (p->from && !stays)
        err = hm_geod_inverse(p->from, rows, n, stride, d);
    if (!err && p->geoid)
        err = lift(p, stays ? p->from : NULL, rows, n, stride, d);
    if (!err && p->to && !stays)
        err = hm_geod_forward(p->to, rows, n, stride, d);
    from_metres(p, rows, n, stride);
    return err ? err : check_finite(rows, n, stride, d);
}

static void carry_chunk(void *arg, size_t chunk)
{
    const struct job *j = arg;
    size_t first = chunk * CHUNK, n = j->n - first < CHUNK ? j->n - first : CHUNK;
    carry_rows(j->plan, j->rows + first * j->stride, n, j->stride, &j->failed[chunk]);
}

/* All rows, on threads; of several failures the first in the order of the rows is told. */
static enum hm_err carry_all(const struct plan *p, double *rows, size_t n, size_t stride,
                             int threads, struct hm_diag *d)
{
    if (n <= CHUNK)
        return carry_rows(p, rows, n, stride, d);
    size_t chunks = (n + CHUNK - 1) / CHUNK;
    struct job j = {p, rows, n, stride, hm_alloc0(chunks, sizeof *j.failed)};
    enum hm_err err = HM_OK;
    if (!j.failed)
        return hm_fail_memory(d);
    hm_thread_for(threads, chunks, carry_chunk, &j);
    for (size_t k = 0; k < chunks && !err; k++)
        if ((err = j.failed[k].err))
            *d = j.failed[k];
    free(j.failed);
    return err;
}

/* Longitudes of one line or mesh run on across the antimeridian, so that it stays in one piece. */
static void run_on(const struct plan *p, double *rows, size_t n, size_t stride)
{
    if (!p->known || p->target.kind != HM_CRS_LONLAT)
        return;
    for (size_t i = 1; i < n; i++)
        rows[i * stride] += 360 * round((rows[0] - rows[i * stride]) / 360);
}

void georef_extend(struct extent *e, const double *rows, size_t n, size_t stride)
{
    if (!e || n == 0)
        return;
    if (!e->any) {
        *e = (struct extent){true, rows[0], rows[0], rows[1], rows[1]};
    }
    for (size_t i = 0; i < n; i++) {
        double lon = rows[i * stride], lat = rows[i * stride + 1];
        lon += 360 * round(((e->west + e->east) / 2 - lon) / 360);
        e->west = fmin(e->west, lon);
        e->east = fmax(e->east, lon);
        e->south = fmin(e->south, lat);
        e->north = fmax(e->north, lat);
    }
}

static enum hm_err carry_points(struct hm_reader *r, const struct hm_header *h, struct hm_writer *w,
                                const struct plan *plan, int threads, struct extent *extent,
                                struct hm_diag *d)
{
    struct hm_batch b = {0};
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_batch_read(&b, r, h, d))) {
        err = carry_all(plan, b.rows, b.n, h->nfields, threads, d);
        georef_extend(err ? NULL : extent, b.rows, b.n, h->nfields);
        if (!err)
            err = hm_writer_points(w, b.rows, b.n, d);
    }
    hm_batch_free(&b);
    return err;
}

static enum hm_err carry_lines(struct hm_reader *r, struct hm_writer *w, const struct plan *plan,
                               int threads, struct extent *extent, struct hm_diag *d)
{
    struct hm_line line;
    enum hm_err err;
    while (!(err = hm_reader_line(r, &line, d))) {
        if ((err = carry_all(plan, line.xyz, line.n, 3, threads, d)))
            break;
        run_on(plan, line.xyz, line.n, 3);
        georef_extend(extent, line.xyz, line.n, 3);
        if ((err = hm_writer_line(w, &line, d)))
            break;
    }
    return err;
}

static enum hm_err carry_mesh(struct hm_reader *r, struct hm_writer *w, const struct plan *plan,
                              int threads, struct extent *extent, struct hm_diag *d)
{
    _Static_assert(offsetof(struct hm_node, z) == 2 * sizeof(double) &&
                       sizeof(struct hm_node) % sizeof(double) == 0,
                   "a node is a row that begins with x, y, z");
    enum { STRIDE = sizeof(struct hm_node) / sizeof(double) };
    struct hm_mesh m = {0};
    enum hm_err err = hm_reader_mesh(r, &m, d);
    double *rows = m.nnodes > 0 ? &m.node->x : NULL;
    if (!err)
        err = carry_all(plan, rows, m.nnodes, STRIDE, threads, d);
    if (!err) {
        run_on(plan, rows, m.nnodes, STRIDE);
        georef_extend(extent, rows, m.nnodes, STRIDE);
        err = hm_writer_mesh(w, &m, d);
    }
    hm_mesh_free(&m);
    return err;
}

enum hm_err georef_carry(struct hm_reader *r, const struct hm_header *h, struct hm_writer *w,
                         const struct plan *plan, int threads, struct extent *extent,
                         struct hm_diag *d)
{
    enum hm_err err = hm_writer_begin(w, h, d);
    if (err)
        return err;
    err = h->kind == HM_POINTS  ? carry_points(r, h, w, plan, threads, extent, d)
          : h->kind == HM_LINES ? carry_lines(r, w, plan, threads, extent, d)
                                : carry_mesh(r, w, plan, threads, extent, d);
    if (err == HM_END)
        err = HM_OK;
    return err ? err : hm_writer_end(w, d);
}
