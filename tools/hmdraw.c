/* hmdraw: any streams → a picture, one layer an object, from bottom to top in the order given; or
 * meshes → a page with a 3D view. */
#include "hmdraw/draw.h"
#include "hmdraw/scene.h"

#include "hm_cli.h"
#include "hm_num.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static struct {
    const char *region; /* w/e/s/n, NULL: all there is */
    double size;        /* pixels */
    int type, fill;     /* enum format, enum mesh_fill */
    int levels;         /* of each colour channel */
    bool has_type, has_fill, has_size, has_levels, plain, scene;
    const char *title, *band;
} cmd = {.size = 1600, .levels = 256};

static const struct hm_option options[] = {
    {'3', "3d", NULL, HM_OPT_FLAG, &cmd.scene,
     .help = "a page of HTML with a 3D view of the meshes, to turn and to click"},
    {'R', "region", "W/E/S/N", HM_OPT_TEXT, &cmd.region, .help = "window to draw (default: all)"},
    {'s', "size", "PIXELS", HM_OPT_POSITIVE, &cmd.size,
     .help = "longer side of the picture (default 1600)", .given = &cmd.has_size},
    {'t', "type", NULL, HM_OPT_CHOICE, &cmd.type,
     .help = "format (default: by the suffix of -o, or png)", .choices = "png|svg|pdf",
     .given = &cmd.has_type},
    {'f', "fill", NULL, HM_OPT_CHOICE, &cmd.fill,
     .help = "what colours the elements (default material)", .choices = "material|wire|z|quality",
     .given = &cmd.has_fill},
    {'B', "band", "NAME", HM_OPT_TEXT, &cmd.band,
     .help = "draw this band of grids (default z, shaded)"},
    {'T', "title", "TEXT", HM_OPT_TEXT, &cmd.title, .help = "title above the map"},
    {'l', "levels", "N", HM_OPT_NATURAL, &cmd.levels,
     .help = "PNG: steps of each colour, 2 to 256; 16 for small files (default 256)",
     .given = &cmd.has_levels},
    {'P', "plain", NULL, HM_OPT_FLAG, &cmd.plain, .help = "the map alone: no frame, no legend"},
    {0}};

static const struct hm_program program = {
    .name = "hmdraw",
    .purpose = "points, grids, lines and meshes → a map, meshes → a 3D view",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_ANY,
    .degrees_ok = true,
    .without = "bpK",
};

struct layer {
    enum hm_kind kind;
    union {
        struct hm_points points;
        struct hm_grid grid;
        struct hm_lines lines;
        struct hm_mesh mesh;
    } of;
};

struct drawing {
    struct layer *layer;
    size_t n, cap;
    struct view view;
    struct scale heights; /* of everything that is coloured by height */
};

/* --- read --- */

static void read_layers(struct hm_cli *cli, struct drawing *drawing)
{
    struct hm_header h;
    struct hm_diag d = {0};
    while (hm_cli_next(cli, &h)) {
        if (!hm_grow(&drawing->layer, &drawing->cap, drawing->n + 1, sizeof *drawing->layer))
            hm_cli_die(cli, "out of memory");
        struct layer *layer = &drawing->layer[drawing->n++];
        *layer = (struct layer){.kind = h.kind};
        struct hm_reader *r = hm_cli_reader(cli);
        enum hm_err err = HM_OK;
        switch (h.kind) {
        case HM_POINTS:
            hm_cli_read_points(cli, &layer->of.points, &h);
            break;
        case HM_GRID:
            err = hm_grid_read(&layer->of.grid, r, &h, &d);
            break;
        case HM_LINES:
            err = hm_lines_read(&layer->of.lines, r, &h, &d);
            break;
        default:
            err = hm_mesh_read(&layer->of.mesh, r, &h, &d);
            break;
        }
        hm_cli_check(cli, err, &d);
    }
}

static const struct hm_header *header_of(const struct layer *layer)
{
    return layer->kind == HM_POINTS  ? &layer->of.points.header
           : layer->kind == HM_GRID  ? &layer->of.grid.header
           : layer->kind == HM_LINES ? &layer->of.lines.header
                                     : &layer->of.mesh.header;
}

