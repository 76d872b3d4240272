#include "hm_import_private.h"

const struct hm_foreign hm_import_formats[] = {
    HM_IMPORT_PLAIN, {"geojson", hm_import_is_geojson, NULL, hm_import_geojson}, {0}};
