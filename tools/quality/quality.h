/* Parts of quality: what a run holds, and measurements against meshes. */
#ifndef QUALITY_H
#define QUALITY_H

#include "hm_cli.h"
#include "hm_criterion.h"

enum { MESHES = 2 };

struct run {
    struct hm_cli *cli;
    struct hm_quality mesh[MESHES]; /* the one that is judged, and the one of --compare */
    size_t nmeshes;                 /* 1 or 2, */
    bool has_mesh;                  /* of which the first may be still to come */
    enum hm_strata strata;
    struct hm_lines *lines; /* as they came */
    size_t nlines, lines_cap;
    struct hm_zones zones;  /* in the units of the first mesh */
    struct hm_points *held; /* measurements that came before the mesh, or before the zones */
    size_t nheld, held_cap;
    bool compared;            /* measurements have been compared already */
    const char *residuals;    /* file for the residual stream, or NULL */
    struct hm_writer *writer; /* of it */
};

/* What the lengths of an object with that header are to be multiplied with, to be in the units of
 * a mesh: x and y, z. */
void quality_scale(struct run *run, const struct hm_header *h, const struct hm_quality *q,
                   double scale[2]);

/* The same lines in the units of a mesh; the copy is the caller's. */
void quality_scale_lines(struct run *run, const struct hm_lines *lines, const struct hm_quality *q,
                         struct hm_lines *scaled);

/* Compare the points that the reader is at, or those held. */
void quality_stream_points(struct run *run, const struct hm_header *h);
void quality_compare_held(struct run *run);

/* All have been compared: close the residual stream. */
void quality_end_residuals(struct run *run);

#endif
