/* hm_star: the triangles around a vertex, and how good they would be with it elsewhere. Layer 6.
 *
 * Good are angles of a minimum and more, and elements not much larger than those beside them;
 * elements of regular meshes count, too.
 */
#ifndef HM_STAR_H
#define HM_STAR_H

#include "hm_sizes.h"

enum { HM_STAR_MOST = 24 }; /* triangles in a star */

/* An edge of a regular mesh, by its vertices, and the area of the element beyond. */
struct hm_star_side {
    int32_t a, b;
    double area;
};

/* What is wanted. */
struct hm_star_rules {
    const struct hm_domain *dom; /* triangulated */
    double ratio;                /* of an element to one beside it at most; 0: any */
    double cos2;                 /* square of the cosine of the minimum angle */
    const struct hm_sizes *sizes;
    struct hm_star_side *side; /* sorted */
    size_t n_sides;
};

/* Fill the rules for a domain; min_angle in degrees. The sides hold as long as its fixed edges. */
enum hm_err hm_star_open(struct hm_star_rules *rules, const struct hm_domain *dom, double ratio,
                         double min_angle, const struct hm_sizes *sizes, struct hm_diag *d);
void hm_star_close(struct hm_star_rules *rules);

/* The area of the element left of an edge, m²; 0 when nobody meshes there. */
double hm_star_area(const struct hm_star_rules *rules, int32_t e);

/* How bad the pair of elements at an edge is; 0: good. */
double hm_star_excess(const struct hm_star_rules *rules, int32_t e);

/* A star, seen from its vertex: triangle k has corners k and k + 1. */
struct hm_star {
    int n;
    const double *corner[HM_STAR_MOST + 1];
    double beyond[HM_STAR_MOST]; /* area of the element beyond its far edge; 0: none */
    double most[HM_STAR_MOST];   /* largest area that it may have */
    double largest;              /* area that one of them has */
    double longest;              /* square of the longest edge that it may have */
    double worst;                /* square of the cosine of the smallest angle that it may have */
    double shortest;             /* edge from the vertex */
};

/* Look at the star of a vertex that is on no fixed edge. What is allowed is what the rules say, or
 * what is there. It begins at the lowest neighbour, whatever the numbers of triangles. False when
 * it has too many of them. */
bool hm_star_look(const struct hm_star_rules *rules, int32_t v, struct hm_star *s);

/* How bad the pairs in a star are with the vertex at p; INFINITY when it may not be there. */
double hm_star_rate(const struct hm_star_rules *rules, const struct hm_star *s, const double *p);

/* The square of the cosine of the smallest angle of a triangle. */
double hm_star_sharpest(const double *a, const double *b, const double *c);

/* The square of a distance. */
static inline double hm_star_length2(const double *a, const double *b)
{
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

#endif
