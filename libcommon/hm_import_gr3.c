/* SCHISM hgrid.gr3 and ADCIRC fort.14. */
#include "hm_import_private.h"
#include "hm_num.h"
#include "hm_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The numbers that a line begins with, up to `most`; a comment may stand behind them. */
static int leading_numbers(const char **line, const char *end, double *v, int most)
{
    const char *s = *line, *lf = memchr(s, '\n', (size_t)(end - s));
    const char *stop = lf ? lf : end;
    int n = 0;
    *line = lf ? lf + 1 : end;
    if (stop > s && stop[-1] == '\r')
        stop--;
    while (n < most && (s = hm_row_skip(s, stop)) < stop && (s = hm_num_parse(s, stop, &v[n])))
        n++;
    return n;
}

static bool is_whole(double v)
{
    return v >= 0 && v <= INT32_MAX && v == floor(v);
}

/* Under a title, two counts, and then a node: no table has such lines. */
bool hm_import_is_gr3(const char *s, const char *end)
{
    double counts[3], node[5];
    const char *lf = memchr(s, '\n', (size_t)(end - s));
    if (!lf || hm_import_begins(s, end, "MESH") || *s == '>' || *s == '#')
        return false;
    s = lf + 1;
    return leading_numbers(&s, end, counts, 3) == 2 && is_whole(counts[0]) && is_whole(counts[1]) &&
           counts[0] > 0 && counts[1] > 0 && leading_numbers(&s, end, node, 5) == 4 &&
           is_whole(node[0]);
}

static enum hm_err read_nodes(struct hm_words *w, struct hm_mesh *m, int32_t count,
                              struct hm_ids *ids)
{
    const char *s, *end;
    for (int32_t k = 0; k < count && !w->err; k++) {
        int32_t id = hm_words_integer(w);
        double xyz[3];
        for (int i = 0; i < 3; i++)
            xyz[i] = hm_words_number(w);
        xyz[2] = 0 - xyz[2]; /* not -0 */
        if (!w->err)
            w->err = hm_ids_add(ids, id, w->d);
        if (!w->err)
            w->err = hm_import_node(w->in, m, xyz, w->d);
        if (w->s < w->end)
            hm_words_line(w, &s, &end);
    }
    return w->err ? w->err : hm_ids_sort(ids, w->in->name, w->d);
}

static enum hm_err read_elems(struct hm_words *w, struct hm_mesh *m, int32_t count,
                              const struct hm_ids *ids)
{
    const char *s, *end;
    for (int32_t k = 0; k < count && !w->err; k++) {
        int64_t node[4];
        hm_words_integer(w);
        int32_t corners = hm_words_integer(w);
        if (!w->err && corners != 3 && corners != 4)
            hm_words_fail(w, "an element has neither three nor four corners");
        for (int32_t i = 0; i < corners && !w->err; i++)
            node[i] = hm_ids_find(ids, hm_words_integer(w));
        if (!w->err)
            w->err = hm_import_elem(w->in, m, node, corners, 0, w->d);
        if (w->s < w->end)
            hm_words_line(w, &s, &end);
    }
    return w->err;
}

/* The number that a line begins with. */
static int32_t read_count(struct hm_words *w)
{
    const char *s, *end;
    int32_t v = hm_words_count(w);
    if (w->s < w->end)
        hm_words_line(w, &s, &end);
    return v;
}

/* An open boundary as the string open1, open2 …; land is what is left. */
static void read_open(struct hm_words *w, struct hm_mesh *m, int32_t number,
                      const struct hm_ids *ids)
{
    int64_t *node = NULL;
    size_t cap = 0, n = 0;
    char name[24];
    int32_t count = read_count(w);
    for (; n < (size_t)count && !w->err; n++) {
        if (!hm_grow(&node, &cap, n + 1, sizeof *node))
            w->err = hm_fail_memory(w->d);
        else if ((node[n] = hm_ids_find(ids, read_count(w))) < 0)
            hm_words_fail(w, "an open boundary has a node that is not there");
    }
    snprintf(name, sizeof name, "open%d", number);
    if (!w->err && n > 0)
        w->err = hm_import_string(m, name, node, n, w->d);
    free(node);
}

enum hm_err hm_import_gr3(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d)
{
    struct hm_words w = {.in = in, .d = d};
    struct hm_ids ids = {0};
    const char *s, *end, *word;
    if (hm_words_line(&w, &s, &end))
        w.err = hm_import_name(m, s, end, d);
    int32_t elems = hm_words_count(&w), nodes = hm_words_count(&w);
    if (w.s < w.end)
        hm_words_line(&w, &s, &end);
    if (!w.err)
        w.err = read_nodes(&w, m, nodes, &ids);
    if (!w.err)
        w.err = read_elems(&w, m, elems, &ids);
    if (!w.err && hm_words_next(&w, &word) > 0) { /* the boundaries may be missing */
        w.s = word;
        int32_t open = read_count(&w);
        read_count(&w);
        for (int32_t k = 0; k < open && !w.err; k++)
            read_open(&w, m, k + 1, &ids);
    }
    while (hm_words_line(&w, &s, &end)) /* land, and what else */
        ;
    hm_ids_free(&ids);
    return w.err;
}
