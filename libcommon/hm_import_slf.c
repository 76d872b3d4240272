/* TELEMAC Selafin, in single or double precision; heights are those of BOTTOM (or FOND) in the
 * first frame. */
#include "hm_import_private.h"

#include <stdlib.h>
#include <string.h>

static const char little_endian[4] = "\x50\0\0";

/* The first record is one of 80 bytes, big endian; the other way round it is known, and refused. */
bool hm_import_is_slf(const char *s, const char *end)
{
    return end - s >= 84 && (!memcmp(s, "\0\0\0\x50", 4) || !memcmp(s, little_endian, 4)) &&
           !memcmp(s + 76, "SERAFIN", 7);
}

struct selafin {
    struct hm_input *in;
    struct hm_mesh *m;
    size_t real; /* bytes of a number: 4 or 8 */
    int32_t nvar, bottom;
    int32_t params[10], nelem, npoin, ndp;
    char *record; /* the last one read */
    size_t n, cap;
};

static uint32_t get_u32(const char *b)
{
    const unsigned char *u = (const unsigned char *)b;
    return (uint32_t)u[0] << 24 | (uint32_t)u[1] << 16 | (uint32_t)u[2] << 8 | u[3];
}

static double get_real(const struct selafin *f, size_t i)
{
    const char *b = f->record + i * f->real;
    float single;
    double value;
    uint32_t low = get_u32(b);
    if (f->real == 4) {
        memcpy(&single, &low, sizeof single);
        return single;
    }
    uint64_t bits = (uint64_t)low << 32 | get_u32(b + 4);
    memcpy(&value, &bits, sizeof value);
    return value;
}

static enum hm_err fail(const struct selafin *f, enum hm_err err, struct hm_diag *d,
                        const char *text)
{
    return hm_input_fail_byte(f->in, err, hm_input_tell(f->in), d, "%s", text);
}

static enum hm_err read_mark(struct selafin *f, uint32_t *v, struct hm_diag *d)
{
    char b[4];
    enum hm_err err = hm_input_read(f->in, b, sizeof b, d);
    if (err)
        return err == HM_END ? fail(f, HM_ETRUNC, d, "the file ends in the middle") : err;
    *v = get_u32(b);
    return HM_OK;
}

/* The next record; its length must be `want` unless that is 0. Room is made as bytes come. */
static enum hm_err read_record(struct selafin *f, size_t want, struct hm_diag *d)
{
    enum { STEP = 1 << 20 };
    uint32_t length, again;
    enum hm_err err = read_mark(f, &length, d);
    if (err)
        return err;
    if (want > 0 && length != want)
        return fail(f, HM_EFORMAT, d, "a record has not the length that the counts ask for");
    for (f->n = 0; f->n < length && !err;) {
        size_t part = length - f->n < STEP ? length - f->n : STEP;
        if (!hm_grow(&f->record, &f->cap, f->n + part, 1))
            return hm_fail_memory(d);
        err = hm_input_read(f->in, f->record + f->n, part, d);
        f->n += part;
    }
    if (err)
        return err == HM_END ? fail(f, HM_ETRUNC, d, "the file ends in the middle") : err;
    err = read_mark(f, &again, d);
    if (!err && again != length)
        err = fail(f, HM_EFORMAT, d, "a record has not the same length before and behind it");
    return err;
}

static enum hm_err read_integers(struct selafin *f, int32_t *v, size_t n, struct hm_diag *d)
{
    enum hm_err err = read_record(f, 4 * n, d);
    for (size_t i = 0; i < n && !err; i++)
        v[i] = (int32_t)get_u32(f->record + 4 * i);
    return err;
}

static enum hm_err read_title(struct selafin *f, struct hm_diag *d)
{
    enum hm_err err = hm_input_fill(f->in, sizeof little_endian, d);
    if (!err && hm_input_has(f->in) >= sizeof little_endian &&
        !memcmp(hm_input_at(f->in), little_endian, sizeof little_endian))
        return fail(f, HM_EFORMAT, d,
                    "little-endian, the other way round than Selafin is; write it anew big-endian");
    if (!err)
        err = read_record(f, 80, d);
    if (err)
        return err;
    f->real = f->record[79] == 'D' ? 8 : 4;
    return hm_import_name(f->m, f->record, f->record + 72, d);
}

