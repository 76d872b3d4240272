/* hm_batch: the points of an object some thousands at a time, for those who do not hold them.
 * Layer 5.
 *
 *     struct hm_batch b = {0};
 *     while (!(err = hm_batch_read(&b, r, &h, d)))   // until HM_END
 *         for (size_t i = 0; i < b.n; i++)
 *             … b.rows + i * h.nfields …
 *     hm_batch_free(&b);
 */
#ifndef HM_BATCH_H
#define HM_BATCH_H

#include "hm_reader.h"

/* Points of a full batch: enough to share between threads, little beside a mesh. */
enum { HM_BATCH = 16384 };

struct hm_batch {
    double *rows; /* n points, nfields doubles each, x y z first */
    size_t n;
};

/* Read the next points of the object with header h; the room for them is made at the first call. */
enum hm_err hm_batch_read(struct hm_batch *b, struct hm_reader *r, const struct hm_header *h,
                          struct hm_diag *d);
void hm_batch_free(struct hm_batch *b);

/* Give all points of the object to `take`, batch after batch, in order; with more than one thread
 * the next ones are read meanwhile. take may change the rows. */
enum hm_err hm_batch_each(struct hm_reader *r, const struct hm_header *h, int threads,
                          enum hm_err (*take)(void *arg, struct hm_batch *b, struct hm_diag *d),
                          void *arg, struct hm_diag *d);

#endif
