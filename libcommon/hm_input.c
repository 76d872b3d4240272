#include "hm_input.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { BUFFER = 1 << 20 };
#define LONGEST_LINE ((size_t)1 << 30)

enum hm_err hm_input_open_fd(struct hm_input *in, int fd, const char *name, struct hm_diag *d)
{
    *in = (struct hm_input){.fd = fd};
    in->name = strdup(name);
    in->buf = hm_alloc(BUFFER, 1);
    in->cap = BUFFER;
    if (in->name && in->buf)
        return HM_OK;
    hm_input_close(in);
    return hm_fail_memory(d);
}

enum hm_err hm_input_open(struct hm_input *in, const char *path, struct hm_diag *d)
{
    if (!strcmp(path, "-"))
        return hm_input_open_fd(in, STDIN_FILENO, "standard input", d);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return hm_fail_line(d, HM_EIO, path, 0, "cannot open: %s", strerror(errno));
    return hm_input_open_fd(in, fd, path, d);
}

void hm_input_close(struct hm_input *in)
{
    if (in->fd > STDIN_FILENO)
        close(in->fd);
    free(in->name);
    free(in->buf);
    *in = (struct hm_input){.fd = -1};
}

/* Room for `need` unread bytes, with the line last given kept when it is still unfinished. */
static enum hm_err make_room(struct hm_input *in, size_t need, struct hm_diag *d)
{
    if (in->pos > 0) {
        memmove(in->buf, in->buf + in->pos, in->fill - in->pos);
        in->offset += (int64_t)in->pos;
        in->fill -= in->pos;
        in->pos = 0;
    }
    return hm_grow(&in->buf, &in->cap, need, 1) ? HM_OK : hm_fail_memory(d);
}

/* Read up to n bytes to `to`; *got is 0 at the end of the input only. */
static enum hm_err read_some(struct hm_input *in, char *to, size_t n, size_t *got,
                             struct hm_diag *d)
{
    ssize_t part;
    do
        part = read(in->fd, to, n);
    while (part < 0 && errno == EINTR);
    if (part < 0)
        return hm_fail_line(d, HM_EIO, in->name, 0, "cannot read: %s", strerror(errno));
    *got = (size_t)part;
    in->eof = part == 0;
    return HM_OK;
}

enum hm_err hm_input_fill(struct hm_input *in, size_t need, struct hm_diag *d)
{
    if (hm_input_has(in) >= need || in->eof)
        return HM_OK;
    enum hm_err err = make_room(in, need, d);
    while (!err && in->fill < need && !in->eof) {
        size_t got = 0;
        err = read_some(in, in->buf + in->fill, in->cap - in->fill, &got, d);
        in->fill += got;
    }
    return err;
}

/* Read n bytes past the buffer, which is empty, straight to where they belong. */
static enum hm_err read_straight(struct hm_input *in, char *to, size_t n, struct hm_diag *d)
{
    in->offset += (int64_t)in->pos;
    in->pos = in->fill = 0;
    for (size_t got = 0; n > 0; n -= got, to += got) {
        enum hm_err err = read_some(in, to, n, &got, d);
        if (err)
            return err;
        if (got == 0)
            return HM_END;
        in->offset += (int64_t)got;
    }
    return HM_OK;
}

enum hm_err hm_input_read(struct hm_input *in, void *bytes, size_t n, struct hm_diag *d)
{
    enum { LARGE = 1 << 16 };
    for (char *to = bytes; n > 0;) {
        if (to && n >= LARGE && hm_input_has(in) == 0 && !in->eof)
            return read_straight(in, to, n, d);
        enum hm_err err = hm_input_fill(in, 1, d);
        if (err)
            return err;
        size_t has = hm_input_has(in), part = has < n ? has : n;
        if (part == 0)
            return HM_END;
        if (to) {
            memcpy(to, hm_input_at(in), part);
            to += part;
        }
        in->pos += part;
        n -= part;
    }
    return HM_OK;
}

enum hm_err hm_input_long_line(struct hm_input *in, const char **s, const char **end,
                               struct hm_diag *d)
{
    const char *lf = NULL;
    while (!lf && !in->eof) {
        size_t seen = hm_input_has(in);
        if (seen >= LONGEST_LINE) {
            in->line++;
            return hm_input_fail(in, HM_EFORMAT, d, "a line of more than 1 GB");
        }
        enum hm_err err = hm_input_fill(in, seen + 1, d);
        if (err)
            return err;
        lf = memchr(hm_input_at(in) + seen, '\n', hm_input_has(in) - seen);
    }
    if (lf)
        return hm_input_line(in, s, end, d);
    if (in->pos == in->fill)
        return HM_END;
    in->last = in->pos;
    in->line++;
    *s = hm_input_at(in);
    in->pos = in->fill;
    in->unfinished = true;
    *end = in->buf + in->fill;
    if ((*end)[-1] == '\r')
        --*end;
    return HM_OK;
}

enum hm_err hm_input_fail(const struct hm_input *in, enum hm_err err, struct hm_diag *d,
                          const char *format, ...)
{
    char text[HM_DIAG_TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return hm_fail_line(d, err, in->name, in->line, "%s", text);
}

enum hm_err hm_input_fail_byte(const struct hm_input *in, enum hm_err err, int64_t at,
                               struct hm_diag *d, const char *format, ...)
{
    char text[HM_DIAG_TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return hm_fail_line(d, err, in->name, 0, "%s (byte %lld)", text, (long long)at);
}
