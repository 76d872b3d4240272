#include "hm_reader.h"

#include "hm_attr.h"
#include "hm_reader_private.h"
#include "hm_row.h"

#include <stdlib.h>
#include <string.h>

/* A reader whose input was just opened, or could not be. */
static enum hm_err make(struct hm_reader **r, struct hm_input *in, enum hm_err err,
                        struct hm_diag *d)
{
    *r = err ? NULL : hm_alloc0(1, sizeof **r);
    if (err)
        return err;
    if (!*r) {
        hm_input_close(in);
        return hm_fail_memory(d);
    }
    (*r)->in = *in;
    return HM_OK;
}

enum hm_err hm_reader_open(struct hm_reader **r, const char *path, struct hm_diag *d)
{
    struct hm_input in = {.fd = -1};
    return make(r, &in, hm_input_open(&in, path, d), d);
}

enum hm_err hm_reader_open_fd(struct hm_reader **r, int fd, const char *name, struct hm_diag *d)
{
    struct hm_input in = {.fd = -1};
    return make(r, &in, hm_input_open_fd(&in, fd, name, d), d);
}

static void forget_object(struct hm_reader *r)
{
    if (r->form && r->form->free && r->state)
        r->form->free(r->state);
    else
        free(r->state);
    r->state = NULL;
    r->form = NULL;
}

void hm_reader_close(struct hm_reader *r)
{
    if (!r)
        return;
    forget_object(r);
    hm_inputs_free(&r->whole);
    hm_input_close(&r->in);
    free(r->attrs);
    free(r->xyz);
    free(r->row);
    hm_reader_free_plain(r);
    free(r);
}

void hm_reader_strict(struct hm_reader *r, bool strict)
{
    r->strict = strict;
}

void hm_reader_threads(struct hm_reader *r, int threads)
{
    r->threads = threads;
}

void hm_reader_foreign(struct hm_reader *r, const struct hm_foreign *list)
{
    r->foreign = list;
}

const struct hm_foreign *hm_reader_found(const struct hm_reader *r)
{
    return r->form == &hm_reader_whole ? r->found : NULL;
}

const char *hm_reader_name(const struct hm_reader *r)
{
    return r->in.name;
}

/* --- between objects --- */

/* Read the rest of the object; its data are checked and dropped. */
static enum hm_err drain(struct hm_reader *r, struct hm_diag *d)
{
    enum { SOME = 1024 };
    enum hm_err err = HM_OK;
    double *room = NULL;
    size_t n = r->kind == HM_POINTS ? SOME * r->nfields
               : r->kind == HM_GRID ? (size_t)r->lattice.nx * (r->nfields - 2)
                                    : 0;
    if (r->ended)
        return HM_OK;
    if (n > 0 && !(room = hm_alloc(n, sizeof *room)))
        return hm_fail_memory(d);
    while (!err) {
        struct hm_line line;
        struct hm_mesh mesh = {0};
        if (r->kind == HM_POINTS)
            err = hm_reader_points(r, room, SOME, &n, d);
        else if (r->kind == HM_GRID)
            err = hm_reader_row(r, room, d);
        else if (r->kind == HM_LINES)
            err = hm_reader_line(r, &line, d);
        else {
            err = hm_reader_mesh(r, &mesh, d);
            hm_mesh_free(&mesh);
            if (!err)
                break;
        }
    }
    free(room);
    return err == HM_END ? HM_OK : err;
}

static bool begins(const char *s, const char *end, const char *mark)
{
    size_t n = strlen(mark);
    return (size_t)(end - s) >= n && !memcmp(s, mark, n);
}

/* Does an object of the project begin here? */
static bool is_own(const char *s, const char *end)
{
    return begins(s, end, "#hm") && (end - s == 3 || memchr(" \t\r\n", s[3], 4));
}

static const char *next_line(const char *s, const char *end)
{
    const char *lf = memchr(s, '\n', (size_t)(end - s));
    return lf ? lf + 1 : end;
}

/* Where the first line begins that is of the project's own, or a line mark when that is wanted. */
static const char *find_line(const char *s, const char *end, bool mark)
{
    while (s < end && !is_own(s, end) && !(mark && *s == '>'))
        s = next_line(s, end);
    return s;
}

/* Files that are neither text nor read here; the first bytes say what they are. */
static enum hm_err refuse_binary(struct hm_reader *r, const char *s, const char *end,
                                 struct hm_diag *d)
{
    int64_t at = hm_input_tell(&r->in);
    if (begins(s, end, "\x1f\x8b"))
        return hm_input_fail_byte(&r->in, HM_EFORMAT, at, d,
                                  "compressed: use \"gunzip -c\" into a pipe");
    if (begins(s, end, "LASF"))
        return hm_input_fail_byte(&r->in, HM_EFORMAT, at, d,
                                  "LAS behind something else; it must be a file of its own");
    if (memchr(s, '\0', (size_t)(end - s)))
        return hm_input_fail_byte(&r->in, HM_EFORMAT, at, d,
                                  "binary data of no form that is known");
    return HM_OK;
}

