#include "hm_line.h"

#include <stdlib.h>
#include <string.h>

enum hm_err hm_lines_append(struct hm_lines *l, const struct hm_line *line, struct hm_diag *d)
{
    if (!hm_grow(&l->line, &l->cap, l->n + 1, sizeof *l->line))
        return hm_fail_memory(d);
    struct hm_line copy = *line;
    copy.attrs = strdup(line->attrs ? line->attrs : "");
    copy.xyz = hm_alloc(line->n, 3 * sizeof *copy.xyz);
    if (!copy.attrs || !copy.xyz) {
        free(copy.attrs);
        free(copy.xyz);
        return hm_fail_memory(d);
    }
    if (line->n > 0)
        memcpy(copy.xyz, line->xyz, line->n * 3 * sizeof *copy.xyz);
    l->line[l->n++] = copy;
    return HM_OK;
}

void hm_lines_free(struct hm_lines *l)
{
    hm_header_free(&l->header);
    for (size_t i = 0; i < l->n; i++) {
        free(l->line[i].attrs);
        free(l->line[i].xyz);
    }
    free(l->line);
    *l = (struct hm_lines){0};
}
