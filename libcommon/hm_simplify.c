#include "hm_simplify.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NOTHING = -1 };

/* Vertices of all lines, one after the other. */
struct vertex {
    const double *xyz;
    int64_t before, behind; /* those that are left; NOTHING at the end of an open line */
    int64_t line;
    int64_t next_in_cell;
    int32_t version; /* counts the changes of its neighbours */
    bool gone;
};

struct offer { /* to take a vertex out */
    double cost;
    int64_t vertex;
    int32_t version;
};

struct work {
    const struct hm_lines *lines;
    double tolerance;
    struct vertex *vertex;
    size_t n;
    size_t *start; /* a line: its first vertex */
    size_t *left;  /* a line: vertices left */
    struct offer *heap;
    size_t noffers, cap;
    int64_t *cell; /* buckets over the extent: first vertex in each */
    size_t nx, ny;
    double x0, y0, size;
};

/* --- heap of offers, the cheapest on top --- */

static bool cheaper(const struct offer *a, const struct offer *b)
{
    return a->cost < b->cost || (a->cost == b->cost && a->vertex < b->vertex);
}

static enum hm_err push(struct work *w, struct offer o, struct hm_diag *d)
{
    if (!hm_grow(&w->heap, &w->cap, w->noffers + 1, sizeof *w->heap))
        return hm_fail_memory(d);
    size_t k = w->noffers++;
    while (k > 0 && cheaper(&o, &w->heap[(k - 1) / 2])) {
        w->heap[k] = w->heap[(k - 1) / 2];
        k = (k - 1) / 2;
    }
    w->heap[k] = o;
    return HM_OK;
}

static struct offer pop(struct work *w)
{
    struct offer top = w->heap[0], last = w->heap[--w->noffers];
    size_t k = 0;
    for (size_t child; (child = 2 * k + 1) < w->noffers; k = child) {
        if (child + 1 < w->noffers && cheaper(&w->heap[child + 1], &w->heap[child]))
            child++;
        if (!cheaper(&w->heap[child], &last))
            break;
        w->heap[k] = w->heap[child];
    }
    w->heap[k] = last;
    return top;
}

/* --- buckets of vertices --- */

static size_t cell_along(double v, double v0, double size, size_t count)
{
    double c = floor((v - v0) / size);
    return c <= 0 ? 0 : c >= (double)count ? count - 1 : (size_t)c;
}

static enum hm_err make_cells(struct work *w, struct hm_diag *d)
{
    double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
    for (size_t k = 0; k < w->n; k++)
        for (int x = 0; x < 2; x++) {
            lo[x] = fmin(lo[x], w->vertex[k].xyz[x]);
            hi[x] = fmax(hi[x], w->vertex[k].xyz[x]);
        }
    double wide = hi[0] - lo[0], high = hi[1] - lo[1];
    w->x0 = lo[0];
    w->y0 = lo[1];
    w->size = fmax(sqrt(wide * high / (double)w->n), fmax(wide, high) / (double)w->n);
    if (!(w->size > 0))
        w->size = 1;
    w->nx = (size_t)(wide / w->size) + 1;
    w->ny = (size_t)(high / w->size) + 1;
    w->cell = hm_alloc(w->nx * w->ny, sizeof *w->cell);
    if (!w->cell)
        return hm_fail_memory(d);
    for (size_t k = 0; k < w->nx * w->ny; k++)
        w->cell[k] = NOTHING;
    for (size_t k = w->n; k-- > 0;) {
        const double *p = w->vertex[k].xyz;
        int64_t *first = &w->cell[cell_along(p[1], w->y0, w->size, w->ny) * w->nx +
                                  cell_along(p[0], w->x0, w->size, w->nx)];
        w->vertex[k].next_in_cell = *first;
        *first = (int64_t)k;
    }
    return HM_OK;
}

