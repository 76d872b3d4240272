/* hm_drape: the heights of a B-spline surface dragged to the terrain under it. Layer 6.
 *
 * Least-squares progressive-iterative approximation (Deng & Lin 2014) on a lattice of samples: in
 * each iteration a control point moves by the mean of the residuals under its basis function,
 * weighted by that function. Interpolation at the Greville sites alone would overshoot beside every
 * toe and crest, as control points are far apart against the width of a bank.
 */
#ifndef HM_DRAPE_H
#define HM_DRAPE_H

#include "hm_bspline.h"

/* z[b*na + a] is the height wanted at u = a (n-1)/(na-1), v = b (m-1)/(nb-1); NaN is not known. The
 * last coordinate of the control points, which holds the start, is changed; the ring is made anew.
 */
enum hm_err hm_drape(struct hm_bsurf *s, const double *z, size_t na, size_t nb, int iterations,
                     int threads, struct hm_diag *d);

#endif
