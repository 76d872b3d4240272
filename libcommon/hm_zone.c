#include "hm_zone.h"

#include "hm_attr.h"
#include "hm_role.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 64 };

static enum hm_err take_ring(struct hm_zones *z, const struct hm_line *line, struct hm_diag *d)
{
    struct hm_line ring = *line;
    const double *first = ring.xyz, *last = ring.xyz + 3 * (ring.n > 0 ? ring.n - 1 : 0);
    char name[NAME];
    hm_attr_get(line->attrs, "zone", name, sizeof name);
    if (ring.n > 1 && first[0] == last[0] && first[1] == last[1]) {
        ring.n--;
        ring.closed = true;
    }
    if (ring.n < 3 || !ring.closed)
        return hm_fail_at(d, HM_EGEOM, ring.n ? first[0] : 0, ring.n ? first[1] : 0,
                          "the line zone=%s %s", name,
                          ring.closed ? "has fewer than three points" : "is not closed (closed=1)");
    return hm_lines_append(&z->ring, &ring, d);
}

/* Zones of one name are one zone. */
static enum hm_err join_names(struct hm_zones *z, struct hm_diag *d)
{
    free(z->first);
    z->first = hm_alloc(z->ring.n, sizeof *z->first);
    if (!z->first)
        return hm_fail_memory(d);
    for (size_t i = 0; i < z->ring.n; i++) {
        char name[NAME], other[NAME] = "";
        size_t k = 0;
        hm_zones_name(z, (int64_t)i, name, sizeof name);
        for (; k < i; k++) {
            hm_zones_name(z, (int64_t)k, other, sizeof other);
            if (!strcmp(name, other))
                break;
        }
        z->first[i] = (int64_t)k;
    }
    return HM_OK;
}

enum hm_err hm_zones_take(struct hm_zones *z, const struct hm_lines *lines, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < lines->n && !err; k++)
        if (hm_role_of(lines->line[k].attrs) == HM_ROLE_ZONE)
            err = take_ring(z, &lines->line[k], d);
    hm_rings_free(z->index);
    z->index = NULL;
    if (!err)
        err = join_names(z, d);
    return err ? err : hm_rings_build(&z->index, z->ring.line, z->ring.n, d);
}

void hm_zones_free(struct hm_zones *z)
{
    hm_lines_free(&z->ring);
    hm_rings_free(z->index);
    free(z->first);
    *z = (struct hm_zones){0};
}

int64_t hm_zones_find(const struct hm_zones *z, double x, double y)
{
    int64_t found = hm_rings_find(z->index, x, y);
    return found < 0 ? -1 : z->first[found];
}

void hm_zones_name(const struct hm_zones *z, int64_t zone, char *name, size_t size)
{
    if (zone < 0)
        snprintf(name, size, "elsewhere");
    else
        hm_attr_get(z->ring.line[zone].attrs, "zone", name, size);
}
