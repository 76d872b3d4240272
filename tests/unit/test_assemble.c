/* hm_assemble and hm_paper: what must hold of every irregular mesh, on inputs made for it: it
 * covers its domain once, keeps the boundaries of regular meshes and every piece of every
 * breakline, is constrained Delaunay, and lies on the terrain. */
#include "hm_assemble.h"
#include "hm_attr.h"
#include "hm_meshcheck.h"
#include "hm_paper.h"
#include "hm_polyline.h"
#include "meshes.h"
#include "tap.h"

static uint64_t state = 3;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

static double plane(double x, double y)
{
    return 10 + 0.125 * x - 0.0625 * y;
}

/* --- a case: inputs, and what comes out --- */

struct trial {
    struct hm_points points;
    struct hm_lines lines;
    struct hm_mesh regular;
    struct hm_terrain *terrain;
    struct hm_domain dom;
    struct hm_assembly_counts counts;
    struct hm_paper_left left;
    struct hm_mesh mesh;
    struct hm_diag d;
};

/* n measurements of the plane in [0, 200] × [0, 100]. */
static void start(struct trial *c, int n)
{
    *c = (struct trial){0};
    hm_header_init(&c->points.header, HM_POINTS, NULL);
    for (int i = 0; i < n; i++) {
        double x = 200 * uniform(), y = 100 * uniform();
        hm_points_append(&c->points, (double[3]){x, y, plane(x, y)}, NULL);
    }
    struct hm_inputs in = {.points = &c->points, .npoints = 1};
    struct hm_terrain_counts counts;
    hm_terrain_build(&c->terrain, &in, 0, 1, &counts, NULL);
}

static void add_line(struct trial *c, const char *attrs, const double *xy, size_t n)
{
    double xyz[3 * 64];
    for (size_t i = 0; i < n; i++) {
        xyz[3 * i] = xy[2 * i];
        xyz[3 * i + 1] = xy[2 * i + 1];
        xyz[3 * i + 2] = *attrs ? 0 : plane(xy[2 * i], xy[2 * i + 1]);
    }
    struct hm_line line = {
        .attrs = (char *)attrs, .xyz = xyz, .n = n, .closed = hm_attr_flag(attrs, "closed")};
    hm_lines_append(&c->lines, &line, NULL);
}

static enum hm_err assemble(struct trial *c, double clearance)
{
    const struct hm_assembly in = {.points = &c->points,
                                   .lines = &c->lines,
                                   .meshes = &c->regular,
                                   .npoints = 1,
                                   .nlines = 1,
                                   .nmeshes = c->regular.nelems > 0,
                                   .terrain = c->terrain,
                                   .clearance = clearance,
                                   .threads = 2};
    return hm_assemble(&in, &c->dom, &c->counts, &c->d);
}

/* The whole way; most 0: all measurements stay. */
static bool run(struct trial *c, double least, double most)
{
    enum hm_err err = assemble(c, most > 0 ? least / 2 : 0.5);
    const struct hm_paper_options o = {
        .bounds = {least, most, least / 2}, .smooth = 3, .threads = 2};
    if (!err && most > 0)
        err = hm_paper_reach(&c->dom, &o, &c->left, &c->d);
    if (!err)
        err = hm_domain_mesh(&c->dom, &c->mesh, &c->d);
    return ok(err == HM_OK, "it is made: %s", c->d.text);
}

static void stop(struct trial *c)
{
    hm_points_free(&c->points);
    hm_lines_free(&c->lines);
    hm_mesh_free(&c->regular);
    hm_terrain_free(c->terrain);
    hm_domain_free(&c->dom);
    hm_mesh_free(&c->mesh);
}

/* --- claims --- */

static double area(const struct hm_mesh *m)
{
    double sum = 0;
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_node *a = &m->node[m->elem[k].node[0]], *b = &m->node[m->elem[k].node[1]],
                             *c = &m->node[m->elem[k].node[2]];
        sum += ((b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x)) / 2;
    }
    return sum;
}

static int32_t node_at(const struct hm_mesh *m, const double *xy)
{
    for (size_t i = 0; i < m->nnodes; i++)
        if (m->node[i].x == xy[0] && m->node[i].y == xy[1])
            return (int32_t)i;
    return -1;
}

