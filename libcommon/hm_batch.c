#include "hm_batch.h"

#include <stdlib.h>

enum hm_err hm_batch_read(struct hm_batch *b, struct hm_reader *r, const struct hm_header *h,
                          struct hm_diag *d)
{
    b->n = 0;
    if (!b->rows)
        b->rows = hm_alloc(HM_BATCH * h->nfields, sizeof *b->rows);
    return b->rows ? hm_reader_points(r, b->rows, HM_BATCH, &b->n, d) : hm_fail_memory(d);
}

void hm_batch_free(struct hm_batch *b)
{
    free(b->rows);
    *b = (struct hm_batch){0};
}
