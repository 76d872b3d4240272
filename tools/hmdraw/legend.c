/* The panel beside the map: legend, colour bars, scale bar, north arrow. */
#include "draw.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct ticks ticks_within(struct range range, double step)
{
    if (!(range.hi > range.lo))
        return (struct ticks){1, range.lo, 1};
    struct ticks t = {.step = nice_step(step)};
    t.first = ceil(range.lo / t.step);
    t.n = (int)fmin(100, floor(range.hi / t.step) - t.first + 1);
    return t;
}

double tick_print(const struct ticks *ticks, int k, char text[32])
{
    double value = (ticks->first + k) * ticks->step, digits = 10;
    if (value != 0)
        digits = fmax(10, floor(log10(fabs(value))) - floor(log10(fabs(ticks->step))) + 1);
    snprintf(text, 32, "%.*g", (int)fmin(15, digits), value);
    return value;
}

double nice_step(double v)
{
    double power = 1;
    while (power > v)
        power /= 10;
    while (10 * power <= v)
        power *= 10;
    return v >= 5 * power ? 5 * power : v >= 2 * power ? 2 * power : power;
}

void draw_text(struct page *page, double x, double y, double size, const char *text)
{
    cairo_set_font_size(page->cr, size);
    cairo_move_to(page->cr, x, y);
    cairo_show_text(page->cr, text);
    cairo_new_path(page->cr);
}

/* --- entries --- */

static struct legend_item *find(struct page *page, enum legend_mark mark, const char *text)
{
    for (size_t k = 0; k < page->nitems; k++)
        if (page->item[k].mark == mark && !strcmp(page->item[k].text, text))
            return &page->item[k];
    if (!hm_grow(&page->item, &page->items_cap, page->nitems + 1, sizeof *page->item))
        return NULL;
    struct legend_item *item = &page->item[page->nitems++];
    *item = (struct legend_item){.mark = mark};
    snprintf(item->text, sizeof item->text, "%s", text);
    return item;
}

