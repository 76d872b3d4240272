/* Light and shade. */
#include "draw.h"

#include <math.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Steep places, but for the steepest fiftieth, shall look 40°. */
double relief_stretch(double *steep, size_t n)
{
    qsort(steep, n, sizeof *steep, by_value);
    double typical = n ? steep[n - 1 - n / 50] : 0;
    return typical > 0 ? fmin(8, fmax(1, 0.84 / typical)) : 1;
}

/* Lambert's law with the light from north-west, 45° high, and some light from everywhere. */
double relief_light(double east, double north)
{
    double lambert = ((east - north) / sqrt(2) + 1) / sqrt(east * east + north * north + 1);
    return 0.35 + 0.65 * fmax(0, lambert);
}
