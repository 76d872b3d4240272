/* hm_meshstat: sizes and shapes of the elements of a mesh, and what solvers would rather not have,
 * of the whole and of each material. Layer 6.
 */
#ifndef HM_MESHSTAT_H
#define HM_MESHSTAT_H

#include "hm_measure.h"
#include "hm_meshedges.h"

enum hm_shape {
    HM_SHAPE_LEAST_ANGLE,   /* of an element, degrees */
    HM_SHAPE_MOST_ANGLE,    /* of an element, degrees */
    HM_SHAPE_EDGE_RATIO,    /* longest over shortest edge of an element */
    HM_SHAPE_AREA,          /* of an element, m² */
    HM_SHAPE_SLOPE,         /* of the bed in an element, degrees from level */
    HM_SHAPE_AREA_RATIO,    /* larger over smaller of two neighbours */
    HM_SHAPE_ORTHOGONALITY, /* at an edge: how far the line between the centres of its two elements
                               is from perpendicular to it, degrees */
    HM_SHAPE_DEGREE,        /* elements at an inner node */
    HM_SHAPE_TIME_STEP,     /* of an element at Courant number 1, s */
    HM_SHAPES
};
extern const struct hm_measure_kind hm_shape_kind[HM_SHAPES];

/* Not wrong, but bad for a solver. */
enum hm_mesh_warning {
    HM_WARN_TRIANGLE_SHARP, /* a triangle's angle under 10° */
    HM_WARN_TRIANGLE_BLUNT, /* a triangle's angle over 150° */
    HM_WARN_QUAD_SHARP,     /* a quadrilateral's angle under 30° */
    HM_WARN_QUAD_BLUNT,     /* a quadrilateral's angle over 150° */
    HM_WARN_AREA_RATIO,     /* neighbours of area ratio over 2 */
    HM_WARN_FEW_ELEMENTS,   /* fewer than 4 elements at an inner node */
    HM_WARN_MANY_ELEMENTS,  /* more than 10 elements at a node */
    HM_WARN_ALL_BOUNDARY,   /* a triangle with all three nodes on the boundary */
    HM_WARN_STEEP,          /* an element steeper than 45° */
    HM_WARN_ORTHOGONALITY,  /* an edge over 70° from perpendicular */
    HM_WARNINGS
};
const char *hm_mesh_warning_name(enum hm_mesh_warning warning);

/* A mesh, or what of it has one material: elements of that material, and edges that have one on
 * both sides. Nodes belong to the whole alone. */
struct hm_meshpart {
    int32_t region;
    size_t triangles, quads;
    double area;    /* m² */
    int64_t faults; /* elements without positive area, or not convex */
    struct hm_measure shape[HM_SHAPES];
    int64_t warning[HM_WARNINGS];
    double place[HM_WARNINGS][2]; /* of the first of each */
};

struct hm_meshstat {
    size_t nodes;
    struct hm_meshpart whole;
    struct hm_meshpart *part; /* by ascending region; owned */
    size_t nparts;
};

/* What lengths of the mesh are in metres, and water for the time step: with a depth of 0 it is not
 * worked out. */
struct hm_meshstat_want {
    double metres, z_metres; /* of a unit of x and y, and of z */
    double depth, velocity;  /* m, m/s */
};

/* The edges are those of hm_mesh_edges. The time step of an element is its smallest height over
 * velocity + sqrt(g depth). */
enum hm_err hm_meshstat_run(struct hm_meshstat *s, const struct hm_mesh *m,
                            const struct hm_mesh_edge *edge, size_t nedges,
                            const struct hm_meshstat_want *want, struct hm_diag *d);
void hm_meshstat_free(struct hm_meshstat *s);

int64_t hm_meshpart_warnings(const struct hm_meshpart *p); /* of all kinds together */

#endif
