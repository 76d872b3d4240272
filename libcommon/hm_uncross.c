#include "hm_uncross.h"

#include "hm_lineedit.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- where lines cross --- */

struct crossings {
    const struct hm_segment *self;
    void (*mark)(void *arg, const struct hm_segment *s);
    void *arg;
    size_t n;
};

static bool look_at(void *arg, const struct hm_segment *other)
{
    struct crossings *c = arg;
    const struct hm_segment *self = c->self;
    /* each pair once */
    if (other->line < self->line || (other->line == self->line && other->piece <= self->piece))
        return true;
    if (hm_plane_cross(self->a, self->b, other->a, other->b)) {
        c->mark(c->arg, self);
        c->mark(c->arg, other);
        c->n++;
    }
    return true;
}

static enum hm_err take_segments(const struct hm_lines *lines, struct hm_segment **segment,
                                 size_t *n, struct hm_diag *d)
{
    size_t count = 0;
    for (size_t l = 0; l < lines->n; l++)
        count += hm_polyline_pieces(&lines->line[l]);
    *n = 0;
    *segment = hm_alloc(count, sizeof **segment);
    if (!*segment || lines->n > INT32_MAX)
        return hm_fail_memory(d);
    for (size_t l = 0; l < lines->n; l++)
        for (size_t k = 0; k < hm_polyline_pieces(&lines->line[l]); k++) {
            struct hm_segment *s = &(*segment)[(*n)++];
            memcpy(s->a, hm_polyline_from(&lines->line[l], k), sizeof s->a);
            memcpy(s->b, hm_polyline_to(&lines->line[l], k), sizeof s->b);
            s->line = (int32_t)l;
            s->piece = (int32_t)k;
        }
    return HM_OK;
}

/* Call mark for both pieces of every pair that crosses; *n pairs. */
static enum hm_err find_crossings(const struct hm_lines *lines,
                                  void (*mark)(void *arg, const struct hm_segment *s), void *arg,
                                  size_t *n, struct hm_diag *d)
{
    struct hm_segment *segment;
    struct hm_segindex *x = NULL;
    size_t count;
    struct crossings c = {.mark = mark, .arg = arg};
    enum hm_err err = take_segments(lines, &segment, &count, d);
    if (!err)
        err = hm_segindex_build(&x, segment, count, d);
    for (size_t k = 0; k < count && !err; k++) {
        const double *a = segment[k].a, *b = segment[k].b;
        const double lo[2] = {fmin(a[0], b[0]), fmin(a[1], b[1])};
        const double hi[2] = {fmax(a[0], b[0]), fmax(a[1], b[1])};
        c.self = &segment[k];
        hm_segindex_box(x, lo, hi, look_at, &c);
    }
    *n = c.n;
    hm_segindex_free(x);
    free(segment);
    return err;
}

/* --- smoothing --- */

struct smoothing {
    struct hm_lines *lines;
    const struct hm_lines *before;
    size_t back; /* vertices put back in this round */
};

static enum hm_err copy_lines(struct hm_lines *to, const struct hm_lines *from, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t l = 0; l < from->n && !err; l++)
        err = hm_lines_append(to, &from->line[l], d);
    return err;
}

static void put_back(void *arg, const struct hm_segment *s)
{
    struct smoothing *m = arg;
    struct hm_line *line = &m->lines->line[s->line];
    const struct hm_line *before = &m->before->line[s->line];
    size_t end[2] = {(size_t)s->piece, (size_t)s->piece + 1 < line->n ? (size_t)s->piece + 1 : 0};
    for (int k = 0; k < 2; k++) {
        double *now = line->xyz + 3 * end[k];
        const double *was = before->xyz + 3 * end[k];
        m->back += now[0] != was[0] || now[1] != was[1];
        memcpy(now, was, 3 * sizeof *now);
    }
}

enum hm_err hm_uncross_smooth(struct hm_lines *lines, double most, size_t *kept, struct hm_diag *d)
{
    struct hm_lines before = {0};
    struct smoothing m = {lines, &before, 0};
    enum hm_err err = copy_lines(&before, lines, d);
    *kept = 0;
    for (size_t l = 0; l < lines->n && !err; l++)
        err = hm_lineedit_smooth(&lines->line[l], most, d);
    do {
        size_t crossings;
        m.back = 0;
        if (!err)
            err = find_crossings(lines, put_back, &m, &crossings, d);
        *kept += m.back;
    } while (m.back > 0 && !err);
    hm_lines_free(&before);
    return err;
}

/* --- resampling --- */

