/* Meshes: what is changed on the way, and how they are written. */
#include "hmconv.h"

#include "hm_data.h"
#include "hm_num.h"
#include "hm_split.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void shift(const struct job *j, struct hm_mesh *m)
{
    double x, y;
    const char *s = j->origin, *end = s + strlen(s), *comma = hm_num_parse(s, end, &x);
    if (!comma || *comma != ',' || hm_num_parse(comma + 1, end, &y) != end || !isfinite(x) ||
        !isfinite(y))
        hm_cli_die(j->cli, "--origin: '%s' is not two numbers with a comma between", j->origin);
    for (size_t k = 0; k < m->nnodes; k++) {
        m->node[k].x -= x;
        m->node[k].y -= y;
    }
    const char *crs = hm_header_get(&m->header, "crs");
    char text[512];
    struct hm_diag d = {0};
    snprintf(text, sizeof text, "%s, from %s", crs ? crs : "", j->origin);
    if (crs) /* it is not that any more */
        hm_cli_check(j->cli, hm_header_set(&m->header, "crs", text, &d), &d);
}

static void split(const struct job *j, struct hm_mesh *m)
{
    struct hm_diag d = {0};
    int64_t count;
    hm_cli_check(j->cli, hm_split_quads(m, &count, &d), &d);
    if (count > 0)
        hm_cli_say(j->cli, "%s split into triangles", hm_cli_counted(count, "quadrilateral").text);
}

/* Depths below --datum, which the reader takes to be below 0, become heights. */
static bool has_depths(const struct job *j)
{
    const struct hm_foreign *found = hm_reader_found(hm_cli_reader(j->cli));
    return found && !strcmp(found->name, "gr3") && j->datum != 0;
}

bool hmconv_changes_mesh(const struct job *j)
{
    return j->split || j->origin || has_depths(j);
}

enum hm_err hmconv_read_mesh(const struct job *j, struct hm_mesh *m, struct hm_header *h,
                             struct hm_diag *d)
{
    double datum = has_depths(j) ? j->datum : 0;
    enum hm_err err = hm_mesh_read(m, hm_cli_reader(j->cli), h, d);
    if (err)
        return err;
    for (size_t k = 0; k < m->nnodes && datum != 0; k++)
        m->node[k].z += datum;
    if (j->split || (j->to->lacks & NO_QUADS))
        split(j, m);
    if (j->origin)
        shift(j, m);
    return HM_OK;
}

enum hm_err hmconv_copy_mesh(const struct job *j, const struct hm_header *h, struct hm_diag *d)
{
    struct hm_mesh m = {0};
    struct hm_header own = {0};
    enum hm_err err = hm_header_copy(&own, h, d);
    if (!err)
        err = hmconv_read_mesh(j, &m, &own, d);
    if (!err)
        err = hm_header_add_history(&m.header, hm_cli_history(j->cli), d);
    if (!err)
        err = hm_mesh_write(&m, j->product, d);
    hm_mesh_free(&m);
    return err;
}

void hmconv_write_mesh(const struct job *j, struct hm_mesh *m)
{
    struct hm_diag d = {0};
    int lacks = j->to->lacks;
    for (size_t k = 0; k < m->nnodes; k++)
        if (!isfinite(m->node[k].z) && !(lacks & NO_HEIGHTS)) {
            hm_fail_at(&d, HM_EGEOM, m->node[k].x, m->node[k].y, "a node has no height");
            hm_cli_check(j->cli, HM_EGEOM, &d);
        }
    hmconv_say_mesh(j, m);
    for (size_t k = 0; k < m->nnodes && (lacks & DEPTHS); k++)
        m->node[k].z = j->datum - m->node[k].z;
    hm_cli_check(j->cli, j->to->write(m, j->product, &d), &d);
}
