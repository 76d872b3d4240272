/* hm_geod: longitude and latitude to metres and back, by GeographicLib. Layer 6.
 *
 * The only part of the library that is C++, and not in libhm.a: georef alone links it. No exception
 * leaves it; what GeographicLib throws becomes HM_EGEOM or HM_EARG. All on the WGS84 ellipsoid.
 * Once open, an object may be used by several threads at once.
 *
 *     struct hm_crs crs = {.kind = HM_CRS_UTM, .zone = 32, .north = true};
 *     double p[3] = {9.1829, 48.7758, 245};             // Stuttgart
 *     hm_geod_open(&g, &crs, d);
 *     hm_geod_forward(g, p, 1, 3, d);                   // 513437.7 5402549.1 245
 */
#ifndef HM_GEOD_H
#define HM_GEOD_H

#ifdef __cplusplus
extern "C" {
#endif

#include "hm_base.h"
#include "hm_crs.h"

struct hm_geod;

/* HM_EARG when a parameter is out of range. *g is NULL on failure. */
enum hm_err hm_geod_open(struct hm_geod **g, const struct hm_crs *crs, struct hm_diag *d);
void hm_geod_close(struct hm_geod *g);

/* The first three of `stride` doubles of each of n rows: longitude, latitude (degrees) and height
 * over the ellipsoid (metres) to coordinates of the system, in place; and back, longitudes in
 * -180 .. 180. z passes unchanged but for ENU. HM_EGEOM names a place that the system cannot hold:
 * no latitude, more than 35 degrees of arc (3900 km) from the central meridian of a transverse
 * Mercator (nearer, it is good to 5 nm), beyond the equator in UPS, without height in ENU. The rows
 * are half done then. */
enum hm_err hm_geod_forward(const struct hm_geod *g, double *rows, size_t n, size_t stride,
                            struct hm_diag *d);
enum hm_err hm_geod_inverse(const struct hm_geod *g, double *rows, size_t n, size_t stride,
                            struct hm_diag *d);

/* The UTM zone of a place, or UPS near the poles, with the exceptions of Norway and Svalbard. */
enum hm_err hm_geod_zone(struct hm_crs *crs, double lon, double lat, struct hm_diag *d);

/* The middle of the square that an MGRS reference names ("32UNV1343802438", blanks removed), in
 * degrees. HM_EFORMAT when it is none. */
enum hm_err hm_geod_mgrs(double lonlat[2], const char *text, struct hm_diag *d);

/* A model of the geoid: the file of a GeographicLib model, FILE.pgm, or the name of an installed
 * one ("egm96-5"). HM_EIO when it cannot be read. */
struct hm_geoid;
enum hm_err hm_geoid_open(struct hm_geoid **g, const char *name, struct hm_diag *d);
void hm_geoid_close(struct hm_geoid *g);

/* Height of the geoid over the ellipsoid, metres: ellipsoidal = orthometric + this. */
enum hm_err hm_geoid_height(double *height, const struct hm_geoid *g, double lon, double lat,
                            struct hm_diag *d);

#ifdef __cplusplus
}
#endif

#endif
