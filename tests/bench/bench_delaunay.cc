// bench_delaunay: hm_tri against CGAL, kernel time without input and output.
//
//     bench_delaunay [-q] [river.poly]      -q: nothing over a million points
//     bench_delaunay -m ours|cgal N         only triangulate N uniform points (for the memory
//     cases)
//
// bench.hh says how to read the table.

#include "bench.hh"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/spatial_sort.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <malloc.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern "C" {
#include "hm_tri.h"
}

namespace
{

using namespace bench;

using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;
// the river's segments cross in seven places
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>;

struct Random {
    uint64_t state = 88172645463325252u;
    double operator()()
    {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return static_cast<double>(state >> 11) * 0x1p-53;
    }
};

Cloud uniform(size_t n, double width = 4000, double height = 4000)
{
    Cloud cloud;
    Random random;
    for (size_t i = 0; i < n; i++) {
        double x = width * random();
        cloud.add(x, height * random());
    }
    return cloud;
}

// Scan lines across a strip of 1 km, two decimals in UTM, with a point in fifty recorded twice.
Cloud lidar(size_t n)
{
    Cloud cloud;
    Random random;
    auto cm = [](double v) { return std::round(100 * v) / 100; };
    for (double line = 0; cloud.size() < n; line += 0.7) {
        for (double along = 0; along < 1000 && cloud.size() < n; along += 0.3 + 0.4 * random()) {
            double x = cm(545000 + along), y = cm(5972000 + line + 0.1 * along + 0.05 * random());
            cloud.add(x, y);
            if (cloud.size() < n && random() < 0.02)
                cloud.add(x, y);
        }
    }
    return cloud;
}

Cloud lattice(int side)
{
    Cloud cloud;
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++)
            cloud.add(k, i);
    return cloud;
}

// --- the contestants ---

hm_tri *build(const Cloud &cloud, int threads)
{
    hm_tri *t;
    hm_diag d = {};
    if (hm_tri_build(&t, cloud.xy.data(), cloud.size(), 2, threads, &d)) {
        fprintf(stderr, "bench_delaunay: %s\n", d.text);
        exit(2);
    }
    return t;
}

Work ours(const Cloud &cloud, int threads)
{
    return [&cloud, threads](clockid_t clock) {
        double start = now(clock);
        hm_tri *t = build(cloud, threads);
        double took = now(clock) - start;
        hm_tri_free(t);
        return took;
    };
}

Work cgal(const Cloud &cloud)
{
    return [&cloud](clockid_t clock) {
        double start = now(clock);
        Delaunay t(cloud.points.begin(), cloud.points.end());
        return now(clock) - start;
    };
}

// --- constraints ---

Work ours_constrained(const Cloud &cloud, const Segments &segments)
{
    return [&](clockid_t clock) {
        double start = now(clock);
        hm_tri *t = build(cloud, 1);
        std::vector<hm_tri_segment> s;
        for (auto &ends : segments)
            s.push_back({hm_tri_of_input(t, ends.first), hm_tri_of_input(t, ends.second), 1});
        if (hm_tri_constrain(t, s.data(), s.size(), nullptr, nullptr))
            exit(2);
        double took = now(clock) - start;
        hm_tri_free(t);
        return took;
    };
}

Work cgal_constrained(const Cloud &cloud, const Segments &segments)
{
    return [&](clockid_t clock) {
        double start = now(clock);
        Constrained t;
        t.insert_constraints(cloud.points.begin(), cloud.points.begin() + 8872, segments.begin(),
                             segments.end());
        t.insert(cloud.points.begin() + 8872, cloud.points.end());
        return now(clock) - start;
    };
}

void river(const char *name)
{
    Cloud cloud;
    Segments segments;
    if (!read_poly(name, cloud, segments)) {
        printf("%-34s skipped: %s cannot be read\n", "uniform 1M with segments", name);
        return;
    }
    double box[4] = {1e300, 1e300, -1e300, -1e300};
    for (const Point &p : cloud.points) {
        box[0] = std::min(box[0], p.x());
        box[1] = std::min(box[1], p.y());
        box[2] = std::max(box[2], p.x());
        box[3] = std::max(box[3], p.y());
    }
    Random random;
    while (cloud.size() < 1000000) {
        double x = box[0] + (box[2] - box[0]) * random();
        cloud.add(x, box[1] + (box[3] - box[1]) * random());
    }
    Work bare = ours(cloud, 1), with = ours_constrained(cloud, segments);
    compare("uniform 1M, 8860 segments", 0.60, with, cgal_constrained(cloud, segments));
    compare("  the same against no segments", 1.10, with, bare);
}

// --- location ---

