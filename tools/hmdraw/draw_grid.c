/* Grids: heights as a shaded relief in a colour ramp, slopes in classes, other bands in colour
 * alone. */
#include "draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The grid as a field of page pixels: where a pixel has no height it is NaN. */
struct field {
    double *z;
    int64_t width, height;
};

static double node_at(const struct hm_grid *g, size_t band, int64_t i, int64_t j)
{
    const struct hm_lattice *l = &g->header.lattice;
    if (i < 0 || j < 0 || i >= l->nx || j >= l->ny)
        return NAN;
    return g->v[(size_t)(j * l->nx + i) * g->bands + band];
}

/* Bilinear between four nodes, else the nearest node, up to half a cell beyond the last. */
static double sample(const struct hm_grid *g, size_t band, double u, double v)
{
    const struct hm_lattice *l = &g->header.lattice;
    if (!(u > -0.5 && v > -0.5 && u < (double)l->nx - 0.5 && v < (double)l->ny - 0.5))
        return NAN;
    double i = floor(u), j = floor(v);
    int64_t a = (int64_t)i, b = (int64_t)j;
    double fu = u - i, fv = v - j;
    double z = (1 - fv) * ((1 - fu) * node_at(g, band, a, b) + fu * node_at(g, band, a + 1, b)) +
               fv * ((1 - fu) * node_at(g, band, a, b + 1) + fu * node_at(g, band, a + 1, b + 1));
    return isnan(z) ? node_at(g, band, a + (fu > 0.5), b + (fv > 0.5)) : z;
}

/* Mean of the nodes in a box of hu × hv cells around (u, v); for grids finer than the page. */
static double box_mean(const struct hm_grid *g, size_t band, double u, double v, double hu,
                       double hv)
{
    double sum = 0;
    int64_t n = 0;
    for (int64_t j = (int64_t)ceil(v - hv / 2); (double)j < v + hv / 2; j++)
        for (int64_t i = (int64_t)ceil(u - hu / 2); (double)i < u + hu / 2; i++) {
            double z = node_at(g, band, i, j);
            if (!isnan(z)) {
                sum += z;
                n++;
            }
        }
    return n ? sum / (double)n : NAN;
}

static enum hm_err resample(struct field *f, const struct hm_grid *g, size_t band,
                            const struct view *view, double zoom, struct hm_diag *d)
{
    const struct hm_lattice *l = &g->header.lattice;
    const double step = 1 / (view->scale * zoom); /* metres a pixel */
    const double hu = step / fabs(l->dx), hv = step / fabs(l->dy);
    f->z = hm_alloc((size_t)(f->width * f->height), sizeof *f->z);
    if (!f->z)
        return hm_fail_memory(d);
    for (int64_t y = 0; y < f->height; y++)
        for (int64_t x = 0; x < f->width; x++) {
            double u = (view->w + ((double)x + 0.5) * step - l->x0) / l->dx;
            double v = (view->n - ((double)y + 0.5) * step - l->y0) / l->dy;
            double *z = &f->z[y * f->width + x];
            bool beyond = !(u > -1 && v > -1 && u < (double)l->nx && v < (double)l->ny);
            *z = beyond                 ? NAN
                 : hu > 1.5 || hv > 1.5 ? box_mean(g, band, u, v, hu, hv)
                                        : sample(g, band, u, v);
        }
    return HM_OK;
}

static double field_at(const struct field *f, int64_t x, int64_t y)
{
    return x < 0 || y < 0 || x >= f->width || y >= f->height ? NAN : f->z[y * f->width + x];
}

/* Rise a pixel towards x, y by central differences over `reach` pixels, one-sided at the border. */
static void gradient(const struct field *f, int64_t x, int64_t y, int64_t reach, double slope[2])
{
    const double here = field_at(f, x, y);
    for (int k = 0; k < 2; k++) {
        double ahead = field_at(f, x + (k ? 0 : reach), y + (k ? reach : 0));
        double behind = field_at(f, x - (k ? 0 : reach), y - (k ? reach : 0));
        double run = (double)reach * (!isnan(ahead) + !isnan(behind));
        double rise = (isnan(ahead) ? here : ahead) - (isnan(behind) ? here : behind);
        slope[k] = run > 0 ? rise / run : 0;
    }
}

static double stretch_of(const struct field *f, int64_t reach, double step)
{
    enum { MOST = 20000 };
    double steep[MOST] = {0};
    size_t n = 0;
    int64_t stride = f->width * f->height / MOST + 1;
    for (int64_t k = 0; k < f->width * f->height; k += stride) {
        double s[2];
        gradient(f, k % f->width, k / f->width, reach, s);
        if (!isnan(f->z[k]))
            steep[n++] = sqrt(s[0] * s[0] + s[1] * s[1]) / step;
    }
    return relief_stretch(steep, n);
}

/* v in steps of 1 / levels */
static double step_to(double v, double levels)
{
    return round(v * levels) / levels;
}

/* Light and colour go in steps too small to disturb: a noisy ground in smooth ones makes pictures
 * twice as large. The light alone goes to `lights`, black where less of it falls than on level
 * ground and white where more does. */
