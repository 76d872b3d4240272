#include "hm_tri_topology.h"

#include <stdlib.h>

void hm_tri_free(struct hm_tri *t)
{
    if (!t)
        return;
    free(t->half);
    free(t->marks);
    free(t->region);
    free(t->xy);
    free(t->edge);
    free(t->input);
    free(t->of_input);
    free(t->stack);
    free(t->hole);
    free(t->left.link);
    free(t->right.link);
    free(t);
}

int32_t hm_tri_vertices(const struct hm_tri *t)
{
    return t->vertices;
}

bool hm_tri_is_used(const struct hm_tri *t, int32_t v)
{
    return !t->edge || t->edge[v] != HM_TRI_NONE;
}

const double *hm_tri_xy(const struct hm_tri *t, int32_t v)
{
    return hm_tri_at(t, v);
}

int32_t hm_tri_of_input(const struct hm_tri *t, size_t input)
{
    return t->of_input[input];
}

int64_t hm_tri_input(const struct hm_tri *t, int32_t v)
{
    return t->input[v];
}

size_t hm_tri_duplicates(const struct hm_tri *t)
{
    return t->duplicates;
}

int32_t hm_tri_triangles(const struct hm_tri *t)
{
    return t->triangles;
}

bool hm_tri_is_solid(const struct hm_tri *t, int32_t tri)
{
    return t->half[3 * tri].org != HM_TRI_FREE && !hm_tri_is_ghost(t, tri);
}

int32_t hm_tri_org(const struct hm_tri *t, int32_t e)
{
    return t->half[e].org;
}

int32_t hm_tri_dest(const struct hm_tri *t, int32_t e)
{
    return hm_tri_dest_of(t, e);
}

int32_t hm_tri_apex(const struct hm_tri *t, int32_t e)
{
    return hm_tri_apex_of(t, e);
}

int32_t hm_tri_twin(const struct hm_tri *t, int32_t e)
{
    return t->half[e].twin;
}

int32_t hm_tri_edge_from(const struct hm_tri *t, int32_t v)
{
    return hm_tri_edge_of(t, v);
}

int32_t hm_tri_edge_between(const struct hm_tri *t, int32_t a, int32_t b)
{
    int32_t first = hm_tri_edge_of(t, a), e = first;
    if (first == HM_TRI_NONE)
        return HM_TRI_NONE;
    do {
        if (hm_tri_dest_of(t, e) == b)
            return e;
        e = hm_tri_turn(t, e);
    } while (e != first);
    return HM_TRI_NONE;
}

int32_t hm_tri_marks(const struct hm_tri *t, int32_t e)
{
    return hm_tri_marks_of(t, e);
}

enum hm_err hm_tri_need_edges(struct hm_tri *t, struct hm_diag *d)
{
    if (t->edge)
        return HM_OK;
    t->edge = hm_alloc(t->cap_vertices, sizeof *t->edge);
    if (!t->edge)
        return hm_fail_memory(d);
    const struct hm_tri_half *half = t->half;
    int32_t *edge = t->edge;
    for (int32_t e = 0, n = 3 * t->triangles; e < n; e++)
        if (half[e].org != HM_TRI_INFINITY)
            edge[half[e].org] = e;
    return HM_OK;
}

enum hm_err hm_tri_need_marks(struct hm_tri *t, struct hm_diag *d)
{
    if (!t->marks && !(t->marks = hm_alloc0(3 * t->cap_triangles, sizeof *t->marks)))
        return hm_fail_memory(d);
    return HM_OK;
}

enum hm_err hm_tri_need_regions(struct hm_tri *t, struct hm_diag *d)
{
    if (!t->region && !(t->region = hm_alloc0(t->cap_triangles, sizeof *t->region)))
        return hm_fail_memory(d);
    return HM_OK;
}

/* Grow one of several arrays that share a capacity, to `room` items. */
static bool regrow(void *items, size_t cap, size_t room, size_t size)
{
    return hm_grow(items, &cap, room, size);
}

/* A capacity that holds `need` items, with half as much to spare if `most` allows; 0: it does not
 * allow them at all. */
static size_t room_for(size_t need, size_t most)
{
    if (need > most)
        return 0;
    return need + need / 2 < most ? need + need / 2 : most;
}

enum hm_err hm_tri_need_triangles(struct hm_tri *t, int32_t more, struct hm_diag *d)
{
    size_t need = (size_t)t->triangles + (size_t)more;
    if (need <= t->cap_triangles)
        return HM_OK;
    size_t room = room_for(need, HM_TRI_MOST_TRIANGLES);
    if (room == 0)
        return hm_fail(d, HM_ENOMEM, "too many triangles for one triangulation");
    if (!regrow(&t->half, 3 * t->cap_triangles, 3 * room, sizeof *t->half) ||
        (t->marks && !regrow(&t->marks, 3 * t->cap_triangles, 3 * room, sizeof *t->marks)) ||
        (t->region && !regrow(&t->region, t->cap_triangles, room, sizeof *t->region)))
        return hm_fail_memory(d);
    t->cap_triangles = room;
    return HM_OK;
}

enum hm_err hm_tri_need_vertices(struct hm_tri *t, int32_t more, struct hm_diag *d)
{
    size_t need = (size_t)t->vertices + (size_t)more;
    if (need <= t->cap_vertices)
        return HM_OK;
    size_t room = room_for(need, HM_TRI_MOST_VERTICES);
    if (room == 0)
        return hm_fail(d, HM_ENOMEM, "too many vertices for one triangulation");
    if (!regrow(&t->xy, 2 * t->cap_vertices, 2 * room, sizeof *t->xy) ||
        !regrow(&t->edge, t->cap_vertices, room, sizeof *t->edge) ||
        !regrow(&t->input, t->cap_vertices, room, sizeof *t->input))
        return hm_fail_memory(d);
    t->cap_vertices = room;
    return HM_OK;
}

int32_t hm_tri_take_triangle(struct hm_tri *t)
{
    int32_t tri = t->free;
    if (tri == HM_TRI_NONE)
        tri = t->triangles++;
    else
        t->free = t->half[3 * tri].twin;
    return tri;
}

void hm_tri_give_triangle(struct hm_tri *t, int32_t tri)
{
    t->half[3 * tri] = (struct hm_tri_half){HM_TRI_FREE, t->free};
    t->free = tri;
    if (t->region)
        t->region[tri] = 0;
    for (int32_t e = 3 * tri; t->marks && e < 3 * tri + 3; e++)
        t->marks[e] = 0;
}

int32_t hm_tri_take_vertex(struct hm_tri *t, double x, double y)
{
    int32_t v = t->vertices++;
    t->xy[2 * (size_t)v] = x;
    t->xy[2 * (size_t)v + 1] = y;
    t->input[v] = HM_TRI_NONE;
    t->edge[v] = HM_TRI_NONE;
    return v;
}
