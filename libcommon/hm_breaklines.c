#include "hm_breaklines.h"

#include "hm_attr.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum hm_err measure(const struct hm_line *line, double **behind, struct hm_diag *d)
{
    size_t pieces = hm_polyline_pieces(line);
    double *s = *behind = hm_alloc(pieces + 1, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    s[0] = 0;
    for (size_t k = 0; k < pieces; k++) {
        const double *a = hm_polyline_from(line, k), *b = hm_polyline_to(line, k);
        s[k + 1] = s[k] + hypot(b[0] - a[0], b[1] - a[1]);
    }
    return HM_OK;
}

static enum hm_err build_index(struct hm_breaklines *b, size_t pieces, struct hm_diag *d)
{
    struct hm_segment *s = hm_alloc(pieces, sizeof *s);
    if (!s)
        return hm_fail_memory(d);
    size_t n = 0;
    for (size_t l = 0; l < b->n; l++)
        for (size_t k = 0; k < hm_polyline_pieces(b->line[l]); k++, n++) {
            memcpy(s[n].a, hm_polyline_from(b->line[l], k), sizeof s[n].a);
            memcpy(s[n].b, hm_polyline_to(b->line[l], k), sizeof s[n].b);
            s[n].line = (int32_t)l;
            s[n].piece = (int32_t)k;
        }
    enum hm_err err = hm_segindex_build(&b->index, s, n, d);
    free(s);
    return err;
}

enum hm_err hm_breaklines_build(struct hm_breaklines **out, const struct hm_lines *sets, size_t n,
                                struct hm_diag *d)
{
    *out = NULL;
    size_t most = 0, pieces = 0;
    char limit[2];
    for (size_t s = 0; s < n; s++)
        most += sets[s].n;
    struct hm_breaklines *b = hm_alloc0(1, sizeof *b);
    if (!b)
        return hm_fail_memory(d);
    b->line = hm_alloc(most, sizeof *b->line);
    b->behind = hm_alloc(most, sizeof *b->behind);
    b->sided = hm_alloc(most, sizeof *b->sided);
    enum hm_err err = b->line && b->behind && b->sided ? HM_OK : hm_fail_memory(d);
    for (size_t s = 0; !err && s < n; s++)
        for (size_t k = 0; !err && k < sets[s].n; k++) {
            const struct hm_line *line = &sets[s].line[k];
            if (hm_role_of(line->attrs) != HM_ROLE_BREAKLINE || line->n < 2)
                continue;
            err = measure(line, &b->behind[b->n], d);
            b->line[b->n] = line;
            b->sided[b->n] = hm_attr_get(line->attrs, "limit", limit, sizeof limit);
            b->n += !err;
            pieces += hm_polyline_pieces(line);
        }
    if (!err)
        err = build_index(b, pieces, d);
    if (err)
        hm_breaklines_free(b);
    else
        *out = b;
    return err;
}

void hm_breaklines_free(struct hm_breaklines *b)
{
    if (!b)
        return;
    for (size_t k = 0; k < b->n; k++)
        free(b->behind[k]);
    free(b->behind);
    free(b->sided);
    free(b->line);
    hm_segindex_free(b->index);
    free(b);
}

void hm_breaklines_at(const struct hm_breaklines *b, int32_t l, double s, double xy[2])
{
    const struct hm_line *line = b->line[l];
    const double *behind = b->behind[l];
    size_t lo = 0, hi = hm_polyline_pieces(line);
    double length = behind[hi];
    if (line->closed && length > 0) {
        s = fmod(s, length);
        s = s < 0 ? s + length : s;
    }
    while (hi - lo > 1) {
        size_t mid = (lo + hi) / 2;
        *(behind[mid] <= s ? &lo : &hi) = mid;
    }
    double piece = behind[lo + 1] - behind[lo];
    double t = piece > 0 ? fmin(1, fmax(0, (s - behind[lo]) / piece)) : 0;
    const double *p = hm_polyline_from(line, lo), *q = hm_polyline_to(line, lo);
    for (int k = 0; k < 2; k++)
        xy[k] = p[k] + t * (q[k] - p[k]);
}

double hm_breaklines_way(const struct hm_breaklines *b, int32_t l, double s1, double s2)
{
    double way = s2 - s1, length = b->behind[l][hm_polyline_pieces(b->line[l])];
    return b->line[l]->closed && length > 0 ? remainder(way, length) : way;
}

/* --- the first one on a way --- */

struct way {
    const double *from, *to, *along;
    double part;
};

static bool meets_way(void *arg, const struct hm_segment *s)
{
    struct way *w = arg;
    double u[2] = {s->b[0] - s->a[0], s->b[1] - s->a[1]}, length = hypot(u[0], u[1]);
    double cosine = length > 0 ? fabs(u[0] * w->along[0] + u[1] * w->along[1]) / length : 0;
    if (cosine >= 0.5 && hm_plane_meet(w->from, w->to, s->a, s->b))
        w->part = fmin(w->part, hm_plane_meeting(w->from, w->to, s->a, s->b));
    return true;
}

double hm_breaklines_first(const struct hm_breaklines *b, const double from[2], const double to[2],
                           const double along[2])
{
    struct way w = {from, to, along, INFINITY};
    const double lo[2] = {fmin(from[0], to[0]), fmin(from[1], to[1])};
    const double hi[2] = {fmax(from[0], to[0]), fmax(from[1], to[1])};
    hm_segindex_box(b->index, lo, hi, meets_way, &w);
    return w.part;
}
