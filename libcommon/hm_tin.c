/* hm_tin: see hm_tin.h. */
#include "hm_tin.h"

#include "hm_plane.h"

#include <math.h>
#include <stdlib.h>

/* --- heights of vertices --- */

struct shared {
    int32_t vertex;
    double z;
};

static int by_vertex_and_z(const void *a, const void *b)
{
    const struct shared *s = a, *t = b;
    if (s->vertex != t->vertex)
        return s->vertex < t->vertex ? -1 : 1;
    return (s->z > t->z) - (s->z < t->z);
}

/* Means of the heights that share a vertex; sorted first, so that their order does not matter. */
static void take_means(double *z, struct shared *s, size_t n)
{
    qsort(s, n, sizeof *s, by_vertex_and_z);
    for (size_t k = 0, end; k < n; k = end) {
        double sum = 0;
        for (end = k; end < n && s[end].vertex == s[k].vertex; end++)
            sum += s[end].z;
        z[s[k].vertex] = sum / (double)(end - k);
    }
}

static enum hm_err take_heights(struct hm_tin *tin, const double *xyz, size_t n, struct hm_diag *d)
{
    const struct hm_tri *t = tin->tri;
    size_t vertices = (size_t)hm_tri_vertices(t), nshared = 0;
    bool *is_shared = hm_alloc0(vertices, sizeof *is_shared);
    /* each merged point brings itself and at most one first point */
    struct shared *s = hm_alloc(2 * hm_tri_duplicates(t), sizeof *s);
    tin->z = hm_alloc(vertices, sizeof *tin->z);
    enum hm_err err = is_shared && s && tin->z ? HM_OK : hm_fail_memory(d);
    for (size_t k = 0; k < n && !err; k++) {
        int32_t v = hm_tri_of_input(t, k);
        if (hm_tri_input(t, v) == (int64_t)k)
            tin->z[v] = xyz[3 * k + 2];
        else
            is_shared[v] = true;
    }
    for (size_t k = 0; k < n && !err; k++)
        if (is_shared[hm_tri_of_input(t, k)])
            s[nshared++] = (struct shared){hm_tri_of_input(t, k), xyz[3 * k + 2]};
    if (!err && nshared > 0)
        take_means(tin->z, s, nshared);
    free(is_shared);
    free(s);
    return err;
}

enum hm_err hm_tin_build(struct hm_tin *tin, const double *xyz, size_t n, int threads,
                         struct hm_diag *d)
{
    *tin = (struct hm_tin){0};
    enum hm_err err = hm_tri_build(&tin->tri, xyz, n, 3, threads, d);
    if (!err)
        err = take_heights(tin, xyz, n, d);
    if (err)
        hm_tin_free(tin);
    return err;
}

void hm_tin_free(struct hm_tin *tin)
{
    hm_tri_free(tin->tri);
    free(tin->z);
    *tin = (struct hm_tin){0};
}

/* --- heights between --- */

double hm_tin_height(const struct hm_tin *tin, int32_t tri, double x, double y)
{
    const double *p[3], at[2] = {x, y};
    double z[3];
    for (int k = 0; k < 3; k++) {
        int32_t v = hm_tri_org(tin->tri, 3 * tri + k);
        p[k] = hm_tri_xy(tin->tri, v);
        z[k] = tin->z[v];
    }
    return hm_plane_height(p[0], p[1], p[2], z, at);
}

static double distance2(const double *a, double x, double y)
{
    return (a[0] - x) * (a[0] - x) + (a[1] - y) * (a[1] - y);
}

bool hm_tin_is_gap(const struct hm_tin *tin, int32_t tri, double gap)
{
    for (int32_t e = 3 * tri; e < 3 * tri + 3 && gap > 0; e++) {
        const double *a = hm_tri_xy(tin->tri, hm_tri_org(tin->tri, e));
        const double *b = hm_tri_xy(tin->tri, hm_tri_dest(tin->tri, e));
        if (distance2(a, b[0], b[1]) > gap * gap)
            return true;
    }
    return false;
}

/* In a Delaunay triangulation every vertex but the nearest has a neighbour that is nearer still, so
 * going downhill by distance ends at the right one. */
double hm_tin_nearest(const struct hm_tin *tin, double x, double y, int32_t *hint, double *dist2)
{
    const struct hm_tri *t = tin->tri;
    int32_t tri = hm_tri_locate(t, x, y, hint);
    if (tri == HM_TRI_NONE)
        tri = *hint >= 0 && *hint < hm_tri_triangles(t) ? *hint : 0;
    int32_t v = HM_TRI_INFINITY;
    for (int k = 0; k < 3 && v == HM_TRI_INFINITY; k++)
        v = hm_tri_org(t, 3 * tri + k);
    *dist2 = distance2(hm_tri_xy(t, v), x, y);
    for (bool nearer = true; nearer;) {
        nearer = false;
        int32_t first = hm_tri_edge_from(t, v), e = first;
        do {
            int32_t w = hm_tri_dest(t, e);
            double far2 = w == HM_TRI_INFINITY ? INFINITY : distance2(hm_tri_xy(t, w), x, y);
            if (far2 < *dist2) {
                *dist2 = far2;
                v = w;
                nearer = true;
                break;
            }
            e = hm_tri_twin(t, hm_tri_prev(e));
        } while (e != first);
    }
    return tin->z[v];
}
