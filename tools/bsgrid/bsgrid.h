/* bsgrid.h: what the parts of bsgrid share: what the user asked, and the points. */
#ifndef BSGRID_H
#define BSGRID_H

#include "hm_anchor.h"
#include "hm_bspline.h"
#include "hm_cellmean.h"
#include "hm_cli.h"

enum { TIN, MEAN, MEDIAN };
enum { FIT_GRID, FIT_POINTS };
enum { ALL, FIRST, LAST, ONLY };

struct command {
    double spacing;
    const char *region, *classes, *mask, *clean;
    int method, degree, iterations, fit, over, returns;
    double gap, tolerance, blunders;
    bool gap_given, blunders_given, derivatives, count, density, single;
};
extern struct command cmd;

enum { CLASSES = 256 };

/* Whether points span an area: two of them at different places, and whether any is off their line.
 */
struct spread {
    enum { NOWHERE, ONE_PLACE, ONE_LINE, AN_AREA } over;
    double a[2], b[2];
};

/* The points, as far as the method needs them. */
struct survey {
    double window[4]; /* w, e, s, n as asked, when there is one */
    bool has_window;
    struct hm_anchor out;   /* the nodes asked for (with a window) */
    struct hm_anchor nodes; /* those with their surroundings */
    struct hm_anchor fine;  /* the nodes written: those of `out`, oversampled */
    double reach[4];        /* points beyond are of no use */
    bool wanted[CLASSES];   /* -c */
    bool hold;              /* keep the points themselves, not only the sums of cells */
    double *xyz;            /* hold: x, y, z of each point */
    size_t n, cap;
    struct hm_cellmean *cells; /* not hold: sums of cells */
    double box[4];             /* extent of the points used */
    struct spread spread;
    int64_t used, without_z, duplicates, in_gaps, blunders;
};

/* points.c: add the points of the object just given; then lay the lattices for them. */
void read_points(struct hm_cli *cli, struct survey *s, const struct hm_header *h);
void place_nodes(struct hm_cli *cli, struct survey *s);

/* surface.c: the dragged surface, blunders taken out of the points; the rest of them to a file. */
struct hm_bsurf make_clean_surface(struct hm_cli *cli, struct survey *s);
void write_clean(struct hm_cli *cli, const struct survey *s);
/* The sums of cells of the points held. */
struct hm_cellmean *sum_cells(struct hm_cli *cli, const struct survey *s);

/* grid.c: the surface as a grid. */
void write_grid(struct hm_cli *cli, const struct survey *s, const struct hm_bsurf *b);

/* Room for a grid, or the end. */
static inline double *need(struct hm_cli *cli, size_t count, size_t size)
{
    double *p = hm_alloc(count, size);
    if (!p)
        hm_cli_die(cli,
                   "out of memory for a grid of %zu nodes: a window (-R) or a larger spacing "
                   "(-d) would help",
                   count);
    return p;
}

#endif
