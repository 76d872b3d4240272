/* hm_terrain: see hm_terrain.h. */
#include "hm_terrain.h"
#include "hm_bilinear.h"
#include "hm_median.h"
#include "hm_role.h"
#include "hm_tin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hm_terrain {
    const struct hm_grid *grid;
    size_t ngrids;
    struct hm_tin tin; /* without triangulation: no measurement */
    double gap;
};

/* --- building --- */

/* Places with a height, as x, y, z. */
struct places {
    double *xyz;
    size_t n, cap;
    int64_t without_z;
};

static enum hm_err add_place(struct places *p, const double *xyz, struct hm_diag *d)
{
    if (!isfinite(xyz[2])) {
        p->without_z++;
        return HM_OK;
    }
    if (fabs(xyz[2]) > HM_TERRAIN_HIGHEST)
        return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1], "a height of %g m", xyz[2]);
    if (!hm_grow(&p->xyz, &p->cap, 3 * (p->n + 1), sizeof *p->xyz))
        return hm_fail_memory(d);
    memcpy(p->xyz + 3 * p->n++, xyz, 3 * sizeof *xyz);
    return HM_OK;
}

static enum hm_err add_measurements(struct places *p, const struct hm_inputs *in, struct hm_diag *d)
{
    size_t n = 0;
    for (size_t k = 0; k < in->npoints; k++)
        n += in->points[k].n;
    enum hm_err err = hm_grow(&p->xyz, &p->cap, 3 * n, sizeof *p->xyz) ? HM_OK : hm_fail_memory(d);
    for (size_t k = 0; k < in->npoints; k++)
        for (size_t i = 0; !err && i < in->points[k].n; i++)
            err = add_place(p, in->points[k].v + i * in->points[k].stride, d);
    return err;
}

static enum hm_err add_lines_and_meshes(struct places *p, const struct hm_inputs *in,
                                        struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < in->nlines; k++)
        for (size_t i = 0; i < in->lines[k].n; i++) {
            const struct hm_line *line = &in->lines[k].line[i];
            bool tells = hm_role_of(line->attrs) == HM_ROLE_BREAKLINE;
            for (size_t j = 0; !err && tells && j < line->n; j++)
                err = add_place(p, line->xyz + 3 * j, d);
        }
    for (size_t k = 0; k < in->nmeshes; k++)
        for (size_t i = 0; !err && i < in->mesh[k].nnodes; i++)
            err = add_place(p, &in->mesh[k].node[i].x, d);
    return err;
}

static enum hm_err check_grids(const struct hm_inputs *in, struct hm_diag *d)
{
    for (size_t k = 0; k < in->ngrids; k++) {
        const struct hm_grid *g = &in->grid[k];
        const struct hm_lattice *l = &g->header.lattice;
        for (int64_t i = 0; i < l->nx * l->ny; i++) {
            double z = g->v[(size_t)i * g->bands];
            if (fabs(z) > HM_TERRAIN_HIGHEST)
                return hm_fail_at(d, HM_EGEOM, l->x0 + (double)(i % l->nx) * l->dx,
                                  l->y0 + (double)(i / l->nx) * l->dy, "a height of %g m", z);
        }
    }
    return HM_OK;
}

static enum hm_err build(struct hm_terrain *t, struct places *p, const struct hm_inputs *in,
                         int threads, struct hm_terrain_counts *counts, struct hm_diag *d)
{
    enum hm_err err = check_grids(in, d);
    if (!err)
        err = add_measurements(p, in, d);
    bool measured = p->n > 0;
    *counts = (struct hm_terrain_counts){.without_z = p->without_z};
    if (!err && !measured && in->ngrids == 0)
        err = add_lines_and_meshes(p, in, d);
    if (!err && p->n > 0)
        err = hm_tin_build(&t->tin, p->xyz, p->n, threads, d);
    if (!err && measured)
        counts->duplicates = (int64_t)hm_tri_duplicates(t->tin.tri);
    return err;
}

enum hm_err hm_terrain_build(struct hm_terrain **t, const struct hm_inputs *in, double gap,
                             int threads, struct hm_terrain_counts *counts, struct hm_diag *d)
{
    struct places p = {0};
    *t = hm_alloc0(1, sizeof **t);
    if (!*t)
        return hm_fail_memory(d);
    **t = (struct hm_terrain){.grid = in->grid, .ngrids = in->ngrids, .gap = gap};
    enum hm_err err = build(*t, &p, in, threads, counts, d);
    free(p.xyz);
    if (err) {
        hm_terrain_free(*t);
        *t = NULL;
    }
    return err;
}

