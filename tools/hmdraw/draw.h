/* draw: what the parts of hmdraw share. Uses cairo, which libcommon must not.
 *
 * A page is a map in a frame with a panel beside it. Layers draw themselves in the map, in the
 * order of the operands, and enter what they mean in the legend of the panel.
 */
#ifndef DRAW_H
#define DRAW_H

#include "hm_data.h"
#include "hm_residual.h"

#include <cairo.h>

struct rgb {
    double r, g, b; /* 0 .. 1 */
};

struct range {
    double lo, hi; /* lo == hi: one value */
};

enum { LEGEND_TEXT = 40 };

/* What a colour means. */
struct scale {
    struct range range;
    char title[LEGEND_TEXT]; /* "Height (m)" */
    const double *limits; /* SLOPE_LIMITS, ascending, between classes; NULL: colours go smoothly */
};
enum { SLOPE_LIMITS = 6 };

/* --- colour.c --- */

enum ramp { RAMP_HEIGHT, RAMP_VALUE };

struct rgb ramp_colour(enum ramp ramp, double t); /* t 0 .. 1, clamped */
struct rgb material_colour(int32_t material);     /* 0: a light grey; 1, 2, …: a palette */
double range_part(struct range range, double v);  /* 0 at lo, 1 at hi */

struct page;
void set_colour(struct page *page, struct rgb colour, double alpha);

extern const struct rgb INK, PAPER, GREY, BREAKLINE, ROUGH, STRING, GOOD, FAIR, DOUBTFUL, POOR;

/* The colour that one of that opacity takes over another. */
struct rgb blend(struct rgb over, double alpha, struct rgb under);

/* --- relief.c --- */

/* How much heights are to be stretched for a relief that can be seen well, by the slopes (rise over
 * run) of a sample of places, which is sorted. */
double relief_stretch(double *steep, size_t n);
/* The light on ground that rises so much (stretched) to the east and to the north: 1 on level
 * ground. */
double relief_light(double east, double north);

/* --- view.c --- */

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

/* Is a place in the window; is an element, perhaps: do their boxes meet? */
bool view_holds(const struct view *v, double x, double y);
bool view_meets(const struct view *v, const struct hm_mesh *m, const struct hm_elem *e);
/* How many of them. */
size_t view_points(const struct view *v, const struct hm_points *p);
size_t view_elements(const struct view *v, const struct hm_mesh *m);

/* --- range.c --- */

/* Values in the window, up to some 100,000 a layer; begin with {0}. */
struct sampling {
    double *v;
    size_t n, cap;
};
enum hm_err sample_points(struct sampling *s, const struct view *v, const struct hm_points *p,
                          struct hm_diag *d);
enum hm_err sample_grid(struct sampling *s, const struct view *v, const struct hm_grid *g,
                        size_t band, struct hm_diag *d);
enum hm_err sample_mesh(struct sampling *s, const struct view *v, const struct hm_mesh *m,
                        struct hm_diag *d);
/* The range of the values, without blunders; frees them. */
struct range sampling_range(struct sampling *s);

/* Title of a scale from the name of a column and its unit; limits of classes for slopes. */
void scale_name(struct scale *scale, const struct hm_header *h, size_t column, const char *name);

/* --- page.c --- */

enum format { FORMAT_PNG, FORMAT_SVG, FORMAT_PDF };

enum legend_mark { MARK_NONE, MARK_LINE, MARK_DASHES, MARK_DOT, MARK_FILL, MARK_BAR };

struct legend_item {
    enum legend_mark mark;
    char text[LEGEND_TEXT];
    struct rgb colour;
    int64_t count;      /* what the item counts; -1: nothing */
    enum ramp ramp;     /* MARK_BAR */
    struct range range; /* MARK_BAR */
};

/* An image that covers the map, `zoom` pixels a page unit: premultiplied ARGB, row by row. */
struct image {
    cairo_surface_t *surface;
    uint32_t *pixel;
    int64_t width, height, stride;
    double zoom;
};

