/* Meshes: elements filled by what they belong to, by height or by their smallest angle, under thin
 * wires; the seams between their parts a little stronger, the boundary thick. */
#include "draw.h"

#include "hm_elem.h"
#include "hm_meshedges.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Paths are painted in pieces of so many elements or edges: cairo is slow on endless ones. */
enum { PIECE = 2000, SHADES = 64, NAME = 24 };

/* Number of the regular mesh an element belongs to: that of all its nodes, 0 when they differ. */
static int32_t owner_of(const struct hm_mesh *m, const struct hm_elem *e)
{
    int32_t owner = m->node[e->node[0]].owner;
    for (int k = 1; k < hm_elem_corners(e); k++)
        if (m->node[e->node[k]].owner != owner)
            return 0;
    return owner;
}

/* The name of an owner, from the header: the k-th word of `owners`, or the mesh's own name. */
static void owner_name(const struct hm_mesh *m, int32_t owner, char name[NAME])
{
    const char *names = hm_header_get(&m->header, "owners");
    snprintf(name, NAME, "regular %d", (int)owner);
    for (int32_t k = 1; names && *names; k++) {
        size_t length = strcspn(names, " \t");
        if (k == owner && length)
            snprintf(name, NAME, "%.*s", (int)length, names);
        names += length;
        names += strspn(names, " \t");
    }
}

/* --- fills: every element gets a class; classes are painted one after the other --- */

static const struct {
    double least; /* degrees */
    const char *text;
} angle_class[] = {
    {30, "smallest angle over 30°"}, {20, "20° to 30°"}, {10, "10° to 20°"}, {-1, "under 10°"}};
enum { ANGLES = sizeof angle_class / sizeof *angle_class };

static struct rgb angle_colour(int32_t class)
{
    const struct rgb colour[ANGLES] = {GOOD, FAIR, {0.90, 0.55, 0.10}, POOR};
    return colour[class];
}

static int32_t class_of(const struct hm_mesh *m, const struct hm_elem *e, enum mesh_fill fill,
                        const struct scale *heights)
{
    if (fill == FILL_Z) {
        double z = 0;
        for (int k = 0; k < hm_elem_corners(e); k++)
            z += m->node[e->node[k]].z / hm_elem_corners(e);
        return isnan(z) ? -1
                        : (int32_t)(fmin(1, fmax(0, range_part(heights->range, z))) * (SHADES - 1));
    }
    if (fill == FILL_QUALITY) {
        double least, most;
        int32_t class = 0;
        hm_elem_angles(m, e, &least, &most);
        while (class < ANGLES - 1 && !(least >= angle_class[class].least))
            class ++;
        return class;
    }
    return owner_of(m, e);
}

static void element_path(struct page *page, const struct hm_mesh *m, const struct hm_elem *e)
{
    for (int k = 0; k < hm_elem_corners(e); k++) {
        const struct hm_node *node = &m->node[e->node[k]];
        double x = view_x(&page->view, node->x), y = view_y(&page->view, node->y);
        if (k == 0)
            cairo_move_to(page->cr, x, y);
        else
            cairo_line_to(page->cr, x, y);
    }
    cairo_close_path(page->cr);
}

static struct rgb class_colour(int32_t class, enum mesh_fill fill)
{
    if (fill == FILL_Z)
        return ramp_colour(RAMP_HEIGHT, class / (SHADES - 1.0));
    if (fill == FILL_QUALITY)
        return angle_colour(class);
    return class > 0 ? owner_colour(class) : (struct rgb){0.95, 0.95, 0.93};
}

/* Heights and qualities are opaque; what the parts are is a tint, through which the ground shows.
 * Where it has a relief the tint may cover its colours almost: light and shade fall on it again. */
static double class_alpha(const struct page *page, int32_t class, enum mesh_fill fill)
{
    if (fill != FILL_REGION || !page->has_ground)
        return 1;
    return class <= 0 ? 0.25 : page->relief.surface ? 0.85 : 0.7;
}

