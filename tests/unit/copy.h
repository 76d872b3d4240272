/* copy: files, and copying every object of one stream to another; for the tests of streams and the
 * fuzz target of the reader. */
#ifndef COPY_H
#define COPY_H

#include "hm_data.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 1 << 22 }; /* bytes of a file, at most */

static char path[64], copy[80], again[96];

/* The bytes of a file, 0-terminated; *n without the 0. */
static char *slurp(const char *name, size_t *n)
{
    FILE *f = fopen(name, "rb");
    static char bytes[MOST];
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

static void begin_files(void)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%.40s/hm-%ld", folder ? folder : "/tmp", (long)getpid());
    snprintf(copy, sizeof copy, "%s.copy", path);
    snprintf(again, sizeof again, "%s.again", path);
}

static void end_files(void)
{
    unlink(path);
    unlink(copy);
    unlink(again);
}

/* Whatever the bytes are: when they can be read, what is written of them must come back the same,
 * as text and through blocks. */
__attribute__((unused)) static bool comes_back(const char *bytes, size_t n)
{
    struct hm_diag d;
    size_t m, k;
    spill(path, bytes, n);
    if (convert(path, copy, text, false, &d))
        return d.text[0] != '\0'; /* refused, and says why */
    if (convert(copy, path, blocks, true, &d) || convert(path, again, text, true, &d))
        return false;
    char *first = malloc(MOST);
    memcpy(first, slurp(copy, &m), MOST);
    const char *second = slurp(again, &k);
    bool same = m == k && !memcmp(first, second, m);
    free(first);
    return same;
}

#endif