static void free_layers(struct drawing *drawing)
{
    for (size_t k = 0; k < drawing->n; k++) {
        struct layer *layer = &drawing->layer[k];
        if (layer->kind == HM_POINTS)
            hm_points_free(&layer->of.points);
        else if (layer->kind == HM_GRID)
            hm_grid_free(&layer->of.grid);
        else if (layer->kind == HM_LINES)
            hm_lines_free(&layer->of.lines);
        else
            hm_mesh_free(&layer->of.mesh);
    }
    free(drawing->layer);
}

/* --- the window --- */

static void widen(struct view *v, double x, double y)
{
    v->w = fmin(v->w, x);
    v->e = fmax(v->e, x);
    v->s = fmin(v->s, y);
    v->n = fmax(v->n, y);
}

static void widen_by_layer(struct view *v, const struct layer *layer)
{
    if (layer->kind == HM_POINTS) {
        const struct hm_points *p = &layer->of.points;
        for (size_t i = 0; i < p->n; i++)
            widen(v, p->v[i * p->stride], p->v[i * p->stride + 1]);
    } else if (layer->kind == HM_GRID) {
        const struct hm_lattice *l = &layer->of.grid.header.lattice;
        widen(v, l->x0, l->y0);
        widen(v, l->x0 + (double)(l->nx - 1) * l->dx, l->y0 + (double)(l->ny - 1) * l->dy);
    } else if (layer->kind == HM_LINES) {
        const struct hm_lines *lines = &layer->of.lines;
        for (size_t k = 0; k < lines->n; k++)
            for (size_t i = 0; i < lines->line[k].n; i++)
                widen(v, lines->line[k].xyz[3 * i], lines->line[k].xyz[3 * i + 1]);
    } else {
        const struct hm_mesh *m = &layer->of.mesh;
        for (size_t i = 0; i < m->nnodes; i++)
            widen(v, m->node[i].x, m->node[i].y);
    }
}

/* Side below which doubles cannot tell places in the window apart well enough. */
static double least_side(const struct view *v)
{
    return fmax(1e-9, 1e-9 * fmax(fabs(v->w) + fabs(v->e), fabs(v->s) + fabs(v->n)));
}

/* A longest side beyond which lengths on the page would overflow. */
static const double most_side = 1e300;

/* A little room around the data, and a shape that fits a page. */
static void round_window(struct view *v)
{
    double width = v->e - v->w, height = v->n - v->s, least = fmax(width, height);
    least = fmax(least > 1e-9 ? least / 8 : 1, least_side(v));
    double room = 0.01 * fmax(least, fmin(width, height));
    double dx = fmax(room, (least - width) / 2), dy = fmax(room, (least - height) / 2);
    v->w -= dx;
    v->e += dx;
    v->s -= dy;
    v->n += dy;
}

static void parse_window(struct hm_cli *cli, const char *text, struct view *v)
{
    double value[4];
    const char *p = text, *end = text + strlen(text);
    for (int k = 0; k < 4; k++) {
        p = hm_num_parse(p, end, &value[k]);
        if (!p || !isfinite(value[k]) || *p != (k < 3 ? '/' : '\0'))
            hm_cli_die(cli, "--region: expected w/e/s/n, got '%s'", text);
        p++;
    }
    *v = (struct view){.w = value[0], .e = value[1], .s = value[2], .n = value[3]};
    if (!(v->w < v->e && v->s < v->n))
        hm_cli_die(cli, "--region: west must be less than east, south less than north");
    const double least = least_side(v);
    if (v->e - v->w < least || v->n - v->s < least)
        hm_cli_die(cli, "--region: a window too small for such coordinates");
    if (!(v->e - v->w < most_side && v->n - v->s < most_side))
        hm_cli_die(cli, "--region: a window too large to draw");
    if (v->e - v->w > 100 * (v->n - v->s) || v->n - v->s > 100 * (v->e - v->w))
        hm_cli_die(cli, "--region: a window more than 100 times as long as wide");
}

