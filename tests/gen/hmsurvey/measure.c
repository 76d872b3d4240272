#include "measure.h"

#include "rng.h"

#include <math.h>

enum { HOLES = 6 };

static const double tile = 200, strip = 2.4; /* metres: edge of a tile, width of the gap beside */

struct hole {
    double at[2], rx, ry;
};

static enum hm_err put(struct cloud *c, double x, double y, double z, struct hm_diag *d)
{
    if (!hm_grow(&c->p, &c->cap, c->n + 1, sizeof *c->p))
        return hm_fail_memory(d);
    c->p[c->n][0] = x;
    c->p[c->n][1] = y;
    c->p[c->n][2] = z;
    c->n++;
    return HM_OK;
}

/* Elliptic holes in the floodplain, clear of every feature. */
static void make_holes(struct hole *hole, const struct terrain *t, struct rng *rng)
{
    for (int k = 0; k < HOLES; k++) {
        bool clear = false;
        while (!clear) {
            hole[k].at[0] = rng_uniform(rng, 0.05 * t->w, 0.95 * t->w);
            hole[k].at[1] = rng_uniform(rng, 0.05 * t->h, 0.95 * t->h);
            hole[k].rx = rng_uniform(rng, 3, 6);
            hole[k].ry = rng_uniform(rng, 3, 6);
            clear = true;
            for (enum feature f = MAIN; f < FEATURES; f++) {
                double s;
                clear &= curve_distance(&t->axis[f], hole[k].at, 30, &s) > 30;
            }
        }
    }
}

static bool is_seen(const struct hole *hole, double x, double y)
{
    double east = fmod(x, tile), north = fmod(y, tile);
    if ((x > tile / 2 && fmin(east, tile - east) < strip / 2) ||
        (y > tile / 2 && fmin(north, tile - north) < strip / 2))
        return false;
    for (int k = 0; k < HOLES; k++) {
        double ex = (x - hole[k].at[0]) / hole[k].rx, ey = (y - hole[k].at[1]) / hole[k].ry;
        if (ex * ex + ey * ey < 1)
            return false;
    }
    return true;
}

static void throw_blunders(struct cloud *c, size_t from, size_t blunders, struct rng *rng)
{
    /* One in each of as many stretches of the cloud, so that none is hit twice. */
    size_t n = c->n - from;
    for (size_t k = 0; k < blunders && blunders <= n; k++) {
        size_t lo = from + n / blunders * k;
        double *p = c->p[lo + (size_t)rng_uniform(rng, 0, (double)(n / blunders))];
        p[2] += rng_sign(rng) * rng_uniform(rng, 2, 8);
    }
}

enum hm_err measure_lidar(struct cloud *c, const struct terrain *t, double density, double sigma,
                          size_t blunders, uint64_t seed, struct hm_diag *d)
{
    struct rng rng = {seed};
    struct hole hole[HOLES];
    const double fx = 12.0 / 13, fy = 5.0 / 13; /* direction of flight */
    const double along = sqrt(1.25 / density), across = 1 / (density * along);
    const double reach = t->w * fy + t->h * fx;
    size_t from = c->n;
    make_holes(hole, t, &rng);
    for (double f = 0; f < t->w * fx + t->h * fy; f += along) {
        double phase = rng_uniform(&rng, 0, across);
        for (double s = -t->w * fy + phase; s < reach - t->w * fy; s += across) {
            double a = f + rng_uniform(&rng, -0.35, 0.35) * along;
            double b = s + rng_uniform(&rng, -0.35, 0.35) * across;
            double x = floor(100 * (a * fx - b * fy) + 0.5) / 100;
            double y = floor(100 * (a * fy + b * fx) + 0.5) / 100;
            if (x < 0 || y < 0 || x > t->w || y > t->h || !is_seen(hole, x, y))
                continue;
            double z = terrain_z(t, x, y);
            if (z < terrain_water(x, y))
                continue;
            if (put(c, x, y, z + sigma * rng_normal(&rng), d))
                return d ? d->err : HM_ENOMEM;
        }
    }
    throw_blunders(c, from, blunders, &rng);
    return HM_OK;
}

/* Offsets of the soundings of a section: middle, toes, halfway, and just inside the water's edge.
 */
enum { SOUNDINGS = 7 };
static void sound_offsets(enum feature f, double offset[SOUNDINGS])
{
    const struct section *s = &terrain_section[f];
    const double edge = s->half + s->run * (s->height - 2) - 0.3;
    const double side[] = {-edge, -s->half, -s->half / 2, 0, s->half / 2, s->half, edge};
    for (int k = 0; k < SOUNDINGS; k++)
        offset[k] = side[k];
}

/* One row of soundings at parameter s; heights from `z`. Those where another river is deeper, or
 * outside the domain, are left out. */
static enum hm_err put_row(struct cloud *c, const struct terrain *t, enum feature f, double s,
                           const double z[SOUNDINGS], struct hm_diag *d)
{
    double offset[SOUNDINGS], p[2];
    sound_offsets(f, offset);
    for (int k = 0; k < SOUNDINGS; k++) {
        curve_offset(&t->axis[f], s, offset[k], p);
        double x = floor(100 * p[0] + 0.5) / 100, y = floor(100 * p[1] + 0.5) / 100;
        if (x < 0 || y < 0 || x > t->w || y > t->h ||
            terrain_z(t, x, y) < terrain_feature(t, f, x, y) - 1e-9)
            continue;
        if (put(c, x, y, z[k], d))
            return d ? d->err : HM_ENOMEM;
    }
    return HM_OK;
}

static void sound(const struct terrain *t, enum feature f, double s, double sigma, struct rng *rng,
                  double z[SOUNDINGS])
{
    double offset[SOUNDINGS], p[2];
    sound_offsets(f, offset);
    for (int k = 0; k < SOUNDINGS; k++) {
        curve_offset(&t->axis[f], s, offset[k], p);
        z[k] = terrain_feature(t, f, p[0], p[1]) + sigma * rng_normal(rng);
    }
}

enum hm_err measure_bathymetry(struct cloud *c, const struct terrain *t, double sigma,
                               uint64_t seed, struct hm_diag *d)
{
    struct rng rng = {seed ^ 0x5bd1e995};
    for (enum feature f = MAIN; f <= TRIBUTARY; f++) {
        double s = 0, here[SOUNDINGS], next[SOUNDINGS], z[SOUNDINGS];
        sound(t, f, s, sigma, &rng, here);
        while (s < curve_end(&t->axis[f])) {
            double far = curve_advance(&t->axis[f], s, 20);
            sound(t, f, far, sigma, &rng, next);
            for (int part = 0; part < 4; part++) {
                for (int k = 0; k < SOUNDINGS; k++)
                    z[k] = here[k] + (next[k] - here[k]) * part / 4;
                if (put_row(c, t, f, s + (far - s) * part / 4, z, d))
                    return d ? d->err : HM_ENOMEM;
            }
            for (int k = 0; k < SOUNDINGS; k++)
                here[k] = next[k];
            s = far;
        }
    }
    return HM_OK;
}
