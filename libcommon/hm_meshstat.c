#include "hm_meshstat.h"

#include "hm_elem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double GRAVITY = 9.81;

const struct hm_measure_kind hm_shape_kind[HM_SHAPES] = {
    [HM_SHAPE_LEAST_ANGLE] = {"smallest angle",
                              "deg",
                              true,
                              {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85,
                               90},
                              18},
    [HM_SHAPE_MOST_ANGLE] = {"largest angle",
                             "deg",
                             false,
                             {60, 70, 80, 90, 100, 110, 120, 130, 140, 150, 160, 170, 180},
                             12},
    [HM_SHAPE_EDGE_RATIO] =
        {"edge ratio", "", false, {1, 1.5, 2, 3, 4, 6, 10, 20, 50, INFINITY}, 9},
    [HM_SHAPE_AREA] = {"area",
                       "m2",
                       true,
                       {0,   0.1, 0.2, 0.5,  1,    2,    5,     10,    20,    50,      100,
                        200, 500, 1e3, 2000, 5000, 10e3, 20000, 50000, 100e3, INFINITY},
                       20},
    [HM_SHAPE_SLOPE] = {"bed slope", "deg", false, {0, 1, 2, 5, 10, 20, 30, 45, 60, 90}, 9},
    [HM_SHAPE_AREA_RATIO] =
        {"area ratio", "", false, {1, 1.2, 1.5, 2, 3, 4, 6, 10, 20, INFINITY}, 9},
    [HM_SHAPE_ORTHOGONALITY] =
        {"off orthogonal", "deg", false, {0, 5, 10, 20, 30, 45, 60, 70, 90}, 8},
    [HM_SHAPE_DEGREE] = {"elements at a node",
                         "",
                         false,
                         {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, INFINITY},
                         13},
    [HM_SHAPE_TIME_STEP] = {"time step",
                            "s",
                            true,
                            {0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, INFINITY},
                            13}};

const char *hm_mesh_warning_name(enum hm_mesh_warning warning)
{
    static const char *const name[HM_WARNINGS] = {
        [HM_WARN_TRIANGLE_SHARP] = "triangle with an angle under 10 degrees",
        [HM_WARN_TRIANGLE_BLUNT] = "triangle with an angle over 150 degrees",
        [HM_WARN_QUAD_SHARP] = "quadrilateral with an angle under 30 degrees",
        [HM_WARN_QUAD_BLUNT] = "quadrilateral with an angle over 150 degrees",
        [HM_WARN_AREA_RATIO] = "neighbours of area ratio over 2",
        [HM_WARN_FEW_ELEMENTS] = "inner node of fewer than 4 elements",
        [HM_WARN_MANY_ELEMENTS] = "inner node of more than 10 elements",
        [HM_WARN_ALL_BOUNDARY] = "triangle with all nodes on the boundary",
        [HM_WARN_STEEP] = "element steeper than 45 degrees",
        [HM_WARN_ORTHOGONALITY] = "edge over 70 degrees off orthogonal"};
    return name[warning];
}

int64_t hm_meshpart_warnings(const struct hm_meshpart *p)
{
    int64_t sum = 0;
    for (int k = 0; k < HM_WARNINGS; k++)
        sum += p->warning[k];
    return sum;
}

/* --- parts --- */

/* What one element, edge or node adds to: the whole, and a part or NULL. */
struct targets {
    struct hm_meshpart *part[2];
};

static void measure(struct targets t, enum hm_shape shape, double value, const double *at)
{
    for (int k = 0; k < 2 && t.part[k]; k++)
        hm_measure_add(&t.part[k]->shape[shape], &hm_shape_kind[shape], value, at[0], at[1]);
}

static void warn_if(bool bad, struct targets t, enum hm_mesh_warning warning, const double *at)
{
    for (int k = 0; bad && k < 2 && t.part[k]; k++)
        if (t.part[k]->warning[warning]++ == 0)
            memcpy(t.part[k]->place[warning], at, 2 * sizeof *at);
}

