/* hm_snap: control points along a rough bank, moved to breaklines (the paper's section 5.1, figures
 * 5 and 7). Layer 6.
 *
 * "Moved to the nearest breakline" is a fit of the whole bank, not of each point alone: where two
 * breaklines run side by side (toe and crest) the bank stays on one of them, it goes forward along
 * the bank everywhere, and crosses over only where that costs less than it gains. Lines with
 * limit=, which are steep on their left, tell toe from crest by which way they run beside the bank.
 */
#ifndef HM_SNAP_H
#define HM_SNAP_H

#include "hm_breaklines.h"

/* One bank: n control points, at least 2. */
struct hm_bank {
    size_t n;
    const double *rough; /* 3 a point (z unused): where the user's line has them */
    const double *reach; /* 1 a point: how far it may move, metres */
    double slide[2][2];  /* directions of the end sections, along which the two ends slide */
};

/* Where the control points go, xy[2*i], and which of them found a breakline, moved[i]. A point that
 * found none is shifted as its moved neighbours are: linearly between the one before and the one
 * behind; beyond the last one the shift fades over HM_SNAP_FADE points, and with no neighbour moved
 * the point stays. */
enum { HM_SNAP_FADE = 5 };
enum hm_err hm_snap_bank(const struct hm_breaklines *b, const struct hm_bank *bank, double *xy,
                         bool *moved, struct hm_diag *d);

#endif
