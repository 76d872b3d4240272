#include "hm_import_private.h"

#include "hm_num.h"
#include "hm_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool hm_import_begins(const char *s, const char *end, const char *text)
{
    size_t n = strlen(text);
    return (size_t)(end - s) >= n && !memcmp(s, text, n);
}

/* --- words --- */

void hm_words_fail(struct hm_words *w, const char *text)
{
    if (!w->err)
        w->err = hm_input_fail(w->in, HM_EFORMAT, w->d, "%s", text);
}

/* Blanks, tabs, and what else may stand between words; a NUL is none. */
static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

size_t hm_words_next(struct hm_words *w, const char **word)
{
    for (;;) {
        while (!w->err && w->s < w->end && is_blank(*w->s))
            w->s++;
        if (w->err)
            return 0;
        if (w->s < w->end)
            break;
        enum hm_err err = hm_input_line(w->in, &w->s, &w->end, w->d);
        if (err) {
            w->s = w->end = NULL;
            if (err != HM_END)
                w->err = err;
            return 0;
        }
    }
    *word = w->s;
    while (w->s < w->end && !is_blank(*w->s))
        w->s++;
    return (size_t)(w->s - *word);
}

bool hm_words_line(struct hm_words *w, const char **s, const char **end)
{
    if (w->err)
        return false;
    if (w->s && w->s < w->end) {
        *s = w->s;
        *end = w->s = w->end;
        return true;
    }
    enum hm_err err = hm_input_line(w->in, s, end, w->d);
    w->s = w->end = NULL;
    if (err && err != HM_END)
        w->err = err;
    return !err;
}

/* A word, where the file must not end. */
static size_t need_word(struct hm_words *w, const char **word)
{
    size_t n = hm_words_next(w, word);
    if (n == 0 && !w->err)
        w->err = hm_input_fail(w->in, HM_ETRUNC, w->d, "the file ends here, in the middle");
    return n;
}

static void not_a(struct hm_words *w, const char *what, const char *s, size_t n)
{
    char word[HM_ROW_WORD];
    if (!w->err)
        w->err = hm_input_fail(w->in, HM_EFORMAT, w->d, "expected %s, got \"%s\"", what,
                               hm_row_word(word, s, s + n));
}

double hm_words_number(struct hm_words *w)
{
    const char *s;
    double v = 0;
    size_t n = need_word(w, &s);
    if (n == 0)
        return 0;
    if (hm_num_parse(s, s + n, &v) == s + n)
        return v;
    not_a(w, "a number", s, n);
    return 0;
}

int32_t hm_words_integer(struct hm_words *w)
{
    const char *s;
    double v = 0;
    size_t n = need_word(w, &s);
    if (n == 0)
        return 0;
    if (hm_num_parse(s, s + n, &v) == s + n && v >= INT32_MIN && v <= INT32_MAX && v == floor(v))
        return (int32_t)v;
    not_a(w, "a whole number", s, n);
    return 0;
}

int32_t hm_words_count(struct hm_words *w)
{
    int32_t v = hm_words_integer(w);
    if (v < 0)
        hm_words_fail(w, "a count below 0");
    return w->err ? 0 : v;
}

void hm_words_expect(struct hm_words *w, const char *word)
{
    const char *s;
    size_t n = need_word(w, &s);
    if (n > 0 && (n != strlen(word) || memcmp(s, word, n)))
        not_a(w, word, s, n);
}

/* --- nodes, elements, strings --- */

enum hm_err hm_import_node(struct hm_input *in, struct hm_mesh *m, const double xyz[3],
                           struct hm_diag *d)
{
    struct hm_node node;
    const char *why = hm_reader_make_node(&node, xyz, 0, 0);
    return why ? hm_input_fail(in, HM_EFORMAT, d, "%s", why) : hm_mesh_add_node(m, node, d);
}

enum hm_err hm_import_elem(struct hm_input *in, struct hm_mesh *m, const int64_t *node, int corners,
                           int64_t region, struct hm_diag *d)
{
    struct hm_elem elem;
    int64_t numbers[5];
    memcpy(numbers, node, (size_t)corners * sizeof *node);
    numbers[corners] = region;
    const char *why = hm_reader_make_elem(&elem, numbers, corners, m->nnodes);
    return why ? hm_input_fail(in, HM_EFORMAT, d, "%s", why) : hm_mesh_add_elem(m, elem, d);
}

enum hm_err hm_import_string(struct hm_mesh *m, const char *name, const int64_t *node, size_t n,
                             struct hm_diag *d)
{
    char *text = hm_alloc(strlen(name) + 12 * n + 1, 1), *end = text;
    if (!text)
        return hm_fail_memory(d);
    end += sprintf(end, "%s", name);
    for (size_t i = 0; i < n; i++)
        end += sprintf(end, " %d", (int32_t)node[i]);
    enum hm_err err = hm_header_add(&m->header, "string", text, d);
    free(text);
    return err;
}

enum hm_err hm_import_name(struct hm_mesh *m, const char *s, const char *end, struct hm_diag *d)
{
    char name[128];
    while (s < end && is_blank(*s))
        s++;
    while (s < end && is_blank(end[-1]))
        end--;
    size_t n = (size_t)(end - s);
    if (n == 0 || n >= sizeof name || !hm_row_is_text(s, end) || memchr(s, ' ', n) ||
        memchr(s, '\t', n))
        return HM_OK;
    snprintf(name, sizeof name, "%.*s", (int)n, s);
    return hm_header_set(&m->header, "name", name, d);
}
