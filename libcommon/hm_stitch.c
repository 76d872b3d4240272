#include "hm_stitch.h"

#include "hm_cut.h"
#include "hm_seam.h"

#include <math.h>
#include <stdlib.h>

/* Has the mesh an edge of its boundary, node for node, in common with what is there? */
static enum hm_err shares_edge(const struct hm_join *j, const struct hm_mesh *m, bool *shares,
                               struct hm_diag *d)
{
    struct hm_mesh_loops loops;
    enum hm_err err = hm_mesh_boundary(m, &loops, d);
    if (err)
        return err;
    *shares = false;
    for (size_t k = 0; k < loops.nloops; k++) {
        const struct hm_node *last = &m->node[loops.node[loops.start[k + 1] - 1]];
        bool before = hm_places_get(&j->places, last->x, last->y) >= 0;
        for (size_t i = loops.start[k]; i < loops.start[k + 1]; i++) {
            const struct hm_node *node = &m->node[loops.node[i]];
            bool here = hm_places_get(&j->places, node->x, node->y) >= 0;
            *shares |= here && before;
            before = here;
        }
    }
    hm_mesh_loops_free(&loops);
    return HM_OK;
}

/* Number of a node of the lower mesh that the gap uses: that of the element kept, or new. */
static enum hm_err gap_node(struct hm_join *j, const struct hm_mesh *lower, int32_t node,
                            const struct hm_terrain *terrain, int32_t *map, int64_t *reused,
                            struct hm_diag *d)
{
    if (map[node] >= 0)
        return HM_OK;
    struct hm_node n = lower->node[node];
    if (terrain && !(n.flags & HM_NODE_BOUNDARY)) {
        int32_t hint = 0;
        double z = hm_terrain_z(terrain, n.x, n.y, &hint);
        n.z = isfinite(z) ? z : n.z;
    }
    ++*reused;
    return hm_join_node(j, n, &map[node], d);
}

static enum hm_err add_gap(struct hm_join *j, const struct hm_seam *seam,
                           const struct hm_mesh *lower, const struct hm_terrain *terrain,
                           int32_t *map, int64_t *reused, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; !err && i < seam->n; i++) {
        const struct hm_seam_triangle *t = &seam->triangle[i];
        struct hm_elem e = {.node = {0, 0, 0, -1}, .region = t->region};
        for (int k = 0; !err && k < 3; k++) {
            if (t->node[k] < 0)
                err = gap_node(j, lower, ~t->node[k], terrain, map, reused, d);
            e.node[k] = t->node[k] < 0 ? map[~t->node[k]] : t->node[k];
        }
        if (!err)
            err = hm_mesh_add_elem(&j->mesh, e, d);
    }
    return err;
}

static enum hm_err sew(struct hm_join *j, const struct hm_mesh *lower, const struct hm_cut *cut,
                       const struct hm_seam *seam, const struct hm_terrain *terrain,
                       struct hm_stitched *s, struct hm_diag *d)
{
    int32_t *map = hm_alloc(lower->nnodes, sizeof *map);
    if (!map)
        return hm_fail_memory(d);
    size_t before = j->mesh.nelems;
    enum hm_err err = hm_join_mesh(j, lower, cut ? cut->gone : NULL, 0, map, &s->joined, d);
    s->kept = (int64_t)(j->mesh.nelems - before);
    if (!err)
        err = add_gap(j, seam, lower, terrain, map, &s->reused, d);
    s->filled = (int64_t)seam->n;
    s->widened = seam->widened;
    free(map);
    return err;
}

/* The two meshes as the cut and the seam need them. */
struct pair {
    struct hm_border higher;
    struct hm_locate *in_higher, *in_lower;
};

static enum hm_err open_pair(struct pair *p, const struct hm_mesh *higher,
                             const struct hm_mesh *lower, struct hm_diag *d)
{
    enum hm_err err = hm_border_build(&p->higher, higher, d);
    if (!err)
        err = hm_locate_build(&p->in_higher, higher, d);
    if (!err)
        err = hm_locate_build(&p->in_lower, lower, d);
    return err;
}

static void close_pair(struct pair *p)
{
    hm_border_free(&p->higher);
    hm_locate_free(p->in_higher);
    hm_locate_free(p->in_lower);
}

enum hm_err hm_stitch_regular(struct hm_join *j, const struct hm_mesh *lower, double buffer,
                              const struct hm_terrain *terrain, struct hm_stitched *s,
                              struct hm_diag *d)
{
    struct pair p = {0};
    struct hm_cut cut = {0};
    struct hm_seam seam = {0};
    bool beside = false;
    *s = (struct hm_stitched){0};
    enum hm_err err = open_pair(&p, &j->mesh, lower, d);
    if (!err)
        err = hm_cut_mark(&cut, &p.higher, p.in_higher, lower, p.in_lower, buffer, d);
    if (!err && cut.overlapping == 0)
        err = shares_edge(j, lower, &beside, d);
    bool whole = beside || !cut.meets;
    if (!err && !whole) {
        s->overlapping = cut.overlapping;
        s->near = cut.near;
        s->loose = cut.loose;
        err = hm_seam_fill(&seam, &p.higher, p.in_higher, lower, p.in_lower, cut.gone, d);
    }
    if (!err)
        err = sew(j, lower, whole ? NULL : &cut, &seam, terrain, s, d);
    close_pair(&p);
    hm_cut_free(&cut);
    hm_seam_free(&seam);
    return err;
}
