/* Points that stand one a line with nothing but their numbers, which is nearly all of nearly every
 * text: many lines at a time, on several threads. */
#include "hm_reader_private.h"

#include "hm_row.h"
#include "hm_thread.h"

#include <stdlib.h>

enum {
    MOST_LINES = 1 << 14,
    CHUNK = 1 << 9,      /* lines */
    LONG_LINE = 1 << 16, /* bytes; longer ones are not waited for here */
};

/* Whole lines in the buffer, and the rows that they become. */
struct hm_reader_plain {
    struct hm_team *team;
    size_t fields;
    double *rows;
    size_t n;
    const char *begin[MOST_LINES + 1]; /* of each line, and of what follows the last */
    size_t good[MOST_LINES / CHUNK];   /* lines of each chunk before the first that is none */
};

void hm_reader_free_plain(struct hm_reader *r)
{
    if (r->plain)
        hm_team_free(r->plain->team);
    free(r->plain);
}

static void find_lines(struct hm_reader_plain *l, const struct hm_input *in, size_t most)
{
    const char *s = hm_input_at(in), *end = s + hm_input_has(in), *lf;
    l->begin[0] = s;
    for (l->n = 0; l->n < most && (lf = memchr(s, '\n', (size_t)(end - s))); s = lf + 1)
        l->begin[++l->n] = lf + 1;
}

static size_t chunk_end(const struct hm_reader_plain *l, size_t chunk)
{
    return (chunk + 1) * CHUNK < l->n ? (chunk + 1) * CHUNK : l->n;
}

static void parse_chunk(void *arg, size_t chunk)
{
    struct hm_reader_plain *l = arg;
    size_t first = chunk * CHUNK, last = chunk_end(l, chunk), k;
    for (k = first; k < last; k++) {
        const char *s = l->begin[k], *end = l->begin[k + 1] - 1;
        double *v = l->rows + k * l->fields;
        if (end > s && end[-1] == '\r')
            end--;
        if (!hm_row_parse(s, end, v, l->fields) || !hm_reader_good_place(v))
            break;
    }
    l->good[chunk] = k - first;
}

/* Parse the lines found, and pass over those that are plain; their number. */
static size_t take_lines(struct hm_reader_plain *l, struct hm_input *in)
{
    size_t chunks = (l->n + CHUNK - 1) / CHUNK, good = 0;
    hm_team_for(l->team, chunks, parse_chunk, l);
    for (size_t c = 0; c < chunks && good == c * CHUNK; c++)
        good += l->good[c];
    in->pos = (size_t)(l->begin[good] - in->buf);
    in->line += (int64_t)good;
    return good;
}

enum hm_err hm_reader_plain_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                                   struct hm_diag *d)
{
    struct hm_reader_plain *l = r->plain;
    if (r->threads < 2)
        return HM_OK;
    if (!l) {
        l = r->plain = hm_alloc(1, sizeof *l);
        if (!l)
            return hm_fail_memory(d);
        l->team = hm_team_new(r->threads);
    }
    l->fields = r->nfields;
    enum hm_err err = HM_OK;
    for (bool plain = true; plain && *n < max && !err;) {
        l->rows = rows + *n * l->fields;
        find_lines(l, &r->in, max - *n < MOST_LINES ? max - *n : MOST_LINES);
        size_t good = take_lines(l, &r->in), has = hm_input_has(&r->in);
        *n += good;
        plain = good == l->n && (l->n > 0 || (has < LONG_LINE && !r->in.eof));
        if (plain && l->n == 0)
            err = hm_input_fill(&r->in, has + 1, d);
    }
    return err;
}
