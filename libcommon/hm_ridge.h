/* hm_ridge: crests and toes as ridges of curvature, row by row. Layer 6.
 *
 * The curvature of a node is the eigenvalue of larger size of the second derivatives of the heights
 * (smoothed by 1 : 4 : 6 : 4 : 1 in rows and columns), divided by (1 + slope²)^(3/2); across is its
 * eigenvector. On a bank that is the curvature along the fall, its profile; but it holds on the top
 * of a levee and at the bottom of a ditch, too, where there is no fall. Where its size is largest
 * across, and over the limit, runs a crest (convex) or a toe (concave).
 *
 * On every edge of the grid over which the derivative of the curvature across changes its sign lies
 * a crossing; a cell with two is linked, and cells by the edges that they share.
 */
#ifndef HM_RIDGE_H
#define HM_RIDGE_H

#include "hm_chain.h"

enum hm_ridge_kind { HM_RIDGE_CREST, HM_RIDGE_TOE, HM_RIDGE_KINDS };

struct hm_ridge_rule {
    double limit; /* curvature, 1/m */
    enum hm_err (*take)(void *arg, const struct hm_line *line,
                        struct hm_diag *d); /* see hm_chain */
    void *arg[HM_RIDGE_KINDS];
};

struct hm_ridge;

enum hm_err hm_ridge_new(struct hm_ridge **r, const struct hm_lattice *l,
                         const struct hm_ridge_rule *rule, struct hm_diag *d);
void hm_ridge_free(struct hm_ridge *r);

/* Add the next row of heights. Lines end some four nodes before the border and before nodata. */
enum hm_err hm_ridge_row(struct hm_ridge *r, const double *z, struct hm_diag *d);

/* Append boxes around the open lines: hm_chain_open. They go on HM_RIDGE_LAG rows before the
 * newest. */
enum { HM_RIDGE_LAG = 5 };
enum hm_err hm_ridge_open(const struct hm_ridge *r, struct hm_box **box, size_t *n, size_t *cap,
                          struct hm_diag *d);

/* Behind the last row: hand out the lines that are still open. */
enum hm_err hm_ridge_end(struct hm_ridge *r, struct hm_diag *d);

#endif
