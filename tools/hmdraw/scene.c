/* The scene: meshes put together, and what lies on them. */
#include "scene.h"

#include "hm_locate.h"
#include "hm_meshedges.h"
#include "hm_residual.h"
#include "hm_role.h"
#include "hm_strings.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* --- meshes --- */

/* Room for the numbers of what a mesh may add. */
static enum hm_err grow_numbers(struct scene *s, const struct hm_mesh *m, struct hm_diag *d)
{
    int32_t *nodes = realloc(s->node_number, (s->mesh.nnodes + m->nnodes + 1) * sizeof *nodes);
    if (nodes)
        s->node_number = nodes;
    int32_t *elems = realloc(s->elem_number, (s->mesh.nelems + m->nelems + 1) * sizeof *elems);
    if (elems)
        s->elem_number = elems;
    struct scene_part *parts = realloc(s->part, (s->nparts + 1) * sizeof *parts);
    if (parts)
        s->part = parts;
    return nodes && elems && parts ? HM_OK : hm_fail_memory(d);
}

/* Nodes keep their order, so that neighbours in the stream stay neighbours: number[k] is that of
 * node k in the scene, -1 when no element in the window has it. */
static enum hm_err add_nodes(struct scene *s, const struct hm_mesh *m, const struct view *v,
                             int32_t *number, struct hm_diag *d)
{
    for (size_t k = 0; k < m->nnodes; k++)
        number[k] = -1;
    for (size_t k = 0; k < m->nelems; k++)
        for (int i = 0; i < hm_elem_corners(&m->elem[k]) && view_meets(v, m, &m->elem[k]); i++)
            number[m->elem[k].node[i]] = 0;
    for (size_t k = 0; k < m->nnodes; k++) {
        if (number[k] < 0)
            continue;
        number[k] = (int32_t)s->mesh.nnodes;
        s->node_number[s->mesh.nnodes] = (int32_t)k;
        enum hm_err err = hm_mesh_add_node(&s->mesh, m->node[k], d);
        if (err)
            return err;
        s->part[s->nparts].nodes++;
    }
    return HM_OK;
}

static enum hm_err add_elements(struct scene *s, const struct hm_mesh *m, const struct view *v,
                                const int32_t *number, struct hm_diag *d)
{
    for (size_t k = 0; k < m->nelems; k++) {
        if (!view_meets(v, m, &m->elem[k]))
            continue;
        struct hm_elem e = m->elem[k];
        for (int i = 0; i < hm_elem_corners(&m->elem[k]); i++)
            e.node[i] = number[e.node[i]];
        s->elem_number[s->mesh.nelems] = (int32_t)k;
        enum hm_err err = hm_mesh_add_elem(&s->mesh, e, d);
        if (err)
            return err;
        s->part[s->nparts].elems++;
    }
    return HM_OK;
}

enum hm_err scene_add_mesh(struct scene *s, const struct view *v, const struct hm_mesh *m,
                           struct hm_diag *d)
{
    enum hm_err err = grow_numbers(s, m, d);
    if (err)
        return err;
    int32_t *number = hm_alloc(m->nnodes, sizeof *number);
    if (!number)
        return hm_fail_memory(d);
    s->part[s->nparts] = (struct scene_part){.from = m};
    err = add_nodes(s, m, v, number, d);
    if (!err)
        err = add_elements(s, m, v, number, d);
    s->nparts++;
    free(number);
    return err;
}

void scene_free(struct scene *s)
{
    for (int k = 0; k < s->ncolourings; k++)
        classes_free(&s->colouring[k].classes);
    hm_mesh_free(&s->mesh);
    free(s->node_number);
    free(s->elem_number);
    free(s->part);
    free(s->residual);
    free(s->vertices.byte);
    *s = (struct scene){0};
}

/* --- place --- */

/* A power of ten that divides `size` into a thousand million steps at most: a millimetre where that
 * is fine enough, a ten thousandth of the size where the mesh is a small one. */
static double step_of(double size)
{
    double step = pow(10, ceil(log10(fmax(size, 1e-300) * 1e-4)));
    if (step <= 1e-3)
        return fmax(step, 1e-9);
    return fmax(1e-3, pow(10, ceil(log10(size * 1e-9))));
}

