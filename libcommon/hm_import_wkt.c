/* WKT: geometries one after the other, or a column of them in a table with commas, semicolons or
 * tabs between, named WKT (as ogr2ogr writes it), wkt_geom, geometry, geom or the_geom. */
#include "hm_crs.h"
#include "hm_import_private.h"
#include "hm_num.h"
#include "hm_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Rings and collections in parentheses: how deep the vertices stand. */
static const struct shape {
    const char *name;
    enum hm_shape shape;
    int depth;
} shapes[] = {{"POINT", HM_SHAPE_POINTS, 1},      {"LINESTRING", HM_SHAPE_LINE, 1},
              {"POLYGON", HM_SHAPE_RING, 2},      {"TRIANGLE", HM_SHAPE_RING, 2},
              {"MULTIPOINT", HM_SHAPE_POINTS, 1}, {"MULTILINESTRING", HM_SHAPE_LINE, 2},
              {"MULTIPOLYGON", HM_SHAPE_RING, 3}, {"POLYHEDRALSURFACE", HM_SHAPE_RING, 3},
              {"TIN", HM_SHAPE_RING, 3}};
static const char collection[] = "GEOMETRYCOLLECTION";

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static const char *skip(const char *s, const char *end)
{
    while (s < end && is_space(*s))
        s++;
    return s;
}

/* Cut a word of letters off *s; its length. */
static size_t cut_word(const char **s, const char *end, const char **word)
{
    *word = *s = skip(*s, end);
    while (*s < end && ((**s | 32) >= 'a' && (**s | 32) <= 'z'))
        ++*s;
    return (size_t)(*s - *word);
}

static bool is(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && !strncasecmp(word, wanted, n);
}

/* The shape of that name. NULL: there is none, or, with *many, it is a collection. */
static const struct shape *find_shape(const char *word, size_t n, bool *many)
{
    *many = is(word, n, collection);
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
        if (is(word, n, shapes[k].name))
            return &shapes[k];
    return NULL;
}

static bool is_tag(const char *word, size_t n)
{
    return is(word, n, "Z") || is(word, n, "M") || is(word, n, "ZM");
}

/* Cut a geometry's name off *s: POINT, POINT Z or POINTZ, the third number of an M being no
 * height. */
static const struct shape *cut_shape(const char **s, const char *end, bool *many, bool *measured)
{
    const char *word, *tag, *behind;
    size_t n = cut_word(s, end, &word), m;
    const struct shape *shape = find_shape(word, n, many);
    if (shape || *many) {
        behind = *s;
        m = cut_word(&behind, end, &tag);
        if (is_tag(tag, m))
            *s = behind;
    } else {
        m = n > 2 && is_tag(word + n - 2, 2) ? 2 : n > 1 && is_tag(word + n - 1, 1);
        tag = word + n - m;
        shape = find_shape(word, n - m, many);
    }
    *measured = is(tag, m, "M");
    return shape;
}

/* `SRID=32632;`, which may stand before a geometry: the code, 0 without. */
static int cut_srid(const char **s, const char *end)
{
    const char *at = *s = skip(*s, end);
    double v;
    if (end - at < 6 || strncasecmp(at, "SRID=", 5) || !(at = hm_num_parse(at + 5, end, &v)) ||
        at == end || *at != ';')
        return 0;
    *s = at + 1;
    return v > 0 && v < 1000000 ? (int)v : 0;
}

/* --- what it looks like --- */

/* What separates the columns under a line of names: the first of these that it has, or a comma. */
static char separator_of(const char *s, const char *end)
{
    for (; s < end; s++)
        if (*s == ',' || *s == ';' || *s == '\t')
            return *s;
    return ',';
}

/* Cut a field off *s, unquoted in place of its bytes when it was quoted; NULL behind the last. */
static char *cut_field(char **s, char *end, char separator, char **stop)
{
    if (!*s)
        return NULL;
    char *from = *s, *to = from, *p = from;
    for (bool quoted = false; p < end && (quoted || *p != separator); p++) {
        if (*p != '"')
            *to++ = *p;
        else if (quoted && p + 1 < end && p[1] == '"')
            *to++ = *p++;
        else
            quoted = !quoted;
    }
    *s = p < end ? p + 1 : NULL;
    *stop = to;
    return from;
}

