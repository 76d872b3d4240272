/* Statistics of residuals and criteria, against cases worked by hand and plain sums. */
#include "hm_criterion.h"
#include "hm_verdict.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static const double paper[2] = {0.10, 0.30};

static void classes(void)
{
    ok(hm_residual_classify(0.10, paper) == HM_RESIDUAL_GREEN &&
           hm_residual_classify(-0.10, paper) == HM_RESIDUAL_GREEN &&
           hm_residual_classify(-0.1001, paper) == HM_RESIDUAL_YELLOW &&
           hm_residual_classify(0.30, paper) == HM_RESIDUAL_YELLOW &&
           hm_residual_classify(0.3001, paper) == HM_RESIDUAL_RED &&
           hm_residual_classify(INFINITY, paper) == HM_RESIDUAL_RED &&
           hm_residual_classify(NAN, paper) == HM_RESIDUAL_NONE,
       "classes of Table 1, the limits belonging to the lower one");
}

/* -0.5, 0, 0.1, 0.2, 0.2: sum 0, squares 0.25 + 0.01 + 0.04 + 0.04 = 0.34 */
static void by_hand(void)
{
    static const double r[] = {0.1, -0.5, 0.2, 0, 0.2};
    struct hm_residuals s;
    hm_residuals_init(&s, paper, 0.2);
    ok(isnan(hm_residuals_mean(&s)) && isnan(hm_residuals_sigma(&s)) &&
           isnan(hm_residuals_rmse(&s)) && isnan(hm_residuals_share(&s, HM_RESIDUAL_RED)) &&
           isnan(hm_residuals_percentile(&s, 95)),
       "nothing: all are NaN");
    for (int i = 0; i < 5; i++)
        hm_residuals_add(&s, (struct hm_residual){i, 10 * i, r[i]}, NULL);
    near(hm_residuals_mean(&s), 0, 1e-15, "mean");
    near(hm_residuals_sigma(&s), sqrt(0.34 / 5), 1e-15, "sigma");
    near(hm_residuals_rmse(&s), sqrt(0.34 / 5), 1e-15, "RMSE");
    near(hm_residuals_share(&s, HM_RESIDUAL_GREEN), 40, 1e-12, "green");
    near(hm_residuals_share(&s, HM_RESIDUAL_YELLOW), 40, 1e-12, "yellow");
    near(hm_residuals_share(&s, HM_RESIDUAL_RED), 20, 1e-12, "red");
    /* third powers: -0.125 + 0.001 + 0.016; fourth: 0.0625 + 0.0001 + 0.0032 */
    near(hm_residuals_skew(&s), -0.108 / 5 / pow(0.068, 1.5), 1e-14, "skew");
    near(hm_residuals_kurtosis(&s), 0.0658 / 5 / (0.068 * 0.068) - 3, 1e-14, "kurtosis");
    near(hm_residuals_within(&s), 80, 1e-12, "within the bound");
    near(hm_residuals_percentile(&s, 95), 0.5, 1e-15, "95 % of five: the largest");
    near(hm_residuals_percentile(&s, 80), 0.2, 1.01e-4, "80 %: 0.2");
    near(hm_residuals_percentile(&s, 20), 0, 1.01e-4, "20 %: 0");
    ok(s.least.r == -0.5 && s.least.x == 1 && s.most.r == 0.2 && s.most.y == 20,
       "extremes, each where it came first");
    hm_residuals_free(&s);
}

/* A datum 1,000 m off: sigma must not drown in mean². */
static void far_from_zero(void)
{
    struct hm_residuals s;
    hm_residuals_init(&s, paper, 0.294);
    for (int i = 0; i < 10000; i++)
        hm_residuals_add(&s, (struct hm_residual){0, 0, 1000 + (i % 2 ? 0.01 : -0.01)}, NULL);
    near(hm_residuals_sigma(&s), 0.01, 1e-9, "sigma of 1000 +- 0.01");
    near(hm_residuals_mean(&s), 1000, 1e-9, "mean of 1000 +- 0.01");
    near(hm_residuals_skew(&s), 0, 1e-6, "skew of two equal heaps");
    near(hm_residuals_kurtosis(&s), -2, 1e-6, "kurtosis of two equal heaps");
    near(hm_residuals_percentile(&s, 95), 1000.01, 0.1, "the percentile of coarse bins");
    hm_residuals_add(&s, (struct hm_residual){0, 0, -1e9}, NULL);
    near(hm_residuals_percentile(&s, 100), 1e9, 0, "beyond all bins: the largest");
    hm_residuals_free(&s);
}

