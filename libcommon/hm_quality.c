#include "hm_quality.h"

#include "hm_polyline.h"

#include <stdio.h>
#include <stdlib.h>

/* The boundary loops that run clockwise are the borders of holes. */
static enum hm_err find_holes(struct hm_quality *q, const struct hm_mesh_edge *edge, size_t nedges,
                              struct hm_diag *d)
{
    struct hm_mesh_loops loops;
    struct hm_lines holes = {0};
    enum hm_err err = hm_mesh_boundary_of(&q->mesh, edge, nedges, &loops, d);
    for (size_t k = 0; !err && k < loops.nloops; k++) {
        size_t n = loops.start[k + 1] - loops.start[k];
        struct hm_line ring = {.n = n, .closed = true, .xyz = hm_alloc0(n, 3 * sizeof(double))};
        if (!ring.xyz) {
            err = hm_fail_memory(d);
            break;
        }
        for (size_t i = 0; i < n; i++) {
            const struct hm_node *node = &q->mesh.node[loops.node[loops.start[k] + i]];
            ring.xyz[3 * i] = node->x;
            ring.xyz[3 * i + 1] = node->y;
        }
        if (hm_polygon_area2(&ring) < 0)
            err = hm_lines_append(&holes, &ring, d);
        free(ring.xyz);
    }
    if (!err && holes.n > 0)
        err = hm_rings_build(&q->holes, holes.line, holes.n, d);
    hm_lines_free(&holes);
    hm_mesh_loops_free(&loops);
    return err;
}

/* Do the elements lie side by side, as far as walks need it? */
static bool is_plane(const struct hm_meshcheck *c)
{
    return c->count[HM_FAULT_AREA] + c->count[HM_FAULT_CONCAVE] + c->count[HM_FAULT_EDGE] +
               c->count[HM_FAULT_OVERLAP] ==
           0;
}

enum hm_err hm_quality_examine(struct hm_quality *q, struct hm_diag *d)
{
    const struct hm_meshstat_want want = {q->metres, q->z_metres, q->waved ? q->depth : 0,
                                          q->velocity};
    struct hm_mesh_edge *edge;
    size_t nedges;
    enum hm_err err = hm_mesh_edges(&q->mesh, &edge, &nedges, d);
    if (err)
        return err;
    err = hm_meshcheck_run(&q->mesh, &q->check, d);
    if (!err)
        err = hm_meshstat_run(&q->shape, &q->mesh, edge, nedges, &want, d);
    if (!err)
        err = hm_walk_build(&q->walk, &q->mesh, edge, nedges, is_plane(&q->check), d);
    if (!err && !q->check.count[HM_FAULT_EDGE])
        err = find_holes(q, edge, nedges, d);
    free(edge);
    return err;
}

void hm_quality_free(struct hm_quality *q)
{
    hm_walk_free(q->walk);
    hm_mesh_free(&q->mesh);
    hm_survey_free(&q->survey);
    hm_meshstat_free(&q->shape);
    hm_fidelity_free(&q->lines);
    hm_rings_free(q->holes);
    *q = (struct hm_quality){0};
}

int64_t hm_quality_place(const struct hm_quality *q, double x, double y, int32_t *hint,
                         enum hm_survey_place *place)
{
    int64_t e = hm_walk_element(q->walk, x, y, hint);
    if (e >= 0)
        *place = hm_walk_on_border(q->walk, e, x, y) ? HM_SURVEY_BORDER : HM_SURVEY_ON;
    else
        *place =
            q->holes && hm_rings_find(q->holes, x, y) >= 0 ? HM_SURVEY_HOLE : HM_SURVEY_OUTSIDE;
    return e;
}

void hm_quality_stratum(const struct hm_quality *q, int64_t key, char *name, size_t size)
{
    if (q->strata == HM_STRATA_ZONE)
        hm_zones_name(q->zones, key, name, size);
    else
        snprintf(name, size, "%lld", (long long)key);
}
