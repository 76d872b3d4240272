/* hm_tri_topology: how hm_tri keeps its triangles. Layer 2. Internal to the hm_tri_*.c files.
 *
 * A triangle is three half-edges in a row, eight bytes each. What only some need (marks, regions,
 * an edge at each vertex) is in arrays of its own, made when first needed.
 *
 * The layers, each on those before it: topology (this), conquer and build, locate, flip and fill
 * (the two ways to restore the Delaunay property), edit (insert, split, remove, move), constrain;
 * check and regions stand beside them.
 */
#ifndef HM_TRI_TOPOLOGY_H
#define HM_TRI_TOPOLOGY_H

#include "hm_order.h"
#include "hm_pred_inline.h"
#include "hm_tri.h"

enum { HM_TRI_FREE = -2 }; /* org of the first half-edge of a free slot */

/* Numbers of half-edges are int32_t. A vertex taken out keeps its number, and counts. */
enum { HM_TRI_MOST_TRIANGLES = INT32_MAX / 3, HM_TRI_MOST_VERTICES = INT32_MAX / 6 };

struct hm_tri_half {
    int32_t org, twin; /* in a free slot the first twin is the next free slot, or HM_TRI_NONE */
};

/* One edge of the rim of a hole in the triangulation: from v to the next link's v, the hole on its
 * left. `outer` is the half-edge on its other side. Where the hole is on that side too, it is
 * -2 - i, i the number of the link that goes back along the same edge. */
struct hm_tri_link {
    int32_t v, outer, marks;
};

/* A rim: n links and one more that holds the last vertex only. */
struct hm_tri_rim {
    struct hm_tri_link *link;
    size_t n, cap;
};

struct hm_tri {
    struct hm_tri_half *half; /* 3 * triangles; the first three arrays share cap_triangles */
    int32_t *marks;           /* 3 * triangles, or NULL: all 0 */
    int32_t *region;          /* triangles, or NULL: all 0 */
    int32_t triangles, free;  /* slots in use or free; first free slot */
    size_t cap_triangles;

    double *xy;     /* 2 * vertices; these three share cap_vertices */
    int32_t *edge;  /* an edge from each vertex; HM_TRI_NONE: removed. NULL before the first edit */
    int32_t *input; /* lowest input point at each vertex, HM_TRI_NONE: added */
    int32_t vertices;
    size_t cap_vertices;

    struct hm_order_frame frame; /* vertices 0 .. built are in the order of their keys in it, */
    int32_t built;               /* unless moved; later ones in none */

    int32_t *of_input; /* vertex of each of n_input points */
    size_t n_input, duplicates;

    /* scratch, kept from call to call */
    int32_t *stack, *hole; /* hole: the triangles that were in it */
    size_t cap_stack, n_hole, cap_hole;
    struct hm_tri_rim left, right;
};

static inline int32_t hm_tri_apex_of(const struct hm_tri *t, int32_t e)
{
    return t->half[hm_tri_prev(e)].org;
}

static inline int32_t hm_tri_dest_of(const struct hm_tri *t, int32_t e)
{
    return t->half[hm_tri_next(e)].org;
}

static inline void hm_tri_pair(struct hm_tri_half *half, int32_t e, int32_t f)
{
    half[e].twin = f;
    half[f].twin = e;
}

static inline const double *hm_tri_at(const struct hm_tri *t, int32_t v)
{
    return t->xy + 2 * (size_t)v;
}

static inline bool hm_tri_is_ghost(const struct hm_tri *t, int32_t tri)
{
    const struct hm_tri_half *h = t->half + 3 * (size_t)tri;
    return h[0].org == HM_TRI_INFINITY || h[1].org == HM_TRI_INFINITY ||
           h[2].org == HM_TRI_INFINITY;
}

/* The next edge from the same vertex, counter-clockwise. */
static inline int32_t hm_tri_turn(const struct hm_tri *t, int32_t e)
{
    return t->half[hm_tri_prev(e)].twin;
}

static inline int32_t hm_tri_marks_of(const struct hm_tri *t, int32_t e)
{
    return t->marks ? t->marks[e] : 0;
}

/* Only when there are marks. */
static inline void hm_tri_set_marks(struct hm_tri *t, int32_t e, int32_t marks)
{
    t->marks[e] = marks;
    t->marks[t->half[e].twin] = marks;
}

/* Make the arrays that are made late, or room for so many more. HM_ENOMEM changes nothing. */
enum hm_err hm_tri_need_edges(struct hm_tri *t, struct hm_diag *d);
enum hm_err hm_tri_need_marks(struct hm_tri *t, struct hm_diag *d);
enum hm_err hm_tri_need_regions(struct hm_tri *t, struct hm_diag *d);
enum hm_err hm_tri_need_triangles(struct hm_tri *t, int32_t more, struct hm_diag *d);
enum hm_err hm_tri_need_vertices(struct hm_tri *t, int32_t more, struct hm_diag *d);

