/* hm_headio: the header of an object as it stands in a stream. Layer 5.
 */
#ifndef HM_HEADIO_H
#define HM_HEADIO_H

#include "hm_header.h"
#include "hm_input.h"
#include "hm_output.h"

enum hm_encoding { HM_TEXT, HM_F64LE, HM_F32LE };

/* Most rows of a lattice, most values (nodes times bands) of a row, and most columns, so that a
 * false header cannot ask for a row beyond all memory. */
enum { HM_MAX_SIDE = 10000000, HM_MAX_FIELDS = 1000 };

/* Read from `#hm` to `#data`. On failure *h is empty. */
enum hm_err hm_headio_read(struct hm_input *in, struct hm_header *h, enum hm_encoding *encoding,
                           struct hm_diag *d);

/* HM_EFORMAT, without line, when the lattice is none. */
enum hm_err hm_headio_check_lattice(const struct hm_lattice *l, size_t bands, struct hm_diag *d);

/* Write from `#hm` to `#data`. */
enum hm_err hm_headio_write(struct hm_output *out, const struct hm_header *h,
                            enum hm_encoding encoding, struct hm_diag *d);

#endif
