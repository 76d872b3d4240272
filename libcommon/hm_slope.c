#include "hm_slope.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

struct stencil {
    const double *const *z; /* rows before, here, behind */
    size_t nx;
    double dx, dy;
    double middle_x, side_x; /* weights of the three differences along x, with sum 1 */
    double middle_y, side_y; /* and of those along y */
};

static struct stencil make_stencil(enum hm_slope_method method, const double *const z[3], size_t nx,
                                   double dx, double dy)
{
    struct stencil s = {.z = z, .nx = nx, .dx = dx, .dy = dy};
    double middle_x = 1, middle_y = 1, side_x = 1, side_y = 1;
    if (method == HM_SLOPE_OVER_DISTANCE) { /* 1/distance, times the distance to the corner */
        middle_x = hypot(dx, dy) / fabs(dx);
        middle_y = hypot(dx, dy) / fabs(dy);
    } else if (method == HM_SLOPE_HORN) {
        middle_x = middle_y = 2;
    } else if (method == HM_SLOPE_ZT) {
        side_x = side_y = 0;
    }
    s.middle_x = middle_x / (middle_x + 2 * side_x);
    s.side_x = side_x / (middle_x + 2 * side_x);
    s.middle_y = middle_y / (middle_y + 2 * side_y);
    s.side_y = side_y / (middle_y + 2 * side_y);
    return s;
}

/* z of the neighbour of node i in row k (0, 1, 2), or NaN */
static double at(const struct stencil *s, int k, size_t i, int di)
{
    if (!s->z[k] || (di < 0 && i == 0) || (di > 0 && i + 1 == s->nx))
        return NAN;
    return s->z[k][di < 0 ? i - 1 : di > 0 ? i + 1 : i];
}

/* Difference a step, across the middle where both sides are known, else to the one that is. */
static double difference(double before, double middle, double behind)
{
    if (!isnan(before) && !isnan(behind))
        return (behind - before) / 2;
    return isnan(behind) ? middle - before : behind - middle;
}

static double weighted(const double difference_of[3], double middle, double side)
{
    double sum = 0, weights = 0;
    for (int k = 0; k < 3; k++) {
        double w = k == 1 ? middle : side;
        if (w > 0 && !isnan(difference_of[k])) {
            sum += w * difference_of[k];
            weights += w;
        }
    }
    return weights > 0 ? sum / weights : NAN;
}

/* The general node: neighbours may be missing. */
static void careful(const struct stencil *s, size_t i, double *gx, double *gy)
{
    double along_x[3], along_y[3];
    for (int k = 0; k < 3; k++) {
        along_x[k] = difference(at(s, k, i, -1), at(s, k, i, 0), at(s, k, i, 1));
        along_y[k] = difference(at(s, 0, i, k - 1), at(s, 1, i, k - 1), at(s, 2, i, k - 1));
    }
    *gx = weighted(along_x, s->middle_x, s->side_x) / s->dx;
    *gy = weighted(along_y, s->middle_y, s->side_y) / s->dy;
}

/* Equation (1) with the weights of the method; NaN wherever one of the nine is. */
static void quick_row(const struct stencil *s, double *gx, double *gy)
{
    const double *a = s->z[0], *h = s->z[1], *b = s->z[2];
    double mx = s->middle_x / (2 * s->dx), sx = s->side_x / (2 * s->dx);
    double my = s->middle_y / (2 * s->dy), sy = s->side_y / (2 * s->dy);
    for (size_t i = 1; i + 1 < s->nx; i++) {
        double left = a[i - 1] + b[i - 1], right = a[i + 1] + b[i + 1];
        gx[i] = mx * (h[i + 1] - h[i - 1]) + sx * (right - left);
        double before = a[i - 1] + a[i + 1], behind = b[i - 1] + b[i + 1];
        gy[i] = my * (b[i] - a[i]) + sy * (behind - before);
    }
}

static void weighted_row(const struct stencil *s, double *gx, double *gy)
{
    bool quick = s->z[0] && s->z[2];
    if (quick)
        quick_row(s, gx, gy);
    for (size_t i = 0; i < s->nx; i++) {
        bool border = !quick || i == 0 || i + 1 == s->nx;
        if (!border && !isnan(gx[i] + gy[i] + s->z[1][i]))
            continue;
        if (!isnan(s->z[1][i]))
            careful(s, i, &gx[i], &gy[i]);
        if (isnan(s->z[1][i]) || isnan(gx[i]) || isnan(gy[i]))
            gx[i] = gy[i] = NAN;
    }
}

static double before_else_behind(double before, double middle, double behind)
{
    return isnan(before) ? behind - middle : middle - before;
}

static void simple_row(const struct stencil *s, double *gx, double *gy)
{
    for (size_t i = 0; i < s->nx; i++) {
        double z = s->z[1][i];
        gx[i] = before_else_behind(at(s, 1, i, -1), z, at(s, 1, i, 1)) / s->dx;
        gy[i] = before_else_behind(at(s, 0, i, 0), z, at(s, 2, i, 0)) / s->dy;
        if (isnan(gx[i]) || isnan(gy[i]))
            gx[i] = gy[i] = NAN;
    }
}

