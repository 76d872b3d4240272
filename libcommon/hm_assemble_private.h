/* hm_assemble_private: what hm_assemble works on. Layer 6. Internal to hm_assemble.c, which puts
 * everything into one triangulation, hm_assemble_ground.c, which finds in it the ground to be
 * meshed, and hm_assemble_heights.c.
 */
#ifndef HM_ASSEMBLE_PRIVATE_H
#define HM_ASSEMBLE_PRIVATE_H

#include "hm_assemble.h"
#include "hm_fence.h"
#include "hm_role.h"

/* A closed line with a role. */
struct hm_ring {
    struct hm_line line; /* not ours, but for the hull */
    enum hm_role role;
    struct hm_zone zone;
};

/* What goes into the first triangulation. */
struct hm_build {
    const struct hm_assembly *in;
    struct hm_assembly_counts *counts;
    struct hm_fence *fence;
    struct hm_ring *ring;
    size_t nrings, ring_cap;
    double *hull; /* vertices of the outline when the user gave none */
    struct hm_node *node;
    size_t nnodes, node_cap, first_point, end_points; /* which of them are measurements */
    struct hm_tri_segment *segment; /* of regular meshes, breaklines, the hull, rings */
    size_t nsegments, segment_cap, first_breakline, first_hull, first_ring;
    double *beside; /* by segment of a regular mesh: the area of the element there */
    size_t beside_cap;
    struct hm_tri *tri;
};

/* HM_EGEOM: no measurement lies inside the outline, with a place on that. */
enum hm_err hm_build_fail_empty(const struct hm_build *b, struct hm_diag *d);

/* Tell inside from outside: the regions of the triangulation become those of a domain. */
enum hm_err hm_build_judge(struct hm_build *b, struct hm_diag *d);

/* Heights of the nodes that have none so far. HM_EGEOM, with the place, when nothing tells one. */
enum hm_err hm_build_heights(const struct hm_build *b, struct hm_domain *dom, struct hm_diag *d);

/* Nodes, edges and triangulation of the inside, as a domain; outside pieces are counted. */
enum hm_err hm_build_domain(struct hm_build *b, struct hm_domain *dom, struct hm_diag *d);

#endif
