/* hm_zone: parts of the ground with names, closed lines with zone=NAME. Layer 4. */
#ifndef HM_ZONE_H
#define HM_ZONE_H

#include "hm_rings.h"

/* Begins life as `= {0}`, owns what its pointers hold, and is emptied by hm_zones_free. */
struct hm_zones {
    struct hm_lines ring;
    int64_t *first; /* of each ring: the first of its name */
    struct hm_rings *index;
};

/* Add copies of the zones among these lines. HM_EGEOM with the place when one is not closed or has
 * fewer than three vertices. */
enum hm_err hm_zones_take(struct hm_zones *z, const struct hm_lines *lines, struct hm_diag *d);
void hm_zones_free(struct hm_zones *z);

/* The first zone of the name of the last zone that has (x, y) inside or on it; -1 when there is
 * none. */
int64_t hm_zones_find(const struct hm_zones *z, double x, double y);

/* "elsewhere" of -1. */
void hm_zones_name(const struct hm_zones *z, int64_t zone, char *name, size_t size);

#endif