/* A line between its equal chords; chords that cross follow the line as it was. */
struct chords {
    double *node; /* the ends of the chords, x, y, z */
    size_t nodes, n;
    double length;   /* of the line as it was */
    bool *follows;   /* a chord */
    int32_t *origin; /* a piece of the new line: the chord that it is part of */
    size_t cap, origin_cap;
};

struct resampling {
    struct hm_lines before;
    struct chords *chords; /* a line */
    size_t changed;        /* chords that follow their line from this round on */
};

static enum hm_err add_vertex(struct hm_line *line, struct chords *c, const double *xyz,
                              size_t chord, struct hm_diag *d)
{
    if (!hm_grow(&line->xyz, &c->cap, 3 * (line->n + 1), sizeof *line->xyz) ||
        !hm_grow(&c->origin, &c->origin_cap, line->n + 1, sizeof *c->origin))
        return hm_fail_memory(d);
    c->origin[line->n] = (int32_t)chord;
    memcpy(line->xyz + 3 * line->n++, xyz, 3 * sizeof *xyz);
    return HM_OK;
}

/* The new line: the ends of the chords, and between those of a chord that follows the line the
 * vertices that it would pass by. */
static enum hm_err build(struct hm_line *line, const struct hm_line *was, struct chords *c,
                         struct hm_diag *d)
{
    const double near = 1e-9; /* of the length: no vertex so close before an end */
    enum hm_err err = HM_OK;
    size_t v = 1; /* the next vertex of the old line, */
    double at = hypot(was->xyz[3] - was->xyz[0], was->xyz[4] - was->xyz[1]); /* and its place */
    line->n = 0;
    for (size_t k = 0; k < c->n && !err; k++) {
        double end = c->length * ((double)(k + 1) / (double)c->n - near);
        err = add_vertex(line, c, c->node + 3 * k, k, d);
        for (; v < was->n && at < end && !err; v++) {
            if (c->follows[k])
                err = add_vertex(line, c, was->xyz + 3 * v, k, d);
            const double *a = was->xyz + 3 * v, *b = a + 3;
            at += v + 1 < was->n ? hypot(b[0] - a[0], b[1] - a[1]) : 0;
        }
    }
    if (!err && !was->closed)
        err = add_vertex(line, c, c->node + 3 * (c->nodes - 1), c->n - 1, d);
    return err;
}

static void follow(void *arg, const struct hm_segment *s)
{
    struct resampling *r = arg;
    struct chords *c = &r->chords[s->line];
    if (c->n == 0)
        return;
    bool *follows = &c->follows[c->origin[s->piece]];
    r->changed += !*follows;
    *follows = true;
}

static enum hm_err begin_chords(struct chords *c, const struct hm_line *line, double spacing,
                                struct hm_diag *d)
{
    c->length = hm_polyline_length(line);
    if (!(c->length > 0))
        return HM_OK;
    enum hm_err err = hm_polyline_resample(line, spacing, &c->node, &c->nodes, d);
    if (err)
        return err;
    c->n = line->closed ? c->nodes : c->nodes - 1;
    c->follows = hm_alloc0(c->n, sizeof *c->follows);
    return c->follows ? HM_OK : hm_fail_memory(d);
}

static enum hm_err resample(struct resampling *r, struct hm_lines *lines, double spacing,
                            size_t *kept, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t l = 0; l < lines->n && !err; l++) {
        r->chords[l].cap = 3 * lines->line[l].n;
        err = begin_chords(&r->chords[l], &lines->line[l], spacing, d);
    }
    do {
        size_t crossings;
        r->changed = 0;
        for (size_t l = 0; l < lines->n && !err; l++)
            if (r->chords[l].n > 0)
                err = build(&lines->line[l], &r->before.line[l], &r->chords[l], d);
        if (!err)
            err = find_crossings(lines, follow, r, &crossings, d);
        *kept += r->changed;
    } while (r->changed > 0 && !err);
    return err;
}

enum hm_err hm_uncross_resample(struct hm_lines *lines, double spacing, size_t *kept,
                                struct hm_diag *d)
{
    struct resampling r = {.chords = hm_alloc0(lines->n, sizeof *r.chords)};
    *kept = 0;
    enum hm_err err = r.chords ? copy_lines(&r.before, lines, d) : hm_fail_memory(d);
    if (!err)
        err = resample(&r, lines, spacing, kept, d);
    for (size_t l = 0; r.chords && l < lines->n; l++) {
        free(r.chords[l].node);
        free(r.chords[l].follows);
        free(r.chords[l].origin);
    }
    free(r.chords);
    hm_lines_free(&r.before);
    return err;
}
