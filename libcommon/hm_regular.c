#include "hm_regular.h"

#include "hm_coons.h"
#include "hm_drape.h"
#include "hm_polyline.h"
#include "hm_stations.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hm_regular_free(struct hm_regular *s)
{
    hm_bsurf_free(&s->surface);
    for (int side = 0; side < 2; side++) {
        free(s->laid[side]);
        free(s->passed[side]);
        free(s->snapped[side]);
    }
    *s = (struct hm_regular){0};
}

/* --- the control net in the plane --- */

/* What is on the way to the net: both banks as control points, and where the net shall pass. */
struct plan {
    const struct hm_rough *rough;
    struct hm_regular *out;
    size_t n, m;
    double *reach; /* n */
    double *u, *v; /* parameters of columns and rows, 0 .. 1 */
    double *z;     /* n × m × 3: what the surface passes through at its Greville sites */
};

static void plan_free(struct plan *p)
{
    free(p->reach);
    free(p->u);
    free(p->v);
    free(p->z);
}

static double apart(const double *a, const double *b)
{
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* Parameters of columns (equal) and of rows (v runs from right to left, fractions the other way).
 */
static enum hm_err divide_sections(struct plan *p, struct hm_diag *d)
{
    const struct hm_rough_size *size = &p->rough->size;
    double width = 0;
    for (size_t i = 0; i < p->n; i++)
        width +=
            apart(p->out->laid[HM_LEFT] + 3 * i, p->out->laid[HM_RIGHT] + 3 * i) / (double)p->n;
    p->m = size->nfractions;
    if (p->m == 0) {
        const double *start = p->out->laid[HM_RIGHT];
        if (size->across > width)
            return hm_fail_at(d, HM_EGEOM, start[0], start[1],
                              "control points every %g m across surface '%s' are farther apart "
                              "than its banks (%.4g m)",
                              size->across, p->rough->name, width);
        double pieces = floor(width / size->across + 0.5);
        if (pieces * (double)p->n > INT32_MAX / 8)
            return hm_fail(d, HM_ENOMEM, "control points every %g m are too many for surface '%s'",
                           size->across, p->rough->name);
        p->m = (size_t)pieces + 1;
    }
    p->u = hm_alloc(p->n, sizeof *p->u);
    p->v = hm_alloc(p->m, sizeof *p->v);
    if (!p->u || !p->v)
        return hm_fail_memory(d);
    for (size_t i = 0; i < p->n; i++)
        p->u[i] = (double)i / (double)(p->n - 1);
    for (size_t j = 0; j < p->m; j++)
        p->v[j] =
            size->nfractions ? 1 - size->fraction[p->m - 1 - j] : (double)j / (double)(p->m - 1);
    return HM_OK;
}

/* Unit vector along a section at its right (0) or left (1) end. */
static void slide_direction(const struct hm_line *section, int end, double dir[2])
{
    size_t pieces = hm_polyline_pieces(section);
    dir[0] = 1;
    dir[1] = 0;
    for (size_t i = 0; i < pieces; i++) {
        size_t k = end ? pieces - 1 - i : i;
        const double *a = hm_polyline_from(section, k), *b = hm_polyline_to(section, k);
        double length = apart(a, b);
        if (length > 0) {
            dir[0] = (b[0] - a[0]) / length;
            dir[1] = (b[1] - a[1]) / length;
            return;
        }
    }
}

static void tell_moves(struct plan *p, int side)
{
    struct hm_regular *s = p->out;
    for (size_t i = 0; i < p->n; i++) {
        const double *from = p->out->laid[side] + 3 * i;
        double far = apart(from, p->out->passed[side] + 2 * i);
        s->moved += s->snapped[side][i];
        if (s->snapped[side][i] && far > s->largest) {
            s->largest = far;
            s->largest_at[0] = from[0];
            s->largest_at[1] = from[1];
        }
    }
}

/* No point moves nearly as far as half the river is wide, or both banks might take one breakline.
 */
static enum hm_err snap_banks(struct plan *p, const struct hm_breaklines *breaklines,
                              struct hm_diag *d)
{
    static const double most_of_width = 0.45;
    p->reach = hm_alloc(p->n, sizeof *p->reach);
    if (!p->reach)
        return hm_fail_memory(d);
    for (size_t i = 0; i < p->n; i++)
        p->reach[i] = fmin(p->rough->size.snap,
                           most_of_width * apart(p->out->laid[0] + 3 * i, p->out->laid[1] + 3 * i));
    for (int side = 0; side < 2; side++) {
        struct hm_bank bank = {.n = p->n, .rough = p->out->laid[side], .reach = p->reach};
        slide_direction(&p->rough->side[HM_INFLOW], side == HM_LEFT, bank.slide[0]);
        slide_direction(&p->rough->side[HM_OUTFLOW], side == HM_LEFT, bank.slide[1]);
        p->out->passed[side] = hm_alloc(p->n, 2 * sizeof *p->out->passed[side]);
        p->out->snapped[side] = hm_alloc(p->n, sizeof *p->out->snapped[side]);
        if (!p->out->passed[side] || !p->out->snapped[side])
            return hm_fail_memory(d);
        enum hm_err err =
            hm_snap_bank(breaklines, &bank, p->out->passed[side], p->out->snapped[side], d);
        if (err)
            return err;
        tell_moves(p, side);
    }
    return HM_OK;
}

/* The inner points of an end section: its shape, shifted to the snapped ends. */
static void lay_section(struct plan *p, const struct hm_line *section, size_t i)
{
    double length = hm_polyline_length(section), shift[2][2];
    const double *end[2] = {p->z + 3 * i, p->z + 3 * ((p->m - 1) * p->n + i)};
    for (int k = 0; k < 2; k++) {
        shift[0][k] = end[0][k] - section->xyz[k];
        shift[1][k] = end[1][k] - section->xyz[3 * (section->n - 1) + (size_t)k];
    }
    for (size_t j = 1; j + 1 < p->m; j++) {
        double at[3], v = p->v[j];
        hm_polyline_at(section, v * length, at);
        for (int k = 0; k < 2; k++)
            p->z[3 * (j * p->n + i) + (size_t)k] = at[k] + (1 - v) * shift[0][k] + v * shift[1][k];
    }
}

/* Where the surface shall pass: snapped banks, end sections, Coons patch inside; z not known. */
static enum hm_err lay_net(struct plan *p, struct hm_diag *d)
{
    p->z = hm_alloc(p->n * p->m, 3 * sizeof *p->z);
    if (!p->z)
        return hm_fail_memory(d);
    for (size_t k = 0; k < p->n * p->m; k++)
        p->z[3 * k] = p->z[3 * k + 1] = p->z[3 * k + 2] = NAN;
    for (size_t i = 0; i < p->n; i++) {
        memcpy(p->z + 3 * i, p->out->passed[HM_RIGHT] + 2 * i, 2 * sizeof *p->z);
        memcpy(p->z + 3 * ((p->m - 1) * p->n + i), p->out->passed[HM_LEFT] + 2 * i,
               2 * sizeof *p->z);
    }
    lay_section(p, &p->rough->side[HM_INFLOW], 0);
    lay_section(p, &p->rough->side[HM_OUTFLOW], p->n - 1);
    hm_coons_fill(p->z, p->n, p->m, 3, p->u, p->v);
    return HM_OK;
}

/* Drag x and y until the surface passes through the net's points (to a millionth of a control
 * distance; the dragging converges by 3/4 at least in each iteration). */
static enum hm_err drag_plane(struct plan *p, const struct hm_regular_how *how, struct hm_diag *d)
{
    struct hm_bsurf *s = &p->out->surface;
    enum hm_err err = hm_bsurf_init(s, how->degree, p->n, p->m, 3, d);
    if (err)
        return err;
    for (size_t j = 0; j < p->m; j++)
        for (size_t i = 0; i < p->n; i++) {
            double *c = hm_bsurf_at(s, (int64_t)i, (int64_t)j);
            memcpy(c, p->z + 3 * (j * p->n + i), 2 * sizeof *c);
            c[2] = 0;
        }
    double rest = INFINITY, good = 1e-6 * p->rough->size.along;
    for (int round = 0; !err && rest > good && round < 20; round++)
        err = hm_bspline_drag(s, p->z, 8, 0, how->threads, &rest, d);
    return err;
}

/* --- heights --- */

enum {
    CHUNK = 1024,
    SAMPLES = 4 /* of the terrain, to a cell of control points in each direction */
};

struct sampling {
    const struct hm_terrain *terrain;
    struct plan *plan;
    double *z; /* na × nb samples, as hm_drape wants them */
    size_t na, nb;
};

/* z where the surface has its Greville sites, and at the control points themselves, from where the
 * dragging starts: on a plane the surface then is that plane before the first iteration. */
static void sample_net(void *arg, size_t chunk)
{
    const struct sampling *q = arg;
    const struct plan *p = q->plan;
    size_t end = (chunk + 1) * CHUNK < p->n * p->m ? (chunk + 1) * CHUNK : p->n * p->m;
    int32_t hint = 0;
    for (size_t k = chunk * CHUNK; k < end; k++) {
        double *b = p->z + 3 * k;
        double *c = hm_bsurf_at(&p->out->surface, (int64_t)(k % p->n), (int64_t)(k / p->n));
        hm_bspline_eval(&p->out->surface, (double)(k % p->n), (double)(k / p->n), b, NULL, NULL);
        b[2] = hm_terrain_z(q->terrain, b[0], b[1], &hint);
        c[2] = hm_terrain_z(q->terrain, c[0], c[1], &hint);
    }
}

static void sample_terrain(void *arg, size_t chunk)
{
    const struct sampling *q = arg;
    size_t all = q->na * q->nb, end = (chunk + 1) * CHUNK < all ? (chunk + 1) * CHUNK : all;
    int32_t hint = 0;
    for (size_t k = chunk * CHUNK; k < end; k++) {
        double b[3];
        hm_bspline_eval(&q->plan->out->surface, (double)(k % q->na) / SAMPLES,
                        (double)(k / q->na) / SAMPLES, b, NULL, NULL);
        q->z[k] = hm_terrain_z(q->terrain, b[0], b[1], &hint);
    }
}

/* The nearest point of known height from (i, j) in one direction of the net; NULL: none. */
static const double *look(const struct plan *p, size_t i, size_t j, int di, int dj)
{
    for (;;) {
        if ((di < 0 && i == 0) || (di > 0 && i + 1 == p->n) || (dj < 0 && j == 0) ||
            (dj > 0 && j + 1 == p->m))
            return NULL;
        i += (size_t)di;
        j += (size_t)dj;
        const double *b = p->z + 3 * (j * p->n + i);
        if (!isnan(b[2]))
            return b;
    }
}

/* A height between what is known: linear between the nearest points before and behind, and between
 * those to the right and left, the nearer pair counting more. Without a whole pair the nearest
 * single point; NaN without any. */
static double fill_height(const struct plan *p, size_t i, size_t j)
{
    const double *here = p->z + 3 * (j * p->n + i);
    double sum = 0, weights = 0, nearest = INFINITY, single = NAN;
    for (int axis = 0; axis < 2; axis++) {
        const double *a = look(p, i, j, axis ? 0 : -1, axis ? -1 : 0);
        const double *b = look(p, i, j, axis ? 0 : 1, axis ? 1 : 0);
        double da = a ? apart(here, a) : INFINITY, db = b ? apart(here, b) : INFINITY;
        if (fmin(da, db) < nearest) {
            nearest = fmin(da, db);
            single = da <= db ? a[2] : b[2];
        }
        if (a && b && da + db > 0) {
            double w = 1 / (da + db);
            sum += w * (a[2] * db + b[2] * da) / (da + db);
            weights += w;
        }
    }
    return weights > 0 ? sum / weights : single;
}

static bool column_known(const struct plan *p, size_t i)
{
    for (size_t j = 0; j < p->m; j++)
        if (!isnan(p->z[3 * (j * p->n + i) + 2]))
            return true;
    return false;
}

/* Heights are filled between what is known, never carried on beyond it: the first and the last
 * cross section need terrain. */
static enum hm_err check_cover(const struct plan *p, double gap, struct hm_diag *d)
{
    for (int end = 0; end < 2; end++) {
        size_t i = end ? p->n - 1 : 0, missing = 0;
        while (missing < p->n && !column_known(p, end ? p->n - 1 - missing : missing))
            missing++;
        const double *b = p->z + 3 * i;
        if (missing > 0)
            return hm_fail_at(
                d, HM_EGEOM, b[0], b[1],
                "no terrain under %ssurface '%s'; between measurements more than %g m "
                "apart it is not known (-g)",
                missing == p->n ? ""
                : end           ? "the outflow end of "
                                : "the inflow end of ",
                p->rough->name, gap);
    }
    return HM_OK;
}

/* A start for every control point: the terrain, or a height filled in. */
static void start_heights(const struct plan *p)
{
    struct hm_regular *out = p->out;
    for (size_t k = 0; k < p->n * p->m; k++) {
        double *c = hm_bsurf_at(&out->surface, (int64_t)(k % p->n), (int64_t)(k / p->n));
        const double *b = p->z + 3 * k;
        if (isnan(b[2]) && out->unknown++ == 0)
            memcpy(out->unknown_at, b, sizeof out->unknown_at);
        if (isnan(c[2]))
            c[2] = isnan(b[2]) ? fill_height(p, k % p->n, k / p->n) : b[2];
    }
}

static enum hm_err drag_heights(struct plan *p, const struct hm_terrain *terrain,
                                const struct hm_regular_how *how, struct hm_diag *d)
{
    struct sampling q = {terrain, p, NULL, (p->n - 1) * SAMPLES + 1, (p->m - 1) * SAMPLES + 1};
    hm_thread_for(how->threads, (p->n * p->m + CHUNK - 1) / CHUNK, sample_net, &q);
    enum hm_err err = check_cover(p, how->gap, d);
    if (err)
        return err;
    start_heights(p);
    q.z = hm_alloc(q.na * q.nb, sizeof *q.z);
    if (!q.z)
        return hm_fail_memory(d);
    hm_thread_for(how->threads, (q.na * q.nb + CHUNK - 1) / CHUNK, sample_terrain, &q);
    err = hm_drape(&p->out->surface, q.z, q.na, q.nb, how->iterations, how->threads, d);
    free(q.z);
    return err;
}

enum hm_err hm_regular_surface(struct hm_regular *s, const struct hm_rough *rough,
                               const struct hm_breaklines *breaklines,
                               const struct hm_terrain *terrain, const struct hm_regular_how *how,
                               struct hm_diag *d)
{
    *s = (struct hm_regular){0};
    struct plan p = {.rough = rough, .out = s};
    enum hm_err err = hm_stations_lay(rough, how->orthogonal, s->laid, &p.n, d);
    if (!err)
        err = divide_sections(&p, d);
    if (!err)
        err = snap_banks(&p, breaklines, d);
    if (!err)
        err = lay_net(&p, d);
    if (!err)
        err = drag_plane(&p, how, d);
    if (!err)
        err = drag_heights(&p, terrain, how, d);
    plan_free(&p);
    if (err)
        hm_regular_free(s);
    return err;
}
