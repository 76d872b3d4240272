/* hm_writer: objects to one file or pipe. Layer 5.
 *
 *     hm_writer_open(&w, "-", (struct hm_format){.binary = true}, d);
 *     hm_writer_begin(w, &header, d);
 *     hm_writer_points(w, rows, n, d);        // as often as wanted
 *     hm_writer_end(w, d);                    // `#end`: only now does the object count as whole
 *     hm_writer_close(&w, d);                 // flushes; a full disk is noticed here at the latest
 */
#ifndef HM_WRITER_H
#define HM_WRITER_H

#include "hm_header.h"

struct hm_line;
struct hm_mesh;
struct hm_writer;

struct hm_format {
    bool binary;  /* f64le instead of text */
    bool single;  /* f32le; with binary, grids only */
    int decimals; /* text: places behind the point, 1 .. 17; 0: the shortest exact form. Meshes
                     refuse anything but 0 */
};

/* path "-" is standard output. A regular file gets its name from hm_writer_close, so that an input
 * may be overwritten and a failure leaves nothing. */
enum hm_err hm_writer_open(struct hm_writer **w, const char *path, struct hm_format format,
                           struct hm_diag *d);
/* On a descriptor, which is taken over, also on failure; name is for diagnostics. */
enum hm_err hm_writer_open_fd(struct hm_writer **w, int fd, const char *name,
                              struct hm_format format, struct hm_diag *d);
enum hm_err hm_writer_begin(struct hm_writer *w, const struct hm_header *h, struct hm_diag *d);
enum hm_err hm_writer_points(struct hm_writer *w, const double *rows, size_t n, struct hm_diag *d);
enum hm_err hm_writer_row(struct hm_writer *w, const double *row, struct hm_diag *d);
enum hm_err hm_writer_line(struct hm_writer *w, const struct hm_line *line, struct hm_diag *d);
enum hm_err hm_writer_mesh(struct hm_writer *w, const struct hm_mesh *mesh, struct hm_diag *d);
enum hm_err hm_writer_end(struct hm_writer *w, struct hm_diag *d);

/* Bytes of a foreign format (hmconv, hmdraw, reports), outside any object. */
enum hm_err hm_writer_bytes(struct hm_writer *w, const void *bytes, size_t n, struct hm_diag *d);
enum hm_err hm_writer_printf(struct hm_writer *w, struct hm_diag *d, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Flush, rename, close and free; *w becomes NULL whatever happens. */
enum hm_err hm_writer_close(struct hm_writer **w, struct hm_diag *d);

/* Give up: free without finishing; a regular file is removed. NULL is allowed. */
void hm_writer_abandon(struct hm_writer *w);

#endif
