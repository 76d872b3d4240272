/* RMA-10S / Kalypso .2d: elements are the loops of the arcs beside them. Nodes at no end of an arc,
 * as those in the middle of the sides, are left out. */
#include "hm_import_private.h"
#include "hm_num.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST = 10, NUMBER = 10, PLACE = 20 }; /* columns */

bool hm_import_is_kalypso(const char *s, const char *end)
{
    const char *lf = memchr(s, '\n', (size_t)(end - s));
    return hm_import_begins(s, end, "FP") && end - s > 2 && (s[2] == ' ') &&
           (lf ? lf : end) - s >= 2 + FIRST + 3 * PLACE;
}

struct arc {
    int32_t node[2], elem[2]; /* ids; elem 0: outside */
};

struct reading {
    struct hm_input *in;
    struct hm_mesh *m;
    struct hm_ids node, elem;
    struct arc *arc;
    size_t arcs, arc_cap;
    int32_t *class; /* of each element */
    size_t class_cap;
};

/* The columns [from, from + width) of a line as a number. */
static bool cut(const char *s, const char *end, size_t from, size_t width, double *v)
{
    if ((size_t)(end - s) <= from)
        return false;
    const char *p = s + from, *stop = (size_t)(end - p) > width ? p + width : end;
    while (p < stop && *p == ' ')
        p++;
    while (stop > p && (stop[-1] == ' ' || stop[-1] == '\r'))
        stop--;
    return p < stop && hm_num_parse(p, stop, v) == stop;
}

static bool cut_id(const char *s, const char *end, int column, int32_t *id)
{
    double v;
    if (!cut(s, end, 2 + NUMBER * (size_t)column, NUMBER, &v) || !(v >= 0 && v <= INT32_MAX) ||
        v != (double)(int32_t)v)
        return false;
    *id = (int32_t)v;
    return true;
}

static enum hm_err bad(const struct reading *r, struct hm_diag *d, const char *what)
{
    return hm_input_fail(r->in, HM_EFORMAT, d, "expected the columns of %s", what);
}

static enum hm_err read_node(struct reading *r, const char *s, const char *end, struct hm_diag *d)
{
    int32_t id;
    double xyz[3];
    bool good = cut_id(s, end, 0, &id);
    for (size_t k = 0; k < 3 && good; k++)
        good = cut(s, end, 2 + FIRST + k * PLACE, PLACE, &xyz[k]);
    if (!good)
        return bad(r, d, "a node: FP id x y z");
    enum hm_err err = hm_ids_add(&r->node, id, d);
    return err ? err : hm_import_node(r->in, r->m, xyz, d);
}

static enum hm_err read_arc(struct reading *r, const char *s, const char *end, struct hm_diag *d)
{
    struct arc a;
    if (!cut_id(s, end, 1, &a.node[0]) || !cut_id(s, end, 2, &a.node[1]) ||
        !cut_id(s, end, 3, &a.elem[0]) || !cut_id(s, end, 4, &a.elem[1]))
        return bad(r, d, "an arc: AR id node node left right");
    if (a.elem[0] == a.elem[1])
        return hm_input_fail(r->in, HM_EFORMAT, d,
                             a.elem[0] ? "an element of one dimension is not read"
                                       : "an arc without an element");
    if (!hm_grow(&r->arc, &r->arc_cap, r->arcs + 1, sizeof a))
        return hm_fail_memory(d);
    r->arc[r->arcs++] = a;
    return HM_OK;
}

static enum hm_err read_elem(struct reading *r, const char *s, const char *end, struct hm_diag *d)
{
    int32_t id, class = 0;
    if (!cut_id(s, end, 0, &id) || id == 0)
        return bad(r, d, "an element: FE id class");
    cut_id(s, end, 1, &class);
    if (!hm_grow(&r->class, &r->class_cap, r->elem.n + 1, sizeof *r->class))
        return hm_fail_memory(d);
    r->class[r->elem.n] = class;
    return hm_ids_add(&r->elem, id, d);
}

