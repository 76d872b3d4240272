/* stream: what the tests of streams share: files, and copying every object of one to another. */
#ifndef STREAM_H
#define STREAM_H

#include "hm_data.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[64], copy[80], again[96];

/* The bytes of a file, 0-terminated; *n without the 0. */
static char *slurp(const char *name, size_t *n)
{
    FILE *f = fopen(name, "rb");
    static char bytes[1 << 22];
    *n = f ? fread(bytes, 1, sizeof bytes - 1, f) : 0;
    bytes[*n] = '\0';
    if (f)
        fclose(f);
    return bytes;
}

static void spill(const char *name, const char *bytes, size_t n)
{
    FILE *f = fopen(name, "wb");
    if (!f || fwrite(bytes, 1, n, f) != n || fclose(f))
        exit(99);
}

/* Read one object by kind and write it again. */
static enum hm_err copy_object(struct hm_reader *r, struct hm_header *h, struct hm_writer *w,
                               struct hm_diag *d)
{
    struct hm_points points = {0};
    struct hm_grid grid = {0};
    struct hm_lines lines = {0};
    struct hm_mesh mesh = {0};
    enum hm_err err;
    switch (h->kind) {
    case HM_POINTS:
        err = hm_points_read(&points, r, h, d);
        err = err ? err : hm_points_write(&points, w, d);
        break;
    case HM_GRID:
        err = hm_grid_read(&grid, r, h, d);
        err = err ? err : hm_grid_write(&grid, w, d);
        break;
    case HM_LINES:
        err = hm_lines_read(&lines, r, h, d);
        err = err ? err : hm_lines_write(&lines, w, d);
        break;
    default:
        err = hm_mesh_read(&mesh, r, h, d);
        err = err ? err : hm_mesh_write(&mesh, w, d);
    }
    hm_points_free(&points);
    hm_grid_free(&grid);
    hm_lines_free(&lines);
    hm_mesh_free(&mesh);
    return err;
}

/* Copy every object of one file to another, in a format. */
static enum hm_err convert(const char *from, const char *to, struct hm_format format, bool strict,
                           struct hm_diag *d)
{
    struct hm_reader *r = NULL;
    struct hm_writer *w = NULL;
    struct hm_header h;
    *d = (struct hm_diag){0};
    enum hm_err err = hm_reader_open(&r, from, d);
    if (!err)
        err = hm_writer_open(&w, to, format, d);
    if (!err)
        hm_reader_strict(r, strict);
    while (!err && !(err = hm_reader_next(r, &h, d)))
        err = copy_object(r, &h, w, d);
    if (err == HM_END)
        err = hm_writer_close(&w, d);
    hm_writer_abandon(w);
    hm_reader_close(r);
    return err;
}

static const struct hm_format text = {0}, blocks = {.binary = true};

/* Reading must fail just so. */
static void refused(const char *what, const char *bytes, size_t n, enum hm_err want, int64_t line,
                    const char *words)
{
    struct hm_diag d;
    spill(path, bytes, n);
    unlink(copy);
    enum hm_err err = convert(path, copy, text, false, &d);
    bool pass = err == want && d.line == line && strstr(d.text, words);
    if (!ok(pass, "%s: refused", what))
        printf("# got %d line %lld: %s\n", err, (long long)d.line, d.text);
    ok(access(copy, F_OK) != 0, "%s: nothing written", what);
}

static void refused_text(const char *what, const char *bytes, enum hm_err want, int64_t line,
                         const char *words)
{
    refused(what, bytes, strlen(bytes), want, line, words);
}

static void begin_files(void)
{
    snprintf(path, sizeof path, "/tmp/hm-stream-%ld", (long)getpid());
    snprintf(copy, sizeof copy, "%s.copy", path);
    snprintf(again, sizeof again, "%s.again", path);
}

static void end_files(void)
{
    unlink(path);
    unlink(copy);
    unlink(again);
}

#endif
