/* Bare tables of points: `x y z …` between blanks or commas, `#` comments, one line of names. */
#include "hm_reader_private.h"

#include "hm_row.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

struct table {
    size_t columns;
    size_t *field; /* column i goes to this field of a point */
    bool comma;    /* between columns, else blanks */
    bool plain;    /* column i is field i, all of them, between blanks */
    double *v;     /* one line of the table */
};

static void free_table(void *state)
{
    struct table *t = state;
    free(t->field);
    free(t->v);
    free(t);
}

/* The next line that is neither comment nor blank. HM_END at the end of the input, or where an
 * object of the project begins. */
static enum hm_err next_line(struct hm_reader *r, const char **s, const char **end,
                             struct hm_diag *d)
{
    enum hm_err err;
    while (!(err = hm_input_line(&r->in, s, end, d))) {
        const char *at = hm_row_skip(*s, *end);
        if (at < *end && *at != '#')
            return HM_OK;
        if (hm_row_begins(*s, *end, "#hm")) {
            hm_input_unread(&r->in);
            return HM_END;
        }
    }
    return err;
}

/* --- names --- */

/* The columns that are x, y and z by their names, in any case. */
static const char *const known[3][8] = {
    {"x", "easting", "east", "lon", "longitude", "rechtswert", "ostwert", NULL},
    {"y", "northing", "north", "lat", "latitude", "hochwert", "nordwert", NULL},
    {"z", "elevation", "height", "elev", "altitude", "höhe", "hoehe", NULL}};

static bool is_coordinate(const char *name, int k)
{
    for (size_t i = 0; known[k][i]; i++)
        if (!strcasecmp(name, known[k][i]))
            return true;
    return false;
}

/* A name as a field may have it: quotes off, lower case, no blanks inside. NULL: it is none, or
 * there is no memory. */
static char *clean_name(const char *s, const char *end)
{
    if (end - s > 1 && *s == '"' && end[-1] == '"') {
        s++;
        end--;
    }
    if (s == end || (!isalpha((unsigned char)*s) && *s != '_') || !hm_row_is_text(s, end))
        return NULL;
    char *name = strndup(s, (size_t)(end - s));
    for (char *c = name; c && *c; c++)
        *c = *c == ' ' || *c == '\t' ? '_' : (char)tolower((unsigned char)*c);
    return name;
}

/* Put the names of a line into h->fields. HM_EFORMAT, without diagnostic, when they are none. */
static enum hm_err read_names(struct hm_header *h, const char *s, const char *end,
                              struct hm_diag *d)
{
    bool comma = memchr(s, ',', (size_t)(end - s)) != NULL;
    enum hm_err err = HM_OK;
    while (s && !err) {
        const char *stop = hm_row_field(&s, end, comma);
        char *name = clean_name(s, stop);
        err = name ? hm_header_add_field(h, name, NULL, d) : HM_EFORMAT;
        free(name);
        s = hm_row_next(stop, end, comma);
    }
    return err;
}

static enum hm_err fail_names(struct hm_reader *r, const char *what, char **names, size_t n,
                              struct hm_diag *d)
{
    char list[HM_DIAG_TEXT / 2] = "";
    for (size_t i = 0, at = 0; i < n && at + strlen(names[i]) + 2 < sizeof list; i++)
        at += (size_t)sprintf(list + at, "%s%s", i > 0 ? " " : "", names[i]);
    return hm_input_fail(&r->in, HM_EFORMAT, d, "no column is named as %s: %s", what, list);
}

/* Which columns are x, y and z: by their names. Where x and y have no name that is known, the first
 * three in this order; of three columns z is the one that is left. More columns are not guessed
 * at: what is silently no height spoils all that follows. */
static enum hm_err place_columns(struct hm_reader *r, size_t columns, char **names, size_t place[3],
                                 struct hm_diag *d)
{
    for (size_t k = 0; k < 3; k++)
        place[k] = k;
    if (!names)
        return HM_OK;
    for (int k = 0; k < 3; k++)
        for (place[k] = 0; place[k] < columns && !is_coordinate(names[place[k]], k);)
            place[k]++;
    bool x = place[0] < columns, y = place[1] < columns, z = place[2] < columns;
    if (x != y && columns > 3)
        return fail_names(r, x ? "y is (y, northing ...)" : "x is (x, easting ...)", names, columns,
                          d);
    if (!x || !y)
        for (size_t k = 0; k < 3; k++)
            place[k] = k;
    else if (!z && columns == 3)
        place[2] = 3 - place[0] - place[1];
    else if (!z && columns > 3)
        return fail_names(r, "a height is (z, height, elevation ...)", names, columns, d);
    return HM_OK;
}