/* Fill the current path; begin a new one. */
static void fill_path(struct page *page, struct rgb colour, double alpha)
{
    set_colour(page, colour, alpha);
    if (alpha < 1 && alpha > 0.5 && page->relief.surface) {
        cairo_fill_preserve(page->cr);
        page_shade(page);
    } else {
        cairo_fill(page->cr);
    }
}

/* Returns how many elements of the class lie in the window. */
static int64_t fill_class(struct page *page, const struct hm_mesh *m, const int32_t *class,
                          int32_t wanted, enum mesh_fill fill)
{
    const struct rgb colour = class_colour(wanted, fill);
    const double alpha = class_alpha(page, wanted, fill);
    int64_t count = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        if (class[k] != wanted || !view_meets(&page->view, m, &m->elem[k]))
            continue;
        element_path(page, m, &m->elem[k]);
        if (++count % PIECE == 0)
            fill_path(page, colour, alpha);
    }
    fill_path(page, colour, alpha);
    return count;
}

/* The mean colour of the ground under the elements of a class, by their area in the window. */
static struct rgb ground_under(const struct page *page, const struct hm_mesh *m,
                               const int32_t *class, int32_t wanted)
{
    struct rgb mean = PAPER;
    double whole = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        const struct hm_node *a = &m->node[e->node[0]], *b = &m->node[e->node[2]];
        double area = fabs(hm_elem_area(m, e)), x = (a->x + b->x) / 2, y = (a->y + b->y) / 2;
        if (class[k] == wanted && area > 0 && view_holds(&page->view, x, y))
            mean = blend(page_ground(page, x, y), area / (whole += area), mean);
    }
    return mean;
}

static void enter_class(struct page *page, const struct hm_mesh *m, int32_t class, int64_t count,
                        enum mesh_fill fill, bool owned, struct rgb colour)
{
    char name[NAME];
    if (fill == FILL_QUALITY)
        legend_add(page, MARK_FILL, colour, count, "%s", angle_class[class].text);
    if (fill != FILL_REGION)
        return;
    owner_name(m, class, name);
    const char *role = hm_header_get(&m->header, "role");
    bool irregular = role && !strcmp(role, "irregular");
    if (owned && class > 0)
        legend_add(page, MARK_FILL, colour, count, "%s", name);
    else if (class > 0)
        legend_add(page, MARK_FILL, colour, count, "region %d", (int)class);
    else
        legend_add(page, MARK_FILL, colour, count, "%s", owned || irregular ? "irregular" : "mesh");
}

/* A class as it looks over the ground. */
static struct rgb swatch(const struct page *page, const struct hm_mesh *m, const int32_t *class,
                         int32_t wanted, enum mesh_fill fill)
{
    double alpha = class_alpha(page, wanted, fill);
    struct rgb colour = class_colour(wanted, fill);
    return alpha < 1 ? blend(colour, alpha, ground_under(page, m, class, wanted)) : colour;
}

/* Paint every class in turn, from the lowest, and enter it in the legend. */
static void fill_elements(struct page *page, const struct hm_mesh *m, const int32_t *class,
                          enum mesh_fill fill, bool owned)
{
    int64_t last = -1;
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_NONE);
    for (;;) {
        int64_t next = INT64_MAX;
        for (size_t k = 0; k < m->nelems; k++)
            if (class[k] > last && class[k] < next)
                next = class[k];
        if (next == INT64_MAX)
            break;
        int64_t count = fill_class(page, m, class, (int32_t)next, fill);
        if (count)
            enter_class(page, m, (int32_t)next, count, fill, owned,
                        swatch(page, m, class, (int32_t)next, fill));
        last = next;
    }
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_DEFAULT);
}

/* --- edges --- */

/* Wires in so many grades, from the faintest, then the stronger lines. */
enum { GRADES = 8, SEAM = GRADES, BORDER, HIDDEN };

/* Size of the smaller element beside an edge, page units: the root of its area. */
static double room_at(const struct page *page, const struct hm_mesh *m,
                      const struct hm_mesh_edge *e)
{
    double area = fabs(hm_elem_area(m, &m->elem[e->left]));
    if (e->right >= 0)
        area = fmin(area, fabs(hm_elem_area(m, &m->elem[e->right])));
    return sqrt(area) * page->view.scale;
}

