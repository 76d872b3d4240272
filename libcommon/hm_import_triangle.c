/* Triangle: .node, nodes alone or with .ele or .poly behind them (cat river.node river.ele), and
 * .poly. The first attribute of a node is its height. Nodes of elements make a mesh; segments make
 * lines, one from where the last ended as long as they have one marker; what is left are points. */
#include "hm_attr.h"
#include "hm_headio.h"
#include "hm_import_private.h"
#include "hm_polyline.h"
#include "hm_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- lines of numbers --- */

/* Up to `most` numbers of a line, a comment behind them left off; -1 when there is anything else,
 * 0 of a blank line or a comment. */
static int numbers(const char *s, const char *end, double *v, int most)
{
    int n = 0;
    while (n < most && (s = hm_row_skip(s, end)) < end && *s != '#' && *s != '\r') {
        s = hm_num_parse(s, end, &v[n++]);
        if (!s || (s < end && !hm_row_is_blank(*s) && *s != '#' && *s != '\r'))
            return -1;
    }
    return n;
}

static bool is_whole(double v)
{
    return v >= 0 && v <= INT32_MAX && v == floor(v);
}

/* A number of fields that a header may tell of. */
static bool is_few(double v)
{
    return is_whole(v) && v <= HM_MAX_FIELDS - 4;
}

/* Numbers of the next line that has any; `most` at most. */
static int look_line(const char **s, const char *end, double *v, int most)
{
    while (*s < end) {
        const char *lf = memchr(*s, '\n', (size_t)(end - *s)), *stop = lf ? lf : end;
        int n = numbers(*s, stop, v, most);
        *s = lf ? lf + 1 : end;
        if (n != 0)
            return n;
    }
    return 0;
}

/* `count 2 attributes markers` and `1 x y …`, or `count 3 attributes` and `1 a b c …`: a table
 * would have to have consecutive numbers in its first column, and the same number of columns above.
 */
bool hm_import_is_triangle(const char *s, const char *end)
{
    double head[5], row[HM_MAX_FIELDS], next[2];
    int n = look_line(&s, end, head, 5);
    if (n < 3 || n > 4 || !is_whole(head[0]) || !is_few(head[2]))
        return false;
    bool nodes = n == 4 && head[1] == 2 && (head[3] == 0 || head[3] == 1);
    bool elems = n == 3 && (head[1] == 3 || head[1] == 6);
    if (!nodes && !elems)
        return false;
    int columns = nodes ? 3 + (int)head[2] + (int)head[3] : 1 + (int)head[1] + (int)head[2];
    n = look_line(&s, end, row, HM_MAX_FIELDS);
    if (nodes && head[0] == 0)
        return n == 1 || n == 2;
    if (n != columns || (row[0] != 0 && row[0] != 1))
        return false;
    return head[0] == 1 || (look_line(&s, end, next, 2) > 0 && next[0] == row[0] + 1);
}

struct reading {
    struct hm_input *in;
    struct hm_inputs *o;
    struct hm_diag *d;
    struct hm_points nodes; /* x y z, attributes behind the first, marker */
    struct hm_ids ids;
    bool *used; /* of each node: by a segment */
    double v[HM_MAX_FIELDS];
    int n;       /* numbers of the line last read */
    char *attrs; /* of the line that a comment has begun, or NULL */
};

static enum hm_err fail(struct reading *r, const char *text)
{
    return hm_input_fail(r->in, HM_EFORMAT, r->d, "%s", text);
}

/* `# > surface=main`, as hm_export_poly writes it: another line begins. */
static enum hm_err read_comment(struct reading *r, const char *s, const char *end)
{
    if (end - s < 3 || memcmp(s, "# >", 3))
        return HM_OK;
    s = hm_row_skip(s + 3, end);
    free(r->attrs);
    r->attrs = strndup(s, (size_t)(end - s));
    if (!r->attrs)
        return hm_fail_memory(r->d);
    return hm_row_is_text(s, end) && !hm_attr_check(r->attrs, NULL)
               ? HM_OK
               : fail(r, "a comment that begins a line (# >) without its attributes");
}

