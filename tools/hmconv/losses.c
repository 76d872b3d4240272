/* What the format asked for has no place for, said and counted. */
#include "hmconv.h"

#include "hm_crs.h"

#include <string.h>

static bool loses_crs(int lacks, const char *crs)
{
    struct hm_crs system;
    if (lacks & CRS_OF_EPSG)
        return hm_crs_epsg(crs) == 0;
    if (lacks & CRS_OF_UTM)
        return !hm_crs_parse(&system, crs) || system.kind != HM_CRS_UTM;
    return lacks & NO_CRS;
}

/* Each once. Degrees are said by the crs. */
void hmconv_say_header(const struct job *j, const struct hm_header *h)
{
    static bool crs_said, unit_said;
    const char *crs = hm_header_get(h, "crs"), *name = j->to->name;
    char unit[16];
    hm_header_unit(h, 0, unit, sizeof unit);
    bool no_crs = crs && loses_crs(j->to->lacks, crs);
    bool no_unit = strcmp(unit, "m") && strcmp(unit, "degree") && j->to->way != STREAM;
    if (no_crs && !crs_said)
        hm_cli_say(j->cli, "%s has no place for the crs: \"%s\" dropped%s", name, crs,
                   strcmp(name, "asc") ? "" : " (-t prj writes it)");
    if (no_unit && !unit_said)
        hm_cli_say(j->cli, "%s has no units: coordinates stay in %s", name, unit);
    crs_said |= no_crs;
    unit_said |= no_unit;
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
