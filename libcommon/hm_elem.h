/* hm_elem: measures of one element. Layer 3. Corners x, y side by side, counter-clockwise. */
#ifndef HM_ELEM_H
#define HM_ELEM_H

#include "hm_data.h"

/* Corner coordinates of an element; returns 3 or 4. */
int hm_elem_xy(const struct hm_mesh *m, const struct hm_elem *e, double xy[4][2]);

double hm_elem_area(const struct hm_mesh *m, const struct hm_elem *e); /* m², < 0 clockwise */
/* Smallest and largest corner angle in degrees. */
void hm_elem_angles(const struct hm_mesh *m, const struct hm_elem *e, double *least, double *most);
/* Longest over shortest edge, 1 or more; infinity with an edge of length 0. */
double hm_elem_edge_ratio(const struct hm_mesh *m, const struct hm_elem *e);
/* True when every corner turns left, exactly. */
bool hm_elem_is_convex(const struct hm_mesh *m, const struct hm_elem *e);

#endif
