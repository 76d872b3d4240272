/* hm_lspia: a B-spline surface dragged towards scattered measurements. Layer 6.
 *
 * Least-squares progressive-iterative approximation (Deng & Lin 2014): in each iteration a control
 * point moves by the mean of the residuals of the measurements under its basis function, weighted
 * by that function. Control points without measurements stay.
 */
#ifndef HM_LSPIA_H
#define HM_LSPIA_H

#include "hm_anchor.h"
#include "hm_bspline.h"

/* Drag s (dim 1), whose control points are the nodes of `a`, towards n measurements x, y, z. Ends
 * when an iteration has moved no control point by more than `tolerance` (metres), at the latest
 * after `iterations`. Measurements beside missing control points that are not extrapolated, and
 * those outside, do not count. *rms (may be NULL) gets the root mean square of the remaining
 * residuals. */
enum hm_err hm_lspia(struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz, size_t n,
                     int iterations, double tolerance, int threads, double *rms, struct hm_diag *d);

/* rest[k] = z of measurement k - the surface there; NaN for those that do not count. The ring must
 * be extended. */
void hm_lspia_residuals(const struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz,
                        size_t n, int threads, double *rest);

#endif
