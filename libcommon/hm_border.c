#include "hm_border.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <stdlib.h>

enum hm_err hm_border_build(struct hm_border *b, const struct hm_mesh *mesh, struct hm_diag *d)
{
    *b = (struct hm_border){.mesh = mesh};
    enum hm_err err = hm_mesh_boundary(mesh, &b->loops, d);
    if (err)
        return err;
    b->n = b->loops.start[b->loops.nloops];
    b->next = hm_alloc(b->n, sizeof *b->next);
    struct hm_box *box = hm_alloc(b->n, sizeof *box);
    if (!b->next || !box) {
        free(box);
        hm_border_free(b);
        return hm_fail_memory(d);
    }
    for (size_t k = 0; k < b->loops.nloops; k++)
        for (size_t i = b->loops.start[k]; i < b->loops.start[k + 1]; i++)
            b->next[i] = i + 1 < b->loops.start[k + 1] ? i + 1 : b->loops.start[k];
    for (size_t i = 0; i < b->n; i++) {
        box[i] = hm_box_of(hm_border_from(b, i), hm_border_to(b, i));
        b->longest = fmax(b->longest, hm_border_length(b, i));
    }
    err = hm_boxtree_build(&b->tree, box, b->n, d);
    free(box);
    if (err)
        hm_border_free(b);
    return err;
}

void hm_border_free(struct hm_border *b)
{
    hm_mesh_loops_free(&b->loops);
    free(b->next);
    hm_boxtree_free(b->tree);
    *b = (struct hm_border){0};
}

bool hm_border_is_near(const struct hm_border *b, const double *p, double factor, double length)
{
    double reach = factor * fmax(length, b->longest);
    struct hm_boxquery q = hm_boxtree_find(b->tree, hm_box_grown(hm_box_of(p, p), reach));
    for (int32_t k; (k = hm_boxtree_next(&q)) >= 0;) {
        size_t i = (size_t)k;
        double distance = hm_plane_distance(p, hm_border_from(b, i), hm_border_to(b, i));
        if (distance < factor * fmax(length, hm_border_length(b, i)))
            return true;
    }
    return false;
}

/* Where on an edge that the way from p to q meets, 0 .. 1: the place that is first, or last, on the
 * way. Exactly 0 or 1 at a node, also when edge and way run in one line. */
static double place_on(const double *from, const double *to, const double *p, const double *q,
                       bool last)
{
    const double *near = last ? q : p;
    if (hm_pred_orient(p, q, from) != 0 || hm_pred_orient(p, q, to) != 0)
        return hm_plane_meeting(from, to, p, q);
    double length = hypot(to[0] - from[0], to[1] - from[1]);
    double before = hypot(near[0] - from[0], near[1] - from[1]);
    double behind = hypot(near[0] - to[0], near[1] - to[1]);
    if (before < length && behind < length)
        return before / length;
    return before < behind ? 0 : 1;
}

bool hm_border_meeting(const struct hm_border *b, const double *p, const double *q, bool last,
                       size_t *edge, double *at)
{
    bool found = false;
    double best = 0;
    struct hm_boxquery query = hm_boxtree_find(b->tree, hm_box_of(p, q));
    for (int32_t k; (k = hm_boxtree_next(&query)) >= 0;) {
        size_t i = (size_t)k;
        const double *from = hm_border_from(b, i), *to = hm_border_to(b, i);
        if (!hm_plane_meet(p, q, from, to))
            continue;
        /* the part of the way, counted from the end that is wanted */
        double t = last ? hm_plane_meeting(q, p, from, to) : hm_plane_meeting(p, q, from, to);
        if (found && (t > best || (t == best && i > *edge)))
            continue;
        found = true;
        best = t;
        *edge = i;
        *at = place_on(from, to, p, q, last);
    }
    return found;
}
