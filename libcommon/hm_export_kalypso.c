/* RMA-10S / Kalypso .2d: nodes FP, arcs AR with the element on either side, elements FE; columns of
 * fixed width. */
#include "hm_export_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DECIMALS = 7, WIDTH = 20 };

/* A number in its column of twenty, seven places behind the point; one that does not fit there
 * would run into the next. */
static void put_fixed(struct hm_sink *s, double v)
{
    char text[64];
    const double unit = 1e7;
    /* In integers: printf's point depends on the locale. */
    if (!(fabs(v) < 9e11)) {
        if (!s->err)
            s->err = hm_fail(s->d, HM_EARG, "a coordinate is too large for the format");
        return;
    }
    double whole = floor(fabs(v)), part = rint((fabs(v) - whole) * unit);
    if (part >= unit) {
        whole += 1;
        part = 0;
    }
    bool minus = v < 0 && (whole > 0 || part > 0);
    snprintf(text, sizeof text, "%s%.0f.%07.0f", minus ? "-" : "", whole, part);
    hm_sink_format(s, "%*s", WIDTH, text);
}

enum hm_err hm_export_kalypso(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n = 0;
    struct hm_sink s = hm_sink_to(w, d);
    int64_t spare = hm_export_spare_region(m);
    enum hm_err err = hm_mesh_edges(m, &edge, &n, d);
    if (err)
        return err;
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_format(&s, "FP%10zu", k + 1);
        put_fixed(&s, m->node[k].x);
        put_fixed(&s, m->node[k].y);
        put_fixed(&s, m->node[k].z);
        hm_sink_text(&s, "\n");
    }
    for (size_t k = 0; k < n; k++)
        hm_sink_format(&s, "AR%10zu%10d%10d%10d%10d%10d\n", k + 1, edge[k].a + 1, edge[k].b + 1,
                       edge[k].left + 1, edge[k].right < 0 ? 0 : edge[k].right + 1, 0);
    for (size_t k = 0; k < m->nelems; k++) {
        long long class = m->elem[k].region ? m->elem[k].region : spare;
        hm_sink_format(&s, "FE%10zu%10lld%10lld%10d\n", k + 1, class, class, 0);
    }
    free(edge);
    return hm_sink_finish(&s);
}
