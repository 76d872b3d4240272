#include "hm_anchor.h"

#include <math.h>

/* Beyond this a double cannot tell neighbouring nodes apart. */
static const double farthest = 1e15;

/* More nodes than any machine holds: a stray point far off, or a spacing in the wrong unit. */
static const double most_nodes = 1e11;

/* Numbers of the first and last node in [low, high], counted in nodes. */
static bool span(double low, double high, int64_t *first, size_t *count)
{
    if (!(fabs(low) < farthest && fabs(high) < farthest && low <= high))
        return false;
    *first = (int64_t)low;
    *count = (size_t)(high - low) + 1;
    return true;
}

static enum hm_err make(struct hm_anchor *a, const double range[4], struct hm_diag *d)
{
    if (!span(range[0], range[1], &a->i0, &a->nx) || !span(range[2], range[3], &a->j0, &a->ny))
        return hm_fail(d, HM_EARG, "no node of a lattice with spacing %g lies there", a->spacing);
    if ((double)a->nx * (double)a->ny > most_nodes)
        return hm_fail(
            d, HM_EARG,
            "a grid of %zu x %zu nodes is too large: choose a window or a larger spacing", a->nx,
            a->ny);
    return HM_OK;
}

enum hm_err hm_anchor_within(struct hm_anchor *a, double spacing, const double box[4],
                             struct hm_diag *d)
{
    const double near = 1e-9; /* 0.7 / 0.1 is 6.999…: a node meant to be on the border is inside */
    *a = (struct hm_anchor){.spacing = spacing};
    double range[4];
    for (int k = 0; k < 4; k += 2) {
        range[k] = ceil(box[k] / spacing - near);
        range[k + 1] = floor(box[k + 1] / spacing + near);
    }
    return make(a, range, d);
}

enum hm_err hm_anchor_touching(struct hm_anchor *a, double spacing, const double box[4],
                               struct hm_diag *d)
{
    *a = (struct hm_anchor){.spacing = spacing};
    double range[4];
    for (int k = 0; k < 4; k++)
        range[k] = floor(box[k] / spacing + 0.5);
    return make(a, range, d);
}

void hm_anchor_grow(struct hm_anchor *a, int64_t cells)
{
    a->i0 -= cells;
    a->j0 -= cells;
    a->nx += 2 * (size_t)cells;
    a->ny += 2 * (size_t)cells;
}

struct hm_lattice hm_anchor_lattice(const struct hm_anchor *a)
{
    return (struct hm_lattice){.nx = (int64_t)a->nx,
                               .ny = (int64_t)a->ny,
                               .x0 = (double)a->i0 * a->spacing,
                               .y0 = (double)a->j0 * a->spacing,
                               .dx = a->spacing,
                               .dy = a->spacing};
}
