/* Triangle: .node, .ele and .poly. Numbers count from 1. */
#include "hm_attr.h"
#include "hm_export_private.h"
#include "hm_num.h"
#include "hm_places.h"
#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- .node and .ele --- */

/* id, then the numbers of a row. */
static void put_node(struct hm_sink *s, int64_t id, const double *row, size_t n)
{
    hm_sink_integer(s, id);
    for (size_t k = 0; k < n; k++) {
        hm_sink_text(s, " ");
        hm_sink_number(s, row[k], 0);
    }
}

static enum hm_err put_mesh_nodes(struct hm_sink *s, const struct hm_mesh *m)
{
    struct hm_export_border b;
    enum hm_err err = hm_export_border_build(&b, m, s->d);
    if (err)
        return err;
    hm_sink_format(s, "%zu 2 1 1\n", m->nnodes);
    for (size_t k = 0; k < m->nnodes; k++) {
        const struct hm_node *node = &m->node[k];
        put_node(s, (int64_t)k + 1, (double[]){node->x, node->y, node->z}, 3);
        hm_sink_text(s, b.place[k] < 0 ? " 0\n" : " 1\n");
    }
    hm_export_border_free(&b);
    return HM_OK;
}

/* A file has one number of columns: that of the widest; what others lack is nan. */
static void put_points(struct hm_sink *s, const struct hm_inputs *in)
{
    size_t n = 0, stride = 3;
    int64_t id = 0;
    for (size_t i = 0; i < in->npoints; i++) {
        n += in->points[i].n;
        stride = in->points[i].stride > stride ? in->points[i].stride : stride;
    }
    hm_sink_format(s, "%zu 2 %zu 0\n", n, stride - 2);
    for (size_t i = 0; i < in->npoints; i++) {
        const struct hm_points *p = &in->points[i];
        for (size_t k = 0; k < p->n; k++) {
            put_node(s, ++id, p->v + k * p->stride, p->stride);
            for (size_t c = p->stride; c < stride; c++)
                hm_sink_text(s, " nan");
            hm_sink_text(s, "\n");
        }
    }
}

enum hm_err hm_export_node(const struct hm_inputs *in, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    enum hm_err err = HM_OK;
    if (in->nmeshes > 0)
        err = put_mesh_nodes(&s, &in->mesh[0]);
    else
        put_points(&s, in);
    return err ? err : hm_sink_finish(&s);
}

enum hm_err hm_export_ele(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_format(&s, "%zu 3 1\n", m->nelems);
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_integer(&s, (int64_t)k + 1);
        hm_export_corners(&s, &m->elem[k], 1);
        hm_sink_format(&s, " %d\n", m->elem[k].region);
    }
    return hm_sink_finish(&s);
}

/* --- .poly --- */

struct poly {
    struct hm_sink s;
    const struct hm_line **line; /* those of all sets */
    size_t lines, line_cap;
    struct hm_places places; /* the node of a place, from 0 */
    double *xyz;             /* of the nodes */
    size_t n, cap;
    int64_t heights; /* vertices whose height is that of another */
};

static void fail_memory(struct poly *p)
{
    if (!p->s.err)
        p->s.err = hm_fail_memory(p->s.d);
}

/* Of several vertices at one place the first that has a height gives it. */
static void add_place(struct poly *p, const double *xyz)
{
    bool full = p->n == INT32_MAX - 1;
    int32_t node = full ? -1 : hm_places_put(&p->places, xyz[0], xyz[1], (int32_t)p->n);
    if (node < 0 || !hm_grow(&p->xyz, &p->cap, 3 * (p->n + 1), sizeof *p->xyz)) {
        fail_memory(p);
        return;
    }
    if ((size_t)node == p->n)
        memcpy(p->xyz + 3 * p->n++, xyz, 3 * sizeof *xyz);
    double *z = &p->xyz[3 * (size_t)node + 2];
    if (isnan(*z))
        *z = xyz[2];
    p->heights += !isnan(xyz[2]) && *z != xyz[2];
}

static void gather(struct poly *p, const struct hm_inputs *in)
{
    for (size_t i = 0; i < in->npoints && !p->s.err; i++)
        for (size_t k = 0; k < in->points[i].n && !p->s.err; k++)
            add_place(p, in->points[i].v + k * in->points[i].stride);
    for (size_t i = 0; i < in->nlines; i++)
        for (size_t k = 0; k < in->lines[i].n && !p->s.err; k++) {
            const struct hm_line *line = &in->lines[i].line[k];
            if (!hm_grow(&p->line, &p->line_cap, p->lines + 1, sizeof *p->line)) {
                fail_memory(p);
                return;
            }
            p->line[p->lines++] = line;
            for (size_t v = 0; v < line->n && !p->s.err; v++)
                add_place(p, line->xyz + 3 * v);
        }
}

static void put_nodes(struct poly *p)
{
    size_t heights = 0;
    for (size_t k = 0; k < p->n; k++)
        heights += isnan(p->xyz[3 * k + 2]) ? 0 : 1;
    hm_sink_format(&p->s, "%zu 2 %d 0\n", p->n, heights > 0);
    for (size_t k = 0; k < p->n; k++) {
        put_node(&p->s, (int64_t)k + 1, p->xyz + 3 * k, heights > 0 ? 3 : 2);
        hm_sink_text(&p->s, "\n");
    }
}