/* The window asked for, or one around all layers. */
static void choose_window(struct hm_cli *cli, struct drawing *drawing)
{
    struct view *v = &drawing->view;
    struct view all = {.w = INFINITY, .e = -INFINITY, .s = INFINITY, .n = -INFINITY};
    for (size_t k = 0; k < drawing->n; k++)
        widen_by_layer(&all, &drawing->layer[k]);
    if (!(all.w <= all.e))
        hm_cli_die(cli, "nothing to draw");
    if (cmd.region) {
        if (all.e < v->w || all.w > v->e || all.n < v->s || all.s > v->n)
            hm_cli_say(cli, "nothing lies in the window; the data are in %.10g/%.10g/%.10g/%.10g",
                       all.w, all.e, all.s, all.n);
        return;
    }
    round_window(&all);
    if (!(all.e - all.w < most_side && all.n - all.s < most_side))
        hm_cli_die(cli, "coordinates too far apart to draw");
    *v = all;
}

/* --- colours --- */

/* All heights in the window share one scale, with the unit of the first layer that has any. */
static void find_heights(struct hm_cli *cli, struct drawing *drawing)
{
    const struct view *v = &drawing->view;
    struct scale *heights = &drawing->heights;
    struct sampling s = {0};
    struct hm_diag d = {0};
    for (size_t k = 0; k < drawing->n; k++) {
        const struct layer *layer = &drawing->layer[k];
        enum hm_err err = HM_OK;
        if (layer->kind == HM_POINTS)
            err = sample_points(&s, v, &layer->of.points, &d);
        else if (layer->kind == HM_GRID)
            err = sample_grid(&s, v, &layer->of.grid, 0, &d);
        else if (layer->kind == HM_MESH)
            err = sample_mesh(&s, v, &layer->of.mesh, &d);
        hm_cli_check(cli, err, &d);
        struct scale own = {0};
        scale_name(&own, header_of(layer), 2, "z");
        if (layer->kind == HM_LINES)
            continue;
        if (!*heights->title)
            *heights = own;
        else if (strcmp(heights->title, own.title))
            hm_cli_say(cli, "heights in different units share one scale of colours");
    }
    heights->range = sampling_range(&s);
}

/* --- draw --- */

static enum hm_err draw_grid_layer(struct hm_cli *cli, struct page *page, const struct hm_grid *g,
                                   const struct scale *heights, struct hm_diag *d)
{
    const char *name = cmd.band ? cmd.band : g->header.fields[2];
    int field = hm_header_field(&g->header, name);
    if (field < 2)
        hm_cli_die(cli, "--band: the grid has no band '%s'", name);
    if (!strcmp(name, "z"))
        return draw_grid(page, g, (size_t)field - 2, true, heights, d);
    struct scale scale;
    struct sampling s = {0};
    enum hm_err err = sample_grid(&s, &page->view, g, (size_t)field - 2, d);
    scale.range = sampling_range(&s);
    scale_name(&scale, &g->header, (size_t)field, name);
    return err ? err : draw_grid(page, g, (size_t)field - 2, false, &scale, d);
}

static void draw_layers(struct hm_cli *cli, struct page *page, const struct drawing *drawing)
{
    struct hm_diag d = {0};
    for (size_t k = 0; k < drawing->n; k++) {
        const struct layer *layer = &drawing->layer[k];
        enum hm_err err = HM_OK;
        if (layer->kind == HM_POINTS)
            err = draw_points(page, &layer->of.points, &drawing->heights, &d);
        else if (layer->kind == HM_GRID)
            err = draw_grid_layer(cli, page, &layer->of.grid, &drawing->heights, &d);
        else if (layer->kind == HM_LINES)
            err = draw_lines(page, &layer->of.lines, &d);
        else
            err = draw_mesh(page, &layer->of.mesh, (enum mesh_fill)cmd.fill, &drawing->heights, &d);
        hm_cli_check(cli, err, &d);
        hm_cli_progress(cli, "drawing", (double)(k + 1) / (double)drawing->n);
    }
}

