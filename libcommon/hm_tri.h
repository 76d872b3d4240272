/* hm_tri: Delaunay and constrained Delaunay triangulation. Layer 2.
 *
 * Exact predicates throughout; cocircular points are triangulated by their lexicographic order, so
 * the result depends on the points alone, not on their order nor on the number of threads.
 *
 * Vertices have the triangulation's own numbers (spatial order), 0 .. hm_tri_vertices()-1;
 * hm_tri_of_input and hm_tri_input translate. Equal input points become one vertex. Triangles are
 * counter-clockwise. A directed edge is named e = 3*triangle + i; it starts at corner i and has its
 * triangle on the left:
 *
 *                 apex
 *                /    \         next(e): dest → apex,   prev(e): apex → org
 *           org ——e——> dest     twin(e): the same edge seen from the other side
 *
 * Beyond each edge of the convex hull lies a ghost triangle, whose apex is HM_TRI_INFINITY; the
 * hull is walked by twin and next like everything else. Numbers of triangles stay valid until the
 * triangulation is changed; numbers of vertices for ever.
 *
 * A whole program, which prints the area of a field without the pond in it (tests/tri_header.t runs
 * it: 84):
 *
 *     #include "hm_tri.h"
 *     #include "hm_pred.h"
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         const double xy[] = {0, 0, 10, 0, 10, 10, 0, 10, 2, 3, 6, 3, 6, 7, 2, 7, 8, 8};
 *         struct hm_tri *t;
 *         struct hm_diag d = {0};
 *         if (hm_tri_build(&t, xy, 9, 2, 1, &d) != HM_OK) {
 *             fprintf(stderr, "%s\n", d.text);
 *             return 1;
 *         }
 *         struct hm_tri_segment pond[4];
 *         for (size_t i = 0; i < 4; i++)
 *             pond[i] = (struct hm_tri_segment){hm_tri_of_input(t, 4 + i),
 *                                               hm_tri_of_input(t, 4 + (i + 1) % 4), 1};
 *         enum hm_err err = hm_tri_constrain(t, pond, 4, NULL, &d);
 *         if (!err)
 *             err = hm_tri_flood(t, hm_tri_locate(t, 4, 5, NULL), 1, 7, &d);
 *         double area = 0;
 *         for (int32_t k = 0; !err && k < hm_tri_triangles(t); k++)
 *             if (hm_tri_is_solid(t, k) && hm_tri_region(t, k) != 7)
 *                 area += hm_area2(hm_tri_xy(t, hm_tri_org(t, 3 * k)),
 *                                  hm_tri_xy(t, hm_tri_dest(t, 3 * k)),
 *                                  hm_tri_xy(t, hm_tri_apex(t, 3 * k))) / 2;
 *         printf("%g\n", area);
 *         hm_tri_free(t);
 *         return err != HM_OK;
 *     }
 *
 * Memory: 72 bytes a point as built, the given points not counted; 4 more once it is edited, 24
 * with constraints, 8 with regions. At most INT32_MAX / 6 vertices, those taken out included; what
 * would be one more fails with HM_ENOMEM. A function that fails so leaves the triangulation valid,
 * or (hm_tri_build) none.
 */
#ifndef HM_TRI_H
#define HM_TRI_H

#include "hm_base.h"

struct hm_tri;

enum { HM_TRI_INFINITY = -1, HM_TRI_NONE = -1 };

/* --- construction --- */

/* Delaunay triangulation of n points: point i is xy[i*stride], xy[i*stride + 1]. HM_EGEOM when a
 * coordinate is not finite (the place is the point's number in the text) or when all points lie on
 * one line or are fewer than three. */
enum hm_err hm_tri_build(struct hm_tri **t, const double *xy, size_t n, size_t stride, int threads,
                         struct hm_diag *d);
void hm_tri_free(struct hm_tri *t);

/* --- vertices --- */

int32_t hm_tri_vertices(const struct hm_tri *t); /* vertex numbers in use lie below; see is_used */
bool hm_tri_is_used(const struct hm_tri *t, int32_t v);        /* false once removed */
const double *hm_tri_xy(const struct hm_tri *t, int32_t v);    /* until the next edit */
int32_t hm_tri_of_input(const struct hm_tri *t, size_t input); /* vertex of an input point */
int64_t hm_tri_input(const struct hm_tri *t, int32_t v);       /* lowest one at v; -1: added */
size_t hm_tri_duplicates(const struct hm_tri *t);              /* input points merged into others */

/* --- topology --- */

int32_t hm_tri_triangles(const struct hm_tri *t);          /* triangle numbers lie below this */
bool hm_tri_is_solid(const struct hm_tri *t, int32_t tri); /* neither ghost nor free slot */
int32_t hm_tri_org(const struct hm_tri *t, int32_t e);
int32_t hm_tri_dest(const struct hm_tri *t, int32_t e);
int32_t hm_tri_apex(const struct hm_tri *t, int32_t e);
int32_t hm_tri_twin(const struct hm_tri *t, int32_t e);
int32_t hm_tri_edge_from(const struct hm_tri *t, int32_t v); /* some edge with org v */
int32_t hm_tri_edge_between(const struct hm_tri *t, int32_t a, int32_t b); /* or HM_TRI_NONE */

/* Without branches, which could not be foreseen. */
static inline int32_t hm_tri_next(int32_t e)
{
    return e + 1 - 3 * (e % 3 == 2);
}
static inline int32_t hm_tri_prev(int32_t e)
{
    return e - 1 + 3 * (e % 3 == 0);
}

/* --- constraints --- */

