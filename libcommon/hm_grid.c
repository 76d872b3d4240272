#include "hm_grid.h"

#include <math.h>
#include <stdlib.h>

enum hm_err hm_grid_init(struct hm_grid *g, struct hm_header *h, struct hm_diag *d)
{
    *g = (struct hm_grid){.header = *h, .bands = h->nfields - 2};
    *h = (struct hm_header){0};
    const struct hm_lattice *l = &g->header.lattice;
    if (g->bands < 1 || l->nx < 1 || l->ny < 1 || l->nx > INT64_MAX / l->ny ||
        (uint64_t)(l->nx * l->ny) > SIZE_MAX / g->bands)
        return hm_fail_memory(d);
    size_t n = (size_t)(l->nx * l->ny) * g->bands;
    g->v = hm_alloc(n, sizeof *g->v);
    if (!g->v)
        return hm_fail_memory(d);
    for (size_t i = 0; i < n; i++)
        g->v[i] = NAN;
    return HM_OK;
}

void hm_grid_free(struct hm_grid *g)
{
    hm_header_free(&g->header);
    free(g->v);
    *g = (struct hm_grid){0};
}
