/* hm_facefit_fill: notches in a cut that was moved onto its loop. */
#include "hm_elem.h"
#include "hm_facefit.h"
#include "hm_meshedges.h"
#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>

/* How far the middle of a new edge may lie outside the loop, as a part of its length. */
static const double most_outside = 0.05;

static bool is_in_or_near(const double *a, const double *b, int32_t surface,
                          const struct hm_face *faces, size_t n)
{
    const double u[2] = {b[0] - a[0], b[1] - a[1]};
    for (int k = 1; k < 4; k++) { /* to the right of a–b is outside */
        const double p[2] = {a[0] + u[0] * k / 4 - most_outside * u[1],
                             a[1] + u[1] * k / 4 + most_outside * u[0]};
        if (!hm_face_is_inside(p, surface, faces, n))
            return false;
    }
    return true;
}

/* Is the triangle p, q, r, beyond the border at r, one that may be added? */
static bool fits(const struct hm_mesh *m, const struct hm_mesh_loops *loops, const int32_t node[3],
                 double least_angle)
{
    const double *p = hm_mesh_xy(m, node[0]), *q = hm_mesh_xy(m, node[1]),
                 *r = hm_mesh_xy(m, node[2]);
    if (hm_pred_orient(p, q, r) <= 0)
        return false;
    if (fmin(hm_plane_angle(p, q, r), fmin(hm_plane_angle(q, r, p), hm_plane_angle(r, p, q))) <
        least_angle)
        return false;
    for (size_t i = 0; i < loops->start[loops->nloops]; i++) {
        int32_t v = loops->node[i];
        const double *x = hm_mesh_xy(m, v);
        if (v != node[0] && v != node[1] && v != node[2] && hm_pred_orient(p, q, x) >= 0 &&
            hm_pred_orient(q, r, x) >= 0 && hm_pred_orient(r, p, x) >= 0)
            return false;
    }
    return true;
}

/* One notch a loop and pass: the loops change with it. */
static enum hm_err fill_one(struct hm_mesh *m, int32_t surface, const struct hm_face *faces,
                            size_t n, double least_angle, int64_t *filled, struct hm_diag *d)
{
    struct hm_mesh_loops loops;
    enum hm_err err = hm_mesh_boundary(m, &loops, d);
    for (size_t k = 0; !err && k < loops.nloops; k++) {
        size_t start = loops.start[k], length = loops.start[k + 1] - start;
        for (size_t i = 0; !err && i < length && length > 3; i++) {
            const int32_t node[3] = {loops.node[start + i], loops.node[start + (i + 2) % length],
                                     loops.node[start + (i + 1) % length]};
            if (!fits(m, &loops, node, least_angle) ||
                !is_in_or_near(hm_mesh_xy(m, node[0]), hm_mesh_xy(m, node[1]), surface, faces, n))
                continue;
            struct hm_elem e = {{node[0], node[1], node[2], -1}, surface};
            err = hm_mesh_add_elem(m, e, d);
            ++*filled;
            break;
        }
    }
    hm_mesh_loops_free(&loops);
    return err;
}

enum hm_err hm_facefit_fill(struct hm_mesh *m, int32_t surface, const struct hm_face *faces,
                            size_t n, double least_angle, int64_t *filled, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    int64_t before = -1;
    *filled = 0;
    while (!err && *filled > before) {
        before = *filled;
        err = fill_one(m, surface, faces, n, least_angle, filled, d);
    }
    return err;
}
