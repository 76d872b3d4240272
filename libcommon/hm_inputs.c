#include "hm_inputs.h"

#include <stdlib.h>
#include <string.h>

/* One more item of `size` bytes, cleared, at the end of *items (a T **). */
static void *add(void *items, size_t *n, size_t size)
{
    char *array;
    memcpy(&array, items, sizeof array);
    char *longer = *n < PTRDIFF_MAX / size - 1 ? realloc(array, (*n + 1) * size) : NULL;
    if (!longer)
        return NULL;
    memcpy(items, &longer, sizeof longer);
    return memset(longer + (*n)++ * size, 0, size);
}

struct hm_points *hm_inputs_add_points(struct hm_inputs *in)
{
    return add(&in->points, &in->npoints, sizeof *in->points);
}

struct hm_grid *hm_inputs_add_grid(struct hm_inputs *in)
{
    return add(&in->grid, &in->ngrids, sizeof *in->grid);
}

struct hm_lines *hm_inputs_add_lines(struct hm_inputs *in)
{
    return add(&in->lines, &in->nlines, sizeof *in->lines);
}

struct hm_mesh *hm_inputs_add_mesh(struct hm_inputs *in)
{
    return add(&in->mesh, &in->nmeshes, sizeof *in->mesh);
}

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