/* What was mended while segments went in. */
enum hm_tri_mend {
    HM_TRI_CROSSING,    /* segments that crossed: a vertex at the (rounded) intersection */
    HM_TRI_ON_SEGMENT,  /* a vertex that lay on a segment and split it */
    HM_TRI_OVERLAP,     /* a piece that was constrained already; its middle */
    HM_TRI_ZERO_LENGTH, /* a segment whose ends are one vertex: dropped */
    HM_TRI_MENDS        /* how many kinds there are */
};

/* How often, by kind; and, when `tell` is set, each at once with its place. */
struct hm_tri_mends {
    int64_t n[HM_TRI_MENDS];
    void (*tell)(void *who, enum hm_tri_mend what, double x, double y);
    void *who;
};

/* A segment between two vertices, with marks: any bits the caller likes, not 0. Pieces that were
 * constrained already collect the bits of both. */
struct hm_tri_segment {
    int32_t a, b;
    int32_t marks;
};

/* Put segments in, so that each is a chain of edges, and the triangulation constrained Delaunay.
 * mends may be NULL and is added to. HM_EARG, with nothing changed, when one has no marks or an end
 * that is no vertex (any more). */
enum hm_err hm_tri_constrain(struct hm_tri *t, const struct hm_tri_segment *s, size_t n,
                             struct hm_tri_mends *mends, struct hm_diag *d);

int32_t hm_tri_marks(const struct hm_tri *t, int32_t e); /* 0: not a constraint */

/* Take bits off, from both sides of e. An edge left without any is no constraint any more: what is
 * around becomes Delaunay again, by which triangles may change, also between two regions. */
enum hm_err hm_tri_unmark(struct hm_tri *t, int32_t e, int32_t marks, struct hm_diag *d);

/* Regions: a number a triangle, 0 at first. Give `region` to every triangle that can be reached
 * from `tri` without crossing an edge that has any of the bits `stop`. Reaches ghosts too; from
 * hm_tri_twin of a hull edge it starts outside. */
int32_t hm_tri_region(const struct hm_tri *t, int32_t tri);
enum hm_err hm_tri_set_region(struct hm_tri *t, int32_t tri, int32_t region); /* or HM_ENOMEM */
enum hm_err hm_tri_flood(struct hm_tri *t, int32_t tri, int32_t stop, int32_t region,
                         struct hm_diag *d);

/* What the edges with any of the bits `stop` part the plane into, all in one pass: the number of
 * each triangle's component. 0 is that of all ghosts, and of what hangs together with them; the
 * others have 1, 2, … in the order of their lowest triangle. */
struct hm_tri_components {
    int32_t n;
    int32_t *of;      /* by triangle, ghosts included; HM_TRI_NONE: a free slot */
    int32_t *largest; /* by component: its triangle of the largest area, whose centre is far from
                         all borders; HM_TRI_NONE when it has ghosts only */
};
enum hm_err hm_tri_components(const struct hm_tri *t, int32_t stop, struct hm_tri_components *c,
                              struct hm_diag *d);
void hm_tri_components_free(struct hm_tri_components *c);

/* The centre of gravity of a solid triangle, rounded. */
void hm_tri_centre(const struct hm_tri *t, int32_t tri, double xy[2]);

/* --- editing: every call keeps it constrained Delaunay --- */

/* Add a vertex. A constrained edge that it lies on exactly is split, both halves keep its marks. A
 * vertex already there is returned instead. Points beyond the hull extend it. `hint`: a triangle
 * nearby, or HM_TRI_NONE. New triangles take the region of the old ones around. */
enum hm_err hm_tri_insert(struct hm_tri *t, double x, double y, int32_t hint, int32_t *v,
                          struct hm_diag *d);

/* Add a vertex on edge e at x, y, as if it lay on it exactly (midpoints of slanted edges never do):
 * both halves keep the marks. It may be anywhere in the two triangles of e. HM_EGEOM, with nothing
 * changed, elsewhere. */
enum hm_err hm_tri_split(struct hm_tri *t, int32_t e, double x, double y, int32_t *v,
                         struct hm_diag *d);

/* Take out a vertex that is neither on the hull nor on a constraint (HM_EARG otherwise). */
enum hm_err hm_tri_remove(struct hm_tri *t, int32_t v, struct hm_diag *d);

/* Move such a vertex; it keeps its number. HM_EARG, with nothing changed, when the new place is
 * beyond the hull, beyond a constraint around it, or taken. */
enum hm_err hm_tri_move(struct hm_tri *t, int32_t v, double x, double y, struct hm_diag *d);

/* --- location --- */

/* The solid triangle that holds x, y (border included), walking from `hint` (a triangle near it, or
 * HM_TRI_NONE); HM_TRI_NONE outside the hull. *hint (may be NULL) becomes the last triangle seen.
 */
int32_t hm_tri_locate(const struct hm_tri *t, double x, double y, int32_t *hint);

/* The same for n points in any order, fast: sorted along a curve first. */
enum hm_err hm_tri_locate_all(const struct hm_tri *t, const double *xy, size_t n, size_t stride,
                              int threads, int32_t *tri, struct hm_diag *d);

/* --- checks, for tests and the cautious --- */

/* Orientation, neighbours, marks agree on both sides; hull convex. HM_EGEOM names the place. */
enum hm_err hm_tri_check_topology(const struct hm_tri *t, struct hm_diag *d);
/* Every edge that is no constraint is locally Delaunay, cocircular ties by order included. */
enum hm_err hm_tri_check_delaunay(const struct hm_tri *t, struct hm_diag *d);

#endif
