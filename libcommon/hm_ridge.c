#include "hm_ridge.h"

#include "hm_slope.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows kept of everything, a power of 2; row j is kept at j % KEPT. What is made of row j is one
 * row of smoothed heights two rows before, of curvatures one before that, of their derivatives
 * across one more. */
enum { KEPT = 8, REACH = 2 };

struct node {
    double curvature;
    double across[2]; /* unit vector */
    double change;    /* of the curvature across */
};

/* The joints of one kind of line, as in hm_contour. */
struct joints {
    struct hm_chain *chain;
    struct hm_joint *across[2], upright[2];
};

struct hm_ridge {
    struct hm_lattice l;
    size_t nx;
    struct hm_ridge_rule rule;
    int64_t row; /* rows seen */
    double *z[KEPT], *rough[KEPT], *smooth[KEPT], *curvature[KEPT];
    struct node *node[KEPT];
    double *gx, *gy; /* a row */
    struct hm_slope_second *second;
    struct joints joints[HM_RIDGE_KINDS];
};

static bool make_rows(struct hm_ridge *r)
{
    for (int k = 0; k < KEPT; k++) {
        r->z[k] = hm_alloc(r->nx, sizeof *r->z[k]);
        r->rough[k] = hm_alloc(r->nx, sizeof *r->rough[k]);
        r->smooth[k] = hm_alloc(r->nx, sizeof *r->smooth[k]);
        r->curvature[k] = hm_alloc(r->nx, sizeof *r->curvature[k]);
        r->node[k] = hm_alloc(r->nx, sizeof *r->node[k]);
        if (!r->z[k] || !r->rough[k] || !r->smooth[k] || !r->curvature[k] || !r->node[k])
            return false;
    }
    r->gx = hm_alloc(r->nx, sizeof *r->gx);
    r->gy = hm_alloc(r->nx, sizeof *r->gy);
    r->second = hm_alloc(r->nx, sizeof *r->second);
    return r->gx && r->gy && r->second;
}

static enum hm_err make_joints(struct joints *j, size_t nx, const struct hm_ridge_rule *rule,
                               void *arg, struct hm_diag *d)
{
    for (int k = 0; k < 2; k++) {
        hm_joint_clear(&j->upright[k]);
        j->across[k] = hm_alloc(nx, sizeof *j->across[k]);
        if (!j->across[k])
            return hm_fail_memory(d);
        for (size_t i = 0; i < nx; i++)
            hm_joint_clear(&j->across[k][i]);
    }
    return hm_chain_new(&j->chain, rule->take, arg, d);
}

enum hm_err hm_ridge_new(struct hm_ridge **r, const struct hm_lattice *l,
                         const struct hm_ridge_rule *rule, struct hm_diag *d)
{
    *r = hm_alloc0(1, sizeof **r);
    if (!*r)
        return hm_fail_memory(d);
    (*r)->l = *l;
    (*r)->nx = (size_t)l->nx;
    (*r)->rule = *rule;
    enum hm_err err = make_rows(*r) ? HM_OK : hm_fail_memory(d);
    for (int k = 0; k < HM_RIDGE_KINDS && !err; k++)
        err = make_joints(&(*r)->joints[k], (*r)->nx, rule, rule->arg[k], d);
    if (err) {
        hm_ridge_free(*r);
        *r = NULL;
    }
    return err;
}

void hm_ridge_free(struct hm_ridge *r)
{
    if (!r)
        return;
    for (int k = 0; k < KEPT; k++) {
        free(r->z[k]);
        free(r->rough[k]);
        free(r->smooth[k]);
        free(r->curvature[k]);
        free(r->node[k]);
    }
    for (int k = 0; k < HM_RIDGE_KINDS; k++) {
        hm_chain_free(r->joints[k].chain);
        free(r->joints[k].across[0]);
        free(r->joints[k].across[1]);
    }
    free(r->gx);
    free(r->gy);
    free(r->second);
    free(r);
}

/* --- from heights to curvatures --- */

static double binomial(double a, double b, double c, double d, double e)
{
    return (a + e + 4 * (b + d) + 6 * c) / 16;
}

