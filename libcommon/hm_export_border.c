/* What the writers of mesh formats share: names, places, the boundary with its strings. */
#include "hm_export_private.h"

#include <stdlib.h>
#include <string.h>

int64_t hm_export_spare_region(const struct hm_mesh *m)
{
    int64_t largest = 0;
    for (size_t k = 0; k < m->nelems; k++)
        if (m->elem[k].region > largest)
            largest = m->elem[k].region;
    return largest + 1;
}

const char *hm_export_name(const struct hm_mesh *m)
{
    const char *name = hm_header_get(&m->header, "name");
    return name ? name : "mesh";
}

void hm_export_place(struct hm_sink *s, const struct hm_node *node)
{
    const double v[3] = {node->x, node->y, node->z};
    for (int k = 0; k < 3; k++) {
        hm_sink_text(s, " ");
        hm_sink_number(s, v[k], 0);
    }
}

void hm_export_corners(struct hm_sink *s, const struct hm_elem *e, int first)
{
    for (int i = 0; i < hm_elem_corners(e); i++) {
        hm_sink_text(s, " ");
        hm_sink_integer(s, (int64_t)e->node[i] + first);
    }
}

enum hm_export_side hm_export_side_of(const char *name)
{
    static const char *const closed[] = {"wall", "land", "bank", "island"};
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++)
        if (!strncmp(name, closed[i], strlen(closed[i])))
            return HM_SIDE_WALL;
    return strncmp(name, "inflow", 6) ? HM_SIDE_OPEN : HM_SIDE_INFLOW;
}

/* Mark the edge between two nodes of a string, when it is one of the boundary. */
static void mark(struct hm_export_border *b, const int32_t *next, int32_t a, int32_t c,
                 int32_t string)
{
    int32_t from = b->place[a], to = b->place[c];
    if (from < 0 || to < 0)
        return;
    if (next[from] == to)
        b->string[from] = string;
    else if (next[to] == from)
        b->string[to] = string;
}

static enum hm_err mark_strings(struct hm_export_border *b, struct hm_diag *d)
{
    int32_t *next = hm_alloc(b->n, sizeof *next);
    if (!next)
        return hm_fail_memory(d);
    for (size_t k = 0; k < b->loops.nloops; k++)
        for (size_t i = b->loops.start[k]; i < b->loops.start[k + 1]; i++)
            next[i] = (int32_t)hm_export_border_next(b, k, i);
    for (size_t s = 0; s < b->strings.n; s++)
        for (size_t i = 0; i + 1 < b->strings.string[s].n; i++)
            mark(b, next, b->strings.string[s].node[i], b->strings.string[s].node[i + 1],
                 (int32_t)s);
    free(next);
    return HM_OK;
}

enum hm_err hm_export_border_build(struct hm_export_border *b, const struct hm_mesh *m,
                                   struct hm_diag *d)
{
    *b = (struct hm_export_border){0};
    enum hm_err err = hm_mesh_boundary(m, &b->loops, d);
    if (err)
        return err;
    b->n = b->loops.start[b->loops.nloops];
    b->string = hm_alloc(b->n, sizeof *b->string);
    b->place = hm_alloc(m->nnodes, sizeof *b->place);
    err = b->string && b->place ? hm_strings_read(&b->strings, m, d) : hm_fail_memory(d);
    if (!err) {
        for (size_t i = 0; i < m->nnodes; i++)
            b->place[i] = -1;
        for (size_t i = 0; i < b->n; i++) {
            b->string[i] = -1;
            b->place[b->loops.node[i]] = (int32_t)i;
        }
        err = mark_strings(b, d);
    }
    if (err)
        hm_export_border_free(b);
    return err;
}

void hm_export_border_free(struct hm_export_border *b)
{
    hm_mesh_loops_free(&b->loops);
    hm_strings_free(&b->strings);
    free(b->string);
    free(b->place);
    *b = (struct hm_export_border){0};
}

bool hm_export_is_island(const struct hm_export_border *b, const struct hm_mesh *m, size_t k)
{
    const size_t first = b->loops.start[k];
    const double *o = hm_mesh_xy(m, b->loops.node[first]);
    double area = 0;
    for (size_t i = first + 1; i + 1 < b->loops.start[k + 1]; i++) {
        const double *p = hm_mesh_xy(m, b->loops.node[i]), *q = hm_mesh_xy(m, b->loops.node[i + 1]);
        area += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    }
    return area < 0;
}
