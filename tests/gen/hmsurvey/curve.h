/* curve: plan curves of the generated survey, as uniform cubic B-splines.
 *
 * Nothing but + - * / and sqrt, so that every machine computes the same bits.
 */
#ifndef CURVE_H
#define CURVE_H

#include <stdbool.h>
#include <stddef.h>

enum { CURVE_CONTROLS = 16, CURVE_SAMPLES = 8 * CURVE_CONTROLS };

struct curve {
    double control[CURVE_CONTROLS][2];
    size_t n;                            /* control points */
    double sample[CURVE_SAMPLES + 1][2]; /* to find the nearest place roughly */
    size_t nsamples;
};

/* Control points given as parts of a domain of w × h metres. */
void curve_init(struct curve *c, const double (*parts)[2], size_t n, double w, double h);

double curve_end(const struct curve *c); /* the parameter runs over 0 .. curve_end */

/* Place, and on request first and second derivative (NULL: not). */
void curve_at(const struct curve *c, double t, double p[2], double d1[2], double d2[2]);

/* The place at distance `offset` to the left of the curve (right: negative). */
void curve_offset(const struct curve *c, double t, double offset, double p[2]);

/* Parameter at the distance `length` along the curve behind t. */
double curve_advance(const struct curve *c, double t, double length);

/* Distance from the curve in metres, exact where it is less than `reach` (otherwise any larger
 * value), and the parameter of the nearest place. */
double curve_distance(const struct curve *c, const double p[2], double reach, double *t);

#endif
