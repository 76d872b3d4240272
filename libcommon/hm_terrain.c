/* hm_terrain: see hm_terrain.h. */
#include "hm_terrain.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

struct source {
    const struct hm_tri *tri; /* a TIN … */
    const double *z;          /* by vertex number */
    double gap;
    struct hm_tri *own_tri; /* what the terrain itself has to free */
    double *own_z;
    const struct hm_grid *grid; /* … or a grid */
};

struct hm_terrain {
    struct source *source;
    size_t n, cap;
};

enum hm_err hm_terrain_new(struct hm_terrain **t, struct hm_diag *d)
{
    *t = hm_alloc0(1, sizeof **t);
    return *t ? HM_OK : hm_fail_memory(d);
}

void hm_terrain_free(struct hm_terrain *t)
{
    if (!t)
        return;
    for (size_t k = 0; k < t->n; k++) {
        hm_tri_free(t->source[k].own_tri);
        free(t->source[k].own_z);
    }
    free(t->source);
    free(t);
}

bool hm_terrain_is_empty(const struct hm_terrain *t)
{
    return t->n == 0;
}

static enum hm_err add(struct hm_terrain *t, struct source s, struct hm_diag *d)
{
    if (!hm_grow(&t->source, &t->cap, t->n + 1, sizeof *t->source))
        return hm_fail_memory(d);
    t->source[t->n++] = s;
    return HM_OK;
}

enum hm_err hm_terrain_add_tri(struct hm_terrain *t, const struct hm_tri *tri, const double *z,
                               double gap, struct hm_diag *d)
{
    return add(t, (struct source){.tri = tri, .z = z, .gap = gap}, d);
}

enum hm_err hm_terrain_add_grid(struct hm_terrain *t, const struct hm_grid *g, struct hm_diag *d)
{
    return add(t, (struct source){.grid = g}, d);
}

/* The rows of p that have a height, as xyz triples; *n of them. */
static double *with_height(const struct hm_points *p, size_t *n)
{
    double *xyz = hm_alloc(p->n, 3 * sizeof *xyz);
    *n = 0;
    for (size_t i = 0; xyz && i < p->n; i++) {
        const double *row = p->v + i * p->stride;
        if (!isfinite(row[2]))
            continue;
        for (int k = 0; k < 3; k++)
            xyz[3 * *n + (size_t)k] = row[k];
        ++*n;
    }
    return xyz;
}

enum hm_err hm_terrain_add_points(struct hm_terrain *t, const struct hm_points *p, double gap,
                                  int threads, struct hm_diag *d)
{
    size_t n;
    double *xyz = with_height(p, &n);
    if (!xyz)
        return hm_fail_memory(d);
    if (n == 0) {
        free(xyz);
        return HM_OK;
    }
    struct source s = {.gap = gap};
    enum hm_err err = hm_tri_build(&s.own_tri, xyz, n, 3, threads, d);
    if (!err) {
        int32_t vertices = hm_tri_vertices(s.own_tri);
        s.own_z = hm_alloc((size_t)vertices, sizeof *s.own_z);
        if (s.own_z) {
            for (int32_t v = 0; v < vertices; v++)
                s.own_z[v] = xyz[3 * hm_tri_input(s.own_tri, v) + 2];
            s.tri = s.own_tri;
            s.z = s.own_z;
            err = add(t, s, d);
        } else
            err = hm_fail_memory(d);
        if (err) {
            hm_tri_free(s.own_tri);
            free(s.own_z);
        }
    }
    free(xyz);
    return err;
}

/* --- one TIN --- */

static double distance2(const double *a, double x, double y)
{
    return (a[0] - x) * (a[0] - x) + (a[1] - y) * (a[1] - y);
}

/* Linear in the triangle that holds (x, y); NaN outside, and in triangles longer than the gap. */
static double tin_z(const struct source *s, double x, double y, int32_t *hint)
{
    int32_t tri = hm_tri_locate(s->tri, x, y, hint);
    if (tri == HM_TRI_NONE)
        return NAN;
    const double *p[3];
    double z[3], weight[3], at[2] = {x, y};
    for (int k = 0; k < 3; k++) {
        int32_t v = hm_tri_org(s->tri, 3 * tri + k);
        p[k] = hm_tri_xy(s->tri, v);
        z[k] = s->z[v];
    }
    for (int k = 0; k < 3; k++) {
        const double *a = p[k], *b = p[(k + 1) % 3];
        if (s->gap > 0 && distance2(a, b[0], b[1]) > s->gap * s->gap)
            return NAN;
        if (a[0] == x && a[1] == y) /* a measurement keeps its height to the last bit */
            return z[k];
        weight[(k + 2) % 3] = hm_area2(a, b, at);
    }
    double whole = weight[0] + weight[1] + weight[2];
    if (!(whole > 0)) /* an area too small for doubles */
        return (z[0] + z[1] + z[2]) / 3;
    /* differences to z[0]: a level triangle gives just its level */
    return z[0] + (weight[1] * (z[1] - z[0]) + weight[2] * (z[2] - z[0])) / whole;
}

/* Height of the vertex nearest to (x, y). In a Delaunay triangulation every vertex but the nearest
 * has a neighbour that is nearer still, so going downhill by distance ends at the right one. */
