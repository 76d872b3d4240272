/* hm_uncross: smoothing and resampling of a set of lines that never makes them cross. Layer 6.
 *
 * The change is made for all lines at once. Where two pieces then cross, what made them goes back:
 * vertices to where they were, chords to the stretch of line that they cut short. That is repeated
 * until nothing crosses that did not at first.
 */
#ifndef HM_UNCROSS_H
#define HM_UNCROSS_H

#include "hm_line.h"

/* hm_lineedit_smooth for all lines; *kept: the vertices that had to go back. */
enum hm_err hm_uncross_smooth(struct hm_lines *lines, double most, size_t *kept, struct hm_diag *d);

/* hm_polyline_resample for all lines; *kept: the chords that had to follow their line. Lines
 * without length are left as they are. */
enum hm_err hm_uncross_resample(struct hm_lines *lines, double spacing, size_t *kept,
                                struct hm_diag *d);

#endif