/* The next line with numbers; HM_END behind the last. */
static enum hm_err next_numbers(struct reading *r)
{
    const char *s, *end;
    enum hm_err err;
    while (!(err = hm_input_line(r->in, &s, &end, r->d))) {
        r->n = numbers(s, end, r->v, HM_MAX_FIELDS);
        if (r->n > 0)
            return HM_OK;
        if (r->n < 0)
            return hm_row_fail(r->in, s, end, 0, false, r->d);
        if ((err = read_comment(r, s, end)))
            return err;
    }
    return err;
}

/* One of the records that a header has announced: at least so many numbers. */
static enum hm_err next_record(struct reading *r, int least)
{
    enum hm_err err = next_numbers(r);
    if (err == HM_END)
        return hm_input_fail(r->in, HM_ETRUNC, r->d, "the file ends here, in the middle");
    if (!err && r->n < least)
        return hm_input_fail(r->in, HM_EFORMAT, r->d, "expected %d numbers, got %d", least, r->n);
    return err;
}

static enum hm_err count_of(struct reading *r, int32_t *count)
{
    *count = is_whole(r->v[0]) ? (int32_t)r->v[0] : -1;
    return *count < 0 ? fail(r, "expected a count") : HM_OK;
}

/* The node of the id that stands at place k. */
static enum hm_err find_node(struct reading *r, int k, int64_t *node)
{
    *node = is_whole(r->v[k]) ? hm_ids_find(&r->ids, (int32_t)r->v[k]) : -1;
    return *node < 0 ? fail(r, "a node that is not there") : HM_OK;
}

/* --- nodes --- */

/* Names for what stands behind the height. */
static enum hm_err name_fields(struct reading *r, int attributes, bool marker)
{
    enum hm_err err = hm_header_init(&r->nodes.header, HM_POINTS, r->d);
    for (int k = 2; k <= attributes && !err; k++) {
        char name[24];
        snprintf(name, sizeof name, "attribute%d", k);
        err = hm_header_add_field(&r->nodes.header, name, NULL, r->d);
    }
    if (marker && !err)
        err = hm_header_add_field(&r->nodes.header, "marker", NULL, r->d);
    r->nodes.stride = r->nodes.header.nfields;
    return err;
}

/* id x y, then z unless there are no attributes, and so on. */
static enum hm_err read_node(struct reading *r, bool height)
{
    double row[HM_MAX_FIELDS];
    struct hm_node node;
    row[0] = r->v[1];
    row[1] = r->v[2];
    row[2] = NAN;
    memcpy(row + (height ? 2 : 3), r->v + 3, (size_t)(r->n - 3) * sizeof *row);
    const char *why = hm_reader_make_node(&node, row, 0, 0);
    if (why || !is_whole(r->v[0]))
        return fail(r, why ? why : "the number of a node is not whole");
    enum hm_err err = hm_ids_add(&r->ids, (int32_t)r->v[0], r->d);
    return err ? err : hm_points_append(&r->nodes, row, r->d);
}

/* Behind the header `count 2 attributes markers`; a count of 0 means the nodes from before. */
static enum hm_err read_nodes(struct reading *r)
{
    int32_t count;
    int attributes = (int)r->v[2];
    bool marker = r->v[3] == 1;
    enum hm_err err = count_of(r, &count);
    if (!err && r->nodes.n == 0 && count == 0)
        return fail(r, "no nodes: those of a .poly without are in the .node (cat FILE.node "
                       "FILE.poly)");
    if (err || count == 0)
        return err;
    if (r->nodes.n > 0)
        return fail(r, "nodes a second time");
    err = name_fields(r, attributes, marker);
    for (int32_t k = 0; k < count && !err; k++) {
        err = next_record(r, 3 + attributes + marker);
        r->n = 3 + attributes + marker;
        if (!err)
            err = read_node(r, attributes > 0);
    }
    if (!err)
        err = hm_ids_sort(&r->ids, r->in->name, r->d);
    r->used = err ? NULL : hm_alloc0(r->nodes.n, sizeof *r->used);
    return err || r->used ? err : hm_fail_memory(r->d);
}

/* --- elements --- */

