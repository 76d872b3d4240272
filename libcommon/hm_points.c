#include "hm_points.h"

#include <stdlib.h>
#include <string.h>

enum hm_err hm_points_append(struct hm_points *p, const double *row, struct hm_diag *d)
{
    if (p->stride == 0)
        p->stride = p->header.nfields;
    if (!hm_grow(&p->v, &p->cap, (p->n + 1) * p->stride, sizeof *p->v))
        return hm_fail_memory(d);
    memcpy(p->v + p->n++ * p->stride, row, p->stride * sizeof *row);
    return HM_OK;
}

void hm_points_free(struct hm_points *p)
{
    hm_header_free(&p->header);
    free(p->v);
    *p = (struct hm_points){0};
}
