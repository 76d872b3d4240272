// compare_cdt: small dirty drawings, triangulated by hm_tri and by CGAL.
//
//     compare_cdt [drawings [seed]]
//
// CGAL's constrained Delaunay triangulation is defined, and exact, where no two segments cross in
// their inside; points on segments, overlaps and duplicates are allowed. So each drawing is
// compared twice:
//
//   - without those segments that cross one before them: the same points and segments go into both;
//   - as it is: hm_tri leads the crossings through new vertices, and CGAL gets the vertices and
//     constrained edges that came out, which must not cross, nor have another vertex on them.
//
// Both triangulations must have the same edges, but for those between two triangles on one circle,
// of which there may be several good choices, and the same constraints. TAP.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

extern "C" {
#include "hm_tri.h"
}

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Peer = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Default, CGAL::No_constraint_intersection_requiring_constructions_tag>;

using Place = std::pair<double, double>;
using Edge = std::pair<Place, Place>; // the lower end first

struct Edges {
    std::set<Edge> sure, constrained; // sure: in every constrained Delaunay triangulation
    bool operator==(const Edges &other) const
    {
        return sure == other.sure && constrained == other.constrained;
    }
};

struct Drawing {
    std::vector<Place> points;
    std::vector<std::pair<size_t, size_t>> segments;
};

uint64_t state = 88172645463325252u;

uint64_t draw()
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

double uniform()
{
    return static_cast<double>(draw() >> 11) * 0x1p-53;
}

Point at(const Place &p)
{
    return {p.first, p.second};
}

Edge edge(const Place &a, const Place &b)
{
    return a < b ? Edge{a, b} : Edge{b, a};
}

bool on_circle(const Place &a, const Place &b, const Place &c, const Place &d)
{
    return CGAL::side_of_oriented_circle(at(a), at(b), at(c), at(d)) == CGAL::ON_ORIENTED_BOUNDARY;
}

// Do they cross, each in its inside? Exactly.
bool cross(const Drawing &g, size_t i, size_t k)
{
    Point a = at(g.points[g.segments[i].first]), b = at(g.points[g.segments[i].second]);
    Point c = at(g.points[g.segments[k].first]), d = at(g.points[g.segments[k].second]);
    return CGAL::orientation(a, b, c) * CGAL::orientation(a, b, d) < 0 &&
           CGAL::orientation(c, d, a) * CGAL::orientation(c, d, b) < 0;
}

// --- the drawings ---

const char *const kind_name[] = {"on a small grid", "anywhere",           "where doubles are whole",
                                 "along a line",    "of UTM centimetres", "of 1e100 and 1e-100"};
enum { KINDS = sizeof kind_name / sizeof kind_name[0] };

Place place(int kind, int range, double scale)
{
    double x = static_cast<double>(draw() % static_cast<uint64_t>(range));
    double y = static_cast<double>(draw() % static_cast<uint64_t>(range));
    switch (kind) {
    case 0:
        return {x, y};
    case 1:
        x = uniform();
        return {x, uniform()};
    case 2:
        return {0x1p52 + 8 * x, 0x1p52 + 8 * y};
    case 3:
        x = 545000 + 100 * uniform();
        return {x, 0.7 * x + static_cast<double>(draw() % 5) * 1e-10};
    case 4:
        return {545000 + 0.01 * x, 5972000 + 0.01 * y};
    default:
        return {x * scale, y * scale};
    }
}

Drawing make(int kind)
{
    Drawing g;
    size_t n = 3 + draw() % 37, m = draw() % 30;
    int range = 2 + static_cast<int>(draw() % (kind == 0 ? 8 : 60));
    double scale = draw() % 2 ? 1e100 : 1e-100;
    while (g.points.size() < n)
        g.points.push_back(place(kind, range, scale));
    while (g.segments.size() < m)
        g.segments.emplace_back(draw() % n, draw() % n);
    return g;
}

Drawing without_crossings(const Drawing &g)
{
    Drawing clean = {g.points, {}};
    for (auto &segment : g.segments) {
        clean.segments.push_back(segment);
        size_t last = clean.segments.size() - 1;
        for (size_t i = 0; i < last; i++)
            if (cross(clean, i, last)) {
                clean.segments.pop_back();
                break;
            }
    }
    return clean;
}

// --- ours ---

// NULL when all points lie on one line.
hm_tri *triangulate(const Drawing &g, int64_t *crossings)
{
    std::vector<double> xy;
    for (auto &p : g.points)
        xy.insert(xy.end(), {p.first, p.second});
    hm_tri *t;
    if (hm_tri_build(&t, xy.data(), g.points.size(), 2, 1, nullptr))
        return nullptr;
    std::vector<hm_tri_segment> s;
    for (auto &ends : g.segments)
        s.push_back({hm_tri_of_input(t, ends.first), hm_tri_of_input(t, ends.second), 1});
    hm_tri_mends mends = {};
    hm_diag d = {};
    if (hm_tri_constrain(t, s.data(), s.size(), &mends, &d)) {
        printf("# %s\n", d.text);
        exit(1);
    }
    *crossings = mends.n[HM_TRI_CROSSING];
    return t;
}

