#include "hm_outline.h"

#include "hm_mouth.h"
#include "hm_plane.h"

#include <math.h>
#include <stdlib.h>

/* The outline hugs the higher border where it leaves that at a smaller slope than this. */
static const double hugging = 0.17;

/* Walking the lower mesh's old outline for the stretches along the gap. */
struct walk {
    const struct hm_sides *s;
    struct hm_stretches *stretches;
    int32_t *rest_next; /* of lower's nodes: the next one on the border of the rest, or -1 */
    bool open;          /* the last stretch is being added to */
    struct hm_diag *d;
};

static enum hm_err open_stretch(struct walk *w, int64_t from)
{
    struct hm_stretches *c = w->stretches;
    if (!hm_grow(&c->stretch, &c->stretch_cap, c->nstretches + 1, sizeof *c->stretch))
        return hm_fail_memory(w->d);
    c->stretch[c->nstretches++] = (struct hm_stretch){.first = c->nnodes, .from = from, .to = -1};
    w->open = true;
    return HM_OK;
}

static enum hm_err append(struct walk *w, int32_t node)
{
    struct hm_stretches *c = w->stretches;
    if (!hm_grow(&c->node, &c->node_cap, c->nnodes + 1, sizeof *c->node))
        return hm_fail_memory(w->d);
    c->node[c->nnodes++] = node;
    c->stretch[c->nstretches - 1].count++;
    return HM_OK;
}

/* The crossing of the outline's edge p–q with the higher border: the first or the last one. */
static enum hm_err add_crossing(struct walk *w, int32_t p, int32_t q, bool enter)
{
    struct hm_stretches *c = w->stretches;
    if (!hm_grow(&c->crossing, &c->crossing_cap, c->ncrossings + 1, sizeof *c->crossing))
        return hm_fail_memory(w->d);
    struct hm_crossing *x = &c->crossing[c->ncrossings];
    const double *from = hm_mesh_xy(w->s->lower, p), *to = hm_mesh_xy(w->s->lower, q);
    *x = (struct hm_crossing){.enter = enter};
    if (!hm_border_meeting(w->s->higher, from, to, !enter, &x->edge, &x->at))
        return hm_fail_at(w->d, HM_EGEOM, from[0], from[1], "the outline cannot be followed");
    c->ncrossings++;
    return HM_OK;
}

static bool inside(const struct walk *w, int32_t node)
{
    return hm_locate_element(w->s->in_higher, w->s->lower->node[node].x,
                             w->s->lower->node[node].y) >= 0;
}

/* Does edge i of the outline, whose ends are outside the higher mesh, pass through it? */
static bool passes(const struct walk *w, size_t i)
{
    size_t edge;
    double at;
    const struct hm_border *o = w->s->outline;
    return hm_border_meeting(w->s->higher, hm_border_from(o, i), hm_border_to(o, i), false, &edge,
                             &at);
}

static bool is_kept(const struct walk *w, size_t i)
{
    const struct hm_border *o = w->s->outline;
    return w->rest_next[o->loops.node[i]] == o->loops.node[o->next[i]];
}

/* One edge of the outline. The edge at which a loop is entered comes twice: at first only what
 * begins on it counts, at last only what ends. */
static enum hm_err walk_edge(struct walk *w, size_t i, bool first, bool last)
{
    enum hm_err err = HM_OK;
    int32_t p = w->s->outline->loops.node[i];
    int32_t q = w->s->outline->loops.node[w->s->outline->next[i]];
    if (is_kept(w, i)) {
        w->open = false;
        return HM_OK;
    }
    bool in_p = inside(w, p), in_q = inside(w, q);
    bool through = !in_p && !in_q && passes(w, i);
    if (!in_p && !w->open && !first && !last && !(err = open_stretch(w, -1)))
        err = append(w, p);
    if (!err && !in_p && (in_q || through) && w->open) {
        err = add_crossing(w, p, q, true);
        w->stretches->stretch[w->stretches->nstretches - 1].to =
            (int64_t)w->stretches->ncrossings - 1;
        w->open = false;
    }
    if (!err && !in_q && (in_p || through) && !last && !(err = add_crossing(w, p, q, false)))
        err = open_stretch(w, (int64_t)w->stretches->ncrossings - 1);
    if (!err && !in_q && !last)
        err = append(w, q);
    return err;
}

