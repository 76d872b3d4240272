/* The project's own text: a header, a record a line, `#end`. */
#include "hm_reader_private.h"

#include "hm_attr.h"
#include "hm_row.h"

/* What a line that is no record means: HM_OK for a comment or nothing, HM_END behind `#end`. */
static enum hm_err other_line(struct hm_reader *r, const char *s, const char *end, bool *known,
                              struct hm_diag *d)
{
    s = hm_row_skip(s, end);
    *known = s == end || *s == '#';
    if (!*known)
        return HM_OK;
    if (hm_row_begins(s, end, "#hm"))
        return hm_input_fail(&r->in, HM_ETRUNC, d, "cut off: the object before has no #end");
    if (!hm_row_begins(s, end, "#end"))
        return HM_OK;
    double count;
    if (hm_row_parse(s + 4, end, &count, 1)) {
        if (!(count >= 0 && count <= 9007199254740992.0) || count != floor(count))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "the count behind #end is none");
        r->counted = (int64_t)count;
    } else if (hm_row_skip(s + 4, end) < end) {
        return hm_row_fail(&r->in, s + 4, end, 1, false, d);
    }
    r->ended = true;
    return HM_END;
}

/* The next line of the object; HM_END when it has ended. Comments are passed over. */
static enum hm_err next_line(struct hm_reader *r, const char **s, const char **end,
                             struct hm_diag *d)
{
    bool known;
    enum hm_err err;
    do {
        err = hm_input_line(&r->in, s, end, d);
        if (err == HM_END)
            return hm_input_fail(&r->in, HM_ETRUNC, d, "cut off: no #end");
        if (!err && r->in.unfinished && !hm_row_begins(*s, *end, "#end"))
            return hm_input_fail(&r->in, HM_ETRUNC, d, "cut off in the middle of a line");
        if (!err)
            err = other_line(r, *s, *end, &known, d);
    } while (!err && known);
    return err;
}

static enum hm_err read_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                               struct hm_diag *d)
{
    size_t k = r->nfields;
    enum hm_err err = hm_reader_plain_points(r, rows, max, n, d);
    if (err)
        return err;
    while (*n < max) {
        const char *s, *end;
        double *v = rows + *n * k;
        err = hm_input_line(&r->in, &s, &end, d);
        if (!err && hm_row_parse(s, end, v, k) && hm_reader_good_place(v)) {
            ++*n;
            continue;
        }
        if (!err)
            hm_input_unread(&r->in); /* and look at it more closely */
        err = next_line(r, &s, &end, d);
        if (err)
            return err == HM_END && *n > 0 ? HM_OK : err;
        if (!hm_row_parse(s, end, v, k))
            return hm_row_fail(&r->in, s, end, k, false, d);
        if (!hm_reader_good_place(v))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", hm_reader_bad_place(v));
        ++*n;
    }
    return HM_OK;
}

/* --- grids --- */

struct text_grid {
    int64_t next; /* least number that the next node may have */
    bool seen_end;
};

/* The node at x, y as its number in the lattice, x fastest; -1 when there is none within a
 * millionth of a step. */
static int64_t node_number(const struct hm_lattice *l, double x, double y)
{
    double u = (x - l->x0) / l->dx, v = (y - l->y0) / l->dy;
    double i = floor(u + 0.5), j = floor(v + 0.5);
    if (!(fabs(u - i) <= 1e-6 && fabs(v - j) <= 1e-6))
        return -1;
    if (!(i >= 0 && i < (double)l->nx && j >= 0 && j < (double)l->ny))
        return -1;
    return (int64_t)j * l->nx + (int64_t)i;
}

/* A filter may have taken nodes out of a grid; they are nodata. But a lattice that is a mere claim
 * must not make a long grid out of nothing. */
static bool too_thin(const struct hm_reader *r, int64_t number)
{
    return number / 1000 > r->records + 1000;
}

/* The next node: its number, and its row in r->row. */
static enum hm_err read_node(struct hm_reader *r, int64_t *number, struct hm_diag *d)
{
    const struct text_grid *grid = r->state;
    const char *s, *end, *why = NULL;
    double *v = r->row;
    enum hm_err err = next_line(r, &s, &end, d);
    if (err)
        return err;
    if (!hm_row_parse(s, end, v, r->nfields))
        return hm_row_fail(&r->in, s, end, r->nfields, false, d);
    if (!hm_reader_good_place(v))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", hm_reader_bad_place(v));
    *number = node_number(&r->lattice, v[0], v[1]);
    if (*number < 0)
        why = "not at a node of the lattice that the header describes";
    else if (*number < grid->next)
        why = "out of lattice order (x fastest)";
    else if (too_thin(r, *number))
        why = "nearly all nodes of the grid are missing";
    return why ? hm_input_fail(&r->in, HM_EFORMAT, d, "%s", why) : HM_OK;
}

/* Let the values of row from `from` to `to` be nodata. */
static void blank_out(double *row, int64_t from, int64_t to)
{
    for (; from < to; from++)
        row[from] = NAN;
}

