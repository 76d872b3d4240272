/* hm_output: buffered bytes to a file or pipe, every one of them checked. Layer 5.
 *
 * A regular file is written beside its name and takes the name only when it is whole.
 */
#ifndef HM_OUTPUT_H
#define HM_OUTPUT_H

#include "hm_base.h"

struct hm_output {
    char *path;   /* what is written to, for diagnostics and for the renaming */
    char *beside; /* the file written meanwhile; NULL when it is written in place */
    int fd;
    char *buf;
    size_t cap, fill;
    bool failed;
};

/* path "-" is standard output. On failure there is nothing to close. */
enum hm_err hm_output_open(struct hm_output *out, const char *path, struct hm_diag *d);
/* Flush, rename and free, whatever happens. */
enum hm_err hm_output_close(struct hm_output *out, struct hm_diag *d);
/* Free without finishing; what was written beside the name is removed. */
void hm_output_abandon(struct hm_output *out);

enum hm_err hm_output_flush(struct hm_output *out, struct hm_diag *d);
enum hm_err hm_output_write(struct hm_output *out, const void *bytes, size_t n, struct hm_diag *d);

/* Where the next n bytes (at most 65536) are to be put, NULL on failure. Then add what was put
 * there to out->fill. */
static inline char *hm_output_room(struct hm_output *out, size_t n, struct hm_diag *d)
{
    if (out->cap - out->fill < n && hm_output_flush(out, d))
        return NULL;
    return out->buf + out->fill;
}

#endif
