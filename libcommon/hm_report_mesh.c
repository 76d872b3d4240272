/* The report's pages about lines and elements. */
#include "hm_report_private.h"

#include <math.h>
#include <stdlib.h>

/* --- lines --- */

enum { LINES_SHOWN = 20 };

/* Those of which most metres are not followed first, of equals the earlier. */
static int by_unfollowed(const void *pa, const void *pb)
{
    const struct hm_fidelity_line *a = *(const struct hm_fidelity_line *const *)pa;
    const struct hm_fidelity_line *b = *(const struct hm_fidelity_line *const *)pb;
    double left = a->on_mesh - a->followed, right = b->on_mesh - b->followed;
    return left != right ? (left > right ? -1 : 1) : (a > b) - (a < b);
}

static void say_line(struct hm_report_page *p, const struct hm_fidelity_line *l)
{
    hm_say(p, "  %-18.18s %9.1f %9.1f", l->name, l->length, l->on_mesh);
    if (l->on_mesh > 0)
        hm_say(p, "  %5.1f%%", hm_fidelity_share(l));
    if (l->followed > 0)
        hm_say(p, "  %6.3f  %6.3f", l->lateral, l->aside.value);
    else
        hm_say(p, "       -       -");
    if (l->sounded > 0)
        hm_say(p, "  %6.3f  %7.3f  at %.3f %.3f", l->rise_size, l->worst.value, l->worst.x,
               l->worst.y);
    hm_say(p, "\n");
}

void hm_report_lines(struct hm_report_page *p, const struct hm_fidelity *f)
{
    const struct hm_fidelity_line **line = hm_alloc(f->n, sizeof *line);
    if (!line) {
        p->err = p->err ? p->err : hm_fail_memory(p->d);
        return;
    }
    for (size_t k = 0; k < f->n; k++)
        line[k] = &f->line[k];
    qsort(line, f->n, sizeof *line, by_unfollowed);
    hm_say(p, "\nLines: %zu; an edge follows within %g m and 15 degrees\n", f->n, f->tolerance);
    hm_say(p,
           "                                           share        aside, m        height, m\n");
    hm_say(p,
           "  line                length   on mesh  followed    mean    most    mean  largest\n");
    say_line(p, &f->all);
    for (size_t k = 0; k < f->n && k < LINES_SHOWN; k++)
        say_line(p, line[k]);
    if (f->n > LINES_SHOWN)
        hm_say(p, "  (of %zu lines those of which most metres are not followed)\n", f->n);
    if (!isnan(f->all.aside.value))
        hm_say(p, "  furthest aside           %.3f m at %.3f %.3f\n", f->all.aside.value,
               f->all.aside.x, f->all.aside.y);
    if (!isnan(f->all.gap.value))
        hm_say(p, "  longest way not followed %.1f m from %.3f %.3f\n", f->all.gap.value,
               f->all.gap.x, f->all.gap.y);
    if (f->all.across.value > 0)
        hm_say(p, "  triangles with all nodes on one line: %.0f, the first at %.3f %.3f\n",
               f->all.across.value, f->all.across.x, f->all.across.y);
    free(line);
}

/* --- elements --- */

static void say_measures(struct hm_report_page *p, const struct hm_meshpart *whole)
{
    hm_say(p, "  measure                     least       mean       most       worst at\n");
    for (int k = 0; k < HM_SHAPES; k++) {
        const struct hm_measure_kind *kind = &hm_shape_kind[k];
        const struct hm_measure *m = &whole->shape[k];
        const struct hm_measured *worst = m->worst;
        if (!m->n)
            continue;
        hm_say(p, "  %-22s %10.3f %10.3f %10.3f  %-3s  %.3f %.3f\n", kind->name, m->least.value,
               hm_measure_mean(m), m->most.value, kind->unit, worst->x, worst->y);
    }
}

static void say_parts(struct hm_report_page *p, const struct hm_meshstat *s)
{
    hm_say(p, "\nMaterials\n");
    hm_say(p, "  material  elements        area m2  angle least    most  edge ratio  area ratio"
              "  faults  warnings\n");
    for (size_t k = 0; k < s->nparts; k++) {
        const struct hm_meshpart *part = &s->part[k];
        const struct hm_measure *m = part->shape;
        hm_say(p, "  %8d %9zu %14.1f %12.2f %7.2f %11.2f %11.2f %7lld %9lld\n", (int)part->region,
               part->triangles + part->quads, part->area,
               hm_measure_least(&m[HM_SHAPE_LEAST_ANGLE]), hm_measure_most(&m[HM_SHAPE_MOST_ANGLE]),
               hm_measure_most(&m[HM_SHAPE_EDGE_RATIO]), hm_measure_most(&m[HM_SHAPE_AREA_RATIO]),
               (long long)part->faults, (long long)hm_meshpart_warnings(part));
    }
}

