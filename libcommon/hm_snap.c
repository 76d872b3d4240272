#include "hm_snap.h"

#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Prices of the fit, in units in which a move by the whole reach costs 1. They were chosen on
 * meandering rivers with toe and crest in reach of each other. */
static const double COST_UNMOVED = 1.2; /* a control point that uses no breakline */
static const double COST_END = 1.0;    /* half a control distance beyond the end of the breakline */
static const double COST_ACROSS = 2.0; /* a breakline at right angles to the bank */
static const double COST_STRETCH = 0.5; /* neighbours a control distance nearer or farther */
static const double COST_JUMP = 0.1;    /* from one breakline to the next in its prolongation */
static const double COST_OFFSET = 6.0;  /* and the reach beside its prolongation */
static const double COST_LEAVE = 0.3;   /* between moved and unmoved */
static const double COST_SWITCH = 6;    /* between toe and crest, moved or not in between */
static const double LEAST_STEP = 0.2;   /* of a control distance that each point must go forward */
static const double CLEAR_OF_END = 0.4; /* of the distance from an end section that must remain */
static const double MOST_DETOUR = 1.5;  /* length along a breakline over the straight way */

enum { MOST_TARGETS = 12, STAYS = 3, GLIDES = 8 };

/* --- targets of one control point --- */

struct target {
    int32_t line; /* -1: none, the point stays */
    double s;     /* distance along the line */
    double xy[2];
    double dir[2]; /* of the line there, over about a control distance */
    int steep;     /* 1: on the left of the bank, -1: on the right, 0: not known; of a point that
                      stays what was before it, so that toe and crest are told apart beyond it */
    double far;    /* from the control point */
    double cost;   /* of this target, and of the cheapest way up to here */
    double total;
    int32_t before; /* the target of the point before on that way */
};

struct fit {
    const struct hm_breaklines *b;
    const struct hm_bank *bank;
    struct target *target; /* MOST_TARGETS + STAYS a point; the last ones of each are `none` */
    int32_t *ntargets;
};

struct search {
    const struct fit *fit;
    size_t i;           /* control point */
    const double *axis; /* of an end: the direction it slides in; else NULL */
    struct target *out;
    int32_t n;
    double spacing;
};

static const double *rough(const struct fit *f, size_t i)
{
    return f->bank->rough + 3 * i;
}

/* Direction and length of the bank at control point i. */
static double heading(const struct fit *f, size_t i, double dir[2])
{
    const double *a = rough(f, i > 0 ? i - 1 : 0);
    const double *b = rough(f, i + 1 < f->bank->n ? i + 1 : i);
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    dir[0] = length > 0 ? (b[0] - a[0]) / length : 1;
    dir[1] = length > 0 ? (b[1] - a[1]) / length : 0;
    return i > 0 && i + 1 < f->bank->n ? length / 2 : length;
}

/* Keep a target: of several within half a control distance on one line the nearest, and of too many
 * the nearest ones. */
static void keep_target(struct search *q, const struct target *t)
{
    for (int32_t k = 0; k < q->n; k++) {
        struct target *old = &q->out[k];
        if (old->line == t->line &&
            fabs(hm_breaklines_way(q->fit->b, t->line, old->s, t->s)) < q->spacing / 2) {
            if (t->far < old->far)
                *old = *t;
            return;
        }
    }
    if (q->n < MOST_TARGETS) {
        q->out[q->n++] = *t;
        return;
    }
    struct target *farthest = q->out;
    for (int32_t k = 1; k < q->n; k++)
        if (q->out[k].far > farthest->far)
            farthest = &q->out[k];
    if (t->far < farthest->far)
        *farthest = *t;
}

/* Where the axis through p cuts segment s, as a part of s; negative when it does not. */
static double cut_by_axis(const struct hm_segment *s, const double *p, const double *axis)
{
    double da = (s->a[0] - p[0]) * axis[1] - (s->a[1] - p[1]) * axis[0];
    double db = (s->b[0] - p[0]) * axis[1] - (s->b[1] - p[1]) * axis[0];
    if ((da > 0 && db > 0) || (da < 0 && db < 0) || da == db)
        return -1;
    return da / (da - db);
}

