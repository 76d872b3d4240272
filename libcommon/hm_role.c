#include "hm_role.h"

#include "hm_attr.h"

enum hm_role hm_role_of(const char *attrs)
{
    char value[2];
    if (hm_attr_get(attrs, "surface", value, sizeof value))
        return HM_ROLE_SURFACE;
    if (hm_attr_get(attrs, "face", value, sizeof value))
        return HM_ROLE_FACE;
    if (hm_attr_flag(attrs, "hole"))
        return HM_ROLE_HOLE;
    if (hm_attr_flag(attrs, "boundary"))
        return HM_ROLE_BOUNDARY;
    if (hm_attr_get(attrs, "region", value, sizeof value))
        return HM_ROLE_REGION;
    if (hm_attr_get(attrs, "string", value, sizeof value))
        return HM_ROLE_STRING;
    if (hm_attr_get(attrs, "net", value, sizeof value))
        return HM_ROLE_NET;
    if (hm_attr_get(attrs, "move", value, sizeof value))
        return HM_ROLE_MOVE;
    if (hm_attr_get(attrs, "zone", value, sizeof value))
        return HM_ROLE_ZONE;
    return HM_ROLE_BREAKLINE;
}
