#include "hm_chain.h"

#include <stdlib.h>

enum { NOTHING = -1 };

/* Vertices of all open lines are in one pool, each line a list in it, so that two lines are joined
 * in no time; free ones are a list as well. */
struct vertex {
    double xyz[3];
    int64_t next;
};

struct open_line {
    int64_t first, last;          /* vertices, or NOTHING */
    size_t n;                     /* number of vertices; of a free line 0 */
    struct hm_joint *begin, *end; /* where pieces may come; NULL once sealed */
    int64_t next_free;
};

struct hm_chain {
    struct vertex *vertex;
    size_t nvertices, vertex_cap;
    int64_t free_vertex;
    struct open_line *line;
    size_t nlines, line_cap;
    int64_t free_line;
    double *xyz; /* the line being handed out */
    size_t xyz_cap;
    enum hm_err (*take)(void *arg, const struct hm_line *line, struct hm_diag *d);
    void *arg;
};

enum hm_err hm_chain_new(struct hm_chain **c,
                         enum hm_err (*take)(void *arg, const struct hm_line *line,
                                             struct hm_diag *d),
                         void *arg, struct hm_diag *d)
{
    *c = hm_alloc0(1, sizeof **c);
    if (!*c)
        return hm_fail_memory(d);
    (*c)->free_vertex = (*c)->free_line = NOTHING;
    (*c)->take = take;
    (*c)->arg = arg;
    return HM_OK;
}

void hm_chain_free(struct hm_chain *c)
{
    if (!c)
        return;
    free(c->vertex);
    free(c->line);
    free(c->xyz);
    free(c);
}

static int64_t new_vertex(struct hm_chain *c, const double *xyz)
{
    int64_t v = c->free_vertex;
    if (v != NOTHING) {
        c->free_vertex = c->vertex[v].next;
    } else {
        if (!hm_grow(&c->vertex, &c->vertex_cap, c->nvertices + 1, sizeof *c->vertex))
            return NOTHING;
        v = (int64_t)c->nvertices++;
    }
    c->vertex[v] = (struct vertex){{xyz[0], xyz[1], xyz[2]}, NOTHING};
    return v;
}

static int64_t new_line(struct hm_chain *c, struct hm_joint *begin, struct hm_joint *end)
{
    int64_t l = c->free_line;
    if (l != NOTHING) {
        c->free_line = c->line[l].next_free;
    } else {
        if (!hm_grow(&c->line, &c->line_cap, c->nlines + 1, sizeof *c->line))
            return NOTHING;
        l = (int64_t)c->nlines++;
    }
    c->line[l] = (struct open_line){NOTHING, NOTHING, 0, begin, end, NOTHING};
    return l;
}

/* A new vertex, unless it is NULL, at the end of a line or at its beginning. */
static enum hm_err add_vertex(struct hm_chain *c, int64_t line, bool at_end, const double *xyz,
                              struct hm_diag *d)
{
    if (!xyz)
        return HM_OK;
    int64_t v = new_vertex(c, xyz);
    if (v == NOTHING)
        return hm_fail_memory(d);
    struct open_line *l = &c->line[line];
    if (l->n++ == 0) {
        l->first = l->last = v;
    } else if (at_end) {
        c->vertex[l->last].next = v;
        l->last = v;
    } else {
        c->vertex[v].next = l->first;
        l->first = v;
    }
    return HM_OK;
}

/* Hand a line out and free what it used. */
static enum hm_err finish(struct hm_chain *c, int64_t line, bool closed, struct hm_diag *d)
{
    struct open_line *l = &c->line[line];
    if (!hm_grow(&c->xyz, &c->xyz_cap, 3 * l->n, sizeof *c->xyz))
        return hm_fail_memory(d);
    double *to = c->xyz;
    for (int64_t v = l->first; v != NOTHING; v = c->vertex[v].next)
        for (int k = 0; k < 3; k++)
            *to++ = c->vertex[v].xyz[k];
    if (l->last != NOTHING) {
        c->vertex[l->last].next = c->free_vertex;
        c->free_vertex = l->first;
    }
    struct hm_line out = {.xyz = c->xyz, .n = l->n, .closed = closed};
    l->n = 0;
    l->next_free = c->free_line;
    c->free_line = line;
    return c->take(c->arg, &out, d);
}

/* Put line b, which begins where a ends, behind it. */
static void join(struct hm_chain *c, int64_t a, int64_t b)
{
    struct open_line *to = &c->line[a], *from = &c->line[b];
    if (to->last == NOTHING)
        to->first = from->first;
    else
        c->vertex[to->last].next = from->first;
    if (from->last != NOTHING)
        to->last = from->last;
    to->n += from->n;
    to->end = from->end;
    if (to->end)
        to->end->ending = a;
    from->n = 0;
    from->next_free = c->free_line;
    c->free_line = b;
}

