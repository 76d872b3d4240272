/* hm_data: the four kinds held in memory. Layer 3, on reader and writer.
 *
 * Each container begins life as `= {0}`, owns what its pointers hold, and is emptied by its free
 * function. The read functions expect that hm_reader_next has just given `h`, which they take over
 * (on failure as well: the caller frees the container, never h). Write functions write one object.
 */
#ifndef HM_DATA_H
#define HM_DATA_H

#include "hm_header.h"
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

/* Mesh. Elements are counter-clockwise; node[3] is -1 in a triangle. */
enum hm_node_flag {
    HM_NODE_BOUNDARY = 1,  /* on the boundary of the mesh */
    HM_NODE_BREAKLINE = 2, /* on a breakline */
    HM_NODE_FIXED = 4      /* must not be moved */
};
struct hm_node {
    double x, y, z; /* metres; z may be NaN only before heights are known */
    int32_t flags;  /* hm_node_flag bits */
    int32_t owner;  /* 0, or the number of the regular mesh that the node belongs to */
};
struct hm_elem {
    int32_t node[4];
    int32_t region; /* material number, 0 or more */
};
struct hm_mesh {
    struct hm_header header; /* keys name, role: regular, irregular or hybrid */
    struct hm_node *node;
    size_t nnodes, node_cap; /* at most INT32_MAX */
    struct hm_elem *elem;
    size_t nelems, elem_cap;
};
static inline int hm_elem_corners(const struct hm_elem *e)
{
    return e->node[3] < 0 ? 3 : 4;
}
enum hm_err hm_mesh_read(struct hm_mesh *m, struct hm_reader *r, struct hm_header *h,
                         struct hm_diag *d);
enum hm_err hm_mesh_write(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_mesh_add_node(struct hm_mesh *m, struct hm_node node, struct hm_diag *d);
enum hm_err hm_mesh_add_elem(struct hm_mesh *m, struct hm_elem elem, struct hm_diag *d);
void hm_mesh_free(struct hm_mesh *m);

#endif
