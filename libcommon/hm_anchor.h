/* hm_anchor: lattices whose nodes lie at whole multiples of the spacing. Layer 3.
 *
 * Node number i lies at i * spacing, whatever window of the lattice is in use, so that two runs
 * over neighbouring windows have the same nodes.
 */
#ifndef HM_ANCHOR_H
#define HM_ANCHOR_H

#include "hm_header.h"

struct hm_anchor {
    double spacing; /* metres */
    int64_t i0, j0; /* numbers of the first column and row */
    size_t nx, ny;
};

/* The nodes within the box w, e, s, n (metres, border included, to a billionth of the spacing).
 * HM_EARG when there are none, or too many to number. */
enum hm_err hm_anchor_within(struct hm_anchor *a, double spacing, const double box[4],
                             struct hm_diag *d);

/* The nodes whose cells (one spacing wide, the node in the middle) reach into the box. */
enum hm_err hm_anchor_touching(struct hm_anchor *a, double spacing, const double box[4],
                               struct hm_diag *d);

/* Grow on all sides by so many cells. */
void hm_anchor_grow(struct hm_anchor *a, int64_t cells);

/* The same nodes as a grid's header says them. */
struct hm_lattice hm_anchor_lattice(const struct hm_anchor *a);

#endif
