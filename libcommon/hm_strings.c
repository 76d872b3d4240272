#include "hm_strings.h"

#include "hm_attr.h"
#include "hm_border.h"
#include "hm_num.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t";

enum { NAME = 128 };

/* --- strings in the header --- */

/* A string of this name, with room for n nodes. */
static enum hm_err add_string(struct hm_strings *s, const char *name, size_t length, size_t n,
                              struct hm_string **added, struct hm_diag *d)
{
    struct hm_string string = {strndup(name, length), hm_alloc(n, sizeof *string.node), 0};
    if (!string.name || !string.node || !hm_grow(&s->string, &s->cap, s->n + 1, sizeof string)) {
        free(string.name);
        free(string.node);
        return hm_fail_memory(d);
    }
    *added = &s->string[s->n++];
    **added = string;
    return HM_OK;
}

static enum hm_err read_string(struct hm_strings *s, const char *value, size_t nnodes,
                               struct hm_diag *d)
{
    size_t length = strcspn(value, blanks);
    const char *p = value + length, *end = value + strlen(value);
    struct hm_string *string;
    enum hm_err err = add_string(s, value, length, (size_t)(end - p) / 2 + 1, &string, d);
    while (!err && *(p += strspn(p, blanks))) {
        double node;
        p = hm_num_parse(p, end, &node);
        if (!p || !(node >= 0 && node < (double)nnodes) || node != floor(node) ||
            (*p && !strchr(blanks, *p)))
            return hm_fail(d, HM_EFORMAT, "string %s: expected numbers of nodes", string->name);
        string->node[string->n++] = (int32_t)node;
    }
    if (!err && string->n == 0)
        err = hm_fail(d, HM_EFORMAT, "string %s has no nodes", string->name);
    return err;
}

enum hm_err hm_strings_read(struct hm_strings *s, const struct hm_mesh *m, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < m->header.nkeys; i++)
        if (!strcmp(m->header.keys[i].name, "string"))
            err = read_string(s, m->header.keys[i].value, m->nnodes, d);
    return err;
}

enum hm_err hm_strings_write(const struct hm_strings *s, struct hm_header *h, struct hm_diag *d)
{
    enum hm_err err = hm_header_set(h, "string", NULL, d);
    for (size_t i = 0; !err && i < s->n; i++) {
        const struct hm_string *string = &s->string[i];
        size_t length = strlen(string->name) + 1;
        char *text = hm_alloc(length + 12 * string->n, 1), *end = text;
        if (!text)
            return hm_fail_memory(d);
        end += sprintf(end, "%s", string->name);
        for (size_t k = 0; k < string->n; k++)
            end += sprintf(end, " %d", string->node[k]);
        err = hm_header_add(h, "string", text, d);
        free(text);
    }
    return err;
}

static void free_string(struct hm_string *string)
{
    free(string->name);
    free(string->node);
}

void hm_strings_free(struct hm_strings *s)
{
    for (size_t i = 0; i < s->n; i++)
        free_string(&s->string[i]);
    free(s->string);
    *s = (struct hm_strings){0};
}

/* --- strings of a mesh that changes --- */

void hm_strings_renumber(struct hm_strings *s, size_t first, const int32_t *number)
{
    for (size_t i = first; i < s->n; i++)
        for (size_t k = 0; k < s->string[i].n; k++)
            s->string[i].node[k] = number[s->string[i].node[k]];
}

/* Does the string run along the boundary? next: of each node, the node behind it there, or -1. */
static bool is_whole(const struct hm_string *string, const int32_t *next)
{
    bool with = string->n > 1, against = string->n > 1;
    for (size_t k = 0; k < string->n; k++)
        if (string->node[k] < 0)
            return false;
    for (size_t k = 0; k + 1 < string->n; k++) {
        with = with && next[string->node[k]] == string->node[k + 1];
        against = against && next[string->node[k + 1]] == string->node[k];
    }
    return with || against;
}

