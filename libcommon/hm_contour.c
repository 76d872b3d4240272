#include "hm_contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell: its corners in counter-clockwise order of the lattice (i, j), and edge k from corner k to
 * corner k + 1.
 *
 *        3 ——2—— 2
 *        |       |
 *        3       1
 *        |       |
 *        0 ——0—— 1
 */
enum { FLAT, STEEP, UNKNOWN };

struct hm_contour {
    struct hm_lattice l;
    struct hm_contour_rule rule;
    struct hm_chain *chain;
    int64_t row;                   /* number of rows seen */
    const double *slope[2], *z[2]; /* the row before and the newest */
    uint8_t *state[2];             /* FLAT, STEEP or UNKNOWN a node */
    struct hm_joint *across[2];    /* joints on the edges of the row before and of the newest */
    struct hm_joint upright[2];    /* joints on the left and right edge of a cell, by turns */
    bool mirrored;                 /* the lattice is turned over: its left is the map's right */
};

static struct hm_joint *new_joints(size_t n)
{
    struct hm_joint *joints = hm_alloc(n, sizeof *joints);
    for (size_t k = 0; joints && k < n; k++)
        hm_joint_clear(&joints[k]);
    return joints;
}

enum hm_err hm_contour_new(struct hm_contour **c, const struct hm_lattice *l,
                           const struct hm_contour_rule *rule, struct hm_diag *d)
{
    *c = hm_alloc0(1, sizeof **c);
    if (!*c)
        return hm_fail_memory(d);
    (*c)->l = *l;
    (*c)->rule = *rule;
    (*c)->mirrored = l->dx * l->dy < 0;
    bool complete = true;
    for (int k = 0; k < 2; k++) {
        hm_joint_clear(&(*c)->upright[k]);
        (*c)->state[k] = hm_alloc0((size_t)l->nx, 1);
        (*c)->across[k] = new_joints((size_t)l->nx);
        complete = complete && (*c)->state[k] && (*c)->across[k];
    }
    enum hm_err err =
        complete ? hm_chain_new(&(*c)->chain, rule->take, rule->arg, d) : hm_fail_memory(d);
    if (err) {
        hm_contour_free(*c);
        *c = NULL;
    }
    return err;
}

void hm_contour_free(struct hm_contour *c)
{
    if (!c)
        return;
    for (int k = 0; k < 2; k++) {
        free(c->state[k]);
        free(c->across[k]);
    }
    hm_chain_free(c->chain);
    free(c);
}

/* Column and row (0: the row before, 1: the newest) of corner k of the cell at column i. */
static int64_t corner_column(int64_t i, int k)
{
    return i + (k == 1 || k == 2);
}

static int corner_row(int k)
{
    return k >= 2;
}

/* Equation (8) on edge k of the cell at column i, from the end with the lower column and row, so
 * that both cells at an edge find the same point. An exact hit gives the node itself. */
static void crossing(const struct hm_contour *c, int64_t i, int k, double p[3])
{
    int a = k >= 2 ? (k + 1) & 3 : k, b = k >= 2 ? k : k + 1;
    int64_t ia = corner_column(i, a), ib = corner_column(i, b);
    int ra = corner_row(a), rb = corner_row(b);
    double sa = c->slope[ra][ia], sb = c->slope[rb][ib];
    double t = (c->rule.limit - sa) / (sb - sa);
    if (isinf(sa) || isinf(sb))
        t = 0.5;
    if (c->rule.mode == HM_CONTOUR_NODE)
        t = sb >= c->rule.limit ? 1 : 0;
    double row = (double)(c->row - 2 + ra);
    p[0] = c->l.x0 + ((double)ia + t * (double)(ib - ia)) * c->l.dx;
    p[1] = c->l.y0 + (row + t * (double)(rb - ra)) * c->l.dy;
    p[2] = t >= 1 ? c->z[rb][ib] : c->z[ra][ia] + t * (c->z[rb][ib] - c->z[ra][ia]);
}

/* The joint on edge k of the cell at column i. What is right of a cell is left of the next. */
static struct hm_joint *joint_of(struct hm_contour *c, int64_t i, int k)
{
    if (k == 0 || k == 2)
        return &c->across[k / 2][i];
    return &c->upright[(k == 1 ? i + 1 : i) & 1];
}

/* Is the edge's first corner steep, its second not? Then a piece that keeps the steep side on its
 * left begins there. */
static bool leaves(const uint8_t state[4], int k)
{
    return state[k] == STEEP && state[(k + 1) & 3] == FLAT;
}

static bool enters(const uint8_t state[4], int k)
{
    return state[k] == FLAT && state[(k + 1) & 3] == STEEP;
}

