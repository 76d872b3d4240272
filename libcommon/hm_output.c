#define _XOPEN_SOURCE 700 /* realpath */

#include "hm_output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 1 << 20 };

static void release(struct hm_output *out)
{
    if (out->fd > STDERR_FILENO)
        close(out->fd);
    free(out->path);
    free(out->beside);
    free(out->buf);
    *out = (struct hm_output){.fd = -1};
}

static enum hm_err refuse(const struct hm_output *out, const char *what, struct hm_diag *d)
{
    return hm_fail_line(d, HM_EIO, out->path, 0, "cannot %s: %s", what, strerror(errno));
}

/* A new file beside out->path, under a name that is free. */
static enum hm_err open_beside(struct hm_output *out, mode_t mode, struct hm_diag *d)
{
    size_t size = strlen(out->path) + 64;
    out->beside = hm_alloc(size, 1);
    if (!out->beside)
        return hm_fail_memory(d);
    for (int i = 0; i < 1000; i++) {
        snprintf(out->beside, size, "%s.part%ld.%d", out->path, (long)getpid(), i);
        out->fd = open(out->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (out->fd >= 0 || errno != EEXIST)
            break;
    }
    if (out->fd >= 0)
        return HM_OK;
    free(out->beside);
    out->beside = NULL;
    return refuse(out, "create", d);
}

static enum hm_err open_path(struct hm_output *out, struct hm_diag *d)
{
    struct stat st;
    if (stat(out->path, &st))
        return errno == ENOENT ? open_beside(out, 0666, d) : refuse(out, "open", d);
    if (S_ISREG(st.st_mode)) {
        if (access(out->path, W_OK))
            return refuse(out, "write", d);
        char *real = realpath(out->path, NULL); /* through a link, so that the link stays */
        if (!real)
            return refuse(out, "open", d);
        free(out->path);
        out->path = real;
        enum hm_err err = open_beside(out, st.st_mode & 0777, d);
        if (!err && fchmod(out->fd, st.st_mode & 0777))
            err = refuse(out, "create", d);
        return err;
    }
    out->fd = open(out->path, O_WRONLY | O_CLOEXEC);
    return out->fd < 0 ? refuse(out, "open", d) : HM_OK;
}

enum hm_err hm_output_open(struct hm_output *out, const char *path, struct hm_diag *d)
{
    bool standard = !strcmp(path, "-");
    *out = (struct hm_output){.fd = standard ? STDOUT_FILENO : -1, .cap = BUFFER};
    out->path = strdup(standard ? "standard output" : path);
    out->buf = hm_alloc(BUFFER, 1);
    enum hm_err err = out->path && out->buf ? HM_OK : hm_fail_memory(d);
    if (!err && !standard)
        err = open_path(out, d);
    if (err)
        hm_output_abandon(out);
    return err;
}

static enum hm_err put(struct hm_output *out, const char *bytes, size_t n, struct hm_diag *d)
{
    while (n > 0) {
        ssize_t part = write(out->fd, bytes, n);
        if (part < 0 && errno == EINTR)
            continue;
        if (part < 0) {
            out->failed = true;
            return refuse(out, "write", d);
        }
        bytes += part;
        n -= (size_t)part;
    }
    return HM_OK;
}

enum hm_err hm_output_flush(struct hm_output *out, struct hm_diag *d)
{
    if (out->failed)
        return hm_fail_line(d, HM_EIO, out->path, 0, "writing failed before");
    size_t n = out->fill;
    out->fill = 0;
    return put(out, out->buf, n, d);
}

enum hm_err hm_output_write(struct hm_output *out, const void *bytes, size_t n, struct hm_diag *d)
{
    if (n > out->cap - out->fill) {
        enum hm_err err = hm_output_flush(out, d);
        if (err)
            return err;
        if (n >= out->cap)
            return put(out, bytes, n, d);
    }
    if (n > 0)
        memcpy(out->buf + out->fill, bytes, n);
    out->fill += n;
    return HM_OK;
}

enum hm_err hm_output_close(struct hm_output *out, struct hm_diag *d)
{
    enum hm_err err = hm_output_flush(out, d);
    if (!err && out->fd > STDERR_FILENO) {
        if (close(out->fd))
            err = refuse(out, "write", d);
        out->fd = -1;
    }
    if (!err && out->beside && rename(out->beside, out->path))
        err = refuse(out, "rename to this", d);
    if (err) {
        hm_output_abandon(out);
        return err;
    }
    release(out);
    return HM_OK;
}

void hm_output_abandon(struct hm_output *out)
{
    if (out->beside)
        unlink(out->beside);
    release(out);
}
