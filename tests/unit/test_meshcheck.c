/* Every fault that a mesh can have, alone and in its place; edges and loops of awkward meshes. */
#include "hm_meshcheck.h"

#include "meshes.h"
#include "tap.h"

/* The mesh has fault `what`, `count` times, and none but that and `also`. */
static void expect(struct hm_mesh *m, int what, int64_t count, unsigned also, const char *name)
{
    struct hm_meshcheck c;
    struct hm_diag d = {0};
    bool good = hm_meshcheck_run(m, &c, &d) == HM_OK;
    for (int k = 0; k < HM_FAULTS; k++)
        if (!(also & 1u << k) && c.count[k] != (k == what ? count : 0)) {
            printf("# %s: %lld\n", hm_mesh_fault_name((enum hm_mesh_fault)k),
                   (long long)c.count[k]);
            good = false;
        }
    ok(good, "%s", name);
    empty(m);
}

static void valid_meshes(void)
{
    struct hm_mesh m = {0};
    expect(&m, -1, 0, 0, "a mesh without elements has no fault");
    lattice(&m, 0, 10, 10, 0, 5, 5, false);
    expect(&m, -1, 0, 0, "a lattice of triangles is valid");
    lattice(&m, 1e6 + 0.1, 1e6 + 0.7, 7, 5e6 + 0.1, 5e6 + 0.2, 3, true);
    expect(&m, -1, 0, 0, "a lattice of quadrilaterals with large coordinates is valid");
    lattice(&m, 0, 3, 3, 0, 3, 3, true);
    drop(&m, 4);
    expect(&m, -1, 0, 0, "a hole in the middle is no fault");
}

static void faulty_elements(void)
{
    struct hm_mesh m = {0};
    lattice(&m, 0, 4, 4, 0, 4, 4, false);
    int32_t swap = m.elem[5].node[0];
    m.elem[5].node[0] = m.elem[5].node[1];
    m.elem[5].node[1] = swap;
    expect(&m, HM_FAULT_AREA, 1, 1u << HM_FAULT_EDGE | 1u << HM_FAULT_COMPONENTS,
           "a clockwise triangle");
    lattice(&m, 0, 1, 1, 0, 1, 1, false);
    m.node[3].x = 0;
    m.node[3].y = 0.5;
    m.node[2].y = 1;
    m.elem[1].node[1] = 3;
    expect(&m, HM_FAULT_AREA, 1, ~0u, "an element with a node twice");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    m.node[8].x = 1.4; /* the outer corner of the last element, pulled over its diagonal */
    m.node[8].y = 1.4;
    expect(&m, HM_FAULT_CONCAVE, 1, 0, "a concave quadrilateral");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    m.node[8].x = m.node[8].y = 1.5;
    expect(&m, HM_FAULT_CONCAVE, 1, 0, "a quadrilateral with a straight corner");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    m.node[4].z = NAN;
    m.node[5].z = INFINITY;
    expect(&m, HM_FAULT_HEIGHT, 2, 0, "heights missing and infinite");
}

static void faulty_nodes(void)
{
    struct hm_mesh m = {0};
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    node(&m, 7, 7, 0);
    expect(&m, HM_FAULT_ISOLATED, 1, 0, "an isolated node");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    lattice(&m, 2, 4, 2, 0, 2, 2, true);
    expect(&m, HM_FAULT_DUPLICATE, 3, 1u << HM_FAULT_COMPONENTS, "a seam that is not sewn");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    lattice(&m, 3, 4, 2, 0, 2, 2, true);
    expect(&m, HM_FAULT_COMPONENTS, 1, 0, "two pieces");
    lattice(&m, 0, 3, 3, 0, 3, 3, true);
    drop(&m, 8);
    drop(&m, 4);
    expect(&m, HM_FAULT_TOUCH, 1, 1u << HM_FAULT_ISOLATED, "two loops touch in a node");
}

static void hanging(double x0, double y0, double x1, double y1, const char *name)
{
    struct hm_mesh m = {0};
    double dx = x1 - x0, dy = y1 - y0;
    int32_t a = node(&m, x0, y0, 0), b = node(&m, x1, y1, 0);
    int32_t left = node(&m, x0 - dy, y0 + dx, 0), right = node(&m, x0 + dy, y0 - dx, 0);
    int32_t mid = node(&m, x0 + dx / 3, y0 + dy / 3, 0);
    element(&m, a, b, left, -1);
    element(&m, b, mid, right, -1);
    element(&m, mid, a, right, -1);
    expect(&m, HM_FAULT_HANGING, 1,
           1u << HM_FAULT_COMPONENTS | 1u << HM_FAULT_TOUCH | 1u << HM_FAULT_OVERLAP, name);
}

