/* hm_elem: measures of one element. Layer 4. Corners x, y side by side, counter-clockwise. */
#ifndef HM_ELEM_H
#define HM_ELEM_H

#include "hm_boxtree.h"
#include "hm_mesh.h"

/* Corner coordinates of an element; returns 3 or 4. */
int hm_elem_xy(const struct hm_mesh *m, const struct hm_elem *e, double xy[4][2]);

struct hm_box hm_elem_box(const struct hm_mesh *m, const struct hm_elem *e);

double hm_elem_area(const struct hm_mesh *m, const struct hm_elem *e); /* m², < 0 clockwise */
/* Smallest and largest corner angle in degrees. */
void hm_elem_angles(const struct hm_mesh *m, const struct hm_elem *e, double *least, double *most);
/* Longest over shortest edge, 1 or more; infinity with an edge of length 0. */
double hm_elem_edge_ratio(const struct hm_mesh *m, const struct hm_elem *e);
/* The mean of its corners. */
void hm_elem_centre(const struct hm_mesh *m, const struct hm_elem *e, double xy[2]);
/* Mean length of its edges, m. */
double hm_elem_mean_edge(const struct hm_mesh *m, const struct hm_elem *e);
/* True when every corner turns left, exactly. */
bool hm_elem_is_convex(const struct hm_mesh *m, const struct hm_elem *e);

/* Height at (px, py): linear in triangles, bilinear (isoparametric) in quadrilaterals. */
double hm_elem_height(const struct hm_mesh *m, const struct hm_elem *e, double px, double py);

/* True when (px, py) is inside or on the border, exactly. For convex elements, either way round. */
bool hm_elem_holds(const struct hm_mesh *m, const struct hm_elem *e, double px, double py);

/* True when convex elements e of m and f of n have ground in common, exactly; to share a border is
 * not enough. */
bool hm_elem_overlap(const struct hm_mesh *m, const struct hm_elem *e, const struct hm_mesh *n,
                     const struct hm_elem *f);

#endif
