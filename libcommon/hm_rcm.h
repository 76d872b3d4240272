/* hm_rcm: nodes and elements of a mesh in an order that keeps neighbours together. Layer 6.
 *
 * Reverse Cuthill–McKee (Cuthill & McKee 1969, George & Liu 1981): breadth first from a node at the
 * rim of each piece, neighbours by degree, the whole order reversed. Solvers with a banded or
 * profile matrix need the small bandwidth that it gives.
 */
#ifndef HM_RCM_H
#define HM_RCM_H

#include "hm_mesh.h"

/* The largest difference of two node numbers in an element. */
int64_t hm_rcm_bandwidth(const struct hm_mesh *m);

/* Renumber the nodes, and sort the elements by their lowest node. Nothing else changes: not the
 * header either, whose strings have the old numbers. number[k] becomes the new number of node k. */
enum hm_err hm_rcm_renumber(struct hm_mesh *m, int32_t *number, struct hm_diag *d);

#endif
