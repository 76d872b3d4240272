/* hm_output: buffered bytes to a file or pipe, every one of them checked. Layer 5.
 *
 * A regular file takes its name only when it is whole: until then it has none, or where the file
 * system cannot do that, one beside it.
 */
#ifndef HM_OUTPUT_H
#define HM_OUTPUT_H

#include "hm_base.h"

struct hm_output {
    char *path;   /* what is written to, for diagnostics and for the renaming */
    char *beside; /* the name that the file has meanwhile; NULL: none, or written in place */
    int fd;
    bool nameless; /* the file was opened without a name */
    char *buf;
    size_t cap, fill;
    bool failed;
};

/* path "-" is standard output. On failure there is nothing to close. */
enum hm_err hm_output_open(struct hm_output *out, const char *path, struct hm_diag *d);
/* Could it be opened? Touches nothing; before a long computation. */
enum hm_err hm_output_check(const char *path, struct hm_diag *d);
/* On a descriptor, which is taken over, also on failure; name is for diagnostics. */
enum hm_err hm_output_open_fd(struct hm_output *out, int fd, const char *name, struct hm_diag *d);
/* Flush, close, rename and free, whatever happens; HM_EIO when the bytes did not arrive. Standard
 * output stays open. */
enum hm_err hm_output_close(struct hm_output *out, struct hm_diag *d);
/* Free without finishing; nothing of a regular file remains. */
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
