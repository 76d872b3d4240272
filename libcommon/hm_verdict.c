#include "hm_verdict.h"

#include <math.h>

#define FEMA "FEMA 2003, Appendix A (LiDAR for floodplain mapping)"
#define NSSDA "NSSDA (FGDC-STD-007.3-1998)"
#define NDEP "NDEP 2004, 1.0 (errors not normally distributed)"
#define ASPRS "ASPRS Edition 2 (2023)"

static const double TARGET = 0.15; /* m: RMSE, and class of ASPRS */

double hm_verdict_total_rmse(const struct hm_residuals *r, double survey_error)
{
    return hypot(hm_residuals_rmse(r), survey_error);
}

static void judge(struct hm_verdict **v, bool good, enum hm_judgement otherwise, const char *what,
                  double value, const char *unit, const char *source)
{
    *(*v)++ = (struct hm_verdict){good ? HM_JUDGE_PASS : otherwise, what, source, value, unit};
}

size_t hm_verdicts(const struct hm_residuals *r, double survey_error,
                   struct hm_verdict list[HM_VERDICTS])
{
    struct hm_verdict *v = list;
    double rmse = hm_residuals_rmse(r), within = hm_residuals_within(r);
    double p95 = hm_residuals_percentile(r, 95), red = hm_residuals_share(r, HM_RESIDUAL_RED);
    double total = hm_verdict_total_rmse(r, survey_error), mean = hm_residuals_mean(r);
    double skew = hm_residuals_skew(r), kurtosis = hm_residuals_kurtosis(r), n = (double)r->n;
    judge(&v, rmse <= TARGET, HM_JUDGE_MISS, "RMSE at most 0.15 m", rmse, "m", FEMA);
    judge(&v, within >= 95, HM_JUDGE_MISS, "95 % within 0.294 m", within, "%", NSSDA);
    judge(&v, p95 <= 1.96 * TARGET, HM_JUDGE_MISS, "95th percentile at most 0.294 m", p95, "m",
          NDEP);
    judge(&v, total <= TARGET, HM_JUDGE_MISS, "15-cm vertical accuracy class", total, "m", ASPRS);
    judge(&v, red < 5, HM_JUDGE_MISS, "red under 5 %", red, "%",
          "the paper of the scheme, section 7");
    judge(&v, n >= 20, HM_JUDGE_WARN, "20 check points or more", n, "", NSSDA ", FEMA 2003");
    judge(&v, n >= 30, HM_JUDGE_WARN, "30 check points or more", n, "", ASPRS);
    judge(&v, fabs(mean) <= TARGET / 4, HM_JUDGE_WARN, "mean at most a quarter of 0.15 m", mean,
          "m", ASPRS);
    if (survey_error > 0)
        judge(&v, survey_error <= TARGET / 2, HM_JUDGE_WARN, "survey twice as accurate",
              survey_error, "m", ASPRS);
    judge(&v, !(fabs(skew) > 0.5 || fabs(kurtosis) > 2), HM_JUDGE_WARN,
          "near normal (skew 0.5, kurtosis 2)", fabs(skew) > 0.5 ? skew : kurtosis, "",
          "rule of practice; else 1.96 RMSE is not 95 %");
    return (size_t)(v - list);
}

enum hm_judgement hm_verdict_worst(const struct hm_residuals *r, double survey_error)
{
    struct hm_verdict list[HM_VERDICTS];
    enum hm_judgement worst = HM_JUDGE_PASS;
    size_t n = hm_verdicts(r, survey_error, list);
    for (size_t k = 0; k < n; k++)
        if (list[k].judgement != HM_JUDGE_PASS && worst != HM_JUDGE_MISS)
            worst = list[k].judgement;
    return worst;
}

const char *hm_judgement_name(enum hm_judgement judgement)
{
    static const char *const names[] = {
        [HM_JUDGE_PASS] = "pass", [HM_JUDGE_MISS] = "miss", [HM_JUDGE_WARN] = "warn"};
    return names[judgement];
}