/* The first piece of a new line. */
static enum hm_err begin_line(struct hm_chain *c, struct hm_joint *from, struct hm_joint *to,
                              const double *const vertex[3], struct hm_diag *d)
{
    int64_t line = new_line(c, from, to);
    if (line == NOTHING)
        return hm_fail_memory(d);
    from->beginning = line;
    to->ending = line;
    enum hm_err err = HM_OK;
    for (int k = 0; k < 3 && !err; k++)
        err = add_vertex(c, line, true, vertex[k], d);
    return err;
}

enum hm_err hm_chain_add(struct hm_chain *c, struct hm_joint *from, struct hm_joint *to,
                         const double *start, const double *middle, const double *end,
                         struct hm_diag *d)
{
    int64_t before = from->ending, behind = to->beginning;
    enum hm_err err;
    if (before == HM_JOINT_FREE && behind == HM_JOINT_FREE)
        return begin_line(c, from, to, (const double *const[]){start, middle, end}, d);
    if (before == HM_JOINT_FREE) {
        to->beginning = HM_JOINT_FREE;
        from->beginning = behind;
        c->line[behind].begin = from;
        err = add_vertex(c, behind, false, middle, d);
        return err ? err : add_vertex(c, behind, false, start, d);
    }
    from->ending = HM_JOINT_FREE;
    err = add_vertex(c, before, true, middle, d);
    if (err)
        return err;
    if (behind == HM_JOINT_FREE) {
        to->ending = before;
        c->line[before].end = to;
        return add_vertex(c, before, true, end, d);
    }
    to->beginning = HM_JOINT_FREE;
    if (before == behind)
        return finish(c, before, true, d);
    join(c, before, behind);
    const struct open_line *joined = &c->line[before];
    return joined->begin || joined->end ? HM_OK : finish(c, before, false, d);
}

/* Turn an open line round, and say so at its ends. */
static void turn(struct hm_chain *c, int64_t line)
{
    struct open_line *l = &c->line[line];
    int64_t before = NOTHING;
    for (int64_t v = l->first, next; v != NOTHING; v = next) {
        next = c->vertex[v].next;
        c->vertex[v].next = before;
        before = v;
    }
    int64_t first = l->first;
    l->first = l->last;
    l->last = first;
    struct hm_joint *begin = l->begin, *end = l->end;
    if (begin) {
        begin->beginning = HM_JOINT_FREE;
        begin->ending = line;
    }
    if (end) {
        end->ending = HM_JOINT_FREE;
        end->beginning = line;
    }
    l->begin = end;
    l->end = begin;
}

enum hm_err hm_chain_join(struct hm_chain *c, struct hm_joint *a, struct hm_joint *b,
                          const double *at_a, const double *at_b, struct hm_diag *d)
{
    bool against = a->beginning != HM_JOINT_FREE || b->ending != HM_JOINT_FREE;
    struct hm_joint *from = against ? b : a, *to = against ? a : b;
    if (from->beginning != HM_JOINT_FREE)
        turn(c, from->beginning);
    if (to->ending != HM_JOINT_FREE)
        turn(c, to->ending);
    return hm_chain_add(c, from, to, against ? at_b : at_a, NULL, against ? at_a : at_b, d);
}

enum hm_err hm_chain_seal(struct hm_chain *c, struct hm_joint *joint, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    int64_t ending = joint->ending, beginning = joint->beginning;
    hm_joint_clear(joint);
    if (ending != HM_JOINT_FREE) {
        c->line[ending].end = NULL;
        if (!c->line[ending].begin)
            err = finish(c, ending, false, d);
    }
    if (beginning != HM_JOINT_FREE && !err) {
        c->line[beginning].begin = NULL;
        if (!c->line[beginning].end)
            err = finish(c, beginning, false, d);
    }
    return err;
}

/* Boxes around the vertices from v on, each with the first vertex of the next. */
static enum hm_err add_boxes(const struct hm_chain *c, int64_t v, struct hm_box **box, size_t *n,
                             size_t *cap, struct hm_diag *d)
{
    enum { STRETCH = 4 };
    while (v != NOTHING) {
        if (!hm_grow(box, cap, *n + 1, sizeof **box))
            return hm_fail_memory(d);
        struct hm_box *b = &(*box)[(*n)++];
        *b = hm_box_of(c->vertex[v].xyz, c->vertex[v].xyz);
        for (int k = 0; k < STRETCH && v != NOTHING; k++) {
            v = c->vertex[v].next;
            if (v != NOTHING)
                hm_box_add(b, c->vertex[v].xyz);
        }
    }
    return HM_OK;
}

enum hm_err hm_chain_open(const struct hm_chain *c, struct hm_box **box, size_t *n, size_t *cap,
                          struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < c->nlines && !err; k++)
        if (c->line[k].n > 0)
            err = add_boxes(c, c->line[k].first, box, n, cap, d);
    return err;
}