/* In the triangle or on its border; its corners a and c do not count, b does. */
static bool is_in_triangle(const double *p, const double *a, const double *b, const double *c)
{
    if (hm_plane_same(p, a) || hm_plane_same(p, c))
        return false;
    int x = hm_pred_orient(a, b, p), y = hm_pred_orient(b, c, p), z = hm_pred_orient(c, a, p);
    bool inside = (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
    if (!inside || x || y || z)
        return inside;
    /* all on one line */
    return p[0] >= fmin(a[0], fmin(b[0], c[0])) && p[0] <= fmax(a[0], fmax(b[0], c[0])) &&
           p[1] >= fmin(a[1], fmin(b[1], c[1])) && p[1] <= fmax(a[1], fmax(b[1], c[1]));
}

/* Is another vertex in the triangle of vertex v and its neighbours? */
static bool is_blocked(const struct work *w, int64_t v)
{
    const struct vertex *here = &w->vertex[v];
    const double *a = w->vertex[here->before].xyz, *b = here->xyz;
    const double *c = w->vertex[here->behind].xyz;
    size_t i0 = cell_along(fmin(a[0], fmin(b[0], c[0])), w->x0, w->size, w->nx);
    size_t i1 = cell_along(fmax(a[0], fmax(b[0], c[0])), w->x0, w->size, w->nx);
    size_t j0 = cell_along(fmin(a[1], fmin(b[1], c[1])), w->y0, w->size, w->ny);
    size_t j1 = cell_along(fmax(a[1], fmax(b[1], c[1])), w->y0, w->size, w->ny);
    for (size_t j = j0; j <= j1; j++)
        for (size_t i = i0; i <= i1; i++)
            for (int64_t k = w->cell[j * w->nx + i]; k != NOTHING; k = w->vertex[k].next_in_cell)
                if (k != v && !w->vertex[k].gone && is_in_triangle(w->vertex[k].xyz, a, b, c))
                    return true;
    return false;
}

/* --- cost --- */

/* Largest distance from the vertices that the line had between a and c to the piece a–c. */
static double cost_of(const struct work *w, int64_t a, int64_t c)
{
    size_t line = (size_t)w->vertex[a].line, n = w->lines->line[line].n, start = w->start[line];
    double most = 0;
    for (size_t k = ((size_t)a - start + 1) % n; k != (size_t)c - start; k = (k + 1) % n) {
        double away =
            hm_plane_distance(w->vertex[start + k].xyz, w->vertex[a].xyz, w->vertex[c].xyz);
        most = away > most ? away : most;
    }
    return most;
}

/* Offer vertex v, when it may go at all. */
static enum hm_err offer(struct work *w, int64_t v, struct hm_diag *d)
{
    const struct vertex *here = &w->vertex[v];
    if (here->before == NOTHING || here->behind == NOTHING || here->before == here->behind)
        return HM_OK;
    double cost = cost_of(w, here->before, here->behind);
    if (cost > w->tolerance)
        return HM_OK;
    return push(w, (struct offer){cost, v, here->version}, d);
}

static enum hm_err take_out(struct work *w, int64_t v, struct hm_diag *d)
{
    struct vertex *here = &w->vertex[v];
    int64_t a = here->before, c = here->behind;
    here->gone = true;
    w->left[here->line]--;
    w->vertex[a].behind = c;
    w->vertex[c].before = a;
    w->vertex[a].version++;
    w->vertex[c].version++;
    enum hm_err err = offer(w, a, d);
    return err ? err : offer(w, c, d);
}

/* --- the lines in and out --- */

static enum hm_err load(struct work *w, struct hm_diag *d)
{
    for (size_t k = 0; k < w->lines->n; k++)
        w->n += w->lines->line[k].n;
    w->vertex = hm_alloc(w->n, sizeof *w->vertex);
    w->start = hm_alloc(w->lines->n, sizeof *w->start);
    w->left = hm_alloc(w->lines->n, sizeof *w->left);
    if (!w->vertex || !w->start || !w->left)
        return hm_fail_memory(d);
    size_t at = 0;
    for (size_t l = 0; l < w->lines->n; l++) {
        const struct hm_line *line = &w->lines->line[l];
        w->start[l] = at;
        w->left[l] = line->n;
        int64_t first = (int64_t)at, last = (int64_t)(at + line->n) - 1;
        for (size_t k = 0; k < line->n; k++, at++)
            w->vertex[at] = (struct vertex){.xyz = line->xyz + 3 * k,
                                            .before = (int64_t)at - 1,
                                            .behind = (int64_t)at + 1,
                                            .line = (int64_t)l};
        if (line->n > 0) {
            w->vertex[first].before = line->closed ? last : NOTHING;
            w->vertex[last].behind = line->closed ? first : NOTHING;
        }
    }
    return HM_OK;
}

static void store(struct work *w, struct hm_lines *lines)
{
    for (size_t l = 0; l < lines->n; l++) {
        struct hm_line *line = &lines->line[l];
        size_t n = 0;
        for (size_t k = 0; k < line->n; k++)
            if (!w->vertex[w->start[l] + k].gone)
                memmove(line->xyz + 3 * n++, line->xyz + 3 * k, 3 * sizeof *line->xyz);
        line->n = n;
    }
}

static enum hm_err run(struct work *w, struct hm_diag *d)
{
    enum { FEWEST_CLOSED = 3 };
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < w->n && !err; k++)
        err = offer(w, (int64_t)k, d);
    while (w->noffers > 0 && !err) {
        struct offer o = pop(w);
        const struct vertex *v = &w->vertex[o.vertex];
        if (v->gone || v->version != o.version)
            continue;
        if (w->lines->line[v->line].closed && w->left[v->line] <= FEWEST_CLOSED)
            continue;
        if (!is_blocked(w, o.vertex))
            err = take_out(w, o.vertex, d);
    }
    return err;
}

enum hm_err hm_simplify(struct hm_lines *lines, double tolerance, struct hm_diag *d)
{
    struct work w = {.lines = lines, .tolerance = tolerance};
    enum hm_err err = load(&w, d);
    if (!err && w.n > 0) {
        err = make_cells(&w, d);
        if (!err)
            err = run(&w, d);
        if (!err)
            store(&w, lines);
    }
    free(w.vertex);
    free(w.start);
    free(w.left);
    free(w.heap);
    free(w.cell);
    return err;
}
