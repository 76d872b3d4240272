/* Statistics of residuals and criteria, against cases worked by hand and plain sums. */
#include "hm_quality.h"
#include "hm_residual.h"
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
    struct hm_diag d = {0};
    if (!ok(!hm_residuals_init(&s, paper, 0.2, &d), "init"))
        return;
    ok(isnan(hm_residuals_mean(&s)) && isnan(hm_residuals_sigma(&s)) &&
           isnan(hm_residuals_rmse(&s)) && isnan(hm_residuals_share(&s, HM_RESIDUAL_RED)) &&
           isnan(hm_residuals_percentile(&s, 95)),
       "nothing: all are NaN");
    for (int i = 0; i < 5; i++)
        hm_residuals_add(&s, (struct hm_residual){i, 10 * i, r[i]});
    near(hm_residuals_mean(&s), 0, 1e-15, "mean");
    near(hm_residuals_sigma(&s), sqrt(0.34 / 5), 1e-15, "sigma");
    near(hm_residuals_rmse(&s), sqrt(0.34 / 5), 1e-15, "RMSE");
    near(hm_residuals_share(&s, HM_RESIDUAL_GREEN), 40, 1e-12, "green");
    near(hm_residuals_share(&s, HM_RESIDUAL_YELLOW), 40, 1e-12, "yellow");
    near(hm_residuals_share(&s, HM_RESIDUAL_RED), 20, 1e-12, "red");
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
    hm_residuals_init(&s, paper, 0.294, NULL);
    for (int i = 0; i < 10000; i++)
        hm_residuals_add(&s, (struct hm_residual){0, 0, 1000 + (i % 2 ? 0.01 : -0.01)});
    near(hm_residuals_sigma(&s), 0.01, 1e-9, "sigma of 1000 +- 0.01");
    near(hm_residuals_mean(&s), 1000, 1e-9, "mean of 1000 +- 0.01");
    near(hm_residuals_percentile(&s, 95), 1000.01, 0.1, "the percentile of coarse bins");
    hm_residuals_add(&s, (struct hm_residual){0, 0, -1e9});
    near(hm_residuals_percentile(&s, 100), 1e9, 0, "beyond all bins: the largest");
    hm_residuals_free(&s);
}

static void samples(void)
{
    enum { N = 200000 };
    int count[3] = {0, 0, 0}, outside = 0, other = 0;
    for (uint64_t i = 0; i < N; i++) {
        bool one = hm_residual_sampled(7, i, 1), five = hm_residual_sampled(7, i, 5);
        count[0] += one;
        count[1] += five;
        count[2] += hm_residual_sampled(7, i, 100);
        outside += one && !five;
        other += one && hm_residual_sampled(8, i, 1);
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
    hm_quality_init(&q, NULL, 0, 1, paper, &d);
    q.shape.angle_least.value = NAN; /* no element */
    for (int i = 0; i < 5; i++)
        hm_quality_add(&q, (struct hm_residual){0, 0, r[i]}, i);
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
    struct hm_quality q;
    hm_quality_init(&q, NULL, 0, 1, paper, NULL);
    for (int i = 0; i < 100; i++)
        hm_quality_add(&q, (struct hm_residual){i, 0, (i * 37 % 100) / (i % 2 ? 10. : -10.)}, i);
    bool ordered = q.nworst == HM_QUALITY_WORST;
    for (size_t k = 0; k < q.nworst; k++)
        ordered &= fabs(fabs(q.worst[k].r) - (99 - (double)k) / 10) < 1e-12;
    ok(ordered, "the ten largest, largest first");
    hm_quality_free(&q);
}

int main(void)
{
    classes();
    by_hand();
    far_from_zero();
    samples();
    criteria();
    worst();
    return done();
}
