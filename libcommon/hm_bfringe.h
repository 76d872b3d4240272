/* hm_bfringe: control nets with holes. Layer 1, part of hm_bspline.
 *
 * Control points without data (gaps, the outside of a survey) take no part in a surface; those
 * beside points with data form its fringe, ring included, and are extrapolated so that the surface
 * can be evaluated at every control point that has data: linearly along rows and columns, else
 * along diagonals, else by a plane fitted to the control points around. Planes are continued
 * exactly.
 */
#ifndef HM_BFRINGE_H
#define HM_BFRINGE_H

#include "hm_bspline.h"

struct hm_bfringe;

/* Declare the control points of s missing for which z (n × m, row after row) is NaN. When there are
 * none this does nothing. hm_bsurf_free frees. */
enum hm_err hm_bfringe_declare(struct hm_bsurf *s, const double *z, struct hm_diag *d);
void hm_bfringe_free(struct hm_bfringe *f);

/* Give the fringe its coordinates (hm_bsurf_extend does it). */
void hm_bfringe_fill(const struct hm_bsurf *s);

/* Has control point (i, j), ring included, coordinates of its own or extrapolated ones? */
bool hm_bfringe_knows(const struct hm_bsurf *s, int64_t i, int64_t j);

/* Has it data of its own? (False for the ring.) */
bool hm_bfringe_has_data(const struct hm_bsurf *s, int64_t i, int64_t j);

#endif
