// bench_refine: hm_tri_refine against CGAL's Delaunay_mesher_2, from points and segments to the
// mesh, without input and output.
//
//     bench_refine [-q] [river.poly]      -q: nothing under 22 m2
//
// bench.hh says how to read the table. Below the times: how many triangles we make, against what
// Triangle makes for the same bounds, and how many are under the angle though the input is not.

#include "bench.hh"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <malloc.h>

extern "C" {
#include "hm_tri_refine.h"
}

namespace
{

using namespace bench;

using Vertex = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Face = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Store = CGAL::Triangulation_data_structure_2<Vertex, Face>;
// the river's segments cross in seven places
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Store, CGAL::Exact_predicates_tag>;

// A bound on areas: CGAL has one on lengths, and its criteria by area never end.
struct Criteria : CGAL::Delaunay_mesh_size_criteria_2<Constrained> {
    using Base = CGAL::Delaunay_mesh_size_criteria_2<Constrained>;
    double most;
    Criteria(double sine2, double area) : Base(sine2), most(area)
    {
    }
    struct Is_bad : Base::Is_bad {
        double most;
        Is_bad(const Criteria &c) : Base::Is_bad(c.bound(), 0, Kernel()), most(c.most)
        {
        }
        using Base::Is_bad::operator();
        CGAL::Mesh_2::Face_badness operator()(const Constrained::Face_handle &face,
                                              Quality &q) const
        {
            const Point &a = face->vertex(0)->point(), &b = face->vertex(1)->point();
            const Point &c = face->vertex(2)->point();
            double ab = CGAL::squared_distance(a, b), bc = CGAL::squared_distance(b, c);
            double ca = CGAL::squared_distance(c, a), area = CGAL::area(a, b, c);
            q.second = area / most;
            q.first = 4 * area * area / (std::max(ab, std::min(bc, ca)) * std::max(bc, ca));
            return (*this)(q);
        }
    };
    Is_bad is_bad_object() const
    {
        return Is_bad(*this);
    }
};
using Mesher = CGAL::Delaunay_mesher_2<Constrained, Criteria>;

struct Domain {
    Cloud cloud;
    Segments segments;
    std::vector<Point> holes;
};

struct Bounds {
    double angle, area;
};

void check(hm_err err, const hm_diag &d)
{
    if (!err)
        return;
    fprintf(stderr, "bench_refine: %s\n", d.text);
    exit(2);
}

hm_tri *constrained(const Domain &domain)
{
    hm_tri *t;
    hm_diag d = {};
    check(hm_tri_build(&t, domain.cloud.xy.data(), domain.cloud.size(), 2, 1, &d), d);
    std::vector<hm_tri_segment> s;
    for (auto &ends : domain.segments)
        s.push_back({hm_tri_of_input(t, ends.first), hm_tri_of_input(t, ends.second), 1});
    check(hm_tri_constrain(t, s.data(), s.size(), nullptr, &d), d);
    int32_t beyond = 0;
    while (hm_tri_is_solid(t, beyond))
        beyond++;
    check(hm_tri_flood(t, beyond, 1, -1, &d), d);
    for (const Point &hole : domain.holes)
        check(hm_tri_flood(t, hm_tri_locate(t, hole.x(), hole.y(), nullptr), 1, -1, &d), d);
    return t;
}

hm_tri *refined(const Domain &domain, Bounds bounds, hm_tri_refined *done)
{
    hm_diag d = {};
    hm_tri *t = constrained(domain);
    hm_tri_quality q = {};
    q.min_angle = bounds.angle;
    q.max_area = bounds.area;
    q.outside = -1;
    q.hull_marks = 1;
    check(hm_tri_refine(t, &q, done, &d), d);
    return t;
}

Work ours(const Domain &domain, Bounds bounds)
{
    return [&domain, bounds](clockid_t clock) {
        double start = now(clock);
        hm_tri *t = refined(domain, bounds, nullptr);
        double took = now(clock) - start;
        hm_tri_free(t);
        return took;
    };
}

Work cgal(const Domain &domain, Bounds bounds)
{
    return [&domain, bounds](clockid_t clock) {
        double sine = std::sin(bounds.angle * std::acos(-1.0) / 180);
        double start = now(clock);
        Constrained t;
        t.insert_constraints(domain.cloud.points.begin(), domain.cloud.points.end(),
                             domain.segments.begin(), domain.segments.end());
        Mesher mesher(t, Criteria(sine * sine, bounds.area));
        mesher.set_seeds(domain.holes.begin(), domain.holes.end());
        mesher.refine_mesh();
        return now(clock) - start;
    };
}

// --- what came out ---

void count_line(const std::string &name, long value, long most)
{
    printf("%-34s %9ld %9s    %6s  %6ld", name.c_str(), value, "", "", most);
    verdict(value <= most, false);
}

void result(const Domain &domain, Bounds bounds, int most)
{
    hm_tri_refined done;
    hm_tri *t = refined(domain, bounds, &done);
    int triangles = 0;
    for (int32_t k = 0; k < hm_tri_triangles(t); k++)
        triangles += hm_tri_is_solid(t, k) && hm_tri_region(t, k) != -1;
    std::string angle = std::to_string(static_cast<int>(bounds.angle)) + " degrees";
    count_line("triangles at " + angle, triangles, most);
    count_line("  under it, not the input's own", done.small - done.given, 0);
    hm_tri_free(t);
}

} // namespace

int main(int argc, char **argv)
{
    mallopt(M_MMAP_THRESHOLD, 1 << 20); // fresh memory for every run, as for a program of its own
    bool quick = argc > 1 && !strcmp(argv[1], "-q");
    const char *poly = argc > 1 + quick ? argv[1 + quick] : "river.poly";
    Domain domain;
    if (!read_poly(poly, domain.cloud, domain.segments, &domain.holes)) {
        printf("skipped: %s cannot be read\n", poly);
        return 0;
    }
    header();
    compare("river, 30 degrees, 22 m2", 0.09, ours(domain, {30, 22}), cgal(domain, {30, 22}));
    result(domain, {20, 22}, 338069);
    result(domain, {30, 22}, 346689);
    result(domain, {33, 22}, 380621);
    if (!quick)
        compare("river, 30 degrees, 2.2 m2", 0.04, ours(domain, {30, 2.2}), cgal(domain, {30, 2.2}),
                CLOCK_PROCESS_CPUTIME_ID, 1);
    return summary();
}
