/* hm_greedy: measurements become nodes, the one with the largest vertical error first. Layer 6.
 *
 * Greedy insertion (Garland & Heckbert 1995) on the constrained triangulation of the domain. Each
 * triangle has a bucket of the measurements in it and knows the worst; a heap has the triangles. An
 * insertion looks again only at the buckets around the new node: n log n as a rule. Equal errors
 * are taken in spatial order, so the result depends on the measurements alone.
 */
#ifndef HM_GREEDY_H
#define HM_GREEDY_H

#include "hm_domain.h"

struct hm_greedy_options {
    double max_error;  /* m: stop when no measurement is farther above or below the mesh */
    int64_t max_nodes; /* stop at so many nodes; 0: any number */
    double least;      /* m: no node nearer than this to another, than half of it to a line; or 0 */
    double clearance;  /* m: nor nearer than this to a regular mesh */
    int threads;
};

struct hm_greedy_done {
    int64_t inserted;
    int64_t refused;    /* measurements over the error that would have come too near */
    double error, x, y; /* the largest error left among the others, and where */
};

/* Insert out of n measurements x, y, z (hm_terrain_measurements). The domain comes back
 * triangulated; the new nodes are HM_NODE_NEW, without heights. */
enum hm_err hm_greedy_reach(struct hm_domain *dom, const double *xyz, size_t n,
                            const struct hm_greedy_options *o, struct hm_greedy_done *done,
                            struct hm_diag *d);

/* Only look: where the n measurements are farthest above or below the triangulated domain, whose
 * nodes have heights. */
enum hm_err hm_greedy_look(struct hm_domain *dom, const double *xyz, size_t n, int threads,
                           struct hm_greedy_done *done, struct hm_diag *d);

#endif
