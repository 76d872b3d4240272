/* What GeoJSON and WKT have in common: features of a GIS to points and lines. */
#include "hm_attr.h"
#include "hm_headio.h"
#include "hm_import_private.h"
#include "hm_num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum hm_err hm_features_begin(struct hm_features *f)
{
    free(f->attrs);
    f->attrs = strdup("");
    f->n = 0;
    return f->attrs ? HM_OK : hm_fail_memory(f->d);
}

enum hm_err hm_features_property(struct hm_features *f, const char *key, const char *value)
{
    char *name = strdup(key);
    if (!name)
        return hm_fail_memory(f->d);
    for (char *c = name; *c; c++)
        if ((unsigned char)*c <= ' ' || strchr("=\"\\", *c))
            *c = '_';
    char *attrs = *name ? hm_attr_set(f->attrs, name, value) : strdup(f->attrs);
    free(name);
    if (!attrs)
        return hm_fail_memory(f->d);
    for (char *c = attrs; *c; c++) /* a line is a line */
        if ((unsigned char)*c < ' ')
            *c = ' ';
    free(f->attrs);
    f->attrs = attrs;
    return HM_OK;
}

enum hm_err hm_features_vertex(struct hm_features *f, const double xyz[3])
{
    struct hm_node node;
    const char *why = hm_reader_make_node(&node, xyz, 0, 0);
    if (why)
        return hm_input_fail(f->in, HM_EFORMAT, f->d, "%s", why);
    if (!hm_grow(&f->xyz, &f->cap, 3 * (f->n + 1), sizeof *f->xyz))
        return hm_fail_memory(f->d);
    memcpy(f->xyz + 3 * f->n++, xyz, 3 * sizeof *xyz);
    return HM_OK;
}

/* --- points --- */

/* One field more, without value in the points from before. */
static enum hm_err widen(struct hm_points *p, const char *name, struct hm_diag *d)
{
    size_t old = p->stride, wide = old + 1;
    enum hm_err err = hm_header_add_field(&p->header, name, NULL, d);
    if (!err && !hm_grow(&p->v, &p->cap, p->n * wide, sizeof *p->v))
        err = hm_fail_memory(d);
    for (size_t k = err ? 0 : p->n; k-- > 0;) {
        memmove(p->v + k * wide, p->v + k * old, old * sizeof *p->v);
        p->v[k * wide + old] = NAN;
    }
    p->stride = wide;
    return err;
}

/* The numbers among the properties to their fields of a row, which has room for all. A height may
 * stand there. */
static void fill_row(const struct hm_points *p, const struct hm_attr_list *list, double *row)
{
    for (size_t k = 3; k < p->stride; k++)
        row[k] = NAN;
    for (size_t i = 0; i < list->n; i++) {
        const char *value = list->item[i].value, *end = value + strlen(value);
        int field = hm_header_field(&p->header, list->item[i].key);
        double v;
        if (hm_num_parse(value, end, &v) == end && (field > 2 || (field == 2 && isnan(row[2]))))
            row[field] = field > 2 || !isinf(v) ? v : NAN;
    }
}

static enum hm_err add_fields(struct hm_points *p, const struct hm_attr_list *list,
                              struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < list->n && !err; i++) {
        const char *value = list->item[i].value, *end = value + strlen(value);
        double v;
        if (hm_num_parse(value, end, &v) == end && p->stride < HM_MAX_FIELDS &&
            hm_header_field(&p->header, list->item[i].key) < 0)
            err = widen(p, list->item[i].key, d);
    }
    return err;
}

static enum hm_err add_points(struct hm_features *f, const struct hm_attr_list *list)
{
    struct hm_points *p = f->o->points;
    if (!p) {
        p = hm_inputs_add_points(f->o);
        enum hm_err err = p ? hm_header_init(&p->header, HM_POINTS, f->d) : hm_fail_memory(f->d);
        if (err)
            return err;
        p->stride = p->header.nfields;
    }
    enum hm_err err = add_fields(p, list, f->d);
    double *row = hm_alloc(p->stride, sizeof *row);
    if (!row)
        err = hm_fail_memory(f->d);
    for (size_t k = 0; k < f->n && !err; k++) {
        memcpy(row, f->xyz + 3 * k, 3 * sizeof *row);
        fill_row(p, list, row);
        err = hm_points_append(p, row, f->d);
    }
    free(row);
    return err;
}

/* --- lines --- */

/* The last vertex of a ring is its first once more. */
static enum hm_err add_line(struct hm_features *f, enum hm_shape shape)
{
    struct hm_lines *l = f->o->lines;
    if (!l) {
        l = hm_inputs_add_lines(f->o);
        enum hm_err err = l ? hm_header_init(&l->header, HM_LINES, f->d) : hm_fail_memory(f->d);
        if (err)
            return err;
    }
    struct hm_line line = {.attrs = f->attrs, .xyz = f->xyz, .n = f->n};
    const double *last = f->xyz + 3 * (f->n - 1);
    if (shape != HM_SHAPE_LINE && f->n > 1) {
        line.closed = true;
        line.n -= f->xyz[0] == last[0] && f->xyz[1] == last[1];
    }
    if (shape == HM_SHAPE_HOLE && !(line.attrs = hm_attr_set(f->attrs, "hole", "1")))
        return hm_fail_memory(f->d);
    enum hm_err err = hm_lines_append(l, &line, f->d);
    if (shape == HM_SHAPE_HOLE)
        free(line.attrs);
    return err;
}

enum hm_err hm_features_end(struct hm_features *f, enum hm_shape shape)
{
    struct hm_attr_list list = {0};
    enum hm_err err = HM_OK;
    if (f->n > 0 && shape != HM_SHAPE_POINTS)
        err = add_line(f, shape);
    else if (f->n > 0)
        err = hm_attr_list_read(&list, f->attrs) ? add_points(f, &list) : hm_fail_memory(f->d);
    hm_attr_list_free(&list);
    f->n = 0;
    return err;
}

/* --- the end --- */

enum hm_err hm_features_finish(struct hm_features *f, const char *crs)
{
    enum hm_err err = HM_OK;
    if (crs && f->o->points)
        err = hm_header_set(&f->o->points->header, "crs", crs, f->d);
    if (crs && f->o->lines && !err)
        err = hm_header_set(&f->o->lines->header, "crs", crs, f->d);
    return err;
}

void hm_features_free(struct hm_features *f)
{
    free(f->attrs);
    free(f->xyz);
}