/* The nodes at both ends of a piece, from 1; false when they are one. */
static bool piece(const struct poly *p, const struct hm_line *line, size_t k, int32_t node[2])
{
    const double *a = hm_polyline_from(line, k), *b = hm_polyline_to(line, k);
    node[0] = hm_places_get(&p->places, a[0], a[1]) + 1;
    node[1] = hm_places_get(&p->places, b[0], b[1]) + 1;
    return node[0] != node[1];
}

/* The attributes of a line as a comment; that it is closed is seen from its segments. */
static void put_attrs(struct poly *p, const struct hm_line *line)
{
    char *attrs = hm_attr_set(line->attrs, "closed", NULL);
    if (!attrs) {
        fail_memory(p);
        return;
    }
    hm_sink_text(&p->s, *attrs ? "# > " : "# >");
    hm_sink_text(&p->s, attrs);
    hm_sink_text(&p->s, "\n");
    free(attrs);
}

static void put_segments(struct poly *p)
{
    size_t count = 0, number = 0;
    int32_t node[2];
    for (size_t i = 0; i < p->lines; i++)
        for (size_t k = 0; k < hm_polyline_pieces(p->line[i]); k++)
            count += piece(p, p->line[i], k, node);
    hm_sink_format(&p->s, "%zu 1\n", count);
    for (size_t i = 0; i < p->lines; i++) {
        put_attrs(p, p->line[i]);
        for (size_t k = 0; k < hm_polyline_pieces(p->line[i]); k++)
            if (piece(p, p->line[i], k, node))
                hm_sink_format(&p->s, "%zu %d %d %zu\n", ++number, node[0], node[1], i + 2);
    }
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A place inside a closed line: halfway between two of its vertices in y, in the middle of the
 * widest stretch inside; the next vertices are tried when that is too thin. False: none found. */
static bool place_inside(const struct hm_line *ring, double *x /* room for ring->n + 2 */,
                         double xy[2])
{
    for (size_t k = 0; k + 1 < ring->n; k++) {
        double y = ring->xyz[3 * k + 1] / 2 + ring->xyz[3 * k + 4] / 2;
        size_t n = 0;
        for (size_t i = 0; i < ring->n; i++) {
            const double *a = hm_polyline_from(ring, i), *b = hm_polyline_to(ring, i);
            if ((a[1] > y) != (b[1] > y))
                x[n++] = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        }
        qsort(x, n, sizeof *x, compare);
        size_t widest = 0;
        for (size_t i = 0; i + 1 < n; i += 2)
            if (x[i + 1] - x[i] > x[widest + 1] - x[widest])
                widest = i;
        xy[0] = n > 1 ? x[widest] / 2 + x[widest + 1] / 2 : 0;
        xy[1] = y;
        if (n > 1 && hm_polygon_side(ring, xy[0], y) > 0)
            return true;
    }
    return false;
}

/* The place of a hole or region (x, y, number, area), when the line makes one. */
static bool find_place(struct poly *p, const struct hm_line *line, bool regions, double v[4])
{
    struct hm_diag ignored = {0};
    bool hole = hm_attr_flag(line->attrs, "hole");
    if (!line->closed || hole == regions || hm_attr_get(line->attrs, "face", NULL, 0) ||
        (regions && !hm_attr_get(line->attrs, "region", NULL, 0)) ||
        hm_attr_number(line->attrs, "region", 0, &v[2], &ignored) ||
        hm_attr_number(line->attrs, "max_area", -1, &v[3], &ignored))
        return false;
    double *x = hm_alloc(line->n + 2, sizeof *x);
    bool found = x && place_inside(line, x, v);
    if (!x)
        fail_memory(p);
    free(x);
    return found;
}

static void put_places(struct poly *p, bool regions)
{
    double *v = hm_alloc(p->lines, 4 * sizeof *v);
    size_t n = 0;
    if (!v) {
        fail_memory(p);
        return;
    }
    for (size_t i = 0; i < p->lines; i++)
        n += find_place(p, p->line[i], regions, v + 4 * n);
    hm_sink_format(&p->s, "%zu\n", n);
    for (size_t k = 0; k < n; k++) {
        put_node(&p->s, (int64_t)k + 1, v + 4 * k, regions ? 4 : 2);
        hm_sink_text(&p->s, "\n");
    }
    free(v);
}

enum hm_err hm_export_poly(const struct hm_inputs *in, int64_t *heights, struct hm_writer *w,
                           struct hm_diag *d)
{
    struct poly p = {.s = hm_sink_to(w, d)};
    gather(&p, in);
    if (!p.s.err) {
        put_nodes(&p);
        put_segments(&p);
        put_places(&p, false);
        put_places(&p, true);
    }
    *heights = p.heights;
    hm_places_free(&p.places);
    free(p.line);
    free(p.xyz);
    return hm_sink_finish(&p.s);
}