static bool is_geometry_column(const char *s, const char *end)
{
    static const char *const names[] = {"WKT", "wkt_geom", "geometry", "geom", "the_geom"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (is(s, (size_t)(end - s), names[k]))
            return true;
    return false;
}

/* The number of the column with geometries in a line of names; -1 when there is none. Changes the
 * line. */
static int geometry_column(char *line, char *end, char separator)
{
    char *stop, *field;
    for (int k = 0; (field = cut_field(&line, end, separator, &stop)); k++)
        if (is_geometry_column(field, stop))
            return k;
    return -1;
}

static bool is_table(const char *s, const char *end)
{
    char line[4096];
    const char *lf = memchr(s, '\n', (size_t)(end - s));
    size_t n = (size_t)((lf ? lf : end) - s);
    if (n >= sizeof line)
        return false;
    memcpy(line, s, n);
    n -= n > 0 && line[n - 1] == '\r';
    return geometry_column(line, line + n, separator_of(s, s + n)) >= 0;
}

bool hm_import_is_wkt(const char *s, const char *end)
{
    bool many, measured;
    const char *at = s;
    cut_srid(&at, end);
    if (cut_shape(&at, end, &many, &measured) || many) {
        at = skip(at, end);
        return at < end && (*at == '(' || (*at | 32) == 'e');
    }
    return is_table(s, end);
}

/* --- geometries --- */

struct reading {
    struct hm_features f;
    int srid;
    const char *s, *end; /* what is left of the record */
    bool measured;       /* the third number is no height */
};

static enum hm_err fail(struct reading *r, const char *expected)
{
    char word[HM_ROW_WORD];
    if (r->s == r->end)
        return hm_input_fail(r->f.in, HM_ETRUNC, r->f.d, "a geometry ends here, in the middle");
    return hm_input_fail(r->f.in, HM_EFORMAT, r->f.d, "expected %s, got \"%s\"", expected,
                         hm_row_word(word, r->s, r->end));
}

/* Take the character, with blanks before it; false when another stands there. */
static bool take(struct reading *r, char c)
{
    r->s = skip(r->s, r->end);
    if (r->s == r->end || *r->s != c)
        return false;
    r->s++;
    return true;
}

/* Two to four numbers. */
static enum hm_err read_vertex(struct reading *r)
{
    double v[4], xyz[3];
    int n = 0;
    for (const char *stop; n < 4; n++) {
        r->s = skip(r->s, r->end);
        stop = hm_num_parse(r->s, r->end, &v[n]);
        if (!stop)
            break;
        r->s = stop;
    }
    if (n < 2)
        return fail(r, "a number");
    xyz[0] = v[0];
    xyz[1] = v[1];
    xyz[2] = n > 2 && !(r->measured && n == 3) ? v[2] : NAN;
    return hm_features_vertex(&r->f, xyz);
}

static bool is_empty(struct reading *r)
{
    const char *word, *s = r->s;
    size_t n = cut_word(&s, r->end, &word);
    if (!is(word, n, "EMPTY"))
        return false;
    r->s = s;
    return true;
}

/* What stands in the parentheses of a shape. A vertex of many points may have its own. */
static enum hm_err read_body(struct reading *r, const struct shape *shape, int depth, bool inner)
{
    enum hm_err err = HM_OK;
    if (is_empty(r))
        return HM_OK;
    if (!take(r, '('))
        return fail(r, "(");
    bool further = false;
    do {
        bool own = depth == 1 && shape->shape == HM_SHAPE_POINTS && take(r, '(');
        err = depth > 1 ? read_body(r, shape, depth - 1, further && depth == 2) : read_vertex(r);
        if (!err && own && !take(r, ')'))
            err = fail(r, ")");
        further = true;
    } while (!err && take(r, ','));
    if (!err && !take(r, ')'))
        err = fail(r, "a comma or )");
    if (!err && depth == 1)
        err = hm_features_end(&r->f, inner && shape->shape == HM_SHAPE_RING ? HM_SHAPE_HOLE
                                                                            : shape->shape);
    return err;
}

static enum hm_err read_geometry(struct reading *r, int depth)
{
    bool many;
    int srid = cut_srid(&r->s, r->end);
    const struct shape *shape = cut_shape(&r->s, r->end, &many, &r->measured);
    enum hm_err err = HM_OK;
    r->srid = srid ? srid : r->srid;
    if (shape)
        return read_body(r, shape, shape->depth, false);
    if (!many || depth > 20)
        return hm_input_fail(r->f.in, HM_EFORMAT, r->f.d,
                             "no geometry of WKT that is read: points, lines and polygons are");
    if (is_empty(r))
        return HM_OK;
    if (!take(r, '('))
        return fail(r, "(");
    do {
        err = read_geometry(r, depth + 1);
    } while (!err && take(r, ','));
    return !err && !take(r, ')') ? fail(r, "a comma or )") : err;
}

/* --- records --- */

struct record { /* lines of the file that belong together */
    char *text;
    size_t n, cap;
};

/* The quotes, and outside of a table the parentheses, that are open behind a line. */
struct open {
    bool quote;
    long parentheses;
};

static void look(struct open *open, const char *s, const char *end)
{
    for (; s < end; s++) {
        if (*s == '"')
            open->quote = !open->quote;
        else if (*s == '(' || *s == ')')
            open->parentheses += *s == '(' ? 1 : -1;
    }
}

/* The next record; HM_END behind the last. */
static enum hm_err next_record(struct hm_features *f, struct record *record, bool table)
{
    struct open open = {0};
    const char *s, *end;
    record->n = 0;
    do {
        enum hm_err err = hm_input_line(f->in, &s, &end, f->d);
        if (err == HM_END && record->n > 0)
            return HM_OK; /* what is missing will be noticed */
        if (err)
            return err;
        if (!hm_row_is_text(s, end))
            return hm_input_fail(f->in, HM_EFORMAT, f->d, "control characters");
        size_t n = (size_t)(end - s);
        if (!hm_grow(&record->text, &record->cap, record->n + n + 1, 1))
            return hm_fail_memory(f->d);
        memcpy(record->text + record->n, s, n);
        record->n += n;
        record->text[record->n++] = '\n';
        look(&open, s, end);
    } while (table ? open.quote : open.parentheses > 0);
    record->n--;
    return HM_OK;
}

static enum hm_err read_plain(struct reading *r, const struct record *record)
{
    enum hm_err err = HM_OK;
    r->s = skip(record->text, record->text + record->n);
    r->end = record->text + record->n;
    while (!err && r->s < r->end) {
        err = hm_features_begin(&r->f);
        if (!err)
            err = read_geometry(r, 0);
        if (!err)
            take(r, ';');
        r->s = skip(r->s, r->end);
    }
    return err;
}

struct names { /* of the columns */
    char **name;
    size_t n, cap;
    char separator;
    size_t geometry; /* which of them */
};

static enum hm_err read_names(struct names *names, struct record *record, struct hm_diag *d)
{
    char *s = record->text, *end = s + record->n, *stop, *field;
    names->separator = separator_of(s, end);
    while ((field = cut_field(&s, end, names->separator, &stop))) {
        if (!hm_grow(&names->name, &names->cap, names->n + 1, sizeof *names->name) ||
            !(names->name[names->n] = strndup(field, (size_t)(stop - field))))
            return hm_fail_memory(d);
        if (is_geometry_column(field, stop))
            names->geometry = names->n;
        names->n++;
    }
    return HM_OK;
}

/* One row: properties, then the geometry, which is written in the field found on the way. */
static enum hm_err read_row(struct reading *r, const struct names *names, struct record *record)
{
    char *s = record->text, *end = s + record->n, *stop, *field;
    enum hm_err err = hm_features_begin(&r->f);
    r->s = r->end = end;
    for (size_t k = 0; !err && (field = cut_field(&s, end, names->separator, &stop)); k++) {
        if (k >= names->n)
            return hm_input_fail(r->f.in, HM_EFORMAT, r->f.d, "more fields than the %zu columns",
                                 names->n);
        if (k == names->geometry) {
            r->s = skip(field, stop);
            r->end = stop;
        } else if (stop > field) {
            char *value = strndup(field, (size_t)(stop - field));
            err =
                value ? hm_features_property(&r->f, names->name[k], value) : hm_fail_memory(r->f.d);
            free(value);
        }
    }
    if (err || r->s == r->end) /* a feature without geometry */
        return err;
    err = read_geometry(r, 0);
    r->s = skip(r->s, r->end);
    return !err && r->s < r->end ? fail(r, "nothing more") : err;
}

static enum hm_err read_records(struct reading *r, struct record *record, struct names *names)
{
    enum hm_err err = next_record(&r->f, record, false);
    bool table = !err && is_table(record->text, record->text + record->n);
    if (table)
        err = read_names(names, record, r->f.d);
    else if (!err)
        err = read_plain(r, record);
    while (!err && !(err = next_record(&r->f, record, table))) {
        if (skip(record->text, record->text + record->n) == record->text + record->n)
            continue;
        err = table ? read_row(r, names, record) : read_plain(r, record);
    }
    return err == HM_END ? HM_OK : err;
}

enum hm_err hm_import_wkt(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d)
{
    struct reading r = {.f = {.in = in, .o = o, .d = d}};
    struct record record = {0};
    struct names names = {0};
    char crs[32];
    enum hm_err err = read_records(&r, &record, &names);
    snprintf(crs, sizeof crs, "EPSG:%d", r.srid);
    if (!err)
        err = hm_features_finish(&r.f, r.srid ? crs : NULL);
    for (size_t k = 0; k < names.n; k++)
        free(names.name[k]);
    free(names.name);
    free(record.text);
    hm_features_free(&r.f);
    return err;
}
