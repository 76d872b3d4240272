#include "hm_json.h"

#include "hm_num.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void put(struct hm_json *j, const char *bytes, size_t n)
{
    if (!j->err)
        j->err = hm_writer_bytes(j->w, bytes, n, &j->d);
}

/* Bytes of the character of UTF-8 at s (Unicode, table 3-7); 0 when there is none. */
static size_t utf8_length(const unsigned char *s)
{
    size_t n = s[0] < 0x80 ? 1 : s[0] < 0xc2 ? 0 : s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : 4;
    int least = s[0] == 0xe0 ? 0xa0 : s[0] == 0xf0 ? 0x90 : 0x80;
    int most = s[0] == 0xed ? 0x9f : s[0] == 0xf4 ? 0x8f : 0xbf;
    if (s[0] > 0xf4 || (n > 1 && (s[1] < least || s[1] > most)))
        return 0;
    for (size_t k = 2; k < n; k++)
        if ((s[k] & 0xc0) != 0x80)
            return 0;
    return n;
}

size_t hm_json_escape(char out[HM_JSON_ESCAPE], const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    size_t n = utf8_length(s);
    *text += n > 0 ? n : 1;
    if (n == 0) { /* Latin-1 is 0x80 to 0xff here */
        out[0] = (char)(0xc0 | s[0] >> 6);
        out[1] = (char)(0x80 | (s[0] & 0x3f));
        return 2;
    }
    if (s[0] < 0x20 || s[0] == '<')
        return (size_t)snprintf(out, HM_JSON_ESCAPE, "\\u%04x", (unsigned)s[0]);
    size_t escaped = s[0] == '"' || s[0] == '\\';
    out[0] = '\\';
    memcpy(out + escaped, s, n);
    return escaped + n;
}

static void put_string(struct hm_json *j, const char *text)
{
    put(j, "\"", 1);
    while (*text) {
        char escape[HM_JSON_ESCAPE];
        put(j, escape, hm_json_escape(escape, &text));
    }
    put(j, "\"", 1);
}

static void new_line(struct hm_json *j)
{
    put(j, "\n", 1);
    for (int i = 0; i < j->depth; i++)
        put(j, "  ", 2);
}

/* What stands before a value: comma, a line of its own, its name. */
static void lead(struct hm_json *j, const char *name)
{
    if (j->begun)
        put(j, ",", 1);
    if (j->depth > 0)
        new_line(j);
    j->begun = true;
    if (name) {
        put_string(j, name);
        put(j, ": ", 2);
    }
}

void hm_json_open(struct hm_json *j, const char *name, char bracket)
{
    lead(j, name);
    put(j, &bracket, 1);
    j->depth++;
    j->begun = false;
}

void hm_json_close(struct hm_json *j, char bracket)
{
    j->depth--;
    if (j->begun)
        new_line(j);
    put(j, &bracket, 1);
    j->begun = true;
    if (j->depth == 0)
        put(j, "\n", 1);
}

void hm_json_number(struct hm_json *j, const char *name, double v)
{
    char text[HM_NUM_CHARS];
    lead(j, name);
    if (isfinite(v))
        put(j, text, hm_num_print(text, v));
    else
        put(j, "null", 4);
}

void hm_json_integer(struct hm_json *j, const char *name, int64_t v)
{
    char text[24];
    lead(j, name);
    put(j, text, (size_t)snprintf(text, sizeof text, "%lld", (long long)v));
}

void hm_json_bool(struct hm_json *j, const char *name, bool v)
{
    lead(j, name);
    put(j, v ? "true" : "false", v ? 4 : 5);
}

void hm_json_text(struct hm_json *j, const char *name, const char *text)
{
    lead(j, name);
    if (text)
        put_string(j, text);
    else
        put(j, "null", 4);
}
