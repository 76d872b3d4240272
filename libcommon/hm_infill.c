#include "hm_infill.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>
#include <string.h>

/* A change must be worth so many degrees. */
static const double least_gain = 1;

enum { ROUNDS = 12, MOST_NEIGHBOURS = 16 };

struct infill {
    struct hm_tri *t;
    int32_t region;
    double goal;
    bool changed;
};

/* --- angles --- */

static double smallest_angle(const double *a, const double *b, const double *c)
{
    return fmin(hm_plane_angle(a, b, c), fmin(hm_plane_angle(b, c, a), hm_plane_angle(c, a, b)));
}

static bool is_inside(const struct infill *f, int32_t tri)
{
    return hm_tri_is_solid(f->t, tri) && hm_tri_region(f->t, tri) == f->region;
}

static void corners(const struct hm_tri *t, int32_t tri, const double *p[3])
{
    p[0] = hm_tri_xy(t, hm_tri_org(t, 3 * tri));
    p[1] = hm_tri_xy(t, hm_tri_dest(t, 3 * tri));
    p[2] = hm_tri_xy(t, hm_tri_apex(t, 3 * tri));
}

/* May the vertex be changed? */
static bool is_free(const struct infill *f, int32_t v)
{
    if (!hm_tri_is_used(f->t, v))
        return false;
    int32_t first = hm_tri_edge_from(f->t, v), e = first;
    do {
        if (!is_inside(f, e / 3) || hm_tri_marks(f->t, e))
            return false;
        e = hm_tri_twin(f->t, hm_tri_prev(e));
    } while (e != first);
    return true;
}

/* The smallest angle of the triangles around v, were it at p; negative when one would turn over. */
static double angle_around(const struct infill *f, int32_t v, const double *p)
{
    double least = 180;
    int32_t first = hm_tri_edge_from(f->t, v), e = first;
    do {
        const double *a = hm_tri_xy(f->t, hm_tri_dest(f->t, e));
        const double *b = hm_tri_xy(f->t, hm_tri_apex(f->t, e));
        if (hm_pred_orient(a, b, p) <= 0)
            return -1;
        least = fmin(least, smallest_angle(a, b, p));
        e = hm_tri_twin(f->t, hm_tri_prev(e));
    } while (e != first);
    return least;
}

/* --- moving a vertex --- */

/* The middle of the neighbours, and how far they are on average. */
static double middle_around(const struct infill *f, int32_t v, double middle[2])
{
    const double *p = hm_tri_xy(f->t, v);
    double far = 0, sum[2] = {0, 0};
    int n = 0;
    int32_t first = hm_tri_edge_from(f->t, v), e = first;
    do {
        const double *q = hm_tri_xy(f->t, hm_tri_dest(f->t, e));
        far += hypot(q[0] - p[0], q[1] - p[1]);
        sum[0] += q[0] - p[0];
        sum[1] += q[1] - p[1];
        n++;
        e = hm_tri_twin(f->t, hm_tri_prev(e));
    } while (e != first);
    middle[0] = p[0] + sum[0] / n;
    middle[1] = p[1] + sum[1] / n;
    return far / n;
}

/* The best of some places for v: where it is, the middle of the neighbours, and around what is best
 * so far, nearer and nearer. Returns the smallest angle there, with the triangles as they are now;
 * constrained Delaunay, which follows a move, has none smaller. */
static double find_place(const struct infill *f, int32_t v, double best[2])
{
    static const double way[8][2] = {{1, 0},  {0.7, 0.7},   {0, 1},  {-0.7, 0.7},
                                     {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}};
    double place[2], most = angle_around(f, v, hm_tri_xy(f->t, v));
    memcpy(best, hm_tri_xy(f->t, v), 2 * sizeof *best);
    double step = middle_around(f, v, place) / 2;
    for (int round = 0; round < 5; round++, step /= 2) {
        const double centre[2] = {best[0], best[1]};
        for (int k = 0; k < 9; k++) {
            if (k < 8) {
                place[0] = centre[0] + step * way[k][0];
                place[1] = centre[1] + step * way[k][1];
            } else if (round == 0) {
                middle_around(f, v, place);
            }
            double angle = angle_around(f, v, place);
            if (angle > most) {
                most = angle;
                memcpy(best, place, sizeof place);
            }
        }
    }
    return most;
}

static enum hm_err move(struct infill *f, int32_t v, struct hm_diag *d)
{
    double best[2], now = angle_around(f, v, hm_tri_xy(f->t, v));
    if (now >= f->goal || find_place(f, v, best) < now + least_gain)
        return HM_OK;
    f->changed = true;
    return hm_tri_move(f->t, v, best[0], best[1], d);
}

/* --- taking a vertex out --- */

/* The largest smallest angle that a triangulation of the polygon of n corners can have, which is
 * what is left there without the vertex: dynamic programming over its diagonals. */
static double best_polygon(const double *const p[], int n)
{
    double best[MOST_NEIGHBOURS][MOST_NEIGHBOURS];
    for (int i = 0; i + 1 < n; i++)
        best[i][i + 1] = 180;
    for (int span = 2; span < n; span++)
        for (int i = 0; i + span < n; i++) {
            int j = i + span;
            best[i][j] = -1;
            for (int k = i + 1; k < j; k++) {
                if (hm_pred_orient(p[i], p[k], p[j]) <= 0)
                    continue;
                double angle = fmin(best[i][k], best[k][j]);
                angle = fmin(angle, smallest_angle(p[i], p[k], p[j]));
                best[i][j] = fmax(best[i][j], angle);
            }
        }
    return best[0][n - 1];
}

