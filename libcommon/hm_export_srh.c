/* SRH-2D .srhgeom. */
#include "hm_export_private.h"

#include <string.h>

/* SRH-2D knows metres and feet by these words. */
static const char *unit_of(const struct hm_mesh *m)
{
    const char *units = hm_header_get(&m->header, "units");
    return units && (!strncmp(units, "ft", 2) || !strncmp(units, "us-ft", 5)) ? "Feet" : "Meters";
}

enum hm_err hm_export_srh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    enum { PER_LINE = 10 };
    struct hm_strings strings = {0};
    enum hm_err err = hm_strings_read(&strings, m, d);
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_format(&s, "SRHGEOM 30\nName \"%.200s\"\n\nGridUnit \"%s\"\n", hm_export_name(m),
                   unit_of(m));
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_format(&s, "Elem %zu", k + 1);
        hm_export_corners(&s, &m->elem[k], 1);
        hm_sink_text(&s, "\n");
    }
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_format(&s, "Node %zu", k + 1);
        hm_export_place(&s, &m->node[k]);
        hm_sink_text(&s, "\n");
    }
    for (size_t k = 0; k < strings.n; k++) {
        hm_sink_format(&s, "NodeString %zu", k + 1);
        for (size_t i = 0; i < strings.string[k].n; i++)
            hm_sink_format(&s, "%s %d", i > 0 && i % PER_LINE == 0 ? "\n" : "",
                           strings.string[k].node[i] + 1);
        hm_sink_text(&s, "\n");
    }
    hm_strings_free(&strings);
    return err ? err : hm_sink_finish(&s);
}
