/* hm_input: the bytes of a file or pipe, as lines or as blocks, without copying. Layer 5.
 *
 * One buffer; lines and blocks are given as pointers into it that hold until the next call. It
 * grows only when a single line is longer than it, hence with the data that are really there.
 */
#ifndef HM_INPUT_H
#define HM_INPUT_H

#include "hm_base.h"

#include <string.h>

struct hm_input {
    char *name; /* for diagnostics: the path, or "standard input" */
    int fd;
    char *buf;
    size_t cap, pos, fill; /* buf[pos..fill) is unread */
    size_t last;           /* where the line last given begins */
    int64_t offset;        /* byte of the file that buf[0] is */
    int64_t line;          /* number of the line last given, from 1 */
    bool eof;              /* nothing behind buf[fill) */
    bool unfinished;       /* the line last given is the last, and has no line end */
};

/* path "-" is standard input. On failure there is nothing to close. */
enum hm_err hm_input_open(struct hm_input *in, const char *path, struct hm_diag *d);
/* On a descriptor, which is taken over, also on failure; name is for diagnostics. */
enum hm_err hm_input_open_fd(struct hm_input *in, int fd, const char *name, struct hm_diag *d);
void hm_input_close(struct hm_input *in);

/* Have at least `need` unread bytes in the buffer, or all that there are. */
enum hm_err hm_input_fill(struct hm_input *in, size_t need, struct hm_diag *d);
static inline size_t hm_input_has(const struct hm_input *in)
{
    return in->fill - in->pos;
}
static inline const char *hm_input_at(const struct hm_input *in)
{
    return in->buf + in->pos;
}
/* Byte of the file that is read next. */
static inline int64_t hm_input_tell(const struct hm_input *in)
{
    return in->offset + (int64_t)in->pos;
}

/* Read exactly n bytes into bytes, or pass over them when bytes is NULL; HM_END, with what there
 * was consumed, when there are fewer. */
enum hm_err hm_input_read(struct hm_input *in, void *bytes, size_t n, struct hm_diag *d);

/* The slow way of hm_input_line: the line does not end in the buffer. */
enum hm_err hm_input_long_line(struct hm_input *in, const char **s, const char **end,
                               struct hm_diag *d);

/* The next line as [*s, *end), without its end (LF, or CR LF). HM_END behind the last. */
static inline enum hm_err hm_input_line(struct hm_input *in, const char **s, const char **end,
                                        struct hm_diag *d)
{
    const char *from = in->buf + in->pos, *lf = memchr(from, '\n', in->fill - in->pos);
    if (!lf)
        return hm_input_long_line(in, s, end, d);
    in->last = in->pos;
    in->pos = (size_t)(lf - in->buf) + 1;
    in->line++;
    *s = from;
    *end = lf > from && lf[-1] == '\r' ? lf - 1 : lf;
    return HM_OK;
}

/* Give the line last given once more. */
static inline void hm_input_unread(struct hm_input *in)
{
    in->pos = in->last;
    in->line--;
}

/* Failures at the line last given, and at byte `at` of the file. */
enum hm_err hm_input_fail(const struct hm_input *in, enum hm_err err, struct hm_diag *d,
                          const char *format, ...) __attribute__((format(printf, 4, 5)));
enum hm_err hm_input_fail_byte(const struct hm_input *in, enum hm_err err, int64_t at,
                               struct hm_diag *d, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

#endif
