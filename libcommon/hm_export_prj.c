/* .prj: a system of coordinates in ESRI's words, beside a grid or a shapefile. */
#include "hm_crs.h"
#include "hm_export_private.h"

static const char degrees[] = "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\","
                              "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
                              "UNIT[\"Degree\",0.0174532925199433]]";

static void put_parameter(struct hm_sink *s, const char *name, double v)
{
    hm_sink_format(s, ",PARAMETER[\"%s\",", name);
    hm_sink_number(s, v, 0);
    hm_sink_text(s, "]");
}

/* UTM is a transverse Mercator whose centre lies on the equator. */
static struct hm_crs as_mercator(const struct hm_crs *crs)
{
    return crs->kind != HM_CRS_UTM ? *crs
                                   : (struct hm_crs){.kind = HM_CRS_TM,
                                                     .lon = 6 * crs->zone - 183,
                                                     .scale = 0.9996,
                                                     .x0 = 500000,
                                                     .y0 = crs->north ? 0 : 10000000};
}

enum hm_err hm_export_prj(const char *crs, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_crs system;
    struct hm_sink s = hm_sink_to(w, d);
    if (hm_crs_epsg(crs) == 4326) {
        hm_sink_format(&s, "%s\n", degrees);
        return hm_sink_finish(&s);
    }
    if (!hm_crs_parse(&system, crs) || (system.kind != HM_CRS_UTM && system.kind != HM_CRS_TM))
        return hm_fail(d, HM_EARG, "no words for the crs \"%s\" in a .prj", crs);
    if (system.kind == HM_CRS_UTM)
        hm_sink_format(&s, "PROJCS[\"WGS_1984_UTM_Zone_%d%c\",", system.zone,
                       system.north ? 'N' : 'S');
    else
        hm_sink_text(&s, "PROJCS[\"WGS_1984_Transverse_Mercator\",");
    system = as_mercator(&system);
    hm_sink_format(&s, "%s,PROJECTION[\"Transverse_Mercator\"]", degrees);
    put_parameter(&s, "False_Easting", system.x0);
    put_parameter(&s, "False_Northing", system.y0);
    put_parameter(&s, "Central_Meridian", system.lon);
    put_parameter(&s, "Scale_Factor", system.scale);
    put_parameter(&s, "Latitude_Of_Origin", system.lat);
    hm_sink_text(&s, ",UNIT[\"Meter\",1]]\n");
    return hm_sink_finish(&s);
}
