#include "hm_batch.h"

#include "hm_thread.h"

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

/* The points of an object on their way to `take`. */
enum { SLOTS = 4 };

struct relay {
    struct hm_reader *r;
    const struct hm_header *h;
    enum hm_err (*take)(void *arg, struct hm_batch *b, struct hm_diag *d);
    void *arg;
    struct hm_batch batch[SLOTS];
    enum hm_err read, taken;
    struct hm_diag read_d, taken_d;
};

static bool read_slot(void *arg, size_t slot)
{
    struct relay *y = arg;
    y->read = hm_batch_read(&y->batch[slot], y->r, y->h, &y->read_d);
    return y->read == HM_OK;
}

static bool take_slot(void *arg, size_t slot)
{
    struct relay *y = arg;
    y->taken = y->take(y->arg, &y->batch[slot], &y->taken_d);
    return y->taken == HM_OK;
}

enum hm_err hm_batch_each(struct hm_reader *r, const struct hm_header *h, int threads,
                          enum hm_err (*take)(void *arg, struct hm_batch *b, struct hm_diag *d),
                          void *arg, struct hm_diag *d)
{
    struct relay y = {.r = r, .h = h, .take = take, .arg = arg};
    hm_thread_relay(threads, SLOTS, read_slot, take_slot, &y);
    enum hm_err err = y.taken ? y.taken : y.read == HM_END ? HM_OK : y.read;
    if (err && d && !d->err)
        *d = y.taken ? y.taken_d : y.read_d;
    for (size_t k = 0; k < SLOTS; k++)
        hm_batch_free(&y.batch[k]);
    return err;
}