static enum hm_err take_out(struct infill *f, int32_t v, bool *gone, struct hm_diag *d)
{
    const double *p[MOST_NEIGHBOURS];
    int n = 0;
    double now = angle_around(f, v, hm_tri_xy(f->t, v));
    *gone = false;
    if (now >= f->goal)
        return HM_OK;
    int32_t first = hm_tri_edge_from(f->t, v), e = first;
    do {
        if (n == MOST_NEIGHBOURS)
            return HM_OK;
        p[n++] = hm_tri_xy(f->t, hm_tri_dest(f->t, e));
        e = hm_tri_twin(f->t, hm_tri_prev(e));
    } while (e != first);
    if (best_polygon(p, n) < now + least_gain)
        return HM_OK;
    f->changed = *gone = true;
    return hm_tri_remove(f->t, v, d);
}

/* --- putting a vertex in --- */

/* Is there a triangle with these corners? */
static bool stands(const struct infill *f, const int32_t corner[3])
{
    int32_t e = hm_tri_edge_between(f->t, corner[0], corner[1]);
    return e != HM_TRI_NONE && hm_tri_apex(f->t, e) == corner[2];
}

/* Try a vertex at p, moved to the best place around: *place, and *angle the smallest angle there; 0
 * when the triangle does not go by that. The triangulation is as before. */
static enum hm_err try_vertex(struct infill *f, const int32_t triangle[3], const double *p,
                              double place[2], double *angle, struct hm_diag *d)
{
    int32_t v, hint = hm_tri_edge_from(f->t, triangle[0]) / 3;
    int32_t at = hm_tri_locate(f->t, p[0], p[1], &hint);
    *angle = 0;
    if (at == HM_TRI_NONE || !is_inside(f, at))
        return HM_OK;
    for (int32_t e = 3 * at; e < 3 * at + 3; e++)
        if (hm_pred_orient(hm_tri_xy(f->t, hm_tri_org(f->t, e)),
                           hm_tri_xy(f->t, hm_tri_dest(f->t, e)), p) <= 0)
            return HM_OK; /* on an edge, perhaps a constraint */
    enum hm_err err = hm_tri_insert(f->t, p[0], p[1], at, &v, d);
    if (err)
        return err;
    if (!stands(f, triangle))
        *angle = find_place(f, v, place);
    return hm_tri_remove(f->t, v, d);
}

/* Places that may mend a triangle: above the middle of its shortest edge, so that an angle of 40 or
 * 60 degrees is there (off-centres, Üngör 2004), its circumcentre, its centre. */
static void list_places(const struct hm_tri *t, int32_t tri, double place[4][2])
{
    const double *p[3];
    double least = INFINITY;
    int shortest = 0;
    corners(t, tri, p);
    for (int k = 0; k < 3; k++) {
        double length = hypot(p[(k + 1) % 3][0] - p[k][0], p[(k + 1) % 3][1] - p[k][1]);
        if (length < least) {
            least = length;
            shortest = k;
        }
    }
    const double *a = p[shortest], *b = p[(shortest + 1) % 3], *c = p[(shortest + 2) % 3];
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, w[2] = {c[0] - a[0], c[1] - a[1]};
    const double cross = u[0] * w[1] - u[1] * w[0];
    /* the circumcentre lies on the bisector of a–b, `far` times its length above it */
    double far = ((w[0] * w[0] + w[1] * w[1]) - (u[0] * w[0] + u[1] * w[1])) / (2 * cross);
    const double height[3] = {fmin(1.37, far), fmin(0.87, far), far};
    for (int k = 0; k < 3; k++) {
        place[k][0] = a[0] + u[0] / 2 - height[k] * u[1];
        place[k][1] = a[1] + u[1] / 2 + height[k] * u[0];
    }
    place[3][0] = a[0] + (u[0] + w[0]) / 3;
    place[3][1] = a[1] + (u[1] + w[1]) / 3;
}

/* A vertex at the best of these places, if one helps. */
static enum hm_err mend(struct infill *f, int32_t tri, struct hm_diag *d)
{
    const int32_t triangle[3] = {hm_tri_org(f->t, 3 * tri), hm_tri_dest(f->t, 3 * tri),
                                 hm_tri_apex(f->t, 3 * tri)};
    const double *p[3];
    corners(f->t, tri, p);
    double now = smallest_angle(p[0], p[1], p[2]), most = now + least_gain;
    double place[4][2], best[2] = {0, 0};
    bool found = false;
    if (now >= f->goal)
        return HM_OK;
    list_places(f->t, tri, place);
    for (int k = 0; k < 4; k++) {
        double angle, at[2];
        enum hm_err err = try_vertex(f, triangle, place[k], at, &angle, d);
        if (err)
            return err;
        if (angle <= most)
            continue;
        found = true;
        most = angle;
        memcpy(best, at, sizeof best);
    }
    if (!found)
        return HM_OK;
    int32_t v;
    f->changed = true;
    return hm_tri_insert(f->t, best[0], best[1], HM_TRI_NONE, &v, d);
}

enum hm_err hm_infill_improve(struct hm_tri *t, int32_t region, double angle, struct hm_diag *d)
{
    struct infill f = {.t = t, .region = region, .goal = angle, .changed = true};
    enum hm_err err = HM_OK;
    for (int round = 0; !err && f.changed && round < ROUNDS; round++) {
        f.changed = false;
        for (int32_t v = 0; !err && v < hm_tri_vertices(t); v++) {
            bool gone;
            if (!is_free(&f, v))
                continue;
            err = take_out(&f, v, &gone, d);
            if (!err && !gone)
                err = move(&f, v, d);
        }
        for (int32_t k = 0; !err && k < hm_tri_triangles(t); k++)
            if (is_inside(&f, k))
                err = mend(&f, k, d);
    }
    return err;
}
