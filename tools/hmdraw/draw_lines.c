/* Lines by what they are: breaklines red, with ticks towards the steep side where there is room;
 * what a user drew dark blue, dashed, with its vertices. */
#include "draw.h"

#include "hm_attr.h"
#include "hm_role.h"

#include <math.h>

struct style {
    const char *text;
    const struct rgb *colour;
    double width; /* of the text size */
    bool dashed, vertices;
};
static const struct style styles[] = {
    [HM_ROLE_BREAKLINE] = {"Breaklines", &BREAKLINE, 0.09, false, false},
    [HM_ROLE_SURFACE] = {"Rough banks", &ROUGH, 0.10, true, true},
    [HM_ROLE_FACE] = {"Face loops", &ROUGH, 0.08, false, true},
    [HM_ROLE_HOLE] = {"Holes", &INK, 0.08, false, true},
    [HM_ROLE_BOUNDARY] = {"Outline", &INK, 0.12, true, false},
    [HM_ROLE_REGION] = {"Regions", &INK, 0.08, false, true},
    [HM_ROLE_STRING] = {"Boundary strings", &STRING, 0.22, false, false},
    [HM_ROLE_NET] = {"Control points", &ROUGH, 0.04, false, true},
    [HM_ROLE_MOVE] = {"Moved to breaklines", &STRING, 0.14, false, false},
    [HM_ROLE_ZONE] = {"Zones", &INK, 0.08, false, true},
};

static void trace(struct page *page, const struct hm_line *line)
{
    for (size_t i = 0; i < line->n; i++)
        cairo_line_to(page->cr, view_x(&page->view, line->xyz[3 * i]),
                      view_y(&page->view, line->xyz[3 * i + 1]));
    if (line->closed)
        cairo_close_path(page->cr);
}

static bool is_visible(const struct view *v, const struct hm_line *line)
{
    bool w = false, e = false, s = false, n = false;
    for (size_t i = 0; i < line->n; i++) {
        w |= line->xyz[3 * i] >= v->w;
        e |= line->xyz[3 * i] <= v->e;
        s |= line->xyz[3 * i + 1] >= v->s;
        n |= line->xyz[3 * i + 1] <= v->n;
    }
    return w && e && s && n;
}

/* Ticks every `spacing` page units to the left, where the steep side is. */
static void draw_ticks(struct page *page, const struct hm_line *line, double spacing, double length)
{
    double behind = spacing / 2; /* page units since the last tick */
    for (size_t i = 0; i + !line->closed < line->n; i++) {
        const double *a = &line->xyz[3 * i], *b = &line->xyz[3 * ((i + 1) % line->n)];
        double ax = view_x(&page->view, a[0]), ay = view_y(&page->view, a[1]);
        double dx = view_x(&page->view, b[0]) - ax, dy = view_y(&page->view, b[1]) - ay;
        double whole = sqrt(dx * dx + dy * dy);
        if (!(whole > 0 && whole < 1e5))
            continue;
        double at = spacing - behind;
        for (; at <= whole; at += spacing) {
            double x = ax + dx * at / whole, y = ay + dy * at / whole;
            cairo_move_to(page->cr, x, y);
            /* left of the way, on a page whose y runs down */
            cairo_line_to(page->cr, x + dy / whole * length, y - dx / whole * length);
        }
        behind = whole - (at - spacing);
    }
    cairo_stroke(page->cr);
}

static void draw_vertices(struct page *page, const struct hm_line *line, double size)
{
    for (size_t i = 0; i < line->n; i++)
        cairo_rectangle(page->cr, view_x(&page->view, line->xyz[3 * i]) - size / 2,
                        view_y(&page->view, line->xyz[3 * i + 1]) - size / 2, size, size);
    cairo_fill(page->cr);
}

/* Ticks need to be nearer than about 6 m, or they tell nothing. */
static bool has_ticks(const struct page *page, const struct hm_line *line)
{
    char limit[8];
    return page->view.scale > 0.1 * page->em &&
           hm_attr_get(line->attrs, "limit", limit, sizeof limit);
}

/* A breakline and its ticks, of so much more width and length than usual. */
static void draw_breakline(struct page *page, const struct hm_line *line, double more)
{
    const double em = page->em;
    cairo_set_line_width(page->cr, (styles[HM_ROLE_BREAKLINE].width + more) * em);
    trace(page, line);
    cairo_stroke(page->cr);
    cairo_set_line_width(page->cr, (0.06 + more) * em);
    if (has_ticks(page, line))
        draw_ticks(page, line, 0.6 * em, (0.36 + more / 2) * em);
}

static void draw_line(struct page *page, const struct hm_line *line, enum hm_role role)
{
    const struct style *style = &styles[role];
    const double em = page->em;
    set_colour(page, *style->colour, 1);
    if (role == HM_ROLE_BREAKLINE) {
        draw_breakline(page, line, 0);
        return;
    }
    cairo_set_line_width(page->cr, style->width * em);
    if (style->dashed)
        cairo_set_dash(page->cr, (double[]){0.6 * em, 0.35 * em}, 2, 0);
    trace(page, line);
    cairo_stroke(page->cr);
    cairo_set_dash(page->cr, NULL, 0, 0);
    if (style->vertices)
        draw_vertices(page, line, 0.4 * em);
}

/* Light bands under all breaklines, on which they can be seen against dark ground. */
static void draw_casings(struct page *page, const struct hm_lines *l)
{
    set_colour(page, PAPER, 0.55);
    for (size_t k = 0; k < l->n; k++)
        if (l->line[k].n && is_visible(&page->view, &l->line[k]) &&
            hm_role_of(l->line[k].attrs) == HM_ROLE_BREAKLINE)
            draw_breakline(page, &l->line[k], 0.1);
}

enum hm_err draw_lines(struct page *page, const struct hm_lines *l, struct hm_diag *d)
{
    (void)d;
    cairo_save(page->cr);
    cairo_set_line_join(page->cr, CAIRO_LINE_JOIN_ROUND);
    draw_casings(page, l);
    for (size_t k = 0; k < l->n; k++) {
        const struct hm_line *line = &l->line[k];
        if (!line->n || !is_visible(&page->view, line))
            continue;
        enum hm_role role = hm_role_of(line->attrs);
        draw_line(page, line, role);
        legend_add(page, styles[role].dashed ? MARK_DASHES : MARK_LINE, *styles[role].colour, 1,
                   "%s", styles[role].text);
    }
    cairo_restore(page->cr);
    return HM_OK;
}
