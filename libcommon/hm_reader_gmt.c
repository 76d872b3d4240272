/* GMT multisegment lines: `>` begins a line, its attributes behind it or, as OGR_GMT writes them,
 * in comments: `# @N` names, `# @D` values, `# @P` and `# @H` the outer and inner rings of
 * polygons. */
#include "hm_reader_private.h"

#include "hm_attr.h"
#include "hm_row.h"

#include <stdio.h>
#include <stdlib.h>

struct gmt {
    size_t columns; /* of the first vertex, and so of all; 0 before it */
    bool comma;
    char **name; /* of the values in `# @D` */
    size_t nnames, names_cap;
    char *feature; /* attributes of the last `# @D`, which hold for the inner rings that follow */
    double *v;
    size_t v_cap;
};

static void free_gmt(void *state)
{
    struct gmt *g = state;
    for (size_t i = 0; i < g->nnames; i++)
        free(g->name[i]);
    free(g->name);
    free(g->feature);
    free(g->v);
    free(g);
}

/* --- comments of OGR_GMT --- */

/* Cut the next of the values between `|` off *rest, unquoted. NULL: no memory. */
static char *cut_value(const char **rest, const char *end)
{
    const char *s = *rest;
    char *value = hm_alloc((size_t)(end - s) + 1, 1);
    size_t n = 0;
    for (bool quoted = false; value && s < end && (quoted || *s != '|'); s++) {
        if (*s == '"') {
            quoted = !quoted;
            continue;
        }
        if (*s == '\\' && s + 1 < end)
            s++;
        value[n++] = *s;
    }
    if (value)
        value[n] = '\0';
    *rest = s < end ? s + 1 : end + 1; /* behind the end: no more */
    return value;
}

static enum hm_err read_names(struct gmt *g, const char *s, const char *end, struct hm_diag *d)
{
    while (s <= end) {
        if (!hm_grow(&g->name, &g->names_cap, g->nnames + 1, sizeof *g->name))
            return hm_fail_memory(d);
        char *name = cut_value(&s, end);
        if (!name)
            return hm_fail_memory(d);
        for (char *c = name; *c; c++)
            if (strchr(" \t=\"", *c))
                *c = '_';
        g->name[g->nnames++] = name;
    }
    return HM_OK;
}

/* Put attrs with one key more, or changed, in their place. */
static enum hm_err set_attr(struct hm_reader *r, const char *key, const char *value,
                            struct hm_diag *d)
{
    char *attrs = hm_attr_set(r->attrs, key, value);
    if (!attrs)
        return hm_fail_memory(d);
    free(r->attrs);
    r->attrs = attrs;
    r->attrs_cap = strlen(attrs) + 1;
    return HM_OK;
}

static enum hm_err read_values(struct hm_reader *r, const char *s, const char *end,
                               struct hm_diag *d)
{
    struct gmt *g = r->state;
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < g->nnames && s <= end && !err; i++) {
        char *value = cut_value(&s, end);
        if (!value)
            return hm_fail_memory(d);
        if (*value && *g->name[i])
            err = set_attr(r, g->name[i], value, d);
        free(value);
    }
    if (err)
        return err;
    free(g->feature);
    g->feature = strdup(r->attrs);
    return g->feature ? HM_OK : hm_fail_memory(d);
}

/* An inner ring is a hole, with the attributes of its polygon. */
static enum hm_err begin_hole(struct hm_reader *r, struct hm_diag *d)
{
    const struct gmt *g = r->state;
    enum hm_err err = HM_OK;
    if (g->feature && !*r->attrs)
        err = hm_reader_set_attrs(r, g->feature, strlen(g->feature), d);
    return err ? err : set_attr(r, "hole", "1", d);
}

/* `# @Je4326` or `# @Jp"+proj=utm +zone=32"`, which give way to the former. */
static enum hm_err read_projection(struct hm_header *h, const char *s, const char *end,
                                   struct hm_diag *d)
{
    if (!h || s == end || (*s != 'e' && (*s != 'p' || hm_header_get(h, "crs"))))
        return HM_OK;
    bool code = *s++ == 'e';
    char crs[HM_DIAG_TEXT], *value = cut_value(&s, end);
    if (!value)
        return hm_fail_memory(d);
    snprintf(crs, sizeof crs, "%s%s", code ? "EPSG:" : "", value);
    free(value);
    return hm_header_set(h, "crs", crs, d);
}

