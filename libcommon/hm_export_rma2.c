/* RMA2/GFGEN geometry: GE elements with mid-side nodes, GNN nodes, GC node strings. */
#include "hm_export_private.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 80 }; /* that GFGEN reads of a line */

/* The mid-side nodes: those of element e are mid[4 e .. ), numbers behind those of the corners. */
struct middles {
    struct hm_mesh_edge *edge;
    size_t n;
    int32_t *mid;
};

/* Which side of the element begins at node a? */
static int side_of(const struct hm_elem *e, int32_t a)
{
    int i = 0;
    while (e->node[i] != a)
        i++;
    return i;
}

static enum hm_err find_middles(struct middles *mid, const struct hm_mesh *m, struct hm_diag *d)
{
    *mid = (struct middles){0};
    enum hm_err err = hm_mesh_edges(m, &mid->edge, &mid->n, d);
    if (err)
        return err;
    if (m->nnodes + mid->n > INT32_MAX)
        return hm_fail(d, HM_EARG, "too many nodes for mid-side nodes");
    mid->mid = hm_alloc(4 * m->nelems, sizeof *mid->mid);
    if (!mid->mid)
        return hm_fail_memory(d);
    for (size_t i = 0; i < mid->n; i++) {
        const struct hm_mesh_edge *edge = &mid->edge[i];
        int32_t number = (int32_t)(m->nnodes + i);
        mid->mid[4 * edge->left + side_of(&m->elem[edge->left], edge->a)] = number;
        if (edge->right >= 0)
            mid->mid[4 * edge->right + side_of(&m->elem[edge->right], edge->b)] = number;
    }
    return HM_OK;
}

/* A line that GFGEN would cut is an error: with fewer digits it would be another mesh. */
static void check_line(struct hm_sink *s, int64_t start)
{
    if (s->written - start > COLUMNS + 1 && !s->err)
        s->err = hm_fail(s->d, HM_EARG,
                         "a line would be longer than the %d columns of RMA2; --origin makes "
                         "coordinates shorter",
                         COLUMNS);
}

static void write_elements(struct hm_sink *s, const struct hm_mesh *m, const struct middles *mid)
{
    int64_t spare = hm_export_spare_region(m);
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        int64_t start = s->written;
        int corners = hm_elem_corners(e);
        hm_sink_format(s, "GE %zu", k + 1);
        for (int i = 0; i < 4; i++)
            if (i < corners)
                hm_sink_format(s, " %d %d", e->node[i] + 1, mid->mid[4 * k + (size_t)i] + 1);
            else
                hm_sink_text(s, " 0 0");
        hm_sink_format(s, " %lld\n", (long long)(e->region ? e->region : spare));
        check_line(s, start);
    }
}

static void write_node(struct hm_sink *s, size_t number, const struct hm_node *node)
{
    int64_t start = s->written;
    hm_sink_format(s, "GNN %zu", number);
    hm_export_place(s, node);
    hm_sink_text(s, "\n");
    check_line(s, start);
}

static void write_nodes(struct hm_sink *s, const struct hm_mesh *m, const struct middles *mid)
{
    for (size_t k = 0; k < m->nnodes; k++)
        write_node(s, k + 1, &m->node[k]);
    for (size_t k = 0; k < mid->n; k++) {
        const struct hm_node *a = &m->node[mid->edge[k].a], *b = &m->node[mid->edge[k].b];
        struct hm_node middle = {a->x + (b->x - a->x) / 2, a->y + (b->y - a->y) / 2,
                                 a->z + (b->z - a->z) / 2, 0, 0};
        write_node(s, m->nnodes + k + 1, &middle);
    }
}

/* Cards that end with -1, several to a string when one would be too long. */
static void write_strings(struct hm_sink *s, const struct hm_strings *strings)
{
    enum { NUMBER = 11 }; /* room that a number and its blank may need */
    for (size_t k = 0; k < strings->n; k++) {
        int64_t start = s->written;
        hm_sink_format(s, "GC %zu", k + 1);
        for (size_t i = 0; i < strings->string[k].n; i++) {
            if (s->written - start + NUMBER + 3 > COLUMNS) {
                hm_sink_text(s, "\n");
                start = s->written;
                hm_sink_text(s, "GC");
            }
            hm_sink_format(s, " %d", strings->string[k].node[i] + 1);
        }
        hm_sink_text(s, " -1\n");
    }
}

enum hm_err hm_export_rma2(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct middles mid;
    struct hm_strings strings = {0};
    struct hm_sink s = hm_sink_to(w, d);
    enum hm_err err = hm_strings_read(&strings, m, d);
    if (!err)
        err = find_middles(&mid, m, d);
    else
        mid = (struct middles){0};
    if (!err) {
        hm_sink_format(&s, "T1 %.60s\nT2\nT3\nSI 1\n", hm_export_name(m));
        write_elements(&s, m, &mid);
        write_nodes(&s, m, &mid);
        write_strings(&s, &strings);
        err = hm_sink_finish(&s);
    }
    free(mid.edge);
    free(mid.mid);
    hm_strings_free(&strings);
    return err;
}
