#include "hm_inputs.h"

#include <stdlib.h>

void hm_inputs_free(struct hm_inputs *in)
{
    for (size_t k = 0; k < in->npoints; k++)
        hm_points_free(&in->points[k]);
    for (size_t k = 0; k < in->ngrids; k++)
        hm_grid_free(&in->grid[k]);
    for (size_t k = 0; k < in->nlines; k++)
        hm_lines_free(&in->lines[k]);
    for (size_t k = 0; k < in->nmeshes; k++)
        hm_mesh_free(&in->mesh[k]);
    free(in->points);
    free(in->grid);
    free(in->lines);
    free(in->mesh);
    *in = (struct hm_inputs){0};
}
