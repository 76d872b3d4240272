#include "hm_residual.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINE_BINS = 100000, COARSE_BINS = 100000 };
static const double FINE = 1e4, COARSE = 10; /* bins a metre */

enum hm_residual_class hm_residual_classify(double residual, const double thresholds[2])
{
    if (isnan(residual))
        return HM_RESIDUAL_NONE;
    double r = fabs(residual);
    return r <= thresholds[0]   ? HM_RESIDUAL_GREEN
           : r <= thresholds[1] ? HM_RESIDUAL_YELLOW
                                : HM_RESIDUAL_RED;
}

/* The mixing function of splitmix64 (Steele, Lea & Flood 2014) on a counter that starts at the
 * mixed seed. */
static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

double hm_residual_lot(uint64_t seed, uint64_t ordinal)
{
    uint64_t hash = mix(mix(seed) + (ordinal + 1) * 0x9e3779b97f4a7c15);
    return (double)(hash >> 11) * 0x1p-53 * 100;
}

void hm_residuals_init(struct hm_residuals *s, const double thresholds[2], double bound)
{
    *s = (struct hm_residuals){.bound = bound, .thresholds = {thresholds[0], thresholds[1]}};
}

void hm_residuals_free(struct hm_residuals *s)
{
    free(s->bins);
    *s = (struct hm_residuals){0};
}

static size_t bin_of(double r)
{
    if (r * FINE < FINE_BINS)
        return (size_t)(r * FINE);
    double coarse = (r - FINE_BINS / FINE) * COARSE;
    return FINE_BINS + (coarse < COARSE_BINS - 1 ? (size_t)coarse : COARSE_BINS - 1);
}

/* The upper end of a bin. */
static double bin_end(size_t bin)
{
    if (bin < FINE_BINS)
        return (double)(bin + 1) / FINE;
    return FINE_BINS / FINE + (double)(bin - FINE_BINS + 1) / COARSE;
}

static bool reach_bin(struct hm_residuals *s, size_t bin)
{
    size_t cap = s->nbins;
    if (bin < s->nbins)
        return true;
    if (!hm_grow(&s->bins, &cap, bin + 1, sizeof *s->bins))
        return false;
    memset(s->bins + s->nbins, 0, (cap - s->nbins) * sizeof *s->bins);
    s->nbins = cap;
    return true;
}

/* Mean and sums of powers of what is off it, without sums that cancel (Welford 1962; Terriberry
 * 2007 for the third and fourth). */
static void add_moments(struct hm_residuals *s, double r)
{
    double n = (double)s->n, off = r - s->mean, part = off / n, part2 = part * part;
    double term = off * part * (n - 1);
    s->mean += part;
    s->m4 += term * part2 * (n * n - 3 * n + 3) + 6 * part2 * s->m2 - 4 * part * s->m3;
    s->m3 += term * part * (n - 2) - 3 * part * s->m2;
    s->m2 += term;
}

enum hm_err hm_residuals_add(struct hm_residuals *s, struct hm_residual r, struct hm_diag *d)
{
    double size = fabs(r.r);
    size_t bin = bin_of(size);
    if (!reach_bin(s, bin))
        return hm_fail_memory(d);
    if (s->n++ == 0)
        s->least = s->most = r;
    if (r.r < s->least.r)
        s->least = r;
    if (r.r > s->most.r)
        s->most = r;
    s->count[hm_residual_classify(r.r, s->thresholds)]++;
    s->within += size <= s->bound;
    s->bins[bin]++;
    add_moments(s, r.r);
    return HM_OK;
}

double hm_residuals_mean(const struct hm_residuals *s)
{
    return s->n ? s->mean : NAN;
}

double hm_residuals_sigma(const struct hm_residuals *s)
{
    return s->n ? sqrt(s->m2 / (double)s->n) : NAN;
}

double hm_residuals_rmse(const struct hm_residuals *s)
{
    return hypot(hm_residuals_mean(s), hm_residuals_sigma(s));
}

double hm_residuals_skew(const struct hm_residuals *s)
{
    return s->m2 > 0 ? sqrt((double)s->n) * s->m3 / (s->m2 * sqrt(s->m2)) : NAN;
}

double hm_residuals_kurtosis(const struct hm_residuals *s)
{
    return s->m2 > 0 ? (double)s->n * s->m4 / (s->m2 * s->m2) - 3 : NAN;
}

static double percent_of(const struct hm_residuals *s, int64_t count)
{
    return s->n ? 100 * (double)count / (double)s->n : NAN;
}

double hm_residuals_share(const struct hm_residuals *s, enum hm_residual_class c)
{
    return percent_of(s, s->count[c]);
}

double hm_residuals_within(const struct hm_residuals *s)
{
    return percent_of(s, s->within);
}

double hm_residuals_percentile(const struct hm_residuals *s, double percent)
{
    if (!s->n)
        return NAN;
    double wanted = percent / 100 * (double)s->n, largest = fmax(fabs(s->least.r), fabs(s->most.r));
    uint64_t seen = 0;
    for (size_t bin = 0; bin < s->nbins && bin + 1 < FINE_BINS + COARSE_BINS; bin++) {
        seen += s->bins[bin];
        if (seen > 0 && (double)seen >= wanted)
            return fmin(bin_end(bin), largest);
    }
    return largest;
}
