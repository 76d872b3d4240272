/* The reports of hm_quality: text and JSON. */
#include "hm_quality.h"

#include "hm_json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* A verdict on the survey: a criterion and who asks for it. */
static const struct {
    const char *criterion, *what, *source;
} verdicts[] = {
    {"rmse<=0.15", "RMSE at most 0.15 m", "FEMA 2003, Appendix A (LiDAR for floodplain mapping)"},
    {"within>=95", "95 % within 0.294 m", "NSSDA (FGDC-STD-007.3-1998): 1.96 x 0.15 m"},
    {"red<5", "red under 5 %", "the paper of the scheme, section 7"}};
enum { VERDICTS = sizeof verdicts / sizeof *verdicts };

static enum hm_err judge(const struct hm_quality *q, int verdict, struct hm_criterion *c,
                         struct hm_diag *d)
{
    struct hm_criterion *list;
    size_t n;
    enum hm_err err = hm_criteria_parse(verdicts[verdict].criterion, &list, &n, d);
    if (err)
        return err;
    hm_quality_judge(q, list, n);
    *c = list[0];
    free(list);
    return HM_OK;
}

/* --- text --- */

/* Where text goes, and the first failure on the way. */
struct text {
    struct hm_writer *w;
    enum hm_err err;
    struct hm_diag *d;
};

__attribute__((format(printf, 2, 3))) static void say(struct text *t, const char *format, ...)
{
    char line[512];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (n >= (int)sizeof line)
        n = (int)sizeof line - 1;
    if (!t->err && n > 0)
        t->err = hm_writer_bytes(t->w, line, (size_t)n, t->d);
}

static void say_points(struct text *t, const struct hm_quality *q)
{
    const struct hm_residuals *r = &q->sample[q->nsamples - 1].residuals;
    double outside = q->points ? 100 * (double)q->outside / (double)q->points : 0;
    say(t, "\nMeasurements\n");
    say(t, "  given            %12lld\n", (long long)q->points);
    say(t, "  without height   %12lld\n", (long long)q->heightless);
    say(t, "  outside the mesh %12lld  (%.2f %%)\n", (long long)q->outside, outside);
    if (q->unknown)
        say(t, "  mesh has no z    %12lld\n", (long long)q->unknown);
    say(t, "  compared         %12lld\n", (long long)r->n);
}

static void say_samples(struct text *t, const struct hm_quality *q)
{
    say(t, "\nResiduals, mesh - measurement: green to %g m, yellow to %g m, red above\n",
        q->thresholds[0], q->thresholds[1]);
    say(t, "  sample      points   green  yellow     red     mean    sigma     rmse\n");
    for (size_t k = 0; k < q->nsamples; k++) {
        const struct hm_residuals *r = &q->sample[k].residuals;
        char name[24];
        if (k + 1 < q->nsamples)
            snprintf(name, sizeof name, "%g %%", q->sample[k].percent);
        else
            snprintf(name, sizeof name, "all");
        say(t, "  %-6s%12lld", name, (long long)r->n);
        if (r->n)
            say(t, "  %5.1f%%  %5.1f%%  %5.1f%%  %7.4f  %7.4f  %7.4f",
                hm_residuals_share(r, HM_RESIDUAL_GREEN), hm_residuals_share(r, HM_RESIDUAL_YELLOW),
                hm_residuals_share(r, HM_RESIDUAL_RED), hm_residuals_mean(r), hm_residuals_sigma(r),
                hm_residuals_rmse(r));
        say(t, "\n");
    }
}

static void say_extremes(struct text *t, const struct hm_quality *q)
{
    const struct hm_residuals *r = &q->sample[q->nsamples - 1].residuals;
    say(t, "\n  1.96 x RMSE          %9.4f m\n", 1.96 * hm_residuals_rmse(r));
    say(t, "  95 %% of |r| within   %9.4f m\n", hm_residuals_percentile(r, 95));
    say(t, "  lowest               %9.4f m  at %.3f %.3f\n", r->least.r, r->least.x, r->least.y);
    say(t, "  highest              %9.4f m  at %.3f %.3f\n", r->most.r, r->most.x, r->most.y);
    say(t, "  largest |r| at\n");
    for (size_t k = 0; k < q->nworst; k++)
        say(t, "    %9.4f m  %.3f %.3f\n", q->worst[k].r, q->worst[k].x, q->worst[k].y);
}

