/* Points and lines as the features of a GIS: GeoJSON, a table of WKT, OGR_GMT. */
#include "hm_attr.h"
#include "hm_crs.h"
#include "hm_export_private.h"
#include "hm_json.h"
#include "hm_num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Names of all properties, each once: the columns of a table. */
struct names {
    char **name;
    size_t n, cap;
};

struct writing {
    struct hm_sink s;
    const struct hm_inputs *in;
    int decimals;
    int64_t *flat;             /* lines that lose their heights */
    struct hm_attr_list attrs; /* of the line being written */
};

static void fail_memory(struct writing *w)
{
    if (!w->s.err)
        w->s.err = hm_fail_memory(w->s.d);
}

/* --- geometries --- */

struct brackets { /* around and between the vertices of a line */
    const char *open, *between, *close, *number;
};
static const struct brackets json = {"[", ",", "]", ","}, wkt = {"", ", ", "", " "};

static void put_place(struct writing *w, const double *xyz, bool height, const struct brackets *b)
{
    hm_sink_text(&w->s, b->open);
    for (int k = 0; k < 2 + height; k++) {
        if (k > 0)
            hm_sink_text(&w->s, b->number);
        hm_sink_number(&w->s, xyz[k], w->decimals);
    }
    hm_sink_text(&w->s, b->close);
}

/* Have all vertices a height? Counted when only some have. */
static bool has_heights(struct writing *w, const struct hm_line *line)
{
    size_t some = 0;
    for (size_t k = 0; k < line->n; k++)
        some += isnan(line->xyz[3 * k + 2]) ? 0 : 1;
    *w->flat += some > 0 && some < line->n;
    return some > 0 && some == line->n;
}

static void put_vertices(struct writing *w, const struct hm_line *line, bool heights,
                         const struct brackets *b)
{
    for (size_t k = 0; k < line->n + line->closed; k++) {
        if (k > 0)
            hm_sink_text(&w->s, b->between);
        put_place(w, line->xyz + 3 * (k % line->n), heights, b);
    }
}

/* A ring has four vertices at least, the first of them repeated. */
static bool is_polygon(const struct hm_line *line)
{
    return line->closed && line->n > 2;
}

/* The attributes of a line to w->attrs; `closed` is told by its shape. */
static void read_attrs(struct writing *w, const struct hm_line *line)
{
    char *attrs = hm_attr_set(line->attrs, "closed", NULL);
    hm_attr_list_free(&w->attrs);
    if (!attrs || !hm_attr_list_read(&w->attrs, attrs))
        fail_memory(w);
    free(attrs);
}

/* --- GeoJSON --- */

static void put_string(struct hm_sink *s, const char *text)
{
    hm_sink_text(s, "\"");
    while (*text) {
        char escape[HM_JSON_ESCAPE];
        size_t n = hm_json_escape(escape, &text);
        hm_sink_bytes(s, escape, n);
    }
    hm_sink_text(s, "\"");
}

/* A value that reads as a number and prints as it was is one. */
static void put_value(struct hm_sink *s, const char *value)
{
    const char *end = value + strlen(value);
    char text[HM_NUM_CHARS];
    double v;
    bool number = hm_num_parse(value, end, &v) == end && isfinite(v) &&
                  hm_num_print(text, v) == (size_t)(end - value) &&
                  !memcmp(text, value, (size_t)(end - value));
    if (number)
        hm_sink_text(s, value);
    else
        put_string(s, value);
}

static void begin_feature(struct writing *w, bool *any)
{
    hm_sink_text(&w->s, *any ? ",\n{\"type\": \"Feature\", \"properties\": {"
                             : "\n{\"type\": \"Feature\", \"properties\": {");
    *any = true;
}

static void json_point(struct writing *w, const struct hm_points *p, size_t k, bool *any)
{
    const double *row = p->v + k * p->stride;
    begin_feature(w, any);
    for (size_t i = 3; i < p->stride; i++) {
        hm_sink_text(&w->s, i > 3 ? ", " : "");
        put_string(&w->s, p->header.fields[i]);
        hm_sink_text(&w->s, ": ");
        if (isfinite(row[i]))
            hm_sink_number(&w->s, row[i], w->decimals);
        else
            hm_sink_text(&w->s, "null");
    }
    hm_sink_text(&w->s, "}, \"geometry\": {\"type\": \"Point\", \"coordinates\": ");
    put_place(w, row, !isnan(row[2]), &json);
    hm_sink_text(&w->s, "}}");
}

