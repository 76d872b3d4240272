/* The window: what of the data lies in it. */
#include "draw.h"

bool view_holds(const struct view *v, double x, double y)
{
    return x >= v->w && x <= v->e && y >= v->s && y <= v->n;
}

bool view_meets(const struct view *v, const struct hm_mesh *m, const struct hm_elem *e)
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

size_t view_points(const struct view *v, const struct hm_points *p)
{
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++)
        n += view_holds(v, p->v[i * p->stride], p->v[i * p->stride + 1]);
    return n;
}

size_t view_elements(const struct view *v, const struct hm_mesh *m)
{
    size_t n = 0;
    for (size_t k = 0; k < m->nelems; k++)
        n += view_meets(v, m, &m->elem[k]);
    return n;
}
