#include "hm_attr.h"

#include "hm_num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One attribute as it stands in the text. */
struct item {
    const char *key, *key_end;
    const char *value, *value_end; /* raw, with its quotes; NULL for a bare word */
    const char *mistake;           /* what is wrong with it, or NULL */
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* A quoted value that starts at p: the end behind its closing quote. */
static const char *skip_quoted(const char *p, struct item *item)
{
    for (p++; *p && *p != '"'; p++)
        if (*p == '\\' && p[1])
            p++;
    if (!*p)
        item->mistake = "a quote is not closed";
    else if (*++p && !is_blank(*p))
        item->mistake = "no blank behind a quoted value";
    return p;
}

/* Take the attribute at *p, and move *p behind it; false at the end of the text. */
static bool take_item(const char **p, struct item *item)
{
    const char *s = *p;
    while (is_blank(*s))
        s++;
    if (!*s)
        return false;
    *item = (struct item){.key = s};
    while (*s && *s != '=' && *s != '"' && !is_blank(*s))
        s++;
    item->key_end = s;
    if (s == item->key || *s == '"')
        item->mistake = "expected key=value";
    if (*s == '=') {
        item->value = ++s;
        if (*s == '"')
            s = skip_quoted(s, item);
    }
    while (*s && !is_blank(*s))
        s++;
    if (item->value)
        item->value_end = s;
    *p = s;
    return true;
}

static bool has_key(const struct item *item, const char *key)
{
    size_t n = strlen(key);
    return (size_t)(item->key_end - item->key) == n && memcmp(item->key, key, n) == 0;
}

/* The last attribute with that key. */
static bool find(const char *attrs, const char *key, struct item *found)
{
    struct item item;
    bool any = false;
    for (const char *p = attrs ? attrs : ""; take_item(&p, &item);)
        if (has_key(&item, key)) {
            *found = item;
            any = true;
        }
    return any;
}

static void unquote(const struct item *item, char *value, size_t size)
{
    const char *p = item->value ? item->value : "1";
    const char *end = item->value ? item->value_end : p + 1;
    bool quoted = p < end && *p == '"';
    size_t n = 0;
    for (p += quoted; p < end && !(quoted && *p == '"'); p++) {
        if (quoted && *p == '\\' && p + 1 < end)
            p++;
        if (n + 1 < size)
            value[n++] = *p;
    }
    if (size)
        value[n] = 0;
}

bool hm_attr_get(const char *attrs, const char *key, char *value, size_t size)
{
    struct item item;
    if (size)
        *value = 0;
    if (!find(attrs, key, &item))
        return false;
    unquote(&item, value, size);
    return true;
}

enum hm_err hm_attr_number(const char *attrs, const char *key, double otherwise, double *value,
                           struct hm_diag *d)
{
    char text[64];
    *value = otherwise;
    if (!hm_attr_get(attrs, key, text, sizeof text))
        return HM_OK;
    double number;
    const char *end = text + strlen(text);
    if (hm_num_parse(text, end, &number) != end || !isfinite(number))
        return hm_fail(d, HM_EFORMAT, "attribute %s=%s: expected a number", key, text);
    *value = number;
    return HM_OK;
}

bool hm_attr_flag(const char *attrs, const char *key)
{
    char text[4];
    return hm_attr_get(attrs, key, text, sizeof text) && strcmp(text, "0") != 0;
}

static bool needs_quotes(const char *value)
{
    return !*value || strpbrk(value, " \t\r\n\"\\") != NULL;
}

/* key=value to p; returns the end. */
static char *put_item(char *p, const char *key, const char *value)
{
    size_t n = strlen(key);
    memcpy(p, key, n);
    p += n;
    *p++ = '=';
    if (!needs_quotes(value)) {
        n = strlen(value);
        memcpy(p, value, n);
        return p + n;
    }
    *p++ = '"';
    for (; *value; value++) {
        if (*value == '"' || *value == '\\')
            *p++ = '\\';
        *p++ = *value;
    }
    *p++ = '"';
    return p;
}

char *hm_attr_set(const char *attrs, const char *key, const char *value)
{
    attrs = attrs ? attrs : "";
    size_t room = strlen(attrs) + strlen(key) + (value ? 2 * strlen(value) : 0) + 8;
    char *set = hm_alloc(room, 1), *out = set;
    if (!set)
        return NULL;
    struct item item;
    const char *p = attrs, *copied = attrs;
    while (copied = p, take_item(&p, &item)) {
        if (has_key(&item, key) && !value)
            continue; /* goes, with the blanks before it */
        if (out == set)
            copied = item.key; /* nothing stands before it any more */
        if (has_key(&item, key)) {
            memcpy(out, copied, (size_t)(item.key - copied));
            out = put_item(out + (item.key - copied), key, value);
            value = NULL; /* further ones go */
            continue;
        }
        memcpy(out, copied, (size_t)(p - copied));
        out += p - copied;
    }
    if (value) {
        if (out > set)
            *out++ = ' ';
        out = put_item(out, key, value);
    }
    *out = 0;
    return set;
}

enum hm_err hm_attr_check(const char *attrs, struct hm_diag *d)
{
    struct item item;
    for (const char *p = attrs ? attrs : ""; take_item(&p, &item);)
        if (item.mistake)
            return hm_fail(d, HM_EFORMAT, "attribute '%.*s': %s", (int)(p - item.key), item.key,
                           item.mistake);
    return HM_OK;
}

/* Append an attribute, or put its value in the place of that of an earlier one. */
static bool list_item(struct hm_attr_list *list, const struct item *item)
{
    size_t k = 0, room = 2 + (item->value ? (size_t)(item->value_end - item->value) : 0);
    while (k < list->n && !has_key(item, list->item[k].key))
        k++;
    char *value = hm_alloc(room, 1);
    if (!value || !hm_grow(&list->item, &list->cap, k + 1, sizeof *list->item)) {
        free(value);
        return false;
    }
    unquote(item, value, room);
    if (k == list->n)
        list->item[list->n++] =
            (struct hm_attr){strndup(item->key, (size_t)(item->key_end - item->key)), NULL};
    free(list->item[k].value);
    list->item[k].value = value;
    return list->item[k].key != NULL;
}

bool hm_attr_list_read(struct hm_attr_list *list, const char *attrs)
{
    struct item item;
    for (const char *p = attrs ? attrs : ""; take_item(&p, &item);)
        if (!list_item(list, &item))
            return false;
    return true;
}

const char *hm_attr_list_get(const struct hm_attr_list *list, const char *key)
{
    for (size_t k = 0; k < list->n; k++)
        if (!strcmp(list->item[k].key, key))
            return list->item[k].value;
    return NULL;
}

void hm_attr_list_free(struct hm_attr_list *list)
{
    for (size_t k = 0; k < list->n; k++) {
        free(list->item[k].key);
        free(list->item[k].value);
    }
    free(list->item);
    *list = (struct hm_attr_list){0};
}
