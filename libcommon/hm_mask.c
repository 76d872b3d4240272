#include "hm_mask.h"

#include "hm_attr.h"
#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* First node of the row from place x on, in 0 .. nx. */
static int64_t first_from(const struct hm_lattice *l, double x)
{
    double i = ceil((x - l->x0) / l->dx);
    return i <= 0 ? 0 : i >= (double)l->nx ? l->nx : (int64_t)i;
}

/* Mark the nodes between x0 and x1, x0 included. */
static void mark(bool *row, const struct hm_lattice *l, double x0, double x1, bool value)
{
    int64_t from = first_from(l, l->dx > 0 ? x0 : x1), to = first_from(l, l->dx > 0 ? x1 : x0);
    for (int64_t i = from; i < to; i++)
        row[i] = value;
}

/* Mark the nodes within a ring, row by row, between pairs of its crossings with the row (even-odd
 * rule); a piece reaches from its lower end to just below its upper one. */
static enum hm_err fill_ring(bool *in, const struct hm_lattice *l, const struct hm_line *ring,
                             bool value, struct hm_diag *d)
{
    size_t pieces = hm_polyline_pieces(ring);
    double *x = hm_alloc(pieces, sizeof *x);
    if (!x)
        return hm_fail_memory(d);
    for (int64_t j = 0; j < l->ny; j++) {
        double y = l->y0 + (double)j * l->dy;
        size_t n = 0;
        for (size_t k = 0; k < pieces; k++) {
            const double *a = hm_polyline_from(ring, k), *b = hm_polyline_to(ring, k);
            if ((a[1] <= y) == (b[1] <= y))
                continue;
            const double *low = a[1] < b[1] ? a : b, *high = a[1] < b[1] ? b : a;
            x[n++] = low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
        }
        qsort(x, n, sizeof *x, by_value);
        for (size_t k = 0; k + 1 < n; k += 2)
            mark(in + j * l->nx, l, x[k], x[k + 1], value);
    }
    free(x);
    return HM_OK;
}

enum hm_err hm_mask(bool *in, const struct hm_lattice *l, const struct hm_lines *lines,
                    struct hm_diag *d)
{
    bool outlined = false;
    for (size_t k = 0; k < lines->n; k++) {
        const struct hm_line *line = &lines->line[k];
        if (!line->closed)
            return hm_fail_at(d, HM_EGEOM, line->n ? line->xyz[0] : 0, line->n ? line->xyz[1] : 0,
                              "line %zu of the mask is not closed", k + 1);
        outlined = outlined || !hm_attr_flag(line->attrs, "hole");
    }
    for (int64_t k = 0; k < l->nx * l->ny; k++)
        in[k] = !outlined;
    enum hm_err err = HM_OK;
    for (int hole = 0; hole < 2; hole++) /* holes last */
        for (size_t k = 0; k < lines->n && !err; k++)
            if (hm_attr_flag(lines->line[k].attrs, "hole") == (hole == 1))
                err = fill_ring(in, l, &lines->line[k], !hole, d);
    return err;
}
