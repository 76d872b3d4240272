/* hm_tri_refine: a constrained triangulation made finer until its triangles are good. Layer 2.
 *
 * Delaunay refinement (Ruppert 1995; Chew 1993; off-centres, Üngör 2004): a vertex goes near the
 * circumcentre of a bad triangle, but no farther from its shortest edge than angle and area allow.
 * Triangles over their area come before those that only have a small angle, in both the one with
 * the shortest edge first. When the vertex would come too near a constraint, that is split instead.
 * Small angles between constraints cannot be mended: there constraints are split on circles about
 * the corner, and triangles that the corner forces are spared (Miller, Pav & Walkington 2003).
 */
#ifndef HM_TRI_REFINE_H
#define HM_TRI_REFINE_H

#include "hm_tri.h"

/* An angle of a triangle that stayed under the minimum. */
struct hm_tri_sharp {
    double x, y, angle; /* of the corner; degrees */
    int32_t v;          /* the vertex there */
    bool given;         /* between two constraints, the input's own: spared. Else such a corner is
                         * near, or a constraint that stays whole, or `most` was reached */
};

/* What is wanted. Zero is "no bound" everywhere. */
struct hm_tri_quality {
    double min_angle; /* degrees; it surely ends up to 20, in practice up to 33; at most 40, for
                       * which set `most` */
    double max_area;
    double max_edge; /* the longest edge of a triangle */

    /* the largest area around x, y in a region, or 0; NULL: max_area alone */
    double (*area_at)(void *arg, double x, double y, int32_t region);
    void *arg;

    /* Gradation: edges get longer by no more than this a unit of the way from the shortest edges of
     * the input and from small areas asked for (0.2: by a fifth of the way; measured along edges)
     */
    double growth;

    int32_t whole;      /* constraints with any of these marks are never split; bad triangles that
                         * would need it stay */
    int32_t outside;    /* triangles of this region are left alone: holes, and beyond the outline */
    int32_t hull_marks; /* hull edges that are no constraints become one with these marks (not 0) */

    /* called for each angle that stays under the minimum, at the end; or NULL */
    void (*sharp)(void *arg, const struct hm_tri_sharp *where);
    void *sharp_arg;

    int64_t most; /* no more than so many vertices are added, those taken out again included */
};

/* What was done. */
struct hm_tri_refined {
    int64_t on_segments, inside; /* vertices added */
    int64_t small;               /* triangles still under the minimum angle … */
    int64_t given;               /* … of those, with an angle between two constraints */
    double smallest, x, y;       /* the smallest angle of all in degrees, and where */
    int64_t large;               /* triangles still over their area or longest edge */
    bool capped;                 /* `most` was reached */
};

/* Refine all solid triangles whose region is not q->outside, which constraints bound (ghosts become
 * outside). Vertices are only added; those of before stay, as do all constraints, split into
 * pieces. done may be NULL. HM_EARG for bounds out of range; HM_EGEOM when the points extend over
 * less than 1e-50 or more than 1e50, whose areas and angles doubles do not hold; HM_ENOMEM leaves a
 * valid triangulation that may not be Delaunay. */
enum hm_err hm_tri_refine(struct hm_tri *t, const struct hm_tri_quality *q,
                          struct hm_tri_refined *done, struct hm_diag *d);

#endif
