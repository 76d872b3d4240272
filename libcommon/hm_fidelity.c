#include "hm_fidelity.h"

#include "hm_attr.h"
#include "hm_elem.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double COS_MOST = 0.96592582628906829; /* of 15 degrees */
static const double ON_LINE = 0.01;                 /* m: a node as near is on a line */

/* What the stations of a line share. */
struct course {
    const struct hm_mesh *mesh;
    const struct hm_walk *walk;
    const struct hm_fidelity_want *want;
    struct hm_fidelity_line *line, *all;
    int32_t *line_of; /* of each node: the last line, from 1, that it was found on */
    int32_t hint;
    struct hm_measured gap; /* the stretch that is open now; value NaN: none */
};

static const struct hm_measured NOWHERE = {NAN, NAN, NAN};

static struct hm_fidelity_line nothing(void)
{
    return (struct hm_fidelity_line){
        .aside = NOWHERE, .worst = NOWHERE, .gap = NOWHERE, .across = {0, NAN, NAN}};
}

/* --- one station --- */

/* The distance of p from the nearest edge within reach that runs along the direction `along` (of
 * length 1); NaN when there is none. Mesh units. */
static double edge_beside(const struct course *c, const double *p, const double *along,
                          double reach)
{
    double nearest = NAN;
    struct hm_boxquery q =
        hm_boxtree_find(hm_walk_boxes(c->walk), hm_box_grown(hm_box_of(p, p), reach));
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;) {
        double xy[4][2];
        int corners = hm_elem_xy(c->mesh, &c->mesh->elem[i], xy);
        for (int k = 0; k < corners; k++) {
            const double *a = xy[k], *b = xy[(k + 1) % corners];
            double dx = b[0] - a[0], dy = b[1] - a[1];
            if (fabs(dx * along[0] + dy * along[1]) < COS_MOST * hypot(dx, dy))
                continue;
            double distance = hm_plane_distance(p, a, b);
            if (distance <= reach && !(distance >= nearest))
                nearest = distance;
        }
    }
    return nearest;
}

static void keep_largest(struct hm_measured *m, double value, const double *p)
{
    if (isnan(m->value) || fabs(value) > fabs(m->value))
        *m = (struct hm_measured){value, p[0], p[1]};
}

static void close_gap(struct course *c)
{
    if (c->gap.value > 0) {
        double at[2] = {c->gap.x, c->gap.y};
        keep_largest(&c->line->gap, c->gap.value, at);
        keep_largest(&c->all->gap, c->gap.value, at);
    }
    c->gap = NOWHERE;
}

static void follow(struct course *c, const double *p, double length, double distance)
{
    struct hm_fidelity_line *to[2] = {c->line, c->all};
    if (isnan(distance)) {
        if (isnan(c->gap.value))
            c->gap = (struct hm_measured){0, p[0], p[1]};
        c->gap.value += length;
        return;
    }
    close_gap(c);
    for (int k = 0; k < 2; k++) {
        to[k]->followed += length;
        to[k]->lateral += length * distance;
        keep_largest(&to[k]->aside, distance, p);
    }
}

static void sound(struct course *c, const double *p, double length, double rise)
{
    struct hm_fidelity_line *to[2] = {c->line, c->all};
    for (int k = 0; k < 2 && isfinite(rise); k++) {
        to[k]->sounded += length;
        to[k]->rise += length * rise;
        to[k]->rise_size += length * fabs(rise);
        keep_largest(&to[k]->worst, rise, p);
    }
}

/* A station that stands for so many metres of line, 0 at a vertex. */
static void visit(struct course *c, const double *p, const double *along, double length)
{
    const struct hm_fidelity_want *w = c->want;
    c->line->length += length;
    c->all->length += length;
    int64_t e = hm_walk_element(c->walk, p[0], p[1], &c->hint);
    if (e < 0) {
        close_gap(c);
        return;
    }
    c->line->on_mesh += length;
    c->all->on_mesh += length;
    follow(c, p, length, edge_beside(c, p, along, w->tolerance / w->metres) * w->metres);
    double z = hm_elem_height(c->mesh, &c->mesh->elem[e], p[0], p[1]);
    sound(c, p, length, (z - p[2]) * w->z_metres);
}

/* --- lines --- */

/* Stations on one piece: beyond, a vertex is far from where it was meant, as 0 0 to 1e12 0. */
static const double most_stations = 1e7;

static enum hm_err visit_piece(struct course *c, const double *a, const double *b,
                               struct hm_diag *d)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    if (!(length > 0))
        return HM_OK;
    const double along[2] = {dx / length, dy / length};
    double metres = length * c->want->metres, n = ceil(metres / c->want->tolerance);
    if (!(n <= most_stations))
        return hm_fail_at(d, HM_EGEOM, a[0], a[1],
                          "a line runs %.3g m straight, too far for stations every %g m", metres,
                          c->want->tolerance);
    visit(c, a, along, 0);
    for (double k = 0; k < n; k++) {
        double t = (k + 0.5) / n;
        double p[3] = {a[0] + t * dx, a[1] + t * dy, a[2] + t * (b[2] - a[2])};
        visit(c, p, along, metres / n);
    }
    visit(c, b, along, 0);
    return HM_OK;
}

