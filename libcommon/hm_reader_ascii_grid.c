/* ESRI ASCII grids: a few keys, then the values row by row, the north first. */
#include "hm_reader_private.h"

#include "hm_row.h"

#include <stdlib.h>
#include <strings.h>

struct ascii_grid {
    double nodata;
    const char *s, *end; /* what is left of the current line */
};

/* The keys; xll and yll may say the corner of the first cell, or its centre. */
enum key { NCOLS, NROWS, XCORNER, XCENTER, YCORNER, YCENTER, CELLSIZE, DX, DY, NODATA, KEYS };
static const char *const names[KEYS] = {"ncols",     "nrows",       "xllcorner", "xllcenter",
                                        "yllcorner", "yllcenter",   "cellsize",  "dx",
                                        "dy",        "nodata_value"};

static enum key which(const char *s, const char *end)
{
    int k = 0;
    while (k < KEYS && (strlen(names[k]) != (size_t)(end - s) ||
                        strncasecmp(names[k], s, (size_t)(end - s)) != 0))
        k++;
    return (enum key)k;
}

bool hm_reader_is_ascii_grid(const char *s, const char *end)
{
    const char *stop = s;
    while (stop < end && !strchr(" \t\r\n", *stop))
        stop++;
    return which(s, stop) < KEYS;
}

/* The next line with anything in it. */
static enum hm_err next_line(struct hm_reader *r, const char **s, const char **end,
                             struct hm_diag *d)
{
    enum hm_err err;
    do {
        err = hm_input_line(&r->in, s, end, d);
        if (!err)
            *s = hm_row_skip(*s, *end);
    } while (!err && *s == *end);
    return err;
}

/* The keys to v, NAN where there is none, up to the first line of values, which is not consumed. */
static enum hm_err read_keys(struct hm_reader *r, double v[KEYS], struct hm_diag *d)
{
    for (int k = 0; k < KEYS; k++)
        v[k] = NAN;
    for (;;) {
        const char *s, *end, *stop;
        char word[HM_ROW_WORD];
        enum hm_err err = next_line(r, &s, &end, d);
        if (err == HM_END)
            return hm_input_fail(&r->in, HM_ETRUNC, d,
                                 "cut off: an ESRI ASCII grid without values");
        if (err)
            return err;
        stop = hm_row_field(&s, end, false);
        enum key k = which(s, stop);
        double number;
        if (k == KEYS && hm_num_parse(s, stop, &number) == stop) {
            hm_input_unread(&r->in);
            return HM_OK;
        }
        if (k == KEYS)
            return hm_input_fail(&r->in, HM_EFORMAT, d, "no key of an ESRI ASCII grid: \"%s\"",
                                 hm_row_word(word, s, stop));
        if (!hm_row_parse(stop, end, &v[k], 1))
            return hm_row_fail(&r->in, stop, end, 1, false, d);
    }
}

/* The nodes are the centres of the cells, half a cell inside the corner. */
static enum hm_err make_lattice(struct hm_reader *r, const double v[KEYS], struct hm_lattice *l,
                                struct hm_diag *d)
{
    double dx = isnan(v[DX]) ? v[CELLSIZE] : v[DX], dy = isnan(v[DY]) ? v[CELLSIZE] : v[DY];
    bool whole = v[NCOLS] >= 1 && v[NROWS] >= 1 && v[NCOLS] <= HM_MAX_SIDE &&
                 v[NROWS] <= HM_MAX_SIDE && v[NCOLS] == floor(v[NCOLS]) &&
                 v[NROWS] == floor(v[NROWS]);
    if (!whole)
        return hm_input_fail(&r->in, HM_EFORMAT, d, "ncols and nrows must be whole, 1 to %d",
                             HM_MAX_SIDE);
    if (!(dx > 0 && dy > 0))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "cellsize must be over 0");
    double rows = v[NROWS] - 1;
    l->nx = (int64_t)v[NCOLS];
    l->ny = (int64_t)v[NROWS];
    l->dx = dx;
    l->dy = -dy;
    l->x0 = isnan(v[XCENTER]) ? v[XCORNER] + dx / 2 : v[XCENTER];
    l->y0 = isnan(v[YCENTER]) ? v[YCORNER] + (rows + 0.5) * dy : v[YCENTER] + rows * dy;
    if (isnan(l->x0) || isnan(l->y0))
        return hm_input_fail(&r->in, HM_EFORMAT, d, "xllcorner or yllcorner is missing");
    struct hm_diag why = {0};
    enum hm_err err = hm_headio_check_lattice(l, 1, &why);
    return err ? hm_input_fail(&r->in, err, d, "%s", why.text) : HM_OK;
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    double v[KEYS];
    struct ascii_grid *g = hm_alloc0(1, sizeof *g);
    if (!g)
        return hm_fail_memory(d);
    r->state = g;
    enum hm_err err = hm_header_init(h, HM_GRID, d);
    if (!err)
        err = read_keys(r, v, d);
    if (!err)
        err = make_lattice(r, v, &h->lattice, d);
    g->nodata = isnan(v[NODATA]) ? -9999 : v[NODATA];
    return err;
}

/* The next value; rows of the grid and lines of the file need not agree. */
static enum hm_err read_value(struct hm_reader *r, double *v, struct hm_diag *d)
{
    struct ascii_grid *g = r->state;
    g->s = hm_row_skip(g->s, g->end);
    if (g->s == g->end) {
        enum hm_err err = next_line(r, &g->s, &g->end, d);
        if (err == HM_END)
            return hm_input_fail(&r->in, HM_ETRUNC, d, "cut off: %lld of %lld values",
                                 (long long)r->records, (long long)(r->lattice.nx * r->lattice.ny));
        if (err)
            return err;
    }
    const char *stop = hm_num_parse(g->s, g->end, v);
    if (!stop || (stop < g->end && !hm_row_is_blank(*stop))) {
        char word[HM_ROW_WORD];
        return hm_input_fail(&r->in, HM_EFORMAT, d, "expected a number, got \"%s\"",
                             hm_row_word(word, g->s, hm_row_field(&g->s, g->end, false)));
    }
    g->s = stop;
    r->records++;
    if (*v == g->nodata || (float)*v == (float)g->nodata)
        *v = NAN;
    return isinf(*v) ? hm_input_fail(&r->in, HM_EFORMAT, d, "z is infinite") : HM_OK;
}

/* Behind the last value nothing may be that looks like one more. */
static enum hm_err check_end(struct hm_reader *r, struct hm_diag *d)
{
    struct ascii_grid *g = r->state;
    double v;
    enum hm_err err = HM_OK;
    if (hm_row_skip(g->s, g->end) == g->end) {
        err = next_line(r, &g->s, &g->end, d);
        if (err)
            return err;
        if (!hm_num_parse(g->s, g->end, &v)) {
            hm_input_unread(&r->in);
            return HM_END;
        }
    }
    return hm_input_fail(&r->in, HM_EFORMAT, d, "more than the %lld values of the grid",
                         (long long)(r->lattice.nx * r->lattice.ny));
}

static enum hm_err read_row(struct hm_reader *r, double *row, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    if (r->rows == r->lattice.ny) {
        err = check_end(r, d);
        r->ended = err == HM_END;
        return err;
    }
    for (int64_t i = 0; i < r->lattice.nx && !err; i++)
        err = read_value(r, row + i, d);
    return err;
}

const struct hm_reader_form hm_reader_ascii_grid = {.begin = begin, .row = read_row};
