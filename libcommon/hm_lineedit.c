#include "hm_lineedit.h"

#include "hm_plane.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hm_lineedit_tidy(struct hm_line *line)
{
    double *v = line->xyz;
    size_t n = 0;
    for (size_t k = 0; k < line->n; k++)
        if (n == 0 || !hm_plane_same(v + 3 * (n - 1), v + 3 * k))
            memmove(v + 3 * n++, v + 3 * k, 3 * sizeof *v);
    while (line->closed && n > 1 && hm_plane_same(v, v + 3 * (n - 1)))
        n--;
    line->n = n;
    if (n < 3)
        line->closed = false;
}

/* Bring p back to within `most` of its origin. */
static void hold(double *p, const double *origin, double most)
{
    double dx = p[0] - origin[0], dy = p[1] - origin[1], distance = hypot(dx, dy);
    if (distance > most) {
        p[0] = origin[0] + dx * (most / distance);
        p[1] = origin[1] + dy * (most / distance);
    }
}

static void smooth_once(const struct hm_line *line, const double *from, const double *origin,
                        double most)
{
    size_t n = line->n;
    for (size_t k = 0; k < n; k++) {
        if (!line->closed && (k == 0 || k + 1 == n))
            continue;
        const double *a = from + 3 * (k == 0 ? n - 1 : k - 1), *b = from + 3 * k;
        const double *c = from + 3 * (k + 1 == n ? 0 : k + 1);
        for (int x = 0; x < 3; x++)
            line->xyz[3 * k + (size_t)x] = (a[x] + 2 * b[x] + c[x]) / 4;
        hold(line->xyz + 3 * k, origin + 3 * k, most);
    }
}

enum hm_err hm_lineedit_smooth(struct hm_line *line, double most, struct hm_diag *d)
{
    enum { ROUNDS = 20 };
    if (line->n < 3)
        return HM_OK;
    size_t size = 3 * line->n * sizeof *line->xyz;
    double *origin = hm_alloc(2, size);
    if (!origin)
        return hm_fail_memory(d);
    double *from = origin + 3 * line->n;
    memcpy(origin, line->xyz, size);
    for (int round = 0; round < ROUNDS; round++) {
        memcpy(from, line->xyz, size);
        smooth_once(line, from, origin, most);
    }
    free(origin);
    return HM_OK;
}
