/* Numbers for the page: seven bits a byte, the lowest first, the eighth bit says that more follow;
 * the signed v as 2v, or as -2v-1 below 0. Neighbours in a mesh have near numbers, so their
 * differences take a byte or two. Then base64 (RFC 4648). */
#include "scene.h"

#include <stdlib.h>

void encode_unsigned(struct encoder *c, uint64_t v)
{
    if (c->err || !hm_grow(&c->byte, &c->cap, c->n + 10, 1)) {
        c->err = HM_ENOMEM;
        return;
    }
    for (; v > 127; v >>= 7)
        c->byte[c->n++] = (unsigned char)(v | 128);
    c->byte[c->n++] = (unsigned char)v;
}

void encode_signed(struct encoder *c, int64_t v)
{
    encode_unsigned(c, v < 0 ? ~((uint64_t)v << 1) : (uint64_t)v << 1);
}

void encode_run_end(struct encoder *c)
{
    if (c->run) {
        encode_unsigned(c, c->run_value);
        encode_unsigned(c, c->run);
    }
    c->run = 0;
}

void encode_run(struct encoder *c, uint64_t v)
{
    if (v != c->run_value)
        encode_run_end(c);
    c->run_value = v;
    c->run++;
}

/* Three bytes as four letters; behind the last byte '='. */
static void letters_of(const unsigned char *byte, size_t n, char out[4])
{
    static const char letter[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned v = (unsigned)byte[0] << 16;
    v |= n > 1 ? (unsigned)byte[1] << 8 : 0;
    v |= n > 2 ? (unsigned)byte[2] : 0;
    out[0] = letter[v >> 18];
    out[1] = letter[v >> 12 & 63];
    out[2] = n > 1 ? letter[v >> 6 & 63] : '=';
    out[3] = n > 2 ? letter[v & 63] : '=';
}

enum hm_err encoder_write(struct encoder *c, const char *id, struct hm_writer *w, struct hm_diag *d)
{
    enum { PIECE = 3 * 4096 };
    char text[PIECE / 3 * 4];
    enum hm_err err = c->err ? hm_fail_memory(d) : HM_OK;
    if (!err)
        err = hm_writer_printf(w, d, "<script type=\"text/plain\" id=\"data-%s\">", id);
    for (size_t i = 0; i < c->n && !err; i += PIECE) {
        const size_t n = c->n - i < PIECE ? c->n - i : PIECE;
        for (size_t k = 0; k < n; k += 3)
            letters_of(&c->byte[i + k], n - k, &text[k / 3 * 4]);
        err = hm_writer_bytes(w, text, (n + 2) / 3 * 4, d);
    }
    if (!err)
        err = hm_writer_printf(w, d, "</script>\n");
    free(c->byte);
    *c = (struct encoder){0};
    return err;
}
