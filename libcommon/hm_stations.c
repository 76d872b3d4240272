#include "hm_stations.h"

#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FINE = 8,    /* places in a table of a bank, to a control distance */
    ROUNDS = 200 /* of shifting; it settles in about fifty */
};

/* Shares of the way to right angles, and to the spacing asked for, in a round. */
static const double STRAIGHTEN = 0.5, EVEN_OUT = 0.2;
/* No station comes nearer to the next than this part of the spacing asked for. */
static const double LEAST_SPACING = 0.5;

/* Both banks, each with a table of places at equal distances. */
struct banks {
    const struct hm_rough *rough;
    double length[2];
    size_t n; /* places, and so many pieces + 1 */
    double *table[2];
};

static void banks_free(struct banks *b)
{
    free(b->table[0]);
    free(b->table[1]);
}

static enum hm_err measure(struct banks *b, struct hm_diag *d)
{
    const struct hm_rough *r = b->rough;
    double mean = 0;
    for (int side = 0; side < 2; side++) {
        b->length[side] = hm_polyline_length(&r->side[side]);
        mean += b->length[side] / 2;
    }
    const double *start = r->side[HM_RIGHT].xyz;
    if (r->size.along > mean)
        return hm_fail_at(d, HM_EGEOM, start[0], start[1],
                          "control points every %g m along surface '%s' are farther apart than its "
                          "banks are long (%.4g m)",
                          r->size.along, r->name, mean);
    if (mean / r->size.along * FINE > INT32_MAX / 8)
        return hm_fail(d, HM_ENOMEM, "control points every %g m are too many for surface '%s'",
                       r->size.along, r->name);
    return HM_OK;
}

static double pieces_of(const struct banks *b)
{
    return floor((b->length[0] + b->length[1]) / 2 / b->rough->size.along + 0.5);
}

static enum hm_err make_tables(struct banks *b, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int side = 0; !err && side < 2; side++)
        err = hm_polyline_divide(&b->rough->side[side], (size_t)pieces_of(b) * FINE,
                                 &b->table[side], &b->n, d);
    return err;
}

/* The place on a bank at s, metres from its start, by the table. */
static void place(const struct banks *b, int side, double s, double xy[2])
{
    double at = fmax(0, s / b->length[side]) * (double)(b->n - 1);
    size_t i = (size_t)fmin(at, (double)(b->n - 2));
    const double *p = b->table[side] + 3 * i, *q = p + 3;
    double t = fmin(1, at - (double)i);
    for (int k = 0; k < 2; k++)
        xy[k] = p[k] + t * (q[k] - p[k]);
}

/* --- denser in bends --- */

/* By how much a bank turns, radians a metre, at place i of its table, over a control distance to
 * either side. */
static double curvature(const struct banks *b, int side, size_t i)
{
    size_t reach = i < FINE ? i : FINE;
    reach = reach < b->n - 1 - i ? reach : b->n - 1 - i;
    if (reach == 0)
        return 0;
    const double *p = b->table[side] + 3 * (i - reach), *q = b->table[side] + 3 * i,
                 *r = b->table[side] + 3 * (i + reach);
    double u[2] = {q[0] - p[0], q[1] - p[1]}, w[2] = {r[0] - q[0], r[1] - q[1]};
    double turn = fabs(atan2(u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1]));
    return turn / (b->length[side] / (double)(b->n - 1) * (double)reach);
}

/* How many stations there are up to each place of the tables: where both banks turn by less than
 * `bend` degrees in a control distance one each, else as many as bring it down to that. */
static double *count_stations(const struct banks *b)
{
    const double bend = b->rough->size.bend * acos(-1) / 180, along = b->rough->size.along;
    double *count = hm_alloc(b->n, sizeof *count);
    if (!count)
        return NULL;
    count[0] = 0;
    for (size_t i = 0; i + 1 < b->n; i++) {
        double want = 1;
        for (int side = 0; side < 2 && bend > 0; side++) {
            double turn = fmax(curvature(b, side, i), curvature(b, side, i + 1));
            want = fmax(want, turn * along / bend);
        }
        want = fmin(want, 1 / HM_STATIONS_LEAST);
        count[i + 1] = count[i] + want * pieces_of(b) / (double)(b->n - 1);
    }
    return count;
}

