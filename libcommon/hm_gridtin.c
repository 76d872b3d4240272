#include "hm_gridtin.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

/* Scan conversion. A row of the lattice crosses two edges of a triangle; the crossings are computed
 * from the edge alone, ends in lexicographic order, so both triangles beside it see the same number
 * and each node between belongs to exactly one of them (left end closed, right end open).
 * Coordinates are counted in cells from the first node.
 */
enum { CHUNK = 1 << 14 };

struct raster {
    const struct hm_tin *tin;
    const struct hm_tri *t; /* the tin's */
    const struct hm_anchor *a;
    struct hm_lattice l; /* the same nodes */
    double *z;
    double gap;
    bool *covered;  /* a triangle: neither ghost nor gap */
    size_t *in_gap; /* a chunk: nodes in gap triangles */
};

struct corner {
    double x, y;
};

static struct corner corner_at(const struct raster *r, int32_t v)
{
    const double *xy = hm_tri_xy(r->t, v);
    return (struct corner){(xy[0] - r->l.x0) / r->l.dx, (xy[1] - r->l.y0) / r->l.dy};
}

static bool before(const struct corner *a, const struct corner *b)
{
    return a->y < b->y || (a->y == b->y && a->x < b->x);
}

/* Where the row at y meets the edge from low to high (low->y <= y <= high->y, low->y < high->y). */
static struct corner crossing(const struct corner *low, const struct corner *high, double y)
{
    double t = (y - low->y) / (high->y - low->y);
    if (t >= 1)
        return *high;
    return (struct corner){low->x + t * (high->x - low->x), y};
}

/* Height at node (i, j) in a triangle. */
static double height(const struct raster *r, int32_t tri, int64_t i, int64_t j)
{
    return hm_tin_height(r->tin, tri, r->l.x0 + (double)i * r->l.dx, r->l.y0 + (double)j * r->l.dy);
}

/* The first integer >= v, kept within [0, count]. */
static int64_t first_from(double v, size_t count)
{
    double c = ceil(v);
    return c <= 0 ? 0 : c >= (double)count ? (int64_t)count : (int64_t)c;
}

static void sort_corners(struct corner c[3])
{
    for (int k = 0; k < 3; k++) {
        int m = k == 1 ? 1 : 0; /* compare 0-1, 1-2, 0-1 */
        if (before(&c[m + 1], &c[m])) {
            struct corner swap = c[m];
            c[m] = c[m + 1];
            c[m + 1] = swap;
        }
    }
}

/* Nodes of one row between two crossings of a triangle; the number of them. */
static size_t fill_span(const struct raster *r, int32_t tri, int64_t j, struct corner p,
                        struct corner q, bool write)
{
    if (q.x < p.x) {
        struct corner swap = p;
        p = q;
        q = swap;
    }
    int64_t i0 = first_from(p.x, r->a->nx), i1 = first_from(q.x, r->a->nx);
    double *row = r->z + (size_t)j * r->a->nx;
    for (int64_t i = i0; i < i1 && write; i++)
        row[i] = height(r, tri, i, j);
    return (size_t)(i1 - i0);
}

static size_t fill_triangle(const struct raster *r, int32_t tri, bool write)
{
    struct corner c[3] = {corner_at(r, hm_tri_org(r->t, 3 * tri)),
                          corner_at(r, hm_tri_dest(r->t, 3 * tri)),
                          corner_at(r, hm_tri_apex(r->t, 3 * tri))};
    sort_corners(c);
    int64_t j0 = first_from(c[0].y, r->a->ny), j1 = first_from(c[2].y, r->a->ny);
    size_t nodes = 0;
    for (int64_t j = j0; j < j1; j++) {
        double y = (double)j;
        struct corner p = crossing(&c[0], &c[2], y);
        struct corner q = y < c[1].y ? crossing(&c[0], &c[1], y) : crossing(&c[1], &c[2], y);
        nodes += fill_span(r, tri, j, p, q, write);
    }
    return nodes;
}

static void fill_chunk(void *arg, size_t chunk)
{
    const struct raster *r = arg;
    int32_t n = hm_tri_triangles(r->t), start = (int32_t)chunk * CHUNK;
    int32_t end = n - start > CHUNK ? start + CHUNK : n;
    for (int32_t tri = start; tri < end; tri++) {
        if (!hm_tri_is_solid(r->t, tri))
            continue;
        r->covered[tri] = !hm_tin_is_gap(r->tin, tri, r->gap);
        size_t nodes = fill_triangle(r, tri, r->covered[tri]);
        if (!r->covered[tri])
            r->in_gap[chunk] += nodes;
    }
}

