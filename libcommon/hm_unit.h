/* hm_unit: units of length. Layer 3. */
#ifndef HM_UNIT_H
#define HM_UNIT_H

#include "hm_header.h"

struct hm_unit {
    const char *name;
    double num, den; /* num / den metres; a fraction, so that 3937 survey feet are 1200 m */
};

/* "m", "ft" (international) and "us-ft" (survey foot). */
enum hm_unit_id { HM_UNIT_M, HM_UNIT_FT, HM_UNIT_US_FT, HM_UNITS };
extern const struct hm_unit hm_unit[HM_UNITS];

/* The unit of a name of n characters, of which headers of others have several (metre, feet, ftUS
 * …); NULL when it is none. */
const struct hm_unit *hm_unit_find(const char *name, size_t n);

/* What `#units` says of a column (0: x); metres when it says nothing. NULL when it is none of
 * these: HM_EFORMAT names the word. */
enum hm_err hm_unit_of(const struct hm_header *h, size_t column, const struct hm_unit **unit,
                       struct hm_diag *d);

/* What a unit of x and y, and one of z, is in metres. HM_EFORMAT as above, and when x and y differ.
 */
enum hm_err hm_unit_metres(const struct hm_header *h, double metres[2], struct hm_diag *d);

#endif
