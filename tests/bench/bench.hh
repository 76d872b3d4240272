// What the benchmarks share: clocks, the table they print, Triangle's .poly files.
//
// A line a case: name, ours, the peer's, their ratio, the goal for it, ok or MISS. Ours and the
// peer take turns; the figures are medians. One thread is measured in processor time, so that other
// programs disturb less; a `~` marks times that still scatter by more than a quarter.
#ifndef BENCH_HH
#define BENCH_HH

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace bench
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

// The same points for us and for CGAL.
struct Cloud {
    std::vector<double> xy;
    std::vector<Point> points;
    size_t size() const
    {
        return points.size();
    }
    void add(double x, double y)
    {
        xy.push_back(x);
        xy.push_back(y);
        points.emplace_back(x, y);
    }
};

using Segments = std::vector<std::pair<size_t, size_t>>;

inline double now(clockid_t clock)
{
    timespec t;
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Times {
    std::vector<double> all;
    double median()
    {
        std::sort(all.begin(), all.end());
        return all[all.size() / 2];
    }
    bool noisy()
    {
        return all.size() > 2 && all[all.size() - 2] - all[1] > 0.25 * median();
    }
};

inline int passed, missed;

inline void header()
{
    printf("%-34s %9s %9s    %6s  %6s\n", "case", "ours", "CGAL", "ratio", "goal");
}

inline void verdict(bool good, bool noisy)
{
    printf("  %s%s\n", good ? "ok" : "MISS", noisy ? " ~" : "");
    fflush(stdout);
    (good ? passed : missed)++;
}

inline void line(const std::string &name, double ours, double peer, double ratio, double goal,
                 bool noisy, const char *unit)
{
    printf("%-34s %9.3f %9.3f %s  %6.3f  %6.3f", name.c_str(), ours, peer, unit, ratio, goal);
    verdict(ratio <= goal, noisy);
}

inline int summary()
{
    printf("%d ok, %d missed\n", passed, missed);
    return missed > 0;
}

using Work = std::function<double(clockid_t)>; // returns seconds on the clock

// Returns our median.
inline double compare(const std::string &name, double goal, const Work &ours, const Work &peer,
                      clockid_t clock = CLOCK_PROCESS_CPUTIME_ID, int runs = 5)
{
    Times a, b;
    for (int i = 0; i < runs; i++) {
        a.all.push_back(ours(clock));
        b.all.push_back(peer(clock));
    }
    double ratio = a.median() / b.median();
    line(name, a.median(), b.median(), ratio, goal, a.noisy() || b.noisy(), "s");
    return a.median();
}

// Nodes, segments and the places of holes; numbers from 1.
inline bool read_poly(const char *name, Cloud &cloud, Segments &segments,
                      std::vector<Point> *holes = nullptr)
{
    FILE *file = fopen(name, "r");
    if (!file)
        return false;
    size_t n = 0, marks;
    bool good = fscanf(file, "%zu %*d %*d %*d", &n) == 1;
    for (size_t i = 0; good && i < n; i++) {
        double x, y;
        good = fscanf(file, "%*d %lf %lf%*[^\n]", &x, &y) == 2;
        cloud.add(x, y);
    }
    good = good && fscanf(file, "%zu %zu", &n, &marks) == 2;
    for (size_t i = 0; good && i < n; i++) {
        size_t a, b;
        good = fscanf(file, "%*d %zu %zu%*[^\n]", &a, &b) == 2;
        segments.emplace_back(a - 1, b - 1);
    }
    good = good && fscanf(file, "%zu", &n) == 1;
    for (size_t i = 0; good && holes && i < n; i++) {
        double x, y;
        good = fscanf(file, "%*d %lf %lf", &x, &y) == 2;
        holes->emplace_back(x, y);
    }
    fclose(file);
    return good;
}

} // namespace bench

#endif
