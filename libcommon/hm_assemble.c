/* hm_assemble: see hm_assemble.h. */
#include "hm_assemble.h"
#include "hm_assemble_private.h"
#include "hm_attr.h"
#include "hm_elem.h"
#include "hm_hull.h"
#include "hm_polyline.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MANY = 65536 }; /* measurements held at once where only corners of their hull matter */

static enum hm_err add_node(struct hm_build *b, const double *xyz, int32_t *number,
                            struct hm_diag *d)
{
    if (b->nnodes >= INT32_MAX / 6)
        return hm_fail(d, HM_ENOMEM, "more than %d points", INT32_MAX / 6);
    if (!hm_grow(&b->node, &b->node_cap, b->nnodes + 1, sizeof *b->node))
        return hm_fail_memory(d);
    *number = (int32_t)b->nnodes;
    b->node[b->nnodes++] = (struct hm_node){.x = xyz[0], .y = xyz[1], .z = xyz[2]};
    return HM_OK;
}

static enum hm_err add_segment(struct hm_build *b, int32_t from, int32_t to, int32_t marks,
                               struct hm_diag *d)
{
    if (!hm_grow(&b->segment, &b->segment_cap, b->nsegments + 1, sizeof *b->segment))
        return hm_fail_memory(d);
    b->segment[b->nsegments++] = (struct hm_tri_segment){from, to, marks};
    return HM_OK;
}

/* --- regular meshes --- */

/* A boundary edge, and the element that it bounds. */
static enum hm_err add_side(struct hm_build *b, int32_t from, int32_t to, double area,
                            struct hm_diag *d)
{
    if (!hm_grow(&b->beside, &b->beside_cap, b->nsegments + 1, sizeof *b->beside))
        return hm_fail_memory(d);
    b->beside[b->nsegments] = area;
    return add_segment(b, from, to, HM_EDGE_REGULAR, d);
}

static enum hm_err add_loop(struct hm_build *b, const struct hm_mesh *m, const int32_t *node,
                            const int32_t *elem, size_t n, struct hm_diag *d)
{
    int32_t first = (int32_t)b->nnodes, number;
    enum hm_err err = HM_OK;
    for (size_t j = 0; !err && j < n; j++) {
        const struct hm_node *from = &m->node[node[j]];
        err = add_node(b, &from->x, &number, d);
        if (err)
            return err;
        b->node[number].flags = from->flags;
        b->node[number].owner = from->owner;
        err = add_side(b, number, j + 1 < n ? number + 1 : first,
                       hm_elem_area(m, &m->elem[elem[j]]), d);
    }
    return err;
}

static enum hm_err add_regular(struct hm_build *b, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < b->in->nmeshes; k++) {
        const struct hm_mesh_loops *l = hm_fence_loops(b->fence, k);
        for (size_t i = 0; !err && i < l->nloops; i++)
            err = add_loop(b, &b->in->meshes[k], l->node + l->start[i], l->elem + l->start[i],
                           l->start[i + 1] - l->start[i], d);
    }
    return err;
}

/* --- outlines, holes, regions --- */

static const char *ring_name(enum hm_role role)
{
    return role == HM_ROLE_BOUNDARY ? "outline" : role == HM_ROLE_HOLE ? "hole" : "region";
}

