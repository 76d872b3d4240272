#include "hm_headio.h"

#include "hm_num.h"
#include "hm_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 1 };

static const char *const encodings[] = {"text", "f64le", "f32le"};

/* A piece of the input, not terminated. */
struct span {
    const char *s, *end;
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* Cut the first word off *rest; empty behind the last. */
static struct span cut_word(struct span *rest)
{
    const char *s = rest->s;
    while (s < rest->end && is_blank(*s))
        s++;
    struct span word = {s, s};
    while (word.end < rest->end && !is_blank(*word.end))
        word.end++;
    rest->s = word.end;
    return word;
}

static bool equals(struct span word, const char *text)
{
    size_t n = (size_t)(word.end - word.s);
    return n == strlen(text) && !memcmp(word.s, text, n);
}

/* The number of the next word. */
static bool cut_number(struct span *rest, double *value)
{
    struct span word = cut_word(rest);
    return hm_num_parse(word.s, word.end, value) == word.end && word.s < word.end;
}

/* The same, a whole number of 0 or more. */
static bool cut_natural(struct span *rest, int64_t *value)
{
    double v;
    if (!cut_number(rest, &v) || !(v >= 0 && v <= 9007199254740992.0) || v != floor(v))
        return false;
    *value = (int64_t)v;
    return true;
}

static bool at_end(struct span rest)
{
    struct span word = cut_word(&rest);
    return word.s == word.end;
}

/* `#hm 1 grid text` */
static enum hm_err read_first(struct hm_input *in, struct hm_header *h, enum hm_encoding *encoding,
                              struct hm_diag *d)
{
    static const enum hm_kind kinds[] = {HM_POINTS, HM_GRID, HM_LINES, HM_MESH};
    struct span rest;
    enum hm_err err = hm_input_line(in, &rest.s, &rest.end, d);
    if (err)
        return err;
    if (in->unfinished)
        return hm_input_fail(in, HM_ETRUNC, d, "cut off inside a header");
    int64_t version;
    cut_word(&rest); /* the reader has seen that it is #hm */
    if (!cut_natural(&rest, &version) || version < 1)
        return hm_input_fail(in, HM_EFORMAT, d, "expected \"#hm %d KIND ENCODING\"", VERSION);
    if (version > VERSION)
        return hm_input_fail(in, HM_EFORMAT, d,
                             "a stream of version %lld; this program reads version %d",
                             (long long)version, VERSION);
    struct span kind = cut_word(&rest), code = cut_word(&rest);
    size_t k = 0, e = 0;
    while (k < 4 && !equals(kind, hm_kind_name(kinds[k])))
        k++;
    while (e < 3 && !equals(code, encodings[e]))
        e++;
    if (k == 4)
        return hm_input_fail(in, HM_EFORMAT, d, "the kind is none of points grid lines mesh");
    if (e == 3 || (e == HM_F32LE && kinds[k] != HM_GRID))
        return hm_input_fail(in, HM_EFORMAT, d, "the encoding is none of text f64le%s",
                             kinds[k] == HM_GRID ? " f32le" : "");
    if (!at_end(rest))
        return hm_input_fail(in, HM_EFORMAT, d, "unexpected words behind the encoding");
    *encoding = (enum hm_encoding)e;
    return hm_header_init(h, kinds[k], d);
}

static char *copy_span(struct span text)
{
    size_t n = (size_t)(text.end - text.s);
    return strndup(text.s, n);
}

static enum hm_err read_fields(struct hm_input *in, struct hm_header *h, struct span rest,
                               struct hm_diag *d)
{
    if (h->kind == HM_MESH)
        return hm_input_fail(in, HM_EFORMAT, d, "a mesh has no #fields");
    for (; h->nfields > 0; h->nfields--)
        free(h->fields[h->nfields - 1]);
    struct span word;
    size_t cap = 0, need = 0;
    free(h->fields);
    h->fields = NULL;
    while (word = cut_word(&rest), word.s < word.end) {
        if (!hm_grow(&h->fields, &cap, ++need, sizeof *h->fields))
            return hm_fail_memory(d);
        h->fields[h->nfields] = copy_span(word);
        if (!h->fields[h->nfields])
            return hm_fail_memory(d);
        h->nfields++;
    }
    bool good = h->nfields >= 3 && !strcmp(h->fields[0], "x") && !strcmp(h->fields[1], "y") &&
                (h->kind == HM_GRID || !strcmp(h->fields[2], "z")) &&
                (h->kind != HM_LINES || h->nfields == 3);
    if (h->nfields > HM_MAX_FIELDS)
        return hm_input_fail(in, HM_EFORMAT, d, "more than %d fields", HM_MAX_FIELDS);
    if (!good)
        return hm_input_fail(in, HM_EFORMAT, d, "the fields of %s %s", hm_kind_name(h->kind),
                             h->kind == HM_LINES  ? "are x y z"
                             : h->kind == HM_GRID ? "begin with x y, then at least one band"
                                                  : "begin with x y z");
    for (size_t i = 1; i < h->nfields; i++)
        for (size_t k = 0; k < i; k++)
            if (!strcmp(h->fields[i], h->fields[k]))
                return hm_input_fail(in, HM_EFORMAT, d, "two fields are called %s", h->fields[i]);
    return HM_OK;
}

static enum hm_err read_other(struct hm_header *h, struct span key, struct span rest,
                              struct hm_diag *d)
{
    while (rest.s < rest.end && is_blank(*rest.s))
        rest.s++;
    while (rest.end > rest.s && is_blank(rest.end[-1]))
        rest.end--;
    char *name = copy_span(key), *value = copy_span(rest);
    enum hm_err err = name && value ? HM_OK : hm_fail_memory(d);
    if (!err)
        err = strcmp(name, "prog") ? hm_header_add(h, name, value, d)
                                   : hm_header_add_history(h, value, d);
    free(name);
    free(value);
    return err;
}

/* One line between `#hm` and `#data`. */
static enum hm_err read_key(struct hm_input *in, struct hm_header *h, struct span rest,
                            struct hm_diag *d)
{
    if (rest.s == rest.end || *rest.s != '#')
        return hm_input_fail(in, HM_EFORMAT, d,
                             "a line without '#' in a header (no #data before it)");
    if (!hm_row_is_text(rest.s, rest.end))
        return hm_input_fail(in, HM_EFORMAT, d, "control characters in a header");
    rest.s++;
    struct span key = {rest.s, rest.s};
    if (rest.s < rest.end && !is_blank(*rest.s))
        key = cut_word(&rest);
    struct hm_lattice *l = &h->lattice;
    bool good = true;
    if (equals(key, "fields"))
        return read_fields(in, h, rest, d);
    if (equals(key, "count"))
        good = cut_natural(&rest, &h->count) && at_end(rest);
    else if (h->kind == HM_GRID && equals(key, "size"))
        good = cut_natural(&rest, &l->nx) && cut_natural(&rest, &l->ny) && at_end(rest);
    else if (h->kind == HM_GRID && equals(key, "origin"))
        good = cut_number(&rest, &l->x0) && cut_number(&rest, &l->y0) && at_end(rest);
    else if (h->kind == HM_GRID && equals(key, "step"))
        good = cut_number(&rest, &l->dx) && cut_number(&rest, &l->dy) && at_end(rest);
    else if (equals(key, "hm") || equals(key, "end"))
        return hm_input_fail(in, HM_ETRUNC, d, "a header without #data");
    else
        return read_other(h, key, rest, d);
    if (!good)
        return hm_input_fail(in, HM_EFORMAT, d, "#%.*s: not the numbers that belong here",
                             (int)(key.end - key.s), key.s);
    return HM_OK;
}

enum hm_err hm_headio_check_lattice(const struct hm_lattice *l, size_t bands, struct hm_diag *d)
{
    if (l->nx < 1 || l->ny < 1)
        return hm_fail(d, HM_EFORMAT, "a grid needs #size with at least one node each way");
    if (bands > HM_MAX_SIDE || l->nx > HM_MAX_SIDE / (int64_t)bands || l->ny > HM_MAX_SIDE)
        return hm_fail(d, HM_EFORMAT,
                       "a grid of %lld x %lld nodes with %zu bands is too large: at most %d rows, "
                       "and columns times bands",
                       (long long)l->nx, (long long)l->ny, bands, HM_MAX_SIDE);
    double x1 = l->x0 + (double)(l->nx - 1) * l->dx, y1 = l->y0 + (double)(l->ny - 1) * l->dy;
    if (!isfinite(l->x0) || !isfinite(l->y0) || !isfinite(x1) || !isfinite(y1))
        return hm_fail(d, HM_EFORMAT, "#origin and #step of a grid must be finite");
    if (l->dx == 0 || l->dy == 0)
        return hm_fail(d, HM_EFORMAT, "a grid needs a #step that is not 0");
    if (l->x0 + l->dx == l->x0 || x1 - l->dx == x1 || l->y0 + l->dy == l->y0 || y1 - l->dy == y1)
        return hm_fail(d, HM_EFORMAT, "the #step of a grid is lost beside its #origin");
    return HM_OK;
}

static enum hm_err read_all(struct hm_input *in, struct hm_header *h, enum hm_encoding *encoding,
                            struct hm_diag *d)
{
    enum hm_err err = read_first(in, h, encoding, d);
    while (!err) {
        struct span line;
        err = hm_input_line(in, &line.s, &line.end, d);
        if (err == HM_END || (!err && in->unfinished))
            return hm_input_fail(in, HM_ETRUNC, d, "cut off inside a header");
        if (err)
            return err;
        if (hm_row_begins(line.s, line.end, "#data") &&
            hm_row_skip(line.s + strlen("#data"), line.end) == line.end)
            break;
        err = read_key(in, h, line, d);
    }
    struct hm_diag why = {0};
    if (!err && h->kind == HM_GRID &&
        (err = hm_headio_check_lattice(&h->lattice, h->nfields - 2, &why)))
        hm_input_fail(in, err, d, "%s", why.text);
    return err;
}

enum hm_err hm_headio_read(struct hm_input *in, struct hm_header *h, enum hm_encoding *encoding,
                           struct hm_diag *d)
{
    memset(h, 0, sizeof *h);
    enum hm_err err = read_all(in, h, encoding, d);
    if (err)
        hm_header_free(h);
    return err;
}

static enum hm_err put(struct hm_output *out, const char *text, struct hm_diag *d)
{
    return hm_output_write(out, text, strlen(text), d);
}

/* `#key value` */
static enum hm_err put_key(struct hm_output *out, const char *key, const char *value,
                           struct hm_diag *d)
{
    if (!hm_row_is_text(value, value + strlen(value)))
        return hm_fail(d, HM_EARG, "control characters in the value of #%s", key);
    enum hm_err err = put(out, "#", d);
    if (!err)
        err = put(out, key, d);
    if (!err && *value)
        err = put(out, " ", d);
    if (!err)
        err = put(out, value, d);
    return err ? err : put(out, "\n", d);
}

static enum hm_err put_pair(struct hm_output *out, const char *key, double a, double b,
                            struct hm_diag *d)
{
    char text[2 * HM_NUM_CHARS + 2];
    size_t n = hm_num_print(text, a);
    text[n++] = ' ';
    n += hm_num_print(text + n, b);
    text[n] = '\0';
    return put_key(out, key, text, d);
}

static enum hm_err put_fields(struct hm_output *out, const struct hm_header *h, struct hm_diag *d)
{
    enum hm_err err = put(out, "#fields", d);
    for (size_t i = 0; i < h->nfields && !err; i++) {
        err = put(out, " ", d);
        if (!err)
            err = put(out, h->fields[i], d);
    }
    return err ? err : put(out, "\n", d);
}

enum hm_err hm_headio_write(struct hm_output *out, const struct hm_header *h,
                            enum hm_encoding encoding, struct hm_diag *d)
{
    char text[64];
    const struct hm_lattice *l = &h->lattice;
    snprintf(text, sizeof text, "%d %s %s", VERSION, hm_kind_name(h->kind), encodings[encoding]);
    enum hm_err err = put_key(out, "hm", text, d);
    if (!err && h->count >= 0) {
        snprintf(text, sizeof text, "%lld", (long long)h->count);
        err = put_key(out, "count", text, d);
    }
    if (!err && h->kind == HM_GRID) {
        err = put_pair(out, "size", (double)l->nx, (double)l->ny, d);
        if (!err)
            err = put_pair(out, "origin", l->x0, l->y0, d);
        if (!err)
            err = put_pair(out, "step", l->dx, l->dy, d);
    }
    if (!err && h->kind != HM_MESH)
        err = put_fields(out, h, d);
    for (size_t i = 0; i < h->nkeys && !err; i++)
        err = put_key(out, h->keys[i].name, h->keys[i].value, d);
    for (size_t i = 0; i < h->nhistory && !err; i++)
        err = put_key(out, "prog", h->history[i], d);
    return err ? err : put(out, "#data\n", d);
}