static double tin_nearest(const struct source *s, double x, double y, int32_t *hint, double *dist2)
{
    int32_t tri = hm_tri_locate(s->tri, x, y, hint);
    if (tri == HM_TRI_NONE)
        tri = hint && *hint >= 0 && *hint < hm_tri_triangles(s->tri) ? *hint : 0;
    int32_t v = HM_TRI_INFINITY;
    for (int k = 0; k < 3 && v == HM_TRI_INFINITY; k++)
        v = hm_tri_org(s->tri, 3 * tri + k);
    *dist2 = distance2(hm_tri_xy(s->tri, v), x, y);
    for (bool nearer = true; nearer;) {
        nearer = false;
        int32_t first = hm_tri_edge_from(s->tri, v), e = first;
        do {
            int32_t w = hm_tri_dest(s->tri, e);
            double far2 = w == HM_TRI_INFINITY ? INFINITY : distance2(hm_tri_xy(s->tri, w), x, y);
            if (far2 < *dist2) {
                *dist2 = far2;
                v = w;
                nearer = true;
                break;
            }
            e = hm_tri_twin(s->tri, hm_tri_prev(e));
        } while (e != first);
    }
    return s->z[v];
}

/* --- one grid --- */

static double node_z(const struct hm_grid *g, int64_t i, int64_t j)
{
    const struct hm_lattice *l = &g->header.lattice;
    return g->v[(size_t)(j * l->nx + i) * g->bands];
}

/* Between two heights; an end that does not count may be nodata. */
static double between(double a, double b, double part)
{
    return part == 0 ? a : part == 1 ? b : a + part * (b - a);
}

/* Bilinear in the cell that holds (x, y); NaN outside and beside nodata. */
static double grid_z(const struct hm_grid *g, double x, double y)
{
    const struct hm_lattice *l = &g->header.lattice;
    double u = (x - l->x0) / l->dx, v = (y - l->y0) / l->dy;
    if (!(u >= 0 && v >= 0 && u <= (double)(l->nx - 1) && v <= (double)(l->ny - 1)))
        return NAN;
    int64_t i = (int64_t)u, j = (int64_t)v;
    int64_t i1 = i + 1 < l->nx ? i + 1 : i, j1 = j + 1 < l->ny ? j + 1 : j;
    double fu = u - (double)i, fv = v - (double)j;
    return between(between(node_z(g, i, j), node_z(g, i1, j), fu),
                   between(node_z(g, i, j1), node_z(g, i1, j1), fu), fv);
}

/* Height of the node with data nearest to (x, y): rings of nodes around it, outward, until no
 * farther ring can hold a nearer one. */
static double grid_nearest(const struct hm_grid *g, double x, double y, double *dist2)
{
    const struct hm_lattice *l = &g->header.lattice;
    double u = fmin(fmax((x - l->x0) / l->dx, 0), (double)(l->nx - 1));
    double v = fmin(fmax((y - l->y0) / l->dy, 0), (double)(l->ny - 1));
    int64_t ci = (int64_t)round(u), cj = (int64_t)round(v);
    double step = fmin(fabs(l->dx), fabs(l->dy)), best = NAN;
    *dist2 = INFINITY;
    for (int64_t r = 0; r <= (l->nx > l->ny ? l->nx : l->ny); r++) {
        /* outside the lattice distances only grow; a ring's nodes are r - 1/2 steps off at least */
        double near = fmax((double)r - 0.5, 0) * step;
        if (*dist2 < near * near)
            break;
        for (int64_t j = cj - r; j <= cj + r; j++) {
            if (j < 0 || j >= l->ny)
                continue;
            int64_t stride = j == cj - r || j == cj + r || r == 0 ? 1 : 2 * r;
            for (int64_t i = ci - r; i <= ci + r; i += stride) {
                if (i < 0 || i >= l->nx || !isfinite(node_z(g, i, j)))
                    continue;
                double at[2] = {l->x0 + (double)i * l->dx, l->y0 + (double)j * l->dy};
                double far2 = distance2(at, x, y);
                if (far2 < *dist2) {
                    *dist2 = far2;
                    best = node_z(g, i, j);
                }
            }
        }
    }
    return best;
}

/* --- all sources --- */

/* The hint is one for the first TIN; the others start their search anywhere. */
static int32_t *hint_of(const struct hm_terrain *t, size_t k, int32_t *hint, int32_t *other)
{
    for (size_t j = 0; j < k; j++)
        if (t->source[j].tri) {
            *other = HM_TRI_NONE;
            return other;
        }
    return hint;
}

double hm_terrain_z(const struct hm_terrain *t, double x, double y, int32_t *hint)
{
    double z = NAN;
    for (size_t k = 0; k < t->n && !isfinite(z); k++) {
        const struct source *s = &t->source[k];
        int32_t other;
        z = s->grid ? grid_z(s->grid, x, y) : tin_z(s, x, y, hint_of(t, k, hint, &other));
    }
    return z;
}

double hm_terrain_z_nearest(const struct hm_terrain *t, double x, double y, int32_t *hint)
{
    double z = hm_terrain_z(t, x, y, hint), best2 = INFINITY;
    if (isfinite(z))
        return z;
    for (size_t k = 0; k < t->n; k++) {
        const struct source *s = &t->source[k];
        int32_t other;
        double dist2, here = s->grid ? grid_nearest(s->grid, x, y, &dist2)
                                     : tin_nearest(s, x, y, hint_of(t, k, hint, &other), &dist2);
        if (dist2 < best2) {
            best2 = dist2;
            z = here;
        }
    }
    return z;
}