void locate(size_t n)
{
    Cloud cloud = uniform(n), query;
    Random random;
    random.state += 12345;
    for (size_t i = 0; i < n; i++) {
        double x = 4000 * random();
        query.add(x, 4000 * random());
    }
    hm_tri *t = build(cloud, 1);
    Delaunay dt(cloud.points.begin(), cloud.points.end());
    std::vector<double> z(n);
    auto height = [](double x, double y) { return 0.1 * x - 0.2 * y; };
    auto plane = [&](double x, double y, const double *a, const double *b, const double *c) {
        double wa = (b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x);
        double wb = (c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x);
        double wc = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
        return (wa * height(a[0], a[1]) + wb * height(b[0], b[1]) + wc * height(c[0], c[1])) /
               (wa + wb + wc);
    };
    Work mine = [&](clockid_t clock) {
        double start = now(clock);
        std::vector<int32_t> tri(n);
        if (hm_tri_locate_all(t, query.xy.data(), n, 2, 1, tri.data(), nullptr))
            exit(2);
        for (size_t i = 0; i < n; i++)
            if (tri[i] != HM_TRI_NONE)
                z[i] = plane(query.xy[2 * i], query.xy[2 * i + 1],
                             hm_tri_xy(t, hm_tri_org(t, 3 * tri[i])),
                             hm_tri_xy(t, hm_tri_dest(t, 3 * tri[i])),
                             hm_tri_xy(t, hm_tri_apex(t, 3 * tri[i])));
        return now(clock) - start;
    };
    Work peer = [&](clockid_t clock) {
        double start = now(clock);
        std::vector<size_t> order(n);
        for (size_t i = 0; i < n; i++)
            order[i] = i;
        using Map = CGAL::Pointer_property_map<Point>::type;
        CGAL::spatial_sort(order.begin(), order.end(),
                           CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(
                               CGAL::make_property_map(query.points)));
        Delaunay::Face_handle face;
        for (size_t i : order) {
            face = dt.locate(query.points[i], face);
            if (dt.is_infinite(face))
                continue;
            double v[3][2];
            for (int k = 0; k < 3; k++) {
                v[k][0] = face->vertex(k)->point().x();
                v[k][1] = face->vertex(k)->point().y();
            }
            z[i] = plane(query.points[i].x(), query.points[i].y(), v[0], v[1], v[2]);
        }
        return now(clock) - start;
    };
    compare("locate and interpolate 1M in 1M", 0.60, mine, peer);
    hm_tri_free(t);
}

// --- memory, each in a process of its own ---

double peak_bytes(const char *self, const char *who, size_t n)
{
    pid_t child = fork();
    if (child == 0) {
        execl(self, self, "-m", who, std::to_string(n).c_str(), static_cast<char *>(nullptr));
        _exit(127);
    }
    int status;
    rusage usage;
    if (child < 0 || wait4(child, &status, 0, &usage) < 0 || status != 0)
        return NAN;
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

int only_triangulate(const char *who, size_t n)
{
    Random random;
    if (!strcmp(who, "cgal")) {
        std::vector<Point> points;
        points.reserve(n);
        for (size_t i = 0; i < n; i++) {
            double x = 4000 * random();
            points.emplace_back(x, 4000 * random());
        }
        Delaunay t(points.begin(), points.end());
        return t.number_of_vertices() == 0;
    }
    std::vector<double> xy(2 * n);
    for (double &v : xy)
        v = 4000 * random();
    hm_tri *t;
    if (hm_tri_build(&t, xy.data(), n, 2, 1, nullptr))
        return 1;
    hm_tri_free(t);
    return 0;
}

void memory(const char *self, const char *name, size_t n)
{
    double mine = peak_bytes(self, "ours", n) / static_cast<double>(n);
    double peer = peak_bytes(self, "cgal", n) / static_cast<double>(n);
    line(name, mine, peer, mine, 90, false, "B");
}

// Without a peer, whose gigabytes tell nothing new.
void memory_alone(const char *self, const char *name, size_t n, double goal)
{
    double mine = peak_bytes(self, "ours", n) / 1e9;
    line(name, mine, NAN, mine, goal, false, "GB");
}

void all(const char *self, bool quick, const char *poly)
{
    header();
    Cloud uni = uniform(1000000), lid = lidar(1000000), grid = lattice(1000);
    double at_1m = compare("uniform 1M", 0.60, ours(uni, 1), cgal(uni));
    compare("lidar 1M", 0.60, ours(lid, 1), cgal(lid));
    compare("lattice 1000 x 1000", 0.50, ours(grid, 1), cgal(grid));
    river(poly);
    locate(1000000);
    memory(self, "peak memory a point, uniform 5M", 5000000);
    if (quick)
        return;
    uni = uniform(5000000);
    lid = lidar(5000000);
    compare("uniform 5M", 0.60, ours(uni, 1), cgal(uni));
    compare("lidar 5M", 0.60, ours(lid, 1), cgal(lid));
    compare("uniform 5M, two threads", 0.35, ours(uni, 2), cgal(uni), CLOCK_MONOTONIC);
    compare("lidar 5M, two threads", 0.35, ours(lid, 2), cgal(lid), CLOCK_MONOTONIC);
    grid = lid = uni = Cloud();
    memory_alone(self, "peak memory, uniform 20M", 20000000, 1.8);
    uni = uniform(20000000);
    Times big;
    for (int i = 0; i < 5; i++)
        big.all.push_back(ours(uni, 1)(CLOCK_PROCESS_CPUTIME_ID));
    line("uniform 20M against 20 x 1M", big.median(), 20 * at_1m, big.median() / (20 * at_1m), 1.35,
         big.noisy(), "s");
}

} // namespace

int main(int argc, char **argv)
{
    if (argc == 4 && !strcmp(argv[1], "-m"))
        return only_triangulate(argv[2], strtoul(argv[3], nullptr, 10));
    mallopt(M_MMAP_THRESHOLD,
            1 << 20); // every run gets fresh memory, as a program of its own would
    bool quick = argc > 1 && !strcmp(argv[1], "-q");
    const char *poly = argc > 1 + quick ? argv[1 + quick] : "river.poly";
    all(argv[0], quick, poly);
    return summary();
}
