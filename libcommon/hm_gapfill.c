#include "hm_gapfill.h"

#include "hm_tri.h"

#include <math.h>
#include <stdlib.h>

/* Only nodes with data beside nodes without are triangulated: a Delaunay triangle over an empty
 * node has no others for corners (the circle through its corners reaches a neighbour of each of
 * them). Coordinates are whole numbers, so all geometry here is exact.
 *
 * Most empty nodes of a dense cloud are single: all four neighbours in the row and in the column
 * have data. These four lie on one empty circle around the node, so Delaunay allows either
 * diagonal; such a node gets the mean of both, and no triangulation. Nor is it a node without data
 * to those around: a circle around another empty node that reaches a single one has one of its four
 * neighbours inside.
 */
enum mark { NOTHING, CORNER, SINGLE };

struct fill {
    double *z;
    size_t nx, ny;
    double gap2;
    uint8_t *mark;  /* what a node is, once there is an empty one */
    double *corner; /* i, j of the nodes triangulated */
    size_t n;
};

struct node {
    int64_t i, j;
};

static double *at(const struct fill *f, struct node p)
{
    return &f->z[(size_t)p.j * f->nx + (size_t)p.i];
}

/* Fill the node k when it is single. */
static bool fill_single(const struct fill *f, size_t k, size_t i, size_t j)
{
    if (i == 0 || j == 0 || i + 1 == f->nx || j + 1 == f->ny || f->gap2 < 2)
        return false;
    double mean = (f->z[k - 1] + f->z[k + 1]) / 4 + (f->z[k - f->nx] + f->z[k + f->nx]) / 4;
    if (isnan(mean))
        return false;
    f->z[k] = mean;
    f->mark[k] = SINGLE;
    return true;
}

/* Nodes with data around the empty node i, j are corners. */
static void mark_corners(struct fill *f, size_t i, size_t j)
{
    for (size_t b = j > 0 ? j - 1 : 0; b <= j + 1 && b < f->ny; b++)
        for (size_t a = i > 0 ? i - 1 : 0; a <= i + 1 && a < f->nx; a++) {
            size_t k = b * f->nx + a;
            if (isnan(f->z[k]) || f->mark[k] != NOTHING)
                continue;
            f->mark[k] = CORNER;
            f->n++;
        }
}

/* Fill the single nodes and mark what must be triangulated for the others. */
static enum hm_err visit_empty(struct fill *f, struct hm_diag *d)
{
    for (size_t j = 0; j < f->ny; j++)
        for (size_t i = 0; i < f->nx; i++) {
            size_t k = j * f->nx + i;
            if (!isnan(f->z[k]))
                continue;
            if (!f->mark && !(f->mark = hm_alloc0(f->nx * f->ny, sizeof *f->mark)))
                return hm_fail_memory(d);
            if (!fill_single(f, k, i, j))
                mark_corners(f, i, j);
        }
    return HM_OK;
}

static enum hm_err collect(struct fill *f, struct hm_diag *d)
{
    double *to = f->corner = hm_alloc(2 * f->n, sizeof *f->corner);
    if (!to)
        return hm_fail_memory(d);
    for (size_t j = 0; j < f->ny && f->n > 0; j++)
        for (size_t i = 0; i < f->nx; i++)
            if (f->mark[j * f->nx + i] == CORNER) {
                *to++ = (double)i;
                *to++ = (double)j;
            }
    return HM_OK;
}

static int64_t cross(struct node a, struct node b, struct node c)
{
    return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i);
}

static double length2(struct node a, struct node b)
{
    double di = (double)(b.i - a.i), dj = (double)(b.j - a.j);
    return di * di + dj * dj;
}

/* R = abc / 4A */
static bool is_gap(const struct fill *f, const struct node c[3])
{
    double a = length2(c[0], c[1]), b = length2(c[1], c[2]), e = length2(c[2], c[0]);
    double area2 = (double)cross(c[0], c[1], c[2]);
    return a > f->gap2 || b > f->gap2 || e > f->gap2 || a * b * e > 4 * area2 * area2 * f->gap2;
}

