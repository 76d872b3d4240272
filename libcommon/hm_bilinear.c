#include "hm_bilinear.h"

#include <math.h>

/* Between two values; an end that does not count may be nodata. */
static double between(double a, double b, double part)
{
    return part == 0 ? a : part == 1 ? b : a + part * (b - a);
}

double hm_bilinear(const struct hm_grid *g, size_t band, double x, double y)
{
    const struct hm_lattice *l = &g->header.lattice;
    double u = (x - l->x0) / l->dx, v = (y - l->y0) / l->dy;
    if (!(u >= 0 && v >= 0 && u <= (double)(l->nx - 1) && v <= (double)(l->ny - 1)))
        return NAN;
    int64_t i = (int64_t)u, j = (int64_t)v;
    int64_t across = i + 1 < l->nx, along = j + 1 < l->ny ? l->nx : 0;
    const double *at = g->v + (size_t)(j * l->nx + i) * g->bands + band;
    const double *up = at + (size_t)along * g->bands;
    size_t right = (size_t)across * g->bands;
    double fu = u - (double)i, fv = v - (double)j;
    return between(between(at[0], at[right], fu), between(up[0], up[right], fu), fv);
}
