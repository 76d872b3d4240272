/* hm_regular: a regular mesh on a quadratic (1 … 3) B-spline surface between two banks, the paper's
 * section 5. Layer 6.
 *
 *     rough lines → control points on both banks → snapped to breaklines (hm_snap)
 *                 → Coons patch → x, y dragged through them (hm_bspline)
 *                 → z dragged to the terrain (hm_drape)
 *                 → nodes at constant Δu, Δv → triangles or quadrilaterals
 *
 * The surface has uniform knots and a ring of extrapolated control points, so that it ends in the
 * outermost Greville lines: u = 0 is the inflow section, u = n-1 the outflow, v = 0 the right bank,
 * v = m-1 the left.
 */
#ifndef HM_REGULAR_H
#define HM_REGULAR_H

#include "hm_bspline.h"
#include "hm_mesh.h"
#include "hm_rough.h"
#include "hm_snap.h"
#include "hm_terrain.h"

struct hm_regular_how {
    int degree;     /* 1, 2 or 3 */
    int iterations; /* by which z is dragged to the terrain: the smoothing knob */
    bool quads;
    bool alternating; /* diagonals, not the better fit */
    bool orthogonal;  /* shift control points along the banks: hm_stations */
    double gap;       /* of the terrain, metres: for the message that there is none */
    int threads;
};

struct hm_regular {
    struct hm_bsurf surface;       /* dim 3 */
    double *laid[2];               /* HM_LEFT, HM_RIGHT: 3 a control point, on the rough bank; */
    double *passed[2];             /* 2 a control point: where the surface passes instead */
    bool *snapped[2];              /* control point i found a breakline */
    size_t moved;                  /* and how many did, of 2 n */
    double largest, largest_at[2]; /* the largest move, and from where */
    size_t unknown;                /* control points without terrain: z from their neighbours */
    double unknown_at[2];          /* the first of them */
    int64_t concave;               /* quadrilaterals split because they are not strictly convex */
};

/* Control net and surface. HM_EGEOM with the place when control distances are larger than the river
 * or when the terrain ends before the surface does. */
enum hm_err hm_regular_surface(struct hm_regular *s, const struct hm_rough *rough,
                               const struct hm_breaklines *breaklines,
                               const struct hm_terrain *terrain, const struct hm_regular_how *how,
                               struct hm_diag *d);
void hm_regular_free(struct hm_regular *s);

/* Nodes and elements into an empty mesh (without header): owner and region are the surface's
 * number, bank nodes between snapped control points are HM_NODE_BREAKLINE; the border is not
 * flagged yet. HM_EGEOM with the place where an element would be folded or have no area.
 *
 * Each cell of nodes is cut by the diagonal whose middle lies nearer to the surface; by the shorter
 * one where that makes less than HM_REGULAR_FIT metres; or alternately; in the corners from the
 * corner, so that no triangle has all three nodes on the border. */
#define HM_REGULAR_FIT 0.02
enum hm_err hm_regular_mesh(struct hm_regular *s, const struct hm_rough *rough,
                            const struct hm_regular_how *how, struct hm_mesh *mesh,
                            struct hm_diag *d);

/* The control points for a picture: lines with net=NAME row=J and net=NAME column=I, and for each
 * control point on the banks a line with move=NAME side=left|right moved=0|1 from where it was laid
 * to where the surface passes. Appended to `lines`. */
enum hm_err hm_regular_net(const struct hm_regular *s, const char *name, struct hm_lines *lines,
                           struct hm_diag *d);

/* Mark the nodes on the border of a finished (cut) mesh HM_NODE_BOUNDARY and HM_NODE_FIXED. */
enum hm_err hm_regular_flag_border(struct hm_mesh *mesh, struct hm_diag *d);

#endif