static void say_verdicts(struct text *t, const struct hm_quality *q)
{
    say(t, "\nVerdicts\n");
    for (int k = 0; k < VERDICTS && !t->err; k++) {
        struct hm_criterion c;
        t->err = judge(q, k, &c, t->d);
        if (!t->err)
            say(t, "  %s  %-20s %8.3f   %s\n", c.met ? "pass" : "miss", verdicts[k].what, c.value,
                verdicts[k].source);
    }
}

static void say_measure(struct text *t, const char *name, struct hm_measure m, const char *unit)
{
    if (isnan(m.value))
        return;
    say(t, "  %-22s %10.3f %-3s at %.3f %.3f\n", name, m.value, unit, m.x, m.y);
}

static void say_histogram(struct text *t, const struct hm_meshstat *s)
{
    static const char bar[] = "########################################";
    int64_t most = 1;
    int bins = 0; /* up to the last that holds any */
    for (int k = 0; k < HM_MESHSTAT_BINS; k++) {
        if (s->histogram[k] > most)
            most = s->histogram[k];
        if (s->histogram[k])
            bins = k + 1;
    }
    say(t, "\n  smallest angle of an element, degrees\n");
    for (int k = 0; k < bins; k++) {
        int length = (int)((s->histogram[k] * 40 + most - 1) / most);
        say(t, "    %2d - %2d %10lld%s%.*s\n", 5 * k, 5 * k + 5, (long long)s->histogram[k],
            length ? "  " : "", length, bar);
    }
}

static void say_shape(struct text *t, const struct hm_quality *q)
{
    const struct hm_meshstat *s = &q->shape;
    say(t, "\nElements\n");
    say(t, "  nodes %zu, triangles %zu, quadrilaterals %zu, area %.3f m2\n", s->nodes, s->triangles,
        s->quads, s->area);
    say_measure(t, "smallest angle", s->angle_least, "deg");
    say_measure(t, "largest angle", s->angle_most, "deg");
    for (int k = 0; k < 3; k++)
        say(t, "  angle under %d deg     %10lld     (%.2f %%)\n", 10 * (k + 1),
            (long long)s->below[k], hm_meshstat_percent(s, s->below[k]));
    say_measure(t, "smallest area", s->area_least, "m2");
    say_measure(t, "largest area", s->area_most, "m2");
    say_measure(t, "largest edge ratio", s->edge_ratio, "");
    say(t, "  mean edge ratio        %10.3f\n", s->edge_ratio_mean);
    say_measure(t, "area ratio, neighbours", s->area_ratio, "");
    say(t, "  area ratio over 2      %10lld     of %lld pairs\n", (long long)s->jumps,
        (long long)s->neighbours);
    say_histogram(t, s);
    say(t, "\n  smallest angles at\n");
    for (size_t k = 0; k < s->nworst; k++)
        say(t, "    %7.3f deg  %.3f %.3f\n", s->worst[k].value, s->worst[k].x, s->worst[k].y);
}

static void say_validity(struct text *t, const struct hm_quality *q)
{
    bool any = false;
    say(t, "\nValidity\n");
    for (int k = 0; k < HM_FAULTS; k++) {
        if (!q->check.count[k])
            continue;
        any = true;
        say(t, "  %-40s %10lld  first at %.3f %.3f\n", hm_mesh_fault_name((enum hm_mesh_fault)k),
            (long long)q->check.count[k], q->check.place[k][0], q->check.place[k][1]);
    }
    if (!any)
        say(t, "  no fault: a solver can take this mesh\n");
}

static void say_criteria(struct text *t, const struct hm_criterion *list, size_t n)
{
    say(t, "\nCriteria\n");
    for (size_t k = 0; k < n; k++) {
        char what[64];
        hm_criterion_print(&list[k], what, sizeof what);
        say(t, "  %s  %-24s %g\n", list[k].met ? "pass" : "miss", what, list[k].value);
    }
}

