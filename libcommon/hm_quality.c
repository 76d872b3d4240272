#include "hm_quality.h"

#include "hm_num.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Half a width of the normal distribution that holds 95 %, 1.96, times the RMSE of 0.15 m. */
static const double WITHIN = 0.294;

enum hm_err hm_quality_init(struct hm_quality *q, const double *percent, size_t n, int64_t seed,
                            const double thresholds[2], struct hm_diag *d)
{
    *q = (struct hm_quality){.seed = seed, .thresholds = {thresholds[0], thresholds[1]}};
    q->sample = hm_alloc0(n + 1, sizeof *q->sample);
    if (!q->sample)
        return hm_fail_memory(d);
    q->nsamples = n + 1;
    for (size_t k = 0; k <= n; k++) {
        q->sample[k].percent = k < n ? percent[k] : 100;
        enum hm_err err = hm_residuals_init(&q->sample[k].residuals, thresholds, WITHIN, d);
        if (err)
            return err;
    }
    return HM_OK;
}

void hm_quality_free(struct hm_quality *q)
{
    for (size_t k = 0; k < q->nsamples; k++)
        hm_residuals_free(&q->sample[k].residuals);
    free(q->sample);
    *q = (struct hm_quality){0};
}

static void keep_worst(struct hm_quality *q, struct hm_residual r)
{
    size_t k = q->nworst;
    if (k == HM_QUALITY_WORST && !(fabs(r.r) > fabs(q->worst[--k].r)))
        return;
    for (; k > 0 && fabs(r.r) > fabs(q->worst[k - 1].r); k--)
        q->worst[k] = q->worst[k - 1];
    q->worst[k] = r;
    if (q->nworst < HM_QUALITY_WORST)
        q->nworst++;
}

void hm_quality_add(struct hm_quality *q, struct hm_residual r, int64_t ordinal)
{
    for (size_t k = 0; k < q->nsamples; k++)
        if (hm_residual_sampled((uint64_t)q->seed, (uint64_t)ordinal, q->sample[k].percent))
            hm_residuals_add(&q->sample[k].residuals, r);
    keep_worst(q, r);
}

/* --- measures --- */

static const struct hm_residuals *all(const struct hm_quality *q)
{
    return &q->sample[q->nsamples - 1].residuals;
}

static double rmse(const struct hm_quality *q)
{
    return hm_residuals_rmse(all(q));
}
static double mean(const struct hm_quality *q)
{
    return hm_residuals_mean(all(q));
}
static double sigma(const struct hm_quality *q)
{
    return hm_residuals_sigma(all(q));
}
static double p95(const struct hm_quality *q)
{
    return hm_residuals_percentile(all(q), 95);
}
static double largest(const struct hm_quality *q)
{
    return q->nworst ? fabs(q->worst[0].r) : NAN;
}
static double green(const struct hm_quality *q)
{
    return hm_residuals_share(all(q), HM_RESIDUAL_GREEN);
}
static double yellow(const struct hm_quality *q)
{
    return hm_residuals_share(all(q), HM_RESIDUAL_YELLOW);
}
static double red(const struct hm_quality *q)
{
    return hm_residuals_share(all(q), HM_RESIDUAL_RED);
}
static double within(const struct hm_quality *q)
{
    return hm_residuals_within(all(q));
}
static double outside(const struct hm_quality *q)
{
    return q->points ? 100 * (double)q->outside / (double)q->points : NAN;
}
static double minangle(const struct hm_quality *q)
{
    return q->shape.angle_least.value;
}
static double maxangle(const struct hm_quality *q)
{
    return q->shape.angle_most.value;
}
static double edgeratio(const struct hm_quality *q)
{
    return q->shape.edge_ratio.value;
}
static double arearatio(const struct hm_quality *q)
{
    return q->shape.area_ratio.value;
}
static double minarea(const struct hm_quality *q)
{
    return q->shape.area_least.value;
}
static double maxarea(const struct hm_quality *q)
{
    return q->shape.area_most.value;
}
static double nodes(const struct hm_quality *q)
{
    return (double)q->shape.nodes;
}
static double elements(const struct hm_quality *q)
{
    return (double)(q->shape.triangles + q->shape.quads);
}
static double valid(const struct hm_quality *q)
{
    return hm_meshcheck_is_valid(&q->check, false);
}

static const struct {
    const char *name, *unit;
    double (*value)(const struct hm_quality *q);
} measures[] = {{"rmse", "m", rmse},           {"mean", "m", mean},
                {"sigma", "m", sigma},         {"p95", "m", p95},
                {"largest", "m", largest},     {"green", "%", green},
                {"yellow", "%", yellow},       {"red", "%", red},
                {"within", "%", within},       {"outside", "%", outside},
                {"minangle", "deg", minangle}, {"maxangle", "deg", maxangle},
                {"edgeratio", "", edgeratio},  {"arearatio", "", arearatio},
                {"minarea", "m2", minarea},    {"maxarea", "m2", maxarea},
                {"nodes", "", nodes},          {"elements", "", elements},
                {"valid", "", valid}};
