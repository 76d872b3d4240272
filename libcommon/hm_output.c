#define _GNU_SOURCE /* O_TMPFILE, realpath */

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

/* A name beside out->path that may be free, the i-th. */
static enum hm_err name_beside(struct hm_output *out, int i, struct hm_diag *d)
{
    size_t size = strlen(out->path) + 64;
    if (!out->beside && !(out->beside = hm_alloc(size, 1)))
        return hm_fail_memory(d);
    snprintf(out->beside, size, "%s.part%ld.%d", out->path, (long)getpid(), i);
    return HM_OK;
}

static void forget_beside(struct hm_output *out)
{
    free(out->beside);
    out->beside = NULL;
}

enum { NAME_TRIES = 1000 };

/* A file under a name of its own beside out->path, for file systems that know no other. */
static enum hm_err open_beside(struct hm_output *out, mode_t mode, struct hm_diag *d)
{
    for (int i = 0; i < NAME_TRIES; i++) {
        enum hm_err err = name_beside(out, i, d);
        if (err)
            return err;
        out->fd = open(out->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (out->fd >= 0 || errno != EEXIST)
            break;
    }
    if (out->fd >= 0)
        return HM_OK;
    forget_beside(out);
    return refuse(out, "create", d);
}

/* Where the system shows the open file, so that it can be linked to a name. */
static void show_nameless(const struct hm_output *out, char shown[32])
{
    snprintf(shown, 32, "/proc/self/fd/%d", out->fd);
}

/* A file in the folder of out->path that has no name as yet: should the program be killed, nothing
 * of it is left. */
static enum hm_err open_new(struct hm_output *out, mode_t mode, struct hm_diag *d)
{
    char *folder = strdup(out->path), shown[32];
    if (!folder)
        return hm_fail_memory(d);
    char *slash = strrchr(folder, '/');
    if (slash)
        slash[1] = '\0';
    out->fd = open(slash ? folder : ".", O_WRONLY | O_TMPFILE | O_CLOEXEC, mode);
    free(folder);
    show_nameless(out, shown);
    if (out->fd >= 0 && !access(shown, F_OK)) {
        out->nameless = true;
        return HM_OK;
    }
    if (out->fd >= 0)
        close(out->fd);
    return open_beside(out, mode, d);
}

/* Link the file without name to one beside out->path: only a renaming can replace a file. */
static enum hm_err give_name(struct hm_output *out, struct hm_diag *d)
{
    char shown[32];
    show_nameless(out, shown);
    for (int i = 0; i < NAME_TRIES; i++) {
        enum hm_err err = name_beside(out, i, d);
        if (err)
            return err;
        if (!linkat(AT_FDCWD, shown, AT_FDCWD, out->beside, AT_SYMLINK_FOLLOW))
            return HM_OK;
        if (errno != EEXIST)
            break;
    }
    forget_beside(out);
    return refuse(out, "create", d);
}

static enum hm_err open_path(struct hm_output *out, struct hm_diag *d)
{
    struct stat st;
    if (stat(out->path, &st))
        return errno == ENOENT ? open_new(out, 0666, d) : refuse(out, "open", d);
    if (S_ISREG(st.st_mode)) {
        if (access(out->path, W_OK))
            return refuse(out, "write", d);
        char *real = realpath(out->path, NULL); /* through a link, so that the link stays */
        if (!real)
            return refuse(out, "open", d);
        free(out->path);
        out->path = real;
        enum hm_err err = open_new(out, st.st_mode & 0777, d);
        if (!err && fchmod(out->fd, st.st_mode & 0777))
            err = refuse(out, "create", d);
        return err;
    }
    out->fd = open(out->path, O_WRONLY | O_CLOEXEC);
    return out->fd < 0 ? refuse(out, "open", d) : HM_OK;
}

static enum hm_err begin(struct hm_output *out, int fd, const char *name, struct hm_diag *d)
{
    *out = (struct hm_output){.fd = fd, .cap = BUFFER};
    out->path = strdup(name);
    out->buf = hm_alloc(BUFFER, 1);
    return out->path && out->buf ? HM_OK : hm_fail_memory(d);
}

enum hm_err hm_output_open(struct hm_output *out, const char *path, struct hm_diag *d)
{
    bool standard = !strcmp(path, "-");
    enum hm_err err =
        begin(out, standard ? STDOUT_FILENO : -1, standard ? "standard output" : path, d);
    if (!err && !standard)
        err = open_path(out, d);
    if (err)
        hm_output_abandon(out);
    return err;
}

enum hm_err hm_output_open_fd(struct hm_output *out, int fd, const char *name, struct hm_diag *d)
{
    enum hm_err err = begin(out, fd, name, d);
    if (err)
        hm_output_abandon(out);
    return err;
}

enum hm_err hm_output_check(const char *path, struct hm_diag *d)
{
    struct stat st;
    const char *why = NULL;
    if (!strcmp(path, "-"))
        return HM_OK;
    if (!stat(path, &st)) {
        why = S_ISDIR(st.st_mode) ? strerror(EISDIR) : access(path, W_OK) ? strerror(errno) : NULL;
    } else if (errno != ENOENT) {
        why = strerror(errno);
    } else {
        char *folder = strdup(path), *slash = folder ? strrchr(folder, '/') : NULL;
        if (!folder)
            return hm_fail_memory(d);
        if (slash)
            slash[1] = '\0';
        if (access(slash ? folder : ".", W_OK | X_OK))
            why = strerror(errno);
        free(folder);
    }
    return why ? hm_fail_line(d, HM_EIO, path, 0, "cannot write: %s", why) : HM_OK;
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

/* Some file systems (NFS, quotas) tell only when a file is closed that they could not take it.
 * Standard output is not ours to close; a copy of it does as well. */
static enum hm_err close_checked(struct hm_output *out, struct hm_diag *d)
{
    int fd = out->fd;
    if (fd > STDERR_FILENO)
        out->fd = -1;
    else if ((fd = dup(fd)) < 0)
        return refuse(out, "write", d);
    return close(fd) ? refuse(out, "write", d) : HM_OK;
}

enum hm_err hm_output_close(struct hm_output *out, struct hm_diag *d)
{
    enum hm_err err = hm_output_flush(out, d);
    if (!err && out->nameless)
        err = give_name(out, d);
    if (!err)
        err = close_checked(out, d);
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
