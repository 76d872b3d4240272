/* hm_polyline: measures and changes of polylines and polygons. Layer 2, on predicates.
 *
 * Vertices are x, y, z side by side (struct hm_line); z is carried along, lengths are in the plane.
 */
#ifndef HM_POLYLINE_H
#define HM_POLYLINE_H

#include "hm_data.h"

/* Length in the plane, the closing piece of a closed line included. */
double hm_polyline_length(const struct hm_line *line);

/* The point at distance s along the line (0 .. length; taken around in a closed line). */
void hm_polyline_at(const struct hm_line *line, double s, double xyz[3]);

/* Points at equal distances, as near to `spacing` as the length allows, both ends kept; *out[n] is
 * malloc'd (3 doubles each). */
enum hm_err hm_polyline_resample(const struct hm_line *line, double spacing, double **out,
                                 size_t *n, struct hm_diag *d);

/* Twice the signed area of a closed line, > 0 counter-clockwise. */
double hm_polygon_area2(const struct hm_line *ring);

/* 1 inside, 0 on the border (exactly), -1 outside; even-odd rule. */
int hm_polygon_side(const struct hm_line *ring, double x, double y);

/* The first place where a line meets itself other than at joints of successive pieces; false when
 * it does not. n log n for ordinary lines. */
enum hm_err hm_polyline_crosses_itself(const struct hm_line *line, bool *crosses, double xy[2],
                                       struct hm_diag *d);

#endif
