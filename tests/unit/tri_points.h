/* tri_points: point sets that are hard on triangulations, for the tests of hm_tri. */
#ifndef TRI_POINTS_H
#define TRI_POINTS_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static uint64_t tri_seed = 88172645463325252u;

__attribute__((unused)) static uint64_t draw(void)
{
    tri_seed ^= tri_seed << 13;
    tri_seed ^= tri_seed >> 7;
    tri_seed ^= tri_seed << 17;
    return tri_seed;
}

__attribute__((unused)) static double uniform(void)
{
    return (double)(draw() >> 11) * 0x1p-53;
}

static double to_cm(double v)
{
    return round(100 * v) / 100;
}

enum tri_set {
    SET_UNIFORM,
    SET_LATTICE,
    SET_DECIMAL_LATTICE,
    SET_SHEARED_LATTICE,
    SET_CIRCLE,
    SET_WHOLE_CIRCLE,
    SET_DUPLICATES,
    SET_HUGE,
    SET_TINY,
    SET_DENORMAL,
    SET_SCALES,
    SET_UTM,
    SET_SPIRAL,
    SET_CLUSTERS,
    SET_ULPS,
    SET_THIN,
    SET_CROSS,
    SET_FAN,
    SETS
};

static const char *const tri_set_name[SETS] = {"uniform",         "lattice",
                                               "decimal lattice", "sheared lattice",
                                               "circle",          "whole circle",
                                               "duplicates",      "1e300",
                                               "1e-300",          "denormal",
                                               "scales mixed",    "UTM centimetres",
                                               "spiral",          "two far clusters",
                                               "ulps apart",      "thin strip",
                                               "cross",           "one point over a line"};

static void tri_lattice_point(int i, int side, double *p)
{
    p[0] = i % side;
    p[1] = i / side;
}

/* Point i of n of a set. */
static void tri_point(enum tri_set set, int i, int n, double *p)
{
    int side = (int)ceil(sqrt(n));
    double a = 0.05 * i, r = set == SET_SCALES ? pow(10, 600 * uniform() - 300) : 1;
    p[0] = uniform();
    p[1] = uniform();
    if (set == SET_LATTICE || set == SET_DECIMAL_LATTICE || set == SET_SHEARED_LATTICE)
        tri_lattice_point(i, side, p);
    if (set == SET_DECIMAL_LATTICE || set == SET_HUGE || set == SET_TINY)
        r = set == SET_HUGE ? 1e300 : set == SET_TINY ? 1e-300 : 0.1;
    if (set == SET_SHEARED_LATTICE)
        p[0] += 0.5 * p[1];
    if (set == SET_CIRCLE || set == SET_SPIRAL) {
        r = set == SET_SPIRAL ? a : 1000;
        p[0] = cos(a);
        p[1] = sin(a);
    }
    if (set == SET_WHOLE_CIRCLE) { /* 36 points of x² + y² = 65² */
        static const int on[9][2] = {{65, 0},  {63, 16}, {60, 25}, {56, 33}, {52, 39},
                                     {39, 52}, {33, 56}, {25, 60}, {16, 63}};
        p[0] = on[i % 9][0] * (draw() % 2 ? 1 : -1);
        p[1] = on[i % 9][1] * (draw() % 2 ? 1 : -1);
    }
    if (set == SET_DUPLICATES || set == SET_DENORMAL) {
        p[0] = (double)(draw() % 12);
        p[1] = (double)(draw() % 12);
        r = set == SET_DENORMAL ? 0x1p-1074 : 1;
    }
    p[0] *= r;
    p[1] *= r;
    if (set == SET_UTM) {
        p[0] = to_cm(545000 + 20 * p[0]);
        p[1] = to_cm(5972000 + 20 * p[1]);
    }
    if (set == SET_CLUSTERS && i % 2)
        p[0] += 1e9;
    if (set == SET_ULPS) {
        p[0] = 1 + floor(16 * p[0]) * 0x1p-52;
        p[1] = 1 + floor(16 * p[1]) * 0x1p-52;
    }
    if (set == SET_THIN)
        p[1] *= 1e-12;
    if (set == SET_CROSS)
        p[i % 2] = 0.5;
    if (set == SET_FAN)
        p[1] = i == n / 2;
}

__attribute__((unused)) static double *tri_points(enum tri_set set, int n)
{
    double *xy = malloc(2 * (size_t)n * sizeof *xy);
    for (int i = 0; xy && i < n; i++)
        tri_point(set, i, n, xy + 2 * i);
    return xy;
}

#endif