Place vertex(const hm_tri *t, int32_t v)
{
    return {hm_tri_xy(t, v)[0], hm_tri_xy(t, v)[1]};
}

Edges edges_of(const hm_tri *t)
{
    Edges edges;
    for (int32_t e = 0; e < 3 * hm_tri_triangles(t); e++) {
        int32_t twin = hm_tri_twin(t, e);
        if (!hm_tri_is_solid(t, e / 3) || (twin < e && hm_tri_is_solid(t, twin / 3)))
            continue;
        Place a = vertex(t, hm_tri_org(t, e)), b = vertex(t, hm_tri_dest(t, e));
        bool marked = hm_tri_marks(t, e) != 0;
        if (marked)
            edges.constrained.insert(edge(a, b));
        if (marked || !hm_tri_is_solid(t, twin / 3) ||
            !on_circle(a, b, vertex(t, hm_tri_apex(t, e)), vertex(t, hm_tri_apex(t, twin))))
            edges.sure.insert(edge(a, b));
    }
    return edges;
}

// --- the peer's ---

Place vertex(const Peer::Vertex_handle &v)
{
    return {v->point().x(), v->point().y()};
}

Edges edges_of(const Peer &t)
{
    Edges edges;
    for (auto i = t.finite_edges_begin(); i != t.finite_edges_end(); ++i) {
        Peer::Edge mirror = t.mirror_edge(*i);
        Place a = vertex(i->first->vertex(Peer::ccw(i->second)));
        Place b = vertex(i->first->vertex(Peer::cw(i->second)));
        bool hull = t.is_infinite(i->first) || t.is_infinite(mirror.first);
        if (t.is_constrained(*i))
            edges.constrained.insert(edge(a, b));
        if (hull || t.is_constrained(*i) ||
            !on_circle(a, b, vertex(i->first->vertex(i->second)),
                       vertex(mirror.first->vertex(mirror.second))))
            edges.sure.insert(edge(a, b));
    }
    return edges;
}

Edges by_peer(const std::set<Place> &points, const std::set<Edge> &segments)
{
    Peer t;
    std::map<Place, Peer::Vertex_handle> at_place;
    for (auto &p : points)
        at_place[p] = t.insert(at(p));
    for (auto &s : segments)
        t.insert_constraint(at_place[s.first], at_place[s.second]);
    return edges_of(t);
}

// --- side by side ---

bool clean_agrees(const Drawing &g)
{
    int64_t crossings;
    hm_tri *t = triangulate(g, &crossings);
    if (!t)
        return true;
    std::set<Edge> segments;
    for (auto &s : g.segments)
        if (g.points[s.first] != g.points[s.second])
            segments.insert(edge(g.points[s.first], g.points[s.second]));
    bool good =
        crossings == 0 && edges_of(t) == by_peer({g.points.begin(), g.points.end()}, segments);
    hm_tri_free(t);
    return good;
}

// *crossings is added to.
bool noded_agrees(const Drawing &g, int64_t *crossings)
{
    int64_t here;
    hm_tri *t = triangulate(g, &here);
    if (!t)
        return true;
    *crossings += here;
    std::set<Place> points;
    for (int32_t v = 0; v < hm_tri_vertices(t); v++)
        points.insert(vertex(t, v));
    Edges ours = edges_of(t);
    bool good = ours == by_peer(points, ours.constrained);
    hm_tri_free(t);
    return good;
}

void print(const Drawing &g)
{
    for (auto &p : g.points)
        printf("# point %.17g %.17g\n", p.first, p.second);
    for (auto &s : g.segments)
        printf("# segment %zu %zu\n", s.first, s.second);
}

} // namespace

int main(int argc, char **argv)
{
    long drawings = argc > 1 ? atol(argv[1]) : 50000;
    if (argc > 2)
        state += 0x9e3779b97f4a7c15u * strtoull(argv[2], nullptr, 10);
    int failed = 0;
    for (int kind = 0; kind < KINDS; kind++) {
        long n = (drawings + KINDS - 1) / KINDS, wrong = 0;
        int64_t crossings = 0, segments = 0;
        for (long i = 0; i < n; i++) {
            Drawing g = make(kind), clean = without_crossings(g);
            segments += static_cast<int64_t>(clean.segments.size());
            if (clean_agrees(clean) && noded_agrees(g, &crossings))
                continue;
            if (wrong++ == 0)
                print(g);
        }
        printf("%s %d - %ld drawings %s: %lld segments, with %lld crossings, as CGAL has them\n",
               wrong ? "not ok" : "ok", kind + 1, n, kind_name[kind],
               static_cast<long long>(segments), static_cast<long long>(crossings));
        fflush(stdout);
        failed += wrong > 0;
    }
    printf("1..%d\n", static_cast<int>(KINDS));
    return failed > 0;
}
