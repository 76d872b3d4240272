/* Parts of hmconv: what it was asked, and how objects come into the formats of other programs. */
#ifndef HMCONV_H
#define HMCONV_H

#include "hm_cli.h"

typedef enum hm_err write_mesh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d);

/* What a format of meshes has no place for, or has otherwise. */
enum {
    NO_QUADS = 1,
    NO_STRINGS = 2,
    NO_REGIONS = 4,
    NO_HEIGHTS = 8,
    DEPTHS = 16,       /* positive down */
    FROM_ONE = 32,     /* no region 0 */
    SEVEN_PLACES = 64, /* behind the point */
    NO_CRS = 128,
    CRS_OF_EPSG = 256, /* only one that has a code */
    CRS_OF_UTM = 512   /* only that */
};

/* How a format is written: as objects come, or held until all inputs were read, so that nothing is
 * written when one of them is broken. */
enum way {
    STREAM,   /* the project's own */
    XYZ,      /* tables, as they come */
    CSV,      /* with names */
    GMT,      /* lines, as they come */
    CRS,      /* nothing but that */
    MESH,     /* one mesh, held */
    GRID,     /* one grid, held */
    FEATURES, /* all points and lines, held: for a GIS */
    PLANAR    /* the same for Triangle */
};

struct format {
    const char *name;
    enum way way;
    int kinds; /* that it can hold */
    write_mesh *write;
    int lacks;
};

/* What the user asked for. */
struct job {
    struct hm_cli *cli;
    const struct format *to;
    struct hm_writer *product;
    bool info, split;
    const char *band, *origin;
    double datum;
};

/* --- losses.c: say what the format cannot hold --- */

/* Of what a header says: the crs, units. */
void hmconv_say_header(const struct job *j, const struct hm_header *h);
/* Columns from `first` on, but for one. */
void hmconv_say_columns(const struct job *j, const struct hm_header *h, size_t first, size_t but);
/* Names of columns behind the height. */
void hmconv_say_names(const struct job *j, const struct hm_header *h);
void hmconv_say_mesh(const struct job *j, const struct hm_mesh *m);

/* --- tables.c: objects as they come --- */

/* Number of the band that the user asked for. */
size_t hmconv_band(const struct job *j, const struct hm_header *h);
/* The points or the grid just given to a table; *left_out counts those without height. */
enum hm_err hmconv_table(const struct job *j, const struct hm_header *h, int64_t *left_out,
                         struct hm_diag *d);
/* The lines just given, GMT multisegment. */
enum hm_err hmconv_lines(const struct job *j, struct hm_diag *d);

/* --- meshes.c --- */

/* Is the mesh just given changed on its way to a stream? */
bool hmconv_changes_mesh(const struct job *j);
/* The mesh just given, as asked, but for its format; h is taken over. */
enum hm_err hmconv_read_mesh(const struct job *j, struct hm_mesh *m, struct hm_header *h,
                             struct hm_diag *d);
/* It to a stream, */
enum hm_err hmconv_copy_mesh(const struct job *j, const struct hm_header *h, struct hm_diag *d);
/* and one to the format. */
void hmconv_write_mesh(const struct job *j, struct hm_mesh *m);

/* --- held.c: what is written when all inputs were read --- */

/* Keep the object just given. */
enum hm_err hmconv_hold(const struct job *j, const struct hm_header *h, struct hm_diag *d);
/* Write all that was kept, and forget it. */
void hmconv_write_held(const struct job *j);

#endif
