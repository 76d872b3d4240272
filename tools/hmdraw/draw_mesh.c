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

/* The elements of each class, as they come: those of class k are list[start[k]] to before
 * list[start[k + 1]]. */
struct groups {
    int32_t *list;
    size_t *start;
};

static enum hm_err group(struct groups *g, const struct classes *classes, size_t nelems,
                         struct hm_diag *d)
{
    *g = (struct groups){hm_alloc(nelems, sizeof *g->list),
                         hm_alloc0(classes->n + 2, sizeof *g->start)};
    if (!g->list || !g->start)
        return hm_fail_memory(d);
    size_t *end = g->start + 1; /* while they are filled: where class k goes on */
    for (size_t k = 0; k < nelems; k++)
        if (classes->of[k] >= 0)
            end[classes->of[k] + 1]++;
    for (size_t k = 1; k <= classes->n; k++)
        end[k] += end[k - 1];
    for (size_t k = 0; k < nelems; k++)
        if (classes->of[k] >= 0)
            g->list[end[classes->of[k]]++] = (int32_t)k;
    return HM_OK;
}

/* Returns how many elements of a class lie in the window. */
static int64_t fill_class(struct page *page, const struct hm_mesh *m, const int32_t *list, size_t n,
                          struct rgb colour, double alpha)
{
    int64_t count = 0;
    for (size_t k = 0; k < n; k++) {
        const struct hm_elem *e = &m->elem[list[k]];
        if (!view_meets(&page->view, m, e))
            continue;
        element_path(page, m, e);
        if (++count % PIECE == 0)
            fill_path(page, colour, alpha);
    }
    fill_path(page, colour, alpha);
    return count;
}

/* The mean colour of the ground under some elements, by their area in the window. */
static struct rgb ground_under(const struct page *page, const struct hm_mesh *m,
                               const int32_t *list, size_t n)
{
    struct rgb mean = PAPER;
    double whole = 0;
    for (size_t k = 0; k < n; k++) {
        const struct hm_elem *e = &m->elem[list[k]];
        const struct hm_node *a = &m->node[e->node[0]], *b = &m->node[e->node[2]];
        double area = fabs(hm_elem_area(m, e)), x = (a->x + b->x) / 2, y = (a->y + b->y) / 2;
        if (area > 0 && view_holds(&page->view, x, y))
            mean = blend(page_ground(page, x, y), area / (whole += area), mean);
    }
    return mean;
}

/* Paint every class in turn, and enter it in the legend as it looks over the ground. */
static enum hm_err fill_elements(struct page *page, const struct hm_mesh *m,
                                 const struct classes *classes, enum mesh_fill fill,
                                 struct hm_diag *d)
{
    struct groups g;
    enum hm_err err = group(&g, classes, m->nelems, d);
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_NONE);
    for (size_t k = 0; k < classes->n && !err; k++) {
        const struct class *class = &classes->list[k];
        const double alpha = class_alpha(page, class, fill);
        const int32_t *list = &g.list[g.start[k]];
        const size_t n = g.start[k + 1] - g.start[k];
        int64_t count = fill_class(page, m, list, n, class->colour, alpha);
        if (!count || !*class->text)
            continue;
        struct rgb colour = class->colour;
        if (alpha < 1)
            colour = blend(colour, alpha, ground_under(page, m, list, n));
        legend_add(page, MARK_FILL, colour, count, "%s", class->text);
    }
    cairo_set_antialias(page->cr, CAIRO_ANTIALIAS_DEFAULT);
    free(g.list);
    free(g.start);
    return err;
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
    if (fill == FILL_QUALITY)
        legend_add(page, MARK_NONE, INK, -1, "Smallest angle");
    if (!err && classes.n)
        err = fill_elements(page, m, &classes, fill, d);
    if (fill != FILL_MATERIAL)
        legend_add(page, MARK_LINE, INK, (int64_t)view_elements(&page->view, m), "Elements");
    if (fill == FILL_Z)
        legend_bar(page, RAMP_HEIGHT, heights);
    if (!err)
        err = draw_edges(page, m, fill == FILL_MATERIAL ? classes.of : NULL, d);
    classes_free(&classes);
    page->has_ground |= fill != FILL_WIRE;
    return err;
}
