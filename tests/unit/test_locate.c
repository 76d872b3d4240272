/* Location against brute force; heights against the surfaces that elements reproduce exactly. */
#include "hm_locate.h"

#include "hm_boxtree.h"
#include "hm_places.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_rings.h"
#include "hm_walk.h"
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

/* Walks from anywhere end where a look at all does; borders are told by all edges without a right
 * side. */
static void walk(const struct hm_mesh *m, bool plane, const char *name)
{
    struct hm_walk *w;
    struct hm_mesh_edge *edge;
    size_t nedges;
    bool same = true, border = true;
    int32_t hint = 0;
    int on = 0;
    hm_mesh_edges(m, &edge, &nedges, NULL);
    hm_walk_build(&w, m, edge, nedges, plane, NULL);
    for (int i = 0; i < 4000; i++) {
        double p[2] = {random01() * 14 - 2, random01() * 14 - 2};
        if (i % 2) /* on the lattice: nodes, edges, the border */
            for (int k = 0; k < 2; k++)
                p[k] = round(p[k] * 2) / 2;
        int64_t e = hm_walk_element(w, p[0], p[1], &hint);
        same &= e == slowly(m, p[0], p[1]);
        if (e < 0)
            continue;
        bool is = false;
        for (size_t k = 0; k < nedges && plane; k++)
            is |= edge[k].right < 0 &&
                  hm_plane_holds(p, hm_mesh_xy(m, edge[k].a), hm_mesh_xy(m, edge[k].b));
        border &= !plane || is == hm_walk_on_border(w, e, p[0], p[1]);
        on += is;
    }
    ok(same, "walks in %s", name);
    ok(border && (!plane || on > 20), "points on the border of %s (%d)", name, on);
    hm_walk_free(w);
    free(edge);
}

static void walks(void)
{
    struct hm_mesh m = {0};
    lattice(&m, 0, 10, 20, 0, 10, 20, false);
    for (size_t i = 0; i < 60; i++) /* holes and loose corners */
        drop(&m, (size_t)(random01() * (double)m.nelems));
    walk(&m, true, "triangles with holes");
    empty(&m);
    lattice(&m, 0, 10, 10, 0, 10, 10, true);
    walk(&m, true, "quadrilaterals");
    lattice(&m, 3, 7, 5, 3, 12, 6, true);
    walk(&m, false, "a mesh over another");
    empty(&m);
}

/* The last ring that holds a point, by the even-odd rule over all pieces. */
static void rings(void)
{
    enum { RINGS = 40, VERTICES = 30 };
    static double xyz[RINGS][3 * VERTICES];
    struct hm_line ring[RINGS];
    for (int k = 0; k < RINGS; k++) {
        double cx = random01() * 10, cy = random01() * 10;
        ring[k] = (struct hm_line){.xyz = xyz[k], .n = VERTICES, .closed = true};
        for (int i = 0; i < VERTICES; i++) { /* stars on a lattice, so that exact hits are common */
            double turn = i * 2 * acos(-1) / VERTICES, r = 0.5 + 2 * random01();
            xyz[k][3 * i] = round(4 * (cx + r * cos(turn))) / 4;
            xyz[k][3 * i + 1] = round(4 * (cy + r * sin(turn))) / 4;
        }
    }
    struct hm_rings *r;
    hm_rings_build(&r, ring, RINGS, NULL);
    bool same = true;
    int found = 0;
    for (int i = 0; i < 4000; i++) {
        double x = round(random01() * 100) / 8 - 1, y = round(random01() * 100) / 8 - 1;
        int64_t last = -1;
        for (int k = 0; k < RINGS; k++)
            if (hm_polygon_side(&ring[k], x, y) >= 0)
                last = k;
        same &= hm_rings_find(r, x, y) == last;
        found += last >= 0;
    }
    ok(same && found > 1000 && found < 4000, "the last ring around a point");
    hm_rings_free(r);
    hm_rings_build(&r, NULL, 0, NULL);
    ok(hm_rings_find(r, 0, 0) == -1, "no rings");
    hm_rings_free(r);
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
    walks();
    rings();
    heights();
    overlap();
    places();
    return done();
}
