#include "hm_header.h"

#include "hm_crs.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *hm_kind_name(enum hm_kind kind)
{
    switch (kind) {
    case HM_POINTS:
        return "points";
    case HM_GRID:
        return "grid";
    case HM_LINES:
        return "lines";
    case HM_MESH:
        return "mesh";
    default:
        return "object";
    }
}

/* Append a copy of text to a list of *n strings. */
static enum hm_err append(char ***list, size_t *n, const char *text, struct hm_diag *d)
{
    char **grown = realloc(*list, (*n + 1) * sizeof **list);
    if (!grown)
        return hm_fail_memory(d);
    *list = grown;
    grown[*n] = strdup(text);
    if (!grown[*n])
        return hm_fail_memory(d);
    ++*n;
    return HM_OK;
}

static void free_list(char **list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        free(list[i]);
    free(list);
}

enum hm_err hm_header_init(struct hm_header *h, enum hm_kind kind, struct hm_diag *d)
{
    static const char *const xyz[] = {"x", "y", "z"};
    memset(h, 0, sizeof *h);
    h->kind = kind;
    h->count = -1;
    for (size_t i = 0; i < 3 && kind != HM_MESH; i++) {
        enum hm_err err = append(&h->fields, &h->nfields, xyz[i], d);
        if (err) {
            hm_header_free(h);
            return err;
        }
    }
    return HM_OK;
}

void hm_header_free(struct hm_header *h)
{
    free_list(h->fields, h->nfields);
    free_list(h->history, h->nhistory);
    for (size_t i = 0; i < h->nkeys; i++) {
        free(h->keys[i].name);
        free(h->keys[i].value);
    }
    free(h->keys);
    memset(h, 0, sizeof *h);
}

enum hm_err hm_header_copy(struct hm_header *to, const struct hm_header *from, struct hm_diag *d)
{
    memset(to, 0, sizeof *to);
    to->kind = from->kind;
    to->lattice = from->lattice;
    to->count = from->count;
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < from->nfields && !err; i++)
        err = append(&to->fields, &to->nfields, from->fields[i], d);
    for (size_t i = 0; i < from->nkeys && !err; i++)
        err = hm_header_add(to, from->keys[i].name, from->keys[i].value, d);
    for (size_t i = 0; i < from->nhistory && !err; i++)
        err = append(&to->history, &to->nhistory, from->history[i], d);
    if (err)
        hm_header_free(to);
    return err;
}

/* Index of a key, nkeys when it is not there. */
static size_t find(const struct hm_header *h, const char *name)
{
    size_t i = 0;
    while (i < h->nkeys && strcmp(h->keys[i].name, name))
        i++;
    return i;
}

const char *hm_header_get(const struct hm_header *h, const char *name)
{
    size_t i = find(h, name);
    return i < h->nkeys ? h->keys[i].value : NULL;
}

/* A key is one line of the header: a line break in it would begin another. */
static enum hm_err check_key(const char *name, const char *value, struct hm_diag *d)
{
    if (!strpbrk(name, "\r\n") && !strpbrk(value, "\r\n"))
        return HM_OK;
    return hm_fail(d, HM_EARG, "a line break in the header line #%.*s", (int)strcspn(name, "\r\n"),
                   name);
}

enum hm_err hm_header_add(struct hm_header *h, const char *name, const char *value,
                          struct hm_diag *d)
{
    enum hm_err err = check_key(name, value, d);
    if (err)
        return err;
    struct hm_key *grown = realloc(h->keys, (h->nkeys + 1) * sizeof *grown);
    if (!grown)
        return hm_fail_memory(d);
    h->keys = grown;
    struct hm_key key = {strdup(name), strdup(value)};
    if (!key.name || !key.value) {
        free(key.name);
        free(key.value);
        return hm_fail_memory(d);
    }
    h->keys[h->nkeys++] = key;
    return HM_OK;
}

static void remove_key(struct hm_header *h, size_t i)
{
    free(h->keys[i].name);
    free(h->keys[i].value);
    memmove(h->keys + i, h->keys + i + 1, (h->nkeys - i - 1) * sizeof *h->keys);
    h->nkeys--;
}

enum hm_err hm_header_set(struct hm_header *h, const char *name, const char *value,
                          struct hm_diag *d)
{
    size_t i = find(h, name);
    if (!value) {
        for (; i < h->nkeys; i = find(h, name))
            remove_key(h, i);
        return HM_OK;
    }
    if (i == h->nkeys)
        return hm_header_add(h, name, value, d);
    enum hm_err err = check_key(name, value, d);
    if (err)
        return err;
    char *copy = strdup(value); /* first: value may be the one that is replaced */
    if (!copy)
        return hm_fail_memory(d);
    free(h->keys[i].value);
    h->keys[i].value = copy;
    return HM_OK;
}