/* Where the part of a region stands, or would. */
static size_t place_of(const struct hm_meshstat *s, int32_t region)
{
    size_t low = 0, high = s->nparts;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (s->part[middle].region < region)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static enum hm_err make_parts(struct hm_meshstat *s, const struct hm_mesh *m, struct hm_diag *d)
{
    size_t cap = 0;
    for (size_t i = 0; i < m->nelems; i++) {
        int32_t region = m->elem[i].region;
        size_t k = i > 0 && region == m->elem[i - 1].region ? 0 : place_of(s, region);
        if ((i > 0 && region == m->elem[i - 1].region) ||
            (k < s->nparts && s->part[k].region == region))
            continue;
        if (!hm_grow(&s->part, &cap, s->nparts + 1, sizeof *s->part))
            return hm_fail_memory(d);
        memmove(&s->part[k + 1], &s->part[k], (s->nparts++ - k) * sizeof *s->part);
        s->part[k] = (struct hm_meshpart){.region = region};
    }
    return HM_OK;
}

static struct targets targets_of(struct hm_meshstat *s, int32_t region)
{
    return (struct targets){{&s->whole, &s->part[place_of(s, region)]}};
}

/* --- elements --- */

/* The bed's slope in degrees from the vector product of the diagonals, or of two edges. */
static double slope_of(const struct hm_mesh *m, const struct hm_elem *e, double z_scale)
{
    bool quad = hm_elem_corners(e) == 4;
    const struct hm_node *a = &m->node[e->node[0]], *b = &m->node[e->node[1]],
                         *c = &m->node[e->node[2]], *f = quad ? &m->node[e->node[3]] : a;
    const struct hm_node *from = quad ? b : a, *to = quad ? f : b;
    double u[3] = {to->x - from->x, to->y - from->y, (to->z - from->z) * z_scale};
    double v[3] = {c->x - a->x, c->y - a->y, (c->z - a->z) * z_scale};
    double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2];
    double z = u[0] * v[1] - u[1] * v[0];
    return atan2(hypot(x, y), fabs(z)) * 180 / acos(-1);
}

/* Seconds that the fastest wave needs through the smallest height of an element: the area of the
 * parallelogram, or quadrilateral, over its longest edge. */
static double time_step(double area, int corners, double longest, const struct hm_meshstat_want *w)
{
    double height = (corners == 3 ? 2 : 1) * area / longest * w->metres;
    return height / (w->velocity + sqrt(GRAVITY * w->depth));
}

static double longest_edge(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2], longest = 0;
    int n = hm_elem_xy(m, e, p);
    for (int i = 0; i < n; i++) {
        const double *a = p[i], *b = p[(i + 1) % n];
        longest = fmax(longest, hypot(b[0] - a[0], b[1] - a[1]));
    }
    return longest;
}

static void count_element(struct targets t, int corners, double area, bool faulty)
{
    for (int k = 0; k < 2; k++) {
        t.part[k]->triangles += corners == 3;
        t.part[k]->quads += corners == 4;
        t.part[k]->area += area;
        t.part[k]->faults += faulty;
    }
}

static void add_element(struct hm_meshstat *s, const struct hm_mesh *m, const struct hm_elem *e,
                        const bool *border, const struct hm_meshstat_want *w)
{
    double at[2], least, most, area = hm_elem_area(m, e);
    const int corners = hm_elem_corners(e);
    const int32_t *n = e->node;
    struct targets t = targets_of(s, e->region);
    hm_elem_centre(m, e, at);
    hm_elem_angles(m, e, &least, &most);
    double slope = slope_of(m, e, w->z_metres / w->metres);
    count_element(t, corners, area * w->metres * w->metres, !hm_elem_is_convex(m, e));
    measure(t, HM_SHAPE_LEAST_ANGLE, least, at);
    measure(t, HM_SHAPE_MOST_ANGLE, most, at);
    measure(t, HM_SHAPE_EDGE_RATIO, hm_elem_edge_ratio(m, e), at);
    measure(t, HM_SHAPE_AREA, area * w->metres * w->metres, at);
    measure(t, HM_SHAPE_SLOPE, slope, at);
    if (w->depth > 0)
        measure(t, HM_SHAPE_TIME_STEP, time_step(area, corners, longest_edge(m, e), w), at);
    warn_if(corners == 3 && least < 10, t, HM_WARN_TRIANGLE_SHARP, at);
    warn_if(corners == 3 && most > 150, t, HM_WARN_TRIANGLE_BLUNT, at);
    warn_if(corners == 4 && least < 30, t, HM_WARN_QUAD_SHARP, at);
    warn_if(corners == 4 && most > 150, t, HM_WARN_QUAD_BLUNT, at);
    warn_if(slope > 45, t, HM_WARN_STEEP, at);
    warn_if(corners == 3 && border[n[0]] && border[n[1]] && border[n[2]], t, HM_WARN_ALL_BOUNDARY,
            at);
}