/* Is p q a chain of edges? From node to node along it, each at most 1e-9 m beside. */
static bool is_chain(const struct hm_mesh *m, const double *p, const double *q)
{
    int32_t at = node_at(m, p), end = node_at(m, q);
    double length = hypot(q[0] - p[0], q[1] - p[1]), here = 0;
    while (at >= 0 && end >= 0 && at != end) {
        int32_t next = -1;
        double farther = here;
        for (size_t k = 0; k < m->nelems && next < 0; k++)
            for (int i = 0; i < 3 && next < 0; i++) {
                int32_t a = m->elem[k].node[i], b = m->elem[k].node[(i + 1) % 3];
                if (b == at) { /* border edges are there in one direction only */
                    b = a;
                    a = at;
                }
                if (a != at)
                    continue;
                double w[2] = {m->node[b].x - p[0], m->node[b].y - p[1]};
                double along = (w[0] * (q[0] - p[0]) + w[1] * (q[1] - p[1])) / length;
                double beside = (w[1] * (q[0] - p[0]) - w[0] * (q[1] - p[1])) / length;
                if (fabs(beside) < 1e-9 && along > here && along < length + 1e-9) {
                    next = b;
                    farther = along;
                }
            }
        at = next;
        here = farther;
    }
    return at >= 0 && at == end;
}

static bool is_line_kept(const struct hm_mesh *m, const double *xy, size_t n, bool closed)
{
    for (size_t i = 0; i + !closed < n; i++)
        if (!is_chain(m, xy + 2 * i, xy + 2 * ((i + 1) % n)))
            return false;
    return true;
}

/* What holds whatever the input. */
static void check_mesh(struct trial *c, double want_area)
{
    struct hm_meshcheck check;
    ok(hm_meshcheck_run(&c->mesh, &check, NULL) == HM_OK && hm_meshcheck_is_valid(&check, true),
       "a mesh that solvers accept");
    near(area(&c->mesh) / want_area, 1, 1e-9, "covers its domain once");
    ok(hm_tri_check_delaunay(c->dom.tri, &c->d) == HM_OK, "constrained Delaunay");
    double worst = 0;
    for (size_t i = 0; i < c->mesh.nnodes; i++) {
        const struct hm_node *n = &c->mesh.node[i];
        worst = fmax(worst, fabs(n->z - plane(n->x, n->y)));
    }
    near(worst, 0, 1e-9, "a plane stays a plane");
}

/* Each edge of the regular mesh's boundary is one edge here, nodes equal to the last bit. */
static void check_seam(const struct trial *c)
{
    struct hm_mesh_loops l;
    hm_mesh_boundary(&c->regular, &l, NULL);
    int64_t edges = 0, kept = 0;
    for (size_t k = 0; k < l.nloops; k++)
        for (size_t i = l.start[k]; i < l.start[k + 1]; i++, edges++) {
            size_t j = i + 1 < l.start[k + 1] ? i + 1 : l.start[k];
            const struct hm_node *p = &c->regular.node[l.node[i]];
            const struct hm_node *q = &c->regular.node[l.node[j]];
            int32_t a = node_at(&c->mesh, (double[2]){p->x, p->y});
            int32_t b = node_at(&c->mesh, (double[2]){q->x, q->y});
            bool same = a >= 0 && c->mesh.node[a].z == p->z && c->mesh.node[a].owner == p->owner &&
                        (c->mesh.node[a].flags & HM_NODE_FIXED);
            for (size_t e = 0; e < c->mesh.nelems && same; e++)
                for (int n = 0; n < 3; n++)
                    kept += c->mesh.elem[e].node[n] == b && c->mesh.elem[e].node[(n + 1) % 3] == a;
        }
    ok(edges > 0 && kept == edges, "the seam is shared node by node, edge by edge");
    hm_mesh_loops_free(&l);
}

/* --- cases --- */

static const double outline[] = {10, 10, 190, 10, 190, 90, 10, 90};

static void test_lines(double least, double most)
{
    static const double one[] = {20.5, 20.25, 60.1, 70.7, 120.3, 30.9, 180.2, 80.4};
    static const double two[] = {20.3, 60.2, 100.9, 65.8, 180.6, 20.1};
    static const double ring[] = {90.1, 72.2, 110.3, 74.4, 105.7, 84.9};
    static const double leaving[] = {150, 50.3, 230, 55.1};
    struct trial c;
    start(&c, 3000);
    add_line(&c, "boundary=1 closed=1", outline, 4);
    add_line(&c, "", one, 4);
    add_line(&c, "", two, 3);
    add_line(&c, "", two, 2); /* half of it once more */
    add_line(&c, "closed=1", ring, 3);
    c.lines.line[4].xyz[2] = c.lines.line[4].xyz[5] = c.lines.line[4].xyz[8] = NAN;
    add_line(&c, "", leaving, 2);
    add_line(&c, "string=inflow", leaving, 2);
    if (run(&c, least, most)) {
        check_mesh(&c, 180 * 80);
        ok(is_line_kept(&c.mesh, outline, 4, true), "the outline is kept");
        ok(is_line_kept(&c.mesh, one, 4, false) && is_line_kept(&c.mesh, two, 3, false) &&
               is_line_kept(&c.mesh, ring, 3, true),
           "every piece of every breakline is a chain of edges");
        ok(c.counts.crossings >= 3 && c.counts.overlaps > 0, "crossings and overlaps are counted");
        near(c.counts.outside_length, 40 * hypot(80, 4.8) / 80, 1e-9,
             "so is what left the outline");
        ok(c.counts.line_heights == 3, "and vertices without height");
        ok(c.counts.breaklines == 5 && c.counts.idle_holes == 0, "of five breaklines");
    }
    stop(&c);
}