int hm_header_field(const struct hm_header *h, const char *name)
{
    for (size_t i = 0; i < h->nfields; i++)
        if (!strcmp(h->fields[i], name))
            return (int)i;
    return -1;
}

enum hm_err hm_header_add_history(struct hm_header *h, const char *line, struct hm_diag *d)
{
    return append(&h->history, &h->nhistory, line, d);
}

/* The i-th word of text (NULL: no words), copied to word[size]; false when there are fewer. */
static bool nth_word(const char *text, size_t i, char *word, size_t size)
{
    static const char blanks[] = " \t";
    for (const char *s = text ? text : "";; i--) {
        s += strspn(s, blanks);
        size_t n = strcspn(s, blanks);
        if (n == 0)
            return false;
        if (i == 0) {
            snprintf(word, size, "%.*s", (int)(n < size ? n : size - 1), s);
            return true;
        }
        s += n;
    }
}

enum { UNIT_SIZE = 64 };

/* Unit that a field has when nobody said one. */
static const char *usual_unit(const char *field)
{
    return strlen(field) == 1 && strchr("xyz", field[0]) ? "m" : "1";
}

void hm_header_unit(const struct hm_header *h, size_t column, char *unit, size_t size)
{
    if (nth_word(hm_header_get(h, "units"), column, unit, size))
        return;
    /* the columns of a mesh have no names */
    const char *field = column < h->nfields ? h->fields[column] : column < 3 ? "x" : "";
    snprintf(unit, size, "%s", usual_unit(field));
}

static char *join_units(char *units, const char *unit)
{
    size_t old = units ? strlen(units) : 0;
    char *longer = realloc(units, old + strlen(unit) + 2);
    if (!longer) {
        free(units);
        return NULL;
    }
    sprintf(longer + old, "%s%s", old ? " " : "", unit);
    return longer;
}

enum hm_err hm_header_add_field(struct hm_header *h, const char *name, const char *unit,
                                struct hm_diag *d)
{
    const char *known = hm_header_get(h, "units");
    enum hm_err err = HM_OK;
    if (known || unit) {
        char *units = NULL, word[UNIT_SIZE];
        for (size_t i = 0; i < h->nfields; i++) {
            bool said = nth_word(known, i, word, sizeof word);
            units = join_units(units, said ? word : usual_unit(h->fields[i]));
            if (!units)
                return hm_fail_memory(d);
        }
        units = join_units(units, unit ? unit : "1");
        err = units ? hm_header_set(h, "units", units, d) : hm_fail_memory(d);
        free(units);
    }
    return err ? err : append(&h->fields, &h->nfields, name, d);
}

/* Give h, which has no units, those of the fields that `from` has too. A mesh has the units of
 * x y z. */
static enum hm_err merge_units(struct hm_header *h, const struct hm_header *from, struct hm_diag *d)
{
    static const char *const xyz[] = {"x", "y", "z"};
    const char *known = hm_header_get(from, "units");
    size_t n = h->kind == HM_MESH ? 3 : h->nfields;
    char *units = NULL, word[UNIT_SIZE];
    for (size_t i = 0; i < n; i++) {
        const char *field = h->kind == HM_MESH ? xyz[i] : h->fields[i];
        int column = from->kind == HM_MESH ? (i < 3 ? (int)i : -1) : hm_header_field(from, field);
        bool said = column >= 0 && nth_word(known, (size_t)column, word, sizeof word);
        units = join_units(units, said ? word : usual_unit(field));
        if (!units)
            return hm_fail_memory(d);
    }
    enum hm_err err = units ? hm_header_set(h, "units", units, d) : HM_OK;
    free(units);
    return err;
}

/* How often the line stands among the first n of the history. */
static size_t count_history(const struct hm_header *h, size_t n, const char *line)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        count += !strcmp(h->history[i], line);
    return count;
}

/* A line that stands k times in one of the two histories and fewer in the other stands k times
 * afterwards: what both have is their common past, what one has several times it did several times.
 */
static enum hm_err merge_history(struct hm_header *h, const struct hm_header *from,
                                 struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    size_t had = h->nhistory;
    for (size_t i = 0; i < from->nhistory && !err; i++) {
        const char *line = from->history[i];
        if (count_history(from, i + 1, line) > count_history(h, had, line))
            err = hm_header_add_history(h, line, d);
    }
    return err;
}

