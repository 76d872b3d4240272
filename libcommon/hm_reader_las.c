/* LAS 1.0 to 1.4, point formats 0 to 10: points with the fields x y z class. Points that are marked
 * as withheld are left out. (ASPRS, LAS specification 1.4-R15.) */
#include "hm_reader_private.h"

#include "hm_block.h"

#include <stdlib.h>

enum {
    HEADER = 227,     /* bytes of the header that all versions have */
    HEADER_14 = 375,  /* and that of version 1.4 */
    COMPRESSED = 0x80 /* in the point format: LAZ */
};

struct las {
    double scale[3], offset[3];
    size_t record;   /* bytes of a point */
    bool extended;   /* formats 6 to 10 */
    uint64_t points; /* in the file */
    uint64_t left;   /* not yet read */
};

static size_t get_u16(const char *b)
{
    const unsigned char *u = (const unsigned char *)b;
    return (size_t)(u[0] | u[1] << 8);
}

static enum hm_err refuse(struct hm_reader *r, int64_t at, const char *what, struct hm_diag *d)
{
    return hm_input_fail_byte(&r->in, HM_EFORMAT, at, d, "LAS: %s", what);
}

static enum hm_err cut_off(struct hm_reader *r, struct hm_diag *d)
{
    const struct las *las = r->state;
    return hm_input_fail_byte(
        &r->in, HM_ETRUNC, hm_input_tell(&r->in), d, "LAS: cut off behind %llu of %llu points",
        (unsigned long long)(las->points - las->left), (unsigned long long)las->points);
}

/* What the bytes of the header say of the points. */
static enum hm_err read_layout(struct hm_reader *r, const char *b, size_t *data, struct hm_diag *d)
{
    static const size_t least[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    struct las *las = r->state;
    unsigned format = (unsigned char)b[104];
    size_t header = get_u16(b + 94);
    *data = hm_block_get_u32(b + 96);
    if (format & COMPRESSED)
        return hm_input_fail_byte(&r->in, HM_EFORMAT, 104, d,
                                  "LAZ, which is compressed: decompress it into a pipe by "
                                  "\"laszip -i %s -stdout -olas\"",
                                  strcmp(r->in.name, "standard input") ? r->in.name : "FILE");
    if (b[24] != 1 || b[25] < 0 || b[25] > 4)
        return refuse(r, 24, "a version other than 1.0 to 1.4", d);
    if (format > 10)
        return refuse(r, 104, "a point format other than 0 to 10", d);
    las->record = get_u16(b + 105);
    las->extended = format >= 6;
    if (las->record < least[format])
        return refuse(r, 105, "a record length too small for its point format", d);
    las->points = hm_block_get_u32(b + 107);
    if (header < HEADER || *data < header || (b[25] == 4 && header < HEADER_14))
        return refuse(r, 94, "a header too small for its version", d);
    for (int k = 0; k < 3; k++) {
        las->scale[k] = hm_block_get_f64(b + 131 + 8 * k);
        las->offset[k] = hm_block_get_f64(b + 155 + 8 * k);
        if (!isfinite(las->scale[k]) || las->scale[k] == 0 || !isfinite(las->offset[k]))
            return refuse(r, 131 + 8 * k, "a scale or an offset that is none", d);
    }
    return HM_OK;
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct las *las = hm_alloc0(1, sizeof *las);
    size_t data = 0;
    if (!las)
        return hm_fail_memory(d);
    r->state = las;
    enum hm_err err = hm_input_fill(&r->in, HEADER_14, d);
    if (!err && hm_input_has(&r->in) < HEADER)
        return cut_off(r, d);
    if (!err)
        err = read_layout(r, hm_input_at(&r->in), &data, d);
    if (err)
        return err;
    if (hm_input_at(&r->in)[25] == 4) {
        if (hm_input_has(&r->in) < HEADER_14)
            return cut_off(r, d);
        las->points = hm_block_get_u64(hm_input_at(&r->in) + 247);
    }
    las->left = las->points;
    err = hm_input_read(&r->in, NULL, data, d);
    if (err)
        return err == HM_END ? cut_off(r, d) : err;
    err = hm_header_init(h, HM_POINTS, d);
    return err ? err : hm_header_add_field(h, "class", NULL, d);
}

/* One record to x y z class; false when the point is withheld. */
static bool get_point(const struct las *las, const char *b, double *v)
{
    unsigned flags = (unsigned char)b[15];
    for (int k = 0; k < 3; k++)
        v[k] = (double)(int32_t)hm_block_get_u32(b + 4 * k) * las->scale[k] + las->offset[k];
    v[3] = las->extended ? (unsigned char)b[16] : flags & 0x1f;
    return !(flags & (las->extended ? 0x04 : 0x80));
}

static enum hm_err read_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                               struct hm_diag *d)
{
    struct las *las = r->state;
    while (*n < max && las->left > 0) {
        enum hm_err err = hm_input_fill(&r->in, las->record, d);
        if (err)
            return err;
        if (hm_input_has(&r->in) < las->record)
            return cut_off(r, d);
        if (get_point(las, hm_input_at(&r->in), rows + 4 * *n)) {
            if (!hm_reader_good_place(rows + 4 * *n))
                return refuse(r, hm_input_tell(&r->in), hm_reader_bad_place(rows + 4 * *n), d);
            ++*n;
        }
        r->in.pos += las->record;
        las->left--;
    }
    if (*n > 0)
        return HM_OK;
    /* extended variable length records may follow, and mean nothing here */
    enum hm_err err;
    while (!(err = hm_input_fill(&r->in, 1, d)) && hm_input_has(&r->in) > 0)
        r->in.pos = r->in.fill;
    if (err)
        return err;
    r->ended = true;
    return HM_END;
}

const struct hm_reader_form hm_reader_las = {.begin = begin, .points = read_points};