enum hm_err hm_quality_text(const struct hm_quality *q, const struct hm_criterion *list, size_t n,
                            struct hm_writer *w, struct hm_diag *d)
{
    struct text t = {w, HM_OK, d};
    const char *name = hm_header_get(&q->mesh->header, "name");
    const char *role = hm_header_get(&q->mesh->header, "role");
    const char *crs = hm_header_get(&q->mesh->header, "crs");
    say(&t, "Quality of mesh%s%s%s%s%s\n", name ? " " : "", name ? name : "", role ? " (" : "",
        role ? role : "", role ? ")" : "");
    if (crs)
        say(&t, "  crs %s\n", crs);
    if (q->surveyed) {
        say_points(&t, q);
        say_samples(&t, q);
        if (q->nworst) {
            say_extremes(&t, q);
            say_verdicts(&t, q);
        }
    }
    say_shape(&t, q);
    say_validity(&t, q);
    if (n)
        say_criteria(&t, list, n);
    return t.err;
}

/* --- JSON --- */

static void put_place(struct hm_json *j, const char *name, const char *what, double value, double x,
                      double y)
{
    hm_json_open(j, name, '{');
    hm_json_number(j, what, value);
    hm_json_number(j, "x", x);
    hm_json_number(j, "y", y);
    hm_json_close(j, '}');
}

static void put_measure(struct hm_json *j, const char *name, struct hm_measure m)
{
    put_place(j, name, "value", m.value, m.x, m.y);
}

static void put_residual(struct hm_json *j, const char *name, struct hm_residual r)
{
    put_place(j, name, "residual", r.r, r.x, r.y);
}

static void put_sample(struct hm_json *j, const struct hm_sample *s)
{
    const struct hm_residuals *r = &s->residuals;
    hm_json_open(j, NULL, '{');
    hm_json_number(j, "percent", s->percent);
    hm_json_integer(j, "points", r->n);
    hm_json_number(j, "green", hm_residuals_share(r, HM_RESIDUAL_GREEN));
    hm_json_number(j, "yellow", hm_residuals_share(r, HM_RESIDUAL_YELLOW));
    hm_json_number(j, "red", hm_residuals_share(r, HM_RESIDUAL_RED));
    hm_json_number(j, "mean", hm_residuals_mean(r));
    hm_json_number(j, "sigma", hm_residuals_sigma(r));
    hm_json_number(j, "rmse", hm_residuals_rmse(r));
    hm_json_number(j, "rmse196", 1.96 * hm_residuals_rmse(r));
    hm_json_number(j, "p95", hm_residuals_percentile(r, 95));
    hm_json_number(j, "within", hm_residuals_within(r));
    if (r->n) {
        put_residual(j, "lowest", r->least);
        put_residual(j, "highest", r->most);
    }
    hm_json_close(j, '}');
}

static void put_survey(struct hm_json *j, const struct hm_quality *q)
{
    hm_json_open(j, "measurements", '{');
    hm_json_integer(j, "given", q->points);
    hm_json_integer(j, "without_height", q->heightless);
    hm_json_integer(j, "outside", q->outside);
    hm_json_integer(j, "mesh_without_height", q->unknown);
    hm_json_integer(j, "compared", q->sample[q->nsamples - 1].residuals.n);
    hm_json_close(j, '}');
    hm_json_open(j, "thresholds", '[');
    hm_json_number(j, NULL, q->thresholds[0]);
    hm_json_number(j, NULL, q->thresholds[1]);
    hm_json_close(j, ']');
    hm_json_integer(j, "seed", q->seed);
    hm_json_open(j, "samples", '[');
    for (size_t k = 0; k < q->nsamples; k++)
        put_sample(j, &q->sample[k]);
    hm_json_close(j, ']');
    hm_json_open(j, "worst_residuals", '[');
    for (size_t k = 0; k < q->nworst; k++)
        put_residual(j, NULL, q->worst[k]);
    hm_json_close(j, ']');
}

