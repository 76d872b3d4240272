/* hm_base: errors, diagnostics and memory. Layer 0.
 *
 * The library computes; it never prints and never exits. A function that can fail returns an
 * enum hm_err and, when it does fail, describes the failure in the struct hm_diag that its caller
 * owns. Tools turn that into one line on standard error (hm_cli).
 */
#ifndef HM_BASE_H
#define HM_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum hm_err {
    HM_OK = 0,
    HM_END,     /* nothing more to read; not a failure, sets no diagnostic */
    HM_ENOMEM,  /* memory exhausted, or a size that cannot be represented */
    HM_EIO,     /* the system refused to open, read or write */
    HM_EFORMAT, /* input is not what it claims to be */
    HM_ETRUNC,  /* input stops before its end mark */
    HM_EGEOM,   /* coordinates with which the operation is impossible */
    HM_EARG     /* an argument outside its range */
};

enum { HM_DIAG_TEXT = 384, HM_DIAG_SOURCE = 256 };

/* What went wrong and where. Clear with `= {0}`; a diagnostic once set is kept, so that the first
 * cause wins. */
struct hm_diag {
    enum hm_err err;
    char source[HM_DIAG_SOURCE]; /* file name, or "" */
    int64_t line;                /* line of source, from 1; 0 when it has none */
    bool has_place;              /* x, y are the offending place, in the data's coordinates */
    double x, y;
    char text[HM_DIAG_TEXT]; /* one sentence without source, line or place */
};

/* Set d (which may be NULL) unless it is set already, and return err: `return hm_fail(d, …);` */
enum hm_err hm_fail(struct hm_diag *d, enum hm_err err, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
enum hm_err hm_fail_at(struct hm_diag *d, enum hm_err err, double x, double y, const char *format,
                       ...) __attribute__((format(printf, 5, 6)));
enum hm_err hm_fail_line(struct hm_diag *d, enum hm_err err, const char *source, int64_t line,
                         const char *format, ...) __attribute__((format(printf, 5, 6)));
enum hm_err hm_fail_memory(struct hm_diag *d);
/* Give the error in d, if there is one, the place x, y, unless it has one already. Returns err. */
enum hm_err hm_fail_place(struct hm_diag *d, enum hm_err err, double x, double y);

/* malloc(count * size), or NULL when that overflows or memory is short. count 0 gives a block that
 * can be freed. hm_alloc0 clears it. */
void *hm_alloc(size_t count, size_t size);
void *hm_alloc0(size_t count, size_t size);

/* Make room for `need` items of `size` bytes in the array that items points to (a T **), of
 * capacity *cap, growing by half at least. On failure false, with *items and *cap as they were.
 *
 *     if (!hm_grow(&a, &cap, n + 1, sizeof *a))
 *         return hm_fail_memory(d);
 *     a[n++] = item;
 */
bool hm_grow(void *items, size_t *cap, size_t need, size_t size);

#endif
