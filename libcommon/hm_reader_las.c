/* LAS 1.0 to 1.4, point formats 0 to 10: points with the fields x y z class return returns (of the
 * pulse, this one's number and how many). Points that are marked as withheld are left out. (ASPRS,
 * LAS specification 1.4-R15.) */
#include "hm_reader_private.h"

#include "hm_block.h"
#include "hm_lascrs.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    HEADER = 227,      /* bytes of the header that all versions have */
    HEADER_14 = 375,   /* and that of version 1.4 */
    RECORD_HEAD = 54,  /* of a variable length record */
    COMPRESSED = 0x80, /* in the point format: LAZ */
    FIELDS = 6
};

/* A coordinate is the integer X * scale + offset. Where the scale is one over a whole number and
 * the offset a multiple of it, as in most files, it is made by one division of whole numbers, so
 * that 0.01 * 123 is 1.23 to the last bit. */
struct axis {
    double scale, offset;
    double parts; /* 1 / scale, or 0 */
    double shift; /* offset * parts */
};

struct las {
    struct axis axis[3];
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

static struct axis make_axis(double scale, double offset)
{
    const double most = 0x1p52; /* sums of whole numbers are exact as far as this */
    struct axis a = {scale, offset, 0, 0};
    double parts = nearbyint(1 / scale), shift = nearbyint(offset * parts);
    if (fabs(parts * scale - 1) < 1e-12 && fabs(shift) < most &&
        fabs(shift - offset * parts) <= 1e-9 * fmax(1, fabs(shift))) {
        a.parts = parts;
        a.shift = shift;
    }
    return a;
}

static double coordinate(const struct axis *a, const char *b)
{
    double x = (double)(int32_t)hm_block_get_u32(b);
    return a->parts != 0 ? (x + a->shift) / a->parts : x * a->scale + a->offset;
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
        double scale = hm_block_get_f64(b + 131 + 8 * k);
        double offset = hm_block_get_f64(b + 155 + 8 * k);
        if (!isfinite(scale) || scale == 0 || !isfinite(offset))
            return refuse(r, 131 + 8 * k, "a scale or an offset that is none", d);
        las->axis[k] = make_axis(scale, offset);
    }
    return HM_OK;
}

/* The variable length records, of `room` bytes in all: what they say of the reference system. */
static enum hm_err read_records(struct hm_reader *r, size_t count, size_t room,
                                struct hm_lascrs *crs, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < count && room >= RECORD_HEAD && !err; k++) {
        err = hm_input_fill(&r->in, RECORD_HEAD, d);
        if (err || hm_input_has(&r->in) < RECORD_HEAD)
            return err ? err : cut_off(r, d);
        char user[16];
        memcpy(user, hm_input_at(&r->in) + 2, sizeof user);
        size_t number = get_u16(hm_input_at(&r->in) + 18), n = get_u16(hm_input_at(&r->in) + 20);
        r->in.pos += RECORD_HEAD;
        room -= RECORD_HEAD;
        if (n > room)
            return refuse(r, hm_input_tell(&r->in), "a record reaches into the points", d);
        err = hm_input_fill(&r->in, n, d);
        if (err || hm_input_has(&r->in) < n)
            return err ? err : cut_off(r, d);
        err = hm_lascrs_take(crs, user, number, hm_input_at(&r->in), n, d);
        r->in.pos += n;
        room -= n;
    }
    if (err)
        return err;
    err = hm_input_read(&r->in, NULL, room, d);
    return err == HM_END ? cut_off(r, d) : err;
}

static enum hm_err make_header(struct hm_header *h, const struct hm_lascrs *crs, struct hm_diag *d)
{
    struct hm_lascrs_said said;
    char units[4 * HM_LASCRS_UNIT + 8];
    hm_lascrs_say(crs, &said);
    enum hm_err err = hm_header_init(h, HM_POINTS, d);
    if (!err && *said.crs)
        err = hm_header_set(h, "crs", said.crs, d);
    if (!err && *said.unit) {
        snprintf(units, sizeof units, "%s %s %s", said.unit, said.unit, said.z_unit);
        err = hm_header_set(h, "units", units, d);
    }
    static const char *const field[] = {"class", "return", "returns"};
    for (int k = 0; k < FIELDS - 3 && !err; k++)
        err = hm_header_add_field(h, field[k], NULL, d);
    return err;
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
    const char *b = hm_input_at(&r->in);
    if (b[25] == 4) {
        if (hm_input_has(&r->in) < HEADER_14)
            return cut_off(r, d);
        las->points = hm_block_get_u64(b + 247);
    }
    las->left = las->points;
    size_t header = get_u16(b + 94), records = hm_block_get_u32(b + 100);
    err = hm_input_read(&r->in, NULL, header, d);
    if (err)
        return err == HM_END ? cut_off(r, d) : err;
    struct hm_lascrs crs = {0};
    err = read_records(r, records, data - header, &crs, d);
    if (!err)
        err = make_header(h, &crs, d);
    hm_lascrs_free(&crs);
    return err;
}

/* One record to the fields; false when the point is withheld. */
static bool get_point(const struct las *las, const char *b, double *v)
{
    unsigned returns = (unsigned char)b[14], flags = (unsigned char)b[15];
    for (int k = 0; k < 3; k++)
        v[k] = coordinate(&las->axis[k], b + 4 * k);
    v[3] = las->extended ? (unsigned char)b[16] : flags & 0x1f;
    v[4] = returns & (las->extended ? 15 : 7);
    v[5] = las->extended ? returns >> 4 : returns >> 3 & 7;
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
        if (get_point(las, hm_input_at(&r->in), rows + FIELDS * *n)) {
            if (!hm_reader_good_place(rows + FIELDS * *n))
                return refuse(r, hm_input_tell(&r->in), hm_reader_bad_place(rows + FIELDS * *n), d);
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
