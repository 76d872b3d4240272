/* hm_join: meshes put together by their common nodes. Layer 6.
 *
 * Two nodes are the same when x and y are bit-equal; the first gives z and owner, flags add up.
 * Foreign meshes, whose coordinates went through another program's rounding, are matched within a
 * tolerance instead: boundary node to boundary node, each once, the nearest pairs first.
 */
#ifndef HM_JOIN_H
#define HM_JOIN_H

#include "hm_mesh.h"
#include "hm_places.h"

/* Begins as `= {0}`. */
struct hm_join {
    struct hm_mesh mesh; /* what was put together so far, without header */
    struct hm_places places;
};

struct hm_joined {
    int64_t shared;  /* nodes that were there already */
    int64_t matched; /* of these only within the tolerance */
    double furthest; /* the longest such way, m */
    int64_t unused;  /* nodes without an element, left out */
};

/* Add a node, or find it. */
enum hm_err hm_join_node(struct hm_join *j, struct hm_node node, int32_t *number,
                         struct hm_diag *d);

/* Add m but for the elements `gone` (NULL: none is), and what nodes only these use. map (NULL: not
 * wanted) gets the new number of each of m's nodes, or -1. tolerance: metres, 0 for none. */
enum hm_err hm_join_mesh(struct hm_join *j, const struct hm_mesh *m, const bool *gone,
                         double tolerance, int32_t *map, struct hm_joined *joined,
                         struct hm_diag *d);

/* Set HM_NODE_BOUNDARY on just the nodes of the boundary. HM_EGEOM when edges are used wrongly. */
enum hm_err hm_join_flag_boundary(struct hm_mesh *m, struct hm_diag *d);

void hm_join_free(struct hm_join *j);

#endif
