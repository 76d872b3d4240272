#include "hm_release.h"

#include "hm_polyline.h"

#include <stdlib.h>

enum { STRETCH = 4 }; /* pieces */

/* Lines are bound that something open reaches, directly or over others that are bound. */
struct binding {
    struct hm_boxtree *tree;
    struct hm_box *box;    /* of every stretch, grown */
    int32_t *line;         /* its line */
    int32_t *first;        /* the first stretch of every line, and of what follows the last */
    bool *bound;           /* a line */
    int32_t *stack;        /* bound lines whose surroundings are still to be looked at */
    size_t stretches, top; /* numbers of boxes, and on the stack */
};

static void bind_what_meets(struct binding *b, struct hm_box box)
{
    struct hm_boxquery q = hm_boxtree_find(b->tree, box);
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;)
        if (!b->bound[b->line[i]]) {
            b->bound[b->line[i]] = true;
            b->stack[b->top++] = b->line[i];
        }
}

static void bind_lines(struct binding *b, const struct hm_box *open, size_t nopen, double reach)
{
    for (size_t k = 0; k < nopen; k++)
        bind_what_meets(b, hm_box_grown(open[k], reach));
    while (b->top > 0) {
        int32_t line = b->stack[--b->top];
        for (int32_t i = b->first[line]; i < b->first[line + 1]; i++)
            bind_what_meets(b, b->box[i]);
    }
}

static size_t count_stretches(const struct hm_line *line)
{
    return (hm_polyline_pieces(line) + STRETCH - 1) / STRETCH;
}

static void add_stretches(struct binding *b, const struct hm_line *line, int32_t number,
                          double reach)
{
    size_t pieces = hm_polyline_pieces(line);
    for (size_t k = 0; k < pieces; k += STRETCH) {
        struct hm_box box = hm_box_of(hm_polyline_from(line, k), hm_polyline_to(line, k));
        for (size_t i = k + 1; i < k + STRETCH && i < pieces; i++)
            hm_box_add(&box, hm_polyline_to(line, i));
        b->line[b->stretches] = number;
        b->box[b->stretches++] = hm_box_grown(box, reach);
    }
}

static enum hm_err prepare(struct binding *b, const struct hm_lines *held, double reach,
                           struct hm_diag *d)
{
    size_t count = 0;
    for (size_t k = 0; k < held->n; k++)
        count += count_stretches(&held->line[k]);
    b->box = hm_alloc(count, sizeof *b->box);
    b->line = hm_alloc(count, sizeof *b->line);
    b->first = hm_alloc(held->n + 1, sizeof *b->first);
    b->bound = hm_alloc0(held->n, sizeof *b->bound);
    b->stack = hm_alloc(held->n, sizeof *b->stack);
    if (!b->box || !b->line || !b->first || !b->bound || !b->stack || count > INT32_MAX)
        return hm_fail_memory(d);
    for (size_t k = 0; k < held->n; k++) {
        b->first[k] = (int32_t)b->stretches;
        add_stretches(b, &held->line[k], (int32_t)k, reach);
    }
    b->first[held->n] = (int32_t)b->stretches;
    return hm_boxtree_build(&b->tree, b->box, b->stretches, d);
}

/* Lines that are not bound go to `done`, of which the room is there. */
static void part(struct hm_lines *held, struct hm_lines *done, const bool *bound)
{
    size_t kept = 0;
    for (size_t k = 0; k < held->n; k++)
        if (bound[k])
            held->line[kept++] = held->line[k];
        else
            done->line[done->n++] = held->line[k];
    held->n = kept;
}

enum hm_err hm_release(struct hm_lines *held, struct hm_lines *done, const struct hm_box *open,
                       size_t nopen, double reach, struct hm_diag *d)
{
    struct binding b = {0};
    enum hm_err err = prepare(&b, held, reach, d);
    if (!err && !hm_grow(&done->line, &done->cap, done->n + held->n, sizeof *done->line))
        err = hm_fail_memory(d);
    if (!err) {
        bind_lines(&b, open, nopen, reach);
        part(held, done, b.bound);
    }
    hm_boxtree_free(b.tree);
    free(b.box);
    free(b.line);
    free(b.first);
    free(b.bound);
    free(b.stack);
    return err;
}