/* A line that has to be a ring: closed, of three vertices at least, not meeting itself. */
static enum hm_err check_ring(struct hm_ring *r, struct hm_diag *d)
{
    struct hm_line *line = &r->line;
    const double *xyz = line->xyz, *last = xyz + 3 * (line->n - 1);
    if (line->n >= 4 && xyz[0] == last[0] && xyz[1] == last[1]) {
        line->n--;
        line->closed = true;
    }
    if (line->n < 3)
        return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1], "%s has only %zu %s", ring_name(r->role),
                          line->n, line->n == 1 ? "vertex" : "vertices");
    if (!line->closed)
        return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1], "%s is not a closed line (closed=1)",
                          ring_name(r->role));
    bool crosses;
    double xy[2], region;
    enum hm_err err = hm_polyline_crosses_itself(line, &crosses, xy, d);
    if (!err && crosses)
        return hm_fail_at(d, HM_EGEOM, xy[0], xy[1], "%s meets itself", ring_name(r->role));
    if (!err && r->role == HM_ROLE_REGION) {
        err = hm_attr_number(line->attrs, "region", 0, &region, d);
        if (!err)
            err = hm_attr_number(line->attrs, "max_area", 0, &r->zone.max_area, d);
        if (!err && !(region >= 0 && region < INT32_MAX && region == floor(region)))
            return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1],
                              "region=%g is not a material number (0, 1, 2 …)", region);
        if (!err && !(r->zone.max_area >= 0 && isfinite(r->zone.max_area)))
            return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1], "max_area=%g is not an area",
                              r->zone.max_area);
        if (!err)
            r->zone.material = (int32_t)region;
    }
    return err;
}

static enum hm_err add_ring_segments(struct hm_build *b, const struct hm_ring *r, struct hm_diag *d)
{
    struct hm_segment *s;
    size_t n;
    enum hm_err err = hm_fence_join(b->fence, &r->line, b->in->clearance, &s, &n, d);
    for (size_t k = 0; !err && k < n; k++) {
        int32_t from, to; /* a ring gives no heights */
        err = add_node(b, (double[3]){s[k].a[0], s[k].a[1], NAN}, &from, d);
        if (!err)
            err = add_node(b, (double[3]){s[k].b[0], s[k].b[1], NAN}, &to, d);
        if (!err)
            err = add_segment(b, from, to,
                              r->role == HM_ROLE_REGION ? HM_EDGE_REGION : HM_EDGE_BORDER, d);
    }
    free(s);
    return err;
}

/* Find the rings among the lines. */
static enum hm_err find_rings(struct hm_build *b, struct hm_diag *d)
{
    for (size_t k = 0; k < b->in->nlines; k++)
        for (size_t i = 0; i < b->in->lines[k].n; i++) {
            const struct hm_line *line = &b->in->lines[k].line[i];
            enum hm_role role = hm_role_of(line->attrs);
            if (line->n == 0 ||
                (role != HM_ROLE_BOUNDARY && role != HM_ROLE_HOLE && role != HM_ROLE_REGION))
                continue;
            if (!hm_grow(&b->ring, &b->ring_cap, b->nrings + 1, sizeof *b->ring))
                return hm_fail_memory(d);
            struct hm_ring *r = &b->ring[b->nrings++];
            *r = (struct hm_ring){.line = *line, .role = role};
            enum hm_err err = check_ring(r, d);
            if (err)
                return err;
        }
    return HM_OK;
}

static bool has_outline(const struct hm_build *b)
{
    for (size_t k = 0; k < b->nrings; k++)
        if (b->ring[k].role == HM_ROLE_BOUNDARY)
            return true;
    return false;
}

/* --- breaklines --- */

static enum hm_err add_breakline(struct hm_build *b, const struct hm_line *line, struct hm_diag *d)
{
    int32_t first = (int32_t)b->nnodes, number = first;
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < line->n; i++) {
        double xyz[3] = {line->xyz[3 * i], line->xyz[3 * i + 1], line->xyz[3 * i + 2]};
        if (b->in->line_z_terrain || !isfinite(xyz[2])) {
            xyz[2] = NAN;
            b->counts->line_heights++;
        }
        if (fabs(xyz[2]) > HM_TERRAIN_HIGHEST)
            return hm_fail_at(d, HM_EGEOM, xyz[0], xyz[1], "a breakline's height of %g m", xyz[2]);
        err = add_node(b, xyz, &number, d);
        if (!err && i > 0)
            err = add_segment(b, number - 1, number, HM_EDGE_BREAKLINE, d);
    }
    if (!err && line->closed && line->n > 2)
        err = add_segment(b, number, first, HM_EDGE_BREAKLINE, d);
    return err;
}

