/* The page: layout, frame, images over the map, and the three formats. */
#include "draw.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the text size: width of the panel; margins beside the map for coordinates. */
static const double panel_em = 17, margin_em = 2.2, gap_em = 1.2;

static enum hm_err check(cairo_status_t status, struct hm_diag *d)
{
    if (status == CAIRO_STATUS_SUCCESS)
        return HM_OK;
    if (status == CAIRO_STATUS_NO_MEMORY)
        return hm_fail_memory(d);
    return hm_fail(d, HM_EIO, "cairo: %s", cairo_status_to_string(status));
}

/* Where the map goes, and how large the page becomes. The map fills a square of `size` less its
 * surroundings, in one direction at least. */
static void lay_out(struct page *page, double size, bool titled)
{
    struct view *v = &page->view;
    page->em = fmin(24, fmax(11, size / 100));
    double margin = page->plain ? 0 : margin_em * page->em;
    double gap = page->plain ? 0 : gap_em * page->em;
    double panel = page->plain ? 0 : panel_em * page->em;
    double top = page->plain ? 0 : titled ? 2.6 * page->em : gap;
    double wide = fmax(16, size - margin - panel - gap), high = fmax(16, size - margin - top);
    v->scale = fmin(wide / (v->e - v->w), high / (v->n - v->s));
    v->width = fmax(1, round((v->e - v->w) * v->scale));
    v->height = fmax(1, round((v->n - v->s) * v->scale));
    v->x = round(margin);
    v->y = round(top);
    page->width = v->x + v->width + round(gap + panel);
    /* the panel needs room for its legend even beside a flat map */
    page->height =
        v->y + round(margin) + (page->plain ? v->height : fmax(v->height, 26 * page->em));
}

