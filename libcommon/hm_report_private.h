/* Parts of hm_report: text, and the pages of it. Layer 6. */
#ifndef HM_REPORT_PRIVATE_H
#define HM_REPORT_PRIVATE_H

#include "hm_report.h"

/* Where text goes, and the first failure on the way. */
struct hm_report_page {
    struct hm_writer *w;
    enum hm_err err;
    struct hm_diag *d;
};

void hm_say(struct hm_report_page *page, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

void hm_report_survey(struct hm_report_page *page, const struct hm_quality *q);
void hm_report_lines(struct hm_report_page *page, const struct hm_fidelity *f);
void hm_report_elements(struct hm_report_page *page, const struct hm_quality *q);
void hm_report_histograms(struct hm_report_page *page, const struct hm_meshstat *s);

#endif
