/* hm_sink: text and numbers of a foreign format on their way to a writer. Layer 5.
 *
 * A failure is kept, and everything behind it does nothing; hm_sink_finish tells it. So a format is
 * written down without a check a line:
 *
 *     struct hm_sink s = hm_sink_to(w, d);
 *     hm_sink_text(&s, "ND ");
 *     hm_sink_integer(&s, 1);
 *     …
 *     return hm_sink_finish(&s);
 */
#ifndef HM_SINK_H
#define HM_SINK_H

#include "hm_writer.h"

struct hm_sink {
    struct hm_writer *w;
    struct hm_diag *d;
    enum hm_err err;
    size_t n;
    int64_t written; /* bytes put so far */
    char buf[8192];
};

/* w NULL: the bytes are only counted. */
static inline struct hm_sink hm_sink_to(struct hm_writer *w, struct hm_diag *d)
{
    return (struct hm_sink){.w = w, .d = d};
}
/* Hand over what is left; the first failure, if any. */
enum hm_err hm_sink_finish(struct hm_sink *s);

void hm_sink_bytes(struct hm_sink *s, const void *bytes, size_t n);
void hm_sink_text(struct hm_sink *s, const char *text);
void hm_sink_format(struct hm_sink *s, const char *format, ...)
    __attribute__((format(printf, 2, 3))); /* no numbers with a point: those depend on the locale */
void hm_sink_integer(struct hm_sink *s, int64_t v);
/* The shortest decimal that reads back exactly, or, with decimals, rounded to so many places. */
void hm_sink_number(struct hm_sink *s, double v, int decimals);

/* Binary: integers and IEEE numbers, big endian. */
void hm_sink_be32(struct hm_sink *s, uint32_t v);
void hm_sink_be64(struct hm_sink *s, uint64_t v);
void hm_sink_be_double(struct hm_sink *s, double v);

#endif
