/* hm_header: what stands above the data of an object in a stream. Layer 3.
 *
 * The text form is a block of lines that begin with '#' (hybridmesh(5)). Keys that describe the
 * shape of the data (size, origin, step, fields) are held in fields of their own, the programs that
 * made the data in `history`, every other key in `keys`, in order, known or not.
 */
#ifndef HM_HEADER_H
#define HM_HEADER_H

#include "hm_base.h"

enum hm_kind { /* bits, so that sets of kinds can be said */
               HM_POINTS = 1,
               HM_GRID = 2,
               HM_LINES = 4,
               HM_MESH = 8,
               HM_ANY = 15
};

/* "points", "grid", "lines" or "mesh" */
const char *hm_kind_name(enum hm_kind kind);

struct hm_key {
    char *name;  /* without '#' */
    char *value; /* the rest of the line, without surrounding blanks */
};

struct hm_lattice {
    int64_t nx, ny; /* nodes along x and along y */
    double x0, y0;  /* the first node of the first row */
    double dx, dy;  /* signed: node (i, j) is at x0 + i*dx, y0 + j*dy */
};

struct hm_header {
    enum hm_kind kind;
    struct hm_lattice lattice; /* grids only */
    char **fields;             /* names of the columns: x y z … ; not for meshes */
    size_t nfields;            /* for a grid 2 + number of bands */
    struct hm_key *keys;
    size_t nkeys;
    char **history; /* the `#prog` lines without their key, oldest first */
    size_t nhistory;
    int64_t count; /* records announced by `#count`; -1 when not said */
};

/* An empty header of a kind with its default fields: x y z (grid: x y z as well, one band). */
enum hm_err hm_header_init(struct hm_header *h, enum hm_kind kind, struct hm_diag *d);
void hm_header_free(struct hm_header *h);
enum hm_err hm_header_copy(struct hm_header *to, const struct hm_header *from, struct hm_diag *d);

/* Value of a key ("crs", "units", "name", "role", …), or NULL. */
const char *hm_header_get(const struct hm_header *h, const char *name);

/* Set, replace in place, or (value NULL) remove a key. HM_EARG for a line break in name or value.
 */
enum hm_err hm_header_set(struct hm_header *h, const char *name, const char *value,
                          struct hm_diag *d);

/* Append a key, even one that is there already: `#string` may stand for several boundary strings.
 * HM_EARG as above. */
enum hm_err hm_header_add(struct hm_header *h, const char *name, const char *value,
                          struct hm_diag *d);

/* Column of a field by name, from 0 (x); -1 when there is none. Band = column - 2. */
int hm_header_field(const struct hm_header *h, const char *name);

/* Unit of a column (0: x), cut to size: what `units` says, else "m" for x, y, z and "1" (a number)
 * for others. */
void hm_header_unit(const struct hm_header *h, size_t column, char *unit, size_t size);

/* Append a column with its unit (NULL: "1"). Keeps `#units` in step with `#fields`; columns without
 * a unit so far are taken for metres (x, y, z) or numbers. */
enum hm_err hm_header_add_field(struct hm_header *h, const char *name, const char *unit,
                                struct hm_diag *d);

/* Append one history line. */
enum hm_err hm_header_add_history(struct hm_header *h, const char *line, struct hm_diag *d);

/* Bring what `from` says into h, as a program with several inputs does: history lines that h lacks
 * or has less often (what both have they have in common; equal stages of one history all stay),
 * keys that h lacks (but never what holds for one object alone: name, role, string; units go by the
 * names of the fields). HM_EFORMAT when both have a crs, or
 * units of x, y, z, and they differ. */
enum hm_err hm_header_merge(struct hm_header *h, const struct hm_header *from, struct hm_diag *d);

/* HM_EFORMAT when the crs says longitude and latitude, where metres are needed; names georef. */
enum hm_err hm_header_need_metres(const struct hm_header *h, struct hm_diag *d);

/* HM_EFORMAT when x, y and z have different units; names georef. */
enum hm_err hm_header_need_one_unit(const struct hm_header *h, struct hm_diag *d);

#endif
