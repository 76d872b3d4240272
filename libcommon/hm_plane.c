#include "hm_plane.h"

#include "hm_pred.h"

#include <math.h>

double hm_plane_foot(const double *p, const double *a, const double *b)
{
    double ux = b[0] - a[0], uy = b[1] - a[1];
    double length2 = ux * ux + uy * uy;
    double t = length2 > 0 ? ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / length2 : 0;
    return fmin(fmax(t, 0), 1);
}

double hm_plane_distance(const double *p, const double *a, const double *b)
{
    double t = hm_plane_foot(p, a, b);
    return hypot(a[0] + t * (b[0] - a[0]) - p[0], a[1] + t * (b[1] - a[1]) - p[1]);
}

double hm_plane_gap(const double *a, const double *b, const double *c, const double *d,
                    double middle[2])
{
    const double *end[4][3] = {{a, c, d}, {b, c, d}, {c, a, b}, {d, a, b}};
    double least = INFINITY;
    if (hm_plane_meet(a, b, c, d))
        return 0;
    for (int i = 0; i < 4; i++) { /* the nearest place to one is an end of the other */
        const double *p = end[i][0], *from = end[i][1], *to = end[i][2];
        double distance = hm_plane_distance(p, from, to), t = hm_plane_foot(p, from, to);
        if (distance >= least)
            continue;
        least = distance;
        for (int k = 0; k < 2; k++)
            middle[k] = (p[k] + (from[k] + t * (to[k] - from[k]))) / 2;
    }
    return least;
}

/* Do the intervals of two segments of one line have something in common, in coordinate k? */
static bool intervals_meet(const double *a, const double *b, const double *c, const double *d,
                           int k)
{
    return fmin(a[k], b[k]) <= fmax(c[k], d[k]) && fmin(c[k], d[k]) <= fmax(a[k], b[k]);
}

bool hm_plane_meet(const double *a, const double *b, const double *c, const double *d)
{
    if (!intervals_meet(a, b, c, d, 0) || !intervals_meet(a, b, c, d, 1))
        return false;
    int ab_c = hm_pred_orient(a, b, c), ab_d = hm_pred_orient(a, b, d);
    int cd_a = hm_pred_orient(c, d, a), cd_b = hm_pred_orient(c, d, b);
    /* signs, not products: a sign may be any int */
    return !((ab_c > 0 && ab_d > 0) || (ab_c < 0 && ab_d < 0) || (cd_a > 0 && cd_b > 0) ||
             (cd_a < 0 && cd_b < 0));
}

bool hm_plane_holds(const double *p, const double *a, const double *b)
{
    return intervals_meet(p, p, a, b, 0) && intervals_meet(p, p, a, b, 1) &&
           hm_pred_orient(a, b, p) == 0;
}

bool hm_plane_meet_at(const double *a, const double *b, const double *c, const double *d,
                      double place[2])
{
    if (!hm_plane_meet(a, b, c, d))
        return false;
    const double *end[4][3] = {{c, a, b}, {d, a, b}, {a, c, d}, {b, c, d}};
    for (int i = 0; i < 4; i++) { /* where one touches the other its end is exact */
        const double *p = end[i][0], *from = end[i][1], *to = end[i][2];
        if (hm_plane_holds(p, from, to)) {
            place[0] = p[0];
            place[1] = p[1];
            return true;
        }
    }
    double t = hm_plane_meeting(a, b, c, d);
    for (int k = 0; k < 2; k++)
        place[k] = a[k] + t * (b[k] - a[k]);
    return true;
}

bool hm_plane_cross(const double *a, const double *b, const double *c, const double *d)
{
    int ab_c = hm_pred_orient(a, b, c), ab_d = hm_pred_orient(a, b, d);
    if (!((ab_c > 0 && ab_d < 0) || (ab_c < 0 && ab_d > 0)))
        return false;
    int cd_a = hm_pred_orient(c, d, a), cd_b = hm_pred_orient(c, d, b);
    return (cd_a > 0 && cd_b < 0) || (cd_a < 0 && cd_b > 0);
}

enum hm_ray hm_plane_ray(const double *p, const double *a, const double *b)
{
    double x = p[0], y = p[1];
    if ((a[1] > y && b[1] > y) || (a[1] < y && b[1] < y))
        return HM_RAY_MISSES;
    if (a[1] == y && b[1] == y) {
        bool on = (a[0] <= x && x <= b[0]) || (b[0] <= x && x <= a[0]);
        return on ? HM_RAY_ON : HM_RAY_MISSES;
    }
    int side = hm_pred_orient(a, b, p);
    if (side == 0)
        return HM_RAY_ON;
    /* p is left of it going up, right of it going down */
    bool up = a[1] <= y && b[1] > y, down = b[1] <= y && a[1] > y;
    return (up && side > 0) || (down && side < 0) ? HM_RAY_CROSSES : HM_RAY_MISSES;
}

double hm_plane_meeting(const double *a, const double *b, const double *c, const double *d)
{
    int cd_a = hm_pred_orient(c, d, a), cd_b = hm_pred_orient(c, d, b);
    if (cd_a == 0 && cd_b == 0)
        return hm_plane_distance(a, c, d) == 0
                   ? 0
                   : fmin(hm_plane_foot(c, a, b), hm_plane_foot(d, a, b));
    if (cd_a == 0)
        return 0;
    if (cd_b == 0)
        return 1;
    double from = fabs(hm_area2(c, d, a)), to = fabs(hm_area2(c, d, b));
    return from + to > 0 ? from / (from + to) : 0;
}

double hm_plane_angle(const double *at, const double *a, const double *b)
{
    double dot = (a[0] - at[0]) * (b[0] - at[0]) + (a[1] - at[1]) * (b[1] - at[1]);
    return fabs(atan2(hm_area2(at, a, b), dot)) * 180 / acos(-1);
}

static bool is_before(const double *a, const double *b)
{
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

/* Barycentric weights, as areas that are never negative. What is added up are differences to the
 * height of the heaviest corner: a level triangle gives just its level. */
double hm_plane_height(const double *a, const double *b, const double *c, const double z[3],
                       const double *p)
{
    const double *corner[3] = {a, b, c};
    double weight[3], whole = 0, sum = 0;
    int first = is_before(b, a) ? 1 : 0;
    first = is_before(c, corner[first]) ? 2 : first;
    int order[3] = {first, (first + 1) % 3, (first + 2) % 3}, base = first;
    for (int i = 0; i < 3; i++) {
        int k = order[i];
        if (corner[k][0] == p[0] && corner[k][1] == p[1])
            return z[k];
        weight[k] = fabs(hm_area2(corner[(k + 1) % 3], corner[(k + 2) % 3], p));
        whole += weight[k];
        base = weight[k] > weight[base] ? k : base;
    }
    for (int i = 0; i < 3; i++)
        sum += (whole > 0 ? weight[order[i]] : 1) * (z[order[i]] - z[base]);
    return z[base] + sum / (whole > 0 ? whole : 3); /* 3: too small for doubles */
}
