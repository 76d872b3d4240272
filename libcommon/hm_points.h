/* hm_points: measurements in memory. Layer 3.
 *
 * Begins life as `= {0}`, owns what its pointers hold, and is emptied by hm_points_free.
 */
#ifndef HM_POINTS_H
#define HM_POINTS_H

#include "hm_header.h"

/* Row i is v[i*stride .. ), x y z first, stride = header.nfields. */
struct hm_points {
    struct hm_header header;
    double *v;
    size_t n, cap, stride;
};

enum hm_err hm_points_append(struct hm_points *p, const double *row, struct hm_diag *d);
void hm_points_free(struct hm_points *p);

#endif