static enum hm_err add_piece(struct hm_contour *c, int64_t i, int from, int to,
                             const double *middle, struct hm_diag *d)
{
    double start[3], end[3];
    int first = c->mirrored ? to : from, last = c->mirrored ? from : to;
    struct hm_joint *a = joint_of(c, i, first), *b = joint_of(c, i, last);
    if (middle)
        return hm_chain_add(c->chain, a, b, NULL, middle, NULL, d);
    crossing(c, i, first, start);
    crossing(c, i, last, end);
    return hm_chain_add(c->chain, a, b, start, NULL, end, d);
}

static void mean_of_crossings(const struct hm_contour *c, int64_t i, const uint8_t state[4],
                              double mean[3])
{
    int n = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (int k = 0; k < 4; k++)
        if (leaves(state, k) || enters(state, k)) {
            double p[3];
            crossing(c, i, k, p);
            for (int x = 0; x < 3; x++)
                mean[x] += p[x];
            n++;
        }
    for (int x = 0; x < 3; x++)
        mean[x] /= n;
}

/* Link the crossings of the cell at column i, of which no corner is unknown. */
static enum hm_err link_cell(struct hm_contour *c, int64_t i, const uint8_t state[4],
                             struct hm_diag *d)
{
    double mean[3], *middle = NULL;
    if (c->rule.saddle == HM_CONTOUR_MEAN) {
        mean_of_crossings(c, i, state, mean);
        middle = mean;
    }
    bool saddle = state[0] == state[2] && state[1] == state[3];
    double sum = c->slope[0][i] + c->slope[0][i + 1] + c->slope[1][i] + c->slope[1][i + 1];
    /* in a saddle a piece from edge k cuts off the corner behind it, or the one before */
    int turn = sum / 4 >= c->rule.limit ? 1 : 3;
    for (int from = 0; from < 4; from++) {
        if (!leaves(state, from))
            continue;
        int to = (from + turn) & 3;
        for (int k = 0; k < 4 && !saddle; k++)
            if (enters(state, k))
                to = k;
        enum hm_err err = add_piece(c, i, from, to, middle, d);
        if (err)
            return err;
    }
    return HM_OK;
}

/* Link a cell, then leave its left and lower edge behind for good. */
static enum hm_err do_cell(struct hm_contour *c, int64_t i, struct hm_diag *d)
{
    const uint8_t *below = c->state[0] + i, *above = c->state[1] + i;
    const uint8_t state[4] = {below[0], below[1], above[1], above[0]};
    enum hm_err err = HM_OK;
    if (!((state[0] | state[1] | state[2] | state[3]) & UNKNOWN))
        err = link_cell(c, i, state, d);
    if (!err)
        err = hm_chain_seal(c->chain, joint_of(c, i, 0), d);
    return err ? err : hm_chain_seal(c->chain, joint_of(c, i, 3), d);
}

static enum hm_err do_cells(struct hm_contour *c, struct hm_diag *d)
{
    const uint8_t *below = c->state[0], *above = c->state[1];
    for (int64_t i = 0; i + 1 < c->l.nx; i++) {
        bool uniform =
            !((below[i] ^ above[i]) | (below[i] ^ below[i + 1]) | (below[i] ^ above[i + 1]));
        enum hm_err err = uniform ? HM_OK : do_cell(c, i, d);
        if (err)
            return err;
    }
    return hm_chain_seal(c->chain, joint_of(c, c->l.nx - 1, 3), d);
}

static void swap_rows(struct hm_contour *c)
{
    uint8_t *state = c->state[0];
    struct hm_joint *across = c->across[0];
    c->state[0] = c->state[1];
    c->state[1] = state;
    c->across[0] = c->across[1];
    c->across[1] = across;
    c->slope[0] = c->slope[1];
    c->z[0] = c->z[1];
}

enum hm_err hm_contour_row(struct hm_contour *c, const double *slope, const double *z,
                           struct hm_diag *d)
{
    swap_rows(c);
    c->slope[1] = slope;
    c->z[1] = z;
    c->row++;
    for (int64_t i = 0; i < c->l.nx; i++)
        c->state[1][i] = isnan(slope[i]) ? UNKNOWN : slope[i] >= c->rule.limit ? STEEP : FLAT;
    return c->row > 1 ? do_cells(c, d) : HM_OK;
}

enum hm_err hm_contour_end(struct hm_contour *c, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int64_t i = 0; i < c->l.nx && !err; i++)
        err = hm_chain_seal(c->chain, &c->across[1][i], d);
    return err;
}

enum hm_err hm_contour_open(const struct hm_contour *c, struct hm_box **box, size_t *n, size_t *cap,
                            struct hm_diag *d)
{
    return hm_chain_open(c->chain, box, n, cap, d);
}
