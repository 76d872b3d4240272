/* The report as JSON. Each object here stands in man/quality.schema.json. */
#include "hm_report.h"

#include "hm_json.h"
#include "hm_verdict.h"

#include <math.h>

static void put_place(struct hm_json *j, const char *name, const char *what, double value, double x,
                      double y)
{
    hm_json_open(j, name, '{');
    hm_json_number(j, what, value);
    hm_json_number(j, "x", x);
    hm_json_number(j, "y", y);
    hm_json_close(j, '}');
}

static void put_measured(struct hm_json *j, const char *name, struct hm_measured m)
{
    put_place(j, name, "value", m.value, m.x, m.y);
}

static void put_residual(struct hm_json *j, const char *name, struct hm_residual r)
{
    put_place(j, name, "residual", r.r, r.x, r.y);
}

/* --- measurements --- */

static void put_residuals(struct hm_json *j, const struct hm_residuals *r)
{
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
    hm_json_number(j, "skew", hm_residuals_skew(r));
    hm_json_number(j, "kurtosis", hm_residuals_kurtosis(r));
    if (r->n) {
        put_residual(j, "lowest", r->least);
        put_residual(j, "highest", r->most);
    }
}

static void put_survey(struct hm_json *j, const struct hm_survey *s)
{
    hm_json_open(j, "measurements", '{');
    hm_json_integer(j, "given", s->points);
    hm_json_integer(j, "without_height", s->heightless);
    hm_json_integer(j, "outside", s->off[0] + s->off[1]);
    hm_json_integer(j, "in_holes", s->off[0]);
    hm_json_integer(j, "mesh_without_height", s->unknown);
    hm_json_integer(j, "compared", hm_survey_all(s)->n);
    hm_json_integer(j, "on_border", s->border);
    hm_json_close(j, '}');
    hm_json_open(j, "thresholds", '[');
    hm_json_number(j, NULL, s->thresholds[0]);
    hm_json_number(j, NULL, s->thresholds[1]);
    hm_json_close(j, ']');
    hm_json_integer(j, "seed", s->seed);
    hm_json_open(j, "samples", '[');
    for (size_t k = 0; k < s->nsamples; k++) {
        hm_json_open(j, NULL, '{');
        hm_json_number(j, "percent", s->sample[k].percent);
        put_residuals(j, &s->sample[k].residuals);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
    hm_json_open(j, "worst_residuals", '[');
    for (size_t k = 0; k < s->nworst; k++)
        put_residual(j, NULL, s->worst[k]);
    hm_json_close(j, ']');
}

static void put_verdicts(struct hm_json *j, const struct hm_residuals *r, double survey_error)
{
    struct hm_verdict v[HM_VERDICTS];
    size_t n = r->n ? hm_verdicts(r, survey_error, v) : 0;
    hm_json_open(j, "verdicts", '[');
    for (size_t k = 0; k < n; k++) {
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "what", v[k].what);
        hm_json_text(j, "source", v[k].source);
        hm_json_number(j, "value", v[k].value);
        hm_json_text(j, "unit", v[k].unit);
        hm_json_text(j, "judgement", hm_judgement_name(v[k].judgement));
        hm_json_bool(j, "met", v[k].judgement == HM_JUDGE_PASS);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_strata(struct hm_json *j, const struct hm_quality *q)
{
    static const char *const by[] = {NULL, "class", "region", "zone"};
    hm_json_text(j, "strata_by", by[q->strata]);
    hm_json_open(j, "strata", '[');
    for (size_t k = 0; k < q->survey.nstrata; k++) {
        const struct hm_stratum *s = &q->survey.stratum[k];
        char name[64];
        hm_quality_stratum(q, s->key, name, sizeof name);
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "stratum", name);
        put_residuals(j, &s->residuals);
        put_verdicts(j, &s->residuals, q->survey_error);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

/* --- lines --- */

static void put_line(struct hm_json *j, const char *name, const struct hm_fidelity_line *l)
{
    hm_json_open(j, name, '{');
    hm_json_text(j, "line", l->name);
    hm_json_number(j, "length", l->length);
    hm_json_number(j, "on_mesh", l->on_mesh);
    hm_json_number(j, "followed", hm_fidelity_share(l));
    hm_json_number(j, "lateral_mean", l->lateral);
    put_measured(j, "lateral_largest", l->aside);
    hm_json_number(j, "vertical_mean", l->rise);
    hm_json_number(j, "vertical_mean_size", l->rise_size);
    put_measured(j, "vertical_largest", l->worst);
    put_measured(j, "longest_not_followed", l->gap);
    put_measured(j, "triangles_on_line", l->across);
    hm_json_close(j, '}');
}

static void put_lines(struct hm_json *j, const struct hm_fidelity *f)
{
    hm_json_open(j, "lines", '{');
    hm_json_number(j, "tolerance", f->tolerance);
    put_line(j, "all", &f->all);
    hm_json_open(j, "each", '[');
    for (size_t k = 0; k < f->n; k++)
        put_line(j, NULL, &f->line[k]);
    hm_json_close(j, ']');
    hm_json_close(j, '}');
}

/* --- elements --- */

/* Under its name, with _ for blanks. */
static void put_measure(struct hm_json *j, const struct hm_measure_kind *kind,
                        const struct hm_measure *m)
{
    char name[32];
    size_t n = 0;
    for (; kind->name[n] && n + 1 < sizeof name; n++)
        name[n] = kind->name[n] == ' ' ? '_' : kind->name[n];
    name[n] = 0;
    hm_json_open(j, name, '{');
    hm_json_text(j, "unit", kind->unit);
    hm_json_integer(j, "count", m->n);
    hm_json_number(j, "mean", hm_measure_mean(m));
    hm_json_number(j, "least", m->n ? m->least.value : NAN);
    hm_json_number(j, "most", m->n ? m->most.value : NAN);
    hm_json_open(j, "histogram", '[');
    for (int k = 0; k < kind->bins; k++) {
        hm_json_open(j, NULL, '{');
        hm_json_number(j, "from", kind->limit[k]);
        hm_json_number(j, "to", kind->limit[k + 1]);
        hm_json_integer(j, "count", m->bin[k]);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
    hm_json_open(j, "worst", '[');
    for (int k = 0; k < m->nworst; k++)
        put_measured(j, NULL, m->worst[k]);
    hm_json_close(j, ']');
    hm_json_close(j, '}');
}

static void put_part(struct hm_json *j, const struct hm_meshpart *p)
{
    hm_json_integer(j, "triangles", (int64_t)p->triangles);
    hm_json_integer(j, "quadrilaterals", (int64_t)p->quads);
    hm_json_number(j, "area", p->area);
    hm_json_integer(j, "faulty_elements", p->faults);
    hm_json_open(j, "measures", '{');
    for (int k = 0; k < HM_SHAPES; k++)
        if (p->shape[k].n)
            put_measure(j, &hm_shape_kind[k], &p->shape[k]);
    hm_json_close(j, '}');
    hm_json_open(j, "warnings", '[');
    for (int k = 0; k < HM_WARNINGS; k++) {
        if (!p->warning[k])
            continue;
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "warning", hm_mesh_warning_name((enum hm_mesh_warning)k));
        hm_json_integer(j, "count", p->warning[k]);
        hm_json_number(j, "x", p->place[k][0]);
        hm_json_number(j, "y", p->place[k][1]);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_elements(struct hm_json *j, const struct hm_quality *q)
{
    hm_json_open(j, "elements", '{');
    hm_json_integer(j, "nodes", (int64_t)q->shape.nodes);
    put_part(j, &q->shape.whole);
    hm_json_open(j, "materials", '[');
    for (size_t k = 0; k < q->shape.nparts; k++) {
        hm_json_open(j, NULL, '{');
        hm_json_integer(j, "material", q->shape.part[k].region);
        put_part(j, &q->shape.part[k]);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
    hm_json_number(j, "courant_depth", q->waved ? q->depth : NAN);
    hm_json_number(j, "courant_velocity", q->waved ? q->velocity : NAN);
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

/* --- the whole --- */

static void put_quality(struct hm_json *j, const struct hm_quality *q)
{
    const struct hm_header *h = &q->mesh.header;
    hm_json_text(j, "name", hm_header_get(h, "name"));
    hm_json_text(j, "role", hm_header_get(h, "role"));
    hm_json_text(j, "crs", hm_header_get(h, "crs"));
    hm_json_text(j, "units", hm_header_get(h, "units"));
    put_survey(j, &q->survey);
    put_strata(j, q);
    hm_json_number(j, "survey_error", q->survey_error);
    put_verdicts(j, hm_survey_all(&q->survey), q->survey_error);
    put_lines(j, &q->lines);
    put_elements(j, q);
    put_validity(j, &q->check);
}

enum hm_err hm_report_json(const struct hm_report *r, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_json j = {.w = w};
    hm_json_open(&j, NULL, '{');
    put_quality(&j, r->mesh);
    if (r->other) {
        hm_json_open(&j, "other", '{');
        put_quality(&j, r->other);
        hm_json_close(&j, '}');
    }
    hm_json_open(&j, "criteria", '[');
    for (size_t k = 0; k < r->ncriteria; k++) {
        char what[64];
        hm_criterion_print(&r->criterion[k], what, sizeof what);
        hm_json_open(&j, NULL, '{');
        hm_json_text(&j, "criterion", what);
        hm_json_number(&j, "value", r->criterion[k].value);
        hm_json_bool(&j, "met", r->criterion[k].met);
        hm_json_close(&j, '}');
    }
    hm_json_close(&j, ']');
    hm_json_close(&j, '}');
    if (j.err && d && !d->err)
        *d = j.d;
    return j.err;
}
