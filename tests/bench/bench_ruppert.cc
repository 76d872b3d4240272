// bench_ruppert: what hm_ruppert, which is trimesh -m quality, adds to the time of the kernel's
// refinement: the domain around it, the sizes, and that new vertices become nodes and edges.
//
//     bench_ruppert [river.poly]
//
// bench.hh says how to read the table; the peer is hm_tri itself, from points and segments.

#include "bench.hh"

#include <cstdlib>
#include <malloc.h>

extern "C" {
#include "hm_ruppert.h"
}

namespace
{

using namespace bench;

struct Ground {
    Cloud cloud;
    Segments segments;
    std::vector<Point> holes;
};

void check(hm_err err, const hm_diag &d)
{
    if (!err)
        return;
    fprintf(stderr, "bench_ruppert: %s\n", d.text);
    exit(2);
}

hm_tri *constrained(const Ground &ground)
{
    hm_tri *t;
    hm_diag d = {};
    check(hm_tri_build(&t, ground.cloud.xy.data(), ground.cloud.size(), 2, 1, &d), d);
    std::vector<hm_tri_segment> s;
    for (auto &ends : ground.segments)
        s.push_back(
            {hm_tri_of_input(t, ends.first), hm_tri_of_input(t, ends.second), HM_EDGE_BORDER});
    check(hm_tri_constrain(t, s.data(), s.size(), nullptr, &d), d);
    int32_t beyond = 0;
    while (hm_tri_is_solid(t, beyond))
        beyond++;
    check(hm_tri_flood(t, beyond, HM_EDGE_BORDER, -1, &d), d);
    for (const Point &hole : ground.holes)
        check(
            hm_tri_flood(t, hm_tri_locate(t, hole.x(), hole.y(), nullptr), HM_EDGE_BORDER, -1, &d),
            d);
    return t;
}

// The nodes and edges of a triangulation, crossings mended.
hm_domain domain_of(const hm_tri *t)
{
    hm_domain dom = {};
    hm_diag d = {};
    for (int32_t v = 0; v < hm_tri_vertices(t); v++)
        check(hm_domain_add_node(&dom,
                                 {hm_tri_xy(t, v)[0], hm_tri_xy(t, v)[1], 0, HM_NODE_FIXED, 0}, &d),
              d);
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        int32_t twin = hm_tri_is_solid(t, e / 3) ? hm_tri_twin(t, e) : 0;
        if (!hm_tri_is_solid(t, e / 3) || !hm_tri_marks(t, e) ||
            (twin < e && hm_tri_is_solid(t, twin / 3)))
            continue;
        int32_t left = hm_tri_region(t, e / 3), right = hm_tri_region(t, twin / 3);
        check(hm_domain_add_edge(&dom,
                                 {hm_tri_org(t, e), hm_tri_dest(t, e), HM_EDGE_BORDER,
                                  left < 0 ? HM_OUTSIDE : 0, right < 0 ? HM_OUTSIDE : 0, 0},
                                 &d),
              d);
    }
    dom.nzones = 1;
    dom.zone = static_cast<hm_zone *>(calloc(1, sizeof *dom.zone));
    return dom;
}

double ours(const hm_tri *t, double angle, double area, clockid_t clock)
{
    hm_domain dom = domain_of(t);
    hm_sizes sizes = {};
    sizes.dom = &dom;
    sizes.max_area = area;
    hm_ruppert_options o = {};
    o.min_angle = angle;
    o.sizes = &sizes;
    o.threads = 1;
    hm_tri_refined left;
    hm_diag d = {};
    double start = now(clock);
    check(hm_ruppert_reach(&dom, &o, &left, &d), d);
    double took = now(clock) - start;
    hm_domain_free(&dom);
    return took;
}

double kernels(const Ground &ground, double angle, double area, clockid_t clock)
{
    hm_tri_quality q = {};
    q.min_angle = angle;
    q.max_area = area;
    q.outside = -1;
    q.hull_marks = 1;
    hm_diag d = {};
    double start = now(clock);
    hm_tri *t = constrained(ground);
    check(hm_tri_refine(t, &q, nullptr, &d), d);
    double took = now(clock) - start;
    hm_tri_free(t);
    return took;
}

} // namespace

int main(int argc, char **argv)
{
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    Ground ground;
    const char *poly = argc > 1 ? argv[1] : "river.poly";
    if (!read_poly(poly, ground.cloud, ground.segments, &ground.holes)) {
        printf("skipped: %s cannot be read\n", poly);
        return 0;
    }
    hm_tri *t = constrained(ground);
    printf("%-34s %9s %9s    %6s  %6s\n", "case", "ours", "hm_tri", "ratio", "goal");
    for (double area : {22.0, 2.2})
        compare(
            "river, 30 degrees, " + std::string(area > 10 ? "22" : "2.2") + " m2", 1.25,
            [=](clockid_t clock) { return ours(t, 30, area, clock); },
            [&ground, area](clockid_t clock) { return kernels(ground, 30, area, clock); });
    hm_tri_free(t);
    return summary();
}
