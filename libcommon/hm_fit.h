/* hm_fit: heights of nodes fitted to the measurements around them. Layer 6.
 *
 * Least squares: each measurement in a triangle weighs its corners by its barycentric coordinates,
 * and the sum of squares of what the mesh misses becomes least. So nodes do not carry the noise of
 * single measurements. Each node is held to its old height as by a tenth of a measurement there,
 * which decides where hardly any measurement is near.
 */
#ifndef HM_FIT_H
#define HM_FIT_H

#include "hm_domain.h"

/* Fit to n measurements x, y, z. Nodes of breaklines and of regular meshes keep their heights. The
 * domain is triangulated, and all nodes have heights. The same for any number of threads. */
enum hm_err hm_fit_heights(struct hm_domain *dom, const double *xyz, size_t n, int threads,
                           struct hm_diag *d);

#endif