static enum hm_err read_elements(struct reading *r)
{
    int32_t count;
    int attributes = (int)r->v[2];
    struct hm_mesh *m = hm_inputs_add_mesh(r->o);
    if (r->v[1] != 3)
        return fail(r, "elements with mid-side nodes are not read");
    enum hm_err err = count_of(r, &count);
    if (!err)
        err = m ? hm_header_init(&m->header, HM_MESH, r->d) : hm_fail_memory(r->d);
    for (size_t k = 0; k < r->nodes.n && !err; k++)
        err = hm_import_node(r->in, m, r->nodes.v + k * r->nodes.stride, r->d);
    for (int32_t k = 0; k < count && !err; k++) {
        int64_t node[3];
        err = next_record(r, 4 + attributes);
        for (int i = 0; i < 3 && !err; i++)
            err = find_node(r, 1 + i, &node[i]);
        double region = attributes > 0 ? r->v[4] : 0;
        if (!err && !is_whole(region))
            err = fail(r, "the attribute of an element, its region, is not a whole number");
        if (!err)
            err = hm_import_elem(r->in, m, node, 3, (int64_t)region, r->d);
    }
    return err;
}

/* --- segments --- */

static enum hm_err add_vertex(struct reading *r, struct hm_line *line, size_t *cap, int64_t node)
{
    if (!hm_grow(&line->xyz, cap, 3 * (line->n + 1), sizeof *line->xyz))
        return hm_fail_memory(r->d);
    memcpy(line->xyz + 3 * line->n++, r->nodes.v + (size_t)node * r->nodes.stride,
           3 * sizeof(double));
    r->used[node] = true;
    return HM_OK;
}

/* The line is whole: closed when it has come back. */
static enum hm_err add_line(struct reading *r, struct hm_line *line)
{
    enum hm_err err = HM_OK;
    if (line->n == 0)
        return HM_OK;
    const double *last = line->xyz + 3 * (line->n - 1);
    line->closed = line->n > 3 && line->xyz[0] == last[0] && line->xyz[1] == last[1];
    line->n -= line->closed;
    if (line->n > 0)
        err = hm_lines_append(r->o->lines, line, r->d);
    line->n = 0;
    return err;
}

/* Attributes of the line that begins: those of a comment, or the marker of its segments. */
static enum hm_err begin_line(struct reading *r, struct hm_line *line, double marker)
{
    char text[HM_NUM_CHARS] = "";
    enum hm_err err = add_line(r, line);
    free(line->attrs);
    text[hm_num_print(text, marker)] = '\0';
    line->attrs = r->attrs ? r->attrs : hm_attr_set("", "marker", marker != 0 ? text : NULL);
    r->attrs = NULL;
    return err || line->attrs ? err : hm_fail_memory(r->d);
}

/* `id a b [marker]`, behind the header `count markers`. */
static enum hm_err read_segments(struct reading *r, struct hm_line *line)
{
    int32_t count;
    bool markers = r->n > 1 && r->v[1] == 1;
    enum hm_err err = count_of(r, &count);
    size_t cap = 0;
    int64_t node[2], last = -1;
    double marker = 0;
    for (int32_t k = 0; k < count && !err; k++) {
        err = next_record(r, 3 + markers);
        for (int i = 0; i < 2 && !err; i++)
            err = find_node(r, 1 + i, &node[i]);
        if (err)
            break;
        if (node[0] != last || r->attrs || (markers && r->v[3] != marker)) {
            marker = markers ? r->v[3] : 0;
            err = begin_line(r, line, marker);
            if (!err)
                err = add_vertex(r, line, &cap, node[0]);
        }
        if (!err)
            err = add_vertex(r, line, &cap, node[1]);
        last = node[1];
    }
    return err ? err : add_line(r, line);
}

/* --- holes and regions --- */

/* The smallest closed line around a place; NULL when there is none. */
static struct hm_line *line_around(const struct hm_lines *l, double x, double y)
{
    struct hm_line *found = NULL;
    for (size_t k = 0; k < l->n; k++)
        if (l->line[k].closed && hm_polygon_side(&l->line[k], x, y) > 0 &&
            (!found || fabs(hm_polygon_area2(&l->line[k])) < fabs(hm_polygon_area2(found))))
            found = &l->line[k];
    return found;
}

