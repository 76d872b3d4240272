#include "hm_face.h"

#include "hm_attr.h"
#include "hm_elem.h"
#include "hm_meshedges.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- loops --- */

static void measure_box(struct hm_face *f)
{
    for (int k = 0; k < 2; k++) {
        f->lo[k] = INFINITY;
        f->hi[k] = -INFINITY;
        for (size_t i = 0; i < f->loop.n; i++) {
            f->lo[k] = fmin(f->lo[k], f->loop.xyz[3 * i + (size_t)k]);
            f->hi[k] = fmax(f->hi[k], f->loop.xyz[3 * i + (size_t)k]);
        }
    }
}

static enum hm_err check_loop(const struct hm_line *loop, const char *name, struct hm_diag *d)
{
    bool crosses = false;
    double xy[2], x = loop->n ? loop->xyz[0] : 0, y = loop->n ? loop->xyz[1] : 0;
    if (!loop->closed)
        return hm_fail_at(d, HM_EGEOM, x, y, "the loop face=%s is open", name);
    if (loop->n < 3)
        return hm_fail_at(d, HM_EGEOM, x, y, "the loop face=%s has only %zu points", name, loop->n);
    enum hm_err err = hm_polyline_crosses_itself(loop, &crosses, xy, d);
    if (!err && crosses)
        err = hm_fail_at(d, HM_EGEOM, xy[0], xy[1], "the loop face=%s crosses itself", name);
    return err;
}

static enum hm_err take_loop(const struct hm_line *line, const struct hm_rough *list, size_t count,
                             struct hm_face *face, struct hm_diag *d)
{
    char name[HM_ROUGH_NAME];
    hm_attr_get(line->attrs, "face", name, sizeof name);
    *face = (struct hm_face){.loop = *line, .hole = hm_attr_flag(line->attrs, "hole")};
    for (size_t k = 0; k < count; k++)
        if (!strcmp(list[k].name, name))
            face->surface = list[k].number;
    if (face->surface == 0)
        return hm_fail_at(d, HM_EGEOM, line->n ? line->xyz[0] : 0, line->n ? line->xyz[1] : 0,
                          "face=%s: there is no surface '%s' among the lines", name, name);
    const double *first = line->xyz, *last = line->n ? line->xyz + 3 * (line->n - 1) : first;
    if (line->n > 3 && !line->closed && first[0] == last[0] && first[1] == last[1]) {
        face->loop.closed = true;
        face->loop.n--;
    }
    measure_box(face);
    return check_loop(&face->loop, name, d);
}

enum hm_err hm_face_collect(const struct hm_lines *sets, size_t n, const struct hm_rough *list,
                            size_t count, struct hm_face **faces, size_t *nfaces, struct hm_diag *d)
{
    size_t cap = 0;
    *faces = NULL;
    *nfaces = 0;
    enum hm_err err = HM_OK;
    for (size_t s = 0; !err && s < n; s++)
        for (size_t k = 0; !err && k < sets[s].n; k++) {
            const struct hm_line *line = &sets[s].line[k];
            if (hm_role_of(line->attrs) != HM_ROLE_FACE)
                continue;
            if (!hm_grow(faces, &cap, *nfaces + 1, sizeof **faces))
                err = hm_fail_memory(d);
            else
                err = take_loop(line, list, count, &(*faces)[(*nfaces)++], d);
        }
    if (err) {
        free(*faces);
        *faces = NULL;
        *nfaces = 0;
    }
    return err;
}

/* --- inside or outside --- */

static int side_of(const struct hm_face *f, const double *p)
{
    if (p[0] < f->lo[0] || p[0] > f->hi[0] || p[1] < f->lo[1] || p[1] > f->hi[1])
        return -1;
    return hm_polygon_side(&f->loop, p[0], p[1]);
}

