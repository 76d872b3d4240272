/* hm_residual: statistics of residuals (height of the mesh minus measured height, metres) that
 * arrive one after the other. Layer 6. Memory does not grow with their number.
 *
 * Classes are those of the paper's Table 1: acceptable (green) up to 0.10 m, tolerable (yellow) up
 * to 0.30 m, significant (red) above.
 */
#ifndef HM_RESIDUAL_H
#define HM_RESIDUAL_H

#include "hm_base.h"

enum hm_residual_class {
    HM_RESIDUAL_NONE = 0, /* outside the mesh, or without height */
    HM_RESIDUAL_GREEN = 1,
    HM_RESIDUAL_YELLOW = 2,
    HM_RESIDUAL_RED = 3
};

/* The class of a residual by two thresholds (metres), each of which still belongs to the lower
 * class; none for NaN. */
enum hm_residual_class hm_residual_classify(double residual, const double thresholds[2]);

/* The number of a point in [0, 100), by seed and ordinal. A sample of p percent takes the points
 * under p, so a smaller sample lies within every larger one, and 100 takes all. */
double hm_residual_lot(uint64_t seed, uint64_t ordinal);

/* A residual and where it was. */
struct hm_residual {
    double x, y, r;
};

struct hm_residuals {
    int64_t n;
    int64_t count[4];     /* by class */
    int64_t within;       /* |r| <= bound */
    double bound;         /* metres */
    double thresholds[2]; /* metres */
    struct hm_residual least, most;
    double mean, m2, m3, m4; /* sums of powers of r - mean */
    uint64_t *bins;          /* |r|: 0.1 mm each up to 10 m, then 0.1 m each */
    size_t nbins;
};

void hm_residuals_init(struct hm_residuals *s, const double thresholds[2], double bound);
void hm_residuals_free(struct hm_residuals *s);

/* Add a residual that is a finite number. HM_ENOMEM. */
enum hm_err hm_residuals_add(struct hm_residuals *s, struct hm_residual r, struct hm_diag *d);

/* All of these are NaN when there is no residual. rmse² = mean² + sigma²: sigma divides by n. */
double hm_residuals_mean(const struct hm_residuals *s);
double hm_residuals_sigma(const struct hm_residuals *s);
double hm_residuals_rmse(const struct hm_residuals *s);

/* Third and fourth standardised moment, the latter less 3: 0 for the normal distribution; NaN when
 * sigma is 0. */
double hm_residuals_skew(const struct hm_residuals *s);
double hm_residuals_kurtosis(const struct hm_residuals *s);

/* The share, in percent, of a class, and of |r| <= bound. */
double hm_residuals_share(const struct hm_residuals *s, enum hm_residual_class c);
double hm_residuals_within(const struct hm_residuals *s);

/* The |r| that `percent` of all do not exceed, to 0.1 mm above the truth (0.1 m beyond 10 m). */
double hm_residuals_percentile(const struct hm_residuals *s, double percent);

#endif