static bool before(struct node a, struct node b)
{
    return a.j < b.j || (a.j == b.j && a.i < b.i);
}

/* Height on the piece from a to b, the same from either side. */
static double on_edge(const struct fill *f, struct node a, struct node b, struct node p)
{
    if (before(b, a)) {
        struct node swap = a;
        a = b;
        b = swap;
    }
    double t = a.j == b.j ? (double)(p.i - a.i) / (double)(b.i - a.i)
                          : (double)(p.j - a.j) / (double)(b.j - a.j);
    return *at(f, a) + t * (*at(f, b) - *at(f, a));
}

/* Height at p in the triangle (counter-clockwise), NaN outside; c[0] is the first of its corners,
 * so that the numbers of the triangulation do not matter. */
static double height_in(const struct fill *f, const struct node c[3], struct node p)
{
    int64_t w[3];
    for (int k = 0; k < 3; k++) {
        w[k] = cross(c[(k + 1) % 3], c[(k + 2) % 3], p);
        if (w[k] < 0)
            return NAN;
    }
    for (int k = 0; k < 3; k++)
        if (w[k] == 0)
            return on_edge(f, c[(k + 1) % 3], c[(k + 2) % 3], p);
    double z0 = *at(f, c[0]);
    return z0 + ((double)w[1] * (*at(f, c[1]) - z0) + (double)w[2] * (*at(f, c[2]) - z0)) /
                    (double)(w[0] + w[1] + w[2]);
}

static int64_t least(int64_t a, int64_t b, int64_t c)
{
    int64_t m = a < b ? a : b;
    return m < c ? m : c;
}

static void fill_triangle(const struct fill *f, const struct node c[3])
{
    struct node low = {least(c[0].i, c[1].i, c[2].i), least(c[0].j, c[1].j, c[2].j)};
    struct node high = {-least(-c[0].i, -c[1].i, -c[2].i), -least(-c[0].j, -c[1].j, -c[2].j)};
    if ((high.i - low.i == 1 && high.j - low.j == 1) || is_gap(f, c))
        return;
    for (struct node p = {.j = low.j}; p.j <= high.j; p.j++)
        for (p.i = low.i; p.i <= high.i; p.i++)
            if (isnan(*at(f, p)))
                *at(f, p) = height_in(f, c, p);
}

static struct node node_of(const struct hm_tri *t, int32_t v)
{
    const double *xy = hm_tri_xy(t, v);
    return (struct node){(int64_t)xy[0], (int64_t)xy[1]};
}

static void fill_triangles(const struct fill *f, const struct hm_tri *t)
{
    for (int32_t k = 0; k < hm_tri_triangles(t); k++) {
        if (!hm_tri_is_solid(t, k))
            continue;
        struct node c[3] = {node_of(t, hm_tri_org(t, 3 * k)), node_of(t, hm_tri_dest(t, 3 * k)),
                            node_of(t, hm_tri_apex(t, 3 * k))};
        while (before(c[1], c[0]) || before(c[2], c[0])) {
            struct node first = c[0];
            c[0] = c[1];
            c[1] = c[2];
            c[2] = first;
        }
        fill_triangle(f, c);
    }
}

enum hm_err hm_gapfill(double *z, size_t nx, size_t ny, double gap, int threads, struct hm_diag *d)
{
    struct fill f = {.z = z, .nx = nx, .ny = ny, .gap2 = gap * gap};
    enum hm_err err = visit_empty(&f, d);
    if (!err)
        err = collect(&f, d);
    struct hm_tri *t = NULL;
    struct hm_diag flat = {0}; /* all on one line: there is no triangle to fill, and no failure */
    if (!err && f.n >= 3) {
        err = hm_tri_build(&t, f.corner, f.n, 2, threads, &flat);
        if (!err)
            fill_triangles(&f, t);
        else
            err = err == HM_EGEOM ? HM_OK : hm_fail(d, err, "%s", flat.text);
    }
    hm_tri_free(t);
    free(f.corner);
    free(f.mark);
    return err;
}