bool hm_face_is_inside(const double *p, int32_t surface, const struct hm_face *faces, size_t n)
{
    bool inside = false, loops = false;
    for (size_t k = 0; k < n; k++) {
        if (faces[k].surface != surface)
            continue;
        int side = side_of(&faces[k], p);
        if (faces[k].hole && side > 0)
            return false;
        loops = loops || !faces[k].hole;
        inside = inside || (!faces[k].hole && side >= 0);
    }
    return inside || !loops;
}

/* --- dropping elements --- */

/* Keep the elements marked, and the nodes that they use. */
static enum hm_err compact(struct hm_mesh *m, const bool *keep, struct hm_diag *d)
{
    int32_t *number = hm_alloc(m->nnodes, sizeof *number), n = 0;
    if (!number)
        return hm_fail_memory(d);
    memset(number, -1, m->nnodes * sizeof *number);
    size_t kept = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        if (!keep[k])
            continue;
        for (int c = 0; c < hm_elem_corners(&m->elem[k]); c++)
            number[m->elem[k].node[c]] = 0;
        m->elem[kept++] = m->elem[k];
    }
    m->nelems = kept;
    for (size_t i = 0; i < m->nnodes; i++)
        if (number[i] == 0) {
            m->node[n] = m->node[i];
            number[i] = n++;
        }
    m->nnodes = (size_t)n;
    for (size_t k = 0; k < m->nelems; k++)
        for (int c = 0; c < hm_elem_corners(&m->elem[k]); c++)
            m->elem[k].node[c] = number[m->elem[k].node[c]];
    free(number);
    return HM_OK;
}

/* --- nodes in which the rest hangs together --- */

struct spoke {
    int32_t node, elem;
};

static int by_node(const void *a, const void *b)
{
    const struct spoke *p = a, *q = b;
    if (p->node != q->node)
        return p->node < q->node ? -1 : 1;
    return p->elem < q->elem ? -1 : p->elem > q->elem;
}

/* Do two elements share an edge that ends in node v? */
static bool share_edge(const struct hm_elem *e, const struct hm_elem *f, int32_t v)
{
    int shared = 0;
    for (int i = 0; i < hm_elem_corners(e); i++)
        for (int j = 0; j < hm_elem_corners(f); j++)
            shared += e->node[i] == f->node[j] && e->node[i] != v;
    return shared > 0;
}

/* The elements round a node fall into fans. Keep the largest fan (the first of equals); returns how
 * many elements go. */
