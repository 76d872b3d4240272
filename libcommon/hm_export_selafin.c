/* TELEMAC: Selafin geometry in double precision (SERAFIND), and the boundary conditions (.cli) that
 * go with it. */
#include "hm_export_private.h"

#include <stdlib.h>
#include <string.h>

/* A Fortran record has its length before and behind it. */
static void put_mark(struct hm_sink *s, size_t bytes)
{
    hm_sink_be32(s, (uint32_t)bytes);
}

static void put_integers(struct hm_sink *s, const int32_t *v, size_t n)
{
    put_mark(s, 4 * n);
    for (size_t i = 0; i < n; i++)
        hm_sink_be32(s, (uint32_t)v[i]);
    put_mark(s, 4 * n);
}

static void put_text(struct hm_sink *s, const char *text, size_t width, const char *behind)
{
    size_t n = strlen(text);
    hm_sink_bytes(s, text, n < width ? n : width);
    for (; n < width; n++)
        hm_sink_text(s, " ");
    hm_sink_text(s, behind);
}

static double coordinate(const struct hm_node *node, int k)
{
    return k == 0 ? node->x : k == 1 ? node->y : node->z;
}

static void put_column(struct hm_sink *s, const struct hm_mesh *m, int k)
{
    put_mark(s, 8 * m->nnodes);
    for (size_t i = 0; i < m->nnodes; i++)
        hm_sink_be_double(s, coordinate(&m->node[i], k));
    put_mark(s, 8 * m->nnodes);
}

static void put_connectivity(struct hm_sink *s, const struct hm_mesh *m)
{
    put_mark(s, 12 * m->nelems);
    for (size_t k = 0; k < m->nelems; k++)
        for (int i = 0; i < 3; i++)
            hm_sink_be32(s, (uint32_t)m->elem[k].node[i] + 1);
    put_mark(s, 12 * m->nelems);
}

/* Places of the boundary nodes in the order of TELEMAC, from 1; 0 inside. */
static void put_ranks(struct hm_sink *s, const struct hm_mesh *m, const struct hm_export_border *b)
{
    put_mark(s, 4 * m->nnodes);
    for (size_t i = 0; i < m->nnodes; i++)
        hm_sink_be32(s, (uint32_t)(b->place[i] + 1));
    put_mark(s, 4 * m->nnodes);
}

enum hm_err hm_export_slf(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_export_border b;
    if (m->nnodes > INT32_MAX / 8 || m->nelems > INT32_MAX / 12)
        return hm_fail(d, HM_EARG, "too many nodes or elements for a Selafin record");
    enum hm_err err = hm_export_border_build(&b, m, d);
    if (err)
        return err;
    struct hm_sink s = hm_sink_to(w, d);
    put_mark(&s, 80);
    put_text(&s, hm_export_name(m), 72, "SERAFIND");
    put_mark(&s, 80);
    put_integers(&s, (int32_t[]){1, 0}, 2);
    put_mark(&s, 32);
    put_text(&s, "BOTTOM", 16, "");
    put_text(&s, "M", 16, "");
    put_mark(&s, 32);
    put_integers(&s, (int32_t[]){1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 10);
    put_integers(&s, (int32_t[]){(int32_t)m->nelems, (int32_t)m->nnodes, 3, 1}, 4);
    put_connectivity(&s, m);
    put_ranks(&s, m, &b);
    put_column(&s, m, 0);
    put_column(&s, m, 1);
    put_mark(&s, 8);
    hm_sink_be_double(&s, 0); /* the one frame, at time 0 */
    put_mark(&s, 8);
    put_column(&s, m, 2);
    hm_export_border_free(&b);
    return hm_sink_finish(&s);
}

/* LIHBOR, LIUBOR, LIVBOR of a boundary node: a wall unless an edge beside it is part of a string.
 */
static const char *condition(const struct hm_export_border *b, size_t before, size_t place)
{
    int32_t string = b->string[place] >= 0 ? b->string[place] : b->string[before];
    switch (string < 0 ? HM_SIDE_WALL : hm_export_side_of(b->strings.string[string].name)) {
    case HM_SIDE_INFLOW:
        return "4 5 5";
    case HM_SIDE_OPEN:
        return "5 4 4";
    default:
        return "2 2 2";
    }
}

enum hm_err hm_export_cli(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_export_border b;
    enum hm_err err = hm_export_border_build(&b, m, d);
    if (err)
        return err;
    struct hm_sink s = hm_sink_to(w, d);
    for (size_t k = 0; k < b.loops.nloops; k++)
        for (size_t i = b.loops.start[k]; i < b.loops.start[k + 1]; i++) {
            size_t before = (i > b.loops.start[k] ? i : b.loops.start[k + 1]) - 1;
            int32_t string = b.string[i] >= 0 ? b.string[i] : b.string[before];
            hm_sink_format(&s, "%s 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0 %d %zu # ",
                           condition(&b, before, i), b.loops.node[i] + 1, i + 1);
            hm_sink_text(&s, string < 0 ? "wall" : b.strings.string[string].name);
            hm_sink_text(&s, "\n");
        }
    hm_export_border_free(&b);
    return hm_sink_finish(&s);
}
