/* UGRID in classic NetCDF (CDF-1, CDF-2): the first variable that is a mesh topology of two
 * dimensions, its nodes and faces, heights, regions, and the system of coordinates. */
#include "hm_import_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TAG_DIMENSION = 10, TAG_VARIABLE = 11, TAG_ATTRIBUTE = 12 };
enum { MOST_DIMS = 8 };

bool hm_import_is_ugrid(const char *s, const char *end)
{
    return hm_import_begins(s, end, "CDF\1") || hm_import_begins(s, end, "CDF\2") ||
           hm_import_begins(s, end, "\x89HDF\r\n\x1a\n");
}

struct text { /* in the file */
    const char *s;
    size_t n;
};

struct var {
    struct text name;
    uint32_t dim[MOST_DIMS];
    uint32_t ndims;
    size_t atts; /* where its attributes stand */
    uint32_t type;
    uint64_t begin;
};

/* The file in memory, and a place in it that is read; past the end `bad` is set, and all is 0. */
struct file {
    struct hm_input *in;
    char *bytes;
    size_t n, cap, at;
    bool bad, wide;
    uint32_t *dim;
    size_t dims, dim_cap;
    struct var *var;
    size_t vars, var_cap;
};

static enum hm_err fail(const struct file *f, struct hm_diag *d, const char *text)
{
    return hm_input_fail_byte(f->in, f->bad ? HM_ETRUNC : HM_EFORMAT, (int64_t)f->at, d, "%s",
                              f->bad ? "the file ends in the middle" : text);
}

static enum hm_err read_all(struct file *f, struct hm_diag *d)
{
    enum { STEP = 1 << 16 };
    enum hm_err err = HM_OK;
    while (!err && !(err = hm_input_fill(f->in, STEP, d))) {
        size_t n = hm_input_has(f->in);
        if (n == 0)
            return HM_OK;
        if (!hm_grow(&f->bytes, &f->cap, f->n + n, 1))
            return hm_fail_memory(d);
        err = hm_input_read(f->in, f->bytes + f->n, n, d);
        f->n += n;
    }
    return err;
}

/* --- the header --- */

static uint32_t u32_at(const struct file *f, size_t at)
{
    const unsigned char *u = (const unsigned char *)f->bytes + at;
    return (uint32_t)u[0] << 24 | (uint32_t)u[1] << 16 | (uint32_t)u[2] << 8 | u[3];
}

static uint32_t get_u32(struct file *f)
{
    if (f->bad || f->n - f->at < 4) {
        f->bad = true;
        return 0;
    }
    f->at += 4;
    return u32_at(f, f->at - 4);
}

static void skip(struct file *f, uint64_t n)
{
    n += (4 - n % 4) % 4;
    if (f->bad || n > f->n - f->at)
        f->bad = true;
    else
        f->at += (size_t)n;
}

static struct text get_text(struct file *f)
{
    uint32_t n = get_u32(f);
    struct text t = {f->bytes + f->at, n};
    skip(f, n);
    return f->bad ? (struct text){"", 0} : t;
}

static size_t size_of_type(uint32_t type)
{
    static const size_t sizes[] = {0, 1, 1, 2, 4, 4, 8};
    return type < sizeof sizes / sizeof *sizes ? sizes[type] : 0;
}

static void skip_atts(struct file *f)
{
    get_u32(f);
    uint32_t n = get_u32(f);
    for (uint32_t i = 0; i < n && !f->bad; i++) {
        get_text(f);
        uint32_t type = get_u32(f);
        skip(f, (uint64_t)get_u32(f) * size_of_type(type));
    }
}

/* An attribute of a variable: its type (0: it has none of that name), its values in *t. */
static uint32_t find_att(struct file *f, const struct var *v, const char *name, struct text *t)
{
    size_t kept = f->at;
    uint32_t found = 0;
    f->at = v->atts;
    get_u32(f);
    uint32_t n = get_u32(f);
    for (uint32_t i = 0; i < n && !f->bad && !found; i++) {
        struct text own = get_text(f);
        uint32_t type = get_u32(f), count = get_u32(f);
        if (own.n == strlen(name) && !memcmp(own.s, name, own.n)) {
            found = type;
            *t = (struct text){f->bytes + f->at, count};
        }
        skip(f, (uint64_t)count * size_of_type(type));
    }
    f->at = kept;
    return f->bad ? 0 : found;
}

static bool att_is(struct file *f, const struct var *v, const char *name, const char *value)
{
    struct text t;
    return find_att(f, v, name, &t) == 2 && t.n >= strlen(value) &&
           !memcmp(t.s, value, strlen(value)) &&
           (t.n == strlen(value) || t.s[strlen(value)] == '\0');
}

static int64_t att_integer(struct file *f, const struct var *v, const char *name, int64_t otherwise)
{
    struct text t;
    if (find_att(f, v, name, &t) != 4 || t.n != 1)
        return otherwise;
    return (int32_t)u32_at(f, (size_t)(t.s - f->bytes));
}