/* The first of the formats known besides that this looks like; NULL when there is none. */
static const struct hm_foreign *find_foreign(const struct hm_reader *r, const char *s,
                                             const char *end)
{
    const struct hm_foreign *f = r->foreign;
    while (f && f->name && !f->is(s, end))
        f++;
    return f && f->name ? f : NULL;
}

/* Choose the form by what stands here, looking 64 KB ahead. */
static enum hm_err recognise(struct hm_reader *r, struct hm_diag *d)
{
    enum { AHEAD = 1 << 16 };
    if (hm_reader_has_whole(r)) {
        r->form = &hm_reader_whole;
        return HM_OK;
    }
    enum hm_err err = hm_input_fill(&r->in, AHEAD, d);
    if (err)
        return err;
    if (!r->any && begins(hm_input_at(&r->in), r->in.buf + r->in.fill, "\xef\xbb\xbf"))
        r->in.pos += 3; /* the byte order mark that some editors put first */
    size_t n = hm_input_has(&r->in);
    const char *s = hm_input_at(&r->in), *end = s + (n < AHEAD ? n : AHEAD), *first = s;
    if (is_own(s, end)) {
        r->form = &hm_reader_text;
        return HM_OK;
    }
    r->found = find_foreign(r, s, end);
    if (r->found) {
        r->form = &hm_reader_whole;
        return HM_OK;
    }
    if (begins(s, end, "LASF") && hm_input_tell(&r->in) == 0) {
        r->form = &hm_reader_las;
        return HM_OK;
    }
    end = find_line(s, end, false);
    while (first < end && strchr("# \t\r\n", *first) && *first)
        first = *first == '#' ? next_line(first, end) : first + 1;
    if (hm_reader_is_ascii_grid(first, end))
        r->form = &hm_reader_ascii_grid;
    else if (begins(first, end, "MESH2D") || begins(first, end, "MESHNAME"))
        r->form = &hm_reader_2dm;
    else if (begins(s, end, "# @V") || find_line(s, end, true) < end)
        r->form = &hm_reader_gmt;
    else
        r->form = &hm_reader_table;
    return refuse_binary(r, s, end, d);
}

/* Nothing but blank lines to the end of the input? They are passed over. */
static enum hm_err skip_blank_lines(struct hm_reader *r, struct hm_diag *d)
{
    const char *s, *end;
    enum hm_err err;
    if ((err = hm_input_fill(&r->in, 1, d)))
        return err;
    while (hm_input_has(&r->in) && strchr(" \t\r\n", *hm_input_at(&r->in)) &&
           *hm_input_at(&r->in)) {
        if ((err = hm_input_line(&r->in, &s, &end, d)))
            return err;
        if (hm_row_skip(s, end) < end) {
            hm_input_unread(&r->in);
            break;
        }
        if ((err = hm_input_fill(&r->in, 1, d)))
            return err;
    }
    return hm_input_has(&r->in) ? HM_OK : HM_END;
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    r->ended = false;
    r->records = r->rows = 0;
    r->counted = -1;
    enum hm_err err = recognise(r, d);
    if (!err)
        err = r->form->begin(r, h, d);
    if (err) {
        hm_header_free(h);
        forget_object(r);
        return err;
    }
    r->kind = h->kind;
    r->nfields = h->nfields;
    r->lattice = h->lattice;
    r->announced = h->count;
    r->any = true;
    return HM_OK;
}

enum hm_err hm_reader_next(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    memset(h, 0, sizeof *h);
    if (r->form) {
        enum hm_err err = drain(r, d);
        if (err)
            return err;
        forget_object(r);
    }
    enum hm_err err = hm_reader_has_whole(r) ? HM_OK : skip_blank_lines(r, d);
    if (err == HM_END && !r->any)
        return hm_fail_line(d, HM_EFORMAT, r->in.name, 0, "empty: nothing to read");
    return err ? err : begin(r, h, d);
}

/* --- inside an object --- */

/* HM_END once the object has ended, and then its counts are checked when that is wanted. */
static enum hm_err ready(struct hm_reader *r, enum hm_kind kind, struct hm_diag *d)
{
    if (!r->form || r->kind != kind)
        return hm_fail(d, HM_EARG, "no %s to be read here", hm_kind_name(kind));
    return r->ended ? HM_END : HM_OK;
}

static enum hm_err check_end(struct hm_reader *r, enum hm_err err, struct hm_diag *d)
{
    if (!r->ended || (err && err != HM_END) || !r->strict)
        return err;
    int64_t said = r->counted >= 0 ? r->counted : r->announced;
    if (r->counted >= 0 && r->announced >= 0 && r->announced != r->records)
        said = r->announced;
    if (said >= 0 && said != r->records)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "%lld records were announced, %lld came",
                             (long long)said, (long long)r->records);
    return err;
}

