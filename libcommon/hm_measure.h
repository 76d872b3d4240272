/* hm_measure: a measure that is taken at many places: extremes, mean, histogram, the worst ten.
 * Layer 6.
 *
 *     static const struct hm_measure_kind angle = {"smallest angle", "deg", …};
 *     struct hm_measure m = {0};
 *     hm_measure_add(&m, &angle, value, x, y);        // as often as there are places
 */
#ifndef HM_MEASURE_H
#define HM_MEASURE_H

#include "hm_base.h"

enum { HM_MEASURE_BINS = 24, HM_MEASURE_WORST = 10 };

/* A value and where it was taken. */
struct hm_measured {
    double value, x, y;
};

/* Bins of the histogram: bin k holds limit[k] <= value < limit[k+1]; what lies beyond the outermost
 * limits falls into the outermost bins. */
struct hm_measure_kind {
    const char *name, *unit;
    bool small_is_bad; /* the worst are the smallest, else the largest */
    double limit[HM_MEASURE_BINS + 1];
    int bins;
};

struct hm_measure {
    int64_t n;
    double sum;
    struct hm_measured least, most;             /* of equals the first; when n > 0 */
    struct hm_measured worst[HM_MEASURE_WORST]; /* worst first, of equals the earlier ahead */
    int nworst;
    int64_t bin[HM_MEASURE_BINS];
};

/* Count in a value; NaN does not count. */
void hm_measure_add(struct hm_measure *m, const struct hm_measure_kind *kind, double value,
                    double x, double y);

/* These are NaN without values. */
double hm_measure_mean(const struct hm_measure *m);
double hm_measure_least(const struct hm_measure *m);
double hm_measure_most(const struct hm_measure *m);

#endif
