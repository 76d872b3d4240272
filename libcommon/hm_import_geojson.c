/* GeoJSON, parsed by jansson; built without it (HM_JANSSON not defined), it is recognised and
 * refused. */
#include "hm_import_private.h"

#include <ctype.h>

/* A brace, and then the name of something: no other format begins so. */
bool hm_import_is_geojson(const char *s, const char *end)
{
    while (s < end && isspace((unsigned char)*s))
        s++;
    if (s == end || *s != '{')
        return false;
    for (s++; s < end && isspace((unsigned char)*s);)
        s++;
    return s < end && *s == '"';
}

#ifndef HM_JANSSON

enum hm_err hm_import_geojson(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d)
{
    (void)o;
    return hm_fail_line(d, HM_EFORMAT, in->name, 0,
                        "GeoJSON: this program was built without jansson (libjansson-dev); "
                        "ogr2ogr -f OGR_GMT makes of it what is read");
}

#else

#include "hm_crs.h"
#include "hm_num.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reading {
    struct hm_features f;
    char crs[HM_CRS_CHARS];
};

/* Of a place in the tree jansson does not tell the line: the feature is named by its number. */
static enum hm_err fail(struct reading *r, const char *text)
{
    return hm_fail_line(r->f.d, HM_EFORMAT, r->f.in->name, 0, "%s", text);
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

/* --- geometries --- */

static const struct shape {
    const char *name;
    enum hm_shape shape;
    int depth; /* of its vertices in arrays */
} shapes[] = {{"Point", HM_SHAPE_POINTS, 0},    {"MultiPoint", HM_SHAPE_POINTS, 1},
              {"LineString", HM_SHAPE_LINE, 1}, {"MultiLineString", HM_SHAPE_LINE, 2},
              {"Polygon", HM_SHAPE_RING, 2},    {"MultiPolygon", HM_SHAPE_RING, 3}};

static enum hm_err read_vertex(struct reading *r, const json_t *place)
{
    double xyz[3] = {NAN, NAN, NAN};
    size_t n = json_array_size(place);
    for (size_t k = 0; k < n && k < 3; k++) {
        const json_t *v = json_array_get(place, k);
        if (!json_is_number(v))
            return fail(r, "a coordinate that is no number");
        xyz[k] = json_number_value(v);
    }
    return n < 2 ? fail(r, "a place that is not [x, y] or [x, y, z]")
                 : hm_features_vertex(&r->f, xyz);
}

static enum hm_err read_coordinates(struct reading *r, const json_t *list,
                                    const struct shape *shape, int depth, bool inner)
{
    enum hm_err err = HM_OK;
    if (!json_is_array(list))
        return fail(r, "coordinates that are no list");
    if (depth == 0)
        return read_vertex(r, list);
    for (size_t k = 0; k < json_array_size(list) && !err; k++)
        err = read_coordinates(r, json_array_get(list, k), shape, depth - 1, depth == 2 && k > 0);
    if (!err && depth == 1)
        err = hm_features_end(&r->f, inner && shape->shape == HM_SHAPE_RING ? HM_SHAPE_HOLE
                                                                            : shape->shape);
    return err;
}

static enum hm_err read_geometry(struct reading *r, const json_t *geometry, int depth)
{
    const char *type = text_of(geometry, "type");
    if (json_is_null(geometry)) /* a feature without a place */
        return HM_OK;
    if (!strcmp(type, "GeometryCollection") && depth < 20) {
        const json_t *list = json_object_get(geometry, "geometries");
        enum hm_err err = HM_OK;
        for (size_t k = 0; k < json_array_size(list) && !err; k++)
            err = read_geometry(r, json_array_get(list, k), depth + 1);
        return err;
    }
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        const struct shape *shape = &shapes[k];
        if (strcmp(type, shape->name))
            continue;
        enum hm_err err = read_coordinates(r, json_object_get(geometry, "coordinates"), shape,
                                           shape->depth, false);
        return !err && shape->depth == 0 ? hm_features_end(&r->f, shape->shape) : err;
    }
    return fail(r, "a geometry that is not one of GeoJSON's");
}

/* --- features --- */

/* Text, numbers and truths become attributes; lists, objects and null do not. */
static enum hm_err read_properties(struct reading *r, json_t *properties)
{
    const char *key;
    json_t *v;
    enum hm_err err = HM_OK;
    json_object_foreach(properties, key, v)
    {
        char number[HM_NUM_CHARS] = "";
        const char *value = number;
        if (json_is_string(v))
            value = json_string_value(v);
        else if (json_is_integer(v))
            snprintf(number, sizeof number, "%" JSON_INTEGER_FORMAT, json_integer_value(v));
        else if (json_is_real(v))
            number[hm_num_print(number, json_real_value(v))] = '\0';
        else if (json_is_boolean(v))
            value = json_is_true(v) ? "1" : "0";
        else
            continue;
        if ((err = hm_features_property(&r->f, key, value)))
            break;
    }
    return err;
}

