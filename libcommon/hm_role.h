/* hm_role: what a line is for, by its attributes (hybridmesh(5)). Layer 3. */
#ifndef HM_ROLE_H
#define HM_ROLE_H

enum hm_role {
    HM_ROLE_BREAKLINE, /* no role at all: a constraint, and something to snap to */
    HM_ROLE_SURFACE,   /* surface=NAME side=…: a rough boundary of a regular mesh */
    HM_ROLE_FACE,      /* face=NAME [hole=1]: cuts a regular mesh */
    HM_ROLE_HOLE,      /* hole=1: a hole in the floodplain */
    HM_ROLE_BOUNDARY,  /* boundary=1: the outline of the floodplain */
    HM_ROLE_REGION,    /* region=N: material and size of an area */
    HM_ROLE_STRING,    /* string=NAME: a boundary string for the solver */
    HM_ROLE_NET,       /* net=NAME: control points of a surface, for a picture */
    HM_ROLE_MOVE,      /* move=NAME: a control point's way to its breakline, for a picture */
    HM_ROLE_ZONE       /* zone=NAME: a part of the ground that quality judges by itself */
};

enum hm_role hm_role_of(const char *attrs);

#endif
