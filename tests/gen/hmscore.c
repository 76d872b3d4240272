/* hmscore: how near found breaklines come to the true ones of hmsurvey.
 *
 *     hmscore [-t tolerance] [-f feature,…] COVER TRUE FOUND
 *
 * COVER is a grid with a band density (bsgrid --density); only places with measurements all around
 * count. Of the true lines those of the features named are asked for (main, tributary, ditch,
 * levee; all by default), but a found line near any true one is not false. Prints one line:
 *
 *     mean    distance of the found lines from the true ones, m, where they are within the
 * tolerance p95     its 95th percentile, m found   share of the true length with a found line
 * within the tolerance, % false   share of the found length without a true one within the
 * tolerance, % ratio   length of the found lines over that of the true ones they follow (zigzag)
 */
#include "hm_attr.h"
#include "hm_data.h"
#include "hm_polyline.h"
#include "hm_segindex.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct {
    double tolerance; /* metres */
    const char *features;
    const char *cover, *truth, *found;
} cmd = {.tolerance = 2, .features = "main,tributary,ditch,levee"};

static const double step = 0.25; /* metres between samples of a line */

static void check(enum hm_err err, const struct hm_diag *d)
{
    if (err) {
        fprintf(stderr, "hmscore: %s: %s\n", d->source, d->text);
        exit(2);
    }
}

static void parse(int argc, char **argv)
{
    const char **operand[] = {&cmd.cover, &cmd.truth, &cmd.found};
    int n = 0;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "-t") && i + 1 < argc)
            cmd.tolerance = strtod(argv[++i], NULL);
        else if (!strcmp(argv[i], "-f") && i + 1 < argc)
            cmd.features = argv[++i];
        else if (n < 3)
            *operand[n++] = argv[i];
    }
    if (n < 3 || !(cmd.tolerance > 0)) {
        fputs("usage: hmscore [-t tolerance] [-f feature,...] COVER TRUE FOUND\n", stderr);
        exit(2);
    }
}

/* --- what is read --- */

static struct hm_reader *open_object(const char *path, enum hm_kind kind, struct hm_header *h)
{
    struct hm_diag d = {0};
    struct hm_reader *r;
    check(hm_reader_open(&r, path, &d), &d);
    check(hm_reader_next(r, h, &d), &d);
    if (h->kind != kind) {
        fprintf(stderr, "hmscore: %s: not %s\n", path, hm_kind_name(kind));
        exit(2);
    }
    return r;
}

static struct hm_lines read_lines(const char *path)
{
    struct hm_header h;
    struct hm_diag d = {0};
    struct hm_lines lines = {0};
    struct hm_reader *r = open_object(path, HM_LINES, &h);
    check(hm_lines_read(&lines, r, &h, &d), &d);
    hm_reader_close(r);
    return lines;
}

static struct hm_grid read_cover(const char *path)
{
    struct hm_header h;
    struct hm_diag d = {0};
    struct hm_grid g = {0};
    struct hm_reader *r = open_object(path, HM_GRID, &h);
    check(hm_grid_read(&g, r, &h, &d), &d);
    hm_reader_close(r);
    return g;
}

/* Are there measurements all around, within 3 m? */
static bool is_covered(const struct hm_grid *g, const double *xy)
{
    const double reach = 3, least = 1; /* metres; points a square metre */
    const struct hm_lattice *l = &g->header.lattice;
    size_t band = (size_t)hm_header_field(&g->header, "density") - 2;
    int64_t i0 = (int64_t)floor((xy[0] - reach - l->x0) / l->dx);
    int64_t i1 = (int64_t)ceil((xy[0] + reach - l->x0) / l->dx);
    int64_t j0 = (int64_t)floor((xy[1] - reach - l->y0) / l->dy);
    int64_t j1 = (int64_t)ceil((xy[1] + reach - l->y0) / l->dy);
    if (i0 < 0 || j0 < 0 || i1 >= l->nx || j1 >= l->ny)
        return false;
    for (int64_t j = j0; j <= j1; j++)
        for (int64_t i = i0; i <= i1; i++)
            if (!(g->v[(size_t)(j * l->nx + i) * g->bands + band] >= least))
                return false;
    return true;
}

static bool is_asked(const struct hm_line *line)
{
    char of[32];
    hm_attr_get(line->attrs, "of", of, sizeof of);
    const char *at = strstr(cmd.features, of);
    return at && *of;
}

/* --- scores --- */