enum { MEASURES = sizeof measures / sizeof *measures };

/* --- criteria --- */

enum { LESS, LESS_OR_EQUAL, GREATER, GREATER_OR_EQUAL, NOT_ZERO };
static const char *const comparisons[] = {"<", "<=", ">", ">=", ""};

static enum hm_err unknown_measure(const char *text, size_t n, struct hm_diag *d)
{
    char names[HM_DIAG_TEXT] = "";
    for (int k = 0; k < MEASURES; k++) {
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, " %s", measures[k].name);
    }
    return hm_fail(d, HM_EARG, "no measure is called '%.*s'; there are%s", (int)n, text, names);
}

static enum hm_err parse_bound(const char *p, const char *end, struct hm_criterion *c,
                               struct hm_diag *d)
{
    c->comparison = *p == '<' ? LESS : GREATER;
    const char *s = p + 1;
    if (s < end && *s == '=') {
        c->comparison++;
        s++;
    }
    while (s < end && *s == ' ')
        s++;
    const char *behind = hm_num_parse(s, end, &c->bound);
    if (behind && behind < end && *behind == '%' && *measures[c->measure].unit == '%')
        behind++;
    while (behind && behind < end && *behind == ' ')
        behind++;
    if (behind != end || isnan(c->bound))
        return hm_fail(d, HM_EARG, "criterion '%s%.*s': expected a number%s behind the comparison",
                       measures[c->measure].name, (int)(end - p), p,
                       *measures[c->measure].unit == '%' ? " or percentage" : "");
    return HM_OK;
}

/* One criterion in [p, end). */
static enum hm_err parse_criterion(const char *p, const char *end, struct hm_criterion *c,
                                   struct hm_diag *d)
{
    while (p < end && *p == ' ')
        p++;
    while (p < end && end[-1] == ' ')
        end--;
    size_t length = 0;
    while (p + length < end && !strchr("<>= ", p[length]))
        length++;
    *c = (struct hm_criterion){.measure = -1, .comparison = NOT_ZERO, .value = NAN};
    for (int k = 0; k < MEASURES; k++)
        if (strlen(measures[k].name) == length && !strncmp(measures[k].name, p, length))
            c->measure = k;
    if (c->measure < 0)
        return unknown_measure(p, length, d);
    p += length;
    while (p < end && *p == ' ')
        p++;
    const char *name = measures[c->measure].name;
    if (p < end && (*p == '<' || *p == '>'))
        return parse_bound(p, end, c, d);
    if (p < end)
        return hm_fail(d, HM_EARG, "criterion '%s%.*s': compare by < <= > >=", name, (int)(end - p),
                       p);
    if (measures[c->measure].value != valid)
        return hm_fail(d, HM_EARG, "criterion '%s' needs a bound, as in %s<=1", name, name);
    return HM_OK;
}

enum hm_err hm_criteria_parse(const char *text, struct hm_criterion **list, size_t *n,
                              struct hm_diag *d)
{
    size_t count = 1;
    for (const char *p = text; *p; p++)
        count += *p == ',';
    struct hm_criterion *c = hm_alloc(count, sizeof *c);
    if (!c)
        return hm_fail_memory(d);
    for (size_t k = 0; k < count; k++) {
        const char *end = text + strcspn(text, ",");
        enum hm_err err = parse_criterion(text, end, &c[k], d);
        if (err) {
            free(c);
            return err;
        }
        text = end + 1;
    }
    *list = c;
    *n = count;
    return HM_OK;
}

static bool holds(double value, int comparison, double bound)
{
    switch (comparison) {
    case LESS:
        return value < bound;
    case LESS_OR_EQUAL:
        return value <= bound;
    case GREATER:
        return value > bound;
    case GREATER_OR_EQUAL:
        return value >= bound;
    default:
        return value != 0;
    }
}

bool hm_quality_judge(const struct hm_quality *q, struct hm_criterion *list, size_t n)
{
    bool good = true;
    for (size_t k = 0; k < n; k++) {
        list[k].value = measures[list[k].measure].value(q);
        list[k].met =
            !isnan(list[k].value) && holds(list[k].value, list[k].comparison, list[k].bound);
        good &= list[k].met;
    }
    return good;
}

void hm_criterion_print(const struct hm_criterion *c, char *text, size_t size)
{
    const char *name = measures[c->measure].name, *unit = measures[c->measure].unit;
    if (c->comparison == NOT_ZERO) {
        snprintf(text, size, "%s", name);
        return;
    }
    char bound[HM_NUM_CHARS];
    bound[hm_num_print(bound, c->bound)] = 0;
    snprintf(text, size, "%s %s %s%s%s", name, comparisons[c->comparison], bound, *unit ? " " : "",
             unit);
}