static void steepest_row(const struct stencil *s, double *gx, double *gy)
{
    for (size_t i = 0; i < s->nx; i++) {
        double most = -1;
        gx[i] = gy[i] = NAN;
        for (int k = 0; k < 3; k++)
            for (int di = -1; di <= 1; di++) {
                double x = di * s->dx, y = (k - 1) * s->dy, distance = hypot(x, y);
                double slope = (at(s, k, i, di) - s->z[1][i]) / distance;
                if (distance > 0 && fabs(slope) > most) {
                    most = fabs(slope);
                    gx[i] = slope * x / distance;
                    gy[i] = slope * y / distance;
                }
            }
    }
}

void hm_slope_gradient(enum hm_slope_method method, const double *const z[3], size_t nx, double dx,
                       double dy, double *gx, double *gy)
{
    struct stencil s = make_stencil(method, z, nx, dx, dy);
    if (method == HM_SLOPE_SIMPLE)
        simple_row(&s, gx, gy);
    else if (method == HM_SLOPE_STEEPEST)
        steepest_row(&s, gx, gy);
    else
        weighted_row(&s, gx, gy);
}

/* --- second derivatives --- */

/* The mixed derivative: the mean over the cells around that have all corners. */
static double mixed(const struct stencil *s, size_t i)
{
    double sum = 0, n = 0;
    for (int side = 0; side < 4; side++) {
        int di = side & 1 ? 1 : -1, dk = side & 2 ? 1 : -1;
        double bend = at(s, 1 + dk, i, di) - at(s, 1 + dk, i, 0) - at(s, 1, i, di) + at(s, 1, i, 0);
        if (!isnan(bend)) {
            sum += di * dk * bend;
            n++;
        }
    }
    return sum / n / (s->dx * s->dy);
}

void hm_slope_second(enum hm_slope_method method, const double *const z[3], size_t nx, double dx,
                     double dy, struct hm_slope_second *second)
{
    bool weighs = method != HM_SLOPE_SIMPLE && method != HM_SLOPE_STEEPEST;
    struct stencil s = make_stencil(weighs ? method : HM_SLOPE_OVER_DISTANCE, z, nx, dx, dy);
    for (size_t i = 0; i < nx; i++) {
        double along_x[3], along_y[3];
        for (int k = 0; k < 3; k++) {
            along_x[k] = at(&s, k, i, -1) - 2 * at(&s, k, i, 0) + at(&s, k, i, 1);
            along_y[k] = at(&s, 0, i, k - 1) - 2 * at(&s, 1, i, k - 1) + at(&s, 2, i, k - 1);
        }
        second[i].xx = weighted(along_x, s.middle_x, s.side_x) / (dx * dx);
        second[i].yy = weighted(along_y, s.middle_y, s.side_y) / (dy * dy);
        second[i].xy = mixed(&s, i);
    }
}

double hm_slope_profile_curvature(double gx, double gy, const struct hm_slope_second *s)
{
    double g2 = gx * gx + gy * gy;
    if (!(g2 > 0))
        return NAN;
    double bend = gx * gx * s->xx + 2 * gx * gy * s->xy + gy * gy * s->yy;
    return bend / (g2 * (1 + g2) * sqrt(1 + g2));
}

double hm_slope_plan_curvature(double gx, double gy, const struct hm_slope_second *s)
{
    double g2 = gx * gx + gy * gy;
    if (!(g2 > 0))
        return NAN;
    return (gy * gy * s->xx - 2 * gx * gy * s->xy + gx * gx * s->yy) / (g2 * sqrt(g2));
}

/* --- units --- */

static double from_tangent(double tangent, enum hm_slope_unit unit)
{
    if (unit == HM_SLOPE_PERCENT)
        return 100 * tangent;
    return unit == HM_SLOPE_RADIAN ? atan(tangent) : atan(tangent) * (180 / pi);
}

double hm_slope_of(double gx, double gy, enum hm_slope_unit unit)
{
    return from_tangent(sqrt(gx * gx + gy * gy), unit);
}

double hm_slope_aspect(double gx, double gy)
{
    if (isnan(gx) || isnan(gy) || (gx == 0 && gy == 0))
        return NAN;
    double a = atan2(-gx, -gy) * (180 / pi);
    return a < 0 ? a + 360 : a == 0 ? 0 : a; /* -0 is 0 */
}

const char *hm_slope_unit_name(enum hm_slope_unit unit)
{
    static const char *const name[] = {"degree", "percent", "radian"};
    return name[unit];
}

double hm_slope_convert(double slope, enum hm_slope_unit from, enum hm_slope_unit to)
{
    if (from == to)
        return slope;
    if (from == HM_SLOPE_PERCENT)
        return from_tangent(slope / 100, to);
    return from_tangent(tan(from == HM_SLOPE_RADIAN ? slope : slope * (pi / 180)), to);
}