enum hm_err hm_strings_drop_broken(struct hm_strings *s, const struct hm_mesh *m, int64_t *dropped,
                                   char **name, struct hm_diag *d)
{
    struct hm_border b;
    size_t kept = 0;
    *dropped = 0;
    *name = NULL;
    enum hm_err err = hm_border_build(&b, m, d);
    if (err)
        return err;
    int32_t *next = hm_alloc(m->nnodes, sizeof *next);
    if (!next)
        err = hm_fail_memory(d);
    for (size_t i = 0; !err && i < m->nnodes; i++)
        next[i] = -1;
    for (size_t i = 0; !err && i < b.n; i++)
        next[b.loops.node[i]] = b.loops.node[b.next[i]];
    for (size_t i = 0; !err && i < s->n; i++) {
        if (is_whole(&s->string[i], next)) {
            s->string[kept++] = s->string[i];
            continue;
        }
        if (++*dropped == 1) {
            *name = s->string[i].name;
            s->string[i].name = NULL;
        }
        free_string(&s->string[i]);
    }
    if (!err)
        s->n = kept;
    free(next);
    hm_border_free(&b);
    return err;
}

/* --- strings from lines --- */

/* A way along a loop of the boundary: `n` nodes from place `from` of the border on, forward or
 * back; and how far it is from the line, where. */
struct way {
    size_t loop, from, n;
    bool back;
    double far, at[2];
};

/* The k-th place of a way. */
static size_t place_of(const struct hm_border *b, const struct way *w, size_t k)
{
    size_t start = b->loops.start[w->loop], length = b->loops.start[w->loop + 1] - start;
    return start + (w->from - start + (w->back ? length - k % length : k)) % length;
}

static double distance_to_line(const struct hm_line *line, const double *p)
{
    double least = INFINITY;
    for (size_t k = 0; k < hm_polyline_pieces(line); k++)
        least =
            fmin(least, hm_plane_distance(p, hm_polyline_from(line, k), hm_polyline_to(line, k)));
    return least;
}

static double distance_to_way(const struct hm_border *b, const struct way *w, const double *p)
{
    double least = INFINITY;
    for (size_t k = 0; k + 1 < w->n; k++)
        least = fmin(least, hm_plane_distance(p, hm_border_from(b, place_of(b, w, k)),
                                              hm_border_from(b, place_of(b, w, k + 1))));
    return least;
}

static void note_distance(struct way *w, double far, const double *at)
{
    if (far > w->far) {
        w->far = far;
        memcpy(w->at, at, sizeof w->at);
    }
}

/* How far way and line are apart: nodes from the line, vertices from the way. Beyond `enough` it
 * does not matter how much. */
static void measure_way(const struct hm_border *b, const struct hm_line *line, double enough,
                        struct way *w)
{
    w->far = 0;
    for (size_t k = 0; k < w->n && w->far < enough; k++) {
        const double *p = hm_border_from(b, place_of(b, w, k));
        note_distance(w, distance_to_line(line, p), p);
    }
    for (size_t k = 0; w->n > 1 && k < line->n && w->far < enough; k++)
        note_distance(w, distance_to_way(b, w, line->xyz + 3 * k), line->xyz + 3 * k);
}

/* Place of the node of a loop nearest to p. */
static size_t nearest_place(const struct hm_border *b, size_t loop, const double *p)
{
    size_t best = b->loops.start[loop];
    double least = INFINITY;
    for (size_t i = b->loops.start[loop]; i < b->loops.start[loop + 1]; i++) {
        const double *q = hm_border_from(b, i);
        double apart = hypot(q[0] - p[0], q[1] - p[1]);
        if (apart < least) {
            least = apart;
            best = i;
        }
    }
    return best;
}

static struct way nearest_way(const struct hm_border *b, const struct hm_line *line)
{
    struct way best = {.far = INFINITY};
    for (size_t loop = 0; loop < b->loops.nloops; loop++) {
        size_t length = b->loops.start[loop + 1] - b->loops.start[loop];
        size_t from = nearest_place(b, loop, line->xyz);
        size_t to = nearest_place(b, loop, line->xyz + 3 * (line->n - 1));
        for (int back = 0; back < 2; back++) {
            struct way w = {.loop = loop, .from = from, .back = back};
            w.n = (length + (back ? from - to : to - from)) % length + 1;
            measure_way(b, line, best.far, &w);
            if (w.far < best.far)
                best = w;
        }
    }
    return best;
}

