/* hm_survey: what measurements say about a mesh: counts, samples, strata. Layer 6.
 *
 * Takes the measurements one after the other; memory does not grow with their number.
 */
#ifndef HM_SURVEY_H
#define HM_SURVEY_H

#include "hm_residual.h"

enum { HM_SURVEY_WORST = 10 };

/* Where a measurement lies. */
enum hm_survey_place {
    HM_SURVEY_ON,     /* inside the mesh, */
    HM_SURVEY_BORDER, /* on its border, */
    HM_SURVEY_HOLE,   /* in a hole of it, */
    HM_SURVEY_OUTSIDE /* or elsewhere */
};

/* A sample of the measurements: one row of the paper's Table 2. */
struct hm_sample {
    double percent;
    struct hm_residuals residuals;
};

/* The measurements that have something in common: class, material, polygon. */
struct hm_stratum {
    int64_t key;
    struct hm_residuals residuals;
};

struct hm_survey {
    double thresholds[2];     /* of the classes, metres */
    int64_t seed;             /* of the samples */
    int64_t points;           /* all measurements; each of the next three is counted once */
    int64_t heightless;       /* without z, wherever they are */
    int64_t off[2];           /* in holes; outside: not on the mesh */
    int64_t unknown;          /* on the mesh, where its nodes have no height */
    int64_t border;           /* of those compared, on the border */
    struct hm_sample *sample; /* owned; the last one holds all compared points */
    size_t nsamples;
    struct hm_stratum *stratum; /* owned, by ascending key; none unless asked for */
    size_t nstrata, strata_cap, last_stratum;
    struct hm_residual worst[HM_SURVEY_WORST]; /* largest |r| first, of equals the earlier */
    size_t nworst;
};

/* Samples of n percentages, and all. */
enum hm_err hm_survey_init(struct hm_survey *s, const double *percent, size_t n, int64_t seed,
                           const double thresholds[2], struct hm_diag *d);
void hm_survey_free(struct hm_survey *s);

/* The next measurement. r.r is NaN when it, or the mesh there, has no height; `heightless` says
 * that it is the measurement. stratum NULL: there are none. */
enum hm_err hm_survey_add(struct hm_survey *s, struct hm_residual r, enum hm_survey_place place,
                          bool heightless, const int64_t *stratum, struct hm_diag *d);

/* Residuals of all compared measurements. */
const struct hm_residuals *hm_survey_all(const struct hm_survey *s);

/* Half a width of the interval that holds the share of a class among N measurements with 95 %
 * confidence when a random sample of n of them has the share, all in percent. */
double hm_survey_margin(double share, int64_t n, int64_t N);

#endif
