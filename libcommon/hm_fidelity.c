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

/* What the stations of a line share. */
struct course {
    const struct hm_mesh *mesh;
    const struct hm_walk *walk;
    const struct hm_fidelity_want *want;
    struct hm_fidelity_line *line, *all;
    int32_t hint;
    struct hm_measured gap; /* the stretch that is open now; value NaN: none */
};

static const struct hm_measured NOWHERE = {NAN, NAN, NAN};

static struct hm_fidelity_line nothing(void)
{
    return (struct hm_fidelity_line){.aside = NOWHERE, .worst = NOWHERE, .gap = NOWHERE};
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

static void visit_piece(struct course *c, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    if (!(length > 0))
        return;
    const double along[2] = {dx / length, dy / length};
    double metres = length * c->want->metres, n = ceil(metres / c->want->tolerance);
    visit(c, a, along, 0);
    for (double k = 0; k < n; k++) {
        double t = (k + 0.5) / n;
        double p[3] = {a[0] + t * dx, a[1] + t * dy, a[2] + t * (b[2] - a[2])};
        visit(c, p, along, metres / n);
    }
    visit(c, b, along, 0);
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
    for (size_t k = 0; k < hm_polyline_pieces(line); k++)
        visit_piece(c, hm_polyline_from(line, k), hm_polyline_to(line, k));
    close_gap(c);
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
    enum hm_err err = HM_OK;
    snprintf(f->all.name, sizeof f->all.name, "all");
    for (size_t i = 0; i < n && !err; i++)
        for (size_t k = 0; k < sets[i].n && !err; k++)
            if (hm_role_of(sets[i].line[k].attrs) == HM_ROLE_BREAKLINE)
                err = take_line(f, &cap, &c, &sets[i].line[k], d);
    finish(&f->all);
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
