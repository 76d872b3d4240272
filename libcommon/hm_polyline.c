#include "hm_polyline.h"

#include "hm_plane.h"
#include "hm_pred.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t hm_polyline_pieces(const struct hm_line *line)
{
    if (line->n < 2)
        return 0;
    return line->closed ? line->n : line->n - 1;
}

static double piece_length(const struct hm_line *line, size_t k)
{
    const double *a = hm_polyline_from(line, k), *b = hm_polyline_to(line, k);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

double hm_polyline_length(const struct hm_line *line)
{
    double length = 0;
    for (size_t k = 0; k < hm_polyline_pieces(line); k++)
        length += piece_length(line, k);
    return length;
}

/* Ends are taken over bit for bit, so that a missing z beside a vertex does not spoil it. */
static void between(const double *a, const double *b, double t, double xyz[3])
{
    for (int k = 0; k < 3; k++)
        xyz[k] = t <= 0 ? a[k] : t >= 1 ? b[k] : a[k] + t * (b[k] - a[k]);
}

void hm_polyline_at(const struct hm_line *line, double s, double xyz[3])
{
    size_t pieces = hm_polyline_pieces(line);
    if (line->closed && pieces > 0) {
        double length = hm_polyline_length(line);
        s = length > 0 ? fmod(s, length) : 0;
        s = s < 0 ? s + length : s;
    }
    for (size_t k = 0; k < pieces; k++) {
        double length = piece_length(line, k);
        if (s <= length && length > 0) {
            between(hm_polyline_from(line, k), hm_polyline_to(line, k), s / length, xyz);
            return;
        }
        s -= length;
    }
    const double *end = pieces > 0 ? hm_polyline_to(line, pieces - 1) : line->xyz;
    memcpy(xyz, end, 3 * sizeof *xyz);
}

enum hm_err hm_polyline_divide(const struct hm_line *line, size_t pieces, double **out, size_t *n,
                               struct hm_diag *d)
{
    *out = NULL;
    *n = 0;
    double length = hm_polyline_length(line);
    if (!(length > 0) || !isfinite(length)) {
        double *p = line->xyz;
        return line->n > 0 ? hm_fail_at(d, HM_EGEOM, p[0], p[1], "a line without length")
                           : hm_fail(d, HM_EGEOM, "a line without points");
    }
    size_t count = line->closed ? pieces : pieces + 1;
    double *xyz = hm_alloc(count, 3 * sizeof *xyz);
    if (!xyz)
        return hm_fail_memory(d);
    size_t k = 0, last = hm_polyline_pieces(line) - 1;
    double behind = 0, here = piece_length(line, 0); /* length before piece k, and of it */
    for (size_t i = 0; i < count; i++) {
        double s = length * ((double)i / (double)pieces);
        while (k < last && (s > behind + here || here == 0)) {
            behind += here;
            here = piece_length(line, ++k);
        }
        double t = i == pieces ? 1 : here > 0 ? (s - behind) / here : 0;
        between(hm_polyline_from(line, k), hm_polyline_to(line, k), t, xyz + 3 * i);
    }
    if (!line->closed)
        memcpy(xyz + 3 * pieces, line->xyz + 3 * (line->n - 1), 3 * sizeof *xyz);
    *out = xyz;
    *n = count;
    return HM_OK;
}

enum hm_err hm_polyline_resample(const struct hm_line *line, double spacing, double **out,
                                 size_t *n, struct hm_diag *d)
{
    *out = NULL;
    *n = 0;
    if (!(spacing > 0))
        return hm_fail(d, HM_EARG, "the spacing of points along a line must be positive");
    double pieces = floor(hm_polyline_length(line) / spacing + 0.5);
    if (pieces > INT32_MAX)
        return hm_fail(d, HM_ENOMEM, "spacing %g is too small for a line of this length", spacing);
    return hm_polyline_divide(line, (size_t)fmax(line->closed ? 3 : 1, pieces), out, n, d);
}

double hm_polygon_area2(const struct hm_line *ring)
{
    double area2 = 0; /* about the first vertex: coordinates are large against the ring */
    for (size_t k = 1; k + 1 < ring->n; k++)
        area2 += hm_area2(ring->xyz, ring->xyz + 3 * k, ring->xyz + 3 * (k + 1));
    return area2;
}

int hm_polygon_side(const struct hm_line *ring, double x, double y)
{
    const double p[2] = {x, y};
    bool inside = false;
    for (size_t k = 0; k < ring->n; k++) {
        enum hm_ray c = hm_plane_ray(p, hm_polyline_from(ring, k), hm_polyline_to(ring, k));
        if (c == HM_RAY_ON)
            return 0;
        inside ^= c == HM_RAY_CROSSES;
    }
    return inside ? 1 : -1;
}

/* --- self-crossing --- */

struct meeting {
    const struct hm_segment *self;
    int32_t pieces;
    bool closed, found;
    double xy[2];
};

/* Successive pieces a b, b c share b, and meet elsewhere only when c turns straight back. */
static bool folds_back(const struct hm_segment *p, const struct hm_segment *q, double xy[2])
{
    const double *a = p->a, *b = p->b, *c = q->b;
    if (hm_pred_orient(a, b, c) != 0)
        return false;
    if ((a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) <= 0)
        return false;
    xy[0] = b[0];
    xy[1] = b[1];
    return true;
}

static bool meets_other(void *arg, const struct hm_segment *other)
{
    struct meeting *m = arg;
    const struct hm_segment *self = m->self;
    if (other->piece <= self->piece)
        return true;
    bool follows = other->piece == self->piece + 1;
    bool around = m->closed && self->piece == 0 && other->piece == m->pieces - 1;
    if (follows || around) {
        m->found = (follows && folds_back(self, other, m->xy)) ||
                   (around && folds_back(other, self, m->xy));
    } else {
        m->found = hm_plane_meet_at(self->a, self->b, other->a, other->b, m->xy);
    }
    return !m->found;
}

enum hm_err hm_polyline_crosses_itself(const struct hm_line *line, bool *crosses, double xy[2],
                                       struct hm_diag *d)
{
    *crosses = false;
    size_t pieces = hm_polyline_pieces(line), n = 0;
    struct hm_segment *s = hm_alloc(pieces, sizeof *s);
    struct hm_segindex *x = NULL;
    if (!s)
        return hm_fail_memory(d);
    for (size_t k = 0; k < pieces; k++) {
        const double *a = hm_polyline_from(line, k), *b = hm_polyline_to(line, k);
        if (a[0] == b[0] && a[1] == b[1])
            continue;
        memcpy(s[n].a, a, sizeof s[n].a);
        memcpy(s[n].b, b, sizeof s[n].b);
        s[n].line = 0;
        s[n].piece = (int32_t)n;
        n++;
    }
    enum hm_err err = hm_segindex_build(&x, s, n, d);
    struct meeting m = {.pieces = (int32_t)n, .closed = line->closed};
    for (size_t k = 0; !err && k < n && !m.found; k++) {
        double lo[2], hi[2];
        for (int c = 0; c < 2; c++) {
            lo[c] = fmin(s[k].a[c], s[k].b[c]);
            hi[c] = fmax(s[k].a[c], s[k].b[c]);
        }
        m.self = &s[k];
        hm_segindex_box(x, lo, hi, meets_other, &m);
    }
    if (m.found) {
        *crosses = true;
        xy[0] = m.xy[0];
        xy[1] = m.xy[1];
    }
    hm_segindex_free(x);
    free(s);
    return err;
}
