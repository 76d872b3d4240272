/* hm_tri_check: is the triangulation what it claims to be? Slow and simple, for tests. */
#include "hm_tri_topology.h"

static enum hm_err bad(const struct hm_tri *t, int32_t e, struct hm_diag *d, const char *what)
{
    int32_t v = t->half[e].org >= 0 ? t->half[e].org : hm_tri_dest_of(t, e);
    if (v < 0 || v >= t->vertices)
        return hm_fail(d, HM_EGEOM, "edge %d: %s", (int)e, what);
    const double *p = hm_tri_at(t, v);
    return hm_fail_at(d, HM_EGEOM, p[0], p[1], "edge %d: %s", (int)e, what);
}

static enum hm_err check_edge(const struct hm_tri *t, int32_t e, struct hm_diag *d)
{
    int32_t twin = t->half[e].twin, a = t->half[e].org, b = hm_tri_dest_of(t, e);
    if (a < HM_TRI_INFINITY || a >= t->vertices || twin < 0 || twin >= 3 * t->triangles)
        return bad(t, e, d, "number out of range");
    if (t->half[twin].twin != e || t->half[twin].org != b || hm_tri_dest_of(t, twin) != a)
        return bad(t, e, d, "its twin is another edge");
    if (hm_tri_marks_of(t, e) != hm_tri_marks_of(t, twin))
        return bad(t, e, d, "its two sides are marked differently");
    if (a >= 0 && !hm_tri_is_used(t, a))
        return bad(t, e, d, "it starts at a removed vertex");
    return HM_OK;
}

/* A solid triangle turns left; next to a ghost, the hull does not turn right. */
static enum hm_err check_shape(const struct hm_tri *t, int32_t tri, struct hm_diag *d)
{
    int32_t e = 3 * tri;
    if (!hm_tri_is_ghost(t, tri)) {
        const double *a = hm_tri_at(t, t->half[e].org), *b = hm_tri_at(t, t->half[e + 1].org);
        if (hm_pred_orient_fast(a, b, hm_tri_at(t, t->half[e + 2].org)) <= 0)
            return bad(t, e, d, "its triangle does not turn left");
        return HM_OK;
    }
    while (hm_tri_apex_of(t, e) != HM_TRI_INFINITY)
        e++;
    int32_t next = t->half[hm_tri_prev(e)].twin; /* e: w → v; the ghost of the hull edge w → u */
    int32_t w = t->half[e].org, u = hm_tri_apex_of(t, next), v = hm_tri_dest_of(t, e);
    if (t->half[e].org < 0 || v < 0 || u < 0 || t->half[next].org != w)
        return bad(t, e, d, "the hull is not closed");
    if (hm_pred_orient_fast(hm_tri_at(t, v), hm_tri_at(t, w), hm_tri_at(t, u)) < 0)
        return bad(t, e, d, "the hull is not convex");
    return HM_OK;
}

static enum hm_err check_vertices(const struct hm_tri *t, struct hm_diag *d)
{
    int64_t used = 0, slots = 0;
    for (int32_t v = 0; v < t->vertices; v++) {
        if (!hm_tri_is_used(t, v))
            continue;
        int32_t e = hm_tri_edge_of(t, v);
        used++;
        if (e < 0 || e >= 3 * t->triangles || t->half[e].org != v)
            return hm_fail(d, HM_EGEOM, "the edge of vertex %d starts elsewhere", (int)v);
    }
    for (int32_t tri = 0; tri < t->triangles; tri++)
        slots += t->half[3 * tri].org != HM_TRI_FREE;
    if (slots != 2 * used - 2) /* Euler, the infinite vertex included */
        return hm_fail(d, HM_EGEOM, "%lld triangles on %lld vertices", (long long)slots,
                       (long long)used);
    return HM_OK;
}

enum hm_err hm_tri_check_topology(const struct hm_tri *t, struct hm_diag *d)
{
    for (int32_t tri = 0; tri < t->triangles; tri++) {
        if (t->half[3 * tri].org == HM_TRI_FREE)
            continue;
        enum hm_err err = HM_OK;
        for (int32_t e = 3 * tri; !err && e < 3 * tri + 3; e++)
            err = check_edge(t, e, d);
        if (!err)
            err = check_shape(t, tri, d);
        if (err)
            return err;
    }
    return check_vertices(t, d);
}

enum hm_err hm_tri_check_delaunay(const struct hm_tri *t, struct hm_diag *d)
{
    for (int32_t tri = 0; tri < t->triangles; tri++) {
        if (!hm_tri_is_solid(t, tri))
            continue;
        for (int32_t e = 3 * tri; e < 3 * tri + 3; e++) {
            int32_t beyond = hm_tri_apex_of(t, t->half[e].twin);
            if (beyond == HM_TRI_INFINITY || hm_tri_marks_of(t, e))
                continue;
            int32_t a = t->half[e].org, b = hm_tri_dest_of(t, e), c = hm_tri_apex_of(t, e);
            if (hm_pred_incircle_unique_fast(hm_tri_at(t, a), hm_tri_at(t, b), hm_tri_at(t, c),
                                             hm_tri_at(t, beyond)) > 0)
                return bad(t, e, d, "not locally Delaunay");
        }
    }
    return HM_OK;
}