static enum hm_err read_lines(struct reading *r, struct hm_diag *d)
{
    const char *s, *end;
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_input_line(r->in, &s, &end, d))) {
        if (hm_import_begins(s, end, "FP"))
            err = read_node(r, s, end, d);
        else if (hm_import_begins(s, end, "AR"))
            err = read_arc(r, s, end, d);
        else if (hm_import_begins(s, end, "FE"))
            err = read_elem(r, s, end, d);
    }
    if (err == HM_END)
        err = hm_ids_sort(&r->node, r->in->name, d);
    return err ? err : hm_ids_sort(&r->elem, r->in->name, d);
}

/* The sides of an element, each from one node to the next with the element on its left. */
struct sides {
    int64_t from[4], to[4];
    int n;
};

static enum hm_err add_side(const struct reading *r, struct sides *sides, const struct arc *a,
                            int side, struct hm_diag *d)
{
    int64_t e = a->elem[side] ? hm_ids_find(&r->elem, a->elem[side]) : -1;
    if (a->elem[side] == 0)
        return HM_OK;
    int64_t from = hm_ids_find(&r->node, a->node[side]);
    int64_t to = hm_ids_find(&r->node, a->node[1 - side]);
    if (e < 0 || from < 0 || to < 0)
        return hm_fail_line(d, HM_EFORMAT, r->in->name, 0,
                            "an arc has a node or an element that is not there");
    struct sides *own = &sides[e];
    if (own->n == 4)
        return hm_fail_line(d, HM_EFORMAT, r->in->name, 0, "element %d has more than four arcs",
                            a->elem[side]);
    own->from[own->n] = from;
    own->to[own->n++] = to;
    return HM_OK;
}

/* The corners in order, beginning with the first arc's; false when the arcs are no loop. */
static bool chain(const struct sides *s, int64_t corner[4])
{
    int64_t at = s->from[0];
    if (s->n < 3)
        return false;
    for (int k = 0; k < s->n; k++) {
        int i = 0;
        while (i < s->n && s->from[i] != at)
            i++;
        if (i == s->n)
            return false;
        corner[k] = at;
        at = s->to[i];
    }
    return at == s->from[0];
}

static enum hm_err make_elems(struct reading *r, struct hm_diag *d)
{
    struct sides *sides = hm_alloc0(r->elem.n, sizeof *sides);
    enum hm_err err = sides ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; i < r->arcs && !err; i++)
        for (int side = 0; side < 2 && !err; side++)
            err = add_side(r, sides, &r->arc[i], side, d);
    for (size_t e = 0; e < r->elem.n && !err; e++) {
        int64_t corner[4];
        if (chain(&sides[e], corner))
            err = hm_import_elem(r->in, r->m, corner, sides[e].n, r->class[e], d);
        else
            err = hm_fail_line(d, HM_EFORMAT, r->in->name, 0,
                               "the arcs of element %d do not go round it", r->elem.id[e]);
    }
    free(sides);
    return err;
}

/* Leave out the nodes that no element has. */
static enum hm_err drop_middles(struct hm_mesh *m, struct hm_diag *d)
{
    int32_t *number = hm_alloc0(m->nnodes, sizeof *number), n = 0;
    if (!number)
        return hm_fail_memory(d);
    for (size_t e = 0; e < m->nelems; e++)
        for (int i = 0; i < hm_elem_corners(&m->elem[e]); i++)
            number[m->elem[e].node[i]] = 1;
    for (size_t k = 0; k < m->nnodes; k++)
        if (number[k]) {
            m->node[n] = m->node[k];
            number[k] = n++;
        }
    m->nnodes = (size_t)n;
    for (size_t e = 0; e < m->nelems; e++)
        for (int i = 0; i < hm_elem_corners(&m->elem[e]); i++)
            m->elem[e].node[i] = number[m->elem[e].node[i]];
    free(number);
    return HM_OK;
}

enum hm_err hm_import_kalypso(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct reading r = {.in = in, .m = m};
    enum hm_err err = read_lines(&r, d);
    if (!err)
        err = make_elems(&r, d);
    if (!err)
        err = drop_middles(m, d);
    hm_ids_free(&r.node);
    hm_ids_free(&r.elem);
    free(r.arc);
    free(r.class);
    return err;
}
