#include "terrain.h"

#include <math.h>

const struct section terrain_section[FEATURES] = {
    [MAIN] = {"main", 9.5, 3.5, 0.35, 2.5},
    [TRIBUTARY] = {"tributary", 3.5, 2.6, 0.15, 2},
    [DITCH] = {"ditch", 0.8, 1.3, 0, 1.5},
    [LEVEE] = {"levee", 2, 2.4, 0, 2.5},
};

/* No feature reaches further from its axis, metres. */
enum { REACH = 60 };

void terrain_init(struct terrain *t, double width)
{
    static const double main_river[][2] = {{-0.30, 0.46}, {-0.15, 0.46}, {0.00, 0.42}, {0.15, 0.30},
                                           {0.32, 0.32},  {0.47, 0.52},  {0.64, 0.58}, {0.82, 0.44},
                                           {1.00, 0.36},  {1.15, 0.40},  {1.30, 0.44}};
    static const double tributary[][2] = {{0.17, 1.35},  {0.19, 1.15}, {0.19, 0.98}, {0.20, 0.84},
                                          {0.29, 0.74},  {0.42, 0.79}, {0.54, 0.76}, {0.61, 0.64},
                                          {0.665, 0.52}, {0.70, 0.44}};
    static const double ditch[][2] = {{1.30, 0.80},  {1.15, 0.76}, {1.00, 0.70},
                                      {0.90, 0.72},  {0.82, 0.80}, {0.75, 0.72},
                                      {0.745, 0.60}, {0.74, 0.48}, {0.74, 0.40}};
    static const double levee[][2] = {{-0.30, 0.24}, {-0.15, 0.24}, {0.00, 0.19}, {0.15, 0.08},
                                      {0.32, 0.08},  {0.48, 0.24},  {0.64, 0.29}, {0.82, 0.18},
                                      {1.00, 0.11},  {1.15, 0.14},  {1.30, 0.18}};
    t->w = width;
    t->h = width * 2 / 3;
#define INIT(f, parts) curve_init(&t->axis[f], parts, sizeof parts / sizeof *parts, t->w, t->h)
    INIT(MAIN, main_river);
    INIT(TRIBUTARY, tributary);
    INIT(DITCH, ditch);
    INIT(LEVEE, levee);
#undef INIT
}

double terrain_base(double x, double y)
{
    return 6 - 0.0008 * x + 0.0012 * y;
}

double terrain_water(double x, double y)
{
    return terrain_base(x, y) - 2;
}

/* A wave of period 1 and amplitude 1, near enough to a sine, from arithmetic alone. */
static double wave(double phase)
{
    double q = 4 * (phase - floor(phase)); /* 0 .. 4 quarters */
    q = q <= 1 ? q : q <= 3 ? 2 - q : q - 4;
    return q * (1.5706268 - q * q * (0.6432292 - q * q * 0.0726024));
}

double terrain_ground(const struct terrain *t, double x, double y)
{
    double z = terrain_base(x, y) + 0.18 * wave((x + 0.4 * y) / 170) +
               0.12 * wave((y - 0.3 * x) / 115 + 0.3) + 0.08 * wave((x + 2 * y) / 260 + 0.6);
    /* the raised hook of land between the two rivers */
    double ex = (x - 0.43 * t->w) / (0.17 * t->w), ey = (y - 0.63 * t->h) / (0.17 * t->h);
    double rest = 1 - ex * ex - ey * ey;
    return rest > 0 ? z + 0.9 * rest * rest * rest : z;
}

/* Height of a feature's shape at distance d from its axis. */
static double shape(enum feature f, double d, double base)
{
    const struct section *s = &terrain_section[f];
    if (f == LEVEE)
        return base + s->height - fmax(0, d - s->half) / s->run;
    if (d < s->half)
        return base - s->height - s->sag * (1 - d * d / (s->half * s->half));
    return base - s->height + (d - s->half) / s->run;
}

double terrain_feature(const struct terrain *t, enum feature f, double x, double y)
{
    double s, d = curve_distance(&t->axis[f], (double[2]){x, y}, REACH, &s);
    return shape(f, d, terrain_base(x, y));
}

double terrain_z(const struct terrain *t, double x, double y)
{
    double z = fmax(terrain_ground(t, x, y), terrain_feature(t, LEVEE, x, y));
    for (enum feature f = MAIN; f <= DITCH; f++)
        z = fmin(z, terrain_feature(t, f, x, y));
    return z;
}

double terrain_edge(const struct terrain *t, enum feature f, double s, int side)
{
    const struct section *section = &terrain_section[f];
    double d = section->half + section->run * section->height;
    /* The ground is nearly level, so that this gains more than a digit a step. */
    for (int k = 0; k < 20; k++) {
        double p[2];
        curve_offset(&t->axis[f], s, side * d, p);
        double over = terrain_ground(t, p[0], p[1]) - terrain_base(p[0], p[1]);
        d = section->half +
            section->run * (f == LEVEE ? section->height - over : section->height + over);
    }
    return d;
}