/* --- edges and nodes --- */

static double off_orthogonal(const double *a, const double *b, const double *left,
                             const double *right)
{
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = right[0] - left[0], vy = right[1] - left[1];
    return atan2(fabs(ux * vx + uy * vy), fabs(ux * vy - uy * vx)) * 180 / acos(-1);
}

static void add_edge(struct hm_meshstat *s, const struct hm_mesh *m, const struct hm_mesh_edge *e)
{
    const struct hm_elem *left = &m->elem[e->left], *right = &m->elem[e->right];
    const double *a = hm_mesh_xy(m, e->a), *b = hm_mesh_xy(m, e->b);
    double x[2], y[2], at[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    struct targets t = {{&s->whole, NULL}};
    if (left->region == right->region)
        t = targets_of(s, left->region);
    hm_elem_centre(m, left, x);
    hm_elem_centre(m, right, y);
    double here = fabs(hm_elem_area(m, left)), there = fabs(hm_elem_area(m, right));
    double ratio = fmax(here, there) / fmin(here, there), off = off_orthogonal(a, b, x, y);
    measure(t, HM_SHAPE_AREA_RATIO, ratio, at);
    measure(t, HM_SHAPE_ORTHOGONALITY, off, at);
    warn_if(ratio > 2, t, HM_WARN_AREA_RATIO, at);
    warn_if(off > 70, t, HM_WARN_ORTHOGONALITY, at);
}

static void add_nodes(struct hm_meshstat *s, const struct hm_mesh *m, const bool *border,
                      const int32_t *elements)
{
    struct targets t = {{&s->whole, NULL}};
    for (size_t i = 0; i < m->nnodes; i++) {
        if (border[i] || elements[i] == 0)
            continue;
        const double *at = hm_mesh_xy(m, (int32_t)i);
        measure(t, HM_SHAPE_DEGREE, elements[i], at);
        warn_if(elements[i] < 4, t, HM_WARN_FEW_ELEMENTS, at);
        warn_if(elements[i] > 10, t, HM_WARN_MANY_ELEMENTS, at);
    }
}

static void add_all(struct hm_meshstat *s, const struct hm_mesh *m, const struct hm_mesh_edge *edge,
                    size_t nedges, const struct hm_meshstat_want *want, bool *border,
                    int32_t *elements)
{
    for (size_t k = 0; k < nedges; k++)
        if (edge[k].right < 0)
            border[edge[k].a] = border[edge[k].b] = true;
    for (size_t k = 0; k < m->nelems; k++) {
        add_element(s, m, &m->elem[k], border, want);
        for (int c = 0; c < hm_elem_corners(&m->elem[k]); c++)
            elements[m->elem[k].node[c]]++;
    }
    for (size_t k = 0; k < nedges; k++)
        if (edge[k].right >= 0)
            add_edge(s, m, &edge[k]);
    add_nodes(s, m, border, elements);
}

enum hm_err hm_meshstat_run(struct hm_meshstat *s, const struct hm_mesh *m,
                            const struct hm_mesh_edge *edge, size_t nedges,
                            const struct hm_meshstat_want *want, struct hm_diag *d)
{
    *s = (struct hm_meshstat){.nodes = m->nnodes};
    bool *border = hm_alloc0(m->nnodes, sizeof *border);
    int32_t *elements = hm_alloc0(m->nnodes, sizeof *elements);
    enum hm_err err = border && elements ? make_parts(s, m, d) : hm_fail_memory(d);
    if (!err)
        add_all(s, m, edge, nedges, want, border, elements);
    else
        hm_meshstat_free(s);
    free(border);
    free(elements);
    return err;
}

void hm_meshstat_free(struct hm_meshstat *s)
{
    free(s->part);
    *s = (struct hm_meshstat){0};
}