static void samples(void)
{
    enum { N = 200000 };
    int count[3] = {0, 0, 0}, outside = 0, other = 0;
    for (uint64_t i = 0; i < N; i++) {
        bool one = hm_residual_lot(7, i) < 1, five = hm_residual_lot(7, i) < 5;
        count[0] += one;
        count[1] += five;
        count[2] += hm_residual_lot(7, i) < 100;
        outside += one && !five;
        other += one && hm_residual_lot(8, i) < 1;
    }
    ok(outside == 0, "the 1 %% sample lies within the 5 %% one");
    ok(count[2] == N, "100 %% takes all");
    /* four standard deviations of the binomial: 178 and 390 */
    near(count[0], 0.01 * N, 178, "1 % of the points");
    near(count[1], 0.05 * N, 390, "5 % of the points");
    near(other, 0.0001 * N, 18, "another seed: another sample");
}

static bool refuses(const char *text, const char *why)
{
    struct hm_criterion *list = NULL;
    size_t n;
    struct hm_diag d = {0};
    bool good = hm_criteria_parse(text, &list, &n, &d) == HM_EARG && strstr(d.text, why);
    if (!good)
        printf("# %s: %s\n", text, d.text);
    return good;
}

static void criteria(void)
{
    struct hm_criterion *list = NULL;
    struct hm_quality q;
    size_t n = 0;
    struct hm_diag d = {0};
    char text[64];
    if (!ok(!hm_criteria_parse("rmse<=0.15, red < 25%,minangle>=20,largest>0.5,valid", &list, &n,
                               &d) &&
                n == 5,
            "five criteria"))
        return;
    hm_criterion_print(&list[1], text, sizeof text);
    ok(!strcmp(text, "red < 25 %"), "a criterion printed");
    static const double r[] = {0.1, -0.5, 0.1, 0.1, 0.1};
    q = (struct hm_quality){0}; /* no element */
    hm_survey_init(&q.survey, NULL, 0, 1, paper, &d);
    for (int i = 0; i < 5; i++)
        hm_survey_add(&q.survey, (struct hm_residual){0, 0, r[i]}, HM_SURVEY_ON, false, NULL, &d);
    ok(!hm_quality_judge(&q, list, n), "not all are met");
    ok(!list[0].met && list[1].met && !list[2].met && !list[3].met && list[4].met,
       "missed: RMSE 0.24, no angle, 0.5 not over 0.5; met: red 20 %%, valid");
    near(list[0].value, sqrt(0.29 / 5), 1e-15, "the value that was judged");
    near(list[1].value, 20, 1e-12, "a share is in percent");
    free(list);
    hm_quality_free(&q);
    ok(refuses("rmse", "needs a bound") && refuses("rms<1", "rmse") &&
           refuses("rmse<=", "expected a number") && refuses("rmse<=x", "expected a number") &&
           refuses("rmse<=5%", "expected a number") && refuses("rmse=1", "compare by") &&
           refuses("", "no measure") && refuses("valid,", "no measure") &&
           refuses("rmse<=1 m", "expected a number") && refuses("red<nan", "expected a number"),
       "mistakes are named");
}

static void worst(void)
{
    struct hm_survey s;
    hm_survey_init(&s, NULL, 0, 1, paper, NULL);
    for (int i = 0; i < 100; i++)
        hm_survey_add(&s, (struct hm_residual){i, 0, (i * 37 % 100) / (i % 2 ? 10. : -10.)},
                      HM_SURVEY_ON, false, NULL, NULL);
    bool ordered = s.nworst == HM_SURVEY_WORST;
    for (size_t k = 0; k < s.nworst; k++)
        ordered &= fabs(fabs(s.worst[k].r) - (99 - (double)k) / 10) < 1e-12;
    ok(ordered, "the ten largest, largest first");
    hm_survey_free(&s);
}