/* Places of stations as parts of the banks' lengths, 0 .. 1. */
static enum hm_err divide(const struct banks *b, double **part, size_t *n, struct hm_diag *d)
{
    double *count = count_stations(b);
    if (!count)
        return hm_fail_memory(d);
    double pieces = fmax(1, floor(count[b->n - 1] + 0.5)), step = count[b->n - 1] / pieces;
    *n = (size_t)pieces + 1;
    *part = hm_alloc(*n, sizeof **part);
    for (size_t i = 0, k = 0; *part && k < *n; k++) {
        double want = (double)k * step;
        while (i + 2 < b->n && count[i + 1] < want)
            i++;
        double within = fmin(1, (want - count[i]) / (count[i + 1] - count[i]));
        (*part)[k] = k + 1 < *n ? ((double)i + within) / (double)(b->n - 1) : 1;
    }
    free(count);
    return *part ? HM_OK : hm_fail_memory(d);
}

/* --- right angles --- */

/* How far the left end of section i is ahead of the right one, along the river. */
static double skew(const struct banks *b, double *const s[2], size_t i)
{
    double at[2][2], dir[2] = {0, 0};
    for (int side = 0; side < 2; side++) {
        double before[2], behind[2];
        place(b, side, s[side][i - 1], before);
        place(b, side, s[side][i], at[side]);
        place(b, side, s[side][i + 1], behind);
        dir[0] += behind[0] - before[0];
        dir[1] += behind[1] - before[1];
    }
    double length = hypot(dir[0], dir[1]);
    double ahead =
        (at[HM_LEFT][0] - at[HM_RIGHT][0]) * dir[0] + (at[HM_LEFT][1] - at[HM_RIGHT][1]) * dir[1];
    return length > 0 ? ahead / length : 0;
}

/* Shift station i on one bank: towards the right angle, and towards the spacing that `part` asks
 * for.
 */
static void shift(const struct banks *b, int side, double *s, const double *part, size_t i,
                  double towards)
{
    double before = part[i] - part[i - 1], behind = part[i + 1] - part[i];
    double even = (s[i - 1] * behind + s[i + 1] * before) / (before + behind);
    double least = LEAST_SPACING * b->length[side];
    double to = s[i] + STRAIGHTEN * towards + EVEN_OUT * (even - s[i]);
    s[i] = fmax(fmin(to, s[i + 1] - least * behind), s[i - 1] + least * before);
}

/* Rounds go forward and back in turn, so that neither end counts more. */
static void straighten(const struct banks *b, const double *part, size_t n, double *const s[2])
{
    for (int round = 0; round < ROUNDS; round++)
        for (size_t k = 1; k + 1 < n; k++) {
            size_t i = round % 2 == 0 ? k : n - 1 - k;
            double ahead = skew(b, s, i);
            shift(b, HM_LEFT, s[HM_LEFT], part, i, -ahead / 2);
            shift(b, HM_RIGHT, s[HM_RIGHT], part, i, ahead / 2);
        }
}

/* --- both --- */

static enum hm_err lay(const struct banks *b, double *const s[2], size_t n, double *bank[2],
                       struct hm_diag *d)
{
    for (int side = 0; side < 2; side++) {
        bank[side] = hm_alloc(n, 3 * sizeof *bank[side]);
        if (!bank[side])
            return hm_fail_memory(d);
        for (size_t i = 0; i < n; i++)
            hm_polyline_at(&b->rough->side[side], s[side][i], bank[side] + 3 * i);
    }
    return HM_OK;
}

static enum hm_err lay_unequal(struct banks *b, bool orthogonal, double *bank[2], size_t *n,
                               struct hm_diag *d)
{
    double *part = NULL, *s[2] = {NULL, NULL};
    enum hm_err err = make_tables(b, d);
    if (!err)
        err = divide(b, &part, n, d);
    for (int side = 0; !err && side < 2; side++) {
        s[side] = hm_alloc(*n, sizeof *s[side]);
        if (!s[side])
            err = hm_fail_memory(d);
        for (size_t i = 0; !err && i < *n; i++)
            s[side][i] = part[i] * b->length[side];
    }
    if (!err && orthogonal)
        straighten(b, part, *n, s);
    if (!err)
        err = lay(b, s, *n, bank, d);
    free(part);
    free(s[0]);
    free(s[1]);
    return err;
}

enum hm_err hm_stations_lay(const struct hm_rough *rough, bool orthogonal, double *bank[2],
                            size_t *n, struct hm_diag *d)
{
    struct banks b = {.rough = rough};
    bank[0] = bank[1] = NULL;
    enum hm_err err = measure(&b, d);
    if (!err && (orthogonal || rough->size.bend > 0))
        err = lay_unequal(&b, orthogonal, bank, n, d);
    else
        for (int side = 0; !err && side < 2; side++)
            err = hm_polyline_divide(&rough->side[side], (size_t)pieces_of(&b), &bank[side], n, d);
    if (err)
        for (int side = 0; side < 2; side++) {
            free(bank[side]);
            bank[side] = NULL;
        }
    banks_free(&b);
    return err;
}