static void json_line(struct writing *w, const struct hm_line *line, bool *any)
{
    read_attrs(w, line);
    begin_feature(w, any);
    for (size_t i = 0; i < w->attrs.n; i++) {
        hm_sink_text(&w->s, i > 0 ? ", " : "");
        put_string(&w->s, w->attrs.item[i].key);
        hm_sink_text(&w->s, ": ");
        put_value(&w->s, w->attrs.item[i].value);
    }
    bool polygon = is_polygon(line);
    hm_sink_format(&w->s, "}, \"geometry\": {\"type\": \"%s\", \"coordinates\": %s",
                   polygon ? "Polygon" : "LineString", polygon ? "[[" : "[");
    put_vertices(w, line, has_heights(w, line), &json);
    hm_sink_text(&w->s, polygon ? "]]}}" : "]}}");
}

/* The crs of the inputs, which is one. */
static const char *crs_of(const struct hm_inputs *in)
{
    const char *crs = NULL;
    for (size_t k = 0; k < in->npoints && !crs; k++)
        crs = hm_header_get(&in->points[k].header, "crs");
    for (size_t k = 0; k < in->nlines && !crs; k++)
        crs = hm_header_get(&in->lines[k].header, "crs");
    return crs;
}

static void put_json_crs(struct writing *w, const char *crs)
{
    int epsg = crs ? hm_crs_epsg(crs) : 0;
    if (epsg == 4326)
        return;
    if (!crs) {
        hm_sink_text(&w->s, "\"crs\": null,\n");
        return;
    }
    hm_sink_text(&w->s, "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": ");
    if (epsg > 0)
        hm_sink_format(&w->s, "\"urn:ogc:def:crs:EPSG::%d\"", epsg);
    else
        put_string(&w->s, crs);
    hm_sink_text(&w->s, "}},\n");
}

enum hm_err hm_export_geojson(const struct hm_inputs *in, int decimals, int64_t *flat,
                              struct hm_writer *writer, struct hm_diag *d)
{
    struct writing w = {hm_sink_to(writer, d), in, decimals, flat, {0}};
    bool any = false;
    hm_sink_text(&w.s, "{\"type\": \"FeatureCollection\",\n");
    put_json_crs(&w, crs_of(in));
    hm_sink_text(&w.s, "\"features\": [");
    for (size_t i = 0; i < in->npoints; i++)
        for (size_t k = 0; k < in->points[i].n; k++)
            json_point(&w, &in->points[i], k, &any);
    for (size_t i = 0; i < in->nlines; i++)
        for (size_t k = 0; k < in->lines[i].n; k++)
            json_line(&w, &in->lines[i].line[k], &any);
    hm_sink_text(&w.s, "\n]}\n");
    hm_attr_list_free(&w.attrs);
    return hm_sink_finish(&w.s);
}

/* --- tables --- */

static void add_name(struct writing *w, struct names *names, const char *name)
{
    for (size_t k = 0; k < names->n; k++)
        if (!strcmp(names->name[k], name))
            return;
    char *copy = strdup(name);
    if (!copy || !hm_grow(&names->name, &names->cap, names->n + 1, sizeof *names->name)) {
        free(copy);
        fail_memory(w);
        return;
    }
    names->name[names->n++] = copy;
}

static void find_names(struct writing *w, struct names *names)
{
    for (size_t i = 0; i < w->in->npoints; i++)
        for (size_t k = 3; k < w->in->points[i].stride; k++)
            add_name(w, names, w->in->points[i].header.fields[k]);
    for (size_t i = 0; i < w->in->nlines; i++)
        for (size_t k = 0; k < w->in->lines[i].n; k++) {
            read_attrs(w, &w->in->lines[i].line[k]);
            for (size_t a = 0; a < w->attrs.n; a++)
                add_name(w, names, w->attrs.item[a].key);
        }
}

static void free_names(struct names *names)
{
    for (size_t k = 0; k < names->n; k++)
        free(names->name[k]);
    free(names->name);
}

/* A field between commas, in quotes when it must be. */
static void put_field(struct hm_sink *s, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        hm_sink_text(s, text);
        return;
    }
    hm_sink_text(s, "\"");
    for (; *text; text++)
        hm_sink_bytes(s, *text == '"' ? "\"\"" : text, *text == '"' ? 2 : 1);
    hm_sink_text(s, "\"");
}

static void wkt_point(struct writing *w, const struct hm_points *p, const double *row,
                      const struct names *names)
{
    hm_sink_text(&w->s, isnan(row[2]) ? "POINT (" : "POINT Z (");
    put_place(w, row, !isnan(row[2]), &wkt);
    hm_sink_text(&w->s, ")");
    for (size_t k = 0; k < names->n; k++) {
        int field = hm_header_field(&p->header, names->name[k]);
        hm_sink_text(&w->s, ",");
        if (field > 2 && !isnan(row[field]))
            hm_sink_number(&w->s, row[field], w->decimals);
    }
    hm_sink_text(&w->s, "\n");
}