/* Does a place for control point i lie beyond an end section near by, or too close to it? */
static bool is_beyond_end(const struct fit *f, size_t i, const double xy[2])
{
    for (int end = 0; end < 2; end++) {
        size_t last = end ? f->bank->n - 1 : 0;
        const double *p = rough(f, last), *q = rough(f, i), *axis = f->bank->slide[end];
        if (i == last || hypot(q[0] - p[0], q[1] - p[1]) > 2 * f->bank->reach[i])
            continue;
        double was = axis[0] * (q[1] - p[1]) - axis[1] * (q[0] - p[0]);
        double is = axis[0] * (xy[1] - p[1]) - axis[1] * (xy[0] - p[0]);
        if (was * is < CLEAR_OF_END * was * was)
            return true;
    }
    return false;
}

static bool try_segment(void *arg, const struct hm_segment *s)
{
    struct search *q = arg;
    const double *p = rough(q->fit, q->i);
    double part = q->axis ? cut_by_axis(s, p, q->axis) : hm_plane_foot(p, s->a, s->b);
    if (part < 0)
        return true;
    struct target t = {.line = s->line};
    for (int k = 0; k < 2; k++)
        t.xy[k] = s->a[k] + part * (s->b[k] - s->a[k]);
    t.far = hypot(t.xy[0] - p[0], t.xy[1] - p[1]);
    const double *behind = q->fit->b->behind[s->line] + s->piece;
    t.s = behind[0] + part * (behind[1] - behind[0]);
    if (t.far <= q->fit->bank->reach[q->i] && !is_beyond_end(q->fit, q->i, t.xy))
        keep_target(q, &t);
    return true;
}

/* What a target costs by itself: its distance, how far back from beyond the end of a breakline it
 * pulls the point, and the angle between breakline and bank. */
static void price(const struct search *q, struct target *t, const double dir[2])
{
    const struct fit *f = q->fit;
    double a[2], b[2], half = q->spacing / 2, reach = f->bank->reach[q->i];
    hm_breaklines_at(f->b, t->line, t->s - half, a);
    hm_breaklines_at(f->b, t->line, t->s + half, b);
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    for (int k = 0; k < 2; k++)
        t->dir[k] = length > 0 ? (b[k] - a[k]) / length : dir[k];
    const double *p = rough(f, q->i);
    double along = (t->xy[0] - p[0]) * t->dir[0] + (t->xy[1] - p[1]) * t->dir[1];
    double sine = t->dir[0] * dir[1] - t->dir[1] * dir[0];
    double cosine = t->dir[0] * dir[0] + t->dir[1] * dir[1];
    if (f->b->sided[t->line] && fabs(cosine) > 0.5)
        t->steep = cosine > 0 ? 1 : -1;
    double far = reach > 0 ? t->far / reach : 0;
    along = q->axis || !(half > 0) ? 0 : along / half;
    t->cost = far * far + COST_END * along * along + COST_ACROSS * sine * sine;
}

static void find_targets(struct fit *f, size_t i)
{
    size_t last = f->bank->n - 1;
    struct search q = {.fit = f, .i = i, .out = f->target + i * (MOST_TARGETS + STAYS)};
    if (i == 0 || i == last)
        q.axis = f->bank->slide[i > 0];
    double dir[2], reach = f->bank->reach[i];
    q.spacing = heading(f, i, dir);
    const double *p = rough(f, i);
    double lo[2] = {p[0] - reach, p[1] - reach}, hi[2] = {p[0] + reach, p[1] + reach};
    hm_segindex_box(f->b->index, lo, hi, try_segment, &q);
    for (int32_t k = 0; k < q.n; k++)
        price(&q, &q.out[k], dir);
    for (int steep = -1; steep <= 1; steep++)
        q.out[q.n++] =
            (struct target){.line = -1, .xy = {p[0], p[1]}, .steep = steep, .cost = COST_UNMOVED};
    f->ntargets[i] = q.n;
}

/* --- the cheapest way through the targets (dynamic programming) --- */

/* How far q lies beside the straight prolongation of the line at p, over `unit`, at most 1. */
static double offset_beside(const struct target *p, const double q[2], double unit)
{
    double side = p->dir[0] * (q[1] - p->xy[1]) - p->dir[1] * (q[0] - p->xy[0]);
    return fmin(1, fabs(side) / unit);
}

