#include "hm_meshcheck_private.h"

#include "hm_boxtree.h"
#include "hm_elem.h"
#include "hm_places.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the checks share. */
struct check {
    const struct hm_mesh *m;
    struct hm_meshcheck *c;
    struct hm_mesh_edge *edge;
    size_t nedges;
    bool *proper; /* of each element: positive area, convex */
};

static void fault(struct check *k, enum hm_mesh_fault what, double x, double y)
{
    if (k->c->count[what]++ == 0) {
        k->c->place[what][0] = x;
        k->c->place[what][1] = y;
    }
}

static void fault_at_node(struct check *k, enum hm_mesh_fault what, int32_t node)
{
    fault(k, what, k->m->node[node].x, k->m->node[node].y);
}

static void fault_at_elem(struct check *k, enum hm_mesh_fault what, const struct hm_elem *e)
{
    double p[4][2], x = 0, y = 0;
    int n = hm_elem_xy(k->m, e, p);
    for (int i = 0; i < n; i++) {
        x += p[i][0] / n;
        y += p[i][1] / n;
    }
    fault(k, what, x, y);
}

static void check_elements(struct check *k)
{
    for (size_t i = 0; i < k->m->nelems; i++) {
        const struct hm_elem *e = &k->m->elem[i];
        k->proper[i] = hm_elem_is_convex(k->m, e);
        if (k->proper[i])
            continue;
        bool flat = hm_elem_corners(e) == 3 || hm_elem_area(k->m, e) <= 0;
        fault_at_elem(k, flat ? HM_FAULT_AREA : HM_FAULT_CONCAVE, e);
    }
}

static enum hm_err check_nodes(struct check *k, struct hm_diag *d)
{
    const struct hm_mesh *m = k->m;
    bool *used = hm_alloc0(m->nnodes, sizeof *used);
    struct hm_places places = {0};
    enum hm_err err = used ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; !err && i < m->nelems; i++)
        for (int c = 0; c < hm_elem_corners(&m->elem[i]); c++)
            used[m->elem[i].node[c]] = true;
    for (size_t i = 0; !err && i < m->nnodes; i++) {
        const struct hm_node *node = &m->node[i];
        if (!isfinite(node->z))
            fault(k, HM_FAULT_HEIGHT, node->x, node->y);
        if (!used[i])
            fault(k, HM_FAULT_ISOLATED, node->x, node->y);
        int32_t first = hm_places_put(&places, node->x, node->y, (int32_t)i);
        if (first < 0)
            err = hm_fail_memory(d);
        else if (first != (int32_t)i)
            fault(k, HM_FAULT_DUPLICATE, node->x, node->y);
    }
    hm_places_free(&places);
    free(used);
    return err;
}

/* The nodes of an element in ascending order, for comparison. */
struct nodes {
    int32_t node[4], elem;
};

static int by_nodes(const void *pa, const void *pb)
{
    const struct nodes *a = pa, *b = pb;
    for (int i = 0; i < 4; i++)
        if (a->node[i] != b->node[i])
            return a->node[i] < b->node[i] ? -1 : 1;
    return (a->elem > b->elem) - (a->elem < b->elem);
}

static struct nodes sorted_nodes(const struct hm_elem *e, size_t number)
{
    struct nodes s = {.elem = (int32_t)number};
    memcpy(s.node, e->node, sizeof s.node);
    for (int i = 1; i < 4; i++)
        for (int j = i; j > 0 && s.node[j] < s.node[j - 1]; j--) {
            int32_t swap = s.node[j];
            s.node[j] = s.node[j - 1];
            s.node[j - 1] = swap;
        }
    return s;
}

/* Elements on the same nodes. They cannot be without breaking another rule, so a mesh without
 * faults so far is spared the sorting. */