enum hm_err scene_place(struct scene *s, struct hm_diag *d)
{
    double most[3];
    for (int c = 0; c < 3; c++) {
        s->origin[c] = INFINITY;
        most[c] = -INFINITY;
    }
    for (size_t k = 0; k < s->mesh.nnodes; k++) {
        const struct hm_node *node = &s->mesh.node[k];
        const double place[3] = {node->x, node->y, node->z};
        if (isnan(node->z))
            return hm_fail_at(d, HM_EGEOM, node->x, node->y,
                              "a node without height, which a 3D view cannot place");
        for (int c = 0; c < 3; c++) {
            s->origin[c] = fmin(s->origin[c], place[c]);
            most[c] = fmax(most[c], place[c]);
        }
    }
    for (int c = 0; c < 3; c++) {
        s->size[c] = most[c] - s->origin[c];
        if (!isfinite(s->size[c]))
            return hm_fail(d, HM_EGEOM, "heights too far apart to show");
        s->step[c] = step_of(s->size[c]);
        s->origin[c] = floor(s->origin[c] / s->step[c]) * s->step[c];
    }
    return HM_OK;
}

/* --- lines --- */

/* Lines far outside the mesh are of no use, and their numbers might not fit. */
static bool is_near(const struct scene *s, const double place[3])
{
    const double room = fmax(fmax(s->size[0], s->size[1]), s->size[2]);
    for (int c = 0; c < 3; c++)
        if (!(place[c] >= s->origin[c] - room && place[c] <= s->origin[c] + 2 * room))
            return false;
    return true;
}

static void add_line(struct scene *s, int kind, const double *xyz, size_t n)
{
    s->lines[kind]++;
    encode_unsigned(&s->vertices, n);
    for (size_t i = 0; i < 3 * n; i++) {
        const int c = (int)(i % 3);
        int64_t step = (int64_t)round((xyz[i] - s->origin[c]) / s->step[c]);
        encode_signed(&s->vertices, step - s->last[c]);
        s->last[c] = step;
    }
}

static void add_piece(struct scene *s, int kind, const double a[3], const double b[3])
{
    const double xyz[6] = {a[0], a[1], a[2], b[0], b[1], b[2]};
    if (is_near(s, a) && is_near(s, b))
        add_line(s, kind, xyz, 2);
}

int64_t scene_add_breaklines(struct scene *s, const struct hm_lines *l)
{
    int64_t others = 0;
    for (size_t k = 0; k < l->n; k++) {
        const struct hm_line *line = &l->line[k];
        if (hm_role_of(line->attrs) != HM_ROLE_BREAKLINE) {
            others++;
            continue;
        }
        size_t from = 0;
        for (size_t i = 0; i <= line->n; i++) {
            if (i < line->n && is_near(s, &line->xyz[3 * i]))
                continue;
            if (i - from > 1)
                add_line(s, SCENE_BREAKLINES, &line->xyz[3 * from], i - from);
            from = i + 1;
        }
        if (line->closed && line->n > 1)
            add_piece(s, SCENE_BREAKLINES, &line->xyz[3 * (line->n - 1)], line->xyz);
    }
    return others;
}

/* x, y, z of a node. */
static const double *place_of(const struct hm_mesh *m, int32_t node)
{
    _Static_assert(offsetof(struct hm_node, z) == 2 * sizeof(double), "z lies behind x and y");
    return hm_mesh_xy(m, node);
}

static enum hm_err add_strings(struct scene *s, const struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_strings strings = {0};
    enum hm_err err = hm_strings_read(&strings, m, d);
    for (size_t k = 0; k < strings.n && !err; k++) {
        const struct hm_string *string = &strings.string[k];
        for (size_t i = 0; i + 1 < string->n; i++)
            add_piece(s, SCENE_STRINGS, place_of(m, string->node[i]),
                      place_of(m, string->node[i + 1]));
    }
    hm_strings_free(&strings);
    return err;
}

enum hm_err scene_add_borders(struct scene *s, struct hm_diag *d)
{
    struct hm_mesh_edge *edges;
    size_t n;
    enum hm_err err = hm_mesh_edges(&s->mesh, &edges, &n, d);
    if (err)
        return err;
    for (size_t k = 0; k < n; k++)
        if (edges[k].right < 0)
            add_piece(s, SCENE_BOUNDARY, place_of(&s->mesh, edges[k].a),
                      place_of(&s->mesh, edges[k].b));
    free(edges);
    for (size_t p = 0; p < s->nparts && !err; p++)
        err = add_strings(s, s->part[p].from, d);
    return err;
}

/* --- residuals --- */

