/* hm_outline_parts: stretches of outline along a gap, and how they end at the higher mesh. Shared
 * by hm_outline.c, which finds them, and hm_mouth.c, which ties their ends; nobody else's. */
#ifndef HM_OUTLINE_PARTS_H
#define HM_OUTLINE_PARTS_H

#include "hm_outline.h"

/* The lower outline enters or leaves the higher mesh, through an edge of its border. */
struct hm_crossing {
    size_t edge;    /* of the higher border */
    double at;      /* where on it, 0 .. 1; exact at the ends */
    bool enter;     /* walking the lower outline counter-clockwise */
    int32_t attach; /* node of the higher mesh where the outline ends instead */
    int32_t beyond; /* the next node of that border, away from the mouth */
};

struct hm_chain {
    size_t first, count; /* its nodes, of the lower mesh */
    int64_t from, to;    /* the crossings at its ends; -1: a kept node */
    bool closed;         /* a whole loop */
};

struct hm_chains {
    struct hm_chain *chain;
    size_t nchains, chain_cap;
    int32_t *node;
    size_t nnodes, node_cap;
    struct hm_crossing *crossing;
    size_t ncrossings, crossing_cap;
};

/* Give every crossing its attach and beyond. *widened counts the mouths too narrow for two. */
enum hm_err hm_chains_find_mouths(struct hm_chains *c, const struct hm_border *higher,
                                  int64_t *widened, struct hm_diag *d);

/* Which node of the chain is joined to the attach of its crossing at the end (at_end), or at the
 * beginning: its number in the chain, among the `limit` nodes next to that crossing. */
enum hm_err hm_chain_attach(const struct hm_chains *c, const struct hm_chain *chain, bool at_end,
                            const struct hm_seam_sides *s, size_t limit, size_t *node,
                            struct hm_diag *d);

#endif
