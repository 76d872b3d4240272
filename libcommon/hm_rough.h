/* hm_rough: the rough boundaries of regular meshes, as a user draws them. Layer 6.
 *
 * A surface is bounded by two banks and two end sections, lines with the attributes
 * `surface=NAME side=left|right|inflow|outflow`; left and right as one looks downstream. Banks may
 * be drawn in either direction, but two in one direction without a section run downstream. A
 * section that was not drawn is straight. A line with side=axis only gives its surface a place in
 * the order: hm_axis makes banks of it.
 *
 *          left    0 ───────────────────> n-1
 *                  ^                       ^
 *         inflow   │       surface         │  outflow
 *                  │                       │
 *          right   0 ───────────────────> n-1
 */
#ifndef HM_ROUGH_H
#define HM_ROUGH_H

#include "hm_line.h"

enum hm_rough_side { HM_LEFT, HM_RIGHT, HM_INFLOW, HM_OUTFLOW, HM_SIDES };

enum { HM_ROUGH_NAME = 64, HM_ROUGH_FRACTIONS = 64 };

/* What the user asks of a surface. Numbers that were not said are 0, a snap distance not said is
 * negative. */
struct hm_rough_size {
    double along, across; /* distance of control points in metres; across 0 with fractions */
    double fraction[HM_ROUGH_FRACTIONS]; /* or their places from left bank (0) to right bank (1) */
    size_t nfractions;
    double bend; /* degrees that a bank may turn between control points; 0: any */
    double snap; /* metres that a control point may move to a breakline */
    double elem_along, elem_across; /* lengths of the elements, metres */
};

struct hm_rough {
    char name[HM_ROUGH_NAME];
    int32_t number;                /* 1, 2, … in order of appearance */
    struct hm_line side[HM_SIDES]; /* owned; turned as in the figure, the corners joined */
    struct hm_rough_size size;
    unsigned
        said; /* bits of the attributes along, snap, across, elements, bend: some line has it */
};

/* "10/8", "10" (the same across) or "10/0,.1,.3,.7,.9,1": distances of control points. */
enum hm_err hm_rough_parse_control(const char *text, struct hm_rough_size *size, struct hm_diag *d);
/* "8" or "0,.5,1": the part of it across. */
enum hm_err hm_rough_parse_across(const char *text, struct hm_rough_size *size, struct hm_diag *d);
/* "8/3" or "8": lengths of elements. */
enum hm_err hm_rough_parse_elements(const char *text, struct hm_rough_size *size,
                                    struct hm_diag *d);

/* All surfaces in n sets of lines, in order of appearance; `defaults` holds where no attribute
 * along= across= snap= elements= bend= says otherwise. *list is malloc'd, free with hm_rough_free.
 * HM_EGEOM with the place when a bank is missing, given twice, closed, a point, or when the outline
 * of a surface crosses itself, when left lies on the right, or a section drawn is not one between
 * the banks' ends; HM_EFORMAT for attributes that make no sense, or that two lines of a surface
 * contradict each other in. */
enum hm_err hm_rough_collect(const struct hm_lines *sets, size_t n,
                             const struct hm_rough_size *defaults, struct hm_rough **list,
                             size_t *count, struct hm_diag *d);
void hm_rough_free(struct hm_rough *list, size_t count);

#endif
