#include "hm_report_private.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void hm_say(struct hm_report_page *p, const char *format, ...)
{
    char line[512];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (n >= (int)sizeof line)
        n = (int)sizeof line - 1;
    if (!p->err && n > 0)
        p->err = hm_writer_bytes(p->w, line, (size_t)n, p->d);
}

static const char *key(const struct hm_quality *q, const char *name)
{
    const char *value = hm_header_get(&q->mesh.header, name);
    return value ? value : "";
}

static void say_head(struct hm_report_page *p, const struct hm_quality *q)
{
    const char *name = key(q, "name"), *role = key(q, "role");
    hm_say(p, "Quality of mesh%s%s%s%s%s\n", *name ? " " : "", name, *role ? " (" : "", role,
           *role ? ")" : "");
    if (*key(q, "crs"))
        hm_say(p, "  crs %s\n", key(q, "crs"));
    if (q->metres != 1 || q->z_metres != 1)
        hm_say(p, "  units %s: places are in those, all else is in metres\n", key(q, "units"));
}

/* --- side by side --- */

static void say_value(struct hm_report_page *p, double v)
{
    if (isnan(v))
        hm_say(p, " %14s", "-");
    else if (v == floor(v) && fabs(v) < 1e9)
        hm_say(p, " %14.0f", v);
    else
        hm_say(p, " %14.4f", v);
}

static void say_comparison(struct hm_report_page *p, const struct hm_quality *a,
                           const struct hm_quality *b)
{
    const char *name, *unit;
    hm_say(p, "\nSide by side\n  measure                   this          other     difference\n");
    for (int k = 0; hm_quality_measure(k, &name, &unit); k++) {
        double x = hm_quality_value(a, k), y = hm_quality_value(b, k);
        if (isnan(x) && isnan(y))
            continue;
        hm_say(p, "  %-13s %-3s", name, unit);
        say_value(p, x);
        say_value(p, y);
        say_value(p, y - x);
        hm_say(p, "\n");
    }
}

static void say_criteria(struct hm_report_page *p, const struct hm_report *r)
{
    hm_say(p, "\nCriteria\n");
    for (size_t k = 0; k < r->ncriteria; k++) {
        char what[64];
        hm_criterion_print(&r->criterion[k], what, sizeof what);
        hm_say(p, "  %s  %-24s %g\n", r->criterion[k].met ? "pass" : "miss", what,
               r->criterion[k].value);
    }
}

enum hm_err hm_report_text(const struct hm_report *r, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_report_page page = {w, HM_OK, d}, *p = &page;
    const struct hm_quality *meshes[] = {r->mesh, r->other};
    for (int k = 0; k < 2 && meshes[k]; k++) {
        if (k > 0)
            hm_say(p, "\n");
        say_head(p, meshes[k]);
        hm_report_survey(p, meshes[k]);
        if (meshes[k]->lines.n > 0)
            hm_report_lines(p, &meshes[k]->lines);
        hm_report_elements(p, meshes[k]);
        hm_report_histograms(p, &meshes[k]->shape);
    }
    if (r->other)
        say_comparison(p, r->mesh, r->other);
    if (r->ncriteria)
        say_criteria(p, r);
    return page.err;
}
