/* Classes: of elements by material, height or smallest angle, of residuals by their size. */
#include "draw.h"

#include "hm_elem.h"
#include "hm_num.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    double least; /* degrees */
    const char *text;
} angle_class[] = {{30, "over 30°"}, {20, "20° to 30°"}, {10, "10° to 20°"}, {-1, "under 10°"}};
enum { ANGLES = sizeof angle_class / sizeof *angle_class, SHADES = 48, LIGHTS = 24 };

void classes_free(struct classes *c)
{
    free(c->of);
    free(c->list);
    *c = (struct classes){0};
}

static enum hm_err make_list(struct classes *c, size_t n, struct hm_diag *d)
{
    c->n = n;
    c->list = hm_alloc0(n, sizeof *c->list);
    return c->list ? HM_OK : hm_fail_memory(d);
}

/* How the plane through three corners of an element rises to the east and to the north; that of a
 * quadrilateral through its diagonals. */
static void slope_of(const struct hm_mesh *m, const struct hm_elem *e, double slope[2])
{
    const bool quad = hm_elem_corners(e) == 4;
    const struct hm_node *a = &m->node[e->node[0]], *b = &m->node[e->node[quad ? 2 : 1]];
    const struct hm_node *c = &m->node[e->node[quad ? 1 : 0]], *o = &m->node[e->node[quad ? 3 : 2]];
    const double ux = b->x - a->x, uy = b->y - a->y, uz = b->z - a->z;
    const double vx = o->x - c->x, vy = o->y - c->y, vz = o->z - c->z;
    const double area = ux * vy - uy * vx;
    slope[0] = area != 0 ? (uz * vy - vz * uy) / area : 0;
    slope[1] = area != 0 ? (vz * ux - uz * vx) / area : 0;
}

static double stretch_of(const struct hm_mesh *m)
{
    enum { MOST = 20000 };
    double steep[MOST];
    size_t n = 0;
    for (size_t k = 0; k < m->nelems; k += m->nelems / MOST + 1) {
        double s[2];
        slope_of(m, &m->elem[k], s);
        if (isfinite(s[0]) && isfinite(s[1]))
            steep[n++] = sqrt(s[0] * s[0] + s[1] * s[1]);
    }
    return relief_stretch(steep, n);
}

static double mean_height(const struct hm_mesh *m, const struct hm_elem *e)
{
    double z = 0;
    for (int k = 0; k < hm_elem_corners(e); k++)
        z += m->node[e->node[k]].z / hm_elem_corners(e);
    return z;
}

/* The shades of the ramp, each in several lights, which no legend names one by one; elements
 * without height have none. */
static enum hm_err by_height(struct classes *c, const struct hm_mesh *m,
                             const struct scale *heights, struct hm_diag *d)
{
    const double brightest = relief_light(1, -1), stretch = stretch_of(m);
    if (make_list(c, SHADES * LIGHTS, d))
        return HM_ENOMEM;
    for (int k = 0; k < SHADES * LIGHTS; k++) {
        struct rgb colour = ramp_colour(RAMP_HEIGHT, k / LIGHTS / (SHADES - 1.0));
        double light = k % LIGHTS / (LIGHTS - 1.0) * brightest;
        c->list[k].colour = (struct rgb){fmin(1, colour.r * light), fmin(1, colour.g * light),
                                         fmin(1, colour.b * light)};
    }
    for (size_t k = 0; k < m->nelems; k++) {
        double z = mean_height(m, &m->elem[k]), s[2];
        double shade = fmin(1, fmax(0, range_part(heights->range, z)));
        slope_of(m, &m->elem[k], s);
        double light = relief_light(s[0] * stretch, s[1] * stretch) / brightest;
        c->of[k] = -1;
        if (!isnan(z) && !isnan(light))
            c->of[k] =
                (int32_t)(round(shade * (SHADES - 1)) * LIGHTS + round(light * (LIGHTS - 1)));
    }
    return HM_OK;
}

static enum hm_err by_angle(struct classes *c, const struct hm_mesh *m, struct hm_diag *d)
{
    const struct rgb colour[ANGLES] = {GOOD, FAIR, DOUBTFUL, POOR};
    if (make_list(c, ANGLES, d))
        return HM_ENOMEM;
    for (int k = 0; k < ANGLES; k++) {
        c->list[k].colour = colour[k];
        snprintf(c->list[k].text, LEGEND_TEXT, "%s", angle_class[k].text);
    }
    for (size_t k = 0; k < m->nelems; k++) {
        double least, most;
        int32_t class = 0;
        hm_elem_angles(m, &m->elem[k], &least, &most);
        while (class < ANGLES - 1 && !(least >= angle_class[class].least))
            class ++;
        c->of[k] = class;
    }
    return HM_OK;
}

/* --- materials --- */

