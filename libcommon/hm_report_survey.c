/* The report's pages about measurements. */
#include "hm_report_private.h"

#include "hm_verdict.h"

#include <math.h>
#include <stdio.h>

static void say_counts(struct hm_report_page *p, const struct hm_survey *s)
{
    const struct hm_residuals *all = hm_survey_all(s);
    int64_t off = s->off[0] + s->off[1];
    hm_say(p, "\nMeasurements\n");
    hm_say(p, "  given            %12lld\n", (long long)s->points);
    hm_say(p, "  without height   %12lld\n", (long long)s->heightless);
    hm_say(p, "  outside the mesh %12lld  (%.2f %%; %lld in holes)\n", (long long)off,
           s->points ? 100 * (double)off / (double)s->points : 0, (long long)s->off[0]);
    if (s->unknown)
        hm_say(p, "  mesh has no z    %12lld\n", (long long)s->unknown);
    hm_say(p, "  compared         %12lld  (%lld on the border)\n", (long long)all->n,
           (long long)s->border);
}

static void say_row(struct hm_report_page *p, const char *name, const struct hm_residuals *r)
{
    hm_say(p, "  %-10s%10lld", name, (long long)r->n);
    if (r->n)
        hm_say(p, "  %5.1f%%  %5.1f%%  %5.1f%%  %7.4f  %7.4f  %7.4f",
               hm_residuals_share(r, HM_RESIDUAL_GREEN), hm_residuals_share(r, HM_RESIDUAL_YELLOW),
               hm_residuals_share(r, HM_RESIDUAL_RED), hm_residuals_mean(r), hm_residuals_sigma(r),
               hm_residuals_rmse(r));
}

/* The largest margin of the three shares: how far they may be from those of all. */
static double margin(const struct hm_residuals *r, const struct hm_residuals *all)
{
    double most = 0;
    for (int c = HM_RESIDUAL_GREEN; c <= HM_RESIDUAL_RED; c++) {
        double share = hm_residuals_share(r, (enum hm_residual_class)c);
        most = fmax(most, hm_survey_margin(share, r->n, all->n));
    }
    return most;
}

static void say_samples(struct hm_report_page *p, const struct hm_survey *s)
{
    hm_say(p, "\nResiduals, mesh - measurement: green to %g m, yellow to %g m, red above\n",
           s->thresholds[0], s->thresholds[1]);
    hm_say(
        p,
        "  sample        points   green  yellow     red     mean    sigma     rmse   +- 95 %%\n");
    for (size_t k = 0; k < s->nsamples; k++) {
        const struct hm_residuals *r = &s->sample[k].residuals;
        char name[24] = "all";
        if (k + 1 < s->nsamples)
            snprintf(name, sizeof name, "%g %%", s->sample[k].percent);
        say_row(p, name, r);
        if (r->n && k + 1 < s->nsamples)
            hm_say(p, "  %6.2f%%", margin(r, hm_survey_all(s)));
        hm_say(p, "\n");
    }
}

static void say_extremes(struct hm_report_page *p, const struct hm_quality *q)
{
    const struct hm_survey *s = &q->survey;
    const struct hm_residuals *r = hm_survey_all(s);
    double total = hm_verdict_total_rmse(r, q->survey_error);
    hm_say(p, "\n  1.96 x RMSE          %9.4f m\n", 1.96 * hm_residuals_rmse(r));
    hm_say(p, "  95 %% of |r| within   %9.4f m\n", hm_residuals_percentile(r, 95));
    hm_say(p, "  skew, kurtosis       %9.4f %.4f\n", hm_residuals_skew(r),
           hm_residuals_kurtosis(r));
    hm_say(p, "  with survey error    %9.4f m  (RMSE; survey %g m): ASPRS class %.0f cm\n", total,
           q->survey_error, ceil(100 * total));
    hm_say(p, "  lowest               %9.4f m  at %.3f %.3f\n", r->least.r, r->least.x, r->least.y);
    hm_say(p, "  highest              %9.4f m  at %.3f %.3f\n", r->most.r, r->most.x, r->most.y);
    hm_say(p, "  largest |r| at\n");
    for (size_t k = 0; k < s->nworst; k++)
        hm_say(p, "    %9.4f m  %.3f %.3f\n", s->worst[k].r, s->worst[k].x, s->worst[k].y);
}

static void say_strata(struct hm_report_page *p, const struct hm_quality *q)
{
    static const char *const by[] = {"", "class", "region", "zone"};
    const struct hm_survey *s = &q->survey;
    if (q->strata == HM_STRATA_NONE)
        return;
    hm_say(p, "\nResiduals by %s\n", by[q->strata]);
    hm_say(
        p,
        "  %-10s    points   green  yellow     red     mean    sigma     rmse      p95  verdict\n",
        by[q->strata]);
    for (size_t k = 0; k < s->nstrata; k++) {
        char name[64];
        hm_quality_stratum(q, s->stratum[k].key, name, sizeof name);
        const struct hm_residuals *r = &s->stratum[k].residuals;
        say_row(p, name, r);
        hm_say(p, "  %7.4f  %s\n", hm_residuals_percentile(r, 95),
               hm_judgement_name(hm_verdict_worst(r, q->survey_error)));
    }
}

static void say_verdicts(struct hm_report_page *p, const struct hm_quality *q)
{
    struct hm_verdict v[HM_VERDICTS];
    size_t n = hm_verdicts(hm_survey_all(&q->survey), q->survey_error, v);
    hm_say(p, "\nVerdicts\n");
    for (size_t k = 0; k < n; k++)
        hm_say(p, "  %s  %-34s %10.*f %-2s %s\n", hm_judgement_name(v[k].judgement), v[k].what,
               *v[k].unit                        ? 3
               : v[k].value == floor(v[k].value) ? 0
                                                 : 2,
               v[k].value, v[k].unit, v[k].source);
}

void hm_report_survey(struct hm_report_page *p, const struct hm_quality *q)
{
    say_counts(p, &q->survey);
    say_samples(p, &q->survey);
    if (!q->survey.nworst)
        return;
    say_extremes(p, q);
    say_strata(p, q);
    say_verdicts(p, q);
}