static void smooth_along(const double *z, size_t nx, double *out)
{
    for (size_t i = 0; i < nx; i++)
        out[i] = i < REACH || i + REACH >= nx
                     ? NAN
                     : binomial(z[i - 2], z[i - 1], z[i], z[i + 1], z[i + 2]);
}

static void smooth_across(const struct hm_ridge *r, int64_t row)
{
    const double *a[5];
    for (int k = 0; k < 5; k++)
        a[k] = r->rough[(row - REACH + k) % KEPT];
    for (size_t i = 0; i < r->nx; i++)
        r->smooth[row % KEPT][i] = binomial(a[0][i], a[1][i], a[2][i], a[3][i], a[4][i]);
}

static void rows_around(double *const rows[KEPT], int64_t row, const double *three[3])
{
    for (int k = 0; k < 3; k++)
        three[k] = rows[(row - 1 + k) % KEPT];
}

/* The eigenvalue of larger size and its vector. */
static struct node judge(const struct hm_slope_second *s, double gx, double gy)
{
    double mean = (s->xx + s->yy) / 2, half = (s->xx - s->yy) / 2;
    double spread = hypot(half, s->xy), bend = mean >= 0 ? mean + spread : mean - spread;
    /* of the two ways to the vector the one that does not cancel */
    double x = mean >= 0 ? spread + half : spread - half, y = mean >= 0 ? s->xy : -s->xy;
    if (x < fabs(y)) {
        x = mean >= 0 ? s->xy : -s->xy;
        y = mean >= 0 ? spread - half : spread + half;
    }
    double length = hypot(x, y), steep = 1 + gx * gx + gy * gy;
    struct node n = {bend / (steep * sqrt(steep)), {x / length, y / length}, NAN};
    return n;
}

static void find_curvatures(const struct hm_ridge *r, int64_t row)
{
    const double *z[3];
    rows_around(r->smooth, row, z);
    hm_slope_gradient(HM_SLOPE_EQUAL, z, r->nx, r->l.dx, r->l.dy, r->gx, r->gy);
    hm_slope_second(HM_SLOPE_EQUAL, z, r->nx, r->l.dx, r->l.dy, r->second);
    for (size_t i = 0; i < r->nx; i++) {
        struct node n = judge(&r->second[i], r->gx[i], r->gy[i]);
        r->node[row % KEPT][i] = n;
        r->curvature[row % KEPT][i] = n.curvature;
    }
}

static void find_changes(const struct hm_ridge *r, int64_t row)
{
    const double *c[3];
    struct node *n = r->node[row % KEPT];
    rows_around(r->curvature, row, c);
    hm_slope_gradient(HM_SLOPE_EQUAL, c, r->nx, r->l.dx, r->l.dy, r->gx, r->gy);
    for (size_t i = 0; i < r->nx; i++)
        n[i].change = r->gx[i] * n[i].across[0] + r->gy[i] * n[i].across[1];
}

/* --- crossings --- */

/* The cell at column i of rows row - 1 and row; corners and edges are numbered as in hm_contour. */
struct cell {
    const struct hm_ridge *r;
    int64_t row, i;
};

static void corner(const struct cell *c, int k, int64_t *i, int64_t *row)
{
    *i = c->i + (k == 1 || k == 2);
    *row = c->row - 1 + (k >= 2);
}

