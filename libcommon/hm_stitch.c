#include "hm_stitch.h"

#include "hm_cut.h"
#include "hm_elem.h"
#include "hm_plane.h"
#include "hm_seam.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Does p lie on the segment a–b, exactly, and not at an end? */
static bool is_between(const double *p, const double *a, const double *b)
{
    return !hm_plane_same(p, a) && !hm_plane_same(p, b) && hm_plane_holds(p, a, b);
}

/* Do two borders fit where they touch, node for node, and have they an edge in common? */
static bool fit(const struct hm_border *x, const struct hm_border *y)
{
    bool common = false;
    for (size_t i = 0; i < y->n; i++) {
        const double *a = hm_border_from(y, i), *b = hm_border_to(y, i);
        struct hm_boxquery q = hm_boxtree_find(x->tree, hm_box_of(a, b));
        for (int32_t k; (k = hm_boxtree_next(&q)) >= 0;) {
            const double *c = hm_border_from(x, (size_t)k), *d = hm_border_to(x, (size_t)k);
            if (is_between(a, c, d) || is_between(b, c, d) || is_between(c, a, b) ||
                is_between(d, a, b))
                return false;
            common |= hm_plane_same(a, d) && hm_plane_same(b, c);
        }
    }
    return common;
}

/* A node of the lower mesh that the gap uses, which may be there from an element kept, or a new
 * one: *number. Inside the gap the terrain gives heights. */
static enum hm_err gap_node(struct hm_join *j, struct hm_node node,
                            const struct hm_terrain *terrain, int32_t *number, int64_t *count,
                            struct hm_diag *d)
{
    if (*number >= 0)
        return HM_OK;
    if (terrain && !(node.flags & HM_NODE_BOUNDARY)) {
        int32_t hint = 0;
        double z = hm_terrain_z(terrain, node.x, node.y, &hint);
        node.z = isfinite(z) ? z : node.z;
    }
    ++*count;
    return hm_join_node(j, node, number, d);
}

static enum hm_err note_poor(struct hm_stitched *s, const struct hm_mesh *m,
                             const struct hm_elem *e, double angle, struct hm_diag *d)
{
    if (!hm_grow(&s->poor, &s->poor_cap, s->npoor + 1, sizeof *s->poor))
        return hm_fail_memory(d);
    struct hm_stitch_poor *poor = &s->poor[s->npoor++];
    poor->angle = angle;
    hm_elem_centre(m, e, poor->centre);
    return HM_OK;
}

static enum hm_err add_gap(struct hm_join *j, const struct hm_seam *seam,
                           const struct hm_mesh *lower, const struct hm_terrain *terrain,
                           int32_t *map, struct hm_stitched *s, struct hm_diag *d)
{
    int32_t *fresh = hm_alloc(seam->nnodes, sizeof *fresh);
    enum hm_err err = fresh ? HM_OK : hm_fail_memory(d);
    for (size_t k = 0; !err && k < seam->nnodes; k++) {
        fresh[k] = -1;
        err = gap_node(j, seam->node[k], terrain, &fresh[k], &s->fresh, d);
    }
    for (size_t i = 0; !err && i < seam->n; i++) {
        const struct hm_seam_triangle *t = &seam->triangle[i];
        struct hm_elem e = {.node = {0, 0, 0, -1}, .region = t->region};
        for (int k = 0; !err && k < 3; k++) {
            size_t low = (size_t)~t->node[k];
            e.node[k] = t->node[k];
            if (t->node[k] >= 0)
                continue;
            if (low < lower->nnodes)
                err = gap_node(j, lower->node[low], terrain, &map[low], &s->reused, d);
            e.node[k] = low < lower->nnodes ? map[low] : fresh[low - lower->nnodes];
        }
        if (!err)
            err = hm_mesh_add_elem(&j->mesh, e, d);
        if (!err && t->angle < HM_STITCH_POOR)
            err = note_poor(s, &j->mesh, &e, t->angle, d);
    }
    free(fresh);
    return err;
}

static enum hm_err sew(struct hm_join *j, const struct hm_mesh *lower, const struct hm_cut *cut,
                       const struct hm_seam *seam, const struct hm_terrain *terrain, int32_t *map,
                       struct hm_stitched *s, struct hm_diag *d)
{
    size_t before = j->mesh.nelems;
    enum hm_err err = hm_join_mesh(j, lower, cut ? cut->gone : NULL, 0, map, &s->joined, d);
    s->kept = (int64_t)(j->mesh.nelems - before);
    if (!err)
        err = add_gap(j, seam, lower, terrain, map, s, d);
    s->filled = (int64_t)seam->n;
    s->widened = seam->widened;
    return err;
}

/* The two meshes as the cut and the seam need them. */
struct pair {
    struct hm_border higher, lower;
    struct hm_locate *in_higher, *in_lower;
};

static enum hm_err open_pair(struct pair *p, const struct hm_mesh *higher,
                             const struct hm_mesh *lower, struct hm_diag *d)
{
    enum hm_err err = hm_border_build(&p->higher, higher, d);
    if (!err)
        err = hm_border_build(&p->lower, lower, d);
    if (!err)
        err = hm_locate_build(&p->in_higher, higher, d);
    if (!err)
        err = hm_locate_build(&p->in_lower, lower, d);
    return err;
}

