/* What is written when all inputs were read. */
#include "hmconv.h"

#include "hm_data.h"
#include "hm_export.h"

#include <string.h>

static struct hm_inputs held;
static size_t held_band;

static bool is_format(const struct job *j, const char *name)
{
    return !strcmp(j->to->name, name);
}

/* Some memory, or the end. */
static void *need(const struct job *j, void *memory)
{
    if (!memory)
        hm_cli_die(j->cli, "out of memory");
    return memory;
}

enum hm_err hmconv_hold(const struct job *j, const struct hm_header *h, struct hm_diag *d)
{
    struct hm_header own = {0};
    struct hm_reader *r = hm_cli_reader(j->cli);
    enum hm_err err = hm_header_copy(&own, h, d);
    if (err)
        return err;
    switch (h->kind) {
    case HM_POINTS:
        return hm_points_read(need(j, hm_inputs_add_points(&held)), r, &own, d);
    case HM_LINES:
        return hm_lines_read(need(j, hm_inputs_add_lines(&held)), r, &own, d);
    case HM_GRID:
        held_band = hmconv_band(j, h);
        return hm_grid_read(need(j, hm_inputs_add_grid(&held)), r, &own, d);
    default:
        return hmconv_read_mesh(j, need(j, hm_inputs_add_mesh(&held)), &own, d);
    }
}

/* Lines for a GIS, or for Triangle, and the points with them. */
static void write_features(const struct job *j)
{
    struct hm_diag d = {0};
    int64_t lost = 0;
    int decimals = hm_cli_format(j->cli).decimals;
    enum hm_err err;
    if (is_format(j, "ogrgmt"))
        err = hm_export_ogrgmt(&held, decimals, j->product, &d);
    else if (is_format(j, "geojson"))
        err = hm_export_geojson(&held, decimals, &lost, j->product, &d);
    else
        err = hm_export_wkt(&held, decimals, &lost, j->product, &d);
    hm_cli_check(j->cli, err, &d);
    if (lost > 0)
        hm_cli_say(j->cli, "%s without a height at some vertex: all heights of it dropped",
                   hm_cli_counted(lost, "line").text);
}

static void write_planar(const struct job *j)
{
    struct hm_diag d = {0};
    int64_t lost = 0;
    enum hm_err err;
    if (held.nmeshes > 1 || (held.nmeshes > 0 && held.npoints > 0))
        hm_cli_die(j->cli, "a node file holds points, or the nodes of one mesh, and no more");
    err = is_format(j, "node") ? hm_export_node(&held, j->product, &d)
                               : hm_export_poly(&held, &lost, j->product, &d);
    hm_cli_check(j->cli, err, &d);
    if (lost > 0)
        hm_cli_say(j->cli, "%s dropped: another vertex at that place has another",
                   hm_cli_counted(lost, "height").text);
}

void hmconv_write_held(const struct job *j)
{
    struct hm_diag d = {0};
    int decimals = hm_cli_format(j->cli).decimals;
    switch (j->to->way) {
    case MESH:
        hmconv_write_mesh(j, &held.mesh[0]);
        break;
    case GRID:
        hm_cli_check(j->cli, hm_export_asc(&held.grid[0], held_band, decimals, j->product, &d), &d);
        break;
    case FEATURES:
        write_features(j);
        break;
    default:
        write_planar(j);
        break;
    }
    hm_inputs_free(&held);
}