static enum hm_err add_breaklines(struct hm_build *b, struct hm_diag *d)
{
    struct hm_lines kept = {0};
    struct hm_assembly_counts *c = b->counts;
    enum hm_err err = HM_OK;
    b->first_breakline = b->nsegments;
    for (size_t k = 0; !err && k < b->in->nlines; k++)
        for (size_t i = 0; !err && i < b->in->lines[k].n; i++) {
            const struct hm_line *line = &b->in->lines[k].line[i];
            if (line->n < 2 || hm_role_of(line->attrs) != HM_ROLE_BREAKLINE)
                continue;
            double whole = hm_polyline_length(line), left = 0;
            size_t before = kept.n;
            err = hm_fence_cut(b->fence, line, b->in->clearance, &kept, d);
            for (size_t j = before; j < kept.n; j++)
                left += hm_polyline_length(&kept.line[j]);
            c->breaklines++;
            c->cut_lines += left < whole;
            c->length += whole;
            c->near_length += fmax(whole - left, 0);
        }
    for (size_t k = 0; !err && k < kept.n; k++)
        err = add_breakline(b, &kept.line[k], d);
    hm_lines_free(&kept);
    return err;
}

/* --- measurements, and their hull --- */

/* Of measurements that are to be no nodes only corners of their hull matter: drop the others. */
static enum hm_err keep_corners(struct hm_build *b, struct hm_diag *d)
{
    const size_t stride = sizeof *b->node / sizeof(double), n = b->nnodes - b->first_point;
    struct hm_node *from = b->node + b->first_point;
    size_t *hull, corners;
    enum hm_err err = hm_hull_build(&from->x, n, stride, &hull, &corners, NULL);
    if (err) /* all on a line, so far */
        return err == HM_EGEOM ? HM_OK : hm_fail_memory(d);
    struct hm_node *kept = hm_alloc(corners, sizeof *kept);
    for (size_t k = 0; kept && k < corners; k++)
        kept[k] = from[hull[k]];
    if (kept) {
        memcpy(from, kept, corners * sizeof *kept);
        b->nnodes = b->first_point + corners;
    }
    free(hull);
    free(kept);
    return kept ? HM_OK : hm_fail_memory(d);
}

/* Their heights come from the terrain: it knows what several at one place are worth together, and
 * whether a grid replaces them. */
static enum hm_err add_points(struct hm_build *b, struct hm_diag *d)
{
    b->first_point = b->nnodes;
    for (size_t k = 0; k < b->in->npoints; k++) {
        const struct hm_points *p = &b->in->points[k];
        for (size_t i = 0; i < p->n; i++) {
            const double *row = p->v + i * p->stride;
            if (!isfinite(row[2]))
                continue;
            if (b->in->nmeshes > 0 &&
                hm_fence_is_near(b->fence, row[0], row[1], b->in->clearance)) {
                b->counts->near_points++;
                continue;
            }
            int32_t number;
            enum hm_err err = add_node(b, (double[3]){row[0], row[1], NAN}, &number, d);
            if (!err && b->in->heights_only && (b->nnodes - b->first_point) % MANY == 0)
                err = keep_corners(b, d);
            if (err)
                return err;
        }
    }
    b->end_points = b->nnodes;
    return HM_OK;
}

/* Without an outline the convex hull of all that has a height is one. */
static enum hm_err add_hull(struct hm_build *b, struct hm_diag *d)
{
    const size_t stride = sizeof *b->node / sizeof(double);
    size_t *hull, n;
    b->first_hull = b->nsegments;
    if (has_outline(b))
        return HM_OK;
    if (b->nnodes == 0)
        return hm_fail(d, HM_EGEOM, "no measurement has a height, and no outline tells the ground");
    enum hm_err err = hm_hull_build(&b->node->x, b->nnodes, stride, &hull, &n, d);
    if (err)
        return err;
    b->hull = hm_alloc(n, 3 * sizeof *b->hull);
    if (!b->hull || !hm_grow(&b->ring, &b->ring_cap, b->nrings + 1, sizeof *b->ring))
        err = hm_fail_memory(d);
    for (size_t k = 0; !err && k < n; k++) {
        const struct hm_node *node = &b->node[hull[k]];
        memcpy(b->hull + 3 * k, (double[3]){node->x, node->y, NAN}, 3 * sizeof *b->hull);
        err = add_segment(b, (int32_t)hull[k], (int32_t)hull[(k + 1) % n], HM_EDGE_BORDER, d);
    }
    free(hull);
    if (!err)
        b->ring[b->nrings++] = (struct hm_ring){.line = {.xyz = b->hull, .n = n, .closed = true},
                                                .role = HM_ROLE_BOUNDARY};
    return err;
}

