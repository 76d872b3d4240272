/* hm_terrain: the height of the ground anywhere, from grids and measurements. Layer 4.
 *
 * One rule for all tools. Grids come first, in their order: whoever gives one has chosen (smoothed,
 * cleaned, burnt in) his terrain. Bilinear, where all nodes around have a height. Elsewhere the
 * measurements: linear in the TIN of all of them at once (hm_tin), so that neither the order of the
 * points nor how they are spread over files makes a difference. With neither grid nor measurement
 * the vertices of breaklines and the nodes of meshes make the TIN.
 */
#ifndef HM_TERRAIN_H
#define HM_TERRAIN_H

#include "hm_inputs.h"

struct hm_terrain;

/* Heights beyond this (m) are a mistake: their differences and squares could overflow. */
#define HM_TERRAIN_HIGHEST 1e100

/* What was mended among the measurements. */
struct hm_terrain_counts {
    int64_t without_z;  /* left out */
    int64_t duplicates; /* at the place of another: their mean height counts */
};

/* Of all that the inputs tell; the grids must outlive the terrain, the rest may be freed. Triangles
 * of the TIN with an edge longer than `gap` (m; 0: no limit) know no height. Inputs without any
 * height make a terrain that knows nothing. HM_EGEOM, with the place, for a height that is out of
 * range. */
enum hm_err hm_terrain_build(struct hm_terrain **t, const struct hm_inputs *in, double gap,
                             int threads, struct hm_terrain_counts *counts, struct hm_diag *d);
void hm_terrain_free(struct hm_terrain *t);

/* The height at x, y, or NaN where nothing tells one. *hint: any value at first, 0 is good; keep
 * one a thread and ask for places near each other. */
double hm_terrain_z(const struct hm_terrain *t, double x, double y, int32_t *hint);

/* As hm_terrain_z, but where that knows nothing the height of the nearest measurement or node of a
 * grid (NaN only when the terrain knows nothing at all). */
double hm_terrain_z_nearest(const struct hm_terrain *t, double x, double y, int32_t *hint);

/* How far apart the measurements are: the median length of the edges of their TIN (of a hundred
 * thousand of them at most), m; 0 without measurements. HM_ENOMEM. */
enum hm_err hm_terrain_spacing(const struct hm_terrain *t, double *spacing, struct hm_diag *d);

/* Is x, y where no grid tells the height, and the measurements around are more than `gap` (m)
 * apart?
 */
bool hm_terrain_is_gap(const struct hm_terrain *t, double x, double y, double gap, int32_t *hint);

/* The places of the measurements, each once, in spatial order, with the terrain's heights: n times
 * x, y, z, malloc'd. None when there are grids only. */
enum hm_err hm_terrain_measurements(const struct hm_terrain *t, double **xyz, size_t *n,
                                    struct hm_diag *d);

#endif