enum hm_err hm_reader_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                             struct hm_diag *d)
{
    *n = 0;
    enum hm_err err = ready(r, HM_POINTS, d);
    if (err)
        return err;
    err = r->form->points(r, rows, max, n, d);
    r->records += (int64_t)*n;
    return check_end(r, err, d);
}

enum hm_err hm_reader_row(struct hm_reader *r, double *row, struct hm_diag *d)
{
    enum hm_err err = ready(r, HM_GRID, d);
    if (err)
        return err;
    err = r->form->row(r, row, d);
    if (!err)
        r->rows++;
    return check_end(r, err, d);
}

static bool meets_first(const struct hm_line *line)
{
    const double *last = line->xyz + 3 * (line->n - 1);
    return line->n > 1 && last[0] == line->xyz[0] && last[1] == line->xyz[1];
}

/* A line closes by its attribute, or when it ends where it began; vertices at its end that repeat
 * the first are dropped then. */
static void close_line(struct hm_line *line)
{
    line->closed = hm_attr_flag(line->attrs, "closed") || (line->n > 3 && meets_first(line));
    while (line->closed && meets_first(line))
        line->n--;
}

enum hm_err hm_reader_line(struct hm_reader *r, struct hm_line *line, struct hm_diag *d)
{
    *line = (struct hm_line){0};
    enum hm_err err = ready(r, HM_LINES, d);
    if (err)
        return err;
    do { /* a mark without vertices is no line */
        r->xyz_n = 0;
        err = hm_reader_set_attrs(r, "", 0, d);
        if (!err)
            err = r->form->line(r, d);
    } while (!err && r->xyz_n == 0);
    if (err)
        return check_end(r, err, d);
    r->records++;
    line->attrs = r->attrs;
    line->xyz = r->xyz;
    line->n = r->xyz_n / 3;
    close_line(line);
    return check_end(r, HM_OK, d);
}

enum hm_err hm_reader_mesh(struct hm_reader *r, struct hm_mesh *mesh, struct hm_diag *d)
{
    enum hm_err err = ready(r, HM_MESH, d);
    if (!err)
        err = r->form->mesh(r, mesh, d);
    if (!err)
        r->records = (int64_t)(mesh->nnodes + mesh->nelems);
    return check_end(r, err, d);
}

/* --- what the forms share --- */

enum hm_err hm_reader_add_vertex(struct hm_reader *r, const double xyz[3], struct hm_diag *d)
{
    if (!hm_grow(&r->xyz, &r->xyz_cap, r->xyz_n + 3, sizeof *r->xyz))
        return hm_fail_memory(d);
    memcpy(r->xyz + r->xyz_n, xyz, 3 * sizeof *xyz);
    r->xyz_n += 3;
    return HM_OK;
}

enum hm_err hm_reader_set_attrs(struct hm_reader *r, const char *s, size_t n, struct hm_diag *d)
{
    if (!hm_grow(&r->attrs, &r->attrs_cap, n + 1, 1))
        return hm_fail_memory(d);
    memcpy(r->attrs, s, n);
    r->attrs[n] = '\0';
    return HM_OK;
}

const char *hm_reader_bad_place(const double *xyz)
{
    if (isnan(xyz[0]) || isnan(xyz[1]))
        return "x or y is not a number";
    return isinf(xyz[0]) || isinf(xyz[1]) ? "x or y is infinite" : "z is infinite";
}

const char *hm_reader_make_node(struct hm_node *node, const double xyz[3], int64_t flags,
                                int64_t owner)
{
    if (!hm_reader_good_place(xyz))
        return hm_reader_bad_place(xyz);
    if (flags < 0 || flags > INT32_MAX || owner < 0 || owner > INT32_MAX)
        return "the flags or the owner of a node are out of range";
    *node = (struct hm_node){xyz[0], xyz[1], xyz[2], (int32_t)flags, (int32_t)owner};
    return NULL;
}

const char *hm_reader_make_elem(struct hm_elem *elem, const int64_t *numbers, int corners,
                                size_t nnodes)
{
    int64_t region = numbers[corners];
    *elem = (struct hm_elem){.node = {-1, -1, -1, -1}};
    for (int i = 0; i < corners; i++) {
        if (numbers[i] < 0 || numbers[i] >= (int64_t)nnodes)
            return "an element has a node that is not there";
        for (int k = 0; k < i; k++)
            if (numbers[i] == numbers[k])
                return "an element has a node twice";
        elem->node[i] = (int32_t)numbers[i];
    }
    if (region < 0 || region > INT32_MAX)
        return "the region of an element is out of range";
    elem->region = (int32_t)region;
    return NULL;
}