/* Measurements that give heights only are no nodes, but for corners of the hull. */
static enum hm_err drop_points(struct hm_build *b, struct hm_diag *d)
{
    size_t n = b->nsegments - b->first_hull, kept = b->first_point;
    struct hm_node *corner = hm_alloc(n, sizeof *corner);
    if (!corner)
        return hm_fail_memory(d);
    for (size_t k = 0; k < n; k++)
        corner[k] = b->node[b->segment[b->first_hull + k].a];
    for (size_t k = 0; k < n; k++) {
        struct hm_tri_segment *s = &b->segment[b->first_hull + k],
                              *last = &b->segment[b->first_hull + (k + n - 1) % n];
        if (s->a < (int32_t)b->first_point)
            continue;
        b->node[kept] = corner[k];
        s->a = last->b = (int32_t)kept++;
    }
    b->nnodes = b->end_points = kept;
    free(corner);
    return HM_OK;
}

static enum hm_err add_outlines(struct hm_build *b, struct hm_diag *d)
{
    enum hm_err err = find_rings(b, d);
    size_t given = b->nrings;
    if (!err)
        err = add_hull(b, d);
    if (!err && b->in->heights_only)
        err = drop_points(b, d);
    b->first_ring = b->nsegments;
    for (size_t k = 0; !err && k < given; k++)
        err = add_ring_segments(b, &b->ring[k], d);
    return err;
}

/* --- the first triangulation --- */

static enum hm_err constrain(struct hm_build *b, size_t from, size_t to, struct hm_tri_mends *mends,
                             struct hm_diag *d)
{
    return hm_tri_constrain(b->tri, b->segment + from, to - from, mends, d);
}

/* Each edge of a regular mesh's boundary must still be one edge, else nodes would hang on it. */
static enum hm_err check_regular(const struct hm_build *b, const char *why, struct hm_diag *d)
{
    for (size_t k = 0; k < b->first_breakline; k++) {
        const struct hm_tri_segment *s = &b->segment[k];
        if (hm_tri_edge_between(b->tri, s->a, s->b) != HM_TRI_NONE)
            continue;
        const double *from = hm_tri_xy(b->tri, s->a), *to = hm_tri_xy(b->tri, s->b);
        return hm_fail_at(d, HM_EGEOM, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2, "%s", why);
    }
    return HM_OK;
}

