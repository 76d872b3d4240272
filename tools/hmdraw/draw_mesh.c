/* Meshes: elements filled by what they belong to, by height or by their smallest angle, under thin
 * wires; the boundary and the seams between regular and irregular parts stronger. */
#include "draw.h"

#include "hm_elem.h"
#include "hm_meshcheck.h"

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
                        struct range heights)
{
    if (fill == FILL_Z) {
        double z = 0;
        for (int k = 0; k < hm_elem_corners(e); k++)
            z += m->node[e->node[k]].z / hm_elem_corners(e);
        return isnan(z) ? -1 : (int32_t)(fmin(1, fmax(0, range_part(heights, z))) * (SHADES - 1));
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

static bool is_visible(const struct view *v, const struct hm_mesh *m, const struct hm_elem *e)
{
    bool w = false, east = false, s = false, n = false;
    for (int k = 0; k < hm_elem_corners(e); k++) {
        const struct hm_node *node = &m->node[e->node[k]];
        w |= node->x >= v->w;
        east |= node->x <= v->e;
        s |= node->y >= v->s;
        n |= node->y <= v->n;
    }
    return w && east && s && n;
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
 */
static double class_alpha(const struct page *page, int32_t class, enum mesh_fill fill)
{
    if (fill != FILL_REGION)
        return 1;
    if (!page->has_ground)
        return 1;
    return class > 0 ? 0.7 : 0.25;
}

/* Returns how many elements of the class lie in the window. */
static int64_t fill_class(struct page *page, const struct hm_mesh *m, const int32_t *class,
                          int32_t wanted, enum mesh_fill fill)
{
    set_colour(page, class_colour(wanted, fill), class_alpha(page, wanted, fill));
    int64_t count = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        if (class[k] != wanted || !is_visible(&page->view, m, &m->elem[k]))
            continue;
        element_path(page, m, &m->elem[k]);
        if (++count % PIECE == 0)
            cairo_fill(page->cr);
    }
    cairo_fill(page->cr);
    return count;
}

static void enter_class(struct page *page, const struct hm_mesh *m, int32_t class, int64_t count,
                        enum mesh_fill fill, bool owned)
{
    char name[NAME];
    struct rgb colour = class_colour(class, fill);
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
            enter_class(page, m, (int32_t)next, count, fill, owned);
        last = next;
    }
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_DEFAULT);
}

/* --- wires --- */

enum stress { WIRE, SEAM, BORDER };

static enum stress stress_of(const struct hm_mesh_edge *e, const int32_t *class,
                             enum mesh_fill fill)
{
    if (e->right < 0)
        return BORDER;
    return fill == FILL_REGION && class[e->left] != class[e->right] ? SEAM : WIRE;
}

static void stroke_edges(struct page *page, const struct hm_mesh *m,
                         const struct hm_mesh_edge *edges, size_t n, const int32_t *class,
                         enum mesh_fill fill, enum stress stress)
{
    const struct view *v = &page->view;
    int pending = 0;
    for (size_t k = 0; k < n; k++) {
        const struct hm_node *a = &m->node[edges[k].a], *b = &m->node[edges[k].b];
        if (stress_of(&edges[k], class, fill) != stress || fmax(a->x, b->x) < v->w ||
            fmin(a->x, b->x) > v->e || fmax(a->y, b->y) < v->s || fmin(a->y, b->y) > v->n)
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

/* Mean length of an edge on the page. */
static double mean_edge(const struct page *page, const struct hm_mesh *m,
                        const struct hm_mesh_edge *edges, size_t n)
{
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += hypot(m->node[edges[k].b].x - m->node[edges[k].a].x,
                     m->node[edges[k].b].y - m->node[edges[k].a].y);
    return n ? sum / (double)n * page->view.scale : 0;
}

static enum hm_err draw_wires(struct page *page, const struct hm_mesh *m, const int32_t *class,
                              enum mesh_fill fill, struct hm_diag *d)
{
    struct hm_mesh_edge *edges;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edges, &n, d);
    if (err)
        return err;
    /* fine meshes get finer and fainter wires, so that they do not turn black */
    const double length = mean_edge(page, m, edges, n), em = page->em;
    const double width = fmin(0.05 * em, fmax(0.25, 0.06 * length));
    set_colour(page, INK, fmin(0.75, fmax(0.15, length / 16)));
    cairo_set_line_width(page->cr, width);
    cairo_set_antialias(page->cr, length < 2 ? CAIRO_ANTIALIAS_FAST : CAIRO_ANTIALIAS_DEFAULT);
    stroke_edges(page, m, edges, n, class, fill, WIRE);
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_DEFAULT);
    set_colour(page, ROUGH, 0.9);
    cairo_set_line_width(page->cr, fmax(2 * width, 0.05 * em));
    stroke_edges(page, m, edges, n, class, fill, SEAM);
    set_colour(page, INK, 1);
    cairo_set_line_width(page->cr, fmax(2 * width, 0.08 * em));
    stroke_edges(page, m, edges, n, class, fill, BORDER);
    free(edges);
    return HM_OK;
}

static int64_t count_visible(const struct page *page, const struct hm_mesh *m)
{
    int64_t count = 0;
    for (size_t k = 0; k < m->nelems; k++)
        count += is_visible(&page->view, m, &m->elem[k]);
    return count;
}

enum hm_err draw_mesh(struct page *page, const struct hm_mesh *m, enum mesh_fill fill,
                      struct range heights, struct hm_diag *d)
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
        legend_add(page, MARK_LINE, INK, count_visible(page, m), "Elements");
    if (fill == FILL_Z)
        legend_bar(page, RAMP_HEIGHT, heights, "Height (m)");
    enum hm_err err = draw_wires(page, m, class, fill, d);
    free(class);
    page->has_ground |= fill != FILL_WIRE;
    return err;
}