/* --- write --- */

struct sink {
    struct hm_writer *writer;
    struct hm_diag d;
};

static cairo_status_t sink_write(void *closure, const unsigned char *data, unsigned int length)
{
    struct sink *sink = closure;
    return hm_writer_bytes(sink->writer, data, length, &sink->d) ? CAIRO_STATUS_WRITE_ERROR
                                                                 : CAIRO_STATUS_SUCCESS;
}

/* The suffix of a file name, from its point on; NULL for a name without one, and for "-". */
static const char *suffix_of(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return strcmp(path, "-") ? dot : NULL;
}

/* The format that the suffix of -o says, in any case; PNG without a suffix. */
static int format_of_suffix(struct hm_cli *cli, const char *path)
{
    static const char *const suffix[] = {
        [FORMAT_PNG] = ".png", [FORMAT_SVG] = ".svg", [FORMAT_PDF] = ".pdf"};
    const char *dot = suffix_of(path);
    if (!dot)
        return FORMAT_PNG;
    for (int k = FORMAT_PNG; k <= FORMAT_PDF; k++)
        if (!strcasecmp(dot, suffix[k]))
            return k;
    hm_cli_die(cli, "%s: no picture format; -t says png, svg or pdf, -3 makes a page of HTML",
               path);
}

static enum format choose_format(struct hm_cli *cli)
{
    const char *path = hm_cli_output(cli);
    int type = cmd.has_type ? cmd.type : cmd.scene ? FORMAT_PNG : format_of_suffix(cli, path);
    if ((cmd.scene || type != FORMAT_SVG) && !strcmp(path, "-") && isatty(STDOUT_FILENO))
        hm_cli_die(cli, "a picture does not go to a terminal; use -o or a pipe");
    return (enum format)type;
}

/* Images in cairo end at 32,767 pixels, and those in vector formats have two a unit; readers of PDF
 * take pages up to 14,400 units. */
static void check_numbers(struct hm_cli *cli, enum format format)
{
    const int most = format == FORMAT_PNG ? 20000 : 14400;
    const char *unit = format == FORMAT_PNG ? "pixels in PNG" : "points in SVG and PDF";
    if (cmd.size < 64 || cmd.size > most)
        hm_cli_die(cli, "--size: must be within 64 and %d %s", most, unit);
    if (cmd.levels < 2 || cmd.levels > 256)
        hm_cli_die(cli, "--levels: must be within 2 and 256");
}

/* --- the 3D view --- */

static void check_scene_options(struct hm_cli *cli)
{
    const struct {
        bool given;
        const char *name;
    } option[] = {{cmd.has_type, "type"},
                  {cmd.has_size, "size"},
                  {cmd.band, "band"},
                  {cmd.has_levels, "levels"},
                  {cmd.plain, "plain"}};
    for (size_t k = 0; k < sizeof option / sizeof *option; k++)
        if (option[k].given)
            hm_cli_die(cli, "--%s is for maps, not for the page of --3d", option[k].name);
    if (cmd.fill == FILL_WIRE)
        hm_cli_die(cli, "--fill: the page of --3d has wires; material, z or quality");
    const char *dot = suffix_of(hm_cli_output(cli));
    if (dot && strcasecmp(dot, ".html") && strcasecmp(dot, ".htm"))
        hm_cli_die(cli, "%s: -3 makes a page of HTML", hm_cli_output(cli));
}

static bool has_residuals(const struct layer *layer)
{
    return layer->kind == HM_POINTS && hm_header_field(&layer->of.points.header, "residual") >= 0;
}

static void say_left_out(struct hm_cli *cli, int64_t n, const char *noun, const char *which)
{
    if (n)
        hm_cli_say(cli, "the 3D view shows meshes, breaklines and residuals; %s %s not",
                   hm_cli_counted(n, noun).text, which);
}

