/* SCHISM hgrid.gr3 and ADCIRC fort.14: title, counts, nodes, elements, open boundaries, land. */
#include "hm_export_private.h"

/* A run of boundary nodes: `n` edges of a loop from place `from` on. */
static void write_run(struct hm_sink *s, const struct hm_export_border *b, size_t k, size_t from,
                      size_t nodes)
{
    for (size_t i = 0, at = from; i < nodes; i++, at = hm_export_border_next(b, k, at)) {
        hm_sink_integer(s, (int64_t)b->loops.node[at] + 1);
        hm_sink_text(s, "\n");
    }
}

static bool is_open(const struct hm_export_border *b, size_t place)
{
    int32_t string = b->string[place];
    return string >= 0 && hm_export_side_of(b->strings.string[string].name) != HM_SIDE_WALL;
}

/* Does a run begin at this edge: another string than at the edge before it, or land after open? */
static bool begins(const struct hm_export_border *b, size_t k, size_t place)
{
    size_t first = b->loops.start[k];
    size_t before = place > first ? place - 1 : b->loops.start[k + 1] - 1;
    if (is_open(b, place) && is_open(b, before))
        return b->string[place] != b->string[before];
    return is_open(b, place) != is_open(b, before);
}

/* Edges from one that begins a run to the next such. */
static size_t run_length(const struct hm_export_border *b, size_t k, size_t place)
{
    size_t n = 1;
    for (size_t at = hm_export_border_next(b, k, place); !begins(b, k, at);
         at = hm_export_border_next(b, k, at))
        n++;
    return n;
}

/* The runs of one sort; counted only, when s is NULL. */
struct runs {
    int64_t count, nodes;
};

static void put_run(struct hm_sink *s, const struct hm_export_border *b, size_t k, size_t from,
                    size_t nodes, const char *type, struct runs *r)
{
    r->count++;
    r->nodes += (int64_t)nodes;
    if (!s)
        return;
    hm_sink_format(s, "%zu %s\n", nodes, type);
    write_run(s, b, k, from, nodes);
}

static struct runs each_run(struct hm_sink *s, const struct hm_export_border *b,
                            const struct hm_mesh *m, bool open)
{
    struct runs r = {0};
    for (size_t k = 0; k < b->loops.nloops; k++) {
        bool any = false;
        for (size_t i = b->loops.start[k]; i < b->loops.start[k + 1]; i++) {
            if (!begins(b, k, i))
                continue;
            any = true;
            if (is_open(b, i) == open)
                put_run(s, b, k, i, run_length(b, k, i) + 1, "0", &r);
        }
        size_t first = b->loops.start[k], n = b->loops.start[k + 1] - first;
        bool island = hm_export_is_island(b, m, k);
        if (any || is_open(b, first) != open)
            continue;
        put_run(s, b, k, first, island ? n : n + 1, !open && island ? "1" : "0", &r);
    }
    return r;
}

static void write_boundaries(struct hm_sink *s, const struct hm_export_border *b,
                             const struct hm_mesh *m)
{
    struct runs open = each_run(NULL, b, m, true), land = each_run(NULL, b, m, false);
    hm_sink_format(s,
                   "%lld = Number of open boundaries\n%lld = Total number of open boundary nodes\n",
                   (long long)open.count, (long long)open.nodes);
    each_run(s, b, m, true);
    hm_sink_format(s,
                   "%lld = Number of land boundaries\n%lld = Total number of land boundary nodes\n",
                   (long long)land.count, (long long)land.nodes);
    each_run(s, b, m, false);
}

enum hm_err hm_export_gr3(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_export_border b;
    enum hm_err err = hm_export_border_build(&b, m, d);
    if (err)
        return err;
    struct hm_sink s = hm_sink_to(w, d);
    hm_sink_text(&s, hm_export_name(m));
    hm_sink_format(&s, "\n%zu %zu\n", m->nelems, m->nnodes);
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_integer(&s, (int64_t)k + 1);
        hm_export_place(&s, &m->node[k]);
        hm_sink_text(&s, "\n");
    }
    for (size_t k = 0; k < m->nelems; k++) {
        hm_sink_format(&s, "%zu %d", k + 1, hm_elem_corners(&m->elem[k]));
        hm_export_corners(&s, &m->elem[k], 1);
        hm_sink_text(&s, "\n");
    }
    write_boundaries(&s, &b, m);
    hm_export_border_free(&b);
    return hm_sink_finish(&s);
}
