/* The texts of coordinate systems: there and back, words of others, and what is none. */
#include "hm_crs.h"
#include "hm_header.h"
#include "tap.h"

#include <string.h>

static bool comes_back(struct hm_crs crs, const char *want)
{
    char text[HM_CRS_CHARS], again[HM_CRS_CHARS] = "";
    struct hm_crs back;
    hm_crs_print(text, &crs);
    if (hm_crs_parse(&back, text))
        hm_crs_print(again, &back);
    return !strcmp(text, want) && !strcmp(text, again);
}

/* Does hm_header_need_metres refuse it? */
static bool in_degrees(const char *text)
{
    struct hm_header h;
    struct hm_diag d = {0};
    hm_header_init(&h, HM_POINTS, NULL);
    hm_header_add(&h, "crs", text, NULL);
    bool refused = hm_header_need_metres(&h, &d) != HM_OK;
    hm_header_free(&h);
    return refused;
}

static void test_round_trips(void)
{
    ok(comes_back((struct hm_crs){.kind = HM_CRS_LONLAT}, "longitude latitude WGS84"),
       "longitude and latitude");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_UTM, .zone = 32, .north = true}, "UTM 32N WGS84"),
       "UTM north");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_UTM, .zone = 1}, "UTM 1S WGS84"), "UTM south");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_UPS, .north = true}, "UPS N WGS84"), "UPS north");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_UPS}, "UPS S WGS84"), "UPS south");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_TM,
                                  .lon = -0.1,
                                  .lat = 48.5,
                                  .scale = 0.9996,
                                  .x0 = 1e-7,
                                  .y0 = -20.5},
                  "TM lon=-0.1 lat=48.5 scale=0.9996 x=1e-7 y=-20.5 WGS84"),
       "transverse Mercator");
    ok(comes_back((struct hm_crs){.kind = HM_CRS_ENU, .lon = 9.1, .lat = -48, .h = 310.25},
                  "ENU lon=9.1 lat=-48 h=310.25 WGS84"),
       "east, north, up");
}

static void test_words_of_others(void)
{
    struct hm_crs crs;
    ok(hm_crs_parse(&crs, " utm  5s ") && crs.zone == 5 && !crs.north, "any case, no datum");
    ok(hm_crs_parse(&crs, "EPSG:32632") && crs.kind == HM_CRS_UTM && crs.zone == 32 && crs.north,
       "EPSG of UTM north");
    ok(hm_crs_parse(&crs, "epsg:32760") && crs.zone == 60 && !crs.north, "EPSG of UTM south");
    ok(hm_crs_parse(&crs, "EPSG:32661") && crs.kind == HM_CRS_UPS && crs.north, "EPSG of UPS");
    ok(hm_crs_parse(&crs, "TM lon=9") && crs.scale == 1, "TM has defaults");
    static const char *const none[] = {"",
                                       "UTM",
                                       "UTM 32",
                                       "UTM N",
                                       "UTM 61N",
                                       "UTM 0N",
                                       "UPS 3N",
                                       "UTM 32N ETRS89",
                                       "EPSG:25832",
                                       "EPSG:32600",
                                       "EPSG:32662",
                                       "EPSG:32632 5",
                                       "TM lon=nan",
                                       "TM lon=9x",
                                       "TM h=3",
                                       "TM scale=0",
                                       "ENU lon=9 lat=91",
                                       "ENU scale=2",
                                       "Gauss-Krueger 3"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        ok(!hm_crs_parse(&crs, none[i]), "not known: \"%s\"", none[i]);
}

static void test_degrees(void)
{
    ok(in_degrees("longitude latitude WGS84"), "degrees are refused where metres are needed");
    static const char *const metric[] = {"UTM 32N WGS84", "UPS S WGS84",
                                         "TM lon=9 lat=0 scale=1 x=0 y=0 WGS84",
                                         "ENU lon=9 lat=48 h=0 WGS84", "EPSG:32632"};
    for (size_t i = 0; i < sizeof metric / sizeof *metric; i++)
        ok(!in_degrees(metric[i]), "metres: %s", metric[i]);
}

int main(void)
{
    test_round_trips();
    test_words_of_others();
    test_degrees();
    return done();
}
