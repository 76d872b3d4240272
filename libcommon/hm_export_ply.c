/* PLY, text: vertices in double precision, faces with their region. */
#include "hm_export_private.h"

enum hm_err hm_export_ply(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_format(&s,
                   "ply\nformat ascii 1.0\nelement vertex %zu\nproperty double x\n"
                   "property double y\nproperty double z\nelement face %zu\n"
                   "property list uchar int vertex_indices\nproperty int region\nend_header\n",
                   m->nnodes, m->nelems);
    for (size_t k = 0; k < m->nnodes; k++) {
        const double v[3] = {m->node[k].x, m->node[k].y, m->node[k].z};
        for (int i = 0; i < 3; i++) {
            hm_sink_number(&s, v[i], 0);
            hm_sink_text(&s, i < 2 ? " " : "\n");
        }
    }
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_integer(&s, hm_elem_corners(&m->elem[k]));
        hm_export_corners(&s, &m->elem[k], 0);
        hm_sink_format(&s, " %d\n", m->elem[k].region);
    }
    return hm_sink_finish(&s);
}
