/* hm_sizes: see hm_sizes.h. */
#include "hm_sizes.h"
#include "hm_bilinear.h"

#include <math.h>

double hm_sizes_equilateral(double length)
{
    return sqrt(3) / 4 * length * length;
}

/* --- the grid --- */

static double *size_at(const struct hm_grid *g, size_t band, int64_t i, int64_t j)
{
    return g->v + (size_t)(j * g->header.lattice.nx + i) * g->bands + band;
}

static enum hm_err check(const struct hm_grid *g, size_t band, struct hm_diag *d)
{
    const struct hm_lattice *l = &g->header.lattice;
    for (int64_t j = 0; j < l->ny; j++)
        for (int64_t i = 0; i < l->nx; i++) {
            double size = *size_at(g, band, i, j);
            if (!isnan(size) && !(size > 0))
                return hm_fail_at(d, HM_EARG, l->x0 + (double)i * l->dx, l->y0 + (double)j * l->dy,
                                  "%g is not an edge length", size);
        }
    return HM_OK;
}

static void lower(double *size, double than)
{
    if (than < *size || isnan(*size))
        *size = than;
}

/* Four sweeps, one from each corner, each node from the three before it, carry every size on to all
 * others along the ways of a chess king, which are 8 % longer than straight ones at most. */
static void spread(struct hm_grid *g, size_t band, double growth)
{
    const struct hm_lattice *l = &g->header.lattice;
    const double dx = growth * fabs(l->dx), dy = growth * fabs(l->dy), both = hypot(dx, dy);
    for (int sweep = 0; sweep < 4; sweep++) {
        int64_t di = sweep & 1 ? -1 : 1, dj = sweep & 2 ? -1 : 1;
        for (int64_t j = dj > 0 ? 0 : l->ny - 1; j >= 0 && j < l->ny; j += dj)
            for (int64_t i = di > 0 ? 0 : l->nx - 1; i >= 0 && i < l->nx; i += di) {
                double *here = size_at(g, band, i, j);
                bool behind = i - di >= 0 && i - di < l->nx, below = j - dj >= 0 && j - dj < l->ny;
                if (behind)
                    lower(here, *size_at(g, band, i - di, j) + dx);
                if (below)
                    lower(here, *size_at(g, band, i, j - dj) + dy);
                if (behind && below)
                    lower(here, *size_at(g, band, i - di, j - dj) + both);
            }
    }
}

enum hm_err hm_sizes_limit(struct hm_grid *grid, size_t band, double growth, struct hm_diag *d)
{
    enum hm_err err = check(grid, band, d);
    if (!err)
        spread(grid, band, growth);
    return err;
}

/* --- areas --- */

double hm_sizes_area(void *sizes, double x, double y, int32_t region)
{
    const struct hm_sizes *s = sizes;
    double area = s->dom->zone[region - 1].max_area;
    area = area > 0 ? area : s->max_area;
    if (!s->grid)
        return area;
    double here = hm_sizes_equilateral(hm_bilinear(s->grid, s->band, x, y));
    return here < area || (area == 0 && here > 0) ? here : area;
}

bool hm_sizes_are_equal(const struct hm_sizes *s)
{
    for (size_t k = 0; k < s->dom->nzones; k++)
        if (s->dom->zone[k].max_area > 0)
            return false;
    return !s->grid;
}

/* Cells of the grid, by the sizes at their lower left nodes. */
static double nodes_of_grid(const struct hm_sizes *s)
{
    const struct hm_lattice *l = &s->grid->header.lattice;
    double nodes = 0;
    int32_t hint = HM_TRI_NONE;
    for (int64_t j = 0; j < l->ny; j++)
        for (int64_t i = 0; i < l->nx; i++) {
            double x = l->x0 + (double)i * l->dx, y = l->y0 + (double)j * l->dy;
            double size = *size_at(s->grid, s->band, i, j);
            int32_t tri = hm_tri_locate(s->dom->tri, x, y, &hint);
            if (size > 0 && tri != HM_TRI_NONE && hm_domain_is_inside(s->dom, tri))
                nodes += 0.75 * fabs(l->dx * l->dy) / hm_sizes_equilateral(size);
        }
    return nodes;
}

/* A node for each two triangles, which have two thirds of their maximum area or less; and one for
 * each longest edge of a fixed one. */
double hm_sizes_nodes(const struct hm_sizes *s)
{
    const struct hm_domain *dom = s->dom;
    const struct hm_sizes general = {.dom = dom, .max_area = s->max_area};
    double nodes = s->grid ? nodes_of_grid(s) : 0;
    double edge = s->max_edge > 0 ? s->max_edge : INFINITY, inner = hm_sizes_equilateral(edge);
    for (int32_t tri = 0; tri < hm_tri_triangles(dom->tri); tri++) {
        double area = hm_domain_area(dom, tri);
        double most =
            area > 0 ? hm_sizes_area((void *)&general, 0, 0, hm_tri_region(dom->tri, tri)) : 0;
        nodes += area > 0 ? 0.75 * area / fmin(most > 0 ? most : INFINITY, inner) : 0;
    }
    for (size_t k = 0; k < dom->nedges; k++)
        nodes +=
            sqrt(hm_node_distance2(&dom->node[dom->edge[k].a], &dom->node[dom->edge[k].b])) / edge;
    return nodes;
}
