/* hm_crs: the coordinate systems that georef knows, as the text of `#crs`. Layer 3.
 *
 *     longitude latitude WGS84
 *     UTM 32N WGS84
 *     UPS N WGS84
 *     TM lon=9 lat=0 scale=1 x=500000 y=0 WGS84
 *     ENU lon=9.1 lat=48.2 h=310 WGS84
 *
 * All on the WGS84 ellipsoid.
 */
#ifndef HM_CRS_H
#define HM_CRS_H

#include <stdbool.h>
#include <stddef.h>

enum hm_crs_kind {
    HM_CRS_LONLAT, /* x longitude, y latitude, degrees */
    HM_CRS_UTM,    /* universal transverse Mercator, metres */
    HM_CRS_UPS,    /* universal polar stereographic, metres */
    HM_CRS_TM,     /* transverse Mercator with a meridian of one's own, metres */
    HM_CRS_ENU     /* east, north and up of an origin, metres */
};

struct hm_crs {
    enum hm_crs_kind kind;
    int zone;        /* UTM: 1 .. 60 */
    bool north;      /* UTM, UPS */
    double lon, lat; /* TM: central meridian and latitude of the centre; ENU: origin; degrees */
    double h;        /* ENU: height of the origin over the ellipsoid, metres */
    double scale;    /* TM: on the central meridian */
    double x0, y0;   /* TM: coordinates of the centre, metres */
};

enum { HM_CRS_CHARS = 256 }; /* room that hm_crs_print needs */

/* Write the text of a system, with a terminating 0. */
void hm_crs_print(char text[HM_CRS_CHARS], const struct hm_crs *crs);

/* Read what hm_crs_print writes, in any case, with or without the datum, and the EPSG codes of UTM
 * and UPS on WGS84 (EPSG:32632 …). Longitude and latitude in words of others are not known here:
 * hm_header_need_metres finds them. False when it is no such text. */
bool hm_crs_parse(struct hm_crs *crs, const char *text);

/* The EPSG code of the text of a system: that of "EPSG:n", or of one of the above; 0: it has none.
 */
int hm_crs_epsg(const char *text);

/* Do two texts say the same system? */
bool hm_crs_same(const char *a, const char *b);

/* A zone alone: `32N`, `5s`, `32` (*half false: the hemisphere is not said), `N` or `S` (UPS). */
bool hm_crs_parse_zone(struct hm_crs *crs, bool *half, const char *text);

#endif
