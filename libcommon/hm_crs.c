#include "hm_crs.h"

#include "hm_num.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* --- to text --- */

static char *put(char *p, const char *key, double v)
{
    p += sprintf(p, " %s=", key);
    p += hm_num_print(p, v);
    *p = '\0';
    return p;
}

void hm_crs_print(char text[HM_CRS_CHARS], const struct hm_crs *crs)
{
    char *p = text;
    switch (crs->kind) {
    case HM_CRS_LONLAT:
        p += sprintf(p, "longitude latitude");
        break;
    case HM_CRS_UTM:
        p += sprintf(p, "UTM %d%c", crs->zone, crs->north ? 'N' : 'S');
        break;
    case HM_CRS_UPS:
        p += sprintf(p, "UPS %c", crs->north ? 'N' : 'S');
        break;
    case HM_CRS_TM:
        p += sprintf(p, "TM");
        p = put(put(p, "lon", crs->lon), "lat", crs->lat);
        p = put(put(put(p, "scale", crs->scale), "x", crs->x0), "y", crs->y0);
        break;
    case HM_CRS_ENU:
        p += sprintf(p, "ENU");
        p = put(put(put(p, "lon", crs->lon), "lat", crs->lat), "h", crs->h);
        break;
    }
    strcpy(p, " WGS84");
}

/* --- from text --- */

/* Cut the next word off *s; its length, 0 at the end. */
static size_t next_word(const char **s, const char **word)
{
    *s += strspn(*s, " \t");
    *word = *s;
    *s += strcspn(*s, " \t");
    return (size_t)(*s - *word);
}

static bool is_word(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && !strncasecmp(word, wanted, n);
}

/* A whole number without sign; -1 when it is none. */
static int whole(const char *s, size_t n)
{
    int v = 0;
    if (n < 1 || n > 6)
        return -1;
    for (size_t i = 0; i < n; i++) {
        if (!isdigit((unsigned char)s[i]))
            return -1;
        v = 10 * v + (s[i] - '0');
    }
    return v;
}

static bool parse_zone(struct hm_crs *crs, bool *half, const char *s, size_t n)
{
    int last = n > 0 ? toupper((unsigned char)s[n - 1]) : 0;
    *crs = (struct hm_crs){.kind = HM_CRS_UTM, .north = last == 'N'};
    *half = last == 'N' || last == 'S';
    if (*half && n == 1) {
        crs->kind = HM_CRS_UPS;
        return true;
    }
    crs->zone = whole(s, *half ? n - 1 : n);
    return crs->zone >= 1 && crs->zone <= 60;
}

bool hm_crs_parse_zone(struct hm_crs *crs, bool *half, const char *text)
{
    return parse_zone(crs, half, text, strlen(text));
}

/* EPSG:32601 .. 32660 are UTM north, 32661 UPS north, 32701 .. 32761 the same of the south. */
static bool parse_epsg(struct hm_crs *crs, const char *code, size_t n)
{
    int v = whole(code, n), zone = v % 100;
    if ((v / 100 != 326 && v / 100 != 327) || zone < 1 || zone > 61)
        return false;
    *crs = (struct hm_crs){.kind = zone == 61 ? HM_CRS_UPS : HM_CRS_UTM,
                           .zone = zone == 61 ? 0 : zone,
                           .north = v / 100 == 326};
    return true;
}

/* `key=number` to where the key belongs. */
static bool parse_key(struct hm_crs *crs, const char *word, size_t n)
{
    struct {
        const char *name;
        double *value;
        bool of_tm, of_enu;
    } const keys[] = {{"lon", &crs->lon, true, true},      {"lat", &crs->lat, true, true},
                      {"scale", &crs->scale, true, false}, {"x", &crs->x0, true, false},
                      {"y", &crs->y0, true, false},        {"h", &crs->h, false, true}};
    const char *equals = memchr(word, '=', n), *end = word + n;
    if (!equals)
        return false;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if ((crs->kind == HM_CRS_TM ? keys[i].of_tm : keys[i].of_enu) &&
            is_word(word, (size_t)(equals - word), keys[i].name))
            return hm_num_parse(equals + 1, end, keys[i].value) == end && isfinite(*keys[i].value);
    return false;
}

/* What stands behind the name of the system. */
static bool parse_rest(struct hm_crs *crs, const char *s)
{
    const char *word;
    size_t n;
    bool half = false;
    if (crs->kind == HM_CRS_UTM || crs->kind == HM_CRS_UPS) {
        enum hm_crs_kind kind = crs->kind;
        n = next_word(&s, &word);
        if (!parse_zone(crs, &half, word, n) || !half || crs->kind != kind)
            return false;
    }
    while ((n = next_word(&s, &word)) > 0) {
        bool datum = is_word(word, n, "WGS84");
        bool keyed = crs->kind == HM_CRS_TM || crs->kind == HM_CRS_ENU;
        if (!datum && !(keyed && parse_key(crs, word, n)))
            return false;
    }
    return fabs(crs->lat) <= 90 && (crs->kind != HM_CRS_TM || crs->scale > 0);
}

bool hm_crs_parse(struct hm_crs *crs, const char *text)
{
    static const struct {
        const char *name;
        enum hm_crs_kind kind;
    } systems[] = {
        {"UTM", HM_CRS_UTM}, {"UPS", HM_CRS_UPS}, {"TM", HM_CRS_TM}, {"ENU", HM_CRS_ENU}};
    const char *s = text, *word;
    size_t n = next_word(&s, &word);
    *crs = (struct hm_crs){.scale = 1};
    if (n > 5 && !strncasecmp(word, "EPSG:", 5))
        return parse_epsg(crs, word + 5, n - 5) && next_word(&s, &word) == 0;
    if (is_word(word, n, "longitude")) {
        n = next_word(&s, &word);
        return is_word(word, n, "latitude") && parse_rest(crs, s);
    }
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++)
        if (is_word(word, n, systems[i].name)) {
            crs->kind = systems[i].kind;
            return parse_rest(crs, s);
        }
    return false;
}

int hm_crs_epsg(const char *text)
{
    struct hm_crs crs;
    if (!strncasecmp(text, "EPSG:", 5)) {
        int code = whole(text + 5, strlen(text + 5));
        return code > 0 ? code : 0;
    }
    if (!hm_crs_parse(&crs, text))
        return 0;
    switch (crs.kind) {
    case HM_CRS_LONLAT:
        return 4326;
    case HM_CRS_UTM:
        return (crs.north ? 32600 : 32700) + crs.zone;
    case HM_CRS_UPS:
        return crs.north ? 32661 : 32761;
    default:
        return 0;
    }
}

bool hm_crs_same(const char *a, const char *b)
{
    struct hm_crs p, q;
    char s[HM_CRS_CHARS], t[HM_CRS_CHARS];
    if (!strcmp(a, b))
        return true;
    if (!hm_crs_parse(&p, a) || !hm_crs_parse(&q, b))
        return false;
    hm_crs_print(s, &p);
    hm_crs_print(t, &q);
    return !strcmp(s, t);
}