static void test_river(double least, double most)
{
    /* along the regular mesh, 0.3 m off, and then away from it */
    static const double hugging[] = {30, 40.3, 150, 40.3, 170, 80};
    struct trial c;
    start(&c, 3000);
    lattice(&c.regular, 40, 160, 24, 30, 40, 3, true);
    for (size_t i = 0; i < c.regular.nnodes; i++) {
        c.regular.node[i].z = plane(c.regular.node[i].x, c.regular.node[i].y);
        c.regular.node[i].owner = 2;
    }
    add_line(&c, "boundary=1 closed=1", outline, 4);
    add_line(&c, "", hugging, 3);
    if (run(&c, least, most)) {
        check_mesh(&c, 180 * 80 - 120 * 10);
        check_seam(&c);
        ok(c.counts.cut_lines == 1 && c.counts.near_length > 100, "a hugging breakline is cut");
        ok(c.counts.near_points > 0, "measurements at the seam are left out");
    }
    stop(&c);
}

/* An outline that crosses the regular mesh between its nodes is bent to the nearest ones. */
static void test_crossing_outline(void)
{
    static const double half[] = {10, 10, 101.7, 10, 101.7, 90, 10, 90};
    struct trial c;
    start(&c, 3000);
    lattice(&c.regular, 40, 160, 24, 30, 40, 3, true);
    for (size_t i = 0; i < c.regular.nnodes; i++)
        c.regular.node[i].z = plane(c.regular.node[i].x, c.regular.node[i].y);
    add_line(&c, "boundary=1 closed=1", half, 4);
    if (run(&c, 3, 8))
        check_mesh(&c, 91.7 * 80 - 60 * 10 - 1.7 * (20 / 2.0 + 10 + 50 / 2.0));
    stop(&c);
}

/* Where two outlines touch along an edge there is no border. */
static void test_neighbours(void)
{
    static const double west[] = {10, 10, 100.1, 10, 100.1, 90, 10, 90};
    static const double east[] = {100.1, 10, 190, 10, 190, 90, 100.1, 90};
    struct trial c;
    start(&c, 3000);
    add_line(&c, "boundary=1 closed=1", west, 4);
    add_line(&c, "boundary=1 closed=1", east, 4);
    if (run(&c, 0, 0)) {
        check_mesh(&c, 180 * 80);
        ok(!is_line_kept(&c.mesh, (double[]){100.1, 10, 100.1, 90}, 2, false),
           "two outlines with a common edge make one domain");
    }
    stop(&c);
}

static void test_areas(void)
{
    static const double island[] = {40, 30, 80, 30, 80, 60, 40, 60};
    static const double hole[] = {100, 40, 110, 40, 110, 50, 100, 50};
    static const double far_off[] = {300, 40, 310, 40, 310, 50};
    static const double forest[] = {120, 5, 170, 5, 170, 50, 120, 50};
    struct trial c;
    start(&c, 2000);
    add_line(&c, "boundary=1 closed=1", outline, 4);
    add_line(&c, "boundary=1 closed=1", island, 4);
    add_line(&c, "hole=1 closed=1", hole, 4);
    add_line(&c, "hole=1 closed=1", far_off, 3);
    add_line(&c, "region=7 closed=1", forest, 4);
    if (run(&c, 3, 8)) {
        check_mesh(&c, 180 * 80 - 40 * 30 - 10 * 10);
        double wooded = 0;
        for (size_t k = 0; k < c.mesh.nelems; k++) {
            struct hm_mesh one = c.mesh;
            one.elem += k;
            one.nelems = c.mesh.elem[k].region == 7;
            wooded += area(&one);
        }
        near(wooded, 50 * 40, 1e-6, "the region inside the outline has its number");
        ok(c.counts.idle_holes == 1, "a hole outside the outline is counted");
    }
    stop(&c);
}

static void test_lengths(void)
{
    struct trial c;
    start(&c, 20000);
    if (run(&c, 4, 10)) {
        struct hm_mesh_edge *edge;
        size_t n;
        int64_t outside = 0;
        hm_mesh_edges(&c.mesh, &edge, &n, NULL);
        for (size_t k = 0; k < n; k++) {
            const struct hm_node *a = &c.mesh.node[edge[k].a], *b = &c.mesh.node[edge[k].b];
            double length = hypot(a->x - b->x, a->y - b->y);
            outside += edge[k].right >= 0 && (length < 4 || length > 10);
        }
        ok(c.left.too_short == c.left.too_short_fixed && c.left.too_long == 0,
           "no free edge under the minimum, none over the maximum: %d, %d between fixed nodes; %d",
           (int)c.left.too_short, (int)c.left.too_short_fixed, (int)c.left.too_long);
        ok(outside == c.left.too_short + c.left.too_long, "what is left is what was counted");
        free(edge);
    }
    stop(&c);
}

