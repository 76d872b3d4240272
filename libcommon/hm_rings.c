#include "hm_rings.h"

#include "hm_boxtree.h"
#include "hm_plane.h"
#include "hm_polyline.h"

#include <math.h>
#include <stdlib.h>

struct ring {
    double (*xy)[2];
    size_t n;
    struct hm_boxtree *pieces;
};

struct hm_rings {
    struct ring *ring;
    size_t n;
    struct hm_boxtree *boxes; /* of the rings */
};

static const double *from(const struct ring *r, size_t k)
{
    return r->xy[k];
}
static const double *to(const struct ring *r, size_t k)
{
    return r->xy[k + 1 < r->n ? k + 1 : 0];
}

static enum hm_err take(struct ring *r, const struct hm_line *line, struct hm_box *box,
                        struct hm_diag *d)
{
    struct hm_box *piece = hm_alloc(line->n, sizeof *piece);
    r->xy = hm_alloc(line->n, sizeof *r->xy);
    r->n = line->n;
    enum hm_err err = piece && r->xy ? HM_OK : hm_fail_memory(d);
    for (size_t k = 0; !err && k < r->n; k++) {
        r->xy[k][0] = line->xyz[3 * k];
        r->xy[k][1] = line->xyz[3 * k + 1];
        hm_box_add(box, r->xy[k]);
    }
    for (size_t k = 0; !err && k < r->n; k++)
        piece[k] = hm_box_of(from(r, k), to(r, k));
    if (!err)
        err = hm_boxtree_build(&r->pieces, piece, r->n, d);
    free(piece);
    return err;
}

enum hm_err hm_rings_build(struct hm_rings **rings, const struct hm_line *ring, size_t n,
                           struct hm_diag *d)
{
    *rings = NULL;
    struct hm_rings *r = hm_alloc0(1, sizeof *r);
    struct hm_box *box = hm_alloc(n, sizeof *box);
    enum hm_err err = r && box ? HM_OK : hm_fail_memory(d);
    if (!err && !(r->ring = hm_alloc0(n, sizeof *r->ring)))
        err = hm_fail_memory(d);
    for (; !err && r->n < n; r->n++) {
        box[r->n] = hm_box_of(ring[r->n].xyz, ring[r->n].xyz);
        err = take(&r->ring[r->n], &ring[r->n], &box[r->n], d);
    }
    if (!err)
        err = hm_boxtree_build(&r->boxes, box, n, d);
    free(box);
    if (err)
        hm_rings_free(r);
    else
        *rings = r;
    return err;
}

void hm_rings_free(struct hm_rings *r)
{
    if (!r)
        return;
    for (size_t k = 0; k < r->n; k++) {
        free(r->ring[k].xy);
        hm_boxtree_free(r->ring[k].pieces);
    }
    free(r->ring);
    hm_boxtree_free(r->boxes);
    free(r);
}

/* Only pieces that a ray to the right can meet. */
static bool holds(const struct ring *r, const double *p)
{
    const struct hm_box ray = {{p[0], p[1]}, {INFINITY, p[1]}};
    bool inside = false;
    struct hm_boxquery q = hm_boxtree_find(r->pieces, ray);
    for (int32_t k; (k = hm_boxtree_next(&q)) >= 0;) {
        enum hm_ray c = hm_plane_ray(p, from(r, (size_t)k), to(r, (size_t)k));
        if (c == HM_RAY_ON)
            return true;
        inside ^= c == HM_RAY_CROSSES;
    }
    return inside;
}

int64_t hm_rings_find(const struct hm_rings *r, double x, double y)
{
    const double p[2] = {x, y};
    int64_t found = -1;
    struct hm_boxquery q = hm_boxtree_find(r->boxes, hm_box_of(p, p));
    for (int32_t k; (k = hm_boxtree_next(&q)) >= 0;)
        if (k > found && holds(&r->ring[k], p))
            found = k;
    return found;
}
