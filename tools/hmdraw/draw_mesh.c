/* Meshes: elements filled by their classes under thin wires; the seams between materials a little
 * stronger, the boundary thick. */
#include "draw.h"

#include "hm_elem.h"
#include "hm_meshedges.h"

#include <math.h>
#include <stdlib.h>

/* Paths are painted in pieces of so many elements or edges: cairo is slow on endless ones. */
enum { PIECE = 2000 };

/* --- fills: classes are painted one after the other --- */

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

/* Heights and qualities are opaque; materials are a tint, through which the ground shows. Where it
 * has a relief the tint may cover its colours almost: light and shade fall on it again. */
static double class_alpha(const struct page *page, const struct class *class, enum mesh_fill fill)
{
    if (fill != FILL_MATERIAL || !page->has_ground)
        return 1;
    return class->backdrop ? 0.25 : page->relief.surface ? 0.85 : 0.7;
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
static int64_t fill_class(struct page *page, const struct hm_mesh *m, const struct classes *classes,
                          int32_t wanted, double alpha)
{
    const struct rgb colour = classes->list[wanted].colour;
    int64_t count = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        if (classes->of[k] != wanted || !view_meets(&page->view, m, &m->elem[k]))
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
                               const struct classes *classes, int32_t wanted)
{
    struct rgb mean = PAPER;
    double whole = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        const struct hm_node *a = &m->node[e->node[0]], *b = &m->node[e->node[2]];
        double area = fabs(hm_elem_area(m, e)), x = (a->x + b->x) / 2, y = (a->y + b->y) / 2;
        if (classes->of[k] == wanted && area > 0 && view_holds(&page->view, x, y))
            mean = blend(page_ground(page, x, y), area / (whole += area), mean);
    }
    return mean;
}

/* Paint every class in turn, and enter it in the legend as it looks over the ground. */
static void fill_elements(struct page *page, const struct hm_mesh *m, const struct classes *classes,
                          enum mesh_fill fill)
{
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_NONE);
    for (int32_t k = 0; k < (int32_t)classes->n; k++) {
        const struct class *class = &classes->list[k];
        const double alpha = class_alpha(page, class, fill);
        int64_t count = fill_class(page, m, classes, k, alpha);
        if (!count || !*class->text)
            continue;
        struct rgb colour = class->colour;
        if (alpha < 1)
            colour = blend(colour, alpha, ground_under(page, m, classes, k));
        legend_add(page, MARK_FILL, colour, count, "%s", class->text);
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
                              const struct hm_mesh_edge *e, const int32_t *material)
{
    if (e->right < 0)
        return BORDER;
    if (material && material[e->left] != material[e->right])
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

/* `material`, where it is not NULL, tells the parts between which seams run. */
static enum hm_err draw_edges(struct page *page, const struct hm_mesh *m, const int32_t *material,
                              struct hm_diag *d)
{
    struct hm_mesh_edge *edges;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edges, &n, d);
    if (err)
        return err;
    unsigned char *grade = hm_alloc(n, sizeof *grade);
    for (size_t k = 0; k < n && grade; k++)
        grade[k] = grade_of(page, m, &edges[k], material);
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
    struct classes classes = {0};
    enum hm_err err = fill == FILL_WIRE ? HM_OK : classify(&classes, m, fill, heights, d);
    if (err)
        return err;
    fill_elements(page, m, &classes, fill);
    if (fill != FILL_MATERIAL)
        legend_add(page, MARK_LINE, INK, (int64_t)view_elements(&page->view, m), "Elements");
    if (fill == FILL_Z)
        legend_bar(page, RAMP_HEIGHT, heights);
    err = draw_edges(page, m, fill == FILL_MATERIAL ? classes.of : NULL, d);
    classes_free(&classes);
    page->has_ground |= fill != FILL_WIRE;
    return err;
}