void legend_add(struct page *page, enum legend_mark mark, struct rgb colour, int64_t count,
                const char *format, ...)
{
    char text[LEGEND_TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    struct legend_item *item = find(page, mark, text);
    if (!item)
        return;
    item->colour = colour;
    item->count += count;
}

void legend_bar(struct page *page, enum ramp ramp, const struct scale *scale)
{
    struct legend_item *item = find(page, MARK_BAR, scale->title);
    if (!item)
        return;
    item->ramp = ramp;
    item->range = scale->range;
    item->count = -1;
}

/* --- drawing --- */

/* 337368 as "337 368" */
static void print_count(char *text, size_t size, int64_t count)
{
    char digits[32];
    int n = snprintf(digits, sizeof digits, "%lld", (long long)count);
    size_t k = 0;
    for (int i = 0; i < n && k + 2 < size; i++) {
        if (i && (n - i) % 3 == 0)
            text[k++] = ' ';
        text[k++] = digits[i];
    }
    text[k] = 0;
}

static void draw_sample(struct page *page, const struct legend_item *item, double x, double y)
{
    cairo_t *cr = page->cr;
    const double em = page->em, width = 2 * em;
    set_colour(page, item->colour, 1);
    cairo_set_line_width(cr, 0.13 * em);
    switch (item->mark) {
    case MARK_NONE:
        break;
    case MARK_DASHES:
        cairo_set_dash(cr, (double[]){0.45 * em, 0.3 * em}, 2, 0);
        /* fall through */
    case MARK_LINE:
        cairo_move_to(cr, x, y - 0.35 * em);
        cairo_line_to(cr, x + width, y - 0.35 * em);
        cairo_stroke(cr);
        cairo_set_dash(cr, NULL, 0, 0);
        break;
    case MARK_DOT:
        cairo_arc(cr, x + width / 2, y - 0.35 * em, 0.28 * em, 0, 4 * acos(0));
        cairo_fill(cr);
        break;
    case MARK_FILL:
    case MARK_BAR:
        cairo_rectangle(cr, x + 0.2 * em, y - 0.85 * em, 1.6 * em, em);
        cairo_fill_preserve(cr);
        set_colour(page, INK, 1);
        cairo_set_line_width(cr, 0.05 * em);
        cairo_stroke(cr);
        break;
    }
    set_colour(page, INK, 1);
}

/* A colour bar of nice values, highest on top; returns its height. */
static double draw_bar(struct page *page, const struct legend_item *item, double x, double y,
                       double height)
{
    cairo_t *cr = page->cr;
    const double em = page->em, top = y + 0.6 * em;
    const struct range r = item->range;
    draw_text(page, x, y, em, item->text);
    cairo_pattern_t *shade = cairo_pattern_create_linear(0, top + height, 0, top);
    for (int k = 0; k <= 12; k++) {
        struct rgb c = ramp_colour(item->ramp, k / 12.0);
        cairo_pattern_add_color_stop_rgb(shade, k / 12.0, c.r, c.g, c.b);
    }
    cairo_rectangle(cr, x + 0.2 * em, top, 1.6 * em, height);
    cairo_set_source(cr, shade);
    cairo_fill_preserve(cr);
    cairo_pattern_destroy(shade);
    set_colour(page, INK, 1);
    cairo_set_line_width(cr, 0.05 * em);
    cairo_stroke(cr);
    const double parts = fmin(4, height / (2.25 * em));
    const struct ticks ticks = ticks_within(r, r.hi / parts - r.lo / parts);
    for (int k = 0; k < ticks.n; k++) {
        char text[32];
        double at = top + height * (1 - range_part(r, tick_print(&ticks, k, text)));
        cairo_move_to(cr, x + 1.8 * em, at);
        cairo_line_to(cr, x + 2.1 * em, at);
        cairo_stroke(cr);
        draw_text(page, x + 2.5 * em, at + 0.32 * em, 0.9 * em, text);
    }
    return height + 3 * em;
}

static void draw_north(struct page *page, double x, double y)
{
    const double em = page->em;
    cairo_move_to(page->cr, x, y - 2.4 * em);
    cairo_line_to(page->cr, x + 0.7 * em, y);
    cairo_line_to(page->cr, x, y - 0.5 * em);
    cairo_line_to(page->cr, x - 0.7 * em, y);
    cairo_close_path(page->cr);
    cairo_fill(page->cr);
    draw_text(page, x - 0.38 * em, y - 2.7 * em, em, "N");
}

/* Two black and two white fields of a nice length together. */
static void draw_scale(struct page *page, double x, double y)
{
    const double em = page->em, length = nice_step(11 * em / page->view.scale);
    const double part = length * page->view.scale / 4;
    char text[64];
    cairo_set_line_width(page->cr, 0.06 * em);
    for (int k = 0; k < 4; k++) {
        cairo_rectangle(page->cr, x + k * part, y - 0.4 * em, part, 0.4 * em);
        if (k % 2 == 0)
            cairo_fill_preserve(page->cr);
        cairo_stroke(page->cr);
    }
    draw_text(page, x, y - 0.8 * em, 0.9 * em, "0");
    if (length >= 1000 && !strcmp(page->unit, "m"))
        snprintf(text, sizeof text, "%.6g km", length / 1000);
    else
        snprintf(text, sizeof text, "%.6g %s", length, page->unit);
    draw_text(page, x + 4 * part - 0.5 * em, y - 0.8 * em, 0.9 * em, text);
}

/* The text of an item and, in grey, what it counts: behind it, or below where there is no room.
 * Returns the height taken. */
static double draw_item(struct page *page, const struct legend_item *item, double x, double y)
{
    const double em = page->em, left = item->mark == MARK_NONE ? x : x + 2.5 * em;
    char count[40];
    cairo_text_extents_t box;
    draw_sample(page, item, x, y);
    draw_text(page, left, y, em, item->text);
    if (item->count < 0)
        return 1.7 * em;
    cairo_text_extents(page->cr, item->text, &box);
    print_count(count, sizeof count, item->count);
    bool below = 2.5 * em + box.x_advance + 0.6 * em * (double)strlen(count) > 15.5 * em;
    set_colour(page, (struct rgb){0.4, 0.4, 0.4}, 1);
    draw_text(page, below ? left : left + box.x_advance + 0.6 * em, below ? y + 1.15 * em : y,
              0.85 * em, count);
    set_colour(page, INK, 1);
    return below ? 2.8 * em : 1.7 * em;
}

/* Items, and between them and `end` how many had no room; returns where the next would stand. */
static double draw_items(struct page *page, double x, double y, double end)
{
    const double em = page->em, line = 1.7 * em, most = 2.8 * em; /* of an item */
    size_t more = 0;
    for (size_t k = 0; k < page->nitems; k++) {
        if (page->item[k].mark == MARK_BAR)
            continue;
        if (more || y + most + line > end)
            more++;
        else
            y += draw_item(page, &page->item[k], x, y);
    }
    if (more) {
        char text[40];
        snprintf(text, sizeof text, "and %zu more", more);
        draw_text(page, x + 2.5 * em, y, em, text);
        y += line;
    }
    return y;
}

void legend_draw(struct page *page, double x, double y)
{
    const double em = page->em, bottom = page->height - 2.2 * em, end = bottom - 5 * em;
    const double least = 4 * em;  /* of a colour bar */
    const double around = 3 * em; /* its title and margins */
    size_t bars = 0;
    for (size_t k = 0; k < page->nitems; k++)
        bars += page->item[k].mark == MARK_BAR;
    set_colour(page, INK, 1);
    y = draw_items(page, x, y + em, end - (double)bars * (least + around));
    /* what is left above the scale bar is shared by the colour bars */
    double room = bars ? (end - y) / (double)bars - around : 0;
    for (size_t k = 0; k < page->nitems; k++)
        if (page->item[k].mark == MARK_BAR && room > least)
            y += draw_bar(page, &page->item[k], x, y + em, fmin(9 * em, room));
    draw_scale(page, x, bottom);
    draw_north(page, x + 15 * em, bottom);
}