static void put_verdicts(struct hm_json *j, const struct hm_quality *q)
{
    hm_json_open(j, "verdicts", '[');
    for (int k = 0; k < VERDICTS && !j->err; k++) {
        struct hm_criterion c;
        j->err = judge(q, k, &c, &j->d);
        if (j->err)
            return;
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "what", verdicts[k].what);
        hm_json_text(j, "source", verdicts[k].source);
        hm_json_number(j, "value", c.value);
        hm_json_bool(j, "met", c.met);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_shape(struct hm_json *j, const struct hm_meshstat *s)
{
    hm_json_open(j, "elements", '{');
    hm_json_integer(j, "nodes", (int64_t)s->nodes);
    hm_json_integer(j, "triangles", (int64_t)s->triangles);
    hm_json_integer(j, "quadrilaterals", (int64_t)s->quads);
    hm_json_number(j, "area", s->area);
    put_measure(j, "smallest_angle", s->angle_least);
    put_measure(j, "largest_angle", s->angle_most);
    hm_json_integer(j, "angle_under_10", s->below[0]);
    hm_json_integer(j, "angle_under_20", s->below[1]);
    hm_json_integer(j, "angle_under_30", s->below[2]);
    put_measure(j, "smallest_area", s->area_least);
    put_measure(j, "largest_area", s->area_most);
    put_measure(j, "largest_edge_ratio", s->edge_ratio);
    hm_json_number(j, "mean_edge_ratio", s->edge_ratio_mean);
    put_measure(j, "largest_area_ratio", s->area_ratio);
    hm_json_integer(j, "neighbours", s->neighbours);
    hm_json_integer(j, "area_ratio_over_2", s->jumps);
    hm_json_open(j, "smallest_angle_by_5_degrees", '[');
    for (int k = 0; k < HM_MESHSTAT_BINS; k++)
        hm_json_integer(j, NULL, s->histogram[k]);
    hm_json_close(j, ']');
    hm_json_open(j, "worst_angles", '[');
    for (size_t k = 0; k < s->nworst; k++)
        put_measure(j, NULL, s->worst[k]);
    hm_json_close(j, ']');
    hm_json_close(j, '}');
}

static void put_validity(struct hm_json *j, const struct hm_meshcheck *check)
{
    hm_json_bool(j, "valid", hm_meshcheck_is_valid(check, false));
    hm_json_open(j, "faults", '[');
    for (int k = 0; k < HM_FAULTS; k++) {
        if (!check->count[k])
            continue;
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "fault", hm_mesh_fault_name((enum hm_mesh_fault)k));
        hm_json_integer(j, "count", check->count[k]);
        hm_json_number(j, "x", check->place[k][0]);
        hm_json_number(j, "y", check->place[k][1]);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_criteria(struct hm_json *j, const struct hm_criterion *list, size_t n)
{
    hm_json_open(j, "criteria", '[');
    for (size_t k = 0; k < n; k++) {
        char what[64];
        hm_criterion_print(&list[k], what, sizeof what);
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "criterion", what);
        hm_json_number(j, "value", list[k].value);
        hm_json_bool(j, "met", list[k].met);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

enum hm_err hm_quality_json(const struct hm_quality *q, const struct hm_criterion *list, size_t n,
                            struct hm_writer *w, struct hm_diag *d)
{
    struct hm_json j = {.w = w};
    const struct hm_header *h = &q->mesh->header;
    hm_json_open(&j, NULL, '{');
    hm_json_text(&j, "name", hm_header_get(h, "name"));
    hm_json_text(&j, "role", hm_header_get(h, "role"));
    hm_json_text(&j, "crs", hm_header_get(h, "crs"));
    if (q->surveyed) {
        put_survey(&j, q);
        put_verdicts(&j, q);
    }
    put_shape(&j, &q->shape);
    put_validity(&j, &q->check);
    put_criteria(&j, list, n);
    hm_json_close(&j, '}');
    if (j.err && d && !d->err)
        *d = j.d;
    return j.err;
}