/* Both say units of x, y and z, and these differ: their coordinates cannot go together. */
static bool units_differ(const struct hm_header *h, const struct hm_header *from)
{
    char a[UNIT_SIZE], b[UNIT_SIZE];
    const char *ours = hm_header_get(h, "units"), *theirs = hm_header_get(from, "units");
    for (size_t i = 0; i < 3; i++)
        if (nth_word(ours, i, a, sizeof a) && nth_word(theirs, i, b, sizeof b) && strcmp(a, b))
            return true;
    return false;
}

/* Keys that hold for one object alone. */
static bool is_own(const char *key)
{
    return !strcmp(key, "name") || !strcmp(key, "role") || !strcmp(key, "string") || !*key;
}

enum hm_err hm_header_merge(struct hm_header *h, const struct hm_header *from, struct hm_diag *d)
{
    const char *crs = hm_header_get(h, "crs"), *other = hm_header_get(from, "crs");
    if (crs && other && !hm_crs_same(crs, other))
        return hm_fail(d, HM_EFORMAT, "inputs differ in their crs: \"%s\" and \"%s\"", crs, other);
    if (units_differ(h, from))
        return hm_fail(d, HM_EFORMAT, "inputs differ in their units: %s and %s",
                       hm_header_get(h, "units"), hm_header_get(from, "units"));
    enum hm_err err = merge_history(h, from, d);
    size_t had = h->nkeys; /* a key that `from` has several times comes over whole */
    for (size_t i = 0; i < from->nkeys && !err; i++) {
        const char *name = from->keys[i].name;
        size_t at = find(h, name);
        if (is_own(name) || at < had)
            continue;
        if (strcmp(name, "units"))
            err = hm_header_add(h, name, from->keys[i].value, d);
        else if (at == h->nkeys)
            err = merge_units(h, from, d);
    }
    return err;
}

/* Does the lower-case text say longitude and latitude? A name of a datum alone, such as WGS84,
 * does; a projected system written as WKT has its geographic base inside and does not. */
static bool says_degrees(const char *text)
{
    static const char *const words[] = {
        "lonlat",    "longlat",   "latlon",     "latlong",   "longitude", "latitude",
        "lon/lat",   "lat/lon",   "geographic", "indegrees", "epsg:4326", "epsg4326",
        "ogc:crs84", "epsg:4258", "epsg:4269",  "epsg:4267", "epsg:4979"};
    static const char *const datums[] = {"wgs84", "wgs1984", "etrs89", "nad83",
                                         "nad27", "degree",  "degrees"};
    if (strstr(text, "projcs") || strstr(text, "projcrs") || strstr(text, "projectedcrs"))
        return false;
    if (!strncmp(text, "geogc", 5) || !strncmp(text, "geodcrs", 7))
        return true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const char *at = strstr(text, words[i]);
        if (at && !isdigit((unsigned char)at[strlen(words[i])]))
            return true;
    }
    for (size_t i = 0; i < sizeof datums / sizeof *datums; i++)
        if (!strcmp(text, datums[i]))
            return true;
    return false;
}

enum hm_err hm_header_need_metres(const struct hm_header *h, struct hm_diag *d)
{
    static const char advice[] = "metres are needed (georef projects)";
    const char *crs = hm_header_get(h, "crs");
    char text[256] = "", unit[UNIT_SIZE];
    size_t n = 0;
    for (const char *s = crs ? crs : ""; *s && n < sizeof text - 1; s++)
        if (!isspace((unsigned char)*s))
            text[n++] = (char)tolower((unsigned char)*s);
    text[n] = '\0';
    if (says_degrees(text))
        return hm_fail(d, HM_EFORMAT, "the crs \"%s\" is in longitude and latitude; %s", crs,
                       advice);
    const char *units = hm_header_get(h, "units");
    if (nth_word(units, 0, unit, sizeof unit) && !strncmp(unit, "deg", 3))
        return hm_fail(d, HM_EFORMAT, "x is in degrees (#units); %s", advice);
    return HM_OK;
}

enum hm_err hm_header_need_one_unit(const struct hm_header *h, struct hm_diag *d)
{
    const char *units = hm_header_get(h, "units");
    char unit[UNIT_SIZE], other[UNIT_SIZE];
    if (!nth_word(units, 0, unit, sizeof unit))
        return HM_OK;
    for (size_t i = 1; i < 3; i++)
        if (nth_word(units, i, other, sizeof other) && strcmp(unit, other))
            return hm_fail(d, HM_EFORMAT,
                           "x is in %s, %s in %s: one unit is needed (georef -t same converts)",
                           unit, i == 1 ? "y" : "z", other);
    return HM_OK;
}
