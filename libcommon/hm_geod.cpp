#include "hm_geod.h"

#include <GeographicLib/Geoid.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include <cmath>
#include <memory>
#include <new>
#include <string>

using GeographicLib::Constants;
using GeographicLib::Geoid;
using GeographicLib::LocalCartesian;
using GeographicLib::Math;
using GeographicLib::MGRS;
using GeographicLib::PolarStereographic;
using GeographicLib::TransverseMercator;
using GeographicLib::UTMUPS;

namespace
{

/* Run f; what it throws becomes a failure of kind err. */
template <class Function> hm_err guard(hm_diag *d, hm_err err, Function f)
{
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return hm_fail_memory(d);
    } catch (const std::exception &e) {
        return hm_fail(d, err, "%s", e.what());
    } catch (...) {
        return hm_fail(d, err, "GeographicLib failed");
    }
}

/* Sine of the arc from the central meridian within which the series of the transverse Mercator is
 * good to 5 nm, and the largest coordinates, on a meridian of scale 1, that can belong to it. */
const double sin_reach = 0.573576436351046; // 35 degrees
const double east_reach = 4.2e6, north_reach = 2.0e7;

} // namespace

struct hm_geod {
    explicit hm_geod(const hm_crs &system);
    hm_err forward(double *p, hm_diag *d) const;
    hm_err inverse(double *p, hm_diag *d) const;

  private:
    hm_crs crs;
    TransverseMercator tm; // UTM, TM
    LocalCartesian local;  // ENU
    double x0, y0;         // false easting and northing
    bool within_reach(double lon, double lat) const;
    hm_err too_far(const double *p, hm_diag *d) const;
};

/* Longitudes may go round once more, as those of a line across the antimeridian do. */
static hm_err check_degrees(const double *p, hm_diag *d)
{
    if (!(std::fabs(p[1]) <= 90))
        return hm_fail_at(d, HM_EGEOM, p[0], p[1], "%g is no latitude", p[1]);
    if (!(std::fabs(p[0]) <= 540))
        return hm_fail_at(d, HM_EGEOM, p[0], p[1], "%g is no longitude", p[0]);
    return HM_OK;
}

static double scale_of(const hm_crs &crs)
{
    return crs.kind == HM_CRS_TM ? crs.scale : Constants::UTM_k0();
}

hm_geod::hm_geod(const hm_crs &system)
    : crs(system), tm(Constants::WGS84_a(), Constants::WGS84_f(), scale_of(system)),
      local(system.kind == HM_CRS_ENU ? system.lat : 0, system.lon, system.h), x0(system.x0),
      y0(system.y0)
{
    if (crs.kind == HM_CRS_UTM) {
        crs.lon = 6 * crs.zone - 183;
        x0 = 5e5;
        y0 = crs.north ? 0 : 1e7;
    } else if (crs.kind == HM_CRS_UPS) {
        x0 = y0 = 2e6;
    } else if (crs.kind == HM_CRS_TM) {
        double x, y;
        tm.Forward(crs.lon, crs.lat, crs.lon, x, y);
        y0 -= y;
    }
}

bool hm_geod::within_reach(double lon, double lat) const
{
    double sine = std::cos(lat * Math::degree()) * std::sin((lon - crs.lon) * Math::degree());
    return std::fabs(sine) <= sin_reach;
}

hm_err hm_geod::too_far(const double *p, hm_diag *d) const
{
    if (crs.kind == HM_CRS_UPS)
        return hm_fail_at(d, HM_EGEOM, p[0], p[1], "on the other side of the equator, for UPS");
    return hm_fail_at(d, HM_EGEOM, p[0], p[1],
                      "more than 35 degrees (3900 km) from the central meridian, %g", crs.lon);
}

hm_err hm_geod::forward(double *p, hm_diag *d) const
{
    const double lon = p[0], lat = p[1];
    hm_err err = check_degrees(p, d);
    if (err)
        return err;
    switch (crs.kind) {
    case HM_CRS_LONLAT:
        break;
    case HM_CRS_UTM:
    case HM_CRS_TM:
        if (!within_reach(lon, lat))
            return too_far(p, d);
        tm.Forward(crs.lon, lat, lon, p[0], p[1]);
        break;
    case HM_CRS_UPS:
        if (crs.north ? lat < 0 : lat > 0)
            return too_far(p, d);
        PolarStereographic::UPS().Forward(crs.north, lat, lon, p[0], p[1]);
        break;
    case HM_CRS_ENU:
        if (std::isnan(p[2]))
            return hm_fail_at(d, HM_EGEOM, lon, lat, "east, north, up needs heights; none");
        local.Forward(lat, lon, p[2], p[0], p[1], p[2]);
        return HM_OK;
    }
    if (crs.kind != HM_CRS_LONLAT) {
        p[0] += x0;
        p[1] += y0;
    }
    return HM_OK;
}

