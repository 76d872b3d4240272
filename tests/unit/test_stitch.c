/* What stitching rests on: segments in the plane, borders, joining, owners, renumbering. */
#include "hm_border.h"
#include "hm_join.h"
#include "hm_owners.h"
#include "hm_plane.h"
#include "hm_rcm.h"
#include "meshes.h"
#include "tap.h"

static void segments(void)
{
    const double a[2] = {0, 0}, b[2] = {10, 0}, c[2] = {4, 3}, d[2] = {4, -1};
    const double e[2] = {4, 0}, f[2] = {12, 0}, g[2] = {14, 0};
    double middle[2] = {0};
    ok(hm_plane_meet(a, b, c, d) && hm_plane_cross(a, b, c, d), "two segments cross");
    ok(hm_plane_meet(a, b, c, e) && !hm_plane_cross(a, b, c, e), "a touch is no crossing");
    ok(hm_plane_meet(a, b, e, f) && !hm_plane_cross(a, b, e, f), "an overlap is no crossing");
    ok(!hm_plane_meet(a, b, f, g), "segments of one line may miss each other");
    near(hm_plane_meeting(c, d, a, b), 0.75, 1e-15, "where they meet");
    near(hm_plane_meeting(c, e, a, b), 1, 0, "exactly at an end");
    near(hm_plane_gap(a, b, f, g, middle), 2, 0, "the gap between two");
    near(middle[0], 11, 0, "and its middle");
    near(hm_plane_angle(a, b, c), 36.86989764584402, 1e-12, "an angle");
    near(hm_plane_distance(c, a, b), 3, 0, "distance within");
    near(hm_plane_distance(g, a, b), 4, 0, "distance beyond");
}

static void borders(void)
{
    struct hm_mesh m = {0};
    struct hm_border b;
    size_t edge;
    double at;
    lattice(&m, 0, 4, 4, 0, 2, 2, true);
    hm_border_build(&b, &m, NULL);
    const double west[2] = {-1, 0.5}, east[2] = {9, 0.5}, south[2] = {-1, 0}, far[2] = {2, 9};
    ok(b.n == 12 && b.longest == 1, "the border of a lattice");
    ok(hm_border_meeting(&b, west, east, false, &edge, &at) && at == 0.5 &&
           hm_border_from(&b, edge)[0] == 0,
       "the first place of a way through");
    ok(hm_border_meeting(&b, west, east, true, &edge, &at) && at == 0.5 &&
           hm_border_from(&b, edge)[0] == 4,
       "and the last");
    const double *p = NULL;
    bool found = hm_border_meeting(&b, south, (double[2]){1.5, 0}, false, &edge, &at);
    p = at > 0 ? hm_border_to(&b, edge) : hm_border_from(&b, edge);
    ok(found && (at == 0 || at == 1) && p[0] == 0 && p[1] == 0,
       "a way along an edge meets the border in a node");
    ok(!hm_border_meeting(&b, west, far, false, &edge, &at), "a way beside meets nothing");
    ok(hm_border_is_near(&b, far, 7.1, 0) && !hm_border_is_near(&b, far, 7, 0.5), "how near");
    hm_border_free(&b);
    empty(&m);
}

static void joining(void)
{
    struct hm_join j = {0};
    struct hm_joined joined = {0};
    struct hm_mesh a = {0}, b = {0};
    lattice(&a, 0, 2, 2, 0, 2, 2, true);
    lattice(&b, 2, 4, 2, 0, 2, 2, true);
    for (size_t i = 0; i < b.nnodes; i++)
        b.node[i].x += 0.004;
    node(&b, 9, 9, 0);
    hm_join_mesh(&j, &a, NULL, 0, NULL, &joined, NULL);
    hm_join_mesh(&j, &b, NULL, 0.01, NULL, &joined, NULL);
    ok(j.mesh.nnodes == 15 && joined.matched == 3 && joined.shared == 3 && joined.unused == 1,
       "three nodes match within the tolerance, one is of no use");
    near(joined.furthest, 0.004, 1e-12, "how far");
    hm_join_flag_boundary(&j.mesh, NULL);
    int flagged = 0;
    for (size_t i = 0; i < j.mesh.nnodes; i++)
        flagged += (j.mesh.node[i].flags & HM_NODE_BOUNDARY) != 0;
    ok(flagged == 12, "the boundary is flagged anew");
    hm_join_free(&j);
    empty(&a);
    empty(&b);
}

static void owners(void)
{
    struct hm_mesh m[3] = {0};
    char *names;
    for (int i = 0; i < 3; i++) {
        lattice(&m[i], i, i + 1, 1, 0, 1, 1, true);
        hm_header_init(&m[i].header, HM_MESH, NULL);
    }
    hm_header_set(&m[0].header, "owners", "a b", NULL);
    hm_header_set(&m[1].header, "owners", "c a", NULL);
    hm_header_set(&m[2].header, "role", "regular", NULL);
    hm_header_set(&m[2].header, "name", "d", NULL);
    m[0].node[0].owner = 1;
    m[1].node[0].owner = 2;
    m[1].node[1].owner = 1;
    enum hm_err err = hm_owners_join(m, 3, &names, NULL);
    ok(err == HM_OK && !strcmp(names, "a c d"), "the owners in use, by name: %s", names);
    ok(m[0].node[0].owner == 1 && m[1].node[0].owner == 1 && m[1].node[1].owner == 2 &&
           m[2].node[3].owner == 3 && m[1].node[3].owner == 0,
       "nodes are numbered by them");
    free(names);
    m[0].node[0].owner = -1;
    ok(hm_owners_join(m, 3, &names, NULL) == HM_EFORMAT, "a negative owner is refused");
    for (int i = 0; i < 3; i++) {
        hm_header_free(&m[i].header);
        empty(&m[i]);
    }
}

static void renumbering(void)
{
    struct hm_mesh m = {0};
    int32_t number[164];
    lattice(&m, 0, 40, 40, 0, 3, 3, true); /* numbered along: 42 apart */
    int64_t before = hm_rcm_bandwidth(&m);
    ok(hm_rcm_renumber(&m, number, NULL) == HM_OK && before == 42 && hm_rcm_bandwidth(&m) <= 8,
       "a strip gets a bandwidth near its width");
    bool plane = true, used[164] = {0};
    for (size_t i = 0; i < m.nnodes; i++) {
        plane = plane && m.node[i].z == m.node[i].x + 2 * m.node[i].y;
        used[(int)(m.node[i].x + 41 * m.node[i].y + 0.5)] = true;
    }
    for (int i = 0; i < 164; i++)
        plane = plane && used[i];
    ok(plane, "all nodes are there, each with its height");
    ok(m.node[number[43]].x == 2 && m.node[number[43]].y == 1, "it is said which is which");
    empty(&m);
    lattice(&m, 0, 2, 2, 0, 2, 2, false);
    lattice(&m, 5, 7, 2, 0, 2, 2, false);
    node(&m, 9, 9, 0);
    ok(hm_rcm_renumber(&m, number, NULL) == HM_OK && hm_rcm_bandwidth(&m) <= 5,
       "several pieces, and a node alone");
    empty(&m);
}

int main(void)
{
    segments();
    borders();
    joining();
    owners();
    renumbering();
    return done();
}
