/* The page: what the scene is in JSON, then its numbers, in the place that view3d/page.html keeps
 * for them. Each block is read by the function of model.js that has its name. */
#include "scene.h"

#include "hm_json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* view3d/page.html with all it refers to; made by the Makefile. */
extern const char view3d_page[];

static const char place[] = "<!--DATA-->\n";

/* --- what it is --- */

static void put_colour(struct hm_json *j, const char *name, struct rgb c)
{
    char text[8];
    snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)lround(255 * c.r),
             (unsigned)lround(255 * c.g), (unsigned)lround(255 * c.b));
    hm_json_text(j, name, text);
}

static void put_numbers(struct hm_json *j, const char *name, const double *v, int n)
{
    hm_json_open(j, name, '[');
    for (int k = 0; k < n; k++)
        hm_json_number(j, NULL, v[k]);
    hm_json_close(j, ']');
}

static void put_heights(struct hm_json *j, const struct scale *heights)
{
    const struct range r = heights->range;
    const struct ticks ticks = ticks_within(r, r.hi / 4 - r.lo / 4);
    enum { STOPS = 13 };
    hm_json_open(j, "ramp", '[');
    for (int k = 0; k < STOPS; k++)
        put_colour(j, NULL, ramp_colour(RAMP_HEIGHT, k / (STOPS - 1.0)));
    hm_json_close(j, ']');
    hm_json_open(j, "height", '{');
    hm_json_text(j, "title", heights->title);
    put_numbers(j, "range", (const double[]){r.lo, r.hi}, 2);
    hm_json_open(j, "ticks", '[');
    for (int k = 0; k < ticks.n; k++) {
        char text[32];
        double value = tick_print(&ticks, k, text);
        hm_json_open(j, NULL, '[');
        hm_json_number(j, NULL, value);
        hm_json_text(j, NULL, text);
        hm_json_close(j, ']');
    }
    hm_json_close(j, ']');
    hm_json_close(j, '}');
}