static double mean_edge(const struct hm_border *b)
{
    double sum = 0;
    for (size_t i = 0; i < b->n; i++)
        sum += hm_border_length(b, i);
    return sum / (double)b->n;
}

static enum hm_err check_line(const struct hm_line *line, const char *name, struct hm_diag *d)
{
    double x = line->n > 0 ? line->xyz[0] : 0, y = line->n > 0 ? line->xyz[1] : 0;
    if (!name[0] || strlen(name) + 1 == NAME || strpbrk(name, blanks))
        return hm_fail_at(d, HM_EFORMAT, x, y,
                          "the name of a string is one word of at most %d letters, not '%s'",
                          NAME - 2, name);
    if (line->closed)
        return hm_fail_at(d, HM_EGEOM, x, y, "the line string=%s is closed, and has no ends", name);
    if (!(hm_polyline_length(line) > 0))
        return hm_fail_at(d, HM_EGEOM, x, y, "the line string=%s is only one point", name);
    return HM_OK;
}

static enum hm_err check_way(const struct way *w, const struct hm_line *line, const char *name,
                             double tolerance, struct hm_diag *d)
{
    if (!(w->far <= tolerance))
        return hm_fail_at(d, HM_EGEOM, w->at[0], w->at[1],
                          "string=%s does not run along the boundary of the mesh: %.4g m apart, "
                          "more than %.4g (tolerance= of the line allows more)",
                          name, w->far, tolerance);
    size_t least = strncmp(name, "inflow", 6) ? 1 : 2;
    if (w->n <= least)
        return hm_fail_at(d, HM_EGEOM, line->xyz[0], line->xyz[1],
                          "string=%s is %zu %s of the boundary long, and needs %zu", name, w->n - 1,
                          w->n == 2 ? "edge" : "edges", least);
    return HM_OK;
}

/* Take away the strings of that name among the first `before`; returns how many are left of them.
 */
static size_t forget(struct hm_strings *s, size_t before, const char *name)
{
    size_t kept = 0, left = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (i < before && !strcmp(s->string[i].name, name)) {
            free_string(&s->string[i]);
            continue;
        }
        left += i < before;
        s->string[kept++] = s->string[i];
    }
    s->n = kept;
    return left;
}

static enum hm_err find_string(struct hm_strings *s, const struct hm_border *b,
                               const struct hm_line *line, size_t *before, struct hm_diag *d)
{
    char name[NAME];
    double tolerance;
    struct hm_string *string;
    hm_attr_get(line->attrs, "string", name, sizeof name);
    enum hm_err err = check_line(line, name, d);
    if (!err)
        err =
            hm_fail_place(d, hm_attr_number(line->attrs, "tolerance", mean_edge(b), &tolerance, d),
                          line->xyz[0], line->xyz[1]);
    if (err)
        return err;
    struct way way = nearest_way(b, line);
    err = check_way(&way, line, name, tolerance, d);
    if (err)
        return err;
    *before = forget(s, *before, name);
    err = add_string(s, name, strlen(name), way.n, &string, d);
    for (size_t k = 0; !err && k < way.n; k++)
        string->node[string->n++] = b->loops.node[place_of(b, &way, k)];
    return err;
}

enum hm_err hm_strings_find(struct hm_strings *s, const struct hm_mesh *m,
                            const struct hm_lines *sets, size_t n, size_t *before,
                            struct hm_diag *d)
{
    struct hm_border b;
    *before = s->n;
    enum hm_err err = hm_border_build(&b, m, d);
    if (err)
        return err;
    for (size_t i = 0; !err && i < n; i++)
        for (size_t k = 0; !err && k < sets[i].n; k++)
            if (hm_role_of(sets[i].line[k].attrs) == HM_ROLE_STRING)
                err = find_string(s, &b, &sets[i].line[k], before, d);
    hm_border_free(&b);
    return err;
}
