/* hm_misfit: elements of a regular mesh that the terrain does not bear out. Layer 6.
 *
 * A surface between two banks is too smooth for a groyne, a guide dam or an island in the bed.
 * Elements that miss the ground are given up: the irregular mesh, which has the breaklines as
 * edges, fills the holes.
 */
#ifndef HM_MISFIT_H
#define HM_MISFIT_H

#include "hm_mesh.h"
#include "hm_terrain.h"

/* What remains in groups of fewer elements than this is given up, too. */
enum { HM_MISFIT_LEAST = 40 };

/* keep[i]: element i stays. Given up are elements whose root mean square misfit (over a lattice of
 * places within the element where the terrain is known) is above `most` (m), but for single ones;
 * those with a node in common with them; those that then hang by a single edge; and small remains.
 */
enum hm_err hm_misfit_mark(const struct hm_mesh *m, const struct hm_terrain *terrain, double most,
                           int threads, bool *keep, struct hm_diag *d);

#endif
