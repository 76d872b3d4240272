/* hm_data: the four kinds held in memory. Layer 3, on reader and writer.
 *
 * Each container begins life as `= {0}`, owns what its pointers hold, and is emptied by its free
 * function. The read functions expect that hm_reader_next has just given `h`, which they take over
 * (on failure as well: the caller frees the container, never h). Write functions write one object.
 */
#ifndef HM_DATA_H
#define HM_DATA_H

#include "hm_header.h"
#include "hm_mesh.h"
#include "hm_reader.h"
#include "hm_writer.h"

/* Points: row i is v[i*stride .. ), x y z first, stride = header.nfields. */
struct hm_points {
    struct hm_header header;
    double *v;
    size_t n, cap, stride;
};
enum hm_err hm_points_read(struct hm_points *p, struct hm_reader *r, struct hm_header *h,
                           struct hm_diag *d);
enum hm_err hm_points_write(const struct hm_points *p, struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_points_append(struct hm_points *p, const double *row, struct hm_diag *d);
void hm_points_free(struct hm_points *p);

/* Grid: band b of node (i, j) is v[(j*nx + i)*bands + b]; band 0 is z unless fields say otherwise;
 * NaN is nodata. */
struct hm_grid {
    struct hm_header header;
    double *v;
    size_t bands;
};
enum hm_err hm_grid_init(struct hm_grid *g, struct hm_header *h, struct hm_diag *d); /* all NaN */
enum hm_err hm_grid_read(struct hm_grid *g, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d);
enum hm_err hm_grid_write(const struct hm_grid *g, struct hm_writer *w, struct hm_diag *d);
void hm_grid_free(struct hm_grid *g);

/* Lines: each owns its attributes and vertices. */
struct hm_lines {
    struct hm_header header;
    struct hm_line *line;
    size_t n, cap;
};
enum hm_err hm_lines_read(struct hm_lines *l, struct hm_reader *r, struct hm_header *h,
                          struct hm_diag *d);
enum hm_err hm_lines_write(const struct hm_lines *l, struct hm_writer *w, struct hm_diag *d);
/* Append a copy of line. */
enum hm_err hm_lines_append(struct hm_lines *l, const struct hm_line *line, struct hm_diag *d);
void hm_lines_free(struct hm_lines *l);

/* Mesh: see hm_mesh.h. */
enum hm_err hm_mesh_read(struct hm_mesh *m, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d);
enum hm_err hm_mesh_write(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

#endif