static int64_t keep_one_fan(const struct hm_mesh *m, const struct spoke *s, size_t n, bool *keep)
{
    enum { MOST = 64 }; /* elements round a node; a regular mesh has at most 8 */
    size_t fan[MOST], size[MOST] = {0}, best = 0;
    int64_t gone = 0;
    n = n < MOST ? n : MOST;
    for (size_t i = 0; i < n; i++)
        fan[i] = i;
    for (size_t round = 0; round < n; round++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                if (fan[j] < fan[i] &&
                    share_edge(&m->elem[s[i].elem], &m->elem[s[j].elem], s->node))
                    fan[i] = fan[j];
    for (size_t i = 0; i < n; i++)
        if (++size[fan[i]] > size[best])
            best = fan[i];
    for (size_t i = 0; i < n; i++)
        if (fan[i] != best && keep[s[i].elem]) {
            keep[s[i].elem] = false;
            gone++;
        }
    return gone;
}

/* How many border edges end in each node: a node with more than two is a pinch. */
static enum hm_err count_border(const struct hm_mesh *m, unsigned char *border, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n;
    enum hm_err err = hm_mesh_edges(m, &edge, &n, d);
    for (size_t k = 0; !err && k < n; k++)
        if (edge[k].right < 0) {
            border[edge[k].a]++;
            border[edge[k].b]++;
        }
    free(edge);
    return err;
}

static enum hm_err drop_pinched(struct hm_mesh *m, int64_t *gone, struct hm_diag *d)
{
    *gone = 0;
    size_t n = 0, cap = 0;
    struct spoke *spoke = NULL;
    unsigned char *border = hm_alloc0(m->nnodes, 1);
    bool *keep = hm_alloc(m->nelems, sizeof *keep);
    enum hm_err err = border && keep ? count_border(m, border, d) : hm_fail_memory(d);
    for (size_t k = 0; !err && k < m->nelems; k++) {
        keep[k] = true;
        for (int c = 0; !err && c < hm_elem_corners(&m->elem[k]); c++) {
            int32_t v = m->elem[k].node[c];
            if (border[v] <= 2)
                continue;
            if (!hm_grow(&spoke, &cap, n + 1, sizeof *spoke))
                err = hm_fail_memory(d);
            else
                spoke[n++] = (struct spoke){v, (int32_t)k};
        }
    }
    if (!err && n > 0) {
        qsort(spoke, n, sizeof *spoke, by_node);
        for (size_t i = 0, end; i < n; i = end) {
            for (end = i + 1; end < n && spoke[end].node == spoke[i].node; end++)
                ;
            *gone += keep_one_fan(m, spoke + i, end - i, keep);
        }
        err = compact(m, keep, d);
    }
    free(spoke);
    free(border);
    free(keep);
    return err;
}

static bool element_is_inside(const struct hm_elem *e, const bool *inside)
{
    bool all = true;
    for (int c = 0; c < hm_elem_corners(e); c++)
        all = all && inside[e->node[c]];
    return all;
}

static enum hm_err drop_outside(struct hm_mesh *mesh, int32_t surface, const struct hm_face *faces,
                                size_t n, bool centre, int64_t *dropped, struct hm_diag *d)
{
    bool *inside = hm_alloc(mesh->nnodes, sizeof *inside);
    bool *keep = hm_alloc(mesh->nelems, sizeof *keep);
    enum hm_err err = inside && keep ? HM_OK : hm_fail_memory(d);
    for (size_t i = 0; !err && i < mesh->nnodes; i++)
        inside[i] = hm_face_is_inside(&mesh->node[i].x, surface, faces, n);
    for (size_t k = 0; !err && k < mesh->nelems; k++) {
        double xy[2];
        hm_elem_centre(mesh, &mesh->elem[k], xy);
        keep[k] = centre ? hm_face_is_inside(xy, surface, faces, n)
                         : element_is_inside(&mesh->elem[k], inside);
        *dropped += !keep[k];
    }
    if (!err)
        err = compact(mesh, keep, d);
    free(inside);
    free(keep);
    return err;
}

static enum hm_err drop_all_pinched(struct hm_mesh *mesh, int64_t *pinched, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (int64_t gone = 1; !err && gone > 0; *pinched += err ? 0 : gone)
        err = drop_pinched(mesh, &gone, d);
    return err;
}

enum hm_err hm_face_keep(struct hm_mesh *mesh, const bool *keep, struct hm_face_cut *cut,
                         struct hm_diag *d)
{
    size_t before = mesh->nelems;
    enum hm_err err = compact(mesh, keep, d);
    cut->dropped += (int64_t)(before - mesh->nelems);
    return err ? err : drop_all_pinched(mesh, &cut->pinched, d);
}

enum hm_err hm_face_apply(struct hm_mesh *mesh, const struct hm_rough *surface,
                          const struct hm_face *faces, size_t nfaces, bool centre,
                          struct hm_face_cut *cut, struct hm_diag *d)
{
    *cut = (struct hm_face_cut){0};
    const double *place = NULL;
    bool loops = false;
    for (size_t k = 0; k < nfaces; k++) {
        if (faces[k].surface != surface->number)
            continue;
        place = place ? place : faces[k].loop.xyz;
        loops = loops || !faces[k].hole;
    }
    if (!place)
        return HM_OK;
    enum hm_err err = drop_outside(mesh, surface->number, faces, nfaces, centre, &cut->dropped, d);
    if (!err)
        err = drop_all_pinched(mesh, &cut->pinched, d);
    if (!err && mesh->nelems == 0)
        err = hm_fail_at(d, HM_EGEOM, place[0], place[1],
                         loops ? "no element of surface '%s' lies wholly inside its face loop"
                               : "a hole covers the whole surface '%s'",
                         surface->name);
    return err;
}