static int by_number(const void *a, const void *b)
{
    int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

/* The different materials of a mesh, ascending; *list is malloc'd. */
static enum hm_err materials_of(const struct hm_mesh *m, int32_t **list, size_t *n,
                                struct hm_diag *d)
{
    int32_t *all = hm_alloc(m->nelems, sizeof *all);
    if (!all)
        return hm_fail_memory(d);
    for (size_t k = 0; k < m->nelems; k++)
        all[k] = m->elem[k].region;
    qsort(all, m->nelems, sizeof *all, by_number);
    *n = 0;
    for (size_t k = 0; k < m->nelems; k++)
        if (*n == 0 || all[*n - 1] != all[k])
            all[(*n)++] = all[k];
    *list = all;
    return HM_OK;
}

/* Do all nodes of an element belong to that regular mesh? */
static bool is_owned(const struct hm_mesh *m, const struct hm_elem *e, int32_t owner)
{
    for (int k = 0; k < hm_elem_corners(e); k++)
        if (m->node[e->node[k]].owner != owner)
            return false;
    return true;
}

/* The word for an owner in the header: the k-th of `owners`; false when there is none. */
static bool owner_name(const struct hm_mesh *m, int32_t owner, char name[LEGEND_TEXT])
{
    const char *names = hm_header_get(&m->header, "owners");
    for (int32_t k = 1; names && *names; k++) {
        size_t length = strcspn(names, " \t");
        if (k == owner && length) {
            snprintf(name, LEGEND_TEXT, "%.*s", (int)length, names);
            return true;
        }
        names += length;
        names += strspn(names, " \t");
    }
    return false;
}

/* A material is called by the regular mesh whose number it bears when most of its elements are
 * that mesh's; 0 is the irregular mesh where there are others. */
static void name_material(const struct hm_mesh *m, int32_t material, bool owned,
                          char name[LEGEND_TEXT])
{
    const char *role = hm_header_get(&m->header, "role");
    const bool parted = hm_header_get(&m->header, "owners") || (role && !strcmp(role, "irregular"));
    if (material == 0)
        snprintf(name, LEGEND_TEXT, "%s", parted ? "irregular" : "mesh");
    else if (!owned || !owner_name(m, material, name))
        snprintf(name, LEGEND_TEXT, "material %d", (int)material);
}

static enum hm_err by_material(struct classes *c, const struct hm_mesh *m, struct hm_diag *d)
{
    int32_t *material = NULL;
    size_t n = 0;
    enum hm_err err = materials_of(m, &material, &n, d);
    if (err)
        return err;
    err = make_list(c, n, d);
    int64_t *count = hm_alloc0(2 * n, sizeof *count); /* of elements, and of those owned */
    if (!err && !count)
        err = hm_fail_memory(d);
    for (size_t k = 0; k < m->nelems && !err; k++) {
        const int32_t region = m->elem[k].region;
        const int32_t *at = bsearch(&region, material, n, sizeof *material, by_number);
        c->of[k] = (int32_t)(at - material);
        count[2 * c->of[k]]++;
        count[2 * c->of[k] + 1] += is_owned(m, &m->elem[k], region);
    }
    for (size_t k = 0; k < n && !err; k++) {
        c->list[k].colour = material_colour(material[k]);
        c->list[k].backdrop = material[k] == 0;
        name_material(m, material[k], 2 * count[2 * k + 1] > count[2 * k], c->list[k].text);
    }
    free(count);
    free(material);
    return err;
}

enum hm_err classify(struct classes *c, const struct hm_mesh *m, enum mesh_fill fill,
                     const struct scale *heights, struct hm_diag *d)
{
    *c = (struct classes){.of = hm_alloc(m->nelems, sizeof *c->of)};
    if (!c->of)
        return hm_fail_memory(d);
    enum hm_err err = fill == FILL_QUALITY ? by_angle(c, m, d)
                      : fill == FILL_Z     ? by_height(c, m, heights, d)
                                           : by_material(c, m, d);
    if (err)
        classes_free(c);
    return err;
}

/* --- residuals --- */

void residual_limits(const struct hm_header *h, double limits[2])
{
    const char *text = hm_header_get(h, "thresholds");
    if (text && hm_num_parse_list(text, ' ', limits, 2) == 2 && limits[0] <= limits[1])
        return;
    limits[0] = 0.10; /* the paper's Table 1 */
    limits[1] = 0.30;
}

const enum hm_residual_class residual_order[RESIDUAL_CLASSES] = {
    HM_RESIDUAL_GREEN, HM_RESIDUAL_YELLOW, HM_RESIDUAL_RED, HM_RESIDUAL_NONE};

struct class residual_class(enum hm_residual_class class, const double limits[2])
{
    const struct rgb colour[RESIDUAL_CLASSES] = {
        [HM_RESIDUAL_NONE] = GREY,
        [HM_RESIDUAL_GREEN] = GOOD,
        [HM_RESIDUAL_YELLOW] = FAIR,
        [HM_RESIDUAL_RED] = POOR,
    };
    struct class c = {.colour = colour[class]};
    if (class == HM_RESIDUAL_NONE)
        snprintf(c.text, LEGEND_TEXT, "without residual");
    else
        snprintf(c.text, LEGEND_TEXT,
                 class == HM_RESIDUAL_RED ? "over %.2f m off" : "up to %.2f m off",
                 limits[class == HM_RESIDUAL_GREEN ? 0 : 1]);
    return c;
}
