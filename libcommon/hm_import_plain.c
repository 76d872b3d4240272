/* A file of its own, so that who does not read GeoJSON links no library for it. */
#include "hm_import_private.h"

const struct hm_foreign hm_import_plain[] = {HM_IMPORT_PLAIN, {0}};
