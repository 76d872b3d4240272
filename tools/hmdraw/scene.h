/* scene: the 3D view of meshes, one page of HTML. No cairo in it.
 *
 * A scene is every element of the mesh layers that meets the window, its nodes, lines over it, and
 * what residuals say of its elements. scene_write encodes it into the page of view3d/, whose
 * model.js decodes it.
 */
#ifndef SCENE_H
#define SCENE_H

#include "draw.h"

#include "hm_writer.h"

/* --- encode.c: whole numbers of variable length, in base64 --- */

/* Begins as {0}; .err after the first failure, and later calls then do nothing. */
struct encoder {
    unsigned char *byte;
    size_t n, cap;
    enum hm_err err;
    uint64_t run_value, run; /* of encode_run: so many of the value are still to be written */
};
void encode_unsigned(struct encoder *c, uint64_t v);
void encode_signed(struct encoder *c, int64_t v);
/* Values that often repeat: as pairs of a value and how often. encode_run_end behind the last. */
void encode_run(struct encoder *c, uint64_t v);
void encode_run_end(struct encoder *c);
/* As a block of the page that is called so; and free. */
enum hm_err encoder_write(struct encoder *c, const char *id, struct hm_writer *w,
                          struct hm_diag *d);

/* --- scene.c --- */

/* One mesh layer's share. */
struct scene_part {
    const struct hm_mesh *from;
    size_t nodes, elems; /* in the scene */
};

struct scene_residual {
    int64_t n;          /* measurements in the element */
    double sum2, worst; /* of their residuals: squares; the one farthest from 0 */
};

enum { SCENE_MATERIAL, SCENE_QUALITY, SCENE_RESIDUAL, SCENE_COLOURINGS };

struct colouring {
    const char *title;
    struct classes classes;
};

/* Kinds of lines, in the order in which they are added. */
enum { SCENE_BOUNDARY, SCENE_STRINGS, SCENE_BREAKLINES, SCENE_LINES };

struct scene {
    struct hm_mesh mesh;                /* of all parts together, without header */
    int32_t *node_number, *elem_number; /* in the part's own stream */
    struct scene_part *part;
    size_t nparts;
    double origin[3], step[3], size[3]; /* metres; every coordinate is origin + a whole number of
                                           steps, to half a step */
    struct scene_residual *residual;    /* of each element; NULL when no points have residuals */
    double residual_limits[2];          /* of their classes, metres */
    struct colouring colouring[SCENE_COLOURINGS];
    int ncolourings;
    int64_t lines[SCENE_LINES]; /* how many of each kind */
    struct encoder
        vertices;    /* of all lines: how many, then each less the one before it, in steps */
    int64_t last[3]; /* the last of them */
};

/* Begins with {0}: the elements of a mesh that meet the window. */
enum hm_err scene_add_mesh(struct scene *s, const struct view *v, const struct hm_mesh *m,
                           struct hm_diag *d);
/* Then, once: where it lies. HM_EGEOM when a node has no height. */
enum hm_err scene_place(struct scene *s, struct hm_diag *d);
/* Then what lies on it: the boundary and the boundary strings of the meshes, */
enum hm_err scene_add_borders(struct scene *s, struct hm_diag *d);
/* the breaklines among lines (how many of these have a role and are left out), residuals of points
 * with that field, */
int64_t scene_add_breaklines(struct scene *s, const struct hm_lines *l);
enum hm_err scene_add_residuals(struct scene *s, const struct hm_points *p, struct hm_diag *d);
/* and last the classes that colour elements. */
enum hm_err scene_add_colourings(struct scene *s, struct hm_diag *d);
void scene_free(struct scene *s);

/* --- scene_write.c --- */

/* `start`: the colouring to begin with, -1 for heights. */
enum hm_err scene_write(struct scene *s, const struct scale *heights, const char *title, int start,
                        struct hm_writer *w, struct hm_diag *d);

#endif
