/* hm_reader_private: what the parts of the reader share. Layer 5.
 *
 * A form is one way in which objects are written: the project's text, its blocks, or a foreign
 * format. hm_reader.c recognises it and calls its functions; these read, check what they read, set
 * `ended` when they have seen the end of the object, and then return HM_END.
 */
#ifndef HM_READER_PRIVATE_H
#define HM_READER_PRIVATE_H

#include "hm_headio.h"
#include "hm_input.h"
#include "hm_inputs.h"
#include "hm_line.h"
#include "hm_mesh.h"
#include "hm_reader.h"

#include <float.h>
#include <math.h>

struct hm_reader_form {
    /* Recognised: make the header, which is empty, and `state`. */
    enum hm_err (*begin)(struct hm_reader *r, struct hm_header *h, struct hm_diag *d);
    /* As hm_reader_points and so on; those that the form's kind needs. A line goes to r->attrs and
     * r->xyz, and is closed by its attribute or by its last vertex. */
    enum hm_err (*points)(struct hm_reader *r, double *rows, size_t max, size_t *n,
                          struct hm_diag *d);
    enum hm_err (*row)(struct hm_reader *r, double *row, struct hm_diag *d);
    enum hm_err (*line)(struct hm_reader *r, struct hm_diag *d);
    enum hm_err (*mesh)(struct hm_reader *r, struct hm_mesh *m, struct hm_diag *d);
    void (*free)(void *state); /* NULL: plain free() */
};

struct hm_reader {
    struct hm_input in;
    bool strict;
    int threads;
    bool any;                         /* an object was found */
    const struct hm_foreign *foreign; /* formats known besides, or NULL */
    const struct hm_foreign *found;   /* that of this object */
    struct hm_inputs whole;           /* what a foreign file held, */
    size_t whole_given;               /* and how many of its objects were given */

    /* the object being read */
    const struct hm_reader_form *form; /* NULL between objects */
    enum hm_kind kind;
    size_t nfields;
    struct hm_lattice lattice;
    int64_t announced; /* `#count`; -1 when not said */
    int64_t counted;   /* the count behind the end; -1 when not said */
    int64_t records;   /* points, nodes of a grid, lines, or nodes and elements read so far */
    int64_t rows;      /* rows of a grid given so far */
    bool ended;
    void *state; /* the form's own */

    /* the line being read, and room for a row */
    char *attrs;
    size_t attrs_cap;
    double *xyz;
    size_t xyz_n, xyz_cap; /* doubles */
    double *row;
    size_t row_cap;
    struct hm_reader_plain *plain; /* many lines at once; NULL until needed */
};

extern const struct hm_reader_form hm_reader_text;  /* the project's text */
extern const struct hm_reader_form hm_reader_table; /* bare points */
extern const struct hm_reader_form hm_reader_gmt;   /* GMT multisegment lines */
extern const struct hm_reader_form hm_reader_las;
extern const struct hm_reader_form hm_reader_ascii_grid;
extern const struct hm_reader_form hm_reader_2dm;
extern const struct hm_reader_form hm_reader_whole; /* r->found, and r->whole */

/* Are there objects of a foreign file that have not been given? */
bool hm_reader_has_whole(const struct hm_reader *r);

/* Does the input begin with a key of an ESRI ASCII grid? */
bool hm_reader_is_ascii_grid(const char *s, const char *end);

/* The project's binary: r->form becomes it, once hm_reader_text has read the header. */
enum hm_err hm_reader_begin_blocks(struct hm_reader *r, enum hm_encoding encoding,
                                   struct hm_diag *d);

/* Read up to max points to the rows behind the *n that are there, as far as lines come that hold
 * nothing but their numbers, between blanks; on the reader's threads, and with a single one none.
 */
enum hm_err hm_reader_plain_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                                   struct hm_diag *d);
void hm_reader_free_plain(struct hm_reader *r);

/* Append to the line being read. */
enum hm_err hm_reader_add_vertex(struct hm_reader *r, const double xyz[3], struct hm_diag *d);
enum hm_err hm_reader_set_attrs(struct hm_reader *r, const char *s, size_t n, struct hm_diag *d);

/* Can a point be here? x and y must be finite, z must not be infinite. */
static inline bool hm_reader_good_place(const double *xyz)
{
    return fabs(xyz[0]) <= DBL_MAX && fabs(xyz[1]) <= DBL_MAX && !(fabs(xyz[2]) > DBL_MAX);
}
/* Why it cannot. */
const char *hm_reader_bad_place(const double *xyz);

#endif
