/* Points: dots of a size that suits their density, coloured by height, or by the classes of the
 * paper's Table 1 when they carry residuals. */
#include "draw.h"

#include <math.h>

static void enter_residuals(struct page *page, const int64_t count[RESIDUAL_CLASSES],
                            const double limits[2])
{
    for (int k = 0; k < RESIDUAL_CLASSES; k++) {
        const struct class class = residual_class(residual_order[k], limits);
        if (count[residual_order[k]])
            legend_add(page, MARK_DOT, class.colour, count[residual_order[k]], "%s", class.text);
    }
}

/* A disc of radius r around a place in pixels, soft at its rim; under a pixel it is one pixel. */
static void put_dot(struct image *image, double x, double y, double r, struct rgb colour)
{
    if (r < 0.6) {
        image_put(image, (int64_t)floor(x), (int64_t)floor(y), colour, 1);
        return;
    }
    for (int64_t j = (int64_t)floor(y - r - 0.5); (double)j <= y + r + 0.5; j++)
        for (int64_t i = (int64_t)floor(x - r - 0.5); (double)i <= x + r + 0.5; i++) {
            double dx = (double)i + 0.5 - x, dy = (double)j + 0.5 - y;
            double cover = r + 0.5 - sqrt(dx * dx + dy * dy);
            if (cover > 0)
                image_put(image, i, j, colour, fmin(1, cover));
        }
}

/* Dots of dense points touch each other; sparse ones are as small as can be seen well. */
static double dot_radius(const struct page *page, size_t n)
{
    double distance = sqrt(page->view.width * page->view.height / (double)n);
    return fmin(0.2 * page->em, fmax(0.5, 0.45 * distance));
}

struct dots {
    struct image *image;
    const struct view *view;
    double radius; /* pixels of the image */
    double rim;    /* how dark it is, 0 .. 1 */
};

/* A dot for a point, if it reaches into the map; `part` of the usual size. Large ones have a dark
 * rim, which tells them from what lies under them and from each other. */
static void put_point(const struct dots *dots, const double *row, double part, struct rgb colour)
{
    const struct view *v = dots->view;
    struct image *image = dots->image;
    const double radius = part * dots->radius, rim = radius > 2 ? 0.22 * radius : 0;
    const double x = (view_x(v, row[0]) - v->x) * image->zoom;
    const double y = (view_y(v, row[1]) - v->y) * image->zoom;
    if (!(x > -radius && y > -radius && x < (double)image->width + radius &&
          y < (double)image->height + radius))
        return;
    if (rim > 0)
        put_dot(image, x, y, radius, blend(INK, dots->rim, colour));
    put_dot(image, x, y, radius - rim, colour);
}

static void draw_heights(const struct dots *dots, const struct hm_points *p, struct range range)
{
    for (size_t i = 0; i < p->n; i++) {
        const double *row = &p->v[i * p->stride];
        struct rgb c = GREY;
        if (!isnan(row[2]))
            c = ramp_colour(RAMP_HEIGHT, range_part(range, row[2]));
        put_point(dots, row, 1, c);
    }
}

/* The worst on top; what lies beside the mesh, small, under all that lies on it. */
static void draw_residuals(const struct dots *dots, const struct hm_points *p, int column,
                           const double limits[2], int64_t count[RESIDUAL_CLASSES])
{
    for (int k = 0; k < RESIDUAL_CLASSES; k++) {
        const enum hm_residual_class wanted =
            residual_order[(k + RESIDUAL_CLASSES - 1) % RESIDUAL_CLASSES];
        const struct rgb colour = residual_class(wanted, limits).colour;
        for (size_t i = 0; i < p->n; i++) {
            const double *row = &p->v[i * p->stride];
            if (hm_residual_classify(row[column], limits) != wanted)
                continue;
            put_point(dots, row, wanted == HM_RESIDUAL_NONE ? 0.5 : 1, colour);
            count[wanted] += view_holds(dots->view, row[0], row[1]);
        }
    }
}

enum hm_err draw_points(struct page *page, const struct hm_points *p, const struct scale *heights,
                        struct hm_diag *d)
{
    const int residual = hm_header_field(&p->header, "residual");
    const size_t inside = view_points(&page->view, p);
    if (!inside)
        return HM_OK;
    struct image image;
    enum hm_err err = image_open(&image, page, d);
    if (err)
        return err;
    const struct dots dots = {&image, &page->view, dot_radius(page, inside) * image.zoom,
                              residual >= 0 ? 0.5 : 0.25};
    if (residual >= 0) {
        int64_t count[RESIDUAL_CLASSES] = {0};
        double limits[2];
        residual_limits(&p->header, limits);
        draw_residuals(&dots, p, residual, limits, count);
        enter_residuals(page, count, limits);
    } else {
        draw_heights(&dots, p, heights->range);
        legend_add(page, MARK_DOT, GREY, (int64_t)inside, "Measurements");
        legend_bar(page, RAMP_HEIGHT, heights);
    }
    image_paint(&image, page);
    return HM_OK;
}
