/* hm_reader: objects from one file or pipe, in order, without holding them. Layer 5.
 *
 * Reads the project's streams, text and binary, and recognises by content: bare tables of points,
 * LAS 1.0–1.4, ESRI ASCII grids, GMT multisegment lines, SMS .2dm meshes (hybridmesh(5)).
 *
 *     struct hm_reader *r;
 *     struct hm_header h;
 *     if (hm_reader_open(&r, "-", d)) …
 *     while (!(err = hm_reader_next(r, &h, d))) {
 *         if (h.kind == HM_POINTS)
 *             while (!(err = hm_reader_points(r, rows, 4096, &n, d))) …   // until HM_END
 *         hm_header_free(&h);
 *     }                                                                   // until HM_END
 *     hm_reader_close(r);
 *
 * What is left of an object when hm_reader_next is called again is read and checked, but dropped.
 * Every failure names file and line (text) or file and byte offset (binary).
 */
#ifndef HM_READER_H
#define HM_READER_H

#include "hm_header.h"

struct hm_line;
struct hm_elem;
struct hm_mesh;
struct hm_node;
struct hm_reader;

/* path "-" is standard input. *r is NULL on failure. */
enum hm_err hm_reader_open(struct hm_reader **r, const char *path, struct hm_diag *d);
/* On a descriptor, which is taken over, also on failure; name is for diagnostics. */
enum hm_err hm_reader_open_fd(struct hm_reader **r, int fd, const char *name, struct hm_diag *d);
void hm_reader_close(struct hm_reader *r);

/* A count in a header that disagrees with the data becomes an error (it is ignored otherwise). */
void hm_reader_strict(struct hm_reader *r, bool strict);
/* Threads that the reader may use (else one); what it gives is the same for any number. */
void hm_reader_threads(struct hm_reader *r, int threads);

/* A format of other programs, read whole, for those who ask for it (hm_import). */
struct hm_input;
struct hm_inputs;
struct hm_foreign {
    const char *name;
    /* Do these first bytes of a file, up to 64 KB, look like it? */
    bool (*is)(const char *s, const char *end);
    /* All of it, by one of two: into a mesh that is empty but for an initialised header, or into
     * objects: points, lines and meshes, given in this order. None at all are HM_EFORMAT. */
    enum hm_err (*mesh)(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
    enum hm_err (*objects)(struct hm_input *in, struct hm_inputs *objects, struct hm_diag *d);
};

/* The format of that list in which the object just given stands; NULL: none of them. */
const struct hm_foreign *hm_reader_found(const struct hm_reader *r);

/* Recognise these as well, before all others but the project's own; the list ends with a NULL
 * name. */
void hm_reader_foreign(struct hm_reader *r, const struct hm_foreign *list);

/* Go on to the next object and give its header, which the caller frees. HM_END behind the last. An
 * input without any object is HM_EFORMAT ("empty"). */
enum hm_err hm_reader_next(struct hm_reader *r, struct hm_header *h, struct hm_diag *d);

/* Up to `max` points: nfields doubles each, x y z first, to rows[]; *n says how many. x and y are
 * finite, z may be NaN (missing). HM_END, with *n = 0, behind the last point. */
enum hm_err hm_reader_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                             struct hm_diag *d);

/* The next row of a grid: nx nodes, their bands side by side (nfields - 2 doubles a node). */
enum hm_err hm_reader_row(struct hm_reader *r, double *row, struct hm_diag *d);

/* The next line. Its pointers are the reader's, and hold until its next call. */
enum hm_err hm_reader_line(struct hm_reader *r, struct hm_line *line, struct hm_diag *d);

/* The whole mesh, into an empty *mesh (without its header). */
enum hm_err hm_reader_mesh(struct hm_reader *r, struct hm_mesh *mesh, struct hm_diag *d);

/* The name that diagnostics use: the path, or "standard input". */
const char *hm_reader_name(const struct hm_reader *r);

/* A node, and an element of the numbers of its corners (three or four) and its region, from
 * outside. Return NULL, or what is wrong with them. */
const char *hm_reader_make_node(struct hm_node *node, const double xyz[3], int64_t flags,
                                int64_t owner);
const char *hm_reader_make_elem(struct hm_elem *elem, const int64_t *numbers, int corners,
                                size_t nnodes);

#endif