static enum hm_err triangulate(struct hm_build *b, struct hm_diag *d)
{
    const size_t stride = sizeof *b->node / sizeof(double);
    struct hm_tri_mends hull = {0}, mends = {.tell = b->in->mended, .who = b->in->who};
    enum hm_err err =
        hm_tri_build(&b->tri, b->nnodes ? &b->node->x : NULL, b->nnodes, stride, b->in->threads, d);
    if (err)
        return err;
    for (size_t k = 0; k < b->nsegments; k++) {
        struct hm_tri_segment *s = &b->segment[k];
        s->a = hm_tri_of_input(b->tri, (size_t)s->a);
        s->b = hm_tri_of_input(b->tri, (size_t)s->b);
    }
    err = constrain(b, 0, b->first_breakline, &hull, d);
    if (!err)
        err = check_regular(b,
                            b->in->nmeshes > 1 ? HM_FENCE_OVERLAP
                                               : "the boundary of the regular mesh crosses itself",
                            d);
    if (!err)
        err = constrain(b, b->first_hull, b->first_ring, &hull, d);
    if (!err)
        err = constrain(b, b->first_ring, b->nsegments, &mends, d);
    if (!err)
        err = constrain(b, b->first_breakline, b->first_hull, &mends, d);
    if (!err)
        err = check_regular(b,
                            "an outline, hole or region cuts into the edge of a regular mesh: "
                            "draw it through the mesh's corners or clear of it",
                            d);
    b->counts->crossings = mends.n[HM_TRI_CROSSING];
    b->counts->on_lines = mends.n[HM_TRI_ON_SEGMENT];
    b->counts->overlaps = mends.n[HM_TRI_OVERLAP];
    b->counts->zero_length = mends.n[HM_TRI_ZERO_LENGTH];
    for (size_t i = b->first_point; i < b->end_points; i++)
        if (hm_tri_input(b->tri, hm_tri_of_input(b->tri, i)) < (int64_t)b->first_point)
            b->counts->duplicates++;
    return err;
}

/* Measurements that are no nodes: one at least must lie where the mesh is. */
static enum hm_err check_measured(const struct hm_build *b, const struct hm_domain *dom,
                                  struct hm_diag *d)
{
    int32_t hint = 0;
    bool any = false;
    for (size_t k = 0; k < b->in->npoints; k++) {
        const struct hm_points *p = &b->in->points[k];
        for (size_t i = 0; i < p->n; i++) {
            const double *row = p->v + i * p->stride;
            int32_t tri = hm_tri_locate(dom->tri, row[0], row[1], &hint);
            any = any || isfinite(row[2]);
            if (isfinite(row[2]) && tri != HM_TRI_NONE && hm_domain_is_inside(dom, tri))
                return HM_OK;
        }
    }
    return any ? hm_build_fail_empty(b, d) : HM_OK;
}

/* Holes of which no part is inside an outline. */
static int64_t count_idle_holes(const struct hm_build *b)
{
    int64_t idle = 0;
    for (size_t k = 0; k < b->nrings; k++) {
        const struct hm_line *hole = &b->ring[k].line;
        if (b->ring[k].role != HM_ROLE_HOLE)
            continue;
        bool meets = false;
        for (size_t j = 0; j < b->nrings && !meets; j++) {
            const struct hm_line *outline = &b->ring[j].line;
            if (b->ring[j].role != HM_ROLE_BOUNDARY)
                continue;
            for (size_t i = 0; i < hole->n && !meets; i++)
                meets = hm_polygon_side(outline, hole->xyz[3 * i], hole->xyz[3 * i + 1]) > 0;
            for (size_t i = 0; i < outline->n && !meets; i++)
                meets = hm_polygon_side(hole, outline->xyz[3 * i], outline->xyz[3 * i + 1]) > 0;
        }
        idle += !meets;
    }
    return idle;
}

enum hm_err hm_assemble(const struct hm_assembly *in, struct hm_domain *dom,
                        struct hm_assembly_counts *counts, struct hm_diag *d)
{
    struct hm_build b = {.in = in, .counts = counts};
    *counts = (struct hm_assembly_counts){0};
    enum hm_err err = hm_fence_build(&b.fence, in->meshes, in->nmeshes, d);
    if (!err)
        err = add_regular(&b, d);
    if (!err)
        err = add_breaklines(&b, d);
    if (!err)
        err = add_points(&b, d);
    if (!err)
        err = add_outlines(&b, d);
    if (!err)
        err = triangulate(&b, d);
    if (!err)
        err = hm_build_judge(&b, d);
    if (!err)
        err = hm_build_domain(&b, dom, d);
    if (!err && in->heights_only)
        err = check_measured(&b, dom, d);
    counts->idle_holes = count_idle_holes(&b);
    hm_fence_free(b.fence);
    hm_tri_free(b.tri);
    free(b.ring);
    free(b.hull);
    free(b.node);
    free(b.segment);
    free(b.beside);
    return err;
}
