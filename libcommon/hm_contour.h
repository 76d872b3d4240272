/* hm_contour: breaklines, the borders of what is steeper than a limit, row by row. Layer 6.
 *
 * A node is steep when its slope is >= the limit. On every edge of the grid between a steep node
 * and one that is not lies a crossing (the paper's equation 8); within a cell the crossings are
 * linked, and the cells are linked by the edges that they share. The steep side is on the left.
 */
#ifndef HM_CONTOUR_H
#define HM_CONTOUR_H

#include "hm_chain.h"

enum hm_contour_mode {
    HM_CONTOUR_INTERPOLATE, /* crossings by linear interpolation */
    HM_CONTOUR_NODE         /* crossings at the steep node: the border of the steep nodes */
};

/* What becomes of a cell's crossings. A cell with four is a saddle; when the mean of its corners is
 * steep the steep corners hold together, else the others. */
enum hm_contour_saddle {
    HM_CONTOUR_SPLIT, /* they are the vertices */
    HM_CONTOUR_MEAN   /* their mean is the vertex, one a cell (the paper) */
};

struct hm_contour_rule {
    double limit; /* in the unit of the slopes */
    enum hm_contour_mode mode;
    enum hm_contour_saddle saddle;
    enum hm_err (*take)(void *arg, const struct hm_line *line,
                        struct hm_diag *d); /* see hm_chain */
    void *arg;
};

struct hm_contour;

enum hm_err hm_contour_new(struct hm_contour **c, const struct hm_lattice *l,
                           const struct hm_contour_rule *rule, struct hm_diag *d);
void hm_contour_free(struct hm_contour *c);

/* Add the next row: nx slopes and heights. A node whose slope is NaN has no cells around it: lines
 * end there. The rows must stay until the next call. */
enum hm_err hm_contour_row(struct hm_contour *c, const double *slope, const double *z,
                           struct hm_diag *d);

/* Append boxes around the open lines: hm_chain_open. */
enum hm_err hm_contour_open(const struct hm_contour *c, struct hm_box **box, size_t *n, size_t *cap,
                            struct hm_diag *d);

/* Behind the last row: hand out the lines that are still open. */
enum hm_err hm_contour_end(struct hm_contour *c, struct hm_diag *d);

#endif
