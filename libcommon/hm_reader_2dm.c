/* SMS .2dm meshes: ND nodes, E3T triangles, E4Q quadrilaterals, NS node strings, in any order. Read
 * whole at once: numbers of nodes may have gaps, and the strings, which come last, go to the
 * header. */
#include "hm_reader_private.h"

#include "hm_ids.h"
#include "hm_row.h"

#include <stdio.h>
#include <stdlib.h>

struct string { /* a node string: where it ends in the list of all */
    char *name;
    size_t end;
};

struct mesh2dm {
    struct hm_mesh mesh; /* elements hold ids until the end */
    struct hm_ids ids;
    int32_t *string_id; /* the nodes of all strings */
    size_t string_ids, string_id_cap;
    int64_t string_line; /* where a node of a string was last read */
    struct string *string;
    size_t strings, string_cap;
    int32_t none; /* the material that stands for region 0; 0: none does */
};

static void free_2dm(void *state)
{
    struct mesh2dm *m = state;
    for (size_t i = 0; i < m->strings; i++)
        free(m->string[i].name);
    free(m->string);
    free(m->string_id);
    hm_ids_free(&m->ids);
    hm_mesh_free(&m->mesh);
    free(m);
}

static enum hm_err bad_line(struct hm_reader *r, const char *s, const char *end, struct hm_diag *d)
{
    char word[HM_ROW_WORD];
    return hm_input_fail(&r->in, HM_EFORMAT, d, "not what a .2dm has here: \"%s\"",
                         hm_row_word(word, s, end));
}

/* The next word as a number; false when there is none. */
static bool cut_number(const char **s, const char *end, double *v)
{
    const char *stop = hm_row_field(s, end, false);
    if (*s == stop || hm_num_parse(*s, stop, v) != stop)
        return false;
    *s = stop;
    return true;
}

static bool cut_id(const char **s, const char *end, int32_t *id)
{
    double v;
    if (!cut_number(s, end, &v) || !(fabs(v) <= INT32_MAX) || v != floor(v))
        return false;
    *id = (int32_t)v;
    return true;
}

/* --- cards --- */

static enum hm_err read_node(struct hm_reader *r, const char *s, const char *end, struct hm_diag *d)
{
    struct mesh2dm *m = r->state;
    double xyz[3];
    int32_t id;
    struct hm_node node;
    if (!cut_id(&s, end, &id) || id < 0 || !cut_number(&s, end, &xyz[0]) ||
        !cut_number(&s, end, &xyz[1]) || !cut_number(&s, end, &xyz[2]))
        return bad_line(r, s, end, d);
    const char *why = hm_reader_make_node(&node, xyz, 0, 0);
    if (why)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "%s", why);
    enum hm_err err = hm_ids_add(&m->ids, id, d);
    return err ? err : hm_mesh_add_node(&m->mesh, node, d);
}

/* `E3T id a b c material`; the material may be missing, and more may follow it. */
static enum hm_err read_elem(struct hm_reader *r, const char *s, const char *end, int corners,
                             struct hm_diag *d)
{
    struct mesh2dm *m = r->state;
    struct hm_elem elem = {.node = {-1, -1, -1, -1}};
    int32_t id;
    if (!cut_id(&s, end, &id))
        return bad_line(r, s, end, d);
    for (int i = 0; i < corners; i++)
        if (!cut_id(&s, end, &elem.node[i]) || elem.node[i] < 0)
            return bad_line(r, s, end, d);
    if (hm_row_skip(s, end) < end && (!cut_id(&s, end, &elem.region) || elem.region < 0))
        return bad_line(r, s, end, d);
    return hm_mesh_add_elem(&m->mesh, elem, d);
}

/* A name as it can stand in a header of words. */
static char *string_name(const char *s, const char *end, size_t number)
{
    char text[32];
    const char *stop = hm_row_field(&s, end, false);
    if (s < stop && *s == '"') {
        s++;
        stop = memchr(s, '"', (size_t)(end - s));
        if (!stop)
            stop = end;
    }
    if (s == stop) {
        snprintf(text, sizeof text, "%zu", number);
        return strdup(text);
    }
    char *name = strndup(s, (size_t)(stop - s));
    for (char *c = name; c && *c; c++)
        if (hm_row_is_blank(*c))
            *c = '_';
    return name;
}

/* `NS a b -c name`: the string ends at the negative id; until then it goes on in further cards. */
static enum hm_err read_string(struct hm_reader *r, const char *s, const char *end,
                               struct hm_diag *d)
{
    struct mesh2dm *m = r->state;
    while (hm_row_skip(s, end) < end) {
        int32_t id;
        const char *word = s;
        if (!cut_id(&s, end, &id) || id == 0)
            return bad_line(r, word, end, d);
        m->string_line = r->in.line;
        if (!hm_grow(&m->string_id, &m->string_id_cap, m->string_ids + 1, sizeof *m->string_id))
            return hm_fail_memory(d);
        m->string_id[m->string_ids++] = id < 0 ? -id : id;
        if (id > 0)
            continue;
        if (!hm_grow(&m->string, &m->string_cap, m->strings + 1, sizeof *m->string))
            return hm_fail_memory(d);
        struct string string = {string_name(s, end, m->strings + 1), m->string_ids};
        if (!string.name)
            return hm_fail_memory(d);
        m->string[m->strings++] = string;
        break;
    }
    return HM_OK;
}

/* `MAT 4 "region 0"`, as hm_export_2dm writes it: material 4 is what had no region. Other materials
 * keep their numbers, whatever their names. */