/* Every measurement is counted once, whatever it lacks; strata come by key, in any order. */
static void places(void)
{
    struct hm_survey s;
    hm_survey_init(&s, NULL, 0, 1, paper, NULL);
    const struct hm_residual none = {0, 0, NAN};
    hm_survey_add(&s, none, HM_SURVEY_OUTSIDE, true, NULL, NULL);
    hm_survey_add(&s, none, HM_SURVEY_OUTSIDE, false, NULL, NULL);
    hm_survey_add(&s, none, HM_SURVEY_HOLE, false, NULL, NULL);
    hm_survey_add(&s, none, HM_SURVEY_ON, false, NULL, NULL);
    static const int64_t key[] = {7, 2, 7, -1, 2, 7};
    for (int i = 0; i < 6; i++)
        hm_survey_add(&s, (struct hm_residual){0, 0, 0.1 * i}, i ? HM_SURVEY_ON : HM_SURVEY_BORDER,
                      false, &key[i], NULL);
    ok(s.points == 10 && s.heightless == 1 && s.off[0] == 1 && s.off[1] == 1 && s.unknown == 1 &&
           hm_survey_all(&s)->n == 6 && s.border == 1,
       "each is counted in one place");
    ok(s.nstrata == 3 && s.stratum[0].key == -1 && s.stratum[1].key == 2 && s.stratum[2].key == 7,
       "strata by key");
    near(hm_residuals_mean(&s.stratum[2].residuals), 0.7 / 3, 1e-15, "mean of a stratum");
    near(hm_survey_margin(50, 10000, INT64_MAX), 0.98, 1e-12,
         "half of ten thousand: within 0.98 points");
    near(hm_survey_margin(50, 10000, 20000), 0.98 * sqrt(0.5), 1e-12,
         "of half of all there are: less");
    near(hm_survey_margin(50, 10000, 10000), 0, 1e-12, "of all: none");
    hm_survey_free(&s);
}

static const struct hm_verdict *verdict(const struct hm_verdict *v, size_t n, const char *source,
                                        const char *what)
{
    for (size_t k = 0; k < n; k++)
        if (strstr(v[k].source, source) && strstr(v[k].what, what))
            return &v[k];
    return NULL;
}

/* 25 residuals of 0.14 and -0.14: RMSE 0.14, with a survey error of 0.06 it is 0.1523. */
static void verdicts(void)
{
    struct hm_residuals s;
    struct hm_verdict v[HM_VERDICTS];
    hm_residuals_init(&s, paper, 0.294);
    for (int i = 0; i < 25; i++)
        hm_residuals_add(&s, (struct hm_residual){0, 0, i % 2 ? 0.14 : -0.14}, NULL);
    size_t n = hm_verdicts(&s, 0.06, v);
    near(hm_verdict_total_rmse(&s, 0.06), sqrt(0.14 * 0.14 + 0.06 * 0.06), 1e-12,
         "the survey's error adds in squares");
    ok(verdict(v, n, "FEMA", "RMSE")->judgement == HM_JUDGE_PASS &&
           verdict(v, n, "ASPRS", "class")->judgement == HM_JUDGE_MISS,
       "0.14 m passes FEMA, and misses ASPRS with the survey's 0.06 m");
    ok(hm_verdict_worst(&s, 0.06) == HM_JUDGE_MISS, "which is the worst, though others warn");
    ok(verdict(v, n, "NSSDA", "20 check")->judgement == HM_JUDGE_PASS &&
           verdict(v, n, "ASPRS", "30 check")->judgement == HM_JUDGE_WARN,
       "25 points are enough for NSSDA, not for ASPRS");
    ok(verdict(v, n, "ASPRS", "twice")->judgement == HM_JUDGE_PASS, "0.06 m is under half of 0.15");
    n = hm_verdicts(&s, 0, v);
    ok(!verdict(v, n, "ASPRS", "twice") &&
           verdict(v, n, "ASPRS", "class")->judgement == HM_JUDGE_PASS,
       "without a survey error it is not judged");
    ok(hm_verdict_worst(&s, 0) == HM_JUDGE_WARN, "25 points: no verdict is missed, but one warns");
    for (int i = 0; i < 15; i++)
        hm_residuals_add(&s, (struct hm_residual){0, 0, i % 2 ? 0.14 : -0.14}, NULL);
    ok(hm_verdict_worst(&s, 0) == HM_JUDGE_PASS, "40 points: all pass");
    for (int i = 0; i < 5; i++)
        hm_residuals_add(&s, (struct hm_residual){0, 0, 1}, NULL);
    n = hm_verdicts(&s, 0, v);
    ok(verdict(v, n, "NDEP", "95th")->judgement == HM_JUDGE_MISS &&
           verdict(v, n, "rule", "normal")->judgement == HM_JUDGE_WARN &&
           verdict(v, n, "ASPRS", "mean")->judgement == HM_JUDGE_WARN,
       "five of 45 a metre off: percentile, skew and mean say so");
    hm_residuals_free(&s);
}

int main(void)
{
    classes();
    by_hand();
    far_from_zero();
    samples();
    criteria();
    worst();
    places();
    verdicts();
    return done();
}
