/* hm_axis: banks found from a rough centre line. Layer 6.
 *
 * A line with `surface=NAME side=axis half_width=W` stands for both banks. From places on it, as
 * far apart as control points, one looks to the left and to the right for the first breakline that
 * runs along; so both banks lie on the nearest pair of breaklines.
 */
#ifndef HM_AXIS_H
#define HM_AXIS_H

#include "hm_breaklines.h"
#include "hm_rough.h"

/* Breaklines count between these parts of the half-width from the axis. */
#define HM_AXIS_NEAREST 0.1
#define HM_AXIS_FARTHEST 2.0
/* A place without one goes by the median of those found at so many places before and behind. */
enum { HM_AXIS_AROUND = 2 };

/* What came of one axis. */
struct hm_axis {
    char name[HM_ROUGH_NAME];
    size_t places;         /* on both sides */
    size_t by_width;       /* of them: no breakline, the half-width holds, */
    double by_width_at[2]; /* the first of them */
};

/* For each axis in n sets two lines, with side=left and side=right and its other attributes, as a
 * user would have drawn them, into `banks` (begins empty). `along`: distance of control points
 * where the line does not say it. *found is malloc'd. HM_EGEOM, with the place, for an axis that is
 * closed or a point, HM_EFORMAT for a half-width that is none, HM_EARG without distance. */
enum hm_err hm_axis_banks(const struct hm_breaklines *b, const struct hm_lines *sets, size_t n,
                          double along, struct hm_lines *banks, struct hm_axis **found,
                          size_t *nfound, struct hm_diag *d);

#endif
