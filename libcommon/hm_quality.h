/* hm_quality: all that is known about the quality of one mesh. Layer 6. */
#ifndef HM_QUALITY_H
#define HM_QUALITY_H

#include "hm_fidelity.h"
#include "hm_meshcheck.h"
#include "hm_meshstat.h"
#include "hm_survey.h"
#include "hm_zone.h"

/* What strata of measurements go by. */
enum hm_strata { HM_STRATA_NONE, HM_STRATA_CLASS, HM_STRATA_REGION, HM_STRATA_ZONE };

/* Places are in the coordinates of the mesh, all else in metres whatever its units. */
struct hm_quality {
    struct hm_mesh mesh;
    struct hm_walk *walk;    /* of the mesh */
    double metres, z_metres; /* of a unit of its x and y, and of z */
    struct hm_survey survey;
    double survey_error; /* RMSE of the measurements, metres; 0: not known */
    enum hm_strata strata;
    const struct hm_zones *zones; /* of HM_STRATA_ZONE; the caller's */
    bool waved;                   /* a depth for time steps was given: */
    double depth, velocity;       /* m, m/s */
    struct hm_meshstat shape;
    struct hm_meshcheck check;
    struct hm_fidelity lines;
    struct hm_rings *holes; /* of the mesh; NULL when it has none, or its edges are faulty */
};

/* Check and measure the mesh that stands in q, with its units and the water for time steps; what
 * hm_quality_place needs is there then. */
enum hm_err hm_quality_examine(struct hm_quality *q, struct hm_diag *d);
void hm_quality_free(struct hm_quality *q);

/* Where a place is, by threads that share q and have a hint each (hm_walk_element): its element, or
 * -1, and what the survey calls it. */
int64_t hm_quality_place(const struct hm_quality *q, double x, double y, int32_t *hint,
                         enum hm_survey_place *place);

/* The name of a stratum: class 2, region 7, a zone's own. */
void hm_quality_stratum(const struct hm_quality *q, int64_t key, char *name, size_t size);

#endif
