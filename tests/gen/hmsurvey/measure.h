/* measure: the points that a surveyor brings home. */
#ifndef MEASURE_H
#define MEASURE_H

#include "hm_base.h"
#include "terrain.h"

struct cloud {
    double (*p)[3]; /* local x, y in whole centimetres, z with its error */
    size_t n, cap;
};

/* Airborne LiDAR: scan lines at `density` points a square metre with noise of standard deviation
 * sigma; none over water, in thin strips along tile borders and in some holes. Then `blunders` of
 * the points are thrown up or down by 2 to 8 m. */
enum hm_err measure_lidar(struct cloud *c, const struct terrain *t, double density, double sigma,
                          size_t blunders, uint64_t seed, struct hm_diag *d);

/* Bathymetry: cross sections every 20 m with noise, thickened by linear interpolation along the
 * river to about 5 m. */
enum hm_err measure_bathymetry(struct cloud *c, const struct terrain *t, double sigma,
                               uint64_t seed, struct hm_diag *d);

#endif
