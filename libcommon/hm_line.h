/* hm_line: polylines. Layer 3.
 *
 * Who owns what a line's pointers hold is said where the line stands: in hm_lines the set does, the
 * lines of a reader are the reader's until its next call, and a function that is given a line to
 * look at owns nothing of it.
 */
#ifndef HM_LINE_H
#define HM_LINE_H

#include "hm_header.h"

struct hm_line {
    char *attrs; /* key=value …; "" when it has none */
    double *xyz; /* 3 doubles a vertex; z may be NaN */
    size_t n;    /* vertices */
    bool closed; /* the last vertex joins the first, which is not repeated */
};

/* A set of lines, which owns their attributes and vertices. Begins life as `= {0}`, emptied by
 * hm_lines_free. */
struct hm_lines {
    struct hm_header header;
    struct hm_line *line;
    size_t n, cap;
};

/* Append a copy of line (without attributes when those are NULL). */
enum hm_err hm_lines_append(struct hm_lines *l, const struct hm_line *line, struct hm_diag *d);
void hm_lines_free(struct hm_lines *l);

#endif
