/* hm_row: the numbers of one line of text. Layer 5. */
#ifndef HM_ROW_H
#define HM_ROW_H

#include "hm_input.h"
#include "hm_num.h"

#include <math.h>

static inline bool hm_row_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static inline const char *hm_row_skip(const char *s, const char *end)
{
    while (s < end && hm_row_is_blank(*s))
        s++;
    return s;
}

/* Exactly n numbers between blanks to v; false when the line is anything else. */
static inline bool hm_row_parse(const char *s, const char *end, double *v, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        s = hm_num_parse(hm_row_skip(s, end), end, &v[i]);
        if (!s || (s < end && !hm_row_is_blank(*s)))
            return false;
    }
    return hm_row_skip(s, end) == end;
}

/* The same between commas; an empty field is NaN. */
bool hm_row_parse_commas(const char *s, const char *end, double *v, size_t n);

/* The next field of a line is [*s, returned), once *s has gone behind the blanks before it; comma:
 * fields stand between commas, else between blanks. */
const char *hm_row_field(const char **s, const char *end, bool comma);
/* Where the field behind the one that ends at stop begins, NULL when there is none. */
const char *hm_row_next(const char *stop, const char *end, bool comma);

/* Number of fields of a line; comma: between commas, else between blanks. */
size_t hm_row_count(const char *s, const char *end, bool comma);

/* The failure of a line that is not n numbers. */
enum hm_err hm_row_fail(const struct hm_input *in, const char *s, const char *end, size_t n,
                        bool comma, struct hm_diag *d);

/* Does the line begin with this word, a blank or nothing behind it? */
bool hm_row_begins(const char *s, const char *end, const char *word);

/* Nothing but printable characters (of any language, in UTF-8), blanks and tabs? */
bool hm_row_is_text(const char *s, const char *end);

/* A word of the input as it can stand in a message: printable, cut to fit. */
enum { HM_ROW_WORD = 48 };
const char *hm_row_word(char word[HM_ROW_WORD], const char *s, const char *end);

#endif
