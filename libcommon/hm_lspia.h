/* hm_lspia: a B-spline surface dragged towards scattered measurements. Layer 6.
 *
 * Least-squares progressive-iterative approximation (Deng & Lin 2014): in each iteration a control
 * point moves by the mean of the residuals of the measurements under its basis function, weighted
 * by that function. Control points without measurements stay.
 */
#ifndef HM_LSPIA_H
#define HM_LSPIA_H

#include "hm_bspline.h"

/* Drag s (dim 1) towards n measurements: u, v (counted in control points), z each. Measurements
 * beside missing control points that are not extrapolated, and those outside, do not count. *rms
 * (may be NULL) gets the root mean square of the remaining residuals. */
enum hm_err hm_lspia(struct hm_bsurf *s, const double *uvz, size_t n, int iterations, int threads,
                     double *rms, struct hm_diag *d);

#endif
