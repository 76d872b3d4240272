#include "hm_criterion.h"

#include "hm_num.h"
#include "hm_verdict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- measures --- */

static const struct hm_residuals *all(const struct hm_quality *q)
{
    return hm_survey_all(&q->survey);
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
    return q->survey.nworst ? fabs(q->survey.worst[0].r) : NAN;
}
static double total(const struct hm_quality *q)
{
    return hm_verdict_total_rmse(all(q), q->survey_error);
}
static double skew(const struct hm_quality *q)
{
    return hm_residuals_skew(all(q));
}
static double kurtosis(const struct hm_quality *q)
{
    return hm_residuals_kurtosis(all(q));
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
    const struct hm_survey *s = &q->survey;
    return s->points ? 100 * (double)(s->off[0] + s->off[1]) / (double)s->points : NAN;
}
static double compared(const struct hm_quality *q)
{
    return (double)all(q)->n;
}
static double followed(const struct hm_quality *q)
{
    return hm_fidelity_share(&q->lines.all);
}
static double lateral(const struct hm_quality *q)
{
    return q->lines.all.aside.value;
}
static double vertical(const struct hm_quality *q)
{
    return fabs(q->lines.all.worst.value);
}
static double minangle(const struct hm_quality *q)
{
    return hm_measure_least(&q->shape.whole.shape[HM_SHAPE_LEAST_ANGLE]);
}
static double maxangle(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_MOST_ANGLE]);
}
static double edgeratio(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_EDGE_RATIO]);
}
static double arearatio(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_AREA_RATIO]);
}
static double orthogonality(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_ORTHOGONALITY]);
}
static double slope(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_SLOPE]);
}
static double timestep(const struct hm_quality *q)
{
    return hm_measure_least(&q->shape.whole.shape[HM_SHAPE_TIME_STEP]);
}
static double minarea(const struct hm_quality *q)
{
    return hm_measure_least(&q->shape.whole.shape[HM_SHAPE_AREA]);
}
static double maxarea(const struct hm_quality *q)
{
    return hm_measure_most(&q->shape.whole.shape[HM_SHAPE_AREA]);
}
static double warnings(const struct hm_quality *q)
{
    return (double)hm_meshpart_warnings(&q->shape.whole);
}
static double nodes(const struct hm_quality *q)
{
    return (double)q->shape.nodes;
}
static double elements(const struct hm_quality *q)
{
    return (double)(q->shape.whole.triangles + q->shape.whole.quads);
}
static double valid(const struct hm_quality *q)
{
    return hm_meshcheck_is_valid(&q->check, false);
}

static const struct {
    const char *name, *unit;
    double (*value)(const struct hm_quality *q);
} measures[] = {{"rmse", "m", rmse},
                {"mean", "m", mean},
                {"sigma", "m", sigma},
                {"p95", "m", p95},
                {"largest", "m", largest},
                {"total", "m", total},
                {"skew", "", skew},
                {"kurtosis", "", kurtosis},
                {"green", "%", green},
                {"yellow", "%", yellow},
                {"red", "%", red},
                {"within", "%", within},
                {"outside", "%", outside},
                {"compared", "", compared},
                {"followed", "%", followed},
                {"lateral", "m", lateral},
                {"vertical", "m", vertical},
                {"minangle", "deg", minangle},
                {"maxangle", "deg", maxangle},
                {"edgeratio", "", edgeratio},
                {"arearatio", "", arearatio},
                {"orthogonality", "deg", orthogonality},
                {"slope", "deg", slope},
                {"timestep", "s", timestep},
                {"minarea", "m2", minarea},
                {"maxarea", "m2", maxarea},
                {"warnings", "", warnings},
                {"nodes", "", nodes},
                {"elements", "", elements},
                {"valid", "", valid}};
enum { MEASURES = sizeof measures / sizeof *measures };

bool hm_quality_measure(int k, const char **name, const char **unit)
{
    if (k >= MEASURES)
        return false;
    *name = measures[k].name;
    *unit = measures[k].unit;
    return true;
}

double hm_quality_value(const struct hm_quality *q, int k)
{
    return measures[k].value(q);
}

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
