#include "hm_survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Half a width of the normal distribution that holds 95 %. */
static const double HALF_WIDTH = 1.96;

/* That times the RMSE of 0.15 m. */
static const double WITHIN = 0.294;

enum hm_err hm_survey_init(struct hm_survey *s, const double *percent, size_t n, int64_t seed,
                           const double thresholds[2], struct hm_diag *d)
{
    *s = (struct hm_survey){.seed = seed, .thresholds = {thresholds[0], thresholds[1]}};
    s->sample = hm_alloc0(n + 1, sizeof *s->sample);
    if (!s->sample)
        return hm_fail_memory(d);
    s->nsamples = n + 1;
    for (size_t k = 0; k <= n; k++) {
        s->sample[k].percent = k < n ? percent[k] : 100;
        hm_residuals_init(&s->sample[k].residuals, thresholds, WITHIN);
    }
    return HM_OK;
}

void hm_survey_free(struct hm_survey *s)
{
    for (size_t k = 0; k < s->nsamples; k++)
        hm_residuals_free(&s->sample[k].residuals);
    for (size_t k = 0; k < s->nstrata; k++)
        hm_residuals_free(&s->stratum[k].residuals);
    free(s->sample);
    free(s->stratum);
    *s = (struct hm_survey){0};
}

static void keep_worst(struct hm_survey *s, struct hm_residual r)
{
    size_t k = s->nworst;
    if (k == HM_SURVEY_WORST && !(fabs(r.r) > fabs(s->worst[--k].r)))
        return;
    for (; k > 0 && fabs(r.r) > fabs(s->worst[k - 1].r); k--)
        s->worst[k] = s->worst[k - 1];
    s->worst[k] = r;
    if (s->nworst < HM_SURVEY_WORST)
        s->nworst++;
}

/* The residuals of a stratum, which is made when it is new; NULL when memory is short. Neighbours
 * are mostly of one stratum, so the last is tried first. */
static struct hm_residuals *stratum(struct hm_survey *s, int64_t key)
{
    size_t k = s->last_stratum;
    if (!(k < s->nstrata && s->stratum[k].key == key))
        for (k = 0; k < s->nstrata && s->stratum[k].key < key; k++)
            ;
    if (k == s->nstrata || s->stratum[k].key != key) {
        if (!hm_grow(&s->stratum, &s->strata_cap, s->nstrata + 1, sizeof *s->stratum))
            return NULL;
        memmove(&s->stratum[k + 1], &s->stratum[k], (s->nstrata++ - k) * sizeof *s->stratum);
        s->stratum[k].key = key;
        hm_residuals_init(&s->stratum[k].residuals, s->thresholds, WITHIN);
    }
    s->last_stratum = k;
    return &s->stratum[k].residuals;
}

static enum hm_err compare(struct hm_survey *s, struct hm_residual r, int64_t ordinal,
                           const int64_t *key, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    double lot = hm_residual_lot((uint64_t)s->seed, (uint64_t)ordinal);
    for (size_t k = 0; k < s->nsamples && !err; k++)
        if (lot < s->sample[k].percent)
            err = hm_residuals_add(&s->sample[k].residuals, r, d);
    if (key && !err) {
        struct hm_residuals *part = stratum(s, *key);
        err = part ? hm_residuals_add(part, r, d) : hm_fail_memory(d);
    }
    keep_worst(s, r);
    return err;
}

enum hm_err hm_survey_add(struct hm_survey *s, struct hm_residual r, enum hm_survey_place place,
                          bool heightless, const int64_t *key, struct hm_diag *d)
{
    int64_t ordinal = s->points++;
    if (heightless) {
        s->heightless++;
    } else if (place == HM_SURVEY_HOLE || place == HM_SURVEY_OUTSIDE) {
        s->off[place == HM_SURVEY_OUTSIDE]++;
    } else if (!isfinite(r.r)) {
        s->unknown++;
    } else {
        s->border += place == HM_SURVEY_BORDER;
        return compare(s, r, ordinal, key, d);
    }
    return HM_OK;
}

const struct hm_residuals *hm_survey_all(const struct hm_survey *s)
{
    return &s->sample[s->nsamples - 1].residuals;
}

double hm_survey_margin(double share, int64_t n, int64_t N)
{
    if (n == 0)
        return NAN;
    return HALF_WIDTH * sqrt(share * (100 - share) * (1 / (double)n - 1 / (double)N));
}
