/* hm_blunder: measurements that do not belong to the ground: birds, wires, echoes. Layer 6.
 *
 * Where a residual to the dragged surface is over k robust standard deviations (1.4826 times the
 * median of the residuals' sizes) there is a blunder, but not always the measurement itself: a
 * blunder draws the surface, and its neighbours seem wrong. So a plane is fitted to the
 * measurements around, by least absolute deviations, which one blunder hardly moves; the one
 * farthest off the plane is the blunder if it is over k robust standard deviations off, both of the
 * residuals and of the others' distances from the plane, and alone. At a cliff distances are large,
 * and on a wall the measurement is not alone.
 *
 * The search is to be repeated with a surface made without what was found.
 */
#ifndef HM_BLUNDER_H
#define HM_BLUNDER_H

#include "hm_anchor.h"
#include "hm_bspline.h"

struct hm_blunder_rule {
    double k;     /* standard deviations */
    double least; /* metres; smaller residuals are none */
};

/* Mark blunders among n measurements x, y, z: bad[j] = true (others keep theirs), *found of them.
 * s is the surface, its ring extended, its control points the nodes of `a`. *sigma gets the robust
 * standard deviation of all residuals. */
enum hm_err hm_blunder_find(const struct hm_bsurf *s, const struct hm_anchor *a, const double *xyz,
                            size_t n, const struct hm_blunder_rule *rule, int threads, bool *bad,
                            size_t *found, double *sigma, struct hm_diag *d);

#endif
