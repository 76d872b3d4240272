/* hm_report: what is known about the quality of a mesh, told to people (text) and programs (JSON;
 * man/quality.schema.json is its schema). Layer 6.
 */
#ifndef HM_REPORT_H
#define HM_REPORT_H

#include "hm_criterion.h"
#include "hm_writer.h"

struct hm_report {
    const struct hm_quality *mesh, *other; /* other: to compare with, or NULL */
    const struct hm_criterion *criterion;  /* what the user asked for, judged */
    size_t ncriteria;
};

enum hm_err hm_report_text(const struct hm_report *r, struct hm_writer *w, struct hm_diag *d);
enum hm_err hm_report_json(const struct hm_report *r, struct hm_writer *w, struct hm_diag *d);

#endif