static enum hm_err check_same_elements(struct check *k, struct hm_diag *d)
{
    const int64_t *count = k->c->count;
    if (count[HM_FAULT_AREA] + count[HM_FAULT_CONCAVE] + count[HM_FAULT_EDGE] == 0)
        return HM_OK;
    size_t n = k->m->nelems;
    struct nodes *s = hm_alloc(n, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    for (size_t i = 0; i < n; i++)
        s[i] = sorted_nodes(&k->m->elem[i], i);
    qsort(s, n, sizeof *s, by_nodes);
    for (size_t i = 1; i < n; i++)
        if (!memcmp(s[i].node, s[i - 1].node, sizeof s[i].node))
            fault_at_elem(k, HM_FAULT_DUPLICATE, &k->m->elem[s[i].elem]);
    free(s);
    return HM_OK;
}

/* Edges used wrongly, each once however often it is used; nodes where boundary loops touch. */
static enum hm_err check_edges(struct check *k, struct hm_diag *d)
{
    const struct hm_mesh_edge *edge = k->edge;
    uint8_t *leaving = hm_alloc0(k->m->nnodes, sizeof *leaving);
    if (!leaving)
        return hm_fail_memory(d);
    for (size_t i = 0; i < k->nedges; i++) {
        const struct hm_mesh_edge *e = &edge[i], *before = i > 0 ? e - 1 : NULL;
        bool again =
            before && before->right == -2 &&
            ((before->a == e->a && before->b == e->b) || (before->a == e->b && before->b == e->a));
        if (e->right == -2 && !again)
            fault_at_node(k, HM_FAULT_EDGE, e->a);
        if (e->right == -1 && leaving[e->a] < 2 && ++leaving[e->a] == 2)
            fault_at_node(k, HM_FAULT_TOUCH, e->a);
    }
    free(leaving);
    return HM_OK;
}

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void unite(int32_t *parent, int32_t i, int32_t j)
{
    i = root_of(parent, i);
    j = root_of(parent, j);
    if (i < j)
        parent[j] = i;
    else
        parent[i] = j;
}

/* Pieces that hang together by edges: union and find. The root is the lowest element of a piece. */
static enum hm_err check_components(struct check *k, struct hm_diag *d)
{
    size_t n = k->m->nelems;
    int32_t *parent = hm_alloc(n, sizeof *parent);
    if (!parent)
        return hm_fail_memory(d);
    for (size_t i = 0; i < n; i++)
        parent[i] = (int32_t)i;
    for (size_t i = 0; i < k->nedges; i++) {
        const struct hm_mesh_edge *e = &k->edge[i];
        if (e->right >= 0)
            unite(parent, e->left, e->right);
        else if (e->right == -2 && i > 0 && e[-1].right == -2 &&
                 (e[-1].a == e->a || e[-1].a == e->b) && (e[-1].b == e->a || e[-1].b == e->b))
            unite(parent, e->left, e[-1].left);
    }
    for (size_t i = 0; i < n; i++) {
        if (parent[i] != (int32_t)i)
            continue;
        if (k->c->components++ > 0)
            fault_at_elem(k, HM_FAULT_COMPONENTS, &k->m->elem[i]);
    }
    free(parent);
    return HM_OK;
}

/* Can the boundary tell about overlaps (hm_meshcheck_plain)? */
static bool is_orderly(const struct hm_meshcheck *c)
{
    return c->count[HM_FAULT_AREA] + c->count[HM_FAULT_CONCAVE] + c->count[HM_FAULT_EDGE] +
               c->count[HM_FAULT_DUPLICATE] + c->count[HM_FAULT_TOUCH] ==
           0;
}

static enum hm_err check_overlaps(struct check *k, struct hm_diag *d)
{
    const struct hm_mesh *m = k->m;
    struct hm_boxtree *tree;
    if (is_orderly(k->c)) {
        bool plain;
        enum hm_err failure = hm_meshcheck_plain(m, k->edge, k->nedges, &plain, d);
        if (failure || plain)
            return failure;
    }
    struct hm_box *box = hm_alloc(m->nelems, sizeof *box);
    if (!box)
        return hm_fail_memory(d);
    for (size_t i = 0; i < m->nelems; i++)
        box[i] = hm_elem_box(m, &m->elem[i]);
    enum hm_err err = hm_boxtree_build(&tree, box, m->nelems, d);
    if (err) {
        free(box);
        return err;
    }
    for (size_t i = 0; i < m->nelems; i++) {
        if (!k->proper[i])
            continue;
        struct hm_boxquery q = hm_boxtree_find(tree, box[i]);
        for (int32_t j; (j = hm_boxtree_next(&q)) >= 0;)
            if ((size_t)j > i && k->proper[j] && hm_elem_overlap(m, &m->elem[i], m, &m->elem[j]))
                fault_at_elem(k, HM_FAULT_OVERLAP, &m->elem[i]);
        if (k->c->count[HM_FAULT_OVERLAP] >= HM_MESHCHECK_MOST_OVERLAPS)
            break;
    }
    hm_boxtree_free(tree);
    free(box);
    return HM_OK;
}

/* The last bits of the largest coordinate. */
static double rounding_of(const struct hm_mesh *m)
{
    double most = 0;
    for (size_t i = 0; i < m->nnodes; i++)
        most = fmax(most, fmax(fabs(m->node[i].x), fabs(m->node[i].y)));
    return 4 * DBL_EPSILON * most;
}

/* Is p on the edge a–b, within `reach`, and not at one of its ends? */
static bool inside_edge(const double *a, const double *b, const double *p, double reach)
{
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
    double length = hypot(ux, uy), along = (ux * vx + uy * vy) / length;
    return fabs(ux * vy - uy * vx) <= reach * length && along > reach && along < length - reach;
}

/* Hanging nodes: every edge that is not shared against every node at which such an edge begins. */
static enum hm_err check_hanging(struct check *k, struct hm_diag *d)
{
    const struct hm_mesh *m = k->m;
    double reach = rounding_of(m);
    struct hm_mesh_edge *open = hm_alloc(k->nedges, sizeof *open);
    struct hm_box *box = hm_alloc(k->nedges, sizeof *box);
    size_t n = 0;
    struct hm_boxtree *tree = NULL;
    enum hm_err err = open && box ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; !err && i < k->nedges; i++)
        if (k->edge[i].right < 0) {
            open[n] = k->edge[i];
            box[n++] = hm_box_grown(
                hm_box_of(hm_mesh_xy(m, k->edge[i].a), hm_mesh_xy(m, k->edge[i].b)), reach);
        }
    if (!err)
        err = hm_boxtree_build(&tree, box, n, d);
    for (size_t i = 0; !err && i < n; i++) {
        const double *p = hm_mesh_xy(m, open[i].a);
        struct hm_boxquery q = hm_boxtree_find(tree, hm_box_of(p, p));
        for (int32_t j; (j = hm_boxtree_next(&q)) >= 0;)
            if (inside_edge(hm_mesh_xy(m, open[j].a), hm_mesh_xy(m, open[j].b), p, reach)) {
                fault_at_node(k, HM_FAULT_HANGING, open[i].a);
                break;
            }
    }
    hm_boxtree_free(tree);
    free(open);
    free(box);
    return err;
}

