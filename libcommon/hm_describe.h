/* hm_describe: what an object holds, in a few lines of text. Layer 6. */
#ifndef HM_DESCRIBE_H
#define HM_DESCRIBE_H

#include "hm_reader.h"
#include "hm_writer.h"

/* Read the object that hm_reader_next has just given, to its end, and write kind, name, role,
 * counts, ranges, units, crs, other keys and history. Holds nothing but meshes. */
enum hm_err hm_describe(struct hm_reader *r, const struct hm_header *h, struct hm_writer *w,
                        struct hm_diag *d);

#endif
