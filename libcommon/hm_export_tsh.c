/* ANUGA .tsh: vertices with their elevation, triangles with their neighbours, segments of the
 * boundary with a tag; an outline without anything in it. */
#include "hm_crs.h"
#include "hm_export_private.h"

#include <stdlib.h>

/* neighbour[3 k + i]: across the side opposite corner i of triangle k; -1 outside. */
static enum hm_err find_neighbours(const struct hm_mesh *m, int32_t **neighbour, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n = 0;
    *neighbour = hm_alloc(3 * m->nelems, sizeof **neighbour);
    enum hm_err err = *neighbour ? hm_mesh_edges(m, &edge, &n, d) : hm_fail_memory(d);
    for (size_t i = 0; i < n && !err; i++) {
        const int32_t beside[2] = {edge[i].left, edge[i].right};
        for (int side = 0; side < 2; side++) {
            if (beside[side] < 0)
                continue;
            const struct hm_elem *e = &m->elem[beside[side]];
            for (int k = 0; k < 3; k++)
                if (e->node[k] != edge[i].a && e->node[k] != edge[i].b)
                    (*neighbour)[3 * beside[side] + k] = beside[1 - side];
        }
    }
    free(edge);
    return err;
}

static void put_segments(struct hm_sink *s, const struct hm_export_border *b)
{
    size_t number = 0;
    hm_sink_format(s,
                   "%zu # <# of segments>, next lines <segment #> <vertex #>  <vertex #> "
                   "[boundary tag] ...Triangulation Segments...\n",
                   b->n);
    for (size_t k = 0; k < b->loops.nloops; k++)
        for (size_t i = b->loops.start[k]; i < b->loops.start[k + 1]; i++) {
            int32_t string = b->string[i];
            hm_sink_format(s, "%zu %d %d ", number++, b->loops.node[i],
                           b->loops.node[hm_export_border_next(b, k, i)]);
            hm_sink_text(s, string < 0 ? "exterior" : b->strings.string[string].name);
            hm_sink_text(s, "\n");
        }
}

static void put_outline(struct hm_sink *s, const struct hm_mesh *m)
{
    struct hm_crs crs;
    const char *text = hm_header_get(&m->header, "crs");
    bool utm = text && hm_crs_parse(&crs, text) && crs.kind == HM_CRS_UTM;
    hm_sink_text(s, "0 0 # <# of verts> <# of vert attributes>, next lines <vertex #> <x> <y> "
                    "[attributes] ...Mesh Vertices...\n"
                    "0 # <# of segments>, next lines <segment #> <vertex #>  <vertex #> "
                    "[boundary tag] ...Mesh Segments...\n"
                    "0 # <# of holes>, next lines <Hole #> <x> <y> ...Mesh Holes...\n"
                    "0 # <# of regions>, next lines <Region #> <x> <y> <tag>...Mesh Regions...\n"
                    "0 # <# of regions>, next lines <Region #> [Max Area] ...Mesh Regions...\n");
    hm_sink_format(s, "#geo reference\n%d\n0.0\n0.0\n", utm ? crs.zone : -1);
}

enum hm_err hm_export_tsh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_export_border b;
    int32_t *neighbour = NULL;
    enum hm_err err = hm_export_border_build(&b, m, d);
    if (!err)
        err = find_neighbours(m, &neighbour, d);
    if (err) {
        free(neighbour);
        hm_export_border_free(&b);
        return err;
    }
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_format(&s,
                   "%zu 1 # <# of verts> <# of vert attributes>, next lines <vertex #> <x> <y> "
                   "[attributes] ...Triangulation Vertices...\n",
                   m->nnodes);
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_integer(&s, (int64_t)k);
        hm_export_place(&s, &m->node[k]);
        hm_sink_text(&s, "\n");
    }
    hm_sink_format(&s,
                   "# attribute column titles ...Triangulation Vertex Titles...\nelevation\n"
                   "%zu # <# of triangles>, next lines <triangle #> [<vertex #>] "
                   "[<neigbouring triangle #>] [attribute of region] ...Triangulation "
                   "Triangles...\n",
                   m->nelems);
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_integer(&s, (int64_t)k);
        hm_export_corners(&s, &m->elem[k], 0);
        hm_sink_format(&s, " %d %d %d %d\n", neighbour[3 * k], neighbour[3 * k + 1],
                       neighbour[3 * k + 2], m->elem[k].region);
    }
    put_segments(&s, &b);
    put_outline(&s, m);
    free(neighbour);
    hm_export_border_free(&b);
    return hm_sink_finish(&s);
}