/* One comment; several `@` codes may stand in it. h is NULL once the header is out. */
static enum hm_err read_comment(struct hm_reader *r, struct hm_header *h, const char *s,
                                const char *end, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    s = hm_row_skip(s + 1, end);
    while (!err && end - s > 1 && *s == '@') {
        char code = s[1];
        const char *stop = s + 2;
        for (bool quoted = false; stop < end && (quoted || *stop != ' '); stop++)
            if (*stop == '"')
                quoted = !quoted;
        if (code == 'N' || code == 'D') /* values may have blanks: to the end of the line */
            stop = end;
        if (code == 'J')
            err = read_projection(h, s + 2, stop, d);
        else if (code == 'N')
            err = read_names(r->state, s + 2, stop, d);
        else if (code == 'D' && r->attrs)
            err = read_values(r, s + 2, stop, d);
        else if (code == 'H' && r->attrs)
            err = begin_hole(r, d);
        s = hm_row_skip(stop, end);
    }
    return err;
}

/* --- lines --- */

/* The next line with something in it, comments read on the way. HM_END at the end of the input, or
 * where an object of the project begins. */
static enum hm_err next_line(struct hm_reader *r, struct hm_header *h, const char **s,
                             const char **end, struct hm_diag *d)
{
    enum hm_err err;
    while (!(err = hm_input_line(&r->in, s, end, d))) {
        if (hm_row_begins(*s, *end, "#hm")) {
            hm_input_unread(&r->in);
            return HM_END;
        }
        *s = hm_row_skip(*s, *end);
        if (!hm_row_is_text(*s, *end))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "control characters");
        if (*s < *end && **s != '#')
            return HM_OK;
        if (*s < *end && (err = read_comment(r, h, *s, *end, d)))
            return err;
    }
    return err;
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    const char *s, *end;
    r->state = hm_alloc0(1, sizeof(struct gmt));
    if (!r->state)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_init(h, HM_LINES, d);
    if (!err)
        err = next_line(r, h, &s, &end, d);
    if (err == HM_END)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "no data, and no format that is known");
    if (!err)
        hm_input_unread(&r->in);
    return err;
}

/* What stands behind `>`: attributes, or, as in plain GMT, anything; that becomes the label. */
static enum hm_err read_mark(struct hm_reader *r, const char *s, const char *end, struct hm_diag *d)
{
    s = hm_row_skip(s + 1, end);
    while (end > s && hm_row_is_blank(end[-1]))
        end--;
    enum hm_err err = hm_reader_set_attrs(r, s, (size_t)(end - s), d);
    if (err || (*r->attrs != '-' && !hm_attr_check(r->attrs, NULL)))
        return err;
    char *label = strdup(r->attrs);
    if (!label)
        return hm_fail_memory(d);
    *r->attrs = '\0';
    err = set_attr(r, "label", label, d);
    free(label);
    return err;
}

static enum hm_err read_vertex(struct hm_reader *r, const char *s, const char *end,
                               struct hm_diag *d)
{
    struct gmt *g = r->state;
    if (g->columns == 0) {
        g->comma = memchr(s, ',', (size_t)(end - s)) != NULL;
        g->columns = hm_row_count(s, end, g->comma);
        if (g->columns > HM_MAX_FIELDS)
            return hm_input_fail(&r->in, HM_EFORMAT, d, "more than %d columns", HM_MAX_FIELDS);
        if (!hm_grow(&g->v, &g->v_cap, g->columns + 3, sizeof *g->v))
            return hm_fail_memory(d);
    }
    bool good = g->comma ? hm_row_parse_commas(s, end, g->v, g->columns)
                         : hm_row_parse(s, end, g->v, g->columns);
    if (!good)
        return hm_row_fail(&r->in, s, end, g->columns, g->comma, d);
    if (g->columns < 2)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "expected at least the numbers x y, got 1");
    if (g->columns == 2)
        g->v[2] = NAN;
    if (!hm_reader_good_place(g->v))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", hm_reader_bad_place(g->v));
    return hm_reader_add_vertex(r, g->v, d);
}

static enum hm_err read_line(struct hm_reader *r, struct hm_diag *d)
{
    const char *s, *end;
    enum hm_err err = next_line(r, NULL, &s, &end, d);
    if (!err && *s == '>')
        err = read_mark(r, s, end, d);
    else if (!err)
        hm_input_unread(&r->in); /* the first line may do without */
    while (!err && !(err = next_line(r, NULL, &s, &end, d))) {
        if (*s == '>') {
            hm_input_unread(&r->in);
            return HM_OK;
        }
        err = read_vertex(r, s, end, d);
    }
    r->ended = err == HM_END;
    return r->ended && r->xyz_n > 0 ? HM_OK : err;
}

const struct hm_reader_form hm_reader_gmt = {.begin = begin, .line = read_line, .free = free_gmt};
