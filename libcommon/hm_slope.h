/* hm_slope: gradient, slope and aspect of a grid, row by row. Layer 6.
 *
 * The gradient is taken from the node's 3 × 3 neighbours. Weighted methods take the difference over
 * each of the three rows (columns) that has one and weigh them:
 *
 *     method               middle : side rows       source
 *     one-over-distance    √(dx²+dy²) : |dx|        Jones 1998; the paper's equation (1), 1 : √2 :
 * 1 (columns: |dy|)          when the steps are equal horn                 2 : 1 Horn 1981 zt 1 : 0
 * Zevenbergen & Thorne 1987, Fleming & Hoffer 1979 equal                1 : 1 Sharpnack & Akin 1969
 *
 * Beside the border or a node without data the difference to the neighbour that exists stands for
 * the one across, and a row that has none does not count; so planes are exact everywhere.
 */
#ifndef HM_SLOPE_H
#define HM_SLOPE_H

#include "hm_base.h"

enum hm_slope_method {
    HM_SLOPE_OVER_DISTANCE,
    HM_SLOPE_HORN,
    HM_SLOPE_ZT,
    HM_SLOPE_EQUAL,
    HM_SLOPE_SIMPLE,  /* to the neighbour before, in the row and in the column (else behind) */
    HM_SLOPE_STEEPEST /* along the steepest way to one of the eight neighbours */
};

enum hm_slope_unit { HM_SLOPE_DEGREE, HM_SLOPE_PERCENT, HM_SLOPE_RADIAN };

/* Gradient (dz/dx, dz/dy) of the nx nodes of the row z[1]; z[0] and z[2] are the rows before and
 * behind it (NULL at the border); dx, dy are the signed steps. NaN where z is NaN or no neighbour
 * tells. */
void hm_slope_gradient(enum hm_slope_method method, const double *const z[3], size_t nx, double dx,
                       double dy, double *gx, double *gy);

/* The second derivatives of a node: zxx, zxy, zyy. */
struct hm_slope_second {
    double xx, xy, yy;
};

/* Second derivatives of the nodes of the row z[1], as above: second differences over the rows and
 * columns, with the weights of the method (those of one-over-distance for simple and steepest), the
 * mixed one over the four cells around. Rows, columns and cells that miss a node do not count; NaN
 * where none is left. */
void hm_slope_second(enum hm_slope_method method, const double *const z[3], size_t nx, double dx,
                     double dy, struct hm_slope_second *second);

/* Curvature of the ground along its fall, 1/m: > 0 where it gets flatter downhill (toes), < 0 where
 * it gets steeper (crests). NaN on level ground. */
double hm_slope_profile_curvature(double gx, double gy, const struct hm_slope_second *s);

/* Curvature of the contour line, 1/m: > 0 where it bends around higher ground on its outside
 * (hollows), < 0 on spurs. NaN on level ground. */
double hm_slope_plan_curvature(double gx, double gy, const struct hm_slope_second *s);

/* Equation (1): the slope of a gradient. */
double hm_slope_of(double gx, double gy, enum hm_slope_unit unit);

/* Where the ground falls to, in degrees clockwise from north, 0 .. 360; NaN when it is level. */
double hm_slope_aspect(double gx, double gy);

/* "degree", "percent", "radian" */
const char *hm_slope_unit_name(enum hm_slope_unit unit);

/* A slope in one unit as one in another. */
double hm_slope_convert(double slope, enum hm_slope_unit from, enum hm_slope_unit to);

#endif