enum hm_err scene_add_residuals(struct scene *s, const struct hm_points *p, struct hm_diag *d)
{
    const int column = hm_header_field(&p->header, "residual");
    struct hm_locate *index;
    enum hm_err err = hm_locate_build(&index, &s->mesh, d);
    if (err)
        return err;
    residual_limits(&p->header, s->residual_limits);
    if (!s->residual)
        s->residual = hm_alloc0(s->mesh.nelems, sizeof *s->residual);
    for (size_t i = 0; i < p->n && s->residual; i++) {
        const double *row = &p->v[i * p->stride], r = row[column];
        int64_t k = isfinite(r) ? hm_locate_element(index, row[0], row[1]) : -1;
        if (k < 0)
            continue;
        struct scene_residual *of = &s->residual[k];
        of->n++;
        of->sum2 += r * r;
        if (fabs(r) > fabs(of->worst))
            of->worst = r;
    }
    hm_locate_free(index);
    return s->residual ? HM_OK : hm_fail_memory(d);
}

/* --- colours --- */

/* Put a class at the end of a list, unless one of that name and colour is there; its number. */
static int32_t enter_class(struct classes *list, const struct class *class)
{
    for (size_t k = 0; k < list->n; k++)
        if (!strcmp(list->list[k].text, class->text) &&
            !memcmp(&list->list[k].colour, &class->colour, sizeof class->colour))
            return (int32_t)k;
    list->list[list->n] = *class;
    return (int32_t)list->n++;
}

/* The classes of one part behind those that are there already, for elements from `first` on. */
static enum hm_err join_classes(struct classes *all, const struct classes *own,
                                const struct scene *s, size_t first, size_t n, struct hm_diag *d)
{
    struct class *list = realloc(all->list, (all->n + own->n + 1) * sizeof *list);
    int32_t *to = hm_alloc(own->n, sizeof *to);
    if (list)
        all->list = list;
    for (size_t k = 0; k < own->n && list && to; k++)
        to[k] = enter_class(all, &own->list[k]);
    for (size_t k = first; k < first + n && list && to; k++)
        all->of[k] = to[own->of[s->elem_number[k]]];
    free(to);
    return list && to ? HM_OK : hm_fail_memory(d);
}

static enum hm_err colour_by(struct scene *s, const char *title, enum mesh_fill fill,
                             struct hm_diag *d)
{
    struct colouring *colouring = &s->colouring[s->ncolourings++];
    colouring->title = title;
    colouring->classes.of = hm_alloc(s->mesh.nelems, sizeof *colouring->classes.of);
    enum hm_err err = colouring->classes.of ? HM_OK : hm_fail_memory(d);
    size_t first = 0;
    for (size_t p = 0; p < s->nparts && !err; p++) {
        struct classes own;
        err = classify(&own, s->part[p].from, fill, NULL, d);
        if (err)
            break;
        err = join_classes(&colouring->classes, &own, s, first, s->part[p].elems, d);
        first += s->part[p].elems;
        classes_free(&own);
    }
    return err;
}

/* By the root mean square of the residuals in an element. */
static enum hm_err colour_by_residual(struct scene *s, struct hm_diag *d)
{
    struct colouring *colouring = &s->colouring[s->ncolourings++];
    struct classes *classes = &colouring->classes;
    colouring->title = "Residual";
    classes->of = hm_alloc0(s->mesh.nelems, sizeof *classes->of);
    classes->list = hm_alloc0(RESIDUAL_CLASSES, sizeof *classes->list);
    if (!classes->of || !classes->list)
        return hm_fail_memory(d);
    classes->n = RESIDUAL_CLASSES;
    for (int k = 0; k < RESIDUAL_CLASSES; k++)
        classes->list[k] = residual_class(residual_order[k], s->residual_limits);
    for (size_t k = 0; k < s->mesh.nelems; k++) {
        const struct scene_residual *r = &s->residual[k];
        double rms = r->n ? sqrt(r->sum2 / (double)r->n) : NAN;
        enum hm_residual_class class = hm_residual_classify(rms, s->residual_limits);
        while (residual_order[classes->of[k]] != class)
            classes->of[k]++;
    }
    return HM_OK;
}

enum hm_err scene_add_colourings(struct scene *s, struct hm_diag *d)
{
    enum hm_err err = colour_by(s, "Material", FILL_MATERIAL, d);
    if (!err)
        err = colour_by(s, "Smallest angle", FILL_QUALITY, d);
    return err || !s->residual ? err : colour_by_residual(s, d);
}
