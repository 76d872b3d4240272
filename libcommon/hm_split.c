#include "hm_split.h"

#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

/* Does the diagonal from corner k leave both triangles counter-clockwise? */
static bool is_inside(const struct hm_mesh *m, const struct hm_elem *e, int k)
{
    const double *p[4];
    for (int i = 0; i < 4; i++)
        p[i] = hm_mesh_xy(m, e->node[(k + i) % 4]);
    return hm_area2(p[0], p[1], p[2]) > 0 && hm_area2(p[0], p[2], p[3]) > 0;
}

static double length(const struct hm_mesh *m, const struct hm_elem *e, int k)
{
    const double *p = hm_mesh_xy(m, e->node[k]), *q = hm_mesh_xy(m, e->node[k + 2]);
    return hypot(q[0] - p[0], q[1] - p[1]);
}

/* The corner, 0 or 1, that the diagonal begins at. */
static int choose(const struct hm_mesh *m, const struct hm_elem *e)
{
    bool inside[2] = {is_inside(m, e, 0), is_inside(m, e, 1)};
    if (inside[0] != inside[1])
        return inside[1];
    return length(m, e, 1) < length(m, e, 0);
}

enum hm_err hm_split_quads(struct hm_mesh *m, int64_t *count, struct hm_diag *d)
{
    size_t quads = 0, n = 0;
    for (size_t k = 0; k < m->nelems; k++)
        quads += hm_elem_corners(&m->elem[k]) == 4;
    *count = (int64_t)quads;
    if (quads == 0)
        return HM_OK;
    struct hm_elem *elem = hm_alloc(m->nelems + quads, sizeof *elem);
    if (!elem)
        return hm_fail_memory(d);
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        if (hm_elem_corners(e) == 3) {
            elem[n++] = *e;
            continue;
        }
        const int32_t *v = e->node;
        int c = choose(m, e);
        elem[n++] = (struct hm_elem){{v[c], v[c + 1], v[c + 2], -1}, e->region};
        elem[n++] = (struct hm_elem){{v[c], v[c + 2], v[(c + 3) % 4], -1}, e->region};
    }
    free(m->elem);
    m->elem = elem;
    m->nelems = n;
    m->elem_cap = n;
    return HM_OK;
}