static void read_material(struct mesh2dm *m, const char *s, const char *end)
{
    static const char name[] = "\"region 0\"";
    int32_t id;
    if (!cut_id(&s, end, &id))
        return;
    s = hm_row_skip(s, end);
    if ((size_t)(end - s) >= sizeof name - 1 && !memcmp(s, name, sizeof name - 1))
        m->none = id;
}

/* Cards that mean nothing here are passed over, but not elements that would be missed. */
static enum hm_err read_card(struct hm_reader *r, struct hm_header *h, const char *s,
                             const char *end, struct hm_diag *d)
{
    if (!hm_row_is_text(s, end))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "control characters");
    if (hm_row_begins(s, end, "ND"))
        return read_node(r, s + 2, end, d);
    if (hm_row_begins(s, end, "E3T"))
        return read_elem(r, s + 3, end, 3, d);
    if (hm_row_begins(s, end, "E4Q"))
        return read_elem(r, s + 3, end, 4, d);
    if (hm_row_begins(s, end, "NS"))
        return read_string(r, s + 2, end, d);
    if (hm_row_begins(s, end, "MAT"))
        read_material(r->state, s + 3, end);
    if (hm_row_begins(s, end, "E6T") || hm_row_begins(s, end, "E8Q") ||
        hm_row_begins(s, end, "E9Q"))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "elements with mid-side nodes are not read");
    if (hm_row_begins(s, end, "MESHNAME")) {
        char *name = string_name(s + 8, end, 1);
        enum hm_err err = name ? hm_header_set(h, "name", name, d) : hm_fail_memory(d);
        free(name);
        return err;
    }
    return HM_OK;
}

/* --- from ids to numbers --- */

/* The last string must have come to its end, which only a negative number is. */
static enum hm_err check_strings(struct hm_reader *r, struct hm_diag *d)
{
    const struct mesh2dm *m = r->state;
    size_t end = m->strings > 0 ? m->string[m->strings - 1].end : 0;
    return m->string_ids == end ? HM_OK
                                : hm_fail_line(d, HM_EFORMAT, r->in.name, m->string_line,
                                               "a node string without an end (a negative number)");
}

static enum hm_err number_elems(struct hm_reader *r, struct hm_diag *d)
{
    struct mesh2dm *m = r->state;
    for (size_t i = 0; i < m->mesh.nelems; i++) {
        struct hm_elem *e = &m->mesh.elem[i];
        int corners = hm_elem_corners(e);
        int64_t numbers[5];
        for (int k = 0; k < corners; k++)
            numbers[k] = hm_ids_find(&m->ids, e->node[k]);
        numbers[corners] = e->region == m->none ? 0 : e->region;
        const char *why = hm_reader_make_elem(e, numbers, corners, m->mesh.nnodes);
        if (why)
            return hm_fail_line(d, HM_EFORMAT, r->in.name, 0, "%s (element %zu of the file)", why,
                                i + 1);
    }
    return HM_OK;
}

/* Node strings as keys: `#string inflow 12 13 14`. */
static enum hm_err number_strings(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    const struct mesh2dm *m = r->state;
    enum hm_err err = HM_OK;
    for (size_t i = 0, k = 0; i < m->strings && !err; i++) {
        const struct string *string = &m->string[i];
        size_t size = strlen(string->name) + (string->end - k) * 12 + 1, n = strlen(string->name);
        char *value = hm_alloc(size, 1);
        if (!value)
            return hm_fail_memory(d);
        memcpy(value, string->name, n + 1);
        for (; k < string->end && !err; k++) {
            int64_t node = hm_ids_find(&m->ids, m->string_id[k]);
            if (node < 0)
                err = hm_fail_line(d, HM_EFORMAT, r->in.name, 0,
                                   "node string %s has the node %d, which is not there",
                                   string->name, m->string_id[k]);
            else
                n += (size_t)sprintf(value + n, " %lld", (long long)node);
        }
        if (!err)
            err = hm_header_add(h, "string", value, d);
        free(value);
    }
    return err;
}

/* --- the form --- */

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    r->state = hm_alloc0(1, sizeof(struct mesh2dm));
    if (!r->state)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_init(h, HM_MESH, d);
    while (!err) {
        const char *s, *end;
        err = hm_input_line(&r->in, &s, &end, d);
        if (!err && hm_row_begins(s, end, "#hm")) {
            hm_input_unread(&r->in);
            break;
        }
        if (!err)
            err = read_card(r, h, hm_row_skip(s, end), end, d);
    }
    if (err && err != HM_END)
        return err;
    err = check_strings(r, d);
    if (!err)
        err = hm_ids_sort(&((struct mesh2dm *)r->state)->ids, r->in.name, d);
    if (!err)
        err = number_elems(r, d);
    return err ? err : number_strings(r, h, d);
}

static enum hm_err read_mesh(struct hm_reader *r, struct hm_mesh *mesh, struct hm_diag *d)
{
    (void)d;
    struct hm_mesh *own = &((struct mesh2dm *)r->state)->mesh;
    mesh->node = own->node;
    mesh->nnodes = own->nnodes;
    mesh->node_cap = own->node_cap;
    mesh->elem = own->elem;
    mesh->nelems = own->nelems;
    mesh->elem_cap = own->elem_cap;
    *own = (struct hm_mesh){0};
    r->ended = true;
    return HM_OK;
}

const struct hm_reader_form hm_reader_2dm = {.begin = begin, .mesh = read_mesh, .free = free_2dm};