static enum hm_err walk_whole(struct walk *w, size_t begin, size_t end)
{
    enum hm_err err = open_stretch(w, -1);
    for (size_t i = begin; !err && i < end; i++)
        err = append(w, w->s->outline->loops.node[i]);
    w->stretches->stretch[w->stretches->nstretches - 1].closed = true;
    w->open = false;
    return err;
}

/* A loop is entered at an edge where no stretch can be open: one that is kept, or begins inside the
 * higher mesh, or passes through that. Without any such edge it is all stretch. */
static enum hm_err walk_loop(struct walk *w, size_t begin, size_t end)
{
    size_t start = begin;
    while (start < end && !is_kept(w, start) && !inside(w, w->s->outline->loops.node[start]) &&
           !passes(w, start))
        start++;
    if (start == end)
        return walk_whole(w, begin, end);
    enum hm_err err = HM_OK;
    size_t i = start;
    for (size_t step = 0; !err && step <= end - begin; step++) {
        err = walk_edge(w, i, step == 0, step == end - begin);
        i = w->s->outline->next[i];
    }
    return err;
}

static enum hm_err find_stretches(struct hm_stretches *c, const struct hm_sides *s,
                                  struct hm_diag *d)
{
    struct walk w = {.s = s, .stretches = c, .d = d};
    w.rest_next = hm_alloc(s->lower->nnodes, sizeof *w.rest_next);
    if (!w.rest_next)
        return hm_fail_memory(d);
    for (size_t i = 0; i < s->lower->nnodes; i++)
        w.rest_next[i] = -1;
    for (size_t i = 0; i < s->rest->n; i++)
        w.rest_next[s->rest->loops.node[i]] = s->rest->loops.node[s->rest->next[i]];
    enum hm_err err = HM_OK;
    const struct hm_mesh_loops *loops = &s->outline->loops;
    for (size_t k = 0; !err && k < loops->nloops; k++)
        err = walk_loop(&w, loops->start[k], loops->start[k + 1]);
    free(w.rest_next);
    return err;
}

static enum hm_err add_segment(struct hm_outline *o, int32_t a, int32_t b, struct hm_diag *d)
{
    if (!hm_grow(&o->segment, &o->cap, o->n + 1, sizeof *o->segment))
        return hm_fail_memory(d);
    o->segment[o->n++] = (struct hm_outline_segment){a, b};
    return HM_OK;
}

/* Is a stretch from crossing to crossing, with nothing that stays behind it, all so near to the
 * higher mesh that only needles could fill what it bounds? */
static bool is_grazing(const struct hm_stretches *c, const struct hm_stretch *stretch,
                       const struct hm_sides *s)
{
    bool grazing = stretch->from >= 0 && stretch->to >= 0;
    for (size_t i = 0; grazing && i < stretch->count; i++) {
        int32_t node = c->node[stretch->first + i];
        grazing = !s->kept[node] && hm_border_is_near(s->higher, hm_mesh_xy(s->lower, node),
                                                      HM_SIDES_CLEAR, s->size[node]);
    }
    return grazing;
}

/* The segments of one stretch, from the node where it leaves the higher mesh, if it does, to the
 * one where it ends there. A stretch that cannot be joined to the higher mesh is left out, and with
 * it the ground behind it, when nothing of the lower mesh stays that would then be cut off. */