static void faulty_cover(void)
{
    struct hm_mesh m = {0};
    hanging(0, 0, 3, 0, "a node in the middle of an edge");
    hanging(512345.67, 5987654.32, 512352.11, 5987661.93,
            "a node beside a slanted edge by rounding");
    lattice(&m, 0, 2, 2, 0, 2, 2, true);
    lattice(&m, 1.5, 3.5, 2, 0.5, 1.5, 1, true);
    expect(&m, HM_FAULT_OVERLAP, 2, 1u << HM_FAULT_COMPONENTS, "two pieces overlap");
    lattice(&m, 0, 9, 1, 0, 9, 1, true);
    lattice(&m, 4, 5, 1, 4, 5, 1, true);
    expect(&m, HM_FAULT_OVERLAP, 1, 1u << HM_FAULT_COMPONENTS, "an element inside another");
    lattice(&m, 0, 3, 3, 0, 1, 1, true);
    const int32_t again[4] = {m.elem[1].node[0], m.elem[1].node[1], m.elem[1].node[2],
                              m.elem[1].node[3]};
    element(&m, again[0], again[1], again[2], again[3]);
    expect(&m, HM_FAULT_EDGE, 4, 1u << HM_FAULT_OVERLAP | 1u << HM_FAULT_DUPLICATE,
           "an element twice");
}

/* A spiral staircase of quadrilaterals that comes round over itself: all edges are in order. */
static void winding(void)
{
    struct hm_mesh m = {0};
    for (int i = 0; i <= 30; i++) {
        double angle = i * 0.3, inner = 5 + 0.01 * i;
        node(&m, inner * cos(angle), inner * sin(angle), 0);
        node(&m, (inner + 3) * cos(angle), (inner + 3) * sin(angle), 0);
    }
    for (int i = 0; i < 30; i++)
        element(&m, 2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    struct hm_meshcheck c;
    hm_meshcheck_run(&m, &c, NULL);
    ok(c.count[HM_FAULT_OVERLAP] > 5 && c.components == 1, "a ring that comes round over itself");
    ok(!hm_meshcheck_is_valid(&c, true), "… is not valid");
    empty(&m);
}

static void loops(void)
{
    struct hm_mesh m = {0};
    struct hm_mesh_loops l;
    struct hm_diag d = {0};
    lattice(&m, 0, 3, 3, 0, 3, 3, true);
    drop(&m, 8);
    drop(&m, 4);
    ok(hm_mesh_boundary(&m, &l, &d) == HM_OK && l.nloops == 1 && l.start[1] == 16,
       "a ring that lost its corner has one loop, through the pinched node twice");
    hm_mesh_loops_free(&l);
    empty(&m);

    lattice(&m, 0, 5, 5, 0, 5, 5, false);
    drop(&m, 25); /* the middle cell */
    drop(&m, 24);
    hm_mesh_boundary(&m, &l, &d);
    double area2[2] = {0};
    for (size_t k = 0; k < l.nloops; k++)
        for (size_t i = l.start[k], n = l.start[k + 1]; i < n; i++) {
            const struct hm_node *a = &m.node[l.node[i]];
            const struct hm_node *b = &m.node[l.node[i + 1 < n ? i + 1 : l.start[k]]];
            area2[k] += a->x * b->y - a->y * b->x;
        }
    ok(l.nloops == 2 && area2[0] == 50 && area2[1] == -2,
       "the outline runs counter-clockwise, a hole clockwise");
    hm_mesh_loops_free(&l);
    empty(&m);
}

static void edges(void)
{
    struct hm_mesh m = {0};
    struct hm_mesh_edge *e;
    size_t n;
    lattice(&m, 0, 4, 4, 0, 3, 3, false);
    hm_mesh_edges(&m, &e, &n, NULL);
    bool sorted = true, right = true;
    size_t boundary = 0;
    for (size_t i = 0; i < n; i++) {
        int32_t lo = e[i].a < e[i].b ? e[i].a : e[i].b, hi = e[i].a < e[i].b ? e[i].b : e[i].a;
        if (i > 0) {
            int32_t lo0 = e[i - 1].a < e[i - 1].b ? e[i - 1].a : e[i - 1].b;
            int32_t hi0 = e[i - 1].a < e[i - 1].b ? e[i - 1].b : e[i - 1].a;
            sorted &= lo0 < lo || (lo0 == lo && hi0 < hi);
        }
        const int32_t *c = m.elem[e[i].left].node;
        right &= (c[0] == e[i].a && c[1] == e[i].b) || (c[1] == e[i].a && c[2] == e[i].b) ||
                 (c[2] == e[i].a && c[0] == e[i].b);
        boundary += e[i].right == -1;
    }
    ok(n == 43 && boundary == 14, "Euler: 20 nodes, 24 triangles, 43 edges, 14 of them outside");
    ok(sorted, "edges are sorted");
    ok(right, "the left element runs through its edge forwards");
    free(e);
    empty(&m);
}

int main(void)
{
    valid_meshes();
    faulty_elements();
    faulty_nodes();
    faulty_cover();
    winding();
    loops();
    edges();
    return done();
}
