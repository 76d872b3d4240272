/* hm_gapfill: heights for the nodes of a grid that got no measurement. Layer 6. */
#ifndef HM_GAPFILL_H
#define HM_GAPFILL_H

#include "hm_base.h"

/* Fill NaN nodes of z (ny rows of nx) linearly in the Delaunay triangles between nodes with data;
 * one between four neighbours with data gets their mean. Nodes stay NaN in triangles with an edge
 * over `gap` cells, or so flat that the circle through their corners has a larger radius, and
 * beyond all triangles. Exact on planes. What a node gets depends, to the last bit, on the nodes
 * within 2 * gap of it alone; so windows of a grid agree. */
enum hm_err hm_gapfill(double *z, size_t nx, size_t ny, double gap, int threads, struct hm_diag *d);

#endif
