/* hm_copy: objects from a reader to writers as they come. Layer 5. Holds no object but a mesh. */
#ifndef HM_COPY_H
#define HM_COPY_H

#include "hm_reader.h"
#include "hm_writer.h"

/* Copy the object that hm_reader_next has just given, with header h, to each of n writers. */
enum hm_err hm_copy_object(struct hm_reader *r, const struct hm_header *h, struct hm_writer **to,
                           size_t n, struct hm_diag *d);

#endif
