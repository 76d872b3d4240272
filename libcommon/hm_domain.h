/* hm_domain: the ground that an irregular mesh covers, and the mesh while it is made. Layer 6.
 *
 * Nodes and fixed edges say everything; the triangulation is always the constrained Delaunay
 * triangulation of them, made anew after each round of changes. That costs little while a round
 * changes a good part of all nodes, and every round starts from a mesh that depends on nothing but
 * the nodes.
 *
 *     hm_domain_triangulate(&dom, threads, d);
 *     … read dom.tri, decide …
 *     … change dom.node, dom.edge …
 *     hm_domain_changed(&dom);
 */
#ifndef HM_DOMAIN_H
#define HM_DOMAIN_H

#include "hm_mesh.h"
#include "hm_tri.h"

/* What a fixed edge is part of: bits. */
enum hm_domain_mark {
    HM_EDGE_BREAKLINE = 1,
    HM_EDGE_REGULAR = 2, /* boundary of a regular mesh: never split, nodes never touched */
    HM_EDGE_BORDER = 4,  /* outline or hole of the domain */
    HM_EDGE_REGION = 8   /* between areas of different material, or where the user drew one */
};

/* Beside struct hm_node's flags: the height is a stand-in, the terrain has the right one. */
enum { HM_NODE_NEW = 256 };

enum { HM_OUTSIDE = -1 };

/* An area with a material of its own, and perhaps a size. */
struct hm_zone {
    int32_t material;
    double max_area; /* of its elements, m²; 0: as everywhere */
};

/* An edge that the mesh must have, with the zones left and right of a → b (HM_OUTSIDE: none). */
struct hm_domain_edge {
    int32_t a, b;
    int32_t marks;
    int32_t left, right;
    double beside; /* m²: the element of a regular mesh on one side; 0: none */
};

struct hm_domain {
    struct hm_node *node; /* HM_NODE_FIXED: neither moved nor taken out */
    size_t nnodes, node_cap;
    struct hm_domain_edge *edge; /* they meet in nodes only */
    size_t nedges, edge_cap;
    struct hm_zone *zone; /* the first is all that no other covers */
    size_t nzones;

    /* While triangulated; regions are 0 outside the domain and 1 + the zone inside. */
    struct hm_tri *tri;
    int32_t *node_of;   /* by vertex number of tri; -1 outside the domain */
    int32_t *vertex_of; /* by node */
};

void hm_domain_free(struct hm_domain *dom);

enum hm_err hm_domain_add_node(struct hm_domain *dom, struct hm_node node, struct hm_diag *d);
enum hm_err hm_domain_add_edge(struct hm_domain *dom, struct hm_domain_edge edge,
                               struct hm_diag *d);

/* Make tri and the numbers, unless they are there. HM_EGEOM when the edges turn out to cross. */
enum hm_err hm_domain_triangulate(struct hm_domain *dom, int threads, struct hm_diag *d);

/* Make vertex_of from node_of, for who made tri himself. */
enum hm_err hm_domain_number_vertices(struct hm_domain *dom, struct hm_diag *d);

/* Make nodes of the vertices from `first` on, which were added to tri, and edges of the pieces into
 * which they split fixed ones. On breaklines they have the line's height, elsewhere they are
 * HM_NODE_NEW and their height is NaN. tri stays; moved vertices are the caller's to bring in. */
enum hm_err hm_domain_adopt(struct hm_domain *dom, int32_t first, struct hm_diag *d);

/* The area of a triangle in m²; 0 outside the domain. */
double hm_domain_area(const struct hm_domain *dom, int32_t tri);

/* Drop tri and what goes with it: nodes or edges are about to change, or did. */
void hm_domain_changed(struct hm_domain *dom);

/* Take out the nodes i with gone[i], none of which may be at a fixed edge. */
enum hm_err hm_domain_remove(struct hm_domain *dom, const bool *gone, struct hm_diag *d);

static inline bool hm_domain_is_inside(const struct hm_domain *dom, int32_t tri)
{
    return hm_tri_is_solid(dom->tri, tri) && hm_tri_region(dom->tri, tri) > 0;
}

/* Node numbers of the corners of a triangle. */
static inline void hm_domain_corners(const struct hm_domain *dom, int32_t tri, int32_t node[3])
{
    for (int k = 0; k < 3; k++)
        node[k] = dom->node_of[hm_tri_org(dom->tri, 3 * tri + k)];
}

static inline double hm_node_distance2(const struct hm_node *a, const struct hm_node *b)
{
    return (a->x - b->x) * (a->x - b->x) + (a->y - b->y) * (a->y - b->y);
}

/* The numbers of all nodes in spatial order, malloc'd: for who looks each of them up elsewhere. */
enum hm_err hm_domain_order(const struct hm_domain *dom, int32_t **nodes, struct hm_diag *d);

/* Append nodes and elements of the triangulated domain to a mesh that has none: nodes in spatial
 * order, elements by their lowest node. */
enum hm_err hm_domain_mesh(const struct hm_domain *dom, struct hm_mesh *mesh, struct hm_diag *d);

#endif
