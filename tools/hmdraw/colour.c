/* Colours that stay apart for colour-blind eyes: a height ramp from blue to brown through light
 * tones, and one of values from light yellow to dark blue, on both of which red lines can be seen;
 * classes from the palette of Okabe and Ito, lightened for areas that carry wires. */
#include "draw.h"

#include <math.h>

const struct rgb INK = {0.13, 0.13, 0.15}, PAPER = {1, 1, 1}, GREY = {0.76, 0.76, 0.76};
const struct rgb BREAKLINE = {0.80, 0.06, 0.10}, ROUGH = {0.05, 0.10, 0.45};
const struct rgb STRING = {0.00, 0.45, 0.35};
const struct rgb GOOD = {0.00, 0.62, 0.45}, FAIR = {0.94, 0.84, 0.20},
                 DOUBTFUL = {0.90, 0.55, 0.10}, POOR = {0.84, 0.25, 0.00};

enum { STOPS = 7 };

static const struct rgb stops[][STOPS] = {
    [RAMP_HEIGHT] = {{0.16, 0.40, 0.60},
                     {0.36, 0.62, 0.74},
                     {0.66, 0.82, 0.80},
                     {0.88, 0.91, 0.78},
                     {0.95, 0.87, 0.66},
                     {0.85, 0.68, 0.44},
                     {0.62, 0.42, 0.27}},
    [RAMP_VALUE] = {{1.00, 1.00, 0.88},
                    {0.83, 0.91, 0.60},
                    {0.59, 0.81, 0.58},
                    {0.32, 0.67, 0.62},
                    {0.19, 0.50, 0.65},
                    {0.15, 0.31, 0.58},
                    {0.11, 0.12, 0.36}},
};

/* In halves, since heights of -1e308 and 1e308 are further apart than a double can say. */
double range_part(struct range range, double v)
{
    double whole = range.hi / 2 - range.lo / 2;
    return whole > 0 ? (v / 2 - range.lo / 2) / whole : 0.5;
}

struct rgb blend(struct rgb over, double alpha, struct rgb under)
{
    double rest = 1 - alpha;
    return (struct rgb){over.r * alpha + under.r * rest, over.g * alpha + under.g * rest,
                        over.b * alpha + under.b * rest};
}

struct rgb ramp_colour(enum ramp ramp, double t)
{
    double place = fmin(1, fmax(0, t)) * (STOPS - 1);
    int k = place >= STOPS - 1 ? STOPS - 2 : (int)place;
    double u = place - k;
    struct rgb a = stops[ramp][k], b = stops[ramp][k + 1];
    return (struct rgb){a.r + u * (b.r - a.r), a.g + u * (b.g - a.g), a.b + u * (b.b - a.b)};
}

struct rgb material_colour(int32_t material)
{
    static const struct rgb none = {0.95, 0.95, 0.93};
    static const struct rgb palette[] = {{1.00, 0.79, 0.36}, {0.78, 0.56, 0.78}, {0.60, 0.96, 0.67},
                                         {0.50, 0.56, 0.95}, {0.74, 0.70, 0.66}, {0.72, 0.85, 0.98},
                                         {0.86, 0.50, 0.39}};
    enum { COLOURS = sizeof palette / sizeof *palette };
    return material > 0 ? palette[(material - 1) % COLOURS] : none;
}

void set_colour(struct page *page, struct rgb colour, double alpha)
{
    cairo_set_source_rgba(page->cr, colour.r, colour.g, colour.b, alpha);
}