/* Where a line of the kind crosses edge k; false when none does. */
static bool crossing(const struct cell *c, int k, enum hm_ridge_kind kind, double p[3])
{
    int first = k >= 2 ? (k + 1) & 3 : k, last = k >= 2 ? k : k + 1;
    int64_t ia, ja, ib, jb;
    corner(c, first, &ia, &ja);
    corner(c, last, &ib, &jb);
    const struct hm_ridge *r = c->r;
    const struct node *a = &r->node[ja % KEPT][ia], *b = &r->node[jb % KEPT][ib];
    double sign = kind == HM_RIDGE_TOE ? 1 : -1;
    if (!(sign * a->curvature > 0 && sign * b->curvature > 0))
        return false;
    /* both ends with the same sense of across, that from a to b */
    double dx = (double)(ib - ia) * r->l.dx, dy = (double)(jb - ja) * r->l.dy;
    double along_a = a->across[0] * dx + a->across[1] * dy;
    double same = a->across[0] * b->across[0] + a->across[1] * b->across[1];
    double from = sign * (along_a < 0 ? -a->change : a->change);
    double to = sign * ((along_a < 0) != (same < 0) ? -b->change : b->change);
    if (!(from >= 0 && to < 0)) /* growing at a, falling at b: largest between */
        return false;
    double t = from / (from - to), za = r->z[ja % KEPT][ia], zb = r->z[jb % KEPT][ib];
    if (!(sign * (a->curvature + t * (b->curvature - a->curvature)) >= r->rule.limit))
        return false;
    p[0] = r->l.x0 + ((double)ia + t * (double)(ib - ia)) * r->l.dx;
    p[1] = r->l.y0 + ((double)ja + t * (double)(jb - ja)) * r->l.dy;
    p[2] = za + t * (zb - za);
    return true;
}

static struct hm_joint *joint_of(struct joints *j, int64_t i, int k)
{
    if (k == 0 || k == 2)
        return &j->across[k / 2][i];
    return &j->upright[(k == 1 ? i + 1 : i) & 1];
}

static enum hm_err do_cell(struct hm_ridge *r, int64_t row, int64_t i, enum hm_ridge_kind kind,
                           struct hm_diag *d)
{
    struct cell cell = {r, row, i};
    struct joints *j = &r->joints[kind];
    double p[4][3];
    int edge[4], n = 0;
    for (int k = 0; k < 4; k++)
        if (crossing(&cell, k, kind, p[n]))
            edge[n++] = k;
    enum hm_err err = HM_OK;
    if (n == 2)
        err = hm_chain_join(j->chain, joint_of(j, i, edge[0]), joint_of(j, i, edge[1]), p[0], p[1],
                            d);
    if (!err)
        err = hm_chain_seal(j->chain, joint_of(j, i, 0), d);
    return err ? err : hm_chain_seal(j->chain, joint_of(j, i, 3), d);
}

static enum hm_err do_cells(struct hm_ridge *r, int64_t row, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int kind = 0; kind < HM_RIDGE_KINDS && !err; kind++) {
        struct joints *j = &r->joints[kind];
        for (int64_t i = 0; i + 1 < r->l.nx && !err; i++)
            err = do_cell(r, row, i, (enum hm_ridge_kind)kind, d);
        if (!err)
            err = hm_chain_seal(j->chain, joint_of(j, r->l.nx - 1, 3), d);
        struct hm_joint *across = j->across[0];
        j->across[0] = j->across[1];
        j->across[1] = across;
    }
    return err;
}

enum hm_err hm_ridge_row(struct hm_ridge *r, const double *z, struct hm_diag *d)
{
    enum { FIRST_SMOOTH = 2, FIRST_CURVATURE = 3, FIRST_CHANGE = 4 };
    int64_t row = r->row++;
    memcpy(r->z[row % KEPT], z, r->nx * sizeof *z);
    smooth_along(z, r->nx, r->rough[row % KEPT]);
    row -= REACH;
    if (row >= FIRST_SMOOTH)
        smooth_across(r, row);
    if (--row >= FIRST_CURVATURE)
        find_curvatures(r, row);
    if (--row >= FIRST_CHANGE)
        find_changes(r, row);
    return row > FIRST_CHANGE ? do_cells(r, row, d) : HM_OK;
}

enum hm_err hm_ridge_end(struct hm_ridge *r, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int kind = 0; kind < HM_RIDGE_KINDS; kind++)
        for (size_t i = 0; i < r->nx && !err; i++)
            err = hm_chain_seal(r->joints[kind].chain, &r->joints[kind].across[0][i], d);
    return err;
}

enum hm_err hm_ridge_open(const struct hm_ridge *r, struct hm_box **box, size_t *n, size_t *cap,
                          struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int kind = 0; kind < HM_RIDGE_KINDS && !err; kind++)
        err = hm_chain_open(r->joints[kind].chain, box, n, cap, d);
    return err;
}
