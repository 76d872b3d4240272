/* The project's binary: counted blocks behind the header, and `done`. */
#include "hm_reader_private.h"

#include "hm_attr.h"
#include "hm_block.h"
#include "hm_row.h"

#include <stdlib.h>

struct blocks {
    char tag[5];   /* of the block last begun */
    bool pending;  /* its head is read, but nobody has entered it */
    uint64_t left; /* records of it not yet read */
    size_t value;  /* bytes of a number: 8, or 4 in f32le */
};

/* Something is wrong `before` bytes before the next one. */
static enum hm_err wrong(const struct hm_reader *r, int64_t before, const char *what,
                         struct hm_diag *d)
{
    return hm_input_fail_byte(&r->in, HM_EFORMAT, hm_input_tell(&r->in) - before, d, "%s", what);
}

static enum hm_err cut_off(const struct hm_reader *r, struct hm_diag *d)
{
    return hm_input_fail_byte(&r->in, HM_ETRUNC, hm_input_tell(&r->in), d,
                              "cut off: no block \"done\"");
}

/* The next n bytes, which stay in the buffer until the next call. */
static enum hm_err take(struct hm_reader *r, size_t n, const char **bytes, struct hm_diag *d)
{
    enum hm_err err = hm_input_fill(&r->in, n, d);
    if (err)
        return err;
    if (hm_input_has(&r->in) < n)
        return cut_off(r, d);
    *bytes = hm_input_at(&r->in);
    r->in.pos += n;
    return HM_OK;
}

/* Up to `most` whole records that are in the buffer already, at least one. */
static enum hm_err take_records(struct hm_reader *r, size_t size, uint64_t most, const char **bytes,
                                size_t *n, struct hm_diag *d)
{
    struct blocks *b = r->state;
    enum hm_err err = take(r, size, bytes, d);
    if (err)
        return err;
    size_t more = hm_input_has(&r->in) / size;
    if (most > b->left)
        most = b->left;
    *n = most - 1 < more ? (size_t)most : more + 1;
    r->in.pos += (*n - 1) * size;
    b->left -= *n;
    return HM_OK;
}

/* Read the head of the next block. HM_END, and the object has ended, when it is `done`. */
static enum hm_err peek_block(struct hm_reader *r, struct hm_diag *d)
{
    struct blocks *b = r->state;
    const char *head;
    if (b->pending)
        return HM_OK;
    enum hm_err err = take(r, HM_BLOCK_HEAD, &head, d);
    if (err)
        return err;
    memcpy(b->tag, head, 4);
    b->left = hm_block_get_u64(head + 8);
    if (hm_block_get_u32(head + 4) != 0 || b->left > INT64_MAX)
        return wrong(r, HM_BLOCK_HEAD, "the head of a block is damaged", d);
    b->pending = strcmp(b->tag, "done") != 0;
    if (b->pending)
        return HM_OK;
    r->counted = (int64_t)b->left;
    b->left = 0;
    r->ended = true;
    return HM_END;
}

/* Have records of `tag` before us: those of the current block, or of the next. */
static enum hm_err enter_block(struct hm_reader *r, const char *tag, struct hm_diag *d)
{
    struct blocks *b = r->state;
    while (b->left == 0 || b->pending) {
        enum hm_err err = peek_block(r, d);
        if (err)
            return err;
        if (strcmp(b->tag, tag))
            return wrong(r, HM_BLOCK_HEAD, "a block that does not belong here", d);
        b->pending = false;
    }
    return HM_OK;
}

static enum hm_err read_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                               struct hm_diag *d)
{
    struct blocks *b = r->state;
    size_t k = r->nfields;
    while (*n < max) {
        enum hm_err err = enter_block(r, "pnts", d);
        if (err == HM_END)
            return *n > 0 ? HM_OK : HM_END;
        if (err)
            return err;
        size_t got = max - *n < b->left ? max - *n : (size_t)b->left;
        double *v = rows + *n * k;
        err = hm_input_read(&r->in, v, 8 * k * got, d);
        if (err)
            return err == HM_END ? cut_off(r, d) : err;
        hm_block_turn_f64s(v, got * k);
        b->left -= got;
        for (size_t i = 0; i < got; i++)
            if (!hm_reader_good_place(v + i * k))
                return wrong(r, (int64_t)((got - i) * 8 * k), hm_reader_bad_place(v + i * k), d);
        *n += got;
    }
    return HM_OK;
}

static enum hm_err read_row(struct hm_reader *r, double *row, struct hm_diag *d)
{
    const struct blocks *b = r->state;
    size_t bands = r->nfields - 2, nx = (size_t)r->lattice.nx, size = bands * b->value, got;
    bool behind = r->rows == r->lattice.ny;
    for (size_t at = 0; at < nx; at += got) {
        const char *bytes;
        enum hm_err err = enter_block(r, "rows", d);
        if (err == HM_END && behind)
            return HM_END;
        if (err == HM_END)
            return wrong(r, HM_BLOCK_HEAD, "the grid ends before its last node", d);
        if (!err && behind)
            return wrong(r, HM_BLOCK_HEAD, "the grid goes on behind its last node", d);
        if (!err)
            err = take_records(r, size, nx - at, &bytes, &got, d);
        if (err)
            return err;
        double *v = row + at * bands;
        if (b->value == 8)
            hm_block_get_f64s(v, bytes, got * bands);
        else
            for (size_t i = 0; i < got * bands; i++)
                v[i] = (double)hm_block_get_f32(bytes + 4 * i);
        for (size_t i = 0; i < got; i++)
            if (isinf(v[i * bands]))
                return wrong(r, (int64_t)((got - i) * size), "z is infinite", d);
        r->records += (int64_t)got;
    }
    return HM_OK;
}

