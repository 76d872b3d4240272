#include "hm_lascrs.h"

#include "hm_num.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Records of the user id LASF_Projection. */
enum { GEO_KEYS = 34735, GEO_NAMES = 34737, WKT = 2112 };

static enum hm_err keep(char **to, size_t *have, const char *bytes, size_t n, struct hm_diag *d)
{
    char *copy = hm_alloc(n, 1);
    if (!copy)
        return hm_fail_memory(d);
    memcpy(copy, bytes, n);
    free(*to);
    *to = copy;
    *have = n;
    return HM_OK;
}

enum hm_err hm_lascrs_take(struct hm_lascrs *c, const char user[16], size_t number,
                           const char *bytes, size_t n, struct hm_diag *d)
{
    if (strncmp(user, "LASF_Projection", 16) != 0)
        return HM_OK;
    if (number == GEO_KEYS)
        return keep(&c->keys, &c->nkeys, bytes, n, d);
    if (number == GEO_NAMES)
        return keep(&c->names, &c->nnames, bytes, n, d);
    return number == WKT ? keep(&c->wkt, &c->nwkt, bytes, n, d) : HM_OK;
}

void hm_lascrs_free(struct hm_lascrs *c)
{
    free(c->keys);
    free(c->names);
    free(c->wkt);
    *c = (struct hm_lascrs){0};
}

/* Text of a file as it can stand in a header: one line of printable characters. */
static void copy_text(char *to, size_t size, const char *from, size_t n)
{
    size_t kept = 0;
    for (size_t k = 0; k < n && from[k] && kept + 1 < size; k++) {
        unsigned char c = (unsigned char)from[k];
        to[kept++] = c < ' ' || c == 127 ? ' ' : (char)c;
    }
    while (kept > 0 && to[kept - 1] == ' ')
        kept--;
    to[kept] = 0;
}

static const char *unit_of_size(double metres)
{
    if (fabs(metres - 1) < 1e-9)
        return "m";
    if (fabs(metres - 0.3048) < 1e-8)
        return "ft";
    return fabs(metres - 1200.0 / 3937) < 1e-8 ? "us-ft" : "";
}

/* --- GeoTIFF keys: a table of (key, where, count, value), behind a row that counts them --- */

enum {
    MODEL = 1024, /* 1: projected, 2: longitude and latitude */
    CITATION = 1026,
    GEOGRAPHIC = 2048,
    PROJECTED = 3072,
    PROJECTED_CITATION = 3073,
    LINEAR_UNIT = 3076,
    VERTICAL_UNIT = 4099,
    USER_DEFINED = 32767
};

static unsigned get_u16(const struct hm_lascrs *c, size_t k)
{
    const unsigned char *u = (const unsigned char *)c->keys + 2 * k;
    return (unsigned)(u[0] | u[1] << 8);
}

/* Row of a key in the table, or 0 when it is not there. */
static size_t find_key(const struct hm_lascrs *c, unsigned key)
{
    size_t rows = c->nkeys >= 8 ? get_u16(c, 3) : 0;
    for (size_t r = 1; r <= rows && 8 * (r + 1) <= c->nkeys; r++)
        if (get_u16(c, 4 * r) == key)
            return r;
    return 0;
}

/* Value of a key that is a number; 0 when it is not there. */
static unsigned key_number(const struct hm_lascrs *c, unsigned key)
{
    size_t r = find_key(c, key);
    return r && get_u16(c, 4 * r + 1) == 0 ? get_u16(c, 4 * r + 3) : 0;
}

static void key_text(const struct hm_lascrs *c, unsigned key, char *to, size_t size)
{
    size_t r = find_key(c, key);
    if (!r || get_u16(c, 4 * r + 1) != GEO_NAMES)
        return;
    size_t n = get_u16(c, 4 * r + 2), from = get_u16(c, 4 * r + 3);
    if (from + n > c->nnames)
        return;
    if (n > 0 && c->names[from + n - 1] == '|')
        n--;
    copy_text(to, size, c->names + from, n);
}

/* A unit of length by its EPSG code. */
static const char *unit_of_code(unsigned code)
{
    return code == 9001 ? "m" : code == 9002 ? "ft" : code == 9003 ? "us-ft" : "";
}

static void say_keys(const struct hm_lascrs *c, struct hm_lascrs_said *said)
{
    bool degrees = key_number(c, MODEL) == 2;
    unsigned code = key_number(c, degrees ? GEOGRAPHIC : PROJECTED);
    if (code > 0 && code != USER_DEFINED) {
        snprintf(said->crs, sizeof said->crs, "EPSG:%u", code);
    } else {
        key_text(c, PROJECTED_CITATION, said->crs, sizeof said->crs);
        if (!*said->crs)
            key_text(c, CITATION, said->crs, sizeof said->crs);
    }
    strcpy(said->unit, degrees ? "degree" : unit_of_code(key_number(c, LINEAR_UNIT)));
    strcpy(said->z_unit, unit_of_code(key_number(c, VERTICAL_UNIT)));
}

/* --- WKT: KEYWORD["name", part, …], parts being of the same form --- */

