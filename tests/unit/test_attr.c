#include "hm_attr.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static bool gets(const char *attrs, const char *key, const char *want)
{
    char value[32];
    return hm_attr_get(attrs, key, value, sizeof value) && strcmp(value, want) == 0;
}

static bool sets(const char *attrs, const char *key, const char *value, const char *want)
{
    char *set = hm_attr_set(attrs, key, value);
    bool good = set && strcmp(set, want) == 0;
    if (!good)
        printf("# got <%s>, want <%s>\n", set ? set : "NULL", want);
    free(set);
    return good;
}

static void reading(void)
{
    const char *attrs = "surface=main  side=left\tname=\"upper \\\"old\\\" bank\" closed note=";
    char value[8];
    ok(gets(attrs, "surface", "main") && gets(attrs, "side", "left"), "plain values");
    ok(gets(attrs, "name", "upper \"old\" bank"), "a quoted value, with quotes inside");
    ok(gets(attrs, "closed", "1"), "a bare word counts as 1");
    ok(gets(attrs, "note", ""), "an empty value");
    ok(!hm_attr_get(attrs, "sid", value, sizeof value) && !*value, "part of a key is no key");
    ok(!hm_attr_get(attrs, "old", value, sizeof value), "no key inside quotes");
    ok(!hm_attr_get(NULL, "x", value, sizeof value), "NULL has none");
    ok(gets("a=1 a=2", "a", "2"), "the later one overrides");
    ok(gets("a=x=y", "a", "x=y"), "a value may hold an equals sign");
    ok(hm_attr_get(attrs, "name", value, sizeof value) && strcmp(value, "upper \"") == 0,
       "a long value is cut to fit");
    ok(hm_attr_flag("hole=1", "hole") && hm_attr_flag("hole", "hole") &&
           !hm_attr_flag("hole=0", "hole") && !hm_attr_flag("", "hole"),
       "flags");
}

static void numbers(void)
{
    struct hm_diag d = {0};
    double v = 0;
    ok(!hm_attr_number("limit=-2.5e-1", "limit", 7, &v, &d) && v == -0.25, "a number");
    ok(!hm_attr_number("", "limit", 7, &v, &d) && v == 7, "the default");
    ok(hm_attr_number("limit=5m", "limit", 7, &v, &d) == HM_EFORMAT && strstr(d.text, "limit=5m"),
       "no number: named in the diagnostic");
    ok(hm_attr_number("limit=nan", "limit", 7, &v, NULL) == HM_EFORMAT, "nan is no number here");
    ok(hm_attr_number("limit=", "limit", 7, &v, NULL) == HM_EFORMAT, "nor is nothing");
}

static void setting(void)
{
    ok(sets("", "a", "1", "a=1"), "set in nothing");
    ok(sets(NULL, "a", "1", "a=1"), "set in NULL");
    ok(sets("b=2", "a", "1", "b=2 a=1"), "set appends");
    ok(sets("a=0  b=2\tc", "a", "1", "a=1  b=2\tc"), "set replaces in place, others as they were");
    ok(sets("a=0 b=2 a=3", "a", "1", "a=1 b=2"), "set leaves only one");
    ok(sets("b=2 a=0 c", "a", NULL, "b=2 c"), "removed with its blanks");
    ok(sets("a=0 b=2  c", "a", NULL, "b=2  c"), "the first removed: no blank in its place");
    ok(sets("a=0", "a", NULL, ""), "the last one removed");
    ok(sets("b", "a", "x y", "b a=\"x y\""), "blanks are quoted");
    ok(sets("", "a", "q\"\\", "a=\"q\\\"\\\\\""), "so are quotes and backslashes");
    char *set = hm_attr_set("k=1", "a", "q\" \\ w");
    ok(set && gets(set, "a", "q\" \\ w") && !hm_attr_check(set, NULL), "what is set can be read");
    free(set);
}

static void checking(void)
{
    struct hm_diag d = {0};
    ok(!hm_attr_check("a=1 b c=\"d e\"", &d) && !hm_attr_check("", &d) && !hm_attr_check(NULL, &d),
       "well formed");
    ok(hm_attr_check("a=\"b c", &d) == HM_EFORMAT && strstr(d.text, "not closed"), "open quote");
    ok(hm_attr_check("=3", NULL) == HM_EFORMAT, "no key");
    ok(hm_attr_check("a=\"b\"c", NULL) == HM_EFORMAT, "text behind a quote");
    ok(hm_attr_check("a\"b\"", NULL) == HM_EFORMAT, "a quote in a key");
    ok(hm_attr_check("a=\"b\\\"", NULL) == HM_EFORMAT, "a protected quote does not close");
}

int main(void)
{
    reading();
    numbers();
    setting();
    checking();
    return done();
}