void hm_terrain_free(struct hm_terrain *t)
{
    if (!t)
        return;
    hm_tin_free(&t->tin);
    free(t);
}

/* --- one grid --- */

static double distance2(const double *a, double x, double y)
{
    return (a[0] - x) * (a[0] - x) + (a[1] - y) * (a[1] - y);
}

static double node_z(const struct hm_grid *g, int64_t i, int64_t j)
{
    const struct hm_lattice *l = &g->header.lattice;
    return g->v[(size_t)(j * l->nx + i) * g->bands];
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

/* --- all together --- */

static double tin_z(const struct hm_terrain *t, double x, double y, int32_t *hint)
{
    int32_t tri = t->tin.tri ? hm_tri_locate(t->tin.tri, x, y, hint) : HM_TRI_NONE;
    if (tri == HM_TRI_NONE || hm_tin_is_gap(&t->tin, tri, t->gap))
        return NAN;
    return hm_tin_height(&t->tin, tri, x, y);
}

double hm_terrain_z(const struct hm_terrain *t, double x, double y, int32_t *hint)
{
    double z = NAN;
    for (size_t k = 0; k < t->ngrids && !isfinite(z); k++)
        z = hm_bilinear(&t->grid[k], 0, x, y);
    return isfinite(z) ? z : tin_z(t, x, y, hint);
}

double hm_terrain_z_nearest(const struct hm_terrain *t, double x, double y, int32_t *hint)
{
    double z = hm_terrain_z(t, x, y, hint), best2 = INFINITY, dist2;
    if (isfinite(z))
        return z;
    for (size_t k = 0; k < t->ngrids; k++) {
        double here = grid_nearest(&t->grid[k], x, y, &dist2);
        if (dist2 < best2) {
            best2 = dist2;
            z = here;
        }
    }
    if (t->tin.tri) {
        double here = hm_tin_nearest(&t->tin, x, y, hint, &dist2);
        z = dist2 < best2 ? here : z;
    }
    return z;
}

/* --- gaps --- */

enum hm_err hm_terrain_spacing(const struct hm_terrain *t, double *spacing, struct hm_diag *d)
{
    enum { SAMPLE = 100000 };
    const struct hm_tri *tri = t->tin.tri;
    *spacing = 0;
    if (!tri)
        return HM_OK;
    int32_t edges = 3 * hm_tri_triangles(tri), every = edges / SAMPLE + 1;
    double *length2 = hm_alloc((size_t)(edges / every) + 1, sizeof *length2);
    size_t n = 0;
    if (!length2)
        return hm_fail_memory(d);
    for (int32_t e = 0; e < edges; e += every)
        if (hm_tri_is_solid(tri, e / 3)) {
            const double *to = hm_tri_xy(tri, hm_tri_dest(tri, e));
            length2[n++] = distance2(hm_tri_xy(tri, hm_tri_org(tri, e)), to[0], to[1]);
        }
    *spacing = sqrt(hm_median(length2, n));
    free(length2);
    return HM_OK;
}

bool hm_terrain_is_gap(const struct hm_terrain *t, double x, double y, double gap, int32_t *hint)
{
    for (size_t k = 0; k < t->ngrids; k++)
        if (isfinite(hm_bilinear(&t->grid[k], 0, x, y)))
            return false;
    int32_t tri = t->tin.tri ? hm_tri_locate(t->tin.tri, x, y, hint) : HM_TRI_NONE;
    return tri == HM_TRI_NONE || hm_tin_is_gap(&t->tin, tri, gap);
}

enum hm_err hm_terrain_measurements(const struct hm_terrain *t, double **xyz, size_t *n,
                                    struct hm_diag *d)
{
    int32_t hint = 0;
    *n = t->tin.tri ? (size_t)hm_tri_vertices(t->tin.tri) : 0;
    *xyz = hm_alloc(*n, 3 * sizeof **xyz);
    if (!*xyz)
        return hm_fail_memory(d);
    for (size_t i = 0; i < *n; i++) {
        const double *xy = hm_tri_xy(t->tin.tri, (int32_t)i);
        double z = t->ngrids > 0 ? hm_terrain_z(t, xy[0], xy[1], &hint) : NAN;
        memcpy(*xyz + 3 * i, (double[3]){xy[0], xy[1], isfinite(z) ? z : t->tin.z[i]},
               3 * sizeof **xyz);
    }
    return HM_OK;
}
