/* hm_stations: where along its rough banks a surface has its control points. Layer 6.
 *
 * The same number on both banks: at equal distances; or nearer to each other where the banks bend;
 * and, when that is asked for, shifted along the banks until the sections between them stand at
 * right angles to the river.
 */
#ifndef HM_STATIONS_H
#define HM_STATIONS_H

#include "hm_rough.h"

/* Where banks bend, control points come nearer to each other, but not beyond this part of their
 * usual distance. */
#define HM_STATIONS_LEAST 0.25

/* Control points on the banks HM_LEFT and HM_RIGHT: *n (at least 2) times x, y, z, malloc'd.
 * HM_EGEOM with the place when their distance is larger than the banks are long. */
enum hm_err hm_stations_lay(const struct hm_rough *rough, bool orthogonal, double *bank[2],
                            size_t *n, struct hm_diag *d);

#endif
