#include "hm_sink.h"

#include "hm_num.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void flush(struct hm_sink *s)
{
    if (s->w && !s->err && s->n > 0)
        s->err = hm_writer_bytes(s->w, s->buf, s->n, s->d);
    s->n = 0;
}

enum hm_err hm_sink_finish(struct hm_sink *s)
{
    flush(s);
    return s->err;
}

/* Room for n more bytes, at most the buffer. */
static char *room(struct hm_sink *s, size_t n)
{
    if (sizeof s->buf - s->n < n)
        flush(s);
    return s->buf + s->n;
}

static void took(struct hm_sink *s, size_t n)
{
    s->n += n;
    s->written += (int64_t)n;
}

void hm_sink_bytes(struct hm_sink *s, const void *bytes, size_t n)
{
    if (n > sizeof s->buf) {
        flush(s);
        if (s->w && !s->err)
            s->err = hm_writer_bytes(s->w, bytes, n, s->d);
        s->written += (int64_t)n;
        return;
    }
    memcpy(room(s, n), bytes, n);
    took(s, n);
}

void hm_sink_text(struct hm_sink *s, const char *text)
{
    hm_sink_bytes(s, text, strlen(text));
}

void hm_sink_format(struct hm_sink *s, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if ((n < 0 || (size_t)n >= sizeof text) && !s->err)
        s->err = hm_fail(s->d, HM_EARG, "text too long for the format");
    else if (n > 0)
        hm_sink_bytes(s, text, (size_t)n);
}

void hm_sink_integer(struct hm_sink *s, int64_t v)
{
    took(s, (size_t)sprintf(room(s, 24), "%" PRId64, v));
}

void hm_sink_number(struct hm_sink *s, double v, int decimals)
{
    char *p = room(s, HM_NUM_CHARS);
    took(s, decimals ? hm_num_print_fixed(p, v, decimals) : hm_num_print(p, v));
}

void hm_sink_be32(struct hm_sink *s, uint32_t v)
{
    char b[4];
    for (int i = 0; i < 4; i++)
        b[i] = (char)(v >> (24 - 8 * i));
    hm_sink_bytes(s, b, sizeof b);
}

void hm_sink_be64(struct hm_sink *s, uint64_t v)
{
    hm_sink_be32(s, (uint32_t)(v >> 32));
    hm_sink_be32(s, (uint32_t)v);
}

void hm_sink_be_double(struct hm_sink *s, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    hm_sink_be64(s, bits);
}
