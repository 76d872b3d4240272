#include "hm_row.h"

bool hm_row_begins(const char *s, const char *end, const char *word)
{
    size_t n = strlen(word);
    return (size_t)(end - s) >= n && !memcmp(s, word, n) &&
           ((size_t)(end - s) == n || hm_row_is_blank(s[n]));
}

const char *hm_row_field(const char **s, const char *end, bool comma)
{
    *s = hm_row_skip(*s, end);
    const char *stop = *s;
    if (!comma) {
        while (stop < end && !hm_row_is_blank(*stop))
            stop++;
        return stop;
    }
    while (stop < end && *stop != ',')
        stop++;
    while (stop > *s && hm_row_is_blank(stop[-1]))
        stop--;
    return stop;
}

const char *hm_row_next(const char *stop, const char *end, bool comma)
{
    const char *s = hm_row_skip(stop, end);
    if (s == end)
        return NULL;
    return comma ? s + 1 : s;
}

bool hm_row_parse_commas(const char *s, const char *end, double *v, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!s)
            return false;
        const char *stop = hm_row_field(&s, end, true);
        v[i] = NAN;
        if (s < stop && hm_num_parse(s, stop, &v[i]) != stop)
            return false;
        s = hm_row_next(stop, end, true);
    }
    return !s;
}

size_t hm_row_count(const char *s, const char *end, bool comma)
{
    size_t n = 0;
    if (hm_row_skip(s, end) == end)
        return 0;
    for (; s; n++) {
        const char *stop = hm_row_field(&s, end, comma);
        s = hm_row_next(stop, end, comma);
    }
    return n;
}

bool hm_row_is_text(const char *s, const char *end)
{
    for (; s < end; s++)
        if (((unsigned char)*s < ' ' && *s != '\t') || *s == 127)
            return false;
    return true;
}

const char *hm_row_word(char word[HM_ROW_WORD], const char *s, const char *end)
{
    size_t n = 0;
    for (; s < end && n < HM_ROW_WORD - 4; s++)
        word[n++] = *s >= 32 && *s < 127 ? *s : '?';
    strcpy(word + n, s < end ? "..." : "");
    return word;
}

enum hm_err hm_row_fail(const struct hm_input *in, const char *s, const char *end, size_t n,
                        bool comma, struct hm_diag *d)
{
    size_t got = hm_row_count(s, end, comma);
    for (const char *at = s; at && hm_row_skip(at, end) < end;) {
        double v;
        char word[HM_ROW_WORD];
        const char *stop = hm_row_field(&at, end, comma);
        if (at < stop && hm_num_parse(at, stop, &v) != stop)
            return hm_input_fail(in, HM_EFORMAT, d, "expected a number, got \"%s\"",
                                 hm_row_word(word, at, stop));
        at = hm_row_next(stop, end, comma);
    }
    return hm_input_fail(in, HM_EFORMAT, d, "expected %zu number%s, got %zu", n, n == 1 ? "" : "s",
                         got);
}