/* Lines of all directions across each other, one with a neighbour 1e-9 m off, a spiral outline. */
static void test_tangle(double least, double most)
{
    enum { LINES = 25 };
    double line[LINES + 1][6], spiral[2 * 48], turn2 = 0;
    struct trial c;
    start(&c, 4000);
    for (int i = 0; i < 48; i++) { /* two arms of a band, 12 m wide, wound around (100, 50) */
        double turn = 0.25 * (i < 24 ? i : 47 - i), r = 14 + 5 * turn + (i < 24 ? 6 : -6);
        spiral[2 * i] = 100 + 2 * r * cos(turn);
        spiral[2 * i + 1] = 50 + r * sin(turn);
    }
    for (int i = 0; i < 48; i++) {
        const double *a = spiral + 2 * i, *b = spiral + 2 * ((i + 1) % 48);
        turn2 += a[0] * b[1] - b[0] * a[1];
    }
    add_line(&c, "boundary=1 closed=1", spiral, 48);
    for (int k = 0; k < LINES; k++) {
        for (int i = 0; i < 6; i++)
            line[k][i] = i % 2 ? 30 + 40 * uniform() : 60 + 80 * uniform();
        add_line(&c, "", line[k], 3);
    }
    for (int i = 0; i < 6; i++)
        line[LINES][i] = line[0][i] + (i % 2 ? 1e-9 : 0);
    add_line(&c, "", line[LINES], 3);
    if (run(&c, least, most)) {
        check_mesh(&c, fabs(turn2) / 2);
        ok(is_line_kept(&c.mesh, spiral, 48, true), "the spiral is kept");
        ok(c.counts.crossings > 50, "a tangle of %d crossings", (int)c.counts.crossings);
        double kept = 0;
        for (size_t k = 0; k < c.dom.nedges; k++)
            if (c.dom.edge[k].marks & HM_EDGE_BREAKLINE)
                kept += sqrt(
                    hm_node_distance2(&c.dom.node[c.dom.edge[k].a], &c.dom.node[c.dom.edge[k].b]));
        near(kept + c.counts.outside_length, c.counts.length, 1e-6, "no piece of a line is lost");
    }
    stop(&c);
}

/* --- refusals --- */

static void refuse(struct trial *c, const char *pattern, bool place, const char *what)
{
    enum hm_err err = assemble(c, 1);
    ok(err == HM_EGEOM && strstr(c->d.text, pattern) && c->d.has_place == place, "%s: %s", what,
       c->d.text);
    stop(c);
}

static void test_refusals(void)
{
    static const double bow[] = {10, 10, 190, 90, 190, 10, 10, 90};
    static const double touching[] = {10, 10, 190, 10, 190, 90, 100, 10, 10, 90};
    static const double elsewhere[] = {500, 500, 600, 500, 600, 600};
    struct trial c;
    start(&c, 100);
    add_line(&c, "boundary=1 closed=1", bow, 4);
    refuse(&c, "meets itself", true, "an outline that crosses itself");
    start(&c, 100);
    add_line(&c, "boundary=1 closed=1", touching, 5);
    refuse(&c, "meets itself", true, "an outline that touches itself");
    start(&c, 100);
    add_line(&c, "hole=1", outline, 4);
    refuse(&c, "not a closed line", true, "an open hole");
    start(&c, 100);
    add_line(&c, "boundary=1 closed=1", elsewhere, 3);
    refuse(&c, "no measurement", true, "no measurement inside");
    start(&c, 100);
    add_line(&c, "hole=1 closed=1", (double[]){-1, -1, 201, -1, 201, 101, -1, 101}, 4);
    refuse(&c, "no ground", false, "a hole over everything");
    start(&c, 100);
    lattice(&c.regular, 40, 80, 4, 30, 60, 3, true);
    lattice(&c.regular, 60, 100, 4, 45.5, 70, 3, true);
    refuse(&c, "crosses itself", true, "a regular mesh whose boundary crosses itself");
}

int main(void)
{
    test_lines(3, 8);
    test_lines(0, 0);
    test_river(3, 8);
    test_river(1.25, 3); /* edges of the regular mesh are over the maximum */
    test_river(0, 0);
    test_tangle(2, 5);
    test_tangle(0, 0);
    test_areas();
    test_crossing_outline();
    test_neighbours();
    test_lengths();
    test_refusals();
    return done();
}