hm_err hm_geod::inverse(double *p, hm_diag *d) const
{
    const double x = p[0] - x0, y = p[1] - y0;
    double lon = p[0], lat = p[1];
    switch (crs.kind) {
    case HM_CRS_LONLAT:
        return check_degrees(p, d);
    case HM_CRS_UTM:
    case HM_CRS_TM:
        if (!(std::fabs(x) <= east_reach * scale_of(crs)) ||
            !(std::fabs(y) <= north_reach * scale_of(crs)))
            return too_far(p, d);
        tm.Reverse(crs.lon, x, y, lat, lon);
        if (!within_reach(lon, lat))
            return too_far(p, d);
        break;
    case HM_CRS_UPS:
        PolarStereographic::UPS().Reverse(crs.north, x, y, lat, lon);
        if (crs.north ? lat < 0 : lat > 0)
            return too_far(p, d);
        break;
    case HM_CRS_ENU:
        if (std::isnan(p[2]))
            return hm_fail_at(d, HM_EGEOM, lon, lat, "east, north, up needs heights; none");
        local.Reverse(p[0], p[1], p[2], lat, lon, p[2]);
        break;
    }
    p[0] = lon;
    p[1] = lat;
    return HM_OK;
}

hm_err hm_geod_open(hm_geod **g, const hm_crs *crs, hm_diag *d)
{
    *g = nullptr;
    if (!(std::fabs(crs->lat) <= 90) || !std::isfinite(crs->lon))
        return hm_fail(d, HM_EARG, "the centre %g %g is no longitude and latitude", crs->lon,
                       crs->lat);
    return guard(d, HM_EARG, [&] {
        *g = new hm_geod(*crs);
        return HM_OK;
    });
}

void hm_geod_close(hm_geod *g)
{
    delete g;
}

hm_err hm_geod_forward(const hm_geod *g, double *rows, size_t n, size_t stride, hm_diag *d)
{
    return guard(d, HM_EGEOM, [&] {
        hm_err err = HM_OK;
        for (size_t i = 0; i < n && !err; i++)
            err = g->forward(rows + i * stride, d);
        return err;
    });
}

hm_err hm_geod_inverse(const hm_geod *g, double *rows, size_t n, size_t stride, hm_diag *d)
{
    return guard(d, HM_EGEOM, [&] {
        hm_err err = HM_OK;
        for (size_t i = 0; i < n && !err; i++)
            err = g->inverse(rows + i * stride, d);
        return err;
    });
}

hm_err hm_geod_zone(hm_crs *crs, double lon, double lat, hm_diag *d)
{
    return guard(d, HM_EGEOM, [&] {
        int zone = UTMUPS::StandardZone(lat, lon);
        *crs = hm_crs();
        crs->kind = zone == UTMUPS::UPS ? HM_CRS_UPS : HM_CRS_UTM;
        crs->zone = zone;
        crs->north = lat >= 0;
        return HM_OK;
    });
}

hm_err hm_geod_mgrs(double lonlat[2], const char *text, hm_diag *d)
{
    return guard(d, HM_EFORMAT, [&] {
        int zone, precision;
        bool north;
        double x, y;
        MGRS::Reverse(text, zone, north, x, y, precision);
        if (std::isnan(x)) // "INV"
            return hm_fail(d, HM_EFORMAT, "no MGRS reference: %s", text);
        UTMUPS::Reverse(zone, north, x, y, lonlat[1], lonlat[0]);
        return HM_OK;
    });
}

/* --- the geoid --- */

struct hm_geoid {
    Geoid model;
    // Threadsafe: GeographicLib then holds the whole model in memory.
    hm_geoid(const std::string &name, const std::string &folder) : model(name, folder, true, true)
    {
    }
};

hm_err hm_geoid_open(hm_geoid **g, const char *name, hm_diag *d)
{
    *g = nullptr;
    return guard(d, HM_EIO, [&] {
        std::string file = name, folder;
        const std::string ending = ".pgm";
        size_t slash = file.rfind('/');
        bool is_file = file.size() > ending.size() &&
                       !file.compare(file.size() - ending.size(), ending.size(), ending);
        if (is_file) {
            folder = slash == std::string::npos ? "." : slash == 0 ? "/" : file.substr(0, slash);
            file = file.substr(slash == std::string::npos ? 0 : slash + 1);
            file.resize(file.size() - ending.size());
        }
        *g = new hm_geoid(file, folder);
        return HM_OK;
    });
}

void hm_geoid_close(hm_geoid *g)
{
    delete g;
}

hm_err hm_geoid_height(double *height, const hm_geoid *g, double lon, double lat, hm_diag *d)
{
    return guard(d, HM_EGEOM, [&] {
        *height = g->model(lat, lon);
        return HM_OK;
    });
}
