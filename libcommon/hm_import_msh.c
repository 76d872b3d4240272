/* Gmsh .msh 2.2, text: lines with a physical group become node strings, points are passed over. */
#include "hm_import_private.h"
#include "hm_row.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 1, TRIANGLE = 2, QUAD = 3, POINT = 15 };

bool hm_import_is_msh(const char *s, const char *end)
{
    return hm_import_begins(s, end, "$MeshFormat");
}

struct group { /* a physical group of lines */
    int32_t id;
    char *name;
    int64_t *node; /* of its lines, two each */
    size_t n, cap;
};

struct reading {
    struct hm_words w;
    struct hm_mesh *m;
    struct hm_ids ids;
    struct group *group;
    size_t groups, group_cap;
    int32_t none; /* the physical group that stands for region 0, as hm_export_msh names it */
};

static struct group *find_group(struct reading *r, int32_t id)
{
    for (size_t k = 0; k < r->groups; k++)
        if (r->group[k].id == id)
            return &r->group[k];
    if (!hm_grow(&r->group, &r->group_cap, r->groups + 1, sizeof *r->group)) {
        r->w.err = hm_fail_memory(r->w.d);
        return NULL;
    }
    r->group[r->groups] = (struct group){.id = id};
    return &r->group[r->groups++];
}

static void name_group(struct reading *r, int32_t id, const char *s, const char *stop)
{
    struct group *g = find_group(r, id);
    if (!g || g->name || stop == s)
        return;
    g->name = strndup(s, (size_t)(stop - s));
    if (!g->name)
        r->w.err = hm_fail_memory(r->w.d);
    for (char *c = g->name; c && *c; c++)
        if (hm_row_is_blank(*c))
            *c = '_';
}

/* `1 3 "inflow"`; of groups that are not lines only the name of region 0 is of interest. */
static void read_names(struct reading *r)
{
    static const char zero[] = "region 0";
    const char *s, *end;
    int32_t count = hm_words_count(&r->w);
    for (int32_t k = 0; k < count && !r->w.err; k++) {
        int32_t dimension = hm_words_integer(&r->w), id = hm_words_integer(&r->w);
        if (!hm_words_line(&r->w, &s, &end))
            return;
        s = hm_row_skip(s, end);
        bool quoted = s < end && *s == '"';
        s += quoted;
        const char *stop = quoted ? memchr(s, '"', (size_t)(end - s)) : end;
        if (!stop)
            stop = end;
        if (dimension == 1)
            name_group(r, id, s, stop);
        else if ((size_t)(stop - s) == sizeof zero - 1 && !memcmp(s, zero, sizeof zero - 1))
            r->none = id;
    }
}

static void read_nodes(struct reading *r)
{
    int32_t count = hm_words_count(&r->w);
    if (r->ids.n > 0)
        hm_words_fail(&r->w, "nodes a second time");
    for (int32_t k = 0; k < count && !r->w.err; k++) {
        int32_t id = hm_words_integer(&r->w);
        double xyz[3];
        for (int i = 0; i < 3; i++)
            xyz[i] = hm_words_number(&r->w);
        if (!r->w.err)
            r->w.err = hm_ids_add(&r->ids, id, r->w.d);
        if (!r->w.err)
            r->w.err = hm_import_node(r->w.in, r->m, xyz, r->w.d);
    }
    if (!r->w.err)
        r->w.err = hm_ids_sort(&r->ids, r->w.in->name, r->w.d);
}

static void add_line(struct reading *r, int32_t id, const int64_t node[2])
{
    struct group *g = id > 0 ? find_group(r, id) : NULL;
    if (!g)
        return;
    if (node[0] < 0 || node[1] < 0)
        hm_words_fail(&r->w, "a line has a node that is not there");
    else if (!hm_grow(&g->node, &g->cap, g->n + 2, sizeof *g->node))
        r->w.err = hm_fail_memory(r->w.d);
    if (r->w.err)
        return;
    g->node[g->n++] = node[0];
    g->node[g->n++] = node[1];
}

