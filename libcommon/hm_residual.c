#include "hm_residual.h"

#include <math.h>
#include <stdlib.h>

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

bool hm_residual_sampled(uint64_t seed, uint64_t ordinal, double percent)
{
    uint64_t hash = mix(mix(seed) + (ordinal + 1) * 0x9e3779b97f4a7c15);
    return (double)(hash >> 11) * 0x1p-53 * 100 < percent;
}

enum hm_err hm_residuals_init(struct hm_residuals *s, const double thresholds[2], double bound,
                              struct hm_diag *d)
{
    *s = (struct hm_residuals){.bound = bound, .thresholds = {thresholds[0], thresholds[1]}};
    s->bins = hm_alloc0(FINE_BINS + COARSE_BINS, sizeof *s->bins);
    return s->bins ? HM_OK : hm_fail_memory(d);
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

void hm_residuals_add(struct hm_residuals *s, struct hm_residual r)
{
    if (s->n++ == 0) {
        s->least = s->most = r;
        s->shift = r.r;
    }
    if (r.r < s->least.r)
        s->least = r;
    if (r.r > s->most.r)
        s->most = r;
    double size = fabs(r.r), off = r.r - s->shift;
    s->count[hm_residual_classify(r.r, s->thresholds)]++;
    s->within += size <= s->bound;
    s->sum += off;
    s->sum2 += off * off;
    s->bins[bin_of(size)]++;
}

double hm_residuals_mean(const struct hm_residuals *s)
{
    return s->n ? s->shift + s->sum / (double)s->n : NAN;
}

double hm_residuals_sigma(const struct hm_residuals *s)
{
    if (!s->n)
        return NAN;
    double n = (double)s->n, mean = s->sum / n;
    double variance = s->sum2 / n - mean * mean;
    return variance > 0 ? sqrt(variance) : 0;
}

double hm_residuals_rmse(const struct hm_residuals *s)
{
    return hypot(hm_residuals_mean(s), hm_residuals_sigma(s));
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
    for (size_t bin = 0; bin + 1 < FINE_BINS + COARSE_BINS; bin++) {
        seen += s->bins[bin];
        if (seen > 0 && (double)seen >= wanted)
            return fmin(bin_end(bin), largest);
    }
    return largest;
}
