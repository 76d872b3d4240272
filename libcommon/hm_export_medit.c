/* Medit .mesh of two dimensions: no heights; the reference of an edge of the boundary is the number
 * of its string, from 1, or 0. */
#include "hm_export_private.h"

static size_t count(const struct hm_mesh *m, int corners)
{
    size_t n = 0;
    for (size_t k = 0; k < m->nelems; k++)
        n += hm_elem_corners(&m->elem[k]) == corners;
    return n;
}

static void put_elements(struct hm_sink *s, const struct hm_mesh *m, const char *name, int corners)
{
    size_t n = count(m, corners);
    if (n == 0)
        return;
    hm_sink_format(s, "%s\n%zu\n", name, n);
    for (size_t k = 0; k < m->nelems; k++)
        if (hm_elem_corners(&m->elem[k]) == corners) {
            hm_export_corners(s, &m->elem[k], 1);
            hm_sink_format(s, " %d\n", m->elem[k].region);
        }
}

enum hm_err hm_export_medit(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_export_border b;
    enum hm_err err = hm_export_border_build(&b, m, d);
    if (err)
        return err;
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_format(&s, "MeshVersionFormatted 2\nDimension 2\nVertices\n%zu\n", m->nnodes);
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_number(&s, m->node[k].x, 0);
        hm_sink_text(&s, " ");
        hm_sink_number(&s, m->node[k].y, 0);
        hm_sink_text(&s, " 0\n");
    }
    hm_sink_format(&s, "Edges\n%zu\n", b.n);
    for (size_t k = 0; k < b.loops.nloops; k++)
        for (size_t i = b.loops.start[k]; i < b.loops.start[k + 1]; i++)
            hm_sink_format(&s, "%d %d %d\n", b.loops.node[i] + 1,
                           b.loops.node[hm_export_border_next(&b, k, i)] + 1, b.string[i] + 1);
    put_elements(&s, m, "Triangles", 3);
    put_elements(&s, m, "Quadrilaterals", 4);
    hm_sink_text(&s, "End\n");
    hm_export_border_free(&b);
    return hm_sink_finish(&s);
}
