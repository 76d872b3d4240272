/* hm_polyline: measures and changes of polylines and polygons. Layer 4.
 *
 * Vertices are x, y, z side by side (struct hm_line); z is carried along, lengths are in the plane.
 */
#ifndef HM_POLYLINE_H
#define HM_POLYLINE_H

#include "hm_line.h"

/* Length in the plane, the closing piece of a closed line included. */
double hm_polyline_length(const struct hm_line *line);

/* Pieces between vertices: n - 1, or n of a closed line; 0 of a single point. Piece k runs from
 * vertex k to the next. */
size_t hm_polyline_pieces(const struct hm_line *line);

/* The first and the last vertex of piece k. */
static inline const double *hm_polyline_from(const struct hm_line *line, size_t k)
{
    return line->xyz + 3 * k;
}
static inline const double *hm_polyline_to(const struct hm_line *line, size_t k)
{
    return line->xyz + 3 * (k + 1 < line->n ? k + 1 : 0);
}

/* The point at distance s along the line (0 .. length; taken around in a closed line). */
void hm_polyline_at(const struct hm_line *line, double s, double xyz[3]);

/* Points at equal distances, as near to `spacing` as the length allows, both ends kept (of a closed
 * line the first vertex, and three points at least); *out[n] is malloc'd (3 doubles each). HM_EGEOM
 * when the line has no length. */
enum hm_err hm_polyline_resample(const struct hm_line *line, double spacing, double **out,
                                 size_t *n, struct hm_diag *d);

/* The line cut into `pieces` of equal length: as hm_polyline_resample, by number. */
enum hm_err hm_polyline_divide(const struct hm_line *line, size_t pieces, double **out, size_t *n,
                               struct hm_diag *d);

/* Twice the signed area of a closed line, > 0 counter-clockwise. */
double hm_polygon_area2(const struct hm_line *ring);

/* 1 inside, 0 on the border (exactly), -1 outside; even-odd rule. */
int hm_polygon_side(const struct hm_line *ring, double x, double y);

/* The first place where a line meets itself other than at joints of successive pieces (pieces
 * without length do not count); false when it does not. n log n for ordinary lines. */
enum hm_err hm_polyline_crosses_itself(const struct hm_line *line, bool *crosses, double xy[2],
                                       struct hm_diag *d);

#endif