static enum hm_err read_row(struct hm_reader *r, double *row, struct hm_diag *d)
{
    struct text_grid *grid = r->state;
    int64_t bands = (int64_t)r->nfields - 2, nx = r->lattice.nx, first = r->rows * nx, at = 0;
    while (!grid->seen_end && (at < nx || r->rows == r->lattice.ny)) {
        int64_t number = 0;
        enum hm_err err = read_node(r, &number, d);
        if (err && err != HM_END)
            return err;
        if (err == HM_END) {
            grid->seen_end = true;
            r->ended = false; /* rows of nodata may follow */
            if (too_thin(r, nx * r->lattice.ny))
                return hm_input_fail(&r->in, HM_EFORMAT, d,
                                     "nearly all nodes of the grid are missing");
            break;
        }
        if (number - first >= nx) {
            hm_input_unread(&r->in);
            break;
        }
        blank_out(row, at * bands, (number - first) * bands);
        at = number - first;
        memcpy(row + at * bands, r->row + 2, (size_t)bands * sizeof *row);
        at++;
        r->records++;
        grid->next = number + 1;
    }
    if (r->rows == r->lattice.ny) {
        r->ended = true;
        return HM_END;
    }
    blank_out(row, at * bands, nx * bands);
    return HM_OK;
}

/* --- lines --- */

/* The mark `>` and the attributes behind it. */
static enum hm_err read_mark(struct hm_reader *r, struct hm_diag *d)
{
    const char *s, *end;
    enum hm_err err = next_line(r, &s, &end, d);
    if (err)
        return err;
    s = hm_row_skip(s, end);
    if (*s != '>')
        return hm_input_fail(&r->in, HM_EFORMAT, d, "expected '>', which begins a line");
    s = hm_row_skip(s + 1, end);
    while (end > s && hm_row_is_blank(end[-1]))
        end--;
    struct hm_diag why = {0};
    if (!hm_row_is_text(s, end))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "control characters among attributes");
    err = hm_reader_set_attrs(r, s, (size_t)(end - s), d);
    if (!err && (err = hm_attr_check(r->attrs, &why)))
        hm_input_fail(&r->in, err, d, "%s", why.text);
    return err;
}

static enum hm_err read_line(struct hm_reader *r, struct hm_diag *d)
{
    enum hm_err err = read_mark(r, d);
    while (!err) {
        const char *s, *end;
        double v[3];
        err = next_line(r, &s, &end, d);
        if (err)
            break;
        if (*hm_row_skip(s, end) == '>') {
            hm_input_unread(&r->in);
            break;
        }
        if (!hm_row_parse(s, end, v, 3))
            return hm_row_fail(&r->in, s, end, 3, false, d);
        if (!hm_reader_good_place(v))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", hm_reader_bad_place(v));
        err = hm_reader_add_vertex(r, v, d);
    }
    return err == HM_END && r->xyz_n > 0 ? HM_OK : err;
}

/* --- meshes --- */

static enum hm_err add_node(struct hm_reader *r, const double v[5], struct hm_mesh *m,
                            struct hm_diag *d)
{
    struct hm_node node;
    if (m->nelems > 0)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "a node behind the first element");
    if (!(fabs(v[3]) <= INT32_MAX && fabs(v[4]) <= INT32_MAX && v[3] == floor(v[3]) &&
          v[4] == floor(v[4])))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "flags and owner must be whole numbers");
    const char *why = hm_reader_make_node(&node, v, (int64_t)v[3], (int64_t)v[4]);
    return why ? hm_input_fail(&r->in, HM_EFORMAT, d, "%s", why) : hm_mesh_add_node(m, node, d);
}

static enum hm_err add_elem(struct hm_reader *r, const double v[5], int corners, struct hm_mesh *m,
                            struct hm_diag *d)
{
    int64_t numbers[5];
    struct hm_elem elem;
    for (int i = 0; i <= corners; i++) {
        if (!(fabs(v[i]) <= 9007199254740992.0 && v[i] == floor(v[i])))
            return hm_input_fail(&r->in, HM_EFORMAT, d, "node numbers and region must be whole");
        numbers[i] = (int64_t)v[i];
    }
    const char *why = hm_reader_make_elem(&elem, numbers, corners, m->nnodes);
    return why ? hm_input_fail(&r->in, HM_EFORMAT, d, "%s", why) : hm_mesh_add_elem(m, elem, d);
}

static enum hm_err read_mesh(struct hm_reader *r, struct hm_mesh *m, struct hm_diag *d)
{
    for (;;) {
        const char *s, *end;
        double v[5];
        enum hm_err err = next_line(r, &s, &end, d);
        if (err)
            return err == HM_END ? HM_OK : err;
        s = hm_row_skip(s, end);
        char tag = end - s > 1 && hm_row_is_blank(s[1]) ? *s : '\0';
        size_t n = tag == 'v' || tag == 'q' ? 5 : tag == 't' ? 4 : 0;
        if (n == 0)
            return hm_input_fail(&r->in, HM_EFORMAT, d, "expected a line v, t or q of a mesh");
        if (!hm_row_parse(s + 1, end, v, n))
            return hm_row_fail(&r->in, s + 1, end, n, false, d);
        err = tag == 'v' ? add_node(r, v, m, d) : add_elem(r, v, (int)n - 1, m, d);
        if (err)
            return err;
    }
}

static enum hm_err begin_object(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    enum hm_encoding encoding;
    enum hm_err err = hm_headio_read(&r->in, h, &encoding, d);
    if (err)
        return err;
    if (encoding != HM_TEXT)
        return hm_reader_begin_blocks(r, encoding, d);
    if (h->kind == HM_GRID) {
        r->state = hm_alloc0(1, sizeof(struct text_grid));
        if (!r->state || !hm_grow(&r->row, &r->row_cap, h->nfields, sizeof *r->row))
            return hm_fail_memory(d);
    }
    return HM_OK;
}

const struct hm_reader_form hm_reader_text = {.begin = begin_object,
                                              .points = read_points,
                                              .row = read_row,
                                              .line = read_line,
                                              .mesh = read_mesh};
