#include "hm_material.h"

#include "hm_attr.h"
#include "hm_elem.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdlib.h>

static enum hm_err take_ring(struct hm_material *m, const struct hm_line *line, struct hm_diag *d)
{
    const double *xyz = line->xyz, *last = xyz + 3 * (line->n > 0 ? line->n - 1 : 0);
    double region, x = line->n > 0 ? xyz[0] : 0, y = line->n > 0 ? xyz[1] : 0, at[2];
    *m = (struct hm_material){.ring = *line};
    if (line->n > 1 && xyz[0] == last[0] && xyz[1] == last[1]) {
        m->ring.n--;
        m->ring.closed = true;
    }
    enum hm_err err = hm_fail_place(d, hm_attr_number(line->attrs, "region", 0, &region, d), x, y);
    if (!err && !(region >= 0 && region < INT32_MAX && region == floor(region)))
        err = hm_fail_at(d, HM_EFORMAT, x, y, "region=%g is not a material number (0, 1, 2 …)",
                         region);
    if (!err && m->ring.n < 3)
        err = hm_fail_at(d, HM_EGEOM, x, y, "the line region=%g has only %zu points", region,
                         m->ring.n);
    if (!err && !m->ring.closed)
        err = hm_fail_at(d, HM_EGEOM, x, y, "the line region=%g is not closed (closed=1)", region);
    bool crosses = false;
    if (!err)
        err = hm_polyline_crosses_itself(&m->ring, &crosses, at, d);
    if (!err && crosses)
        err = hm_fail_at(d, HM_EGEOM, at[0], at[1], "the line region=%g crosses itself", region);
    m->region = err ? 0 : (int32_t)region;
    return err;
}

enum hm_err hm_material_collect(const struct hm_lines *sets, size_t n, struct hm_material **list,
                                size_t *count, struct hm_diag *d)
{
    size_t cap = 0;
    enum hm_err err = HM_OK;
    *list = NULL;
    *count = 0;
    for (size_t i = 0; !err && i < n; i++)
        for (size_t k = 0; !err && k < sets[i].n; k++) {
            if (hm_role_of(sets[i].line[k].attrs) != HM_ROLE_REGION)
                continue;
            if (!hm_grow(list, &cap, *count + 1, sizeof **list))
                err = hm_fail_memory(d);
            else
                err = take_ring(&(*list)[(*count)++], &sets[i].line[k], d);
        }
    if (err) {
        free(*list);
        *list = NULL;
        *count = 0;
    }
    return err;
}

static struct hm_box box_of(const struct hm_line *ring)
{
    struct hm_box box = hm_box_of(ring->xyz, ring->xyz);
    for (size_t i = 1; i < ring->n; i++)
        hm_box_add(&box, ring->xyz + 3 * i);
    return box;
}

void hm_material_apply(struct hm_mesh *m, struct hm_material *list, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        struct hm_box box = box_of(&list[k].ring);
        list[k].elements = 0;
        for (size_t i = 0; i < m->nelems; i++) {
            double xy[2];
            hm_elem_centre(m, &m->elem[i], xy);
            const struct hm_box at = hm_box_of(xy, xy);
            if (!hm_box_meets(&box, &at) || hm_polygon_side(&list[k].ring, xy[0], xy[1]) < 0)
                continue;
            m->elem[i].region = list[k].region;
            list[k].elements++;
        }
    }
}