static void wkt_line(struct writing *w, const struct hm_line *line, const struct names *names)
{
    bool polygon = is_polygon(line), heights = has_heights(w, line);
    read_attrs(w, line);
    hm_sink_format(&w->s, "\"%s%s%s", polygon ? "POLYGON" : "LINESTRING", heights ? " Z" : "",
                   polygon ? " ((" : " (");
    put_vertices(w, line, heights, &wkt);
    hm_sink_text(&w->s, polygon ? "))\"" : ")\"");
    for (size_t k = 0; k < names->n; k++) {
        const char *value = hm_attr_list_get(&w->attrs, names->name[k]);
        hm_sink_text(&w->s, ",");
        put_field(&w->s, value ? value : "");
    }
    hm_sink_text(&w->s, "\n");
}

enum hm_err hm_export_wkt(const struct hm_inputs *in, int decimals, int64_t *flat,
                          struct hm_writer *writer, struct hm_diag *d)
{
    struct writing w = {hm_sink_to(writer, d), in, decimals, flat, {0}};
    struct names names = {0};
    find_names(&w, &names);
    hm_sink_text(&w.s, "WKT");
    for (size_t k = 0; k < names.n; k++) {
        hm_sink_text(&w.s, ",");
        put_field(&w.s, names.name[k]);
    }
    hm_sink_text(&w.s, "\n");
    for (size_t i = 0; i < in->npoints; i++)
        for (size_t k = 0; k < in->points[i].n; k++)
            wkt_point(&w, &in->points[i], in->points[i].v + k * in->points[i].stride, &names);
    for (size_t i = 0; i < in->nlines; i++)
        for (size_t k = 0; k < in->lines[i].n; k++)
            wkt_line(&w, &in->lines[i].line[k], &names);
    free_names(&names);
    hm_attr_list_free(&w.attrs);
    return hm_sink_finish(&w.s);
}

/* --- OGR_GMT --- */

/* A value between `|`: in quotes, unless it is plain. */
static void put_value_gmt(struct hm_sink *s, const char *text)
{
    bool plain = !strpbrk(text, "|\"\\ \t");
    hm_sink_text(s, plain ? "" : "\"");
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            hm_sink_text(s, "\\");
        hm_sink_bytes(s, text, 1);
    }
    hm_sink_text(s, plain ? "" : "\"");
}

static void put_gmt_header(struct writing *w, const struct names *names)
{
    const char *crs = crs_of(w->in);
    int epsg = crs ? hm_crs_epsg(crs) : 0;
    hm_sink_text(&w->s, "# @VGMT1.0 @GLINESTRING\n");
    if (epsg > 0)
        hm_sink_format(&w->s, "# @Je%d\n", epsg);
    for (size_t k = 0; k < names->n; k++) {
        hm_sink_text(&w->s, k > 0 ? "|" : "# @N");
        hm_sink_text(&w->s, names->name[k]);
    }
    for (size_t k = 0; k < names->n; k++)
        hm_sink_text(&w->s, k > 0 ? "|string" : "\n# @Tstring");
    hm_sink_text(&w->s, names->n > 0 ? "\n# FEATURE_DATA\n" : "# FEATURE_DATA\n");
}

/* Has any vertex of any line a height? Else there is no column of them. */
static bool any_height(const struct hm_inputs *in)
{
    for (size_t i = 0; i < in->nlines; i++)
        for (size_t k = 0; k < in->lines[i].n; k++)
            for (size_t v = 0; v < in->lines[i].line[k].n; v++)
                if (!isnan(in->lines[i].line[k].xyz[3 * v + 2]))
                    return true;
    return false;
}

static void gmt_line(struct writing *w, const struct hm_line *line, const struct names *names,
                     bool heights)
{
    read_attrs(w, line);
    hm_sink_text(&w->s, ">\n");
    for (size_t k = 0; k < names->n; k++) {
        const char *value = hm_attr_list_get(&w->attrs, names->name[k]);
        hm_sink_text(&w->s, k > 0 ? "|" : "# @D");
        put_value_gmt(&w->s, value ? value : "");
    }
    hm_sink_text(&w->s, names->n > 0 ? "\n" : "");
    for (size_t k = 0; k < line->n + line->closed; k++) {
        put_place(w, line->xyz + 3 * (k % line->n), heights, &wkt);
        hm_sink_text(&w->s, "\n");
    }
}

enum hm_err hm_export_ogrgmt(const struct hm_inputs *in, int decimals, struct hm_writer *writer,
                             struct hm_diag *d)
{
    struct writing w = {hm_sink_to(writer, d), in, decimals, NULL, {0}};
    struct names names = {0};
    bool heights = any_height(in);
    find_names(&w, &names);
    put_gmt_header(&w, &names);
    for (size_t i = 0; i < in->nlines; i++)
        for (size_t k = 0; k < in->lines[i].n; k++)
            gmt_line(&w, &in->lines[i].line[k], &names, heights);
    free_names(&names);
    hm_attr_list_free(&w.attrs);
    return hm_sink_finish(&w.s);
}