/* Slots, once there is room. A taken one holds nothing of use; of one given back marks and region
 * are cleared. */
int32_t hm_tri_take_triangle(struct hm_tri *t);
void hm_tri_give_triangle(struct hm_tri *t, int32_t tri);
int32_t hm_tri_take_vertex(struct hm_tri *t, double x, double y);

/* hm_tri_conquer.c: triangulate n >= 2 points, all different and in the order of hm_order with
 * their keys (which are changed), into half[0 .. 3(2n-2)). Returns the finite half-edge of a ghost.
 */
int32_t hm_tri_conquer(struct hm_tri_half *half, const double *xy, int32_t n, uint32_t *key,
                       int threads);

/* hm_tri_locate.c: some edge from vertex v; HM_TRI_NONE when it is removed. */
int32_t hm_tri_edge_of(const struct hm_tri *t, int32_t v);

/* The solid triangle that holds p, or a ghost whose hull edge has p beyond it. */
int32_t hm_tri_walk(const struct hm_tri *t, const double *p, int32_t tri);  /* tri: solid */
int32_t hm_tri_find(const struct hm_tri *t, const double *p, int32_t hint); /* hint may be none */

/* The edge from vertex a along which p lies, or else the one whose triangle, on its left, the way
 * from a to p enters; HM_TRI_NONE when that way leaves the hull. */
int32_t hm_tri_aim(const struct hm_tri *t, int32_t a, const double *p);

/* For three points on a line, a different from b: is b not farther from a than c is? Only for c on
 * the same side of a as b. */
bool hm_tri_is_between(const double *a, const double *b, const double *c);

/* hm_tri_flip.c. The edge e is given; its two triangles are a → b = e with apex c, and b → a with
 * apex d. */

/* Turn the edge to run from c to d. Afterwards e is a → d and twin(e) as it was is b → c, each
 * beside its new triangle; the new edge is next(e). */
void hm_tri_flip(struct hm_tri *t, int32_t e);

/* Should the edge be flipped? For edges to infinity: would that make the hull convex? */
bool hm_tri_is_illegal(const struct hm_tri *t, int32_t e);

/* Restore the (constrained) Delaunay property around a new vertex v; `link` is an edge opposite v.
 * Flips only edges opposite v, which is enough after inserting it. */
void hm_tri_legalize_star(struct hm_tri *t, int32_t link);

/* The same from any illegal edges, the first n on the stack (Lawson 1977). HM_ENOMEM leaves a valid
 * triangulation that is not quite Delaunay. */
enum hm_err hm_tri_legalize(struct hm_tri *t, size_t n, struct hm_diag *d);

/* hm_tri_fill.c */

/* Append a link along half-edge h of a triangle in the hole. */
enum hm_err hm_tri_rim_add(struct hm_tri *t, struct hm_tri_rim *rim, int32_t h, struct hm_diag *d);
enum hm_err hm_tri_rim_end(struct hm_tri_rim *rim, int32_t v, struct hm_diag *d); /* last vertex */
void hm_tri_rim_reverse(struct hm_tri_rim *rim);
enum hm_err hm_tri_hole_add(struct hm_tri *t, int32_t tri, struct hm_diag *d);
enum hm_err hm_tri_fill_prepare(struct hm_tri *t, const struct hm_tri_rim *rim, struct hm_diag *d);

/* Find the edges that the rim goes along twice; for each rim of a hole before any is filled, and
 * only when nothing can fail any more. */
void hm_tri_rim_match(struct hm_tri *t, struct hm_tri_rim *rim);

/* Triangulate the polygon of a rim and the base from its last vertex to its first, constrained
 * Delaunay, with triangles out of t->hole. Needs hm_tri_fill_prepare and
 * hm_tri_rim_match, then cannot fail. `outer` is
 * the half-edge on the other side of the base, or HM_TRI_NONE; returns that on the inside. */
int32_t hm_tri_fill(struct hm_tri *t, struct hm_tri_rim *rim, int32_t outer);

/* hm_tri_edit.c: put vertex v (taken, not yet in) on edge e or into triangle tri, and restore the
 * Delaunay property but for edges at v itself. Needs room for two triangles. */
void hm_tri_split_edge(struct hm_tri *t, int32_t e, int32_t v);
void hm_tri_split_triangle(struct hm_tri *t, int32_t tri, int32_t v);

/* Would the four triangles of edge e split at p all turn left? */
bool hm_tri_can_split(const struct hm_tri *t, int32_t e, const double *p);

#endif