/* Do two targets lie on the same stretch of one breakline? Not when it turns back between them, as
 * where a toe runs round the end of a bank and comes back as its crest. */
static bool same_stretch(const struct fit *f, const struct target *p, const struct target *q)
{
    double straight = hypot(q->xy[0] - p->xy[0], q->xy[1] - p->xy[1]);
    return p->line >= 0 && p->line == q->line &&
           fabs(hm_breaklines_way(f->b, p->line, p->s, q->s)) <= MOST_DETOUR * straight;
}

/* The price of going from target p of point i to target q of the next; infinite for going back. A
 * toe has its steep side away from the river, a crest towards it: a bank that goes from one to the
 * other, also across points that find nothing, does so only where the rough line insists. */
static double step_cost(const struct fit *f, size_t i, const struct target *p,
                        const struct target *q)
{
    double turn = p->steep * q->steep < 0 ? COST_SWITCH : 0;
    if (q->line < 0 && p->steep != q->steep)
        return INFINITY;
    if (p->line < 0 && q->line < 0)
        return 0;
    const double *a = rough(f, i), *b = rough(f, i + 1);
    double want[2] = {b[0] - a[0], b[1] - a[1]};
    double go[2] = {q->xy[0] - p->xy[0], q->xy[1] - p->xy[1]};
    double length2 = want[0] * want[0] + want[1] * want[1];
    if (!(go[0] * want[0] + go[1] * want[1] >= LEAST_STEP * length2))
        return INFINITY;
    if (p->line < 0 || q->line < 0)
        return COST_LEAVE + turn;
    double dx = go[0] - want[0], dy = go[1] - want[1];
    double cost = COST_STRETCH * (dx * dx + dy * dy) / length2 + turn;
    if (same_stretch(f, p, q))
        return cost;
    double unit = sqrt(length2) / 2;
    double beside = offset_beside(p, q->xy, unit), before = offset_beside(q, p->xy, unit);
    return cost + COST_JUMP + COST_OFFSET * (beside * beside + before * before) / 2;
}

static void find_way(struct fit *f, const struct target **way)
{
    size_t n = f->bank->n, stride = MOST_TARGETS + STAYS;
    for (int32_t k = 0; k < f->ntargets[0]; k++)
        f->target[k].total = f->target[k].cost;
    for (size_t i = 1; i < n; i++)
        for (int32_t k = 0; k < f->ntargets[i]; k++) {
            struct target *t = &f->target[i * stride + (size_t)k];
            t->total = INFINITY;
            t->before = f->ntargets[i - 1] - 1;
            for (int32_t j = 0; j < f->ntargets[i - 1]; j++) {
                const struct target *p = &f->target[(i - 1) * stride + (size_t)j];
                double total = p->total + t->cost + step_cost(f, i - 1, p, t);
                if (total < t->total) {
                    t->total = total;
                    t->before = j;
                }
            }
        }
    int32_t best = 0;
    for (int32_t k = 1; k < f->ntargets[n - 1]; k++)
        if (f->target[(n - 1) * stride + (size_t)k].total <
            f->target[(n - 1) * stride + (size_t)best].total)
            best = k;
    for (size_t i = n; i-- > 0;) {
        way[i] = &f->target[i * stride + (size_t)best];
        best = way[i]->before;
    }
}

/* --- from targets to places --- */

/* Feet crowd on the inside of a bend and gape on the outside. Let the points glide along their
 * breakline, GLIDES times a half of the way to the middle of their neighbours: the spacing evens
 * out over a few control points, the order cannot change. None glides farther than half a control
 * distance. */