static void say_worst(struct hm_report_page *p, const struct hm_meshpart *whole)
{
    for (int k = 0; k < HM_SHAPES; k++) {
        const struct hm_measure *m = &whole->shape[k];
        const char *bad = hm_shape_kind[k].small_is_bad ? "smallest" : "largest";
        if (!m->n || k == HM_SHAPE_DEGREE)
            continue;
        hm_say(p, "\n  %s, the %d %s at\n", hm_shape_kind[k].name, m->nworst, bad);
        for (int i = 0; i < m->nworst; i++)
            hm_say(p, "    %10.3f %-4s %.3f %.3f\n", m->worst[i].value, hm_shape_kind[k].unit,
                   m->worst[i].x, m->worst[i].y);
    }
}

static void say_faults(struct hm_report_page *p, const struct hm_quality *q)
{
    bool any = false;
    hm_say(p, "\nValidity\n");
    for (int k = 0; k < HM_FAULTS; k++) {
        if (!q->check.count[k])
            continue;
        any = true;
        hm_say(p, "  error    %-44s %10lld  first at %.3f %.3f\n",
               hm_mesh_fault_name((enum hm_mesh_fault)k), (long long)q->check.count[k],
               q->check.place[k][0], q->check.place[k][1]);
    }
    if (!any)
        hm_say(p, "  no fault: a solver can take this mesh\n");
    for (int k = 0; k < HM_WARNINGS; k++)
        if (q->shape.whole.warning[k])
            hm_say(p, "  warning  %-44s %10lld  first at %.3f %.3f\n",
                   hm_mesh_warning_name((enum hm_mesh_warning)k),
                   (long long)q->shape.whole.warning[k], q->shape.whole.place[k][0],
                   q->shape.whole.place[k][1]);
}

void hm_report_elements(struct hm_report_page *p, const struct hm_quality *q)
{
    const struct hm_meshstat *s = &q->shape;
    hm_say(p, "\nElements\n");
    hm_say(p, "  nodes %zu, triangles %zu, quadrilaterals %zu, area %.3f m2\n", s->nodes,
           s->whole.triangles, s->whole.quads, s->whole.area);
    if (q->waved)
        hm_say(p, "  time step: of Courant number 1 at a depth of %g m and %g m/s\n", q->depth,
               q->velocity);
    say_measures(p, &s->whole);
    if (s->nparts > 1)
        say_parts(p, s);
    say_faults(p, q);
    say_worst(p, &s->whole);
}

/* --- histograms --- */

static void say_bin(struct hm_report_page *p, const struct hm_measure_kind *kind,
                    const struct hm_measure *m, int k, int64_t most)
{
    static const char bar[] = "########################################";
    int length = (int)((m->bin[k] * 40 + most - 1) / most);
    double share = 100 * (double)m->bin[k] / (double)m->n;
    hm_say(p, "    %7g", kind->limit[k]);
    if (isinf(kind->limit[k + 1]))
        hm_say(p, " and more ");
    else
        hm_say(p, " - %-7g", kind->limit[k + 1]);
    hm_say(p, "%10lld  %5.1f%%%s%.*s\n", (long long)m->bin[k], share, length ? "  " : "", length,
           bar);
}

void hm_report_histograms(struct hm_report_page *p, const struct hm_meshstat *s)
{
    hm_say(p, "\nHistograms\n");
    for (int shape = 0; shape < HM_SHAPES; shape++) {
        const struct hm_measure_kind *kind = &hm_shape_kind[shape];
        const struct hm_measure *m = &s->whole.shape[shape];
        int first = -1, last = 0;
        int64_t most = 1;
        for (int k = 0; k < kind->bins; k++) {
            if (m->bin[k] > most)
                most = m->bin[k];
            if (m->bin[k] && first < 0)
                first = k;
            if (m->bin[k])
                last = k;
        }
        if (first < 0)
            continue;
        hm_say(p, "\n  %s%s%s\n", kind->name, *kind->unit ? ", " : "", kind->unit);
        for (int k = first; k <= last; k++)
            say_bin(p, kind, m, k, most);
    }
}
