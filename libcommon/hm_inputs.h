/* hm_inputs: all objects that a tool was given, by kind. Layer 3. */
#ifndef HM_INPUTS_H
#define HM_INPUTS_H

#include "hm_grid.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_points.h"

/* Each kind in the order in which it came. */
struct hm_inputs {
    struct hm_points *points;
    struct hm_grid *grid;
    struct hm_lines *lines;
    struct hm_mesh *mesh;
    size_t npoints, ngrids, nlines, nmeshes;
};
/* One more, cleared, behind those of its kind; NULL when memory is short. Those from before move.
 */
struct hm_points *hm_inputs_add_points(struct hm_inputs *in);
struct hm_grid *hm_inputs_add_grid(struct hm_inputs *in);
struct hm_lines *hm_inputs_add_lines(struct hm_inputs *in);
struct hm_mesh *hm_inputs_add_mesh(struct hm_inputs *in);
void hm_inputs_free(struct hm_inputs *in);

#endif
