/* hm_terrain: the height of the ground anywhere, from measurements or from a grid. Layer 4.
 *
 * From points: linear in the Delaunay triangulation (TIN). From a grid: bilinear, where all four
 * nodes have a height. Several sources: the first that knows a height there, in the order added.
 */
#ifndef HM_TERRAIN_H
#define HM_TERRAIN_H

#include "hm_grid.h"
#include "hm_points.h"
#include "hm_tri.h"

struct hm_terrain;

enum hm_err hm_terrain_new(struct hm_terrain **t, struct hm_diag *d);
void hm_terrain_free(struct hm_terrain *t);

/* Points without height are left out; triangles with an edge longer than `gap` (0: no limit) know
 * no height. The terrain keeps what it needs; p may be freed. */
enum hm_err hm_terrain_add_points(struct hm_terrain *t, const struct hm_points *p, double gap,
                                  int threads, struct hm_diag *d);
/* The same over a triangulation that the caller has and keeps: z by vertex number. */
enum hm_err hm_terrain_add_tri(struct hm_terrain *t, const struct hm_tri *tri, const double *z,
                               double gap, struct hm_diag *d);
/* Band 0; g must outlive the terrain. */
enum hm_err hm_terrain_add_grid(struct hm_terrain *t, const struct hm_grid *g, struct hm_diag *d);

bool hm_terrain_is_empty(const struct hm_terrain *t);

/* The height at x, y, or NaN where no source knows one. *hint: any value at first, 0 is good; keep
 * one a thread and ask for places near each other. */
double hm_terrain_z(const struct hm_terrain *t, double x, double y, int32_t *hint);

/* As hm_terrain_z, but beyond all sources the height of the nearest measurement or node (NaN only
 * when the terrain is empty). */
double hm_terrain_z_nearest(const struct hm_terrain *t, double x, double y, int32_t *hint);

#endif