static enum hm_err read_feature(struct reading *r, const json_t *feature)
{
    bool bare = strcmp(text_of(feature, "type"), "Feature") != 0;
    enum hm_err err = hm_features_begin(&r->f);
    if (!err && !bare)
        err = read_properties(r, json_object_get(feature, "properties"));
    return err ? err : read_geometry(r, bare ? feature : json_object_get(feature, "geometry"), 0);
}

static enum hm_err read_features(struct reading *r, const json_t *list)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < json_array_size(list) && !err; k++) {
        struct hm_diag *d = r->f.d;
        err = read_feature(r, json_array_get(list, k));
        size_t n = strlen(d->text);
        if (err == HM_EFORMAT)
            snprintf(d->text + n, sizeof d->text - n, " (feature %zu)", k + 1);
    }
    return err;
}

/* --- the system of coordinates --- */

static bool is_degrees(const double *v, size_t n, size_t stride)
{
    for (size_t k = 0; k < n; k++)
        if (fabs(v[k * stride]) > 180 || fabs(v[k * stride + 1]) > 90)
            return false;
    return true;
}

static bool all_degrees(const struct hm_inputs *o)
{
    for (size_t k = 0; o->lines && k < o->lines->n; k++)
        if (!is_degrees(o->lines->line[k].xyz, o->lines->line[k].n, 3))
            return false;
    return !o->points || is_degrees(o->points->v, o->points->n, o->points->stride);
}

/* "urn:ogc:def:crs:EPSG::32632", "EPSG:32632", "urn:ogc:def:crs:OGC:1.3:CRS84". */
static void parse_name(struct reading *r, const char *name)
{
    const char *colon = strrchr(name, ':');
    struct hm_crs crs;
    if (strstr(name, "CRS84"))
        crs = (struct hm_crs){.kind = HM_CRS_LONLAT};
    else if (strstr(name, "EPSG") && colon && isdigit((unsigned char)colon[1])) {
        snprintf(r->crs, sizeof r->crs, "EPSG:%.20s", colon + 1);
        if (!hm_crs_parse(&crs, r->crs))
            return;
    } else {
        snprintf(r->crs, sizeof r->crs, "%s", name);
        return;
    }
    hm_crs_print(r->crs, &crs);
}

/* The member "crs" of before RFC 7946, which is still what projected data have; null says that
 * there is none. Without it longitude and latitude are meant. But GDAL writes CRS84 over data of
 * which it does not know the crs, so numbers that cannot be degrees are none. */
static void find_crs(struct reading *r, const json_t *root)
{
    const json_t *crs = json_object_get(root, "crs");
    parse_name(r, crs ? text_of(json_object_get(crs, "properties"), "name") : "CRS84");
    for (char *c = r->crs; *c; c++)
        if ((unsigned char)*c < ' ')
            *c = ' ';
    struct hm_crs system;
    if (hm_crs_parse(&system, r->crs) && system.kind == HM_CRS_LONLAT && !all_degrees(r->f.o))
        *r->crs = '\0';
}

/* --- the file --- */

struct source {
    struct hm_input *in;
    struct hm_diag *d;
    enum hm_err err;
};

static size_t more_bytes(void *buffer, size_t most, void *data)
{
    struct source *source = data;
    struct hm_input *in = source->in;
    source->err = hm_input_fill(in, 1, source->d);
    if (source->err)
        return (size_t)-1;
    size_t n = hm_input_has(in) < most ? hm_input_has(in) : most;
    memcpy(buffer, hm_input_at(in), n);
    in->pos += n;
    return n;
}

static enum hm_err parse(struct reading *r, json_t **root)
{
    struct source source = {r->f.in, r->f.d, HM_OK};
    json_error_t error;
    *root = json_load_callback(more_bytes, &source, 0, &error);
    if (*root || source.err)
        return source.err;
    enum json_error_code code = json_error_code(&error);
    if (code == json_error_out_of_memory)
        return hm_fail_memory(r->f.d);
    bool cut = code == json_error_premature_end_of_input;
    return hm_fail_line(r->f.d, cut ? HM_ETRUNC : HM_EFORMAT, r->f.in->name, error.line, "%s",
                        error.text);
}

enum hm_err hm_import_geojson(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d)
{
    struct reading r = {.f = {.in = in, .o = o, .d = d}};
    json_t *root = NULL;
    enum hm_err err = parse(&r, &root);
    if (!err && !strcmp(text_of(root, "type"), "FeatureCollection"))
        err = read_features(&r, json_object_get(root, "features"));
    else if (!err)
        err = read_feature(&r, root);
    if (!err)
        find_crs(&r, root);
    if (!err)
        err = hm_features_finish(&r.f, *r.crs ? r.crs : NULL);
    json_decref(root);
    hm_features_free(&r.f);
    return err;
}

#endif