static enum hm_err read_var(struct file *f, struct hm_diag *d)
{
    struct var v = {.name = get_text(f)};
    v.ndims = get_u32(f);
    if (!f->bad && v.ndims > MOST_DIMS)
        return fail(f, d, "a variable with too many dimensions");
    for (uint32_t i = 0; i < v.ndims && !f->bad; i++)
        v.dim[i] = get_u32(f);
    v.atts = f->at;
    skip_atts(f);
    v.type = get_u32(f);
    get_u32(f);
    v.begin = f->wide ? (uint64_t)get_u32(f) << 32 : 0;
    v.begin |= get_u32(f);
    for (uint32_t i = 0; i < v.ndims && !f->bad; i++)
        if (v.dim[i] >= f->dims)
            return fail(f, d, "a variable with a dimension that is not there");
    if (!hm_grow(&f->var, &f->var_cap, f->vars + 1, sizeof v))
        return hm_fail_memory(d);
    f->var[f->vars++] = v;
    return f->bad ? fail(f, d, "") : HM_OK;
}

static enum hm_err read_header(struct file *f, struct hm_diag *d)
{
    if (f->n > 0 && f->bytes[0] != 'C')
        return fail(f, d, "NetCDF 4 (HDF5): \"nccopy -k classic\" makes a file that is read here");
    f->wide = f->n > 3 && f->bytes[3] == 2;
    f->at = 4;
    get_u32(f);
    uint32_t tag = get_u32(f), n = get_u32(f);
    if (!f->bad && n > 0 && tag != TAG_DIMENSION)
        return fail(f, d, "not what a NetCDF file has here");
    for (uint32_t i = 0; i < n && !f->bad; i++) {
        get_text(f);
        if (!hm_grow(&f->dim, &f->dim_cap, f->dims + 1, sizeof *f->dim))
            return hm_fail_memory(d);
        f->dim[f->dims++] = get_u32(f);
    }
    skip_atts(f);
    tag = get_u32(f);
    n = get_u32(f);
    if (!f->bad && n > 0 && tag != TAG_VARIABLE)
        return fail(f, d, "not what a NetCDF file has here");
    enum hm_err err = f->bad ? fail(f, d, "") : HM_OK;
    for (uint32_t i = 0; i < n && !err; i++)
        err = read_var(f, d);
    return err;
}

/* --- values --- */

static const struct var *find_var(const struct file *f, const char *name, size_t n)
{
    for (size_t k = 0; k < f->vars; k++)
        if (f->var[k].name.n == n && !memcmp(f->var[k].name.s, name, n))
            return &f->var[k];
    return NULL;
}

/* The variable of that name behind that of the mesh: mesh2d and _node_z. */
static const struct var *find_beside(const struct file *f, const struct var *mesh,
                                     const char *ending)
{
    char name[256];
    int n = snprintf(name, sizeof name, "%.*s%s", (int)(mesh->name.n < 200 ? mesh->name.n : 200),
                     mesh->name.s, ending);
    return find_var(f, name, (size_t)n);
}

/* Are there `count` values of the variable in the file, of a type that is a number? */
static bool holds(const struct file *f, const struct var *v, uint64_t count)
{
    size_t size = v->type == 4 || v->type == 5 || v->type == 6 ? size_of_type(v->type) : 0;
    return size > 0 && v->begin <= f->n && count <= (f->n - v->begin) / size;
}

static double value(const struct file *f, const struct var *v, size_t i)
{
    size_t at = (size_t)v->begin + i * size_of_type(v->type);
    uint32_t high = u32_at(f, at);
    float single;
    double number;
    if (v->type == 4)
        return (int32_t)high;
    if (v->type == 5) {
        memcpy(&single, &high, sizeof single);
        return single;
    }
    uint64_t bits = (uint64_t)high << 32 | u32_at(f, at + 4);
    memcpy(&number, &bits, sizeof number);
    return number;
}

static const struct var *find_mesh(struct file *f)
{
    for (size_t k = 0; k < f->vars; k++)
        if (att_is(f, &f->var[k], "cf_role", "mesh_topology") &&
            att_integer(f, &f->var[k], "topology_dimension", 2) == 2)
            return &f->var[k];
    return NULL;
}

/* Heights: `<mesh>_node_z`, or what has them by its standard name. */
static const struct var *find_heights(struct file *f, const struct var *mesh)
{
    const struct var *v = find_beside(f, mesh, "_node_z");
    for (size_t k = 0; k < f->vars && !v; k++)
        if (att_is(f, &f->var[k], "standard_name", "altitude") &&
            att_is(f, &f->var[k], "location", "node"))
            v = &f->var[k];
    return v;
}

