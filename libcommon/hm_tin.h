/* hm_tin: the ground as a surface of triangles over measurements (TIN). Layer 4.
 *
 * Delaunay, linear in each triangle. Where points share a place their mean height counts, so the
 * surface depends on the points alone, not on their order nor on how they came in parts.
 */
#ifndef HM_TIN_H
#define HM_TIN_H

#include "hm_tri.h"

struct hm_tin {
    struct hm_tri *tri;
    double *z; /* by vertex */
};

/* Of n points x, y, z, all finite. HM_EGEOM as hm_tri_build. */
enum hm_err hm_tin_build(struct hm_tin *tin, const double *xyz, size_t n, int threads,
                         struct hm_diag *d);
void hm_tin_free(struct hm_tin *tin);

/* Height at x, y in a solid triangle: hm_plane_height. */
double hm_tin_height(const struct hm_tin *tin, int32_t tri, double x, double y);

/* Has a solid triangle an edge longer than `gap` (m; 0: no limit)? */
bool hm_tin_is_gap(const struct hm_tin *tin, int32_t tri, double gap);

/* Height of the vertex nearest to x, y, and the square of its distance. *hint: a triangle nearby;
 * becomes the last one seen. */
double hm_tin_nearest(const struct hm_tin *tin, double x, double y, int32_t *hint, double *dist2);

#endif
