/* Points: dots of a size that suits their density, coloured by height, or by the classes of the
 * paper's Table 1 when they carry residuals. */
#include "draw.h"

#include <math.h>

static void enter_residuals(struct page *page, const int64_t count[RESIDUAL_CLASSES])
{
    for (int k = 0; k < RESIDUAL_CLASSES; k++) {
        const struct class class = residual_class(residual_order[k]);
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

enum hm_err draw_points(struct page *page, const struct hm_points *p, const struct scale *heights,
                        struct hm_diag *d)
{
    const int residual = hm_header_field(&p->header, "residual");
    const struct view *v = &page->view;
    size_t inside = view_points(v, p);
    if (!inside)
        return HM_OK;
    struct image image;
    enum hm_err err = image_open(&image, page, d);
    if (err)
        return err;
    const double radius = dot_radius(page, inside) * image.zoom;
    int64_t count[RESIDUAL_CLASSES] = {0};
    for (size_t i = 0; i < p->n; i++) {
        const double *row = &p->v[i * p->stride];
        double x = (view_x(v, row[0]) - v->x) * image.zoom;
        double y = (view_y(v, row[1]) - v->y) * image.zoom;
        if (!(x > -radius && y > -radius && x < (double)image.width + radius &&
              y < (double)image.height + radius))
            continue;
        struct rgb c = GREY;
        if (residual >= 0) {
            enum hm_residual_class class = hm_residual_classify(row[residual], residual_limits);
            count[class]++;
            c = residual_class(class).colour;
        } else if (!isnan(row[2])) {
            c = ramp_colour(RAMP_HEIGHT, range_part(heights->range, row[2]));
        }
        /* what lies beside the mesh shall not drown what lies on it */
        bool aside = residual >= 0 && isnan(row[residual]);
        put_dot(&image, x, y, aside ? radius / 2 : radius, c);
    }
    enter_residuals(page, count);
    if (residual < 0) {
        legend_add(page, MARK_DOT, GREY, (int64_t)inside, "Measurements");
        legend_bar(page, RAMP_HEIGHT, heights);
    }
    image_paint(&image, page);
    return HM_OK;
}