static enum hm_err glide(const struct fit *f, const struct target *const *way, double *xy,
                         struct hm_diag *d)
{
    size_t n = f->bank->n;
    double *s = hm_alloc(2 * n, sizeof *s), most = 0;
    if (!s)
        return hm_fail_memory(d);
    double *next = s + n;
    for (size_t i = 0; i < n; i++) {
        const double *p = rough(f, i), *before = rough(f, i > 0 ? i - 1 : 0);
        most += hypot(p[0] - before[0], p[1] - before[1]) / (double)(n - 1) / 2;
        s[i] = next[i] = way[i]->s;
    }
    for (int round = 0; round < GLIDES; round++) {
        for (size_t i = 1; i + 1 < n; i++) {
            int32_t l = way[i]->line;
            if (!same_stretch(f, way[i - 1], way[i]) || !same_stretch(f, way[i], way[i + 1]))
                continue;
            double back = hm_breaklines_way(f->b, l, s[i], s[i - 1]);
            double ahead = hm_breaklines_way(f->b, l, s[i], s[i + 1]);
            if ((back > 0) != (ahead > 0))
                next[i] = s[i] + (back + ahead) / 4;
            next[i] = fmin(fmax(next[i], way[i]->s - most), way[i]->s + most);
        }
        memcpy(s, next, n * sizeof *s);
    }
    for (size_t i = 0; i < n; i++) {
        memcpy(xy + 2 * i, way[i]->xy, 2 * sizeof *xy);
        if (way[i]->line >= 0 && s[i] != way[i]->s)
            hm_breaklines_at(f->b, way[i]->line, s[i], xy + 2 * i);
    }
    free(s);
    return HM_OK;
}

static void shift_of(const struct hm_bank *bank, const double *xy, size_t i, double by[2])
{
    by[0] = xy[2 * i] - bank->rough[3 * i];
    by[1] = xy[2 * i + 1] - bank->rough[3 * i + 1];
}

/* Shift unmoved point i as its moved neighbours before and behind are (n: there is none). */
static void follow(const struct hm_bank *bank, double *xy, size_t i, size_t before, size_t behind)
{
    double a[2] = {0, 0}, b[2] = {0, 0}, wa = 0, wb = 0;
    if (before < bank->n) {
        shift_of(bank, xy, before, a);
        wa = 1 - (double)(i - before) / HM_SNAP_FADE;
    }
    if (behind < bank->n) {
        shift_of(bank, xy, behind, b);
        wb = 1 - (double)(behind - i) / HM_SNAP_FADE;
    }
    if (before < bank->n && behind < bank->n) {
        wb = (double)(i - before) / (double)(behind - before);
        wa = 1 - wb;
    }
    double by[2];
    for (int k = 0; k < 2; k++)
        by[k] = fmax(0, wa) * a[k] + fmax(0, wb) * b[k];
    if (i == 0 || i + 1 == bank->n) { /* ends slide on their section only */
        const double *axis = bank->slide[i > 0];
        double along = by[0] * axis[0] + by[1] * axis[1];
        by[0] = along * axis[0];
        by[1] = along * axis[1];
    }
    xy[2 * i] = bank->rough[3 * i] + by[0];
    xy[2 * i + 1] = bank->rough[3 * i + 1] + by[1];
}

static void follow_neighbours(const struct hm_bank *bank, const bool *moved, double *xy)
{
    size_t before = bank->n, behind = 0;
    for (size_t i = 0; i < bank->n; i++) {
        if (moved[i]) {
            before = i;
            continue;
        }
        if (behind <= i)
            for (behind = i + 1; behind < bank->n && !moved[behind]; behind++)
                ;
        follow(bank, xy, i, before, behind);
    }
}

enum hm_err hm_snap_bank(const struct hm_breaklines *b, const struct hm_bank *bank, double *xy,
                         bool *moved, struct hm_diag *d)
{
    struct fit f = {.b = b, .bank = bank};
    f.target = hm_alloc0(bank->n, (MOST_TARGETS + STAYS) * sizeof *f.target);
    f.ntargets = hm_alloc(bank->n, sizeof *f.ntargets);
    const struct target **way = hm_alloc(bank->n, sizeof *way);
    enum hm_err err = f.target && f.ntargets && way ? HM_OK : hm_fail_memory(d);
    if (!err) {
        for (size_t i = 0; i < bank->n; i++)
            find_targets(&f, i);
        find_way(&f, way);
        err = glide(&f, way, xy, d);
    }
    if (!err) {
        for (size_t i = 0; i < bank->n; i++)
            moved[i] = way[i]->line >= 0;
        follow_neighbours(bank, moved, xy);
    }
    free(f.target);
    free(f.ntargets);
    free(way);
    return err;
}
