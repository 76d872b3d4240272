/* draw: what the parts of hmdraw share. Uses cairo, which libcommon must not.
 *
 * A page is a map in a frame with a panel beside it. Layers draw themselves in the map, in the
 * order of the operands, and enter what they mean in the legend of the panel.
 */
#ifndef DRAW_H
#define DRAW_H

#include "hm_data.h"

#include <cairo.h>

struct rgb {
    double r, g, b; /* 0 .. 1 */
};

struct range {
    double lo, hi; /* empty when hi < lo */
};

/* --- colour.c --- */

enum ramp { RAMP_HEIGHT, RAMP_VALUE };

struct rgb ramp_colour(enum ramp ramp, double t); /* t 0 .. 1, clamped */
struct rgb owner_colour(int32_t owner);           /* owner or region 1, 2, … */
double range_part(struct range range, double v);  /* 0 at lo, 1 at hi */

struct page;
void set_colour(struct page *page, struct rgb colour, double alpha);

extern const struct rgb INK, PAPER, GREY, BREAKLINE, ROUGH, STRING, GOOD, FAIR, POOR;

/* --- page.c --- */

/* Window in the data's coordinates, and where it lies on the page. */
struct view {
    double w, e, s, n;          /* metres */
    double scale;               /* page units a metre */
    double x, y, width, height; /* the map's frame, page units (pixels) */
};

static inline double view_x(const struct view *v, double x)
{
    return v->x + (x - v->w) * v->scale;
}
static inline double view_y(const struct view *v, double y)
{
    return v->y + (v->n - y) * v->scale;
}

enum format { FORMAT_PNG, FORMAT_SVG, FORMAT_PDF };

enum { LEGEND_ITEMS = 24, LEGEND_TEXT = 40 };

enum legend_mark { MARK_LINE, MARK_DASHES, MARK_DOT, MARK_FILL, MARK_BAR };

struct legend_item {
    enum legend_mark mark;
    char text[LEGEND_TEXT];
    struct rgb colour;
    int64_t count;      /* what the item counts; -1: nothing */
    enum ramp ramp;     /* MARK_BAR */
    struct range range; /* MARK_BAR */
};

struct page {
    cairo_surface_t *surface;
    cairo_t *cr;
    struct view view;
    enum format format;
    double width, height; /* pixels */
    double em;            /* size of the text, pixels */
    int levels;           /* of each colour channel in a PNG, 2 .. 256 */
    bool plain;           /* the map alone, without frame and panel */
    bool has_ground;      /* something opaque was drawn already: fills become transparent */
    struct legend_item item[LEGEND_ITEMS];
    size_t nitems;
};

/* Lay out a page whose window (w, e, s, n of `view`) is set, `size` pixels wide or, if the window
 * is tall, high; `write` takes the bytes of SVG and PDF as they come. */
enum hm_err page_open(struct page *page, double size, const char *title, cairo_write_func_t write,
                      void *closure, struct hm_diag *d);
/* Frame, coordinates, title, legend, scale, north. */
void page_furnish(struct page *page, const char *title);
/* Write what is left to write, and free. */
enum hm_err page_close(struct page *page, cairo_write_func_t write, void *closure,
                       struct hm_diag *d);

/* An image that covers the map, `zoom` pixels a page unit: premultiplied ARGB, row by row. */
struct image {
    cairo_surface_t *surface;
    uint32_t *pixel;
    int64_t width, height, stride;
    double zoom;
};
enum hm_err image_open(struct image *image, const struct page *page, struct hm_diag *d);
void image_put(struct image *image, int64_t x, int64_t y, struct rgb colour, double alpha);
void image_paint(struct image *image, struct page *page); /* and free */

/* --- legend.c --- */

/* Enter an item, or add its count to the one that has the same text and mark. */
void legend_add(struct page *page, enum legend_mark mark, struct rgb colour, int64_t count,
                const char *format, ...) __attribute__((format(printf, 5, 6)));
void legend_bar(struct page *page, enum ramp ramp, struct range range, const char *text);
void legend_draw(struct page *page, double x, double y);
/* 1, 2 or 5 times a power of ten, the greatest not over v. */
double nice_step(double v);
void draw_text(struct page *page, double x, double y, double size, const char *text);

/* --- the layers --- */

enum mesh_fill { FILL_REGION, FILL_WIRE, FILL_Z, FILL_QUALITY };

/* The band drawn by height is shaded; others get colour alone. */
enum hm_err draw_grid(struct page *page, const struct hm_grid *g, size_t band, const char *name,
                      struct range range, struct hm_diag *d);
enum hm_err draw_points(struct page *page, const struct hm_points *p, struct range heights,
                        struct hm_diag *d);
enum hm_err draw_lines(struct page *page, const struct hm_lines *l, struct hm_diag *d);
enum hm_err draw_mesh(struct page *page, const struct hm_mesh *m, enum mesh_fill fill,
                      struct range heights, struct hm_diag *d);

#endif
