/* terrain: the true surface of the generated survey, a river junction in a lowland.
 *
 * Everything is the least or the greatest of simple shapes: ground and levee (the higher), cut by
 * the main river, the tributary and a ditch (the lowest). Banks are planar: they rise at a constant
 * slope from the toe, at a fixed distance from the axis, to where they meet the ground, the crest.
 * Local coordinates: metres from the south-west corner; x runs east.
 */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "curve.h"

#define TERRAIN_EAST 545000.0 /* UTM place of the south-west corner */
#define TERRAIN_NORTH 5972000.0

enum feature { MAIN, TRIBUTARY, DITCH, LEVEE, FEATURES };

/* Cross section. Channel: toe at `half` from the axis, `height` under the base plane there, `sag`
 * deeper in the middle, sides rising 1:run. Levee: crown of half width `half`, `height` over the
 * base plane, sides falling 1:run. */
struct section {
    const char *name;
    double half, height, sag, run;
};
extern const struct section terrain_section[FEATURES];

struct terrain {
    double w, h;                 /* extent, metres */
    struct curve axis[FEATURES]; /* rivers downstream */
};

void terrain_init(struct terrain *t, double width); /* height is 2/3 of the width */

double terrain_base(double x, double y);  /* the tilted plane that heights refer to */
double terrain_water(double x, double y); /* water level at the time of the flight */
double terrain_ground(const struct terrain *t, double x, double y); /* without any feature */
double terrain_feature(const struct terrain *t, enum feature f, double x, double y);
double terrain_z(const struct terrain *t, double x, double y);

/* Distance from the axis, along its normal at parameter s, at which the sides of a feature meet the
 * ground: the crest of a channel, the toe of the levee. side: 1 left, -1 right. */
double terrain_edge(const struct terrain *t, enum feature f, double s, int side);

#endif
