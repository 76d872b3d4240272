/* hm_quality: what is known about the quality of a mesh, as measures with names, judged by
 * criteria, and told to people (text) or programs (JSON). Layer 6.
 */
#ifndef HM_QUALITY_H
#define HM_QUALITY_H

#include "hm_meshcheck.h"
#include "hm_meshstat.h"
#include "hm_residual.h"
#include "hm_writer.h"

enum { HM_QUALITY_WORST = 10 };

/* A sample of the measurements: one row of the paper's Table 2. */
struct hm_sample {
    double percent;
    struct hm_residuals residuals;
};

struct hm_quality {
    const struct hm_mesh *mesh; /* the caller's */
    double thresholds[2];       /* of the classes, metres */
    int64_t seed;               /* of the samples */
    bool surveyed;              /* measurements were given; all down to `worst` is about them */
    int64_t points;             /* all measurements */
    int64_t heightless;         /* without z */
    int64_t outside;            /* not on the mesh, its border counted as on */
    int64_t unknown;            /* on the mesh, where its nodes have no height */
    struct hm_sample *sample;   /* owned; the last one holds all compared points */
    size_t nsamples;
    struct hm_residual worst[HM_QUALITY_WORST]; /* largest |r| first, of equals the earlier */
    size_t nworst;
    struct hm_meshstat shape;
    struct hm_meshcheck check;
};

/* Samples of n percentages, and all; the rest of q is cleared. */
enum hm_err hm_quality_init(struct hm_quality *q, const double *percent, size_t n, int64_t seed,
                            const double thresholds[2], struct hm_diag *d);
void hm_quality_free(struct hm_quality *q);

/* Count in a residual; ordinal is the number of its point among all measurements, from 0. */
void hm_quality_add(struct hm_quality *q, struct hm_residual r, int64_t ordinal);

/* --- criteria --- */

/* `rmse<=0.15`: measure, comparison (< <= > >=), bound. `valid` alone: a measure that is not 0. */
struct hm_criterion {
    int measure;
    int comparison;
    double bound;
    bool met;     /* hm_quality_judge writes */
    double value; /* these two; NaN (never met) when there is nothing to measure */
};

/* Criteria with commas between. HM_EARG names the mistake, and for an unknown measure all that
 * there are. *list is malloc'd. */
enum hm_err hm_criteria_parse(const char *text, struct hm_criterion **list, size_t *n,
                              struct hm_diag *d);

/* Are all met? */
bool hm_quality_judge(const struct hm_quality *q, struct hm_criterion *list, size_t n);

/* The criterion as text: "rmse <= 0.15 m". */
void hm_criterion_print(const struct hm_criterion *c, char *text, size_t size);

/* --- reports --- */

/* `list` holds the criteria that the user asked for, judged. */
enum hm_err hm_quality_text(const struct hm_quality *q, const struct hm_criterion *list, size_t n,
                            struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_quality_json(const struct hm_quality *q, const struct hm_criterion *list, size_t n,
                            struct hm_writer *w, struct hm_diag *d);

#endif
