#include "hm_axis.h"

#include "hm_attr.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One axis, divided. */
struct axis {
    const struct hm_breaklines *b;
    const struct hm_line *line;
    double half_width;
    size_t n;
    double *xyz; /* the places, 3 doubles each */
    double *far; /* of each place: from it to the bank; NaN where no breakline was found */
};

static const double *place(const struct axis *a, size_t i)
{
    return a->xyz + 3 * i;
}

/* Direction of the axis at place i, a unit vector. */
static void heading(const struct axis *a, size_t i, double dir[2])
{
    const double *p = place(a, i > 0 ? i - 1 : 0), *q = place(a, i + 1 < a->n ? i + 1 : i);
    double length = hypot(q[0] - p[0], q[1] - p[1]);
    dir[0] = length > 0 ? (q[0] - p[0]) / length : 1;
    dir[1] = length > 0 ? (q[1] - p[1]) / length : 0;
}

/* side: 1 to the left, -1 to the right of the axis. */
static void beside(const struct axis *a, size_t i, int side, double far, double xy[2])
{
    double dir[2];
    heading(a, i, dir);
    xy[0] = place(a, i)[0] - side * far * dir[1];
    xy[1] = place(a, i)[1] + side * far * dir[0];
}

static void look(struct axis *a, int side)
{
    double least = HM_AXIS_NEAREST * a->half_width, most = HM_AXIS_FARTHEST * a->half_width;
    for (size_t i = 0; i < a->n; i++) {
        double from[2], to[2], dir[2];
        heading(a, i, dir);
        beside(a, i, side, least, from);
        beside(a, i, side, most, to);
        double part = hm_breaklines_first(a->b, from, to, dir);
        a->far[i] = isfinite(part) ? least + part * (most - least) : NAN;
    }
}

/* The median of what was found around place i; NaN where nothing was. One line astray in the bed
 * does not bend the bank. */
static double median_around(const struct axis *a, size_t i)
{
    double sorted[2 * HM_AXIS_AROUND + 1];
    size_t n = 0;
    for (size_t k = i > HM_AXIS_AROUND ? i - HM_AXIS_AROUND : 0;
         k < a->n && k <= i + HM_AXIS_AROUND; k++) {
        size_t at = n;
        if (isnan(a->far[k]))
            continue;
        for (; at > 0 && sorted[at - 1] > a->far[k]; at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = a->far[k];
        n++;
    }
    return n > 0 ? sorted[n / 2] : NAN;
}

/* One bank. In a bend sharper than the river is wide, places of the inner bank that would go back
 * are left out. */
static enum hm_err make_bank(struct axis *a, int side, struct hm_lines *banks,
                             struct hm_axis *found, struct hm_diag *d)
{
    struct hm_line bank = {.xyz = hm_alloc(a->n, 3 * sizeof *bank.xyz)};
    bank.attrs = hm_attr_set(a->line->attrs, "side", side > 0 ? "left" : "right");
    enum hm_err err = bank.xyz && bank.attrs ? HM_OK : hm_fail_memory(d);
    if (!err)
        look(a, side);
    for (size_t i = 0; !err && i < a->n; i++) {
        double far = median_around(a, i), dir[2], *p = bank.xyz + 3 * bank.n;
        heading(a, i, dir);
        found->places++;
        if (isnan(far) && found->by_width++ == 0)
            memcpy(found->by_width_at, place(a, i), sizeof found->by_width_at);
        beside(a, i, side, isnan(far) ? a->half_width : far, p);
        p[2] = NAN;
        if (bank.n == 0 || (p[0] - p[-3]) * dir[0] + (p[1] - p[-2]) * dir[1] > 0)
            bank.n++;
    }
    if (!err)
        err = hm_lines_append(banks, &bank, d);
    free(bank.xyz);
    free(bank.attrs);
    return err;
}

static enum hm_err read_axis(struct axis *a, double *along, struct hm_diag *d)
{
    const double *start = a->line->xyz;
    if (a->line->closed || !(hm_polyline_length(a->line) > 0))
        return hm_fail_at(d, HM_EGEOM, a->line->n > 0 ? start[0] : 0, a->line->n > 0 ? start[1] : 0,
                          "an axis (side=axis) is %s",
                          a->line->closed ? "a closed line" : "only one point");
    enum hm_err err = hm_attr_number(a->line->attrs, "half_width", 0, &a->half_width, d);
    if (!err)
        err = hm_attr_number(a->line->attrs, "along", *along, along, d);
    if (!err && !(a->half_width > 0 && isfinite(a->half_width)))
        err = hm_fail_at(d, HM_EFORMAT, start[0], start[1],
                         "an axis needs its half-width, metres, as in half_width=20");
    if (!err && !(*along > 0 && isfinite(*along)))
        err = hm_fail_at(d, HM_EARG, start[0], start[1],
                         "no distance of control points for an axis: give it by option or as "
                         "along=");
    return hm_fail_place(d, err, start[0], start[1]);
}

static enum hm_err take_axis(const struct hm_breaklines *b, const struct hm_line *line,
                             double along, struct hm_lines *banks, struct hm_axis *found,
                             struct hm_diag *d)
{
    struct axis a = {.b = b, .line = line};
    enum hm_err err = read_axis(&a, &along, d);
    if (!err)
        err = hm_polyline_resample(line, along, &a.xyz, &a.n, d);
    if (!err && !(a.far = hm_alloc(a.n, sizeof *a.far)))
        err = hm_fail_memory(d);
    *found = (struct hm_axis){0};
    hm_attr_get(line->attrs, "surface", found->name, sizeof found->name);
    for (int side = 1; !err && side >= -1; side -= 2)
        err = make_bank(&a, side, banks, found, d);
    free(a.xyz);
    free(a.far);
    return err;
}

static bool is_axis(const struct hm_line *line)
{
    char side[8];
    return hm_role_of(line->attrs) == HM_ROLE_SURFACE &&
           hm_attr_get(line->attrs, "side", side, sizeof side) && !strcmp(side, "axis");
}

enum hm_err hm_axis_banks(const struct hm_breaklines *b, const struct hm_lines *sets, size_t n,
                          double along, struct hm_lines *banks, struct hm_axis **found,
                          size_t *nfound, struct hm_diag *d)
{
    size_t cap = 0;
    enum hm_err err = HM_OK;
    *found = NULL;
    *nfound = 0;
    for (size_t s = 0; !err && s < n; s++)
        for (size_t k = 0; !err && k < sets[s].n; k++) {
            if (!is_axis(&sets[s].line[k]))
                continue;
            if (!hm_grow(found, &cap, *nfound + 1, sizeof **found))
                err = hm_fail_memory(d);
            else
                err = take_axis(b, &sets[s].line[k], along, banks, &(*found)[(*nfound)++], d);
        }
    return err;
}