/* A stretch of text. */
struct part {
    const char *s, *end;
};

/* Where the bracket opened at s closes; end when it does not. */
static const char *closing(const char *s, const char *end)
{
    int depth = 0;
    bool quoted = false;
    for (; s < end; s++) {
        quoted ^= *s == '"';
        if (quoted)
            continue;
        depth += (*s == '[' || *s == '(') - (*s == ']' || *s == ')');
        if (depth == 0)
            return s;
    }
    return end;
}

/* Take the next part between commas off the list; false at its end. */
static bool next_part(struct part *list, struct part *part)
{
    const char *s = list->s;
    while (s < list->end && (*s == ',' || *s == ' ' || *s == '\n' || *s == '\r' || *s == '\t'))
        s++;
    if (s >= list->end)
        return false;
    part->s = s;
    for (bool quoted = false; s < list->end && (quoted || *s != ','); s++) {
        quoted ^= *s == '"';
        if (!quoted && (*s == '[' || *s == '(')) {
            s = closing(s, list->end);
            if (s == list->end)
                break;
        }
    }
    part->end = list->s = s;
    return true;
}

/* Is the part KEYWORD[…]? Then *inside is the list in its brackets. */
static bool is_called(struct part part, const char *keyword, struct part *inside)
{
    size_t n = strlen(keyword), size = (size_t)(part.end - part.s);
    if (size < n + 2 || memcmp(part.s, keyword, n) != 0 || (part.s[n] != '[' && part.s[n] != '('))
        return false;
    *inside = (struct part){part.s + n + 1, closing(part.s + n, part.end)};
    return true;
}

/* Find a part by one of two keywords, at this level or below. */
static bool find_part(struct part list, const char *old, const char *new, struct part *inside)
{
    enum { COMPOUNDS = 4 };
    static const char *const compound[COMPOUNDS] = {"COMPD_CS", "COMPOUNDCRS", "BOUNDCRS",
                                                    "SOURCECRS"};
    struct part part, below;
    while (next_part(&list, &part)) {
        if (is_called(part, old, inside) || is_called(part, new, inside))
            return true;
        for (int k = 0; k < COMPOUNDS; k++)
            if (is_called(part, compound[k], &below) && find_part(below, old, new, inside))
                return true;
    }
    return false;
}

static void take_quoted(struct part part, char *to, size_t size)
{
    bool quoted = part.end - part.s >= 2 && *part.s == '"' && part.end[-1] == '"';
    copy_text(to, size, part.s + quoted, (size_t)(part.end - part.s) - 2 * quoted);
}

/* EPSG code of AUTHORITY["EPSG","2154"] or ID["EPSG",2154]. */
static void take_code(struct part list, struct hm_lascrs_said *said)
{
    char who[8], code[16];
    struct part part;
    if (!next_part(&list, &part))
        return;
    take_quoted(part, who, sizeof who);
    if (strcmp(who, "EPSG") != 0 || !next_part(&list, &part))
        return;
    take_quoted(part, code, sizeof code);
    snprintf(said->crs, sizeof said->crs, "EPSG:%s", code);
}

/* UNIT["metre",1,…]: the second part is its size. */
static const char *unit_of(struct part list)
{
    struct part part;
    double size;
    if (!next_part(&list, &part) || !next_part(&list, &part) ||
        hm_num_parse(part.s, part.end, &size) != part.end)
        return "";
    return unit_of_size(size);
}

/* Name, code and unit of a system from the parts in its brackets. */
static void read_system(struct part list, struct hm_lascrs_said *said, char *unit)
{
    struct part part, inside;
    if (next_part(&list, &part))
        take_quoted(part, said->crs, sizeof said->crs);
    while (next_part(&list, &part)) {
        if (is_called(part, "AUTHORITY", &inside) || is_called(part, "ID", &inside))
            take_code(inside, said);
        else if (is_called(part, "UNIT", &inside) || is_called(part, "LENGTHUNIT", &inside))
            strcpy(unit, unit_of(inside));
    }
}

static void say_wkt(const struct hm_lascrs *c, struct hm_lascrs_said *said)
{
    struct part all = {c->wkt, c->wkt + c->nwkt}, inside;
    struct hm_lascrs_said vertical = {0};
    if (find_part(all, "PROJCS", "PROJCRS", &inside)) {
        read_system(inside, said, said->unit);
    } else if (find_part(all, "GEOGCS", "GEOGCRS", &inside)) {
        read_system(inside, said, said->unit);
        strcpy(said->unit, "degree");
    }
    if (find_part(all, "VERT_CS", "VERTCRS", &inside))
        read_system(inside, &vertical, said->z_unit);
}

void hm_lascrs_say(const struct hm_lascrs *c, struct hm_lascrs_said *said)
{
    *said = (struct hm_lascrs_said){{0}, {0}, {0}};
    if (c->nwkt > 0)
        say_wkt(c, said);
    else
        say_keys(c, said);
    /* heights are in the unit of the plane unless the file says otherwise */
    if (!*said->z_unit)
        strcpy(said->z_unit, strcmp(said->unit, "degree") ? said->unit : "m");
}
