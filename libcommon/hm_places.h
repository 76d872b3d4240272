/* hm_places: a number for every place, places told apart by the exact x and y. Layer 2.
 *
 * The identity of mesh nodes: the same when x and y are bit-equal (but -0 is 0).
 */
#ifndef HM_PLACES_H
#define HM_PLACES_H

#include "hm_base.h"

struct hm_places {
    struct hm_place *slot; /* open addressing, a power of two of slots */
    size_t slots, n;
};

/* Begins as `= {0}`. The value put in for the place earlier, or `value`, which is put in. A value
 * of 0 or more; -1 when memory is short. */
int32_t hm_places_put(struct hm_places *p, double x, double y, int32_t value);

/* The value of the place; -1 when it has none. */
int32_t hm_places_get(const struct hm_places *p, double x, double y);

void hm_places_free(struct hm_places *p);

#endif