static void put_parts(struct hm_json *j, const struct scene *s)
{
    hm_json_open(j, "meshes", '[');
    for (size_t p = 0; p < s->nparts; p++) {
        const struct scene_part *part = &s->part[p];
        const char *name = hm_header_get(&part->from->header, "name");
        const char *owners = hm_header_get(&part->from->header, "owners");
        char number[32];
        snprintf(number, sizeof number, "mesh %zu", p + 1);
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "name", name ? name : number);
        hm_json_text(j, "owners", owners ? owners : "");
        hm_json_integer(j, "nodes", (int64_t)part->nodes);
        hm_json_integer(j, "elements", (int64_t)part->elems);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_colourings(struct hm_json *j, const struct scene *s)
{
    hm_json_open(j, "colourings", '[');
    for (int k = 0; k < s->ncolourings; k++) {
        const struct classes *classes = &s->colouring[k].classes;
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "title", s->colouring[k].title);
        hm_json_open(j, "classes", '[');
        for (size_t i = 0; i < classes->n; i++) {
            hm_json_open(j, NULL, '{');
            hm_json_text(j, "text", classes->list[i].text);
            put_colour(j, "colour", classes->list[i].colour);
            hm_json_close(j, '}');
        }
        hm_json_close(j, ']');
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static void put_lines(struct hm_json *j, const struct scene *s)
{
    const struct {
        const char *text;
        struct rgb colour;
        double width; /* pixels */
    } style[SCENE_LINES] = {[SCENE_BOUNDARY] = {"Boundary", INK, 1.6},
                            [SCENE_STRINGS] = {"Boundary strings", STRING, 4},
                            [SCENE_BREAKLINES] = {"Breaklines", BREAKLINE, 1.8}};
    hm_json_open(j, "lines", '[');
    for (int k = 0; k < SCENE_LINES; k++) {
        hm_json_open(j, NULL, '{');
        hm_json_text(j, "text", style[k].text);
        put_colour(j, "colour", style[k].colour);
        hm_json_number(j, "width", style[k].width);
        hm_json_integer(j, "count", s->lines[k]);
        hm_json_close(j, '}');
    }
    hm_json_close(j, ']');
}

static enum hm_err write_description(const struct scene *s, const struct scale *heights,
                                     const char *title, int start, struct hm_writer *w,
                                     struct hm_diag *d)
{
    char unit[24];
    struct hm_json j = {.w = w};
    hm_header_unit(&s->part[0].from->header, 0, unit, sizeof unit);
    enum hm_err err = hm_writer_printf(w, d, "<script type=\"application/json\" id=\"scene\">");
    hm_json_open(&j, NULL, '{');
    hm_json_text(&j, "title", title);
    hm_json_text(&j, "unit", unit);
    hm_json_integer(&j, "start", start);
    put_numbers(&j, "origin", s->origin, 3);
    put_numbers(&j, "step", s->step, 3);
    put_heights(&j, heights);
    put_parts(&j, s);
    put_colourings(&j, s);
    put_lines(&j, s);
    hm_json_close(&j, '}');
    if (j.err)
        *d = j.d;
    return err ? err : j.err ? j.err : hm_writer_printf(w, d, "</script>\n");
}

/* --- its numbers --- */

static enum hm_err write_nodes(const struct scene *s, struct hm_writer *w, struct hm_diag *d)
{
    struct encoder places = {0}, marks = {0};
    int64_t last[3] = {0};
    for (size_t k = 0; k < s->mesh.nnodes; k++) {
        const struct hm_node *node = &s->mesh.node[k];
        const double xyz[3] = {node->x, node->y, node->z};
        for (int c = 0; c < 3; c++) {
            int64_t step = (int64_t)round((xyz[c] - s->origin[c]) / s->step[c]);
            encode_signed(&places, step - last[c]);
            last[c] = step;
        }
        encode_run(&marks, (uint32_t)node->flags);
    }
    encode_run_end(&marks);
    for (size_t k = 0; k < s->mesh.nnodes; k++)
        encode_run(&marks, (uint32_t)s->mesh.node[k].owner);
    encode_run_end(&marks);
    enum hm_err err = encoder_write(&places, "nodes", w, d);
    enum hm_err second = encoder_write(&marks, "marks", w, d);
    return err ? err : second;
}

static enum hm_err write_elements(const struct scene *s, struct hm_writer *w, struct hm_diag *d)
{
    struct encoder nodes = {0}, corners = {0};
    int64_t last = 0;
    for (size_t k = 0; k < s->mesh.nelems; k++) {
        const struct hm_elem *e = &s->mesh.elem[k];
        encode_run(&corners, (uint64_t)hm_elem_corners(e));
        encode_signed(&nodes, e->node[0] - last);
        last = e->node[0];
        for (int i = 1; i < hm_elem_corners(e); i++)
            encode_signed(&nodes, e->node[i] - last);
    }
    encode_run_end(&corners);
    enum hm_err err = encoder_write(&corners, "corners", w, d);
    enum hm_err second = encoder_write(&nodes, "elements", w, d);
    return err ? err : second;
}

/* Ascending numbers: how many are left out, how many follow each other. */
static void encode_numbers(struct encoder *c, const int32_t *number, size_t n)
{
    int32_t next = 0;
    for (size_t k = 0; k < n;) {
        size_t end = k + 1;
        while (end < n && number[end] == number[end - 1] + 1)
            end++;
        encode_unsigned(c, (uint64_t)(number[k] - next));
        encode_unsigned(c, end - k);
        next = number[end - 1] + 1;
        k = end;
    }
}

static enum hm_err write_numbers(const struct scene *s, struct hm_writer *w, struct hm_diag *d)
{
    struct encoder c = {0};
    const int32_t *node = s->node_number, *elem = s->elem_number;
    for (size_t p = 0; p < s->nparts; p++) {
        encode_numbers(&c, node, s->part[p].nodes);
        encode_numbers(&c, elem, s->part[p].elems);
        node += s->part[p].nodes;
        elem += s->part[p].elems;
    }
    return encoder_write(&c, "numbers", w, d);
}

/* To a tenth of a millimetre; what is beyond a kilometre is cut to that. */
static int64_t residual_steps(double r)
{
    return (int64_t)round(1e4 * fmin(1000, fmax(-1000, r)));
}

static enum hm_err write_residuals(const struct scene *s, struct hm_writer *w, struct hm_diag *d)
{
    struct encoder c = {0};
    size_t last = 0;
    for (size_t k = 0; k < s->mesh.nelems && s->residual; k++) {
        const struct scene_residual *r = &s->residual[k];
        if (!r->n)
            continue;
        encode_unsigned(&c, k - last);
        encode_unsigned(&c, (uint64_t)r->n);
        encode_unsigned(&c, (uint64_t)residual_steps(sqrt(r->sum2 / (double)r->n)));
        encode_signed(&c, residual_steps(r->worst));
        last = k;
    }
    return encoder_write(&c, "residuals", w, d);
}

static enum hm_err write_classes(const struct scene *s, int colouring, struct hm_writer *w,
                                 struct hm_diag *d)
{
    struct encoder c = {0};
    char id[32];
    for (size_t k = 0; k < s->mesh.nelems; k++)
        encode_run(&c, (uint64_t)s->colouring[colouring].classes.of[k]);
    encode_run_end(&c);
    snprintf(id, sizeof id, "classes-%d", colouring);
    return encoder_write(&c, id, w, d);
}

enum hm_err scene_write(struct scene *s, const struct scale *heights, const char *title, int start,
                        struct hm_writer *w, struct hm_diag *d)
{
    const char *data = strstr(view3d_page, place);
    enum hm_err err = hm_writer_bytes(w, view3d_page, (size_t)(data - view3d_page), d);
    if (!err)
        err = write_description(s, heights, title, start, w, d);
    if (!err)
        err = write_nodes(s, w, d);
    if (!err)
        err = write_elements(s, w, d);
    if (!err)
        err = write_numbers(s, w, d);
    if (!err)
        err = write_residuals(s, w, d);
    if (!err)
        err = encoder_write(&s->vertices, "lines", w, d);
    for (int k = 0; k < s->ncolourings && !err; k++)
        err = write_classes(s, k, w, d);
    data += strlen(place);
    return err ? err : hm_writer_bytes(w, data, strlen(data), d);
}