static enum hm_err read_nodes(struct file *f, const struct var *mesh, struct hm_mesh *m,
                              struct hm_diag *d)
{
    struct text names;
    const struct var *v[3] = {NULL, NULL, find_heights(f, mesh)};
    if (find_att(f, mesh, "node_coordinates", &names) == 2) {
        const char *s = names.s, *end = s + names.n;
        for (int k = 0; k < 2; k++) {
            while (s < end && *s == ' ')
                s++;
            const char *stop = s;
            while (stop < end && *stop != ' ' && *stop)
                stop++;
            v[k] = find_var(f, s, (size_t)(stop - s));
            s = stop;
        }
    }
    if (!v[0] || !v[1] || v[0]->ndims != 1 || v[1]->ndims != 1 || v[0]->dim[0] != v[1]->dim[0])
        return fail(f, d, "the mesh has no node_coordinates that fit");
    size_t n = f->dim[v[0]->dim[0]];
    if (v[2] && (v[2]->ndims != 1 || v[2]->dim[0] != v[0]->dim[0]))
        v[2] = NULL;
    for (int k = 0; k < 3; k++)
        if (v[k] && !holds(f, v[k], n))
            f->bad = true;
    if (f->bad)
        return fail(f, d, "");
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < n && !err; i++) {
        double xyz[3] = {value(f, v[0], i), value(f, v[1], i), v[2] ? value(f, v[2], i) : NAN};
        struct hm_node node;
        const char *why = hm_reader_make_node(&node, xyz, 0, 0);
        err = why ? fail(f, d, why) : hm_mesh_add_node(m, node, d);
    }
    return err;
}

static enum hm_err read_faces(struct file *f, const struct var *mesh, struct hm_mesh *m,
                              struct hm_diag *d)
{
    struct text name;
    const struct var *v = NULL, *region = find_beside(f, mesh, "_face_region");
    if (find_att(f, mesh, "face_node_connectivity", &name) == 2)
        v = find_var(f, name.s, strnlen(name.s, name.n));
    if (!v || v->ndims != 2)
        return fail(f, d, "the mesh has no face_node_connectivity");
    size_t n = f->dim[v->dim[0]], most = f->dim[v->dim[1]];
    int64_t first = att_integer(f, v, "start_index", 0);
    int64_t filling = att_integer(f, v, "_FillValue", -INT32_MAX); /* NetCDF's own */
    if (most < 3 || most > 64)
        return fail(f, d, "faces with fewer than three corners, or too many");
    if (region && (region->ndims != 1 || region->dim[0] != v->dim[0]))
        region = NULL;
    if (!holds(f, v, (uint64_t)n * most) || (region && !holds(f, region, n))) {
        f->bad = true;
        return fail(f, d, "");
    }
    for (size_t k = 0; k < n; k++) {
        int64_t numbers[5];
        int corners = 0;
        for (size_t i = 0; i < most; i++) {
            double node = value(f, v, k * most + i);
            if (node == (double)filling || !(node >= (double)first))
                continue;
            if (corners == 4)
                return fail(f, d, "a face has more than four corners");
            numbers[corners++] = node <= INT32_MAX ? (int64_t)node - first : -1;
        }
        double material = region ? value(f, region, k) : 0;
        numbers[corners] = material >= 0 && material <= INT32_MAX ? (int64_t)material : -1;
        struct hm_elem elem;
        const char *why = corners < 3 ? "a face has fewer than three corners"
                                      : hm_reader_make_elem(&elem, numbers, corners, m->nnodes);
        enum hm_err err = why ? fail(f, d, why) : hm_mesh_add_elem(m, elem, d);
        if (err)
            return err;
    }
    return HM_OK;
}

/* The text that hm_export_ugrid leaves, or the EPSG code. */
static enum hm_err read_system(struct file *f, struct hm_mesh *m, struct hm_diag *d)
{
    static const char *const names[] = {"projected_coordinate_system", "wgs84", "crs"};
    const struct var *v = NULL;
    char text[256];
    struct text name;
    for (size_t k = 0; k < sizeof names / sizeof *names && !v; k++)
        v = find_var(f, names[k], strlen(names[k]));
    if (!v)
        return HM_OK;
    int64_t epsg = att_integer(f, v, "epsg", att_integer(f, v, "EPSG", 0));
    if (find_att(f, v, "name", &name) == 2 && name.n > 0 && name.n < sizeof text &&
        !memchr(name.s, '\n', name.n))
        snprintf(text, sizeof text, "%.*s", (int)name.n, name.s);
    else if (epsg > 0)
        snprintf(text, sizeof text, "EPSG:%lld", (long long)epsg);
    else
        return HM_OK;
    return hm_header_set(&m->header, "crs", text, d);
}

enum hm_err hm_import_ugrid(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct file f = {.in = in};
    enum hm_err err = read_all(&f, d);
    if (!err)
        err = read_header(&f, d);
    const struct var *mesh = err ? NULL : find_mesh(&f);
    if (!err && !mesh)
        err = fail(&f, d, "no mesh: no variable with the cf_role mesh_topology");
    if (!err)
        err = read_nodes(&f, mesh, m, d);
    if (!err)
        err = read_faces(&f, mesh, m, d);
    if (!err)
        err = read_system(&f, m, d);
    free(f.bytes);
    free(f.dim);
    free(f.var);
    return err;
}