static enum hm_err add_stretch(struct hm_outline *o, const struct hm_stretches *c,
                               const struct hm_stretch *stretch, const struct hm_sides *s,
                               struct hm_diag *d)
{
    size_t first = 0, last = stretch->count - 1;
    struct hm_diag failure = {0};
    enum hm_err err = HM_OK;
    if (is_grazing(c, stretch, s))
        return HM_OK;
    if (stretch->from >= 0)
        err = hm_mouth_attach(c, stretch, false, s, stretch->count, &first, &failure);
    if (!err && stretch->to >= 0)
        err = hm_mouth_attach(c, stretch, true, s, stretch->count - first, &last, &failure);
    if (err && s->rest->n == 0)
        return HM_OK;
    if (err && d && !d->err)
        *d = failure;
    const int32_t *node = c->node + stretch->first;
    if (!err && stretch->from >= 0)
        err = add_segment(o, c->crossing[stretch->from].attach, ~node[first], d);
    for (size_t i = first; !err && i < last; i++)
        err = add_segment(o, ~node[i], ~node[i + 1], d);
    if (!err && stretch->closed)
        err = add_segment(o, ~node[last], ~node[first], d);
    if (!err && stretch->to >= 0)
        err = add_segment(o, ~node[last], c->crossing[stretch->to].attach, d);
    return err;
}

/* Node k of a stretch, counted from one of its ends. */
static int32_t node_from(const struct hm_stretches *c, const struct hm_stretch *stretch,
                         bool at_end, size_t k)
{
    return c->node[stretch->first + (at_end ? stretch->count - 1 - k : k)];
}

/* Move a crossing to the place of the border nearest to p. */
static void move_crossing(const struct hm_border *b, struct hm_crossing *x, const double *p)
{
    double least = INFINITY;
    for (size_t i = 0; i < b->n; i++) {
        double apart = hm_plane_distance(p, hm_border_from(b, i), hm_border_to(b, i));
        if (apart >= least)
            continue;
        least = apart;
        x->edge = i;
        x->at = hm_plane_foot(p, hm_border_from(b, i), hm_border_to(b, i));
    }
}

static double border_distance(const struct hm_border *b, const double *p)
{
    struct hm_crossing nearest = {0};
    double foot[2];
    move_crossing(b, &nearest, p);
    hm_border_at(b, nearest.edge, nearest.at, foot);
    return hypot(p[0] - foot[0], p[1] - foot[1]);
}

/* Two meshes of one river, end to end, have the same banks, so that the lower outline hugs the
 * higher border before it really leaves it, at a corner. Of a stretch that begins (or ends) so, the
 * nodes that hug are left out, and the crossing is where the next one leaves. */
static void stop_hugging(struct hm_stretches *c, struct hm_stretch *stretch, bool at_end,
                         const struct hm_sides *s)
{
    int64_t number = at_end ? stretch->to : stretch->from;
    if (number < 0)
        return;
    struct hm_crossing *x = &c->crossing[number];
    double start[2];
    hm_border_at(s->higher, x->edge, x->at, start);
    size_t k = 0;
    for (size_t i = 0; i + 1 < stretch->count; i++) {
        int32_t node = node_from(c, stretch, at_end, i);
        const double *p = hm_mesh_xy(s->lower, node);
        double far = border_distance(s->higher, p);
        double way = hypot(p[0] - start[0], p[1] - start[1]);
        if (s->kept[node] || far > hugging * fmax(way, s->size[node]))
            break;
        if (far <= hugging * way)
            k = i + 1;
    }
    if (k == 0)
        return;
    move_crossing(s->higher, x, hm_mesh_xy(s->lower, node_from(c, stretch, at_end, k)));
    stretch->first += at_end ? 0 : k;
    stretch->count -= k;
}

enum hm_err hm_outline_make(struct hm_outline *o, const struct hm_sides *s, struct hm_diag *d)
{
    *o = (struct hm_outline){0};
    struct hm_stretches c = {0};
    enum hm_err err = find_stretches(&c, s, d);
    for (size_t i = 0; !err && i < c.nstretches; i++)
        if (!is_grazing(&c, &c.stretch[i], s))
            for (int at_end = 0; at_end < 2; at_end++)
                stop_hugging(&c, &c.stretch[i], at_end, s);
    if (!err)
        err = hm_mouth_find(&c, s->higher, &o->widened, d);
    for (size_t i = 0; !err && i < c.nstretches; i++)
        err = add_stretch(o, &c, &c.stretch[i], s, d);
    free(c.stretch);
    free(c.node);
    free(c.crossing);
    if (err)
        hm_outline_free(o);
    return err;
}

void hm_outline_free(struct hm_outline *o)
{
    free(o->segment);
    *o = (struct hm_outline){0};
}
