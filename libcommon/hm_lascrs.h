/* hm_lascrs: reference system and units of a LAS file, from its variable length records. Layer 5.
 *
 * Files of version 1.4 have them as WKT (OGC 01-009 or WKT 2), others as GeoTIFF keys. Only what a
 * header says in one line is taken: the EPSG code, else the name, and the units.
 */
#ifndef HM_LASCRS_H
#define HM_LASCRS_H

#include "hm_base.h"

enum { HM_LASCRS_TEXT = 128, HM_LASCRS_UNIT = 8 };

struct hm_lascrs {
    char *keys, *names, *wkt; /* the records themselves */
    size_t nkeys, nnames, nwkt;
};

/* A variable length record: user id (16 bytes), number, contents. Others than those of the
 * reference system are passed over. */
enum hm_err hm_lascrs_take(struct hm_lascrs *c, const char user[16], size_t number,
                           const char *bytes, size_t n, struct hm_diag *d);
void hm_lascrs_free(struct hm_lascrs *c);

/* What the records say; "" for what they do not. Units: m, ft, us-ft (1200/3937 m) or degree. */
struct hm_lascrs_said {
    char crs[HM_LASCRS_TEXT]; /* "EPSG:2154", or a name */
    char unit[HM_LASCRS_UNIT], z_unit[HM_LASCRS_UNIT];
};
void hm_lascrs_say(const struct hm_lascrs *c, struct hm_lascrs_said *said);

#endif
