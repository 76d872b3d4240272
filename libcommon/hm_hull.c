/* hm_hull: see hm_hull.h. */
#include "hm_hull.h"
#include "hm_pred.h"

#include <stdlib.h>

struct corner {
    const double *p;
    size_t i;
};

static int by_xy(const void *pa, const void *pb)
{
    const struct corner *a = pa, *b = pb;
    for (int k = 0; k < 2; k++)
        if (a->p[k] != b->p[k])
            return a->p[k] < b->p[k] ? -1 : 1;
    return (a->i > b->i) - (a->i < b->i);
}

/* The points farthest in eight directions, counter-clockwise (Akl & Toussaint 1978): what is
 * strictly inside this polygon is no corner, which is nearly everything. */
static void farthest(const double *xy, size_t n, size_t stride, const double *far[8])
{
    static const double direction[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                           {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    double best[8];
    for (size_t i = 0; i < n; i++) {
        const double *p = xy + i * stride;
        for (int k = 0; k < 8; k++) {
            double along = direction[k][0] * p[0] + direction[k][1] * p[1];
            if (i == 0 || along > best[k]) {
                best[k] = along;
                far[k] = p;
            }
        }
    }
}

static bool strictly_inside(const double *far[8], const double *p)
{
    int edges = 0;
    for (int k = 0; k < 8; k++) {
        const double *a = far[k], *b = far[(k + 1) % 8];
        if (a == b)
            continue;
        if (hm_pred_orient(a, b, p) <= 0)
            return false;
        edges++;
    }
    return edges > 0; /* none when all points are equal */
}

/* One side of the hull, in the order of c[]: a stack on which all turns are left (Andrew 1979). */
static size_t chain(const struct corner *c, size_t n, bool back, struct corner *stack)
{
    size_t top = 0;
    for (size_t k = 0; k < n; k++) {
        struct corner next = c[back ? n - 1 - k : k];
        if (top > 0 && stack[top - 1].p[0] == next.p[0] && stack[top - 1].p[1] == next.p[1])
            continue;
        while (top >= 2 && hm_pred_orient(stack[top - 2].p, stack[top - 1].p, next.p) <= 0)
            top--;
        stack[top++] = next;
    }
    return top - 1; /* the last is the first of the other side */
}

enum hm_err hm_hull_build(const double *xy, size_t n, size_t stride, size_t **hull, size_t *nhull,
                          struct hm_diag *d)
{
    const double *far[8];
    struct corner *c = hm_alloc(n, sizeof *c), *stack = NULL;
    size_t *out = NULL, m = 0;
    *hull = NULL;
    *nhull = 0;
    if (c && n > 0) {
        farthest(xy, n, stride, far);
        for (size_t i = 0; i < n; i++)
            if (!strictly_inside(far, xy + i * stride))
                c[m++] = (struct corner){xy + i * stride, i};
        qsort(c, m, sizeof *c, by_xy);
        stack = hm_alloc(m + 1, 2 * sizeof *stack);
        out = hm_alloc(m, sizeof *out);
    }
    enum hm_err err = c && (n == 0 || (stack && out)) ? HM_OK : hm_fail_memory(d);
    if (!err && n > 0) {
        size_t lower = chain(c, m, false, stack);
        *nhull = lower + chain(c, m, true, stack + lower);
        for (size_t k = 0; k < *nhull; k++)
            out[k] = stack[k].i;
    }
    free(c);
    free(stack);
    if (!err && *nhull < 3)
        err = hm_fail(d, HM_EGEOM, "%s",
                      n < 3 ? "fewer than three points" : "all points lie on one line");
    if (err)
        free(out);
    else
        *hull = out;
    return err;
}
