/* PLY, text: elements vertex and face with any properties; of the faces the list of vertices and,
 * if there is one, `region`. */
#include "hm_import_private.h"
#include "hm_row.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_PROPERTIES = 64 };

bool hm_import_is_ply(const char *s, const char *end)
{
    return hm_import_begins(s, end, "ply\n") || hm_import_begins(s, end, "ply\r\n");
}

enum role { OTHER, X, Y, Z, CORNERS, REGION };

struct property {
    enum role role;
    bool list;
};

struct element {
    enum { VERTEX, FACE, UNKNOWN } kind;
    int32_t count;
    struct property property[MOST_PROPERTIES];
    int properties;
};

struct reading {
    struct hm_words w;
    struct hm_mesh *m;
    struct element element[8];
    int elements;
};

static bool is(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && !memcmp(word, wanted, n);
}

static enum role role_of(const char *s, size_t n)
{
    static const struct {
        const char *name;
        enum role role;
    } roles[] = {{"x", X},
                 {"y", Y},
                 {"z", Z},
                 {"vertex_indices", CORNERS},
                 {"vertex_index", CORNERS},
                 {"region", REGION}};
    for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
        if (is(s, n, roles[i].name))
            return roles[i].role;
    return OTHER;
}

static void read_property(struct reading *r)
{
    const char *word = "";
    size_t n = hm_words_next(&r->w, &word);
    bool list = is(word, n, "list");
    for (int i = 0; i < (list ? 3 : 1); i++)
        n = hm_words_next(&r->w, &word);
    if (r->elements == 0 || r->element[r->elements - 1].properties == MOST_PROPERTIES) {
        hm_words_fail(&r->w, "a property of no element, or too many");
        return;
    }
    struct element *e = &r->element[r->elements - 1];
    e->property[e->properties++] = (struct property){role_of(word, n), list};
}

static void read_element(struct reading *r)
{
    const char *word = "";
    size_t n = hm_words_next(&r->w, &word);
    struct element e = {.kind = is(word, n, "vertex") ? VERTEX
                                : is(word, n, "face") ? FACE
                                                      : UNKNOWN};
    e.count = hm_words_count(&r->w);
    if (r->elements == sizeof r->element / sizeof *r->element)
        hm_words_fail(&r->w, "too many elements in the header");
    else
        r->element[r->elements++] = e;
}

static void read_header(struct reading *r)
{
    const char *word, *s, *end;
    size_t n;
    hm_words_expect(&r->w, "ply");
    hm_words_expect(&r->w, "format");
    n = hm_words_next(&r->w, &word);
    if (n > 0 && !is(word, n, "ascii"))
        hm_words_fail(&r->w, "only PLY as text is read");
    hm_words_line(&r->w, &s, &end);
    while ((n = hm_words_next(&r->w, &word)) > 0 && !is(word, n, "end_header"))
        if (is(word, n, "element"))
            read_element(r);
        else if (is(word, n, "property"))
            read_property(r);
        else
            hm_words_line(&r->w, &s, &end); /* comment, obj_info */
    if (n == 0 && !r->w.err)
        r->w.err = hm_input_fail(r->w.in, HM_ETRUNC, r->w.d, "the file ends in its header");
}

/* One record: what it holds of interest. */
struct record {
    double xyz[3];
    int64_t node[4];
    int32_t corners, region;
};

static void read_record(struct reading *r, const struct element *e, struct record *rec)
{
    *rec = (struct record){0};
    for (int k = 0; k < e->properties && !r->w.err; k++) {
        enum role role = e->property[k].role;
        if (e->property[k].list) {
            int32_t n = hm_words_count(&r->w);
            if (role == CORNERS)
                rec->corners = n;
            for (int32_t i = 0; i < n && !r->w.err; i++) {
                double v = hm_words_number(&r->w);
                if (role == CORNERS && i < 4)
                    rec->node[i] = v >= 0 && v <= INT32_MAX ? (int64_t)v : -1;
            }
        } else if (role == REGION) {
            rec->region = hm_words_integer(&r->w);
        } else {
            double v = hm_words_number(&r->w);
            if (role >= X && role <= Z)
                rec->xyz[role - X] = v;
        }
    }
}

static void read_records(struct reading *r, const struct element *e)
{
    struct record rec;
    if (e->properties == 0)
        return;
    for (int32_t k = 0; k < e->count && !r->w.err; k++) {
        read_record(r, e, &rec);
        if (r->w.err || e->kind == UNKNOWN)
            continue;
        if (e->kind == VERTEX)
            r->w.err = hm_import_node(r->w.in, r->m, rec.xyz, r->w.d);
        else if (rec.corners != 3 && rec.corners != 4)
            hm_words_fail(&r->w, "a face has neither three nor four corners");
        else
            r->w.err = hm_import_elem(r->w.in, r->m, rec.node, rec.corners, rec.region, r->w.d);
    }
}

enum hm_err hm_import_ply(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct reading *r = hm_alloc0(1, sizeof *r);
    if (!r)
        return hm_fail_memory(d);
    r->w = (struct hm_words){.in = in, .d = d};
    r->m = m;
    read_header(r);
    for (int k = 0; k < r->elements && !r->w.err; k++)
        read_records(r, &r->element[k]);
    enum hm_err err = r->w.err;
    free(r);
    const char *s, *end;
    while (!err && !(err = hm_input_line(in, &s, &end, d)))
        if (hm_row_skip(s, end) < end)
            return hm_input_fail(in, HM_EFORMAT, d, "more than the header announced");
    return err == HM_END ? HM_OK : err;
}