/* --- triangles on a line --- */

/* The nodes near a piece of the line are on it. */
static void mark_nodes(struct course *c, const double *a, const double *b, int32_t number)
{
    double reach = ON_LINE / c->want->metres;
    struct hm_boxquery q =
        hm_boxtree_find(hm_walk_boxes(c->walk), hm_box_grown(hm_box_of(a, b), reach));
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;) {
        const struct hm_elem *e = &c->mesh->elem[i];
        for (int k = 0; k < hm_elem_corners(e); k++)
            if (c->line_of[e->node[k]] != number &&
                hm_plane_distance(hm_mesh_xy(c->mesh, e->node[k]), a, b) <= reach)
                c->line_of[e->node[k]] = number;
    }
}

/* By the box of the whole line: each triangle once. */
static void count_across(struct course *c, const struct hm_line *line, int32_t number)
{
    struct hm_box box = hm_box_of(line->xyz, line->xyz);
    for (size_t i = 1; i < line->n; i++)
        hm_box_add(&box, line->xyz + 3 * i);
    int32_t first = -1;
    struct hm_boxquery q = hm_boxtree_find(hm_walk_boxes(c->walk), box);
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;) {
        const int32_t *n = c->mesh->elem[i].node;
        if (n[3] >= 0 || c->line_of[n[0]] != number || c->line_of[n[1]] != number ||
            c->line_of[n[2]] != number)
            continue;
        c->line->across.value++;
        if (first < 0 || i < first)
            first = i;
    }
    if (first < 0)
        return;
    double at[2];
    hm_elem_centre(c->mesh, &c->mesh->elem[first], at);
    c->line->across.x = at[0];
    c->line->across.y = at[1];
    if (c->all->across.value == 0)
        c->all->across = (struct hm_measured){0, at[0], at[1]};
    c->all->across.value += c->line->across.value;
}

/* Sums over a length become means. */
static void finish(struct hm_fidelity_line *l)
{
    l->lateral = l->followed > 0 ? l->lateral / l->followed : NAN;
    l->rise = l->sounded > 0 ? l->rise / l->sounded : NAN;
    l->rise_size = l->sounded > 0 ? l->rise_size / l->sounded : NAN;
}

static void name_line(struct hm_fidelity_line *l, const struct hm_line *line, size_t number)
{
    char limit[16];
    if (hm_attr_get(line->attrs, "name", l->name, sizeof l->name) && *l->name)
        return;
    bool limited = hm_attr_get(line->attrs, "limit", limit, sizeof limit);
    snprintf(l->name, sizeof l->name, limited ? "%zu (limit %s)" : "%zu", number, limit);
}

static enum hm_err take_line(struct hm_fidelity *f, size_t *cap, struct course *c,
                             const struct hm_line *line, struct hm_diag *d)
{
    if (!hm_grow(&f->line, cap, f->n + 1, sizeof *f->line))
        return hm_fail_memory(d);
    c->line = &f->line[f->n++];
    *c->line = nothing();
    name_line(c->line, line, f->n);
    for (size_t k = 0; k < hm_polyline_pieces(line); k++) {
        const double *a = hm_polyline_from(line, k), *b = hm_polyline_to(line, k);
        enum hm_err err = visit_piece(c, a, b, d);
        if (err)
            return err;
        mark_nodes(c, a, b, (int32_t)f->n);
    }
    close_gap(c);
    if (line->n > 2)
        count_across(c, line, (int32_t)f->n);
    finish(c->line);
    return HM_OK;
}

enum hm_err hm_fidelity_run(struct hm_fidelity *f, const struct hm_mesh *m,
                            const struct hm_walk *walk, const struct hm_lines *sets, size_t n,
                            const struct hm_fidelity_want *want, struct hm_diag *d)
{
    *f = (struct hm_fidelity){.tolerance = want->tolerance, .all = nothing()};
    struct course c = {.mesh = m, .walk = walk, .want = want, .all = &f->all, .gap = NOWHERE};
    size_t cap = 0;
    c.line_of = hm_alloc0(m->nnodes, sizeof *c.line_of);
    enum hm_err err = c.line_of ? HM_OK : hm_fail_memory(d);
    snprintf(f->all.name, sizeof f->all.name, "all");
    for (size_t i = 0; i < n && !err; i++)
        for (size_t k = 0; k < sets[i].n && !err; k++)
            if (hm_role_of(sets[i].line[k].attrs) == HM_ROLE_BREAKLINE)
                err = take_line(f, &cap, &c, &sets[i].line[k], d);
    finish(&f->all);
    free(c.line_of);
    if (err)
        hm_fidelity_free(f);
    return err;
}

void hm_fidelity_free(struct hm_fidelity *f)
{
    free(f->line);
    *f = (struct hm_fidelity){0};
}

double hm_fidelity_share(const struct hm_fidelity_line *line)
{
    return line->on_mesh > 0 ? 100 * line->followed / line->on_mesh : NAN;
}
