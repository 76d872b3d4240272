/* hm_sizes: how large the elements of an irregular mesh may be, place by place. Layer 6. */
#ifndef HM_SIZES_H
#define HM_SIZES_H

#include "hm_domain.h"
#include "hm_grid.h"

/* Zero is "any size" everywhere. */
struct hm_sizes {
    const struct hm_domain *dom;
    double max_area;            /* m², where a zone has none of its own */
    double max_edge;            /* m: no edge is longer */
    const struct hm_grid *grid; /* m: longest edges asked for, in a band of a grid; or NULL */
    size_t band;
};

/* The area of a triangle with three equal sides of a length. */
double hm_sizes_equilateral(double length);

/* Prepare the band of a grid: sizes grow by no more than `growth` a unit of the way, so that one
 * who looks at the centre of a large element sees small sizes in it. NaN stays NaN (any size) only
 * where there is none at all. HM_EARG, with the place, for a size that is not above 0. */
enum hm_err hm_sizes_limit(struct hm_grid *grid, size_t band, double growth, struct hm_diag *d);

/* The largest area at x, y in a region of the triangulated domain, m², or 0. Of a zone or
 * everywhere, and of the grid where that is smaller. `sizes` is a const struct hm_sizes *, as
 * hm_tri_quality wants it. */
double hm_sizes_area(void *sizes, double x, double y, int32_t region);

/* Is the largest area max_area everywhere? */
bool hm_sizes_are_equal(const struct hm_sizes *s);

/* About how many nodes they make on the triangulated domain. */
double hm_sizes_nodes(const struct hm_sizes *s);

#endif
