/* Parts of georef: what is done to the places of an object, and references read as points. */
#ifndef GEOREF_H
#define GEOREF_H

#include "hm_cli.h"
#include "hm_geod.h"
#include "hm_unit.h"

/* What becomes of a place: units to metres, to longitude and latitude, the height, to the target,
 * metres to units. */
struct plan {
    bool known;                   /* the systems are; else only units change */
    struct hm_crs source, target; /* when known */
    struct hm_geod *from, *to;    /* NULL: nothing to do there */
    const struct hm_geoid *geoid; /* NULL: heights stay on what they are */
    double geoid_sign;            /* times the height of the geoid is added */
    const struct hm_unit *in_xy, *in_z, *out_xy, *out_z;
};

/* Extent in longitude and latitude of what passed; longitudes run on beyond 180 from the first. */
struct extent {
    bool any;
    double west, east, south, north;
};

/* Read the rest of the object of which `h` is the header, carry its places over, and write it.
 * The header of the product is h as it stands. extent may be NULL. */
enum hm_err georef_carry(struct hm_reader *r, const struct hm_header *h, struct hm_writer *w,
                         const struct plan *plan, int threads, struct extent *extent,
                         struct hm_diag *d);

/* Read a table `reference z …` and write it as points of longitude and latitude. */
enum hm_err georef_read_mgrs(const char *path, struct hm_writer *w, struct extent *extent,
                             struct hm_diag *d);

void georef_extend(struct extent *e, const double *rows, size_t n, size_t stride);

#endif
