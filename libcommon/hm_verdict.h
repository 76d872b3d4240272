/* hm_verdict: what accuracy standards say about residuals. Layer 6.
 *
 * FEMA          Guidelines and Specifications for Flood Hazard Mapping Partners, Appendix A, 2003:
 *               RMSE of 0.15 m, 20 check points and more
 * NSSDA         FGDC-STD-007.3-1998: accuracy is 1.96 RMSE; 20 check points
 * NDEP          Guidelines for Digital Elevation Data 1.0, 2004: the 95th percentile, where errors
 *               are not normally distributed
 * ASPRS 2023    Positional Accuracy Standards for Digital Geospatial Data, Edition 2: class by
 *               RMSE, the error of the check points included; 30 check points, twice as accurate as
 *               the class; mean error up to a quarter of the RMSE
 * the paper     section 7: red under 5 %
 */
#ifndef HM_VERDICT_H
#define HM_VERDICT_H

#include "hm_residual.h"

enum hm_judgement {
    HM_JUDGE_PASS,
    HM_JUDGE_MISS,
    HM_JUDGE_WARN /* missed, but not a reason to refuse the mesh by itself */
};

struct hm_verdict {
    enum hm_judgement judgement;
    const char *what, *source; /* constant */
    double value;              /* that was judged */
    const char *unit;
};

enum { HM_VERDICTS = 10 };

/* Judge residuals, of which there is one at least. survey_error: RMSE of the measurements
 * themselves, metres, 0 when it is not known. Returns how many verdicts there are. */
size_t hm_verdicts(const struct hm_residuals *r, double survey_error,
                   struct hm_verdict list[HM_VERDICTS]);

/* HM_JUDGE_MISS when one of these is missed, else HM_JUDGE_WARN when one warns. */
enum hm_judgement hm_verdict_worst(const struct hm_residuals *r, double survey_error);

/* "pass", "miss", "warn" */
const char *hm_judgement_name(enum hm_judgement judgement);

/* RMSE of the mesh with the survey's own error in it (ASPRS 2023), metres. */
double hm_verdict_total_rmse(const struct hm_residuals *r, double survey_error);

#endif
