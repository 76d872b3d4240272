/* hm_buckets: see hm_buckets.h. */
#include "hm_buckets.h"
#include "hm_pred.h"

#include <math.h>
#include <stdlib.h>

static void add(struct hm_buckets *b, int32_t tri, int32_t c)
{
    b->next[c] = b->first[tri];
    b->first[tri] = c;
}

/* Room for all triangles that there are by now. */
static enum hm_err make_room(struct hm_buckets *b, struct hm_diag *d)
{
    size_t triangles = (size_t)hm_tri_triangles(b->dom->tri);
    if (!hm_grow(&b->first, &b->cap_first, triangles, sizeof *b->first))
        return hm_fail_memory(d);
    while (b->n_first < triangles)
        b->first[b->n_first++] = HM_NOBODY;
    return HM_OK;
}

enum hm_err hm_buckets_fill(struct hm_buckets *b, const struct hm_domain *dom, const double *xyz,
                            size_t n, int threads, struct hm_diag *d)
{
    *b = (struct hm_buckets){.dom = dom, .xyz = xyz};
    int32_t *tri = hm_alloc(n, sizeof *tri);
    b->next = hm_alloc(n, sizeof *b->next);
    enum hm_err err = tri && b->next ? make_room(b, d) : hm_fail_memory(d);
    if (!err)
        err = hm_tri_locate_all(dom->tri, xyz, n, 3, threads, tri, d);
    for (size_t c = n; !err && c-- > 0;)
        if (tri[c] != HM_TRI_NONE && hm_domain_is_inside(dom, tri[c]))
            add(b, tri[c], (int32_t)c);
    free(tri);
    return err;
}

void hm_buckets_free(struct hm_buckets *b)
{
    free(b->first);
    free(b->next);
    free(b->star);
    free(b->rim);
}

enum hm_err hm_buckets_look(struct hm_buckets *b, int32_t v, struct hm_diag *d)
{
    const struct hm_tri *t = b->dom->tri;
    int32_t first = hm_tri_edge_from(t, v), e = first;
    b->n_star = 0;
    do {
        if (!hm_grow(&b->star, &b->cap_star, b->n_star + 1, sizeof *b->star) ||
            !hm_grow(&b->rim, &b->cap_rim, 2 * b->n_star + 2, sizeof *b->rim))
            return hm_fail_memory(d);
        if (hm_domain_is_inside(b->dom, e / 3)) {
            b->rim[2 * b->n_star] = hm_tri_xy(t, hm_tri_dest(t, e));
            b->rim[2 * b->n_star + 1] = hm_tri_xy(t, hm_tri_apex(t, e));
            b->star[b->n_star++] = e;
        }
        e = hm_tri_twin(t, hm_tri_prev(e));
    } while (e != first);
    return make_room(b, d);
}

/* For a place that no triangle of the star claims: the one of which it is the least beyond. */
static size_t nearest_sector(const struct hm_buckets *b, const double *v, const double *p)
{
    size_t nearest = 0;
    double least = INFINITY;
    for (size_t k = 0; k < b->n_star; k++) {
        const double *from = b->rim[2 * k], *to = b->rim[2 * k + 1];
        double beyond = fmax(-hm_area2(v, from, p), hm_area2(v, to, p));
        if (beyond < least && hm_area2(from, to, p) <= hm_area2(from, to, v)) {
            least = beyond;
            nearest = k;
        }
    }
    return nearest;
}

size_t hm_buckets_sector(const struct hm_buckets *b, const double *v, const double *p)
{
    const double *last = NULL;
    double after = 0, before = 0; /* how far left of its first edge, and of its last */
    for (size_t k = 0; k < b->n_star; k++) {
        after = b->rim[2 * k] == last ? before : hm_area2(v, b->rim[2 * k], p);
        last = b->rim[2 * k + 1];
        before = hm_area2(v, last, p);
        if (after >= 0 && before < 0)
            return k;
    }
    return nearest_sector(b, v, p);
}

void hm_buckets_deal(struct hm_buckets *b, const double *v, int32_t but)
{
    int32_t all = HM_NOBODY;
    for (size_t k = 0; k < b->n_star; k++) {
        int32_t tri = b->star[k] / 3;
        for (int32_t c = b->first[tri], next; c != HM_NOBODY; c = next) {
            next = b->next[c];
            b->next[c] = all;
            all = c;
        }
        b->first[tri] = HM_NOBODY;
    }
    for (int32_t c = all, next; c != HM_NOBODY; c = next) {
        next = b->next[c];
        if (c != but)
            add(b, b->star[hm_buckets_sector(b, v, hm_buckets_at(b, c))] / 3, c);
    }
}

void hm_buckets_drop(struct hm_buckets *b, int32_t tri, int32_t measurement)
{
    int32_t *link = &b->first[tri];
    while (*link != measurement)
        link = &b->next[*link];
    *link = b->next[measurement];
}