/* Lines and residuals on the meshes; a word about what the view does not show. */
static void furnish_scene(struct hm_cli *cli, struct scene *scene, const struct drawing *drawing)
{
    struct hm_diag d = {0};
    int64_t layers = 0, lines = 0;
    hm_cli_check(cli, scene_add_borders(scene, &d), &d);
    for (size_t k = 0; k < drawing->n; k++) {
        const struct layer *layer = &drawing->layer[k];
        if (layer->kind == HM_LINES)
            lines += scene_add_breaklines(scene, &layer->of.lines);
        else if (has_residuals(layer))
            hm_cli_check(cli, scene_add_residuals(scene, &layer->of.points, &d), &d);
        else
            layers += layer->kind != HM_MESH;
    }
    hm_cli_check(cli, scene_add_colourings(scene, &d), &d);
    say_left_out(cli, layers, "layer", "of points or grids");
    say_left_out(cli, lines, "line", "with a role");
}

/* The colouring to begin with: as asked, else the last of those that tell elements apart. */
static int first_colouring(const struct scene *scene)
{
    if (cmd.has_fill)
        return cmd.fill == FILL_Z ? -1 : cmd.fill == FILL_QUALITY ? SCENE_QUALITY : SCENE_MATERIAL;
    if (scene->residual)
        return SCENE_RESIDUAL;
    return scene->colouring[SCENE_MATERIAL].classes.n > 1 ? SCENE_MATERIAL : -1;
}

static void write_scene(struct hm_cli *cli, const struct drawing *drawing, struct hm_writer *w)
{
    struct scene scene = {0};
    struct hm_diag d = {0};
    const char *role = NULL;
    char title[64];
    for (size_t k = 0; k < drawing->n; k++)
        if (drawing->layer[k].kind == HM_MESH) {
            const struct hm_mesh *m = &drawing->layer[k].of.mesh;
            hm_cli_check(cli, hm_header_need_metres(&m->header, &d), &d);
            hm_cli_check(cli, scene_add_mesh(&scene, &drawing->view, m, &d), &d);
            role = hm_header_get(&m->header, "role");
        }
    if (!scene.mesh.nelems)
        hm_cli_die(cli, "--3d: no mesh to show");
    hm_cli_check(cli, scene_place(&scene, &d), &d);
    furnish_scene(cli, &scene, drawing);
    snprintf(title, sizeof title, "%.48s mesh", role && scene.nparts == 1 ? role : "the");
    title[0] = (char)toupper((unsigned char)title[0]);
    hm_cli_check(cli,
                 scene_write(&scene, &drawing->heights, cmd.title ? cmd.title : title,
                             first_colouring(&scene), w, &d),
                 &d);
    scene_free(&scene);
}

/* --- the map --- */

static void write_map(struct hm_cli *cli, const struct drawing *drawing, enum format format,
                      struct hm_writer *w)
{
    struct page page = {.plain = cmd.plain, .levels = cmd.levels, .format = format};
    struct sink sink = {.writer = w};
    page.view = drawing->view;
    hm_header_unit(header_of(&drawing->layer[0]), 0, page.unit, sizeof page.unit);
    hm_cli_check(cli, page_open(&page, cmd.size, cmd.title, sink_write, &sink, &sink.d), &sink.d);
    draw_layers(cli, &page, drawing);
    page_furnish(&page, cmd.title);
    hm_cli_check(cli, page_close(&page, sink_write, &sink, &sink.d), &sink.d);
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct drawing drawing = {0};
    if (cmd.scene)
        check_scene_options(cli);
    const enum format format = choose_format(cli);
    check_numbers(cli, format);
    if (cmd.region)
        parse_window(cli, cmd.region, &drawing.view);
    struct hm_writer *w = hm_cli_writer(cli); /* before the work: it may not be writable */
    read_layers(cli, &drawing);
    choose_window(cli, &drawing);
    find_heights(cli, &drawing);
    if (cmd.scene)
        write_scene(cli, &drawing, w);
    else
        write_map(cli, &drawing, format, w);
    free_layers(&drawing);
    return hm_cli_finish(cli);
}