enum { GROUND_CELL = 8 }; /* page units between the colours kept of the ground */

struct page {
    cairo_surface_t *surface;
    cairo_t *cr;
    struct view view;
    enum format format;
    double width, height; /* pixels */
    double em;            /* size of the text, pixels */
    char unit[24];        /* of x and y */
    int levels;           /* of each colour channel in a PNG, 2 .. 256 */
    bool plain;           /* the map alone, without frame and panel */
    bool has_ground;      /* something opaque was drawn already: fills become transparent */
    struct rgb *ground;   /* colours of the grids so far, row by row; NULL: none */
    struct image relief;  /* light and shade alone of the grids so far; surface NULL: none */
    struct legend_item *item;
    size_t nitems, items_cap;
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

enum hm_err image_open(struct image *image, const struct page *page, struct hm_diag *d);
void image_put(struct image *image, int64_t x, int64_t y, struct rgb colour, double alpha);
void image_paint(struct image *image, struct page *page); /* and free */
/* The colour of the ground at a place; PAPER where there is none. */
struct rgb page_ground(const struct page *page, double x, double y);
/* Let light and shade of the ground fall on the current path, and begin a new one. */
void page_shade(struct page *page);

/* --- legend.c --- */

/* Enter an item, or add its count to the one that has the same text and mark. When memory is short
 * it is left out. */
void legend_add(struct page *page, enum legend_mark mark, struct rgb colour, int64_t count,
                const char *format, ...) __attribute__((format(printf, 5, 6)));
void legend_bar(struct page *page, enum ramp ramp, const struct scale *scale);
/* As many items as there is room for, and how many more there are. */
void legend_draw(struct page *page, double x, double y);
/* 1, 2 or 5 times a power of ten, the greatest not over v > 0, which must be finite. */
double nice_step(double v);
/* The multiples of a nice step, not over `step`, within a range; or its only value. */
struct ticks {
    double first, step; /* value k: (first + k) * step */
    int n;
};
struct ticks ticks_within(struct range range, double step);
/* The value of a tick, in as many digits as tell it from the others. */
double tick_print(const struct ticks *ticks, int k, char text[32]);
void draw_text(struct page *page, double x, double y, double size, const char *text);

/* --- classes.c --- */

enum mesh_fill { FILL_MATERIAL, FILL_WIRE, FILL_Z, FILL_QUALITY };

struct class
{
    char text[LEGEND_TEXT]; /* "": one of many shades */
    struct rgb colour;
    bool backdrop; /* what lies around all that matters: it may be faint */
};
struct classes {
    int32_t *of; /* the class of each element, -1 for none */
    struct class *list;
    size_t n;
};
/* Materials ascending, shades from low to high, angles from good to poor; emptied by
 * classes_free. */
enum hm_err classify(struct classes *c, const struct hm_mesh *m, enum mesh_fill fill,
                     const struct scale *heights, struct hm_diag *d);
void classes_free(struct classes *c);

/* Limits of residual classes (metres): the header's `#thresholds`, as quality writes it, or the
 * paper's Table 1. */
void residual_limits(const struct hm_header *h, double limits[2]);
/* Of residuals, by hm_residual_classify with such limits: text and colour. */
enum { RESIDUAL_CLASSES = 4 };
extern const enum hm_residual_class residual_order[RESIDUAL_CLASSES]; /* as legends name them */
struct class residual_class(enum hm_residual_class class, const double limits[2]);

/* --- the layers --- */

/* The band drawn by height is shaded; others get colour alone. */
enum hm_err draw_grid(struct page *page, const struct hm_grid *g, size_t band, bool relief,
                      const struct scale *scale, struct hm_diag *d);
enum hm_err draw_points(struct page *page, const struct hm_points *p, const struct scale *heights,
                        struct hm_diag *d);
enum hm_err draw_lines(struct page *page, const struct hm_lines *l, struct hm_diag *d);
enum hm_err draw_mesh(struct page *page, const struct hm_mesh *m, enum mesh_fill fill,
                      const struct scale *heights, struct hm_diag *d);

#endif
