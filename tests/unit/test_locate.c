/* Location against brute force; heights against the surfaces that elements reproduce exactly. */
#include "hm_locate.h"

#include "hm_boxtree.h"
#include "hm_places.h"
#include "meshes.h"
#include "tap.h"

#include <stdint.h>

static double random01(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static int64_t slowly(const struct hm_mesh *m, double x, double y)
{
    for (size_t i = 0; i < m->nelems; i++)
        if (hm_elem_holds(m, &m->elem[i], x, y))
            return (int64_t)i;
    return -1;
}

static void compare(const struct hm_mesh *m, const char *name)
{
    struct hm_locate *x;
    hm_locate_build(&x, m, NULL);
    bool same = true;
    for (int i = 0; i < 2000; i++) {
        double px = random01() * 14 - 2, py = random01() * 14 - 2;
        same &= hm_locate_element(x, px, py) == slowly(m, px, py);
    }
    for (size_t i = 0; i < m->nnodes; i++) /* nodes: on the border of several */
        same &= hm_locate_element(x, m->node[i].x, m->node[i].y) ==
                slowly(m, m->node[i].x, m->node[i].y);
    ok(same, "location in %s is that of a look at all", name);
    hm_locate_free(x);
}

static void location(void)
{
    struct hm_mesh m = {0};
    compare(&m, "an empty mesh");
    lattice(&m, 0, 10, 17, 0, 10, 9, false);
    compare(&m, "triangles");
    lattice(&m, 3, 7, 5, 3, 12, 6, true);
    compare(&m, "a mesh over another");
    for (int i = 0; i < 300; i++) /* a thousand times finer in a corner */
        lattice(&m, 9 + i * 1e-5, 9 + (i + 1) * 1e-5, 1, 9, 9.001, 1, true);
    compare(&m, "elements of very different size");
    empty(&m);
}

static void heights(void)
{
    struct hm_mesh m = {0};
    double worst = 0;
    for (int i = 0; i < 500; i++) {
        bool parallelogram = i % 5 == 0, trapezoid = i % 5 == 1;
        double x[4] = {0, 4, 4, 0}, y[4] = {0, 0, 3, 3};
        for (int k = 0; k < 4; k++) {
            x[k] += random01() * 1.2;
            y[k] += random01() * 1.2;
        }
        if (parallelogram) {
            x[2] = x[1] + x[3] - x[0];
            y[2] = y[1] + y[3] - y[0];
        }
        if (trapezoid)
            y[1] = y[0], y[2] = y[3];
        for (int k = 0; k < 4; k++)
            node(&m, 1000 + x[k], 1000 + y[k], 3 * x[k] - 2 * y[k] + 7);
        element(&m, 0, 1, 2, 3);
        double s = random01(), t = random01();
        double px =
            (1 - s) * (1 - t) * x[0] + s * (1 - t) * x[1] + s * t * x[2] + (1 - s) * t * x[3];
        double py =
            (1 - s) * (1 - t) * y[0] + s * (1 - t) * y[1] + s * t * y[2] + (1 - s) * t * y[3];
        worst = fmax(
            worst, fabs(hm_elem_height(&m, m.elem, 1000 + px, 1000 + py) - (3 * px - 2 * py + 7)));
        /* and a twisted surface: z = s·t at the point of parameters s, t */
        m.node[0].z = m.node[1].z = m.node[3].z = 0;
        m.node[2].z = 1;
        worst = fmax(worst, fabs(hm_elem_height(&m, m.elem, 1000 + px, 1000 + py) - s * t));
        empty(&m);
    }
    ok(worst < 1e-10, "quadrilaterals reproduce planes and their own bilinear surface");
    node(&m, 0, 0, 1);
    node(&m, 4, 0, 5);
    node(&m, 0, 2, 7);
    element(&m, 0, 1, 2, -1);
    near(hm_elem_height(&m, m.elem, 1, 1), 1 + 1 + 3, 1e-15, "a triangle is a plane");
    near(hm_elem_area(&m, m.elem), 4, 0, "area");
    double least, most;
    hm_elem_angles(&m, m.elem, &least, &most);
    near(least, 26.565051177077990, 1e-12, "least angle");
    near(most, 90, 1e-12, "largest angle");
    near(hm_elem_edge_ratio(&m, m.elem), sqrt(5), 1e-15, "edge ratio");
    empty(&m);
}

static void overlap(void)
{
    struct hm_mesh m = {0};
    lattice(&m, 0, 2, 2, 0, 1, 1, true);
    ok(!hm_elem_overlap(&m, &m.elem[0], &m, &m.elem[1]), "neighbours do not overlap");
    ok(hm_elem_overlap(&m, &m.elem[0], &m, &m.elem[0]), "an element overlaps itself");
    m.node[4].x = nextafter(1, 2); /* of the border between them, for the left one alone */
    int32_t own = node(&m, nextafter(1, 0), 1, 0);
    m.elem[1].node[3] = own;
    ok(hm_elem_overlap(&m, &m.elem[0], &m, &m.elem[1]), "one last bit is an overlap");
    empty(&m);
}

static void places(void)
{
    struct hm_places p = {0};
    bool good = hm_places_get(&p, 1, 2) == -1;
    for (int i = 0; i < 5000; i++)
        good &= hm_places_put(&p, i % 100, i / 100 * 0.5, i) == i;
    for (int i = 0; i < 5000; i++)
        good &= hm_places_put(&p, i % 100, i / 100 * 0.5, 7) == i;
    ok(good && hm_places_get(&p, -0.0, 0.0) == 0 && hm_places_get(&p, nextafter(1, 2), 0) == -1,
       "places are told apart by every bit, but for the sign of zero");
    hm_places_free(&p);
}

int main(void)
{
    location();
    heights();
    overlap();
    places();
    return done();
}
