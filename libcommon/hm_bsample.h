/* hm_bsample: a B-spline surface of heights at equal distances of its parameters. Layer 2.
 *
 * With `over` = 1 the places are the Greville sites, one a control point; with more there are
 * `over` steps from one to the next, in either direction.
 */
#ifndef HM_BSAMPLE_H
#define HM_BSAMPLE_H

#include "hm_bspline.h"

struct hm_bsample;

/* s (dim 1, its ring extended) must stay as it is as long as the sampler is used. */
enum hm_err hm_bsample_new(struct hm_bsample **b, const struct hm_bsurf *s, int over,
                           struct hm_diag *d);
void hm_bsample_free(struct hm_bsample *b);

/* Row `row` (0 .. (m - 1) * over): (n - 1) * over + 1 heights, and on request the derivatives with
 * respect to u and v (both, or NULL; degree 1: at its edges the mean of both sides). Places beside
 * missing control points (hm_bfringe) get numbers without meaning. */
void hm_bsample_row(struct hm_bsample *b, size_t row, double *z, double *zu, double *zv);

#endif
