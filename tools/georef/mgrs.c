/* Tables of MGRS references: `32UNV1343802438 245.3 …`, read as points. */
#include "georef.h"

#include "hm_input.h"
#include "hm_row.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_COLUMNS = 1000 };

struct table {
    struct hm_input in;
    size_t columns; /* with that of the references; 0 before the first row */
    bool comma;
    double *row; /* longitude, latitude, z, further columns */
};

/* The next line that is neither blank nor a comment. */
static enum hm_err next_line(struct table *t, const char **s, const char **end, struct hm_diag *d)
{
    enum hm_err err;
    while (!(err = hm_input_line(&t->in, s, end, d))) {
        *s = hm_row_skip(*s, *end);
        if (*s < *end && **s != '#')
            return HM_OK;
    }
    return err;
}

/* A line of names may stand above; every reference holds a digit or ends as long as one of a pole.
 */
static bool is_names(const char *s, const char *end, bool comma)
{
    const char *stop = hm_row_field(&s, end, comma);
    for (; s < stop; s++)
        if (isdigit((unsigned char)*s))
            return false;
    return true;
}

static enum hm_err read_reference(struct table *t, const char *s, const char *stop,
                                  struct hm_diag *d)
{
    char text[HM_ROW_WORD];
    struct hm_diag own = {0};
    if ((size_t)(stop - s) >= sizeof text || !hm_row_is_text(s, stop))
        return hm_input_fail(&t->in, HM_EFORMAT, d, "expected an MGRS reference, got \"%s\"",
                             hm_row_word(text, s, stop));
    snprintf(text, sizeof text, "%.*s", (int)(stop - s), s);
    if (hm_geod_mgrs(t->row, text, &own))
        return hm_input_fail(&t->in, HM_EFORMAT, d, "%s", own.text);
    return HM_OK;
}

static enum hm_err read_row(struct table *t, const char *s, const char *end, struct hm_diag *d)
{
    const char *stop = hm_row_field(&s, end, t->comma);
    size_t count = hm_row_count(s, end, t->comma);
    if (count != t->columns)
        return hm_input_fail(&t->in, HM_EFORMAT, d, "expected %zu columns, got %zu", t->columns,
                             count);
    enum hm_err err = read_reference(t, s, stop, d);
    t->row[2] = NAN;
    for (size_t k = 1; k < t->columns && !err; k++) {
        s = hm_row_next(stop, end, t->comma);
        stop = s ? hm_row_field(&s, end, t->comma) : NULL;
        char word[HM_ROW_WORD];
        if (stop && s == stop && t->comma)
            t->row[k + 1] = NAN;
        else if (!stop || hm_num_parse(s, stop, &t->row[k + 1]) != stop || isinf(t->row[k + 1]))
            err = hm_input_fail(&t->in, HM_EFORMAT, d, "expected a number, got \"%s\"",
                                stop ? hm_row_word(word, s, stop) : "");
    }
    return err;
}

static enum hm_err begin(struct table *t, const char *s, const char *end, struct hm_writer *w,
                         struct hm_diag *d)
{
    struct hm_header h;
    t->columns = hm_row_count(s, end, t->comma);
    if (t->columns > MOST_COLUMNS)
        return hm_input_fail(&t->in, HM_EFORMAT, d, "more than %d columns", MOST_COLUMNS);
    t->row = hm_alloc(t->columns < 2 ? 3 : t->columns + 1, sizeof *t->row);
    if (!t->row)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_init(&h, HM_POINTS, d);
    if (!err)
        err = hm_header_add(&h, "crs", "longitude latitude WGS84", d);
    for (size_t k = 3; k <= t->columns && !err; k++) {
        char name[24];
        snprintf(name, sizeof name, "c%zu", k);
        err = hm_header_add_field(&h, name, NULL, d);
    }
    if (!err)
        err = hm_writer_begin(w, &h, d);
    hm_header_free(&h);
    return err;
}

static enum hm_err copy_rows(struct table *t, struct hm_writer *w, struct extent *extent,
                             struct hm_diag *d)
{
    const char *s, *end;
    enum hm_err err;
    bool first = true;
    while (!(err = next_line(t, &s, &end, d))) {
        if (t->columns == 0) {
            t->comma = memchr(s, ',', (size_t)(end - s)) != NULL;
            if (first && is_names(s, end, t->comma)) {
                first = false;
                continue;
            }
            if ((err = begin(t, s, end, w, d)))
                return err;
        }
        if ((err = read_row(t, s, end, d)) || (err = hm_writer_points(w, t->row, 1, d)))
            return err;
        georef_extend(extent, t->row, 1, 3);
    }
    if (err != HM_END)
        return err;
    return t->columns > 0 ? hm_writer_end(w, d)
                          : hm_input_fail(&t->in, HM_EFORMAT, d, "empty: no MGRS references");
}

enum hm_err georef_read_mgrs(const char *path, struct hm_writer *w, struct extent *extent,
                             struct hm_diag *d)
{
    struct table t = {0};
    enum hm_err err = hm_input_open(&t.in, path, d);
    if (err)
        return err;
    err = copy_rows(&t, w, extent, d);
    hm_input_close(&t.in);
    free(t.row);
    return err;
}
