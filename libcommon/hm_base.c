#include "hm_base.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void describe(struct hm_diag *d, enum hm_err err, const char *format, va_list args)
{
    d->err = err;
    vsnprintf(d->text, sizeof d->text, format, args);
}

enum hm_err hm_fail(struct hm_diag *d, enum hm_err err, const char *format, ...)
{
    if (d && !d->err) {
        va_list args;
        va_start(args, format);
        describe(d, err, format, args);
        va_end(args);
    }
    return err;
}

enum hm_err hm_fail_at(struct hm_diag *d, enum hm_err err, double x, double y, const char *format,
                       ...)
{
    if (d && !d->err) {
        va_list args;
        va_start(args, format);
        describe(d, err, format, args);
        va_end(args);
        d->has_place = true;
        d->x = x;
        d->y = y;
    }
    return err;
}

enum hm_err hm_fail_line(struct hm_diag *d, enum hm_err err, const char *source, int64_t line,
                         const char *format, ...)
{
    if (d && !d->err) {
        va_list args;
        va_start(args, format);
        describe(d, err, format, args);
        va_end(args);
        snprintf(d->source, sizeof d->source, "%s", source);
        d->line = line;
    }
    return err;
}

enum hm_err hm_fail_memory(struct hm_diag *d)
{
    return hm_fail(d, HM_ENOMEM, "out of memory");
}

enum hm_err hm_fail_place(struct hm_diag *d, enum hm_err err, double x, double y)
{
    if (err && d && !d->has_place) {
        d->has_place = true;
        d->x = x;
        d->y = y;
    }
    return err;
}

void *hm_alloc(size_t count, size_t size)
{
    if (size && count > PTRDIFF_MAX / size)
        return NULL;
    size_t bytes = count * size;
    return malloc(bytes > 0 ? bytes : 1);
}

void *hm_alloc0(size_t count, size_t size)
{
    if (size && count > PTRDIFF_MAX / size)
        return NULL;
    return calloc(count ? count : 1, size ? size : 1);
}

bool hm_grow(void *items, size_t *cap, size_t need, size_t size)
{
    if (need <= *cap)
        return true;
    size_t most = PTRDIFF_MAX / size;
    if (need > most)
        return false;
    size_t room = *cap > most - *cap / 2 ? most : *cap + *cap / 2;
    if (room < need)
        room = need;
    if (room < 16 && most >= 16)
        room = 16;
    void *old, *grown;
    memcpy(&old, items, sizeof old); /* items is a T **; its pointee is copied, not aliased */
    grown = realloc(old, room * size);
    if (!grown)
        return false;
    memcpy(items, &grown, sizeof grown);
    *cap = room;
    return true; // cppcheck-suppress memleak ; the caller's array holds it
}
