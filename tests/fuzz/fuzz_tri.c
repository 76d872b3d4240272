/* Any bytes as points, constraints and edits: the triangulation must stay sound after every step.
 *
 * The first byte chooses how coarse the plane is, the second how many points there are; then come
 * two bytes a point, and three a step: what to do, and to which. */
#include "hm_tri_refine.h"

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static void check(const struct hm_tri *t)
{
    if (hm_tri_check_topology(t, NULL) || hm_tri_check_delaunay(t, NULL))
        abort();
}

/* Small whole numbers; the same where doubles are no finer, or very large or small; or halves of
 * third powers, where next to nothing is in line. */
static double place(uint8_t kind, uint8_t byte)
{
    switch (kind % 5) {
    case 0:
        return byte % 16;
    case 1:
        return 0x1p52 + byte % 64;
    case 2:
        return ldexp(byte, 990);
    case 3:
        return ldexp(byte, -1074);
    default:
        return 0.1 * byte * byte * byte;
    }
}

static void step(struct hm_tri *t, const uint8_t *bytes, uint8_t kind)
{
    int32_t a = bytes[1] % hm_tri_vertices(t), b = bytes[2] % hm_tri_vertices(t), v;
    double x = place(kind, bytes[1]), y = place(kind, bytes[2]);
    struct hm_tri_segment s = {a, b, 1 + bytes[0] / 8};
    bool both = hm_tri_is_used(t, a) && hm_tri_is_used(t, b);
    int32_t edge = both ? hm_tri_edge_between(t, a, b) : HM_TRI_NONE;
    enum hm_err err = HM_OK;
    if (bytes[0] % 8 < 3 && both)
        err = hm_tri_constrain(t, &s, 1, NULL, NULL);
    else if (bytes[0] % 8 == 3 && edge != HM_TRI_NONE)
        err = hm_tri_unmark(t, edge, s.marks, NULL);
    else if (bytes[0] % 8 == 4)
        err = hm_tri_insert(t, x, y, HM_TRI_NONE, &v, NULL);
    else if (bytes[0] % 8 == 5)
        (void)hm_tri_remove(t, a, NULL);
    else if (bytes[0] % 8 == 6)
        (void)hm_tri_move(t, a, x, y, NULL);
    else if (bytes[0] % 8 == 7 && edge != HM_TRI_NONE)
        (void)hm_tri_split(t, edge, (hm_tri_xy(t, a)[0] + hm_tri_xy(t, b)[0]) / 2,
                           (hm_tri_xy(t, a)[1] + hm_tri_xy(t, b)[1]) / 2, &v, NULL);
    if (err)
        abort();
    check(t);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    double xy[2 * 64];
    if (n < 2)
        return 0;
    uint8_t kind = bytes[0];
    size_t points = bytes[1] % 64, at = 2;
    if (n < 2 + 2 * points)
        return 0;
    for (size_t i = 0; i < 2 * points; i++)
        xy[i] = place(kind, bytes[at++]);
    struct hm_tri *t;
    if (hm_tri_build(&t, xy, points, 2, 1, NULL))
        return 0;
    check(t);
    for (int steps = 0; steps < 100 && at + 3 <= n; steps++, at += 3)
        step(t, bytes + at, kind);
    struct hm_tri_quality q = {.min_angle = 20, .outside = -1, .hull_marks = 1, .most = 300};
    enum hm_err err = hm_tri_refine(t, &q, NULL, NULL);
    if (err && err != HM_EGEOM) /* that: too large or too small a plane */
        abort();
    check(t);
    hm_tri_free(t);
    return 0;
}
