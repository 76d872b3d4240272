/* What the format asked for has no place for, said and counted. */
#include "hmconv.h"

#include "hm_crs.h"

#include <string.h>

/* What a header says and the format cannot, each once. */
void hmconv_say_header(const struct job *j, const struct hm_header *h)
{
    static bool crs_said, units_said;
    const char *crs = hm_header_get(h, "crs"), *name = j->to->name;
    int lacks = j->to->lacks;
    bool no_crs = (lacks & NO_CRS) || (crs && (lacks & CRS_OF_EPSG) && hm_crs_epsg(crs) == 0);
    char unit[16];
    hm_header_unit(h, 0, unit, sizeof unit);
    if (crs && no_crs && !crs_said)
        hm_cli_say(j->cli, "%s has no place for the crs: \"%s\" dropped", name, crs);
    if (strcmp(unit, "m") && !units_said && j->to->way != STREAM)
        hm_cli_say(j->cli, "%s has no units: coordinates stay in %s", name, unit);
    crs_said |= crs && no_crs;
    units_said |= strcmp(unit, "m") != 0;
}

void hmconv_say_names(const struct job *j, const struct hm_header *h)
{
    for (size_t k = 3; k < h->nfields; k++)
        hm_cli_say(j->cli, "%s: %s has no names of columns: %s is attribute %zu",
                   hm_reader_name(hm_cli_reader(j->cli)), j->to->name, h->fields[k], k - 1);
}

void hmconv_say_columns(const struct job *j, const struct hm_header *h, size_t first, size_t but)
{
    for (size_t k = first; k < h->nfields; k++)
        if (k != but)
            hm_cli_say(j->cli, "%s: %s has no place for the column %s: dropped",
                       hm_reader_name(hm_cli_reader(j->cli)), j->to->name, h->fields[k]);
}

static int64_t count_strings(const struct hm_mesh *m)
{
    int64_t n = 0;
    for (size_t k = 0; k < m->header.nkeys; k++)
        n += !strcmp(m->header.keys[k].name, "string");
    return n;
}

void hmconv_say_mesh(const struct job *j, const struct hm_mesh *m)
{
    const char *name = j->to->name;
    int lacks = j->to->lacks;
    int64_t strings = count_strings(m), none = 0, some = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        none += m->elem[k].region == 0;
        some += m->elem[k].region != 0;
    }
    if ((lacks & NO_STRINGS) && strings > 0)
        hm_cli_say(j->cli, "%s has no node strings: %lld dropped", name, (long long)strings);
    if ((lacks & NO_REGIONS) && some > 0)
        hm_cli_say(j->cli, "%s has no materials: those of %lld elements dropped", name,
                   (long long)some);
    if ((lacks & FROM_ONE) && none > 0)
        hm_cli_say(j->cli, "%s has no material 0: %lld elements get the number behind the largest",
                   name, (long long)none);
    if (lacks & NO_HEIGHTS)
        hm_cli_say(j->cli, "%s has no heights: dropped", name);
    if (lacks & SEVEN_PLACES)
        hm_cli_say(j->cli, "%s has seven decimals", name);
}