static void paint_relief(struct image *image, struct image *lights, const struct field *f,
                         int64_t reach, double step, struct range range)
{
    const double stretch = stretch_of(f, reach, step) / step;
    for (int64_t y = 0; y < f->height; y++)
        for (int64_t x = 0; x < f->width; x++) {
            double z = f->z[y * f->width + x], s[2];
            if (isnan(z))
                continue;
            gradient(f, x, y, reach, s);
            const double east = s[0] * stretch, north = -s[1] * stretch; /* page y runs down */
            double light = step_to(relief_light(east, north), 32);
            struct rgb c = ramp_colour(RAMP_HEIGHT, step_to(range_part(range, z), 48));
            image_put(image, x, y, (struct rgb){c.r * light, c.g * light, c.b * light}, 1);
            lights->pixel[y * lights->stride + x] = 0; /* the grid on top counts */
            image_put(lights, x, y, light < 1 ? (struct rgb){0, 0, 0} : PAPER, fabs(1 - light));
        }
}

/* The colour of a value that is no height: of its class, where the scale has classes. */
static struct rgb value_colour(const struct scale *scale, double value)
{
    if (!scale->limits)
        return ramp_colour(RAMP_VALUE, range_part(scale->range, value));
    int class = 0;
    while (class < SLOPE_LIMITS && value >= scale->limits[class])
        class ++;
    return ramp_colour(RAMP_VALUE, (double)class / SLOPE_LIMITS);
}

static void enter_values(struct page *page, enum ramp ramp, const struct scale *scale)
{
    if (!scale->limits) {
        legend_bar(page, ramp, scale);
        return;
    }
    legend_add(page, MARK_NONE, INK, -1, "%s", scale->title);
    for (int k = SLOPE_LIMITS; k >= 0; k--) {
        const struct rgb colour = ramp_colour(RAMP_VALUE, (double)k / SLOPE_LIMITS);
        const double *limit = scale->limits;
        if (k == SLOPE_LIMITS)
            legend_add(page, MARK_FILL, colour, -1, "over %g", limit[k - 1]);
        else
            legend_add(page, MARK_FILL, colour, -1, "%g to %g", k ? limit[k - 1] : 0, limit[k]);
    }
}

static void paint_values(struct image *image, const struct field *f, const struct scale *scale)
{
    for (int64_t y = 0; y < f->height; y++)
        for (int64_t x = 0; x < f->width; x++) {
            double z = f->z[y * f->width + x];
            if (!isnan(z))
                image_put(image, x, y, value_colour(scale, z), 1);
        }
}

static enum hm_err shade_field(struct page *page, struct image *image, const struct hm_grid *g,
                               const struct field *f, struct range range, struct hm_diag *d)
{
    enum hm_err err = page->relief.surface ? HM_OK : image_open(&page->relief, page, d);
    if (err)
        return err;
    double step = 1 / (page->view.scale * image->zoom); /* metres a pixel */
    double node = fmin(fabs(g->header.lattice.dx), fabs(g->header.lattice.dy)) / step;
    int64_t reach = node > 1 ? (int64_t)ceil(fmin(node, 1e6)) : 1;
    paint_relief(image, &page->relief, f, reach, step, range);
    cairo_surface_mark_dirty(page->relief.surface);
    return HM_OK;
}

/* The colours of the map, at every GROUND_CELL of it, for legends; without light and shade. */
static enum hm_err keep_ground(struct page *page, const struct field *f, double zoom, bool relief,
                               const struct scale *scale, struct hm_diag *d)
{
    const int64_t nx = (int64_t)page->view.width / GROUND_CELL + 1;
    const int64_t ny = (int64_t)page->view.height / GROUND_CELL + 1;
    if (!page->ground) {
        page->ground = hm_alloc((size_t)(nx * ny), sizeof *page->ground);
        if (!page->ground)
            return hm_fail_memory(d);
        for (int64_t k = 0; k < nx * ny; k++)
            page->ground[k] = PAPER;
    }
    for (int64_t k = 0; k < nx * ny; k++) {
        double x = ((double)(k % nx) + 0.5) * GROUND_CELL * zoom;
        double y = ((double)(k / nx) + 0.5) * GROUND_CELL * zoom;
        double z = field_at(f, (int64_t)x, (int64_t)y);
        if (!isnan(z))
            page->ground[k] = relief ? ramp_colour(RAMP_HEIGHT, range_part(scale->range, z))
                                     : value_colour(scale, z);
    }
    return HM_OK;
}

enum hm_err draw_grid(struct page *page, const struct hm_grid *g, size_t band, bool relief,
                      const struct scale *scale, struct hm_diag *d)
{
    struct image image;
    enum hm_err err = image_open(&image, page, d);
    if (err)
        return err;
    struct field f = {.width = image.width, .height = image.height};
    err = resample(&f, g, band, &page->view, image.zoom, d);
    if (!err && relief)
        err = shade_field(page, &image, g, &f, scale->range, d);
    else if (!err)
        paint_values(&image, &f, scale);
    if (!err) {
        enter_values(page, relief ? RAMP_HEIGHT : RAMP_VALUE, scale);
        page->has_ground = true;
        err = keep_ground(page, &f, image.zoom, relief, scale, d);
    }
    image_paint(&image, page);
    free(f.z);
    return err;
}
