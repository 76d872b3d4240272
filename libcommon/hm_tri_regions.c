/* hm_tri_regions: what constraints part the plane into. */
#include "hm_pred.h"
#include "hm_tri_topology.h"

#include <stdlib.h>

int32_t hm_tri_region(const struct hm_tri *t, int32_t tri)
{
    return t->region ? t->region[tri] : 0;
}

enum hm_err hm_tri_set_region(struct hm_tri *t, int32_t tri, int32_t region)
{
    enum hm_err err = region || t->region ? hm_tri_need_regions(t, NULL) : HM_OK;
    if (!err && t->region)
        t->region[tri] = region;
    return err;
}

enum hm_err hm_tri_flood(struct hm_tri *t, int32_t tri, int32_t stop, int32_t region,
                         struct hm_diag *d)
{
    enum hm_err err = hm_tri_need_regions(t, d);
    if (err)
        return err;
    size_t words = ((size_t)t->triangles + 31) / 32, n = 0;
    uint32_t *seen = hm_alloc0(words, sizeof *seen);
    if (!seen || !hm_grow(&t->stack, &t->cap_stack, (size_t)t->triangles, sizeof *t->stack)) {
        free(seen);
        return hm_fail_memory(d);
    }
    seen[tri / 32] |= 1u << tri % 32;
    t->stack[n++] = tri;
    while (n > 0) {
        int32_t here = t->stack[--n];
        t->region[here] = region;
        for (int32_t e = 3 * here; e < 3 * here + 3; e++) {
            int32_t beyond = t->half[e].twin / 3;
            if ((hm_tri_marks_of(t, e) & stop) || (seen[beyond / 32] >> beyond % 32 & 1))
                continue;
            seen[beyond / 32] |= 1u << beyond % 32;
            t->stack[n++] = beyond;
        }
    }
    free(seen);
    return HM_OK;
}

static double area2(const struct hm_tri *t, int32_t tri)
{
    const struct hm_tri_half *h = t->half + 3 * (size_t)tri;
    return hm_area2(hm_tri_at(t, h[0].org), hm_tri_at(t, h[1].org), hm_tri_at(t, h[2].org));
}

/* Number all that can be reached from `start`; the largest triangle among it. `stack` has room for
 * all triangles, each of which comes onto it once. */
static int32_t number_from(const struct hm_tri *t, int32_t start, int32_t stop, int32_t number,
                           int32_t *of, int32_t *stack)
{
    int32_t largest = HM_TRI_NONE, n = 0;
    double most = 0;
    of[start] = number;
    stack[n++] = start;
    while (n > 0) {
        int32_t here = stack[--n];
        double size = hm_tri_is_ghost(t, here) ? -1 : area2(t, here);
        if (size > most || (size == most && here < largest) ||
            (largest == HM_TRI_NONE && !hm_tri_is_ghost(t, here))) {
            largest = here;
            most = size;
        }
        for (int32_t e = 3 * here; e < 3 * here + 3; e++) {
            int32_t beyond = t->half[e].twin / 3;
            if ((hm_tri_marks_of(t, e) & stop) || of[beyond] != HM_TRI_NONE)
                continue;
            of[beyond] = number;
            stack[n++] = beyond;
        }
    }
    return largest;
}

enum hm_err hm_tri_components(const struct hm_tri *t, int32_t stop, struct hm_tri_components *c,
                              struct hm_diag *d)
{
    size_t n = (size_t)t->triangles, cap = 0;
    int32_t *stack = hm_alloc(n, sizeof *stack), ghost = 0;
    *c = (struct hm_tri_components){.of = hm_alloc(n, sizeof *c->of)};
    bool good = stack && c->of;
    for (size_t i = 0; good && i < n; i++)
        c->of[i] = HM_TRI_NONE;
    while (t->half[3 * ghost].org == HM_TRI_FREE || !hm_tri_is_ghost(t, ghost))
        ghost++;
    for (int32_t i = -1; good && i < t->triangles; i++) {
        int32_t start = i < 0 ? ghost : i;
        if (c->of[start] != HM_TRI_NONE || t->half[3 * start].org == HM_TRI_FREE)
            continue;
        good = hm_grow(&c->largest, &cap, (size_t)c->n + 1, sizeof *c->largest);
        if (good) {
            c->largest[c->n] = number_from(t, start, stop, c->n, c->of, stack);
            c->n++;
        }
    }
    free(stack);
    if (good)
        return HM_OK;
    hm_tri_components_free(c);
    return hm_fail_memory(d);
}

void hm_tri_components_free(struct hm_tri_components *c)
{
    free(c->of);
    free(c->largest);
    *c = (struct hm_tri_components){0};
}

void hm_tri_centre(const struct hm_tri *t, int32_t tri, double xy[2])
{
    const struct hm_tri_half *h = t->half + 3 * (size_t)tri;
    const double *a = hm_tri_at(t, h[0].org), *b = hm_tri_at(t, h[1].org),
                 *c = hm_tri_at(t, h[2].org);
    for (int k = 0; k < 2; k++)
        xy[k] = a[k] + ((b[k] - a[k]) + (c[k] - a[k])) / 3;
}