/* Fields x y z from their columns, then the others. */
static enum hm_err map_columns(struct hm_reader *r, struct table *t, struct hm_header *h,
                               char **names, struct hm_diag *d)
{
    size_t place[3];
    enum hm_err err = place_columns(r, t->columns, names, place, d);
    if (err)
        return err;
    if (names && !strncasecmp(names[place[0]], "lon", 3))
        err = hm_header_add(h, "crs", "longitude latitude", d);
    for (size_t i = 0; i < t->columns && !err; i++) {
        char number[24];
        size_t k = 0;
        while (k < 3 && place[k] != i)
            k++;
        t->field[i] = k < 3 ? k : h->nfields;
        snprintf(number, sizeof number, "c%zu", i + 1);
        if (k == 3)
            err = hm_header_add_field(h, names ? names[i] : number, NULL, d);
    }
    t->plain = !t->comma && t->columns == h->nfields;
    for (size_t i = 0; i < t->columns; i++)
        t->plain = t->plain && t->field[i] == i;
    return err;
}

/* --- the table --- */

static bool begins_with_number(const char *s, const char *end, bool comma)
{
    double v;
    const char *stop = hm_row_field(&s, end, comma);
    return s < stop && hm_num_parse(s, stop, &v) == stop;
}

/* Go on to the first line with numbers, over the names above it, when there are some. */
static enum hm_err find_data(struct hm_reader *r, struct table *t, struct hm_header *names,
                             struct hm_diag *d)
{
    for (int i = 0;; i++) {
        const char *s, *end;
        char word[HM_ROW_WORD];
        enum hm_err err = next_line(r, &s, &end, d);
        if (err == HM_END)
            return hm_input_fail(&r->in, HM_EFORMAT, d, "no data, and no format that is known");
        if (err)
            return err;
        t->comma = memchr(s, ',', (size_t)(end - s)) != NULL;
        if (begins_with_number(s, end, t->comma)) {
            t->columns = hm_row_count(s, end, t->comma);
            return HM_OK;
        }
        err = i > 0 ? HM_EFORMAT : read_names(names, s, end, d);
        if (err == HM_EFORMAT)
            hm_input_fail(&r->in, err, d, "neither numbers nor a format that is known: \"%s\"%s",
                          hm_row_word(word, s, end), r->foreign ? "" : "; hmconv reads more");
        if (err)
            return err;
    }
}

static enum hm_err start(struct hm_reader *r, struct table *t, struct hm_header *h,
                         struct hm_header *names, struct hm_diag *d)
{
    enum hm_err err = find_data(r, t, names, d);
    if (err)
        return err;
    if (t->columns < 2)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "expected at least the numbers x y, got 1");
    if (t->columns > HM_MAX_FIELDS)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "more than %d columns", HM_MAX_FIELDS);
    if (names->nfields > 0 && names->nfields != t->columns)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "%zu names above %zu columns", names->nfields,
                             t->columns);
    hm_input_unread(&r->in);
    t->field = hm_alloc(t->columns, sizeof *t->field);
    t->v = hm_alloc(t->columns, sizeof *t->v);
    if (!t->field || !t->v)
        return hm_fail_memory(d);
    return map_columns(r, t, h, names->nfields > 0 ? names->fields : NULL, d);
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct hm_header names = {.kind = HM_MESH}; /* a list of names, no more */
    r->state = hm_alloc0(1, sizeof(struct table));
    if (!r->state)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_init(h, HM_POINTS, d);
    if (!err)
        err = start(r, r->state, h, &names, d);
    hm_header_free(&names);
    return err;
}

/* One line, in whatever order its columns are, to a point. */
static bool parse(const struct table *t, const char *s, const char *end, double *point)
{
    if (t->comma ? !hm_row_parse_commas(s, end, t->v, t->columns)
                 : !hm_row_parse(s, end, t->v, t->columns))
        return false;
    point[2] = NAN;
    for (size_t i = 0; i < t->columns; i++)
        point[t->field[i]] = t->v[i];
    return true;
}

static enum hm_err read_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                               struct hm_diag *d)
{
    const struct table *t = r->state;
    enum hm_err err = t->plain ? hm_reader_plain_points(r, rows, max, n, d) : HM_OK;
    if (err)
        return err;
    for (; *n < max; ++*n) {
        const char *s, *end;
        double *v = rows + *n * r->nfields;
        err = hm_input_line(&r->in, &s, &end, d);
        if (!err && t->plain && hm_row_parse(s, end, v, t->columns) && hm_reader_good_place(v))
            continue;
        if (!err)
            hm_input_unread(&r->in); /* and look at it more closely */
        err = next_line(r, &s, &end, d);
        if (err == HM_END) {
            r->ended = true;
            return *n > 0 ? HM_OK : HM_END;
        }
        if (err)
            return err;
        if (*hm_row_skip(s, end) == '>')
            return hm_input_fail(&r->in, HM_EFORMAT, d,
                                 "'>' in a table of points; a file of lines begins with it");
        if (!parse(t, s, end, v))
            return hm_row_fail(&r->in, s, end, t->columns, t->comma, d);
        if (!hm_reader_good_place(v))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", hm_reader_bad_place(v));
    }
    return HM_OK;
}

const struct hm_reader_form hm_reader_table = {
    .begin = begin, .points = read_points, .free = free_table};
