/* hm_regular_net: the control points of hm_regular.h as lines, for pictures like the paper's
 * figures 5 and 7. */
#include "hm_regular.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ATTRS = HM_ROUGH_NAME + 64 };

/* A line along one row (j) or column (i) of control points. */
static enum hm_err add_row(const struct hm_regular *s, const char *name, bool row, size_t at,
                           struct hm_lines *lines, struct hm_diag *d)
{
    char attrs[ATTRS];
    size_t n = row ? s->surface.n : s->surface.m;
    snprintf(attrs, sizeof attrs, "net=%s %s=%zu", name, row ? "row" : "column", at);
    struct hm_line line = {attrs, hm_alloc(n, 3 * sizeof *line.xyz), n, false};
    if (!line.xyz)
        return hm_fail_memory(d);
    for (size_t k = 0; k < n; k++)
        memcpy(line.xyz + 3 * k,
               hm_bsurf_at(&s->surface, (int64_t)(row ? k : at), (int64_t)(row ? at : k)),
               3 * sizeof *line.xyz);
    enum hm_err err = hm_lines_append(lines, &line, d);
    free(line.xyz);
    return err;
}

static enum hm_err add_move(const struct hm_regular *s, const char *name, int side, size_t i,
                            struct hm_lines *lines, struct hm_diag *d)
{
    char attrs[ATTRS];
    const double *from = s->laid[side] + 3 * i, *to = s->passed[side] + 2 * i;
    double xyz[6] = {from[0], from[1], NAN, to[0], to[1], NAN};
    snprintf(attrs, sizeof attrs, "move=%s side=%s moved=%d", name,
             side == HM_LEFT ? "left" : "right", s->snapped[side][i]);
    return hm_lines_append(lines, &(struct hm_line){attrs, xyz, 2, false}, d);
}

enum hm_err hm_regular_net(const struct hm_regular *s, const char *name, struct hm_lines *lines,
                           struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t j = 0; !err && j < s->surface.m; j++)
        err = add_row(s, name, true, j, lines, d);
    for (size_t i = 0; !err && i < s->surface.n; i++)
        err = add_row(s, name, false, i, lines, d);
    for (int side = HM_LEFT; side <= HM_RIGHT; side++)
        for (size_t i = 0; !err && i < s->surface.n; i++)
            err = add_move(s, name, side, i, lines, d);
    return err;
}