/* An attribute more, unless the line has one of that key. */
static enum hm_err say(struct reading *r, struct hm_line *line, const char *key, double v)
{
    char text[HM_NUM_CHARS + 1], had[2];
    if (hm_attr_get(line->attrs, key, had, sizeof had))
        return HM_OK;
    text[hm_num_print(text, v)] = '\0';
    char *attrs = hm_attr_set(line->attrs, key, text);
    if (!attrs)
        return hm_fail_memory(r->d);
    free(line->attrs);
    line->attrs = attrs;
    return HM_OK;
}

/* `id x y` of a hole, `id x y attribute [area]` of a region. Where no closed line is around it, it
 * is passed over. */
static enum hm_err read_places(struct reading *r, bool regions)
{
    int32_t count;
    enum hm_err err = count_of(r, &count);
    for (int32_t k = 0; k < count && !err; k++) {
        err = next_record(r, regions ? 4 : 3);
        struct hm_line *line = err ? NULL : line_around(r->o->lines, r->v[1], r->v[2]);
        if (!line)
            continue;
        if (!regions)
            err = say(r, line, "hole", 1);
        else if (is_whole(r->v[3]))
            err = say(r, line, "region", r->v[3]);
        if (!err && regions && r->n > 4 && r->v[4] > 0)
            err = say(r, line, "max_area", r->v[4]);
    }
    return err;
}

/* Segments, holes, and regions if there are any. HM_END at the end of the file. */
static enum hm_err read_poly(struct reading *r)
{
    struct hm_line line = {0};
    struct hm_lines *l = hm_inputs_add_lines(r->o);
    enum hm_err err = l ? hm_header_init(&l->header, HM_LINES, r->d) : hm_fail_memory(r->d);
    if (!err)
        err = read_segments(r, &line);
    free(line.attrs);
    free(line.xyz);
    if (!err)
        err = next_record(r, 1);
    if (!err)
        err = read_places(r, false);
    if (!err)
        err = next_numbers(r);
    if (err || r->n > 1)
        return err;
    err = read_places(r, true);
    return err ? err : next_numbers(r);
}

/* --- the file --- */

/* What its header says. HM_END behind the last. */
static enum hm_err read_section(struct reading *r)
{
    bool nodes = r->n == 4 && r->v[1] == 2 && is_few(r->v[2]);
    bool elems = r->n == 3 && (r->v[1] == 3 || r->v[1] == 6) && is_few(r->v[2]);
    enum hm_err err;
    if (r->nodes.n == 0 && !nodes)
        return fail(r, "elements without nodes: those are in the .node (cat FILE.node FILE.ele)");
    if (r->n <= 2 && !r->o->lines)
        return read_poly(r);
    if (elems && !r->o->mesh)
        err = read_elements(r);
    else if (nodes)
        err = read_nodes(r);
    else
        err = fail(r, "neither nodes, elements nor segments of Triangle");
    return err ? err : next_numbers(r);
}

/* Lines only when there are segments; nodes of none are points, when there is no mesh. */
static enum hm_err finish(struct reading *r)
{
    size_t n = 0, stride = r->nodes.stride;
    if (r->o->lines && r->o->lines->n == 0) {
        hm_lines_free(r->o->lines);
        r->o->nlines = 0;
    }
    if (r->o->mesh)
        return HM_OK;
    for (size_t k = 0; k < r->nodes.n; k++)
        if (!r->used[k])
            memmove(r->nodes.v + n++ * stride, r->nodes.v + k * stride, stride * sizeof(double));
    r->nodes.n = n;
    struct hm_points *p = n > 0 ? hm_inputs_add_points(r->o) : NULL;
    if (n > 0 && !p)
        return hm_fail_memory(r->d);
    if (p) {
        *p = r->nodes;
        r->nodes = (struct hm_points){0};
    }
    return HM_OK;
}

enum hm_err hm_import_triangle(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d)
{
    struct reading *r = hm_alloc0(1, sizeof *r);
    if (!r)
        return hm_fail_memory(d);
    *r = (struct reading){.in = in, .o = o, .d = d};
    enum hm_err err = next_numbers(r);
    while (!err)
        err = read_section(r);
    if (err == HM_END)
        err = finish(r);
    hm_points_free(&r->nodes);
    hm_ids_free(&r->ids);
    free(r->used);
    free(r->attrs);
    free(r);
    return err;
}
