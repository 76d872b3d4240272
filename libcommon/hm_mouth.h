/* hm_mouth: how the outline of the lower mesh ends at the border of the higher one. Layer 6.
 *
 * A mouth is a part of the higher border inside the lower mesh. The outline that leads up to it
 * comes in stretches; each ends in the node of the border nearest to where it meets that.
 */
#ifndef HM_MOUTH_H
#define HM_MOUTH_H

#include "hm_sides.h"

/* The lower outline enters or leaves the higher mesh, through an edge of its border. */
struct hm_crossing {
    size_t edge;    /* of the higher border */
    double at;      /* where on it, 0 .. 1; exact at the ends */
    bool enter;     /* walking the lower outline counter-clockwise */
    int32_t attach; /* node of the higher mesh where the outline ends instead */
    int32_t beyond; /* the next node of that border, away from the mouth, */
    int32_t inward; /* and the next one in the mouth */
};

struct hm_stretch {
    size_t first, count; /* its nodes, of the lower mesh */
    int64_t from, to;    /* the crossings at its ends; -1: a kept node */
    bool closed;         /* a whole loop */
};

struct hm_stretches {
    struct hm_stretch *stretch;
    size_t nstretches, stretch_cap;
    int32_t *node;
    size_t nnodes, node_cap;
    struct hm_crossing *crossing;
    size_t ncrossings, crossing_cap;
};

/* Give every crossing its attach and beyond. *widened counts the mouths too narrow for two. */
enum hm_err hm_mouth_find(struct hm_stretches *c, const struct hm_border *higher, int64_t *widened,
                          struct hm_diag *d);

/* Which node of the stretch is joined to the attach of its crossing at the end (at_end), or at the
 * beginning: its number in the stretch, among the `limit` nodes next to that crossing. */
enum hm_err hm_mouth_attach(const struct hm_stretches *c, const struct hm_stretch *stretch,
                            bool at_end, const struct hm_sides *s, size_t limit, size_t *node,
                            struct hm_diag *d);

#endif
