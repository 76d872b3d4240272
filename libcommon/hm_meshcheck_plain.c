/* When all elements are counter-clockwise, the number of them that cover a place is the winding
 * number of the boundary around it: every inner edge counts once each way. When the boundary is
 * made of loops that neither meet themselves nor each other, and only one of them runs
 * counter-clockwise, that number is 0 or 1 everywhere, and nothing overlaps.
 */
#include "hm_meshcheck_private.h"

#include "hm_boxtree.h"
#include "hm_plane.h"
#include "hm_pred.h"

#include <stdlib.h>

/* Have two boundary edges more in common than a node that both have? */
static bool collide(const struct hm_mesh *m, const struct hm_mesh_edge *e,
                    const struct hm_mesh_edge *f)
{
    const double *a = hm_mesh_xy(m, e->a), *b = hm_mesh_xy(m, e->b);
    const double *c = hm_mesh_xy(m, f->a), *g = hm_mesh_xy(m, f->b);
    if (e->b == f->a && e->a == f->b)
        return true;
    if (e->b == f->a)
        return hm_plane_holds(g, a, b) || hm_plane_holds(a, c, g);
    if (e->a == f->b)
        return hm_plane_holds(c, a, b) || hm_plane_holds(b, c, g);
    return hm_plane_meet(a, b, c, g);
}

static enum hm_err edges_collide(const struct hm_mesh *m, const struct hm_mesh_edge *edge, size_t n,
                                 bool *found, struct hm_diag *d)
{
    struct hm_mesh_edge *open = hm_alloc(n, sizeof *open);
    struct hm_box *box = hm_alloc(n, sizeof *box);
    struct hm_boxtree *tree = NULL;
    enum hm_err err = open && box ? HM_OK : hm_fail_memory(d);
    size_t nopen = 0;
    for (size_t i = 0; i < n && !err; i++)
        if (edge[i].right < 0) {
            open[nopen] = edge[i];
            box[nopen++] = hm_box_of(hm_mesh_xy(m, edge[i].a), hm_mesh_xy(m, edge[i].b));
        }
    if (!err)
        err = hm_boxtree_build(&tree, box, nopen, d);
    *found = false;
    for (size_t i = 0; i < nopen && !err && !*found; i++) {
        struct hm_boxquery q = hm_boxtree_find(tree, box[i]);
        for (int32_t j; !*found && (j = hm_boxtree_next(&q)) >= 0;)
            *found = (size_t)j > i && collide(m, &open[i], &open[j]);
    }
    hm_boxtree_free(tree);
    free(open);
    free(box);
    return err;
}

static bool is_before(const double *p, const double *q)
{
    return p[0] != q[0] ? p[0] < q[0] : p[1] < q[1];
}

/* Of a loop that does not meet itself: its first node from the left turns as the loop runs. */
static bool is_counter_clockwise(const struct hm_mesh *m, const int32_t *node, size_t n)
{
    size_t k = 0;
    for (size_t i = 1; i < n; i++)
        if (is_before(hm_mesh_xy(m, node[i]), hm_mesh_xy(m, node[k])))
            k = i;
    return hm_pred_orient(hm_mesh_xy(m, node[(k + n - 1) % n]), hm_mesh_xy(m, node[k]),
                          hm_mesh_xy(m, node[(k + 1) % n])) > 0;
}

enum hm_err hm_meshcheck_plain(const struct hm_mesh *m, const struct hm_mesh_edge *edge, size_t n,
                               bool *plain, struct hm_diag *d)
{
    bool found;
    *plain = false;
    enum hm_err err = edges_collide(m, edge, n, &found, d);
    if (err || found)
        return err;
    struct hm_mesh_loops loops;
    err = hm_mesh_boundary_of(m, edge, n, &loops, d);
    if (err)
        return err;
    size_t outer = 0;
    for (size_t k = 0; k < loops.nloops; k++)
        outer += is_counter_clockwise(m, loops.node + loops.start[k],
                                      loops.start[k + 1] - loops.start[k]);
    hm_mesh_loops_free(&loops);
    *plain = outer == 1;
    return HM_OK;
}