/* Give node (i, j) on the border of a triangle its height, unless it has one; the number of nodes
 * set. */
static size_t set_on_edge(const struct raster *r, int32_t tri, int64_t i, int64_t j)
{
    double *node = &r->z[(size_t)j * r->a->nx + (size_t)i];
    if (!isnan(*node))
        return 0;
    *node = height(r, tri, i, j);
    return 1;
}

/* Nodes on an edge, both ends included: the half-open spans leave out some of those on the border
 * of what is covered. */
static size_t fill_edge(const struct raster *r, int32_t e)
{
    const double near = 1e-9; /* cells */
    struct corner p = corner_at(r, hm_tri_org(r->t, e)), q = corner_at(r, hm_tri_dest(r->t, e));
    if (before(&q, &p)) {
        struct corner swap = p;
        p = q;
        q = swap;
    }
    size_t set = 0;
    int64_t j0 = first_from(p.y - near, r->a->ny), j1 = first_from(q.y + near + 1, r->a->ny);
    for (int64_t j = j0; j < j1 && (double)j <= q.y + near; j++) {
        if (q.y - p.y > 2 * near) {
            struct corner c = crossing(&p, &q, fmax((double)j, p.y));
            double i = nearbyint(c.x);
            if (fabs(i - c.x) <= near && i >= 0 && i < (double)r->a->nx)
                set += set_on_edge(r, e / 3, (int64_t)i, j);
            continue;
        }
        int64_t i0 = first_from(p.x - near, r->a->nx);
        for (int64_t i = i0; i < (int64_t)r->a->nx && (double)i <= q.x + near; i++)
            set += set_on_edge(r, e / 3, i, j);
    }
    return set;
}

/* The edges of the covered area, one after the other: they are few. The nodes set there count for
 * *hull or, beside a gap, for *gap. */
static void fill_borders(const struct raster *r, size_t *hull, size_t *gap)
{
    for (int32_t tri = 0; tri < hm_tri_triangles(r->t); tri++) {
        if (!r->covered[tri])
            continue;
        for (int32_t e = 3 * tri; e < 3 * tri + 3; e++) {
            int32_t beyond = hm_tri_twin(r->t, e) / 3;
            if (!r->covered[beyond])
                *(hm_tri_is_solid(r->t, beyond) ? gap : hull) += fill_edge(r, e);
        }
    }
}

static void count_missing(const struct raster *r, size_t chunks, size_t set_in_gaps,
                          struct hm_gridtin_count *count)
{
    size_t missing = 0, gap = 0;
    for (size_t k = 0; k < r->a->nx * r->a->ny; k++)
        missing += isnan(r->z[k]) != 0;
    for (size_t c = 0; c < chunks; c++)
        gap += r->in_gap[c];
    gap = gap > set_in_gaps ? gap - set_in_gaps : 0;
    count->gap = gap < missing ? gap : missing;
    count->outside = missing - count->gap;
}

enum hm_err hm_gridtin(double *z, const struct hm_anchor *a, const struct hm_tin *tin, double gap,
                       int threads, struct hm_gridtin_count *count, struct hm_diag *d)
{
    struct raster r = {
        .tin = tin, .t = tin->tri, .a = a, .l = hm_anchor_lattice(a), .z = z, .gap = gap};
    size_t triangles = (size_t)hm_tri_triangles(r.t), chunks = triangles / CHUNK + 1;
    r.covered = hm_alloc0(triangles, sizeof *r.covered);
    r.in_gap = hm_alloc0(chunks, sizeof *r.in_gap);
    enum hm_err err = r.covered && r.in_gap ? HM_OK : hm_fail_memory(d);
    if (!err) {
        size_t on_hull = 0, on_gap = 0;
        for (size_t k = 0; k < a->nx * a->ny; k++)
            z[k] = NAN;
        hm_thread_for(threads, chunks, fill_chunk, &r);
        fill_borders(&r, &on_hull, &on_gap);
        count_missing(&r, chunks, on_gap, count);
    }
    free(r.covered);
    free(r.in_gap);
    return err;
}
