/* hm_criterion: measures of quality by name, and criteria that they have to meet. Layer 6.
 */
#ifndef HM_CRITERION_H
#define HM_CRITERION_H

#include "hm_quality.h"

/* The k-th measure, from 0: its name and unit. False behind the last. */
bool hm_quality_measure(int k, const char **name, const char **unit);

/* Its value; NaN when there is nothing to measure. */
double hm_quality_value(const struct hm_quality *q, int k);

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

#endif
