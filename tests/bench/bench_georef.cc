// georef, binary in and out, against GeographicLib's own calls on the same places in memory: at most
// 1.3 times their time on one thread, and less than theirs on two.
//
//     bench_georef [points]
//
// The program is run as a user runs it; its time is that of the process, reading and writing
// included, from and to files.
#include "bench.hh"

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include <cmath>
#include <cstdlib>
#include <sys/resource.h>

using namespace GeographicLib;

namespace
{

struct Place {
    double x, y, z;
};
using Places = std::vector<Place>;

// In a zone or on a cap, without order, as points of a survey have none that a series could use.
Places random_places(size_t n, double west, double east, double south, double north)
{
    Places places(n);
    srand48(1);
    for (Place &p : places)
        p = {west + (east - west) * drand48(), south + (north - south) * drand48(),
             500 * drand48()};
    return places;
}

void write_stream(const std::string &name, const Places &places)
{
    FILE *f = popen(("hmconv -b -o " + name).c_str(), "w");
    for (const Place &p : places)
        fprintf(f, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
    if (pclose(f)) {
        fprintf(stderr, "bench_georef: hmconv failed\n");
        exit(2);
    }
}

double children_seconds()
{
    rusage u;
    getrusage(RUSAGE_CHILDREN, &u);
    return static_cast<double>(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

// Seconds of a command: of its processor on one thread, by the clock on the wall otherwise.
double run(const std::string &command, clockid_t clock)
{
    bool wall = clock == CLOCK_MONOTONIC;
    double begin = wall ? bench::now(clock) : children_seconds();
    if (system(command.c_str())) {
        fprintf(stderr, "bench_georef: failed: %s\n", command.c_str());
        exit(2);
    }
    return (wall ? bench::now(clock) : children_seconds()) - begin;
}

template <class Call> double call_all(const Places &places, clockid_t clock, Call call)
{
    static volatile double kept; // so that no call is left out
    double sum = 0, begin = bench::now(clock);
    for (const Place &p : places)
        sum += call(p);
    kept = sum;
    (void)kept;
    return bench::now(clock) - begin;
}

template <class Call>
void compare(const std::string &name, const std::string &options, const std::string &file,
             const Places &places, Call call)
{
    const std::string command = "georef -b " + options + " -o /dev/null " + file;
    bench::compare(
        name, 1.3, [&](clockid_t clock) { return run(command + " -j 1", clock); },
        [&](clockid_t clock) { return call_all(places, clock, call); });
    bench::compare(
        name + ", two threads", 1, [&](clockid_t clock) { return run(command + " -j 2", clock); },
        [&](clockid_t clock) { return call_all(places, clock, call); }, CLOCK_MONOTONIC);
}

} // namespace

int main(int argc, char **argv)
{
    size_t n = argc > 1 ? strtoul(argv[1], nullptr, 10) : 2000000;
    char folder[] = "/tmp/bench_georef.XXXXXX";
    if (!mkdtemp(folder))
        return 2;
    const std::string at = folder, zone = at + "/zone.hm", metres = at + "/metres.hm",
                      cap = at + "/cap.hm", local = at + "/local.hm";
    const Places in_zone = random_places(n, 6, 12, 0, 84), on_cap = random_places(n, -180, 180, 84, 90);
    write_stream(zone, in_zone);
    write_stream(cap, on_cap);
    run("georef -b -z 32N -o " + metres + " " + zone, CLOCK_MONOTONIC);
    run("georef -b -t enu -c 9,48,0 -o " + local + " " + zone, CLOCK_MONOTONIC);

    const TransverseMercator &tm = TransverseMercator::UTM();
    const LocalCartesian enu(48, 9, 0);
    Places in_metres = in_zone, in_local = in_zone;
    for (Place &p : in_metres) {
        double x, y;
        tm.Forward(9, p.y, p.x, x, y);
        p.x = x;
        p.y = y;
    }
    for (Place &p : in_local)
        enu.Forward(p.y, p.x, p.z, p.x, p.y, p.z);

    printf("%-34s %9s %9s    %6s  %6s\n", "case", "georef", "calls", "ratio", "goal");
    compare("UTM", "-z 32N", zone, in_zone, [&](const Place &p) {
        double x, y;
        tm.Forward(9, p.y, p.x, x, y);
        return x + y;
    });
    compare("and back", "-i", metres, in_metres, [&](const Place &p) {
        double lat, lon;
        tm.Reverse(9, p.x, p.y, lat, lon);
        return lat + lon;
    });
    compare("UPS", "-z N", cap, on_cap, [&](const Place &p) {
        double x, y, gamma, k;
        int zone_found;
        bool north;
        UTMUPS::Forward(p.y, p.x, zone_found, north, x, y, gamma, k, UTMUPS::UPS);
        return x + y;
    });
    compare("east, north, up", "-t enu -c 9,48,0", zone, in_zone, [&](const Place &p) {
        double x, y, z;
        enu.Forward(p.y, p.x, p.z, x, y, z);
        return x + y + z;
    });
    compare("and back", "-i", local, in_local, [&](const Place &p) {
        double lat, lon, h;
        enu.Reverse(p.x, p.y, p.z, lat, lon, h);
        return lat + lon + h;
    });
    run("rm -r " + at, CLOCK_MONOTONIC);
    return bench::summary();
}