static void close_pair(struct pair *p)
{
    hm_border_free(&p->higher);
    hm_border_free(&p->lower);
    hm_locate_free(p->in_higher);
    hm_locate_free(p->in_lower);
}

/* Fill the gap. Where that fails at a place, since an element that stays is in the way, cut more
 * there and try again. */
static enum hm_err fill(struct hm_seam *seam, const struct pair *p, struct hm_cut *cut,
                        struct hm_diag *d)
{
    enum { MOST_TRIES = 12 };
    for (int i = 0;; i++) {
        struct hm_diag failure = {0};
        enum hm_err err = hm_seam_fill(seam, &p->higher, p->in_higher, &p->lower, p->in_lower,
                                       cut->gone, &failure);
        if (!err || !failure.has_place || i == MOST_TRIES) {
            if (err && d && !d->err)
                *d = failure;
            return err;
        }
        err = hm_cut_more(cut, p->lower.mesh, failure.x, failure.y, i, d);
        if (err)
            return err;
    }
}

/* By how much the angles of a seam fall short of that, in all. */
static double shortfall(const struct hm_seam *seam)
{
    double sum = 0;
    for (size_t i = 0; i < seam->n; i++)
        sum += fmax(0, HM_STITCH_POOR - seam->triangle[i].angle);
    return sum;
}

/* A cut, and the seam that fills the gap. */
struct attempt {
    struct hm_cut cut;
    struct hm_seam seam;
};

static void attempt_free(struct attempt *a)
{
    hm_cut_free(&a->cut);
    hm_seam_free(&a->seam);
}

/* Cut the elements that stay at the corners of poor triangles of `a`, into `wider`. */
static enum hm_err widen_cut(struct hm_cut *wider, const struct attempt *a,
                             const struct hm_mesh *lower, int64_t *more, struct hm_diag *d)
{
    const struct hm_seam *seam = &a->seam;
    *wider = a->cut;
    wider->gone = hm_alloc(lower->nelems, sizeof *wider->gone);
    bool *node = hm_alloc0(lower->nnodes, sizeof *node);
    enum hm_err err = wider->gone && node ? HM_OK : hm_fail_memory(d);
    if (!err)
        memcpy(wider->gone, a->cut.gone, lower->nelems * sizeof *wider->gone);
    for (size_t i = 0; !err && i < seam->n; i++)
        for (int k = 0; k < 3 && seam->triangle[i].angle < HM_STITCH_POOR; k++) {
            size_t low = (size_t)~seam->triangle[i].node[k];
            if (seam->triangle[i].node[k] < 0 && low < lower->nnodes)
                node[low] = true;
        }
    if (!err)
        err = hm_cut_around(wider, lower, node, more, d);
    free(node);
    return err;
}

/* Where elements that stay leave no room for good triangles, cut more, and keep the best of what
 * was tried: a mesh that dips its corner into another one has to lose more than one row. */
static enum hm_err improve(struct attempt *best, const struct pair *p, struct hm_diag *d)
{
    enum { MOST_ROUNDS = 6 };
    struct attempt last = {0};
    const struct attempt *from = best;
    enum hm_err err = HM_OK;
    bool more_to_try = true;
    for (int round = 0; !err && more_to_try && round < MOST_ROUNDS && shortfall(&best->seam) > 0;
         round++) {
        struct attempt next = {0};
        int64_t more = 0;
        struct hm_diag ignored = {0};
        err = widen_cut(&next.cut, from, p->lower.mesh, &more, d);
        more_to_try = !err && more > 0 && !fill(&next.seam, p, &next.cut, &ignored);
        bool better = more_to_try && shortfall(&next.seam) < shortfall(&best->seam);
        struct attempt *slot = better ? best : &last;
        attempt_free(slot);
        *slot = next;
        from = slot;
    }
    attempt_free(&last);
    return err;
}

enum hm_err hm_stitch_regular(struct hm_join *j, const struct hm_mesh *lower, double buffer,
                              const struct hm_terrain *terrain, int32_t *map, struct hm_stitched *s,
                              struct hm_diag *d)
{
    struct pair p = {0};
    struct attempt a = {0};
    *s = (struct hm_stitched){0};
    enum hm_err err = open_pair(&p, &j->mesh, lower, d);
    if (!err)
        err = hm_cut_mark(&a.cut, &p.higher, p.in_higher, lower, p.in_lower, buffer, d);
    bool beside = !err && a.cut.overlapping == 0 && fit(&p.higher, &p.lower);
    bool whole = beside || !a.cut.meets;
    if (!err && !whole) {
        err = fill(&a.seam, &p, &a.cut, d);
        if (!err)
            err = improve(&a, &p, d);
        s->overlapping = a.cut.overlapping;
        s->near = a.cut.near;
        s->loose = a.cut.loose;
    }
    if (!err)
        err = sew(j, lower, whole ? NULL : &a.cut, &a.seam, terrain, map, s, d);
    close_pair(&p);
    attempt_free(&a);
    return err;
}

void hm_stitched_free(struct hm_stitched *stitched)
{
    free(stitched->poor);
    *stitched = (struct hm_stitched){0};
}