enum hm_err hm_meshcheck_run(const struct hm_mesh *m, struct hm_meshcheck *c, struct hm_diag *d)
{
    *c = (struct hm_meshcheck){0};
    struct check k = {.m = m, .c = c};
    k.proper = hm_alloc(m->nelems, sizeof *k.proper);
    if (!k.proper)
        return hm_fail_memory(d);
    enum hm_err err = hm_mesh_edges(m, &k.edge, &k.nedges, d);
    if (!err) {
        check_elements(&k);
        err = check_nodes(&k, d);
    }
    if (!err)
        err = check_edges(&k, d);
    if (!err)
        err = check_same_elements(&k, d);
    if (!err)
        err = check_components(&k, d);
    if (!err)
        err = check_hanging(&k, d);
    if (!err)
        err = check_overlaps(&k, d);
    free(k.edge);
    free(k.proper);
    return err;
}

const char *hm_mesh_fault_name(enum hm_mesh_fault fault)
{
    static const char *const name[HM_FAULTS] = {
        [HM_FAULT_AREA] = "element with negative or zero area",
        [HM_FAULT_CONCAVE] = "quadrilateral that is not convex",
        [HM_FAULT_EDGE] = "edge used more than twice, or twice in one direction",
        [HM_FAULT_HANGING] = "node hanging in an edge of another element",
        [HM_FAULT_OVERLAP] = "elements that overlap",
        [HM_FAULT_ISOLATED] = "node that no element uses",
        [HM_FAULT_DUPLICATE] = "two nodes at one place, or two elements on the same nodes",
        [HM_FAULT_TOUCH] = "node where two boundaries touch",
        [HM_FAULT_COMPONENTS] = "piece apart from the rest",
        [HM_FAULT_HEIGHT] = "node without height",
    };
    return fault < HM_FAULTS ? name[fault] : "unknown fault";
}

bool hm_meshcheck_is_valid(const struct hm_meshcheck *c, bool allow_components)
{
    return hm_meshcheck_verdict(c, allow_components, NULL) == HM_OK;
}

enum hm_err hm_meshcheck_verdict(const struct hm_meshcheck *c, bool allow_components,
                                 struct hm_diag *d)
{
    for (int k = 0; k < HM_FAULTS; k++) {
        if (c->count[k] == 0 || (k == HM_FAULT_COMPONENTS && allow_components))
            continue;
        return hm_fail_at(d, HM_EGEOM, c->place[k][0], c->place[k][1], "%s (%lld in all)",
                          hm_mesh_fault_name((enum hm_mesh_fault)k), (long long)c->count[k]);
    }
    return HM_OK;
}