/* --- lines --- */

static enum hm_err read_attrs(struct hm_reader *r, struct hm_diag *d)
{
    struct blocks *b = r->state;
    size_t size = 0;
    enum hm_err err = peek_block(r, d);
    if (err)
        return err;
    if (strcmp(b->tag, "line"))
        return wrong(r, HM_BLOCK_HEAD, "a block that does not belong here", d);
    b->pending = false;
    while (b->left > 0) {
        const char *bytes;
        size_t got;
        if ((err = take_records(r, 1, b->left, &bytes, &got, d)))
            return err;
        if (!hm_row_is_text(bytes, bytes + got))
            return wrong(r, (int64_t)got, "control characters among attributes", d);
        if (!hm_grow(&r->attrs, &r->attrs_cap, size + got + 1, 1))
            return hm_fail_memory(d);
        memcpy(r->attrs + size, bytes, got);
        size += got;
        r->attrs[size] = '\0';
    }
    struct hm_diag why = {0};
    err = hm_attr_check(r->attrs, &why);
    return err ? wrong(r, (int64_t)size, why.text, d) : HM_OK;
}

/* The vertices of one block `vert`. */
static enum hm_err read_vertices(struct hm_reader *r, struct hm_diag *d)
{
    struct blocks *b = r->state;
    enum hm_err err = HM_OK;
    for (b->pending = false; b->left > 0 && !err; b->left--) {
        const char *bytes;
        double v[3];
        if ((err = take(r, sizeof v, &bytes, d)))
            return err;
        hm_block_get_f64s(v, bytes, 3);
        if (!hm_reader_good_place(v))
            return wrong(r, sizeof v, hm_reader_bad_place(v), d);
        err = hm_reader_add_vertex(r, v, d);
    }
    return err;
}

static enum hm_err read_line(struct hm_reader *r, struct hm_diag *d)
{
    const struct blocks *b = r->state;
    enum hm_err err = read_attrs(r, d);
    while (!err && !(err = peek_block(r, d)) && !strcmp(b->tag, "vert"))
        err = read_vertices(r, d);
    return err == HM_END && r->xyz_n > 0 ? HM_OK : err;
}

/* --- meshes --- */

enum { NODE_BYTES = 40 }; /* x y z flags owner */

static enum hm_err read_node(struct hm_reader *r, struct hm_mesh *m, struct hm_diag *d)
{
    const char *bytes;
    double xyz[3];
    struct hm_node node;
    enum hm_err err = take(r, NODE_BYTES, &bytes, d);
    if (err)
        return err;
    hm_block_get_f64s(xyz, bytes, 3);
    const char *why = hm_reader_make_node(&node, xyz, (int64_t)hm_block_get_u64(bytes + 24),
                                          (int64_t)hm_block_get_u64(bytes + 32));
    return why ? wrong(r, NODE_BYTES, why, d) : hm_mesh_add_node(m, node, d);
}

static enum hm_err read_elem(struct hm_reader *r, int corners, struct hm_mesh *m, struct hm_diag *d)
{
    const char *bytes;
    int64_t numbers[5];
    struct hm_elem elem;
    size_t size = 8 * (size_t)(corners + 1);
    enum hm_err err = take(r, size, &bytes, d);
    if (err)
        return err;
    for (int i = 0; i <= corners; i++)
        numbers[i] = (int64_t)hm_block_get_u64(bytes + 8 * i);
    const char *why = hm_reader_make_elem(&elem, numbers, corners, m->nnodes);
    return why ? wrong(r, (int64_t)size, why, d) : hm_mesh_add_elem(m, elem, d);
}

static enum hm_err read_mesh(struct hm_reader *r, struct hm_mesh *m, struct hm_diag *d)
{
    struct blocks *b = r->state;
    enum hm_err err;
    while (!(err = peek_block(r, d))) {
        bool nodes = !strcmp(b->tag, "vert");
        int corners = !strcmp(b->tag, "tri3") ? 3 : !strcmp(b->tag, "quad") ? 4 : 0;
        if ((!nodes && !corners) || (nodes && m->nelems > 0))
            return wrong(r, HM_BLOCK_HEAD, "a block that does not belong here", d);
        b->pending = false;
        for (; b->left > 0 && !err; b->left--)
            err = nodes ? read_node(r, m, d) : read_elem(r, corners, m, d);
        if (err)
            return err;
    }
    return err == HM_END ? HM_OK : err;
}

static const struct hm_reader_form form = {
    .points = read_points, .row = read_row, .line = read_line, .mesh = read_mesh};

enum hm_err hm_reader_begin_blocks(struct hm_reader *r, enum hm_encoding encoding,
                                   struct hm_diag *d)
{
    struct blocks *b = hm_alloc0(1, sizeof *b);
    if (!b)
        return hm_fail_memory(d);
    b->value = encoding == HM_F32LE ? 4 : 8;
    r->state = b;
    r->form = &form;
    return HM_OK;
}