enum hm_err page_open(struct page *page, double size, const char *title, cairo_write_func_t write,
                      void *closure, struct hm_diag *d)
{
    lay_out(page, size, title && *title);
    switch (page->format) {
    case FORMAT_PNG:
        page->surface =
            cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)page->width, (int)page->height);
        break;
    case FORMAT_SVG:
        page->surface =
            cairo_svg_surface_create_for_stream(write, closure, page->width, page->height);
        break;
    case FORMAT_PDF:
        page->surface =
            cairo_pdf_surface_create_for_stream(write, closure, page->width, page->height);
        /* equal pictures, equal bytes: no time of day */
        cairo_pdf_surface_set_metadata(page->surface, CAIRO_PDF_METADATA_CREATE_DATE,
                                       "2000-01-01T00:00:00Z");
        break;
    }
    page->cr = cairo_create(page->surface);
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(page->cr, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(page->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    set_colour(page, PAPER, 1);
    cairo_paint(page->cr);
    cairo_save(page->cr);
    cairo_rectangle(page->cr, page->view.x, page->view.y, page->view.width, page->view.height);
    cairo_clip(page->cr);
    return check(cairo_status(page->cr), d);
}

/* Every channel in `levels` steps: thin soft lines take a third of the space in a PNG. */
static void reduce_colours(cairo_surface_t *surface, int levels)
{
    uint32_t to[256];
    for (int v = 0; v < 256; v++)
        to[v] = (uint32_t)(round(round(v / 255.0 * (levels - 1)) / (levels - 1) * 255));
    cairo_surface_flush(surface);
    void *data = cairo_image_surface_get_data(surface);
    uint32_t *pixel = data;
    int64_t n = (int64_t)cairo_image_surface_get_stride(surface) / 4 *
                cairo_image_surface_get_height(surface);
    for (int64_t k = 0; k < n; k++)
        pixel[k] =
            to[pixel[k] >> 16 & 255] << 16 | to[pixel[k] >> 8 & 255] << 8 | to[pixel[k] & 255];
    cairo_surface_mark_dirty(surface);
}

enum hm_err page_close(struct page *page, cairo_write_func_t write, void *closure,
                       struct hm_diag *d)
{
    enum hm_err err = check(cairo_status(page->cr), d);
    cairo_destroy(page->cr);
    if (!err && page->format == FORMAT_PNG && page->levels < 256)
        reduce_colours(page->surface, page->levels);
    if (!err && page->format == FORMAT_PNG)
        err = check(cairo_surface_write_to_png_stream(page->surface, write, closure), d);
    free(page->ground);
    free(page->item);
    if (page->relief.surface)
        cairo_surface_destroy(page->relief.surface);
    cairo_surface_finish(page->surface);
    if (!err)
        err = check(cairo_surface_status(page->surface), d);
    cairo_surface_destroy(page->surface);
    return err;
}

/* --- the frame --- */

static void tick(struct page *page, double x, double y, double dx, double dy)
{
    cairo_move_to(page->cr, x, y);
    cairo_line_to(page->cr, x + dx, y + dy);
    cairo_stroke(page->cr);
}

/* A coordinate at its tick, centred, or moved so far that it stays within the frame. `turned` runs
 * upwards, along the left side. */
static void draw_coordinate(struct page *page, double value, const char *text, bool turned)
{
    const struct view *v = &page->view;
    const double size = 0.8 * page->em, length = 0.35 * page->em;
    const double at = round(turned ? view_y(v, value) : view_x(v, value)) + 0.5;
    const double lo = turned ? v->y : v->x, hi = lo + (turned ? v->height : v->width);
    cairo_text_extents_t box;
    cairo_set_font_size(page->cr, size);
    cairo_text_extents(page->cr, text, &box);
    const double half = box.x_advance / 2;
    const double middle = fmin(fmax(at, lo + half), hi - half);
    if (turned)
        tick(page, v->x, at, -length, 0);
    else
        tick(page, at, v->y + v->height, 0, length);
    cairo_save(page->cr);
    if (turned) {
        cairo_translate(page->cr, v->x - 0.8 * page->em, middle + half);
        cairo_rotate(page->cr, -acos(0));
    } else {
        cairo_translate(page->cr, middle - half, v->y + v->height + 1.5 * page->em);
    }
    draw_text(page, 0, 0, size, text);
    cairo_restore(page->cr);
}

static void draw_coordinates(struct page *page)
{
    const struct view *v = &page->view;
    const double step = fmax(9 * page->em, v->width / 6) / v->scale;
    for (int side = 0; side < 2; side++) {
        struct range range = side ? (struct range){v->s, v->n} : (struct range){v->w, v->e};
        struct ticks ticks = ticks_within(range, step);
        for (int k = 0; k < ticks.n; k++) {
            char text[32];
            double value = tick_print(&ticks, k, text);
            draw_coordinate(page, value, text, side);
        }
    }
}

void page_furnish(struct page *page, const char *title)
{
    const struct view *v = &page->view;
    cairo_restore(page->cr); /* the clip to the map */
    if (page->plain)
        return;
    set_colour(page, INK, 1);
    cairo_set_line_width(page->cr, 1);
    cairo_rectangle(page->cr, v->x - 0.5, v->y - 0.5, v->width + 1, v->height + 1);
    cairo_stroke(page->cr);
    draw_coordinates(page);
    if (title && *title)
        draw_text(page, v->x, v->y - 0.9 * page->em, 1.3 * page->em, title);
    legend_draw(page, v->x + v->width + gap_em * page->em, v->y);
}

/* --- images over the map --- */

enum hm_err image_open(struct image *image, const struct page *page, struct hm_diag *d)
{
    image->zoom = page->format == FORMAT_PNG ? 1 : 2;
    int width = (int)(page->view.width * image->zoom),
        height = (int)(page->view.height * image->zoom);
    image->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    enum hm_err err = check(cairo_surface_status(image->surface), d);
    if (err) {
        cairo_surface_destroy(image->surface);
        return err;
    }
    void *data = cairo_image_surface_get_data(image->surface);
    image->pixel = data;
    image->stride = cairo_image_surface_get_stride(image->surface) / 4;
    image->width = width;
    image->height = height;
    return HM_OK;
}

static uint32_t channel(double v)
{
    return (uint32_t)(255 * fmin(1, fmax(0, v)) + 0.5);
}

void image_put(struct image *image, int64_t x, int64_t y, struct rgb c, double alpha)
{
    if (x < 0 || y < 0 || x >= image->width || y >= image->height)
        return;
    uint32_t *p = &image->pixel[y * image->stride + x];
    if (alpha < 1 && *p >> 24) {
        double under = (1 - alpha) / 255;
        uint32_t a = channel(alpha + (*p >> 24) * under);
        uint32_t r = channel(c.r * alpha + (*p >> 16 & 255) * under);
        uint32_t g = channel(c.g * alpha + (*p >> 8 & 255) * under);
        uint32_t b = channel(c.b * alpha + (*p & 255) * under);
        *p = a << 24 | r << 16 | g << 8 | b;
        return;
    }
    *p = channel(alpha) << 24 | channel(c.r * alpha) << 16 | channel(c.g * alpha) << 8 |
         channel(c.b * alpha);
}

static void set_source(struct page *page, const struct image *image)
{
    cairo_translate(page->cr, page->view.x, page->view.y);
    cairo_scale(page->cr, 1 / image->zoom, 1 / image->zoom);
    cairo_set_source_surface(page->cr, image->surface, 0, 0);
}

struct rgb page_ground(const struct page *page, double x, double y)
{
    const struct view *v = &page->view;
    if (!page->ground || !view_holds(v, x, y))
        return PAPER;
    int64_t i = (int64_t)(view_x(v, x) - v->x) / GROUND_CELL;
    int64_t j = (int64_t)(view_y(v, y) - v->y) / GROUND_CELL;
    return page->ground[j * ((int64_t)v->width / GROUND_CELL + 1) + i];
}

void page_shade(struct page *page)
{
    cairo_save(page->cr);
    set_source(page, &page->relief);
    cairo_fill(page->cr);
    cairo_restore(page->cr);
}

void image_paint(struct image *image, struct page *page)
{
    cairo_surface_mark_dirty(image->surface);
    cairo_save(page->cr);
    set_source(page, image);
    cairo_paint(page->cr);
    cairo_restore(page->cr);
    cairo_surface_destroy(image->surface);
}
