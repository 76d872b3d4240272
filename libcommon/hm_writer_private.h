/* hm_writer_private: what the two forms of the writer, text and blocks, share. Layer 5. */
#ifndef HM_WRITER_PRIVATE_H
#define HM_WRITER_PRIVATE_H

#include "hm_attr.h"
#include "hm_headio.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_output.h"
#include "hm_writer.h"

/* The header is written already; each function appends to w->out. attrs agree with line->closed. */
struct hm_writer_form {
    enum hm_err (*begin)(struct hm_writer *w, struct hm_diag *d);
    enum hm_err (*points)(struct hm_writer *w, const double *rows, size_t n, struct hm_diag *d);
    enum hm_err (*row)(struct hm_writer *w, const double *row, struct hm_diag *d);
    enum hm_err (*line)(struct hm_writer *w, const struct hm_line *line, const char *attrs,
                        struct hm_diag *d);
    enum hm_err (*mesh)(struct hm_writer *w, const struct hm_mesh *m, struct hm_diag *d);
    enum hm_err (*end)(struct hm_writer *w, struct hm_diag *d);
};

extern const struct hm_writer_form hm_writer_text;
extern const struct hm_writer_form hm_writer_blocks;

struct hm_writer {
    struct hm_output out;
    struct hm_format format;

    /* the object being written */
    enum hm_kind kind; /* 0 between objects */
    const struct hm_writer_form *form;
    size_t nfields;
    struct hm_lattice lattice;
    int64_t records; /* as they are counted behind its end */
    int64_t rows;    /* of a grid, written so far */

    /* text grids: x of column i, and a blank, is columns[column_end[i-1] .. column_end[i]) */
    char *columns;
    size_t *column_end;
    size_t columns_cap, column_end_cap;

    /* blocks: the records of the block that is being filled */
    char *block;
    size_t block_cap, block_n, record;
};

#endif