static struct hm_segindex *index_of(const struct hm_lines *lines)
{
    size_t n = 0, cap = 0;
    struct hm_segment *s = NULL;
    struct hm_diag d = {0};
    struct hm_segindex *x;
    for (size_t l = 0; l < lines->n; l++)
        for (size_t k = 0; k < hm_polyline_pieces(&lines->line[l]); k++) {
            if (!hm_grow(&s, &cap, n + 1, sizeof *s))
                check(hm_fail_memory(&d), &d);
            memcpy(s[n].a, hm_polyline_from(&lines->line[l], k), sizeof s[n].a);
            memcpy(s[n].b, hm_polyline_to(&lines->line[l], k), sizeof s[n].b);
            s[n].line = (int32_t)l;
            s[n++].piece = (int32_t)k;
        }
    check(hm_segindex_build(&x, s, n, &d), &d);
    free(s);
    return x;
}

struct score {
    double *away; /* distances of samples of found lines that follow one asked for */
    size_t n, cap;
    double follows, astray; /* length of found lines */
    double there, met;      /* length of true lines, and of those met */
};

/* Call `take` for samples along all lines, each standing for so many metres. */
static void walk(const struct hm_lines *lines,
                 void (*take)(void *arg, const struct hm_line *line, const double *xy,
                              double length),
                 void *arg)
{
    for (size_t l = 0; l < lines->n; l++)
        for (size_t k = 0; k < hm_polyline_pieces(&lines->line[l]); k++) {
            const double *a = hm_polyline_from(&lines->line[l], k);
            const double *b = hm_polyline_to(&lines->line[l], k);
            double length = hypot(b[0] - a[0], b[1] - a[1]);
            size_t n = (size_t)(length / step) + 1;
            for (size_t i = 0; i < n; i++) {
                double t = ((double)i + 0.5) / (double)n;
                double xy[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
                take(arg, &lines->line[l], xy, length / (double)n);
            }
        }
}

struct walk {
    struct score *score;
    const struct hm_grid *cover;
    const struct hm_lines *others; /* those to be near to */
    const struct hm_segindex *index;
};

static void take_found(void *arg, const struct hm_line *line, const double *xy, double length)
{
    const struct walk *w = arg;
    struct score *s = w->score;
    struct hm_diag d = {0};
    double foot[3], away;
    (void)line;
    if (!is_covered(w->cover, xy))
        return;
    const struct hm_segment *near =
        hm_segindex_nearest(w->index, xy[0], xy[1], cmd.tolerance, foot, &away);
    if (!near) {
        s->astray += length;
        return;
    }
    if (!is_asked(&w->others->line[near->line]))
        return;
    s->follows += length;
    if (!hm_grow(&s->away, &s->cap, s->n + 1, sizeof *s->away))
        check(hm_fail_memory(&d), &d);
    s->away[s->n++] = away;
}

static void take_true(void *arg, const struct hm_line *line, const double *xy, double length)
{
    const struct walk *w = arg;
    double foot[3], away;
    if (!is_asked(line) || !is_covered(w->cover, xy))
        return;
    w->score->there += length;
    if (hm_segindex_nearest(w->index, xy[0], xy[1], cmd.tolerance, foot, &away))
        w->score->met += length;
}

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void print(const struct score *s)
{
    double sum = 0;
    qsort(s->away, s->n, sizeof *s->away, by_value);
    for (size_t k = 0; k < s->n; k++)
        sum += s->away[k];
    double p95 = s->n > 0 ? s->away[(size_t)(0.95 * (double)s->n)] : NAN;
    printf("%.3f %.3f %.2f %.2f %.3f\n", s->n > 0 ? sum / (double)s->n : NAN, p95,
           100 * s->met / s->there, 100 * s->astray / (s->follows + s->astray),
           s->follows / s->met);
}

int main(int argc, char **argv)
{
    parse(argc, argv);
    struct hm_grid cover = read_cover(cmd.cover);
    struct hm_lines truth = read_lines(cmd.truth), found = read_lines(cmd.found);
    struct hm_segindex *of_truth = index_of(&truth), *of_found = index_of(&found);
    struct score score = {0};
    walk(&found, take_found, &(struct walk){&score, &cover, &truth, of_truth});
    walk(&truth, take_true, &(struct walk){&score, &cover, &found, of_found});
    print(&score);
    hm_segindex_free(of_truth);
    hm_segindex_free(of_found);
    hm_lines_free(&truth);
    hm_lines_free(&found);
    hm_grid_free(&cover);
    free(score.away);
    return 0;
}
