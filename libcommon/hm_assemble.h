/* hm_assemble: from measurements, lines and regular meshes to the domain of an irregular mesh.
 * Layer 6.
 *
 * Everything is put into one triangulation; where lines cross or overlap they are mended; then the
 * ground inside the outline (the convex hull without one), outside holes and regular meshes is kept
 * and all else forgotten.
 */
#ifndef HM_ASSEMBLE_H
#define HM_ASSEMBLE_H

#include "hm_domain.h"
#include "hm_terrain.h"

struct hm_assembly {
    const struct hm_points *points;
    const struct hm_lines *lines;
    const struct hm_mesh *meshes;
    size_t npoints, nlines, nmeshes;
    const struct hm_terrain *terrain; /* heights of measurements, and of what has none */
    double clearance;                 /* m: what is nearer to a regular mesh is cut off */
    bool heights_only;                /* measurements are no nodes */
    bool line_z_terrain;              /* heights of breaklines from the terrain, not their own */
    int threads;
    void (*mended)(void *who, enum hm_tri_mend what, double x, double y); /* told, when set */
    void *who;
};

/* What was done on the way. */
struct hm_assembly_counts {
    /* mended */
    int64_t duplicates;  /* measurements at a node of a line or a regular mesh */
    int64_t crossings;   /* of lines: a new node at each */
    int64_t on_lines;    /* nodes that lay on a line and split it */
    int64_t overlaps;    /* pieces of lines drawn twice */
    int64_t zero_length; /* pieces of lines without length */
    /* dropped */
    int64_t near_points; /* measurements nearer to a regular mesh than the clearance */
    int64_t outside_points;
    int64_t breaklines, cut_lines; /* how many there were; how many were cut by regular meshes */
    double length, near_length, outside_length; /* of breaklines, in m: whole; dropped */
    int64_t idle_holes;                         /* holes outside the outline */
    /* for the user's eyes */
    int64_t line_heights;  /* vertices of breaklines that got their height from the terrain */
    double median_segment; /* of the breaklines, m; 0 without */
};

/* Fill an empty domain; it comes triangulated. HM_EGEOM with a place: an outline or hole that is
 * not closed or meets itself, regular meshes that overlap, no ground or no measurement left, a node
 * whose height nothing tells. */
enum hm_err hm_assemble(const struct hm_assembly *in, struct hm_domain *dom,
                        struct hm_assembly_counts *counts, struct hm_diag *d);

#endif
