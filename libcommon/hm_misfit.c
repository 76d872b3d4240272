#include "hm_misfit.h"

#include "hm_elem.h"
#include "hm_meshedges.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK = 256, SAMPLES = 6 /* of the terrain, along an edge */ };

struct survey {
    const struct hm_mesh *mesh;
    const struct hm_terrain *terrain;
    double most;
    bool *keep;
};

/* --- which elements miss the ground --- */

/* Adds the squares of the misfits in a triangle. */
static void add_triangle(const struct survey *s, const struct hm_node *const n[3], double *sum,
                         int *count, int32_t *hint)
{
    for (int i = 0; i < SAMPLES; i++)
        for (int j = 0; i + j < SAMPLES; j++) {
            double u = (i + 1.0 / 3) / SAMPLES, v = (j + 1.0 / 3) / SAMPLES, w = 1 - u - v;
            double z = hm_terrain_z(s->terrain, w * n[0]->x + u * n[1]->x + v * n[2]->x,
                                    w * n[0]->y + u * n[1]->y + v * n[2]->y, hint);
            double miss = w * n[0]->z + u * n[1]->z + v * n[2]->z - z;
            if (isnan(miss))
                continue;
            *sum += miss * miss;
            ++*count;
        }
}

static void survey_chunk(void *arg, size_t chunk)
{
    const struct survey *s = arg;
    const struct hm_mesh *m = s->mesh;
    int32_t hint = 0;
    for (size_t i = chunk * CHUNK; i < (chunk + 1) * CHUNK && i < m->nelems; i++) {
        const struct hm_elem *e = &m->elem[i];
        double sum = 0;
        int count = 0;
        for (int k = 1; k + 1 < hm_elem_corners(e); k++) {
            const struct hm_node *n[3] = {&m->node[e->node[0]], &m->node[e->node[k]],
                                          &m->node[e->node[k + 1]]};
            add_triangle(s, n, &sum, &count, &hint);
        }
        s->keep[i] = sum <= s->most * s->most * count;
    }
}

/* --- what goes with them --- */

/* The elements beside element i across each of its edges, -1 where there is none. */
struct beside {
    int32_t elem[4];
    int count;
};

static struct beside *find_beside(const struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_mesh_edge *edge = NULL;
    size_t n;
    struct beside *b = hm_alloc0(m->nelems, sizeof *b);
    if (!b) {
        hm_fail_memory(d);
        return NULL;
    }
    if (hm_mesh_edges(m, &edge, &n, d)) {
        free(b);
        return NULL;
    }
    for (size_t k = 0; k < n; k++) {
        int32_t l = edge[k].left, r = edge[k].right;
        if (r < 0)
            continue;
        b[l].elem[b[l].count++] = r;
        b[r].elem[b[r].count++] = l;
    }
    free(edge);
    return b;
}

static int neighbours(const struct beside *b, const bool *keep, bool kept)
{
    int n = 0;
    for (int k = 0; k < b->count; k++)
        n += keep[b->elem[k]] == kept;
    return n;
}

/* A single element that misses the ground would leave a hole in which nothing else fits. */
static void spare_single(const struct hm_mesh *m, const struct beside *b, bool *keep)
{
    for (size_t i = 0; i < m->nelems; i++)
        keep[i] = keep[i] || neighbours(&b[i], keep, false) == 0;
}

static enum hm_err drop_around(const struct hm_mesh *m, bool *keep, struct hm_diag *d)
{
    bool *at = hm_alloc0(m->nnodes, sizeof *at);
    if (!at)
        return hm_fail_memory(d);
    for (size_t i = 0; i < m->nelems; i++)
        for (int k = 0; !keep[i] && k < hm_elem_corners(&m->elem[i]); k++)
            at[m->elem[i].node[k]] = true;
    for (size_t i = 0; i < m->nelems; i++)
        for (int k = 0; k < hm_elem_corners(&m->elem[i]); k++)
            keep[i] = keep[i] && !at[m->elem[i].node[k]];
    free(at);
    return HM_OK;
}

static void drop_hanging(const struct hm_mesh *m, const struct beside *b, bool *keep)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < m->nelems; i++)
            if (keep[i] && neighbours(&b[i], keep, true) < 2 && neighbours(&b[i], keep, false)) {
                keep[i] = false;
                changed = true;
            }
    }
}

/* Drop groups of elements, joined by edges, that are too small. */
static enum hm_err drop_small(const struct hm_mesh *m, const struct beside *b, bool *keep,
                              struct hm_diag *d)
{
    int32_t *group = hm_alloc(m->nelems, sizeof *group);
    bool *seen = hm_alloc0(m->nelems, sizeof *seen);
    if (!group || !seen) {
        free(group);
        free(seen);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < m->nelems; i++) {
        size_t n = 0;
        if (keep[i] && !seen[i]) {
            seen[i] = true;
            group[n++] = (int32_t)i;
        }
        for (size_t k = 0; k < n; k++)
            for (int side = 0; side < b[group[k]].count; side++) {
                int32_t next = b[group[k]].elem[side];
                if (!keep[next] || seen[next])
                    continue;
                seen[next] = true;
                group[n++] = next;
            }
        for (size_t k = 0; k < n && n < HM_MISFIT_LEAST && n < m->nelems; k++)
            keep[group[k]] = false;
    }
    free(group);
    free(seen);
    return HM_OK;
}

enum hm_err hm_misfit_mark(const struct hm_mesh *m, const struct hm_terrain *terrain, double most,
                           int threads, bool *keep, struct hm_diag *d)
{
    struct survey s = {m, terrain, most, keep};
    struct beside *b = find_beside(m, d);
    if (!b)
        return HM_ENOMEM;
    hm_thread_for(threads, (m->nelems + CHUNK - 1) / CHUNK, survey_chunk, &s);
    spare_single(m, b, keep);
    enum hm_err err = drop_around(m, keep, d);
    if (!err) {
        drop_hanging(m, b, keep);
        err = drop_small(m, b, keep, d);
    }
    free(b);
    return err;
}
