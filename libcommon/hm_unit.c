#include "hm_unit.h"

#include <string.h>
#include <strings.h>

const struct hm_unit hm_unit[HM_UNITS] = {{"m", 1, 1}, {"ft", 381, 1250}, {"us-ft", 1200, 3937}};

const struct hm_unit *hm_unit_find(const char *name, size_t n)
{
    static const char *const names[HM_UNITS][6] = {
        {"m", "metre", "metres", "meter", "meters", NULL},
        {"ft", "foot", "feet", "ift", NULL},
        {"us-ft", "usft", "ftus", "us_survey_foot", NULL}};
    for (size_t i = 0; i < HM_UNITS; i++)
        for (size_t k = 0; names[i][k]; k++)
            if (strlen(names[i][k]) == n && !strncasecmp(names[i][k], name, n))
                return &hm_unit[i];
    return NULL;
}

enum hm_err hm_unit_of(const struct hm_header *h, size_t column, const struct hm_unit **unit,
                       struct hm_diag *d)
{
    const char *word = hm_header_get(h, "units");
    size_t length = 0;
    *unit = &hm_unit[HM_UNIT_M];
    for (size_t i = 0; word; i++) {
        word += strspn(word, " \t");
        length = strcspn(word, " \t");
        if (i == column || length == 0)
            break;
        word += length;
    }
    if (!word || length == 0)
        return HM_OK;
    *unit = hm_unit_find(word, length);
    return *unit ? HM_OK
                 : hm_fail(d, HM_EFORMAT, "the unit '%.*s' is not known", (int)length, word);
}

enum hm_err hm_unit_metres(const struct hm_header *h, double metres[2], struct hm_diag *d)
{
    const struct hm_unit *unit[3] = {NULL};
    for (size_t i = 0; i < 3; i++) {
        enum hm_err err = hm_unit_of(h, i, &unit[i], d);
        if (err)
            return err;
    }
    if (unit[0] != unit[1])
        return hm_fail(d, HM_EFORMAT, "x is in %s, y in %s", unit[0]->name, unit[1]->name);
    metres[0] = unit[0]->num / unit[0]->den;
    metres[1] = unit[2]->num / unit[2]->den;
    return HM_OK;
}