static void read_element(struct reading *r)
{
    static const int corners_of[] = {[LINE] = 2, [TRIANGLE] = 3, [QUAD] = 4, [POINT] = 1};
    hm_words_integer(&r->w);
    int32_t type = hm_words_integer(&r->w), tags = hm_words_count(&r->w), physical = 0;
    for (int32_t i = 0; i < tags && !r->w.err; i++) {
        int32_t tag = hm_words_integer(&r->w);
        if (i == 0)
            physical = tag;
    }
    if (r->w.err)
        return;
    if (type < 0 || type > POINT || !corners_of[type]) {
        hm_words_fail(&r->w, "an element that is neither point, line, triangle nor quadrilateral");
        return;
    }
    int64_t node[4] = {0};
    for (int i = 0; i < corners_of[type]; i++)
        node[i] = hm_ids_find(&r->ids, hm_words_integer(&r->w));
    if (r->w.err || type == POINT)
        return;
    if (type == LINE)
        add_line(r, physical, node);
    else
        r->w.err = hm_import_elem(r->w.in, r->m, node, corners_of[type],
                                  physical == r->none ? 0 : physical, r->w.d);
}

static void read_format(struct reading *r)
{
    double version = hm_words_number(&r->w);
    int32_t type = hm_words_integer(&r->w);
    hm_words_integer(&r->w);
    if (!r->w.err && !(version >= 2 && version < 3))
        hm_words_fail(&r->w, "only version 2 of .msh is read (gmsh -format msh22 writes it)");
    if (!r->w.err && type != 0)
        hm_words_fail(&r->w, "only .msh as text is read (gmsh -format msh22 writes it)");
}

static bool is(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && !memcmp(word, wanted, n);
}

/* Sections in any order but for the nodes, which come before the elements; unknown ones are passed
 * over. */
static void read_sections(struct reading *r)
{
    const char *word;
    size_t n;
    bool elements = false;
    while ((n = hm_words_next(&r->w, &word)) > 0) {
        if (is(word, n, "$MeshFormat"))
            read_format(r);
        else if (is(word, n, "$PhysicalNames"))
            read_names(r);
        else if (is(word, n, "$Nodes"))
            read_nodes(r);
        else if (is(word, n, "$Elements")) {
            elements = true;
            int32_t count = hm_words_count(&r->w);
            for (int32_t k = 0; k < count && !r->w.err; k++)
                read_element(r);
            hm_words_expect(&r->w, "$EndElements");
        }
    }
    if (!elements && !r->w.err)
        r->w.err = hm_input_fail(r->w.in, HM_ETRUNC, r->w.d, "no $Elements: the file is cut off");
}

/* The lines of a group follow one another, each from where the last one ended: one string; where
 * they do not, another of the same name begins. */
static enum hm_err add_strings(struct reading *r, const struct group *g)
{
    char number[24];
    snprintf(number, sizeof number, "%d", g->id);
    enum hm_err err = HM_OK;
    int64_t *node = hm_alloc(g->n, sizeof *node);
    size_t n = 0;
    if (!node)
        return hm_fail_memory(r->w.d);
    for (size_t i = 0; i < g->n && !err; i += 2) {
        if (n == 0 || node[n - 1] != g->node[i]) {
            if (n > 0)
                err = hm_import_string(r->m, g->name ? g->name : number, node, n, r->w.d);
            n = 0;
            node[n++] = g->node[i];
        }
        node[n++] = g->node[i + 1];
    }
    if (n > 0 && !err)
        err = hm_import_string(r->m, g->name ? g->name : number, node, n, r->w.d);
    free(node);
    return err;
}

enum hm_err hm_import_msh(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct reading r = {.w = {.in = in, .d = d}, .m = m};
    read_sections(&r);
    enum hm_err err = r.w.err;
    for (size_t k = 0; k < r.groups; k++) {
        if (!err && r.group[k].n > 0)
            err = add_strings(&r, &r.group[k]);
        free(r.group[k].name);
        free(r.group[k].node);
    }
    free(r.group);
    hm_ids_free(&r.ids);
    return err;
}
