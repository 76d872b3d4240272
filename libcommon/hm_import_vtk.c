/* VTK legacy, text: an unstructured grid of triangles and quadrilaterals, or polygons; cell data
 * `region` (or `material`) become regions. */
#include "hm_import_private.h"
#include "hm_row.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { VERTEX = 1, LINE = 3, TRIANGLE = 5, QUAD = 9 };

bool hm_import_is_vtk(const char *s, const char *end)
{
    return hm_import_begins(s, end, "# vtk DataFile");
}

struct reading {
    struct hm_words w;
    struct hm_mesh *m;
    int32_t *elem; /* of each cell: the element, or -1 */
    size_t cells, cell_cap;
    bool in_cells; /* behind CELL_DATA */
};

static bool is(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && !strncasecmp(word, wanted, n);
}

static void read_points(struct reading *r)
{
    const char *type;
    int32_t count = hm_words_count(&r->w);
    hm_words_next(&r->w, &type);
    for (int32_t k = 0; k < count && !r->w.err; k++) {
        double xyz[3];
        for (int i = 0; i < 3; i++)
            xyz[i] = hm_words_number(&r->w);
        if (!r->w.err)
            r->w.err = hm_import_node(r->w.in, r->m, xyz, r->w.d);
    }
}

/* Points and lines among the cells are passed over. */
static void read_cells(struct reading *r)
{
    int32_t count = hm_words_count(&r->w);
    hm_words_count(&r->w);
    for (int32_t k = 0; k < count && !r->w.err; k++) {
        int64_t node[4];
        int32_t corners = hm_words_count(&r->w);
        if (corners > 4 || corners < 1)
            hm_words_fail(&r->w, "a cell has more than four corners, or none");
        for (int32_t i = 0; i < corners && !r->w.err; i++)
            node[i] = hm_words_integer(&r->w);
        if (!r->w.err && !hm_grow(&r->elem, &r->cell_cap, r->cells + 1, sizeof *r->elem))
            r->w.err = hm_fail_memory(r->w.d);
        if (r->w.err)
            return;
        r->elem[r->cells++] = corners > 2 ? (int32_t)r->m->nelems : -1;
        if (corners > 2)
            r->w.err = hm_import_elem(r->w.in, r->m, node, corners, 0, r->w.d);
    }
}

static void read_types(struct reading *r)
{
    int32_t count = hm_words_count(&r->w);
    for (int32_t k = 0; k < count && !r->w.err; k++) {
        int32_t type = hm_words_integer(&r->w);
        if (!r->w.err && type != VERTEX && type != LINE && type != TRIANGLE && type != QUAD)
            hm_words_fail(&r->w, "a cell that is neither triangle nor quadrilateral");
    }
}

static bool is_region(const struct reading *r, const char *name, size_t n)
{
    return r->in_cells && (is(name, n, "region") || is(name, n, "material"));
}

static void read_regions(struct reading *r)
{
    for (size_t k = 0; k < r->cells && !r->w.err; k++) {
        int32_t v = hm_words_count(&r->w);
        if (!r->w.err && r->elem[k] >= 0)
            r->m->elem[r->elem[k]].region = v;
    }
}

/* `SCALARS name type [components]`, `LOOKUP_TABLE name`, a number a cell. */
static void read_scalars(struct reading *r)
{
    const char *s, *end, *name;
    size_t n = hm_words_next(&r->w, &name);
    bool region = is_region(r, name, n);
    hm_words_line(&r->w, &s, &end);
    if (!region)
        return;
    hm_words_expect(&r->w, "LOOKUP_TABLE");
    hm_words_line(&r->w, &s, &end);
    read_regions(r);
}

/* `FIELD name arrays`, then of each `name components tuples type` and its values. */
static void read_field(struct reading *r)
{
    const char *word;
    hm_words_next(&r->w, &word);
    int32_t arrays = hm_words_count(&r->w);
    for (int32_t k = 0; k < arrays && !r->w.err; k++) {
        size_t n = hm_words_next(&r->w, &word);
        bool region = is_region(r, word, n);
        int64_t components = hm_words_count(&r->w), values = components * hm_words_count(&r->w);
        hm_words_next(&r->w, &word);
        if (region && components == 1 && values == (int64_t)r->cells)
            read_regions(r);
        else
            while (values-- > 0 && hm_words_next(&r->w, &word) > 0)
                ;
    }
}

static void read_sections(struct reading *r)
{
    const char *word;
    size_t n;
    while ((n = hm_words_next(&r->w, &word)) > 0) {
        if (is(word, n, "POINTS"))
            read_points(r);
        else if (is(word, n, "CELLS") || is(word, n, "POLYGONS"))
            read_cells(r);
        else if (is(word, n, "CELL_TYPES"))
            read_types(r);
        else if (is(word, n, "CELL_DATA") || is(word, n, "POINT_DATA"))
            r->in_cells = is(word, n, "CELL_DATA");
        else if (is(word, n, "SCALARS"))
            read_scalars(r);
        else if (is(word, n, "FIELD"))
            read_field(r);
    }
    if (!r->w.err && r->m->nelems == 0)
        r->w.err = hm_input_fail(r->w.in, HM_EFORMAT, r->w.d, "no cells");
}

enum hm_err hm_import_vtk(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct reading r = {.w = {.in = in, .d = d}, .m = m};
    const char *s, *end;
    hm_words_line(&r.w, &s, &end);
    if (hm_words_line(&r.w, &s, &end))
        r.w.err = hm_import_name(m, s, end, d);
    if (hm_words_line(&r.w, &s, &end) && !hm_row_begins(s, end, "ASCII"))
        hm_words_fail(&r.w, "only VTK as text (ASCII) is read");
    hm_words_expect(&r.w, "DATASET");
    if (!r.w.err && hm_words_line(&r.w, &s, &end)) {
        s = hm_row_skip(s, end);
        if (!hm_row_begins(s, end, "UNSTRUCTURED_GRID") && !hm_row_begins(s, end, "POLYDATA"))
            hm_words_fail(&r.w, "neither an unstructured grid nor polygons");
    }
    read_sections(&r);
    free(r.elem);
    return r.w.err;
}
