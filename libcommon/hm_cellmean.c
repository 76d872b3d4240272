#include "hm_cellmean.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64, EMPTY = -1 };

struct cell {
    double sum;
    uint64_t count;
};

struct tile {
    int64_t i0, j0; /* numbers of its first cell, multiples of SIDE */
    double *place;  /* sums of the distances from the nodes in x and y, in cells; or NULL */
    struct cell cell[SIDE * SIDE];
};

/* Tiles are found by an open hash table of their first cells. */
struct hm_cellmean {
    double spacing;
    bool places;
    struct tile **tile;
    size_t ntiles, cap;
    int64_t *slot; /* tile number or EMPTY */
    size_t nslots; /* a power of 2, more than twice ntiles */
    struct tile *last;
};

enum hm_err hm_cellmean_new(struct hm_cellmean **c, double spacing, bool places, struct hm_diag *d)
{
    enum { FIRST_SLOTS = 64 };
    *c = hm_alloc0(1, sizeof **c);
    if (!*c)
        return hm_fail_memory(d);
    (*c)->spacing = spacing;
    (*c)->places = places;
    (*c)->slot = hm_alloc(FIRST_SLOTS, sizeof *(*c)->slot);
    if (!(*c)->slot) {
        hm_cellmean_free(*c);
        *c = NULL;
        return hm_fail_memory(d);
    }
    (*c)->nslots = FIRST_SLOTS;
    for (size_t k = 0; k < FIRST_SLOTS; k++)
        (*c)->slot[k] = EMPTY;
    return HM_OK;
}

void hm_cellmean_free(struct hm_cellmean *c)
{
    if (!c)
        return;
    for (size_t k = 0; k < c->ntiles; k++) {
        free(c->tile[k]->place);
        free(c->tile[k]);
    }
    free(c->tile);
    free(c->slot);
    free(c);
}

/* The slot of a tile, or the empty one where it would go. */
static size_t find_slot(const struct hm_cellmean *c, int64_t i0, int64_t j0)
{
    uint64_t hash = (uint64_t)i0 * 0x9E3779B97F4A7C15u + (uint64_t)j0 * 0xC2B2AE3D27D4EB4Fu;
    size_t k = (size_t)(hash >> 32) & (c->nslots - 1);
    while (c->slot[k] != EMPTY && (c->tile[c->slot[k]]->i0 != i0 || c->tile[c->slot[k]]->j0 != j0))
        k = (k + 1) & (c->nslots - 1);
    return k;
}

static bool more_slots(struct hm_cellmean *c)
{
    int64_t *old = c->slot;
    int64_t *slot = hm_alloc(2 * c->nslots, sizeof *slot);
    if (!slot)
        return false;
    c->slot = slot;
    c->nslots *= 2;
    for (size_t k = 0; k < c->nslots; k++)
        slot[k] = EMPTY;
    for (size_t t = 0; t < c->ntiles; t++)
        slot[find_slot(c, c->tile[t]->i0, c->tile[t]->j0)] = (int64_t)t;
    free(old);
    return true;
}

static struct tile *new_tile(const struct hm_cellmean *c, int64_t i0, int64_t j0)
{
    struct tile *t = hm_alloc0(1, sizeof *t);
    if (!t)
        return NULL;
    t->i0 = i0;
    t->j0 = j0;
    if (c->places) {
        t->place = hm_alloc0(2 * SIDE * SIDE, sizeof *t->place);
        if (!t->place) {
            free(t);
            return NULL;
        }
    }
    return t;
}

/* A tile that was not the last: found, or made. */
static struct tile *find_tile(struct hm_cellmean *c, int64_t i0, int64_t j0)
{
    size_t k = find_slot(c, i0, j0);
    if (c->slot[k] == EMPTY) {
        if (!hm_grow(&c->tile, &c->cap, c->ntiles + 1, sizeof *c->tile))
            return NULL;
        if (2 * (c->ntiles + 1) >= c->nslots) {
            if (!more_slots(c))
                return NULL;
            k = find_slot(c, i0, j0);
        }
        struct tile *t = new_tile(c, i0, j0);
        if (!t)
            return NULL;
        c->tile[c->ntiles] = t;
        c->slot[k] = (int64_t)c->ntiles++;
    }
    return c->tile[c->slot[k]];
}

/* The number of the cell that is u spacings from the origin: floor(u + 1/2). */
static inline int64_t cell_number(double u)
{
    int64_t n = (int64_t)(u + 0.5);
    return n - ((double)n > u + 0.5);
}