/* Where elements are small on the page their wires are faint, or the map would drown in them: under
 * half a pixel there are none, from 9 on they are strongest. */
static unsigned char grade_of(const struct page *page, const struct hm_mesh *m,
                              const struct hm_mesh_edge *e, const int32_t *class,
                              enum mesh_fill fill)
{
    if (e->right < 0)
        return BORDER;
    if (fill == FILL_REGION && class[e->left] != class[e->right])
        return SEAM;
    double room = room_at(page, m, e);
    if (!(room >= 0.5))
        return HIDDEN;
    return (unsigned char)fmin(GRADES - 1, room / 9 * (GRADES - 1));
}

static void stroke_edges(struct page *page, const struct hm_mesh *m,
                         const struct hm_mesh_edge *edges, size_t n, const unsigned char *grade,
                         int wanted)
{
    const struct view *v = &page->view;
    int pending = 0;
    for (size_t k = 0; k < n; k++) {
        const struct hm_node *a = &m->node[edges[k].a], *b = &m->node[edges[k].b];
        if (grade[k] != wanted || fmax(a->x, b->x) < v->w || fmin(a->x, b->x) > v->e ||
            fmax(a->y, b->y) < v->s || fmin(a->y, b->y) > v->n)
            continue;
        cairo_move_to(page->cr, view_x(v, a->x), view_y(v, a->y));
        cairo_line_to(page->cr, view_x(v, b->x), view_y(v, b->y));
        if (++pending == PIECE) {
            cairo_stroke(page->cr);
            pending = 0;
        }
    }
    cairo_stroke(page->cr);
}

static enum hm_err draw_edges(struct page *page, const struct hm_mesh *m, const int32_t *class,
                              enum mesh_fill fill, struct hm_diag *d)
{
    struct hm_mesh_edge *edges;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edges, &n, d);
    if (err)
        return err;
    unsigned char *grade = hm_alloc(n, sizeof *grade);
    for (size_t k = 0; k < n && grade; k++)
        grade[k] = grade_of(page, m, &edges[k], class, fill);
    const double em = page->em;
    for (int g = 0; g <= BORDER && grade; g++) {
        const double strength = fmin(1, g / (GRADES - 1.0));
        const double wire = em * (0.02 + 0.025 * strength);
        set_colour(page, INK, g < GRADES ? 0.05 + 0.55 * strength : 0.9);
        cairo_set_line_width(page->cr, g == BORDER ? 0.11 * em : g == SEAM ? 0.06 * em : wire);
        stroke_edges(page, m, edges, n, grade, g);
    }
    err = grade ? HM_OK : hm_fail_memory(d);
    free(grade);
    free(edges);
    return err;
}

enum hm_err draw_mesh(struct page *page, const struct hm_mesh *m, enum mesh_fill fill,
                      const struct scale *heights, struct hm_diag *d)
{
    int32_t *class = hm_alloc(m->nelems, sizeof *class);
    if (!class)
        return hm_fail_memory(d);
    bool owned = false;
    for (size_t k = 0; k < m->nelems; k++) {
        class[k] = class_of(m, &m->elem[k], fill, heights);
        owned |= fill == FILL_REGION && class[k] > 0;
    }
    for (size_t k = 0; k < m->nelems && fill == FILL_REGION && !owned; k++)
        class[k] = m->elem[k].region;
    if (fill != FILL_WIRE)
        fill_elements(page, m, class, fill, owned);
    if (fill != FILL_REGION)
        legend_add(page, MARK_LINE, INK, (int64_t)view_elements(&page->view, m), "Elements");
    if (fill == FILL_Z)
        legend_bar(page, RAMP_HEIGHT, heights);
    enum hm_err err = draw_edges(page, m, class, fill, d);
    free(class);
    page->has_ground |= fill != FILL_WIRE;
    return err;
}