static enum hm_err read_variables(struct selafin *f, struct hm_diag *d)
{
    int32_t counts[2];
    enum hm_err err = read_integers(f, counts, 2, d);
    f->bottom = -1;
    if (!err && (counts[0] < 0 || counts[1] < 0 || counts[0] > 1000 || counts[1] > 1000))
        err = fail(f, HM_EFORMAT, d, "a number of variables out of range");
    f->nvar = err ? 0 : counts[0] + counts[1];
    for (int32_t k = 0; k < f->nvar && !err; k++) {
        err = read_record(f, 32, d);
        if (!err && f->bottom < 0 &&
            (!memcmp(f->record, "BOTTOM ", 7) || !memcmp(f->record, "FOND ", 5)))
            f->bottom = k;
    }
    return err;
}

static enum hm_err read_counts(struct selafin *f, struct hm_diag *d)
{
    int32_t size[4];
    enum hm_err err = read_integers(f, f->params, 10, d);
    if (!err && f->params[9] == 1)
        err = read_record(f, 24, d); /* the date */
    if (!err)
        err = read_integers(f, size, 4, d);
    if (err)
        return err;
    f->nelem = size[0];
    f->npoin = size[1];
    f->ndp = size[2];
    if (f->nelem < 0 || f->npoin < 1 || (f->ndp != 3 && f->ndp != 4))
        return fail(f, HM_EFORMAT, d, "not a mesh of triangles or quadrilaterals");
    return HM_OK;
}

static enum hm_err read_elems(struct selafin *f, char **ikle, struct hm_diag *d)
{
    enum hm_err err = read_record(f, 4 * (size_t)f->ndp * (size_t)f->nelem, d);
    if (err)
        return err;
    *ikle = f->record; /* kept until there are nodes */
    f->record = NULL;
    f->cap = 0;
    return read_record(f, 4 * (size_t)f->npoin, d);
}

static enum hm_err add_elems(struct selafin *f, const char *ikle, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < (size_t)f->nelem && !err; k++) {
        int64_t node[4] = {0};
        for (size_t i = 0; i < (size_t)f->ndp; i++)
            node[i] = (int64_t)(int32_t)get_u32(ikle + 4 * (k * (size_t)f->ndp + i)) - 1;
        int corners = f->ndp == 4 && node[3] == node[2] ? 3 : f->ndp;
        struct hm_diag own = {0};
        err = hm_import_elem(f->in, f->m, node, corners, 0, &own);
        if (err)
            err = err == HM_ENOMEM ? hm_fail_memory(d) : fail(f, err, d, own.text);
    }
    return err;
}

/* x, y, and z in their records one after the other. */
static enum hm_err read_nodes(struct selafin *f, struct hm_diag *d)
{
    size_t n = (size_t)f->npoin;
    enum hm_err err = read_record(f, n * f->real, d);
    struct hm_diag own = {0};
    for (size_t i = 0; i < n && !err; i++) {
        double place[3] = {get_real(f, i) + f->params[2], 0, 0};
        err = hm_import_node(f->in, f->m, place, &own);
    }
    if (!err)
        err = read_record(f, n * f->real, d);
    for (size_t i = 0; i < n && !err; i++)
        f->m->node[i].y = get_real(f, i) + f->params[3];
    if (!err)
        err = read_record(f, f->real, d); /* the time of the frame */
    for (int32_t k = 0; k < f->nvar && !err; k++) {
        err = read_record(f, n * f->real, d);
        for (size_t i = 0; i < n && !err && k == f->bottom; i++)
            f->m->node[i].z = get_real(f, i);
    }
    for (size_t i = 0; i < n && !err; i++) {
        struct hm_node *node = &f->m->node[i];
        const char *why = hm_reader_make_node(node, (double[]){node->x, node->y, node->z}, 0, 0);
        if (why)
            err = fail(f, HM_EFORMAT, d, why);
    }
    return err && own.err ? fail(f, err, d, own.text) : err;
}

enum hm_err hm_import_slf(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct selafin f = {.in = in, .m = m};
    char *ikle = NULL;
    enum hm_err err = read_title(&f, d);
    if (!err)
        err = read_variables(&f, d);
    if (!err && f.bottom < 0)
        err = fail(&f, HM_EFORMAT, d, "no variable BOTTOM");
    if (!err)
        err = read_counts(&f, d);
    if (!err)
        err = read_elems(&f, &ikle, d);
    if (!err)
        err = read_nodes(&f, d);
    if (!err)
        err = add_elems(&f, ikle, d);
    while (!err && !hm_input_read(in, NULL, 1 << 16, d)) /* further frames */
        ;
    free(f.record);
    free(ikle);
    return err;
}