enum hm_err hm_cellmean_add(struct hm_cellmean *c, const double *xyz, size_t n, struct hm_diag *d)
{
    const double farthest = 1e15; /* cells from the origin: doubles still tell neighbours apart */
    const double spacing = c->spacing;
    struct tile *t = c->last;
    for (const double *p = xyz; p < xyz + 3 * n; p += 3) {
        double u = p[0] / spacing, v = p[1] / spacing;
        if (!(fabs(u) <= farthest) || !(fabs(v) <= farthest))
            return hm_fail_at(d, HM_EGEOM, p[0], p[1], "a point too far off for a spacing of %g",
                              spacing);
        int64_t i = cell_number(u), j = cell_number(v);
        int64_t a = i & (SIDE - 1), b = j & (SIDE - 1); /* in its tile, for any sign */
        if ((!t || t->i0 != i - a || t->j0 != j - b) && !(t = find_tile(c, i - a, j - b)))
            return hm_fail_memory(d);
        struct cell *cell = &t->cell[b * SIDE + a];
        cell->sum += p[2];
        cell->count++;
        if (t->place) {
            double *place = t->place + 2 * (b * SIDE + a);
            place[0] += u - (double)i;
            place[1] += v - (double)j;
        }
    }
    c->last = t;
    return HM_OK;
}

/* The part of [0, count) that lies in a tile beginning at `start` (both counted from the same). */
static void overlap(int64_t start, size_t count, int64_t *low, int64_t *high)
{
    *low = start > 0 ? start : 0;
    *high = start + SIDE < (int64_t)count ? start + SIDE : (int64_t)count;
}

/* The nodes of `a` that are cells of a tile, and the tile's first cell, both counted in `a`. */
struct part {
    int64_t left, bottom, i0, i1, j0, j1;
};

static struct part part_in(const struct tile *t, const struct hm_anchor *a)
{
    struct part p = {.left = t->i0 - a->i0, .bottom = t->j0 - a->j0};
    overlap(p.left, a->nx, &p.i0, &p.i1);
    overlap(p.bottom, a->ny, &p.j0, &p.j1);
    return p;
}

/* out[node] = sum / count or, without sums, count; `empty` where there is no point. */
static void spread(const struct hm_cellmean *c, const struct hm_anchor *a, bool sums, double empty,
                   double *out)
{
    for (size_t k = 0; k < a->nx * a->ny; k++)
        out[k] = empty;
    for (size_t k = 0; k < c->ntiles; k++) {
        const struct tile *t = c->tile[k];
        struct part p = part_in(t, a);
        for (int64_t j = p.j0; j < p.j1; j++)
            for (int64_t i = p.i0; i < p.i1; i++) {
                const struct cell *cell = &t->cell[(j - p.bottom) * SIDE + (i - p.left)];
                double n = (double)cell->count;
                if (cell->count)
                    out[(size_t)j * a->nx + (size_t)i] = sums ? cell->sum / n : n;
            }
    }
}

void hm_cellmean_get(const struct hm_cellmean *c, const struct hm_anchor *a, double *z)
{
    spread(c, a, true, NAN, z);
}

void hm_cellmean_counts(const struct hm_cellmean *c, const struct hm_anchor *a, double *count)
{
    spread(c, a, false, 0, count);
}

enum hm_err hm_cellmean_points(const struct hm_cellmean *c, const struct hm_anchor *a, double **xyz,
                               size_t *n, struct hm_diag *d)
{
    size_t cap = 0;
    *xyz = NULL;
    *n = 0;
    for (size_t k = 0; k < c->ntiles; k++) {
        const struct tile *t = c->tile[k];
        for (int64_t cell = 0; cell < SIDE * SIDE; cell++) {
            int64_t i = t->i0 + cell % SIDE, j = t->j0 + cell / SIDE;
            double count = (double)t->cell[cell].count;
            if (!t->cell[cell].count || i < a->i0 || i >= a->i0 + (int64_t)a->nx || j < a->j0 ||
                j >= a->j0 + (int64_t)a->ny)
                continue;
            if (!hm_grow(xyz, &cap, 3 * (*n + 1), sizeof **xyz)) {
                free(*xyz);
                *xyz = NULL;
                return hm_fail_memory(d);
            }
            double *p = *xyz + 3 * (*n)++;
            p[0] = ((double)i + t->place[2 * cell] / count) * c->spacing;
            p[1] = ((double)j + t->place[2 * cell + 1] / count) * c->spacing;
            p[2] = t->cell[cell].sum / count;
        }
    }
    return HM_OK;
}
