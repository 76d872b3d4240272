/* hm_import_private: what the readers of mesh formats share. Layer 6. */
#ifndef HM_IMPORT_PRIVATE_H
#define HM_IMPORT_PRIVATE_H

#include "hm_ids.h"
#include "hm_import.h"
#include "hm_input.h"
#include "hm_inputs.h"

bool hm_import_is_ugrid(const char *s, const char *end);
bool hm_import_is_slf(const char *s, const char *end);
bool hm_import_is_gr3(const char *s, const char *end);
bool hm_import_is_kalypso(const char *s, const char *end);
bool hm_import_is_msh(const char *s, const char *end);
bool hm_import_is_ply(const char *s, const char *end);
bool hm_import_is_vtk(const char *s, const char *end);
bool hm_import_is_geojson(const char *s, const char *end);
bool hm_import_is_wkt(const char *s, const char *end);
bool hm_import_is_triangle(const char *s, const char *end);
enum hm_err hm_import_ugrid(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_slf(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_gr3(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_kalypso(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_msh(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_ply(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_vtk(struct hm_input *in, struct hm_mesh *m, struct hm_diag *d);
enum hm_err hm_import_geojson(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d);
enum hm_err hm_import_wkt(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d);
enum hm_err hm_import_triangle(struct hm_input *in, struct hm_inputs *o, struct hm_diag *d);

/* Does a file begin with this text? */
bool hm_import_begins(const char *s, const char *end, const char *text);

/* Text as words, wherever its lines end. A failure is kept, all that follows does nothing then, and
 * numbers are 0: so it is looked at once a record. */
struct hm_words {
    struct hm_input *in;
    struct hm_diag *d;
    enum hm_err err;
    const char *s, *end; /* what is left of the line */
};

/* The next word; its length, 0 at the end of the file (no failure) and after failures. */
size_t hm_words_next(struct hm_words *w, const char **word);
/* The next line, or what is left of this one; false at the end of the file and after failures. */
bool hm_words_line(struct hm_words *w, const char **s, const char **end);
/* HM_ETRUNC at the end of the file, HM_EFORMAT for words that are no such number. */
double hm_words_number(struct hm_words *w);
int32_t hm_words_integer(struct hm_words *w); /* -2^31 .. 2^31-1 */
int32_t hm_words_count(struct hm_words *w);   /* 0 .. 2^31-1 */
/* The word that must stand here. */
void hm_words_expect(struct hm_words *w, const char *word);
void hm_words_fail(struct hm_words *w, const char *text);

/* Append a node, and an element of the numbers of its nodes; failures name the line. */
enum hm_err hm_import_node(struct hm_input *in, struct hm_mesh *m, const double xyz[3],
                           struct hm_diag *d);
enum hm_err hm_import_elem(struct hm_input *in, struct hm_mesh *m, const int64_t *node, int corners,
                           int64_t region, struct hm_diag *d);

/* Append the key `#string name n n …`. */
enum hm_err hm_import_string(struct hm_mesh *m, const char *name, const int64_t *node, size_t n,
                             struct hm_diag *d);

/* The title of a file as the name of the mesh, if it is one word. */
enum hm_err hm_import_name(struct hm_mesh *m, const char *s, const char *end, struct hm_diag *d);

/* The features of a GIS: places with properties beside them. Points become the points of `o`, their
 * numbers fields; lines and the rings of polygons its lines, properties their attributes. */
struct hm_features {
    struct hm_input *in;
    struct hm_inputs *o;
    struct hm_diag *d;
    char *attrs; /* of the feature being read */
    double *xyz; /* the vertices read of its line, or its points */
    size_t n, cap;
};
enum hm_shape { HM_SHAPE_POINTS, HM_SHAPE_LINE, HM_SHAPE_RING, HM_SHAPE_HOLE };

/* Another feature begins: it has no properties, */
enum hm_err hm_features_begin(struct hm_features *f);
/* but for these. */
enum hm_err hm_features_property(struct hm_features *f, const char *key, const char *value);
/* A vertex, and what those since the last call here are. */
enum hm_err hm_features_vertex(struct hm_features *f, const double xyz[3]);
enum hm_err hm_features_end(struct hm_features *f, enum hm_shape shape);
/* Behind the last: the crs (NULL: none is said). */
enum hm_err hm_features_finish(struct hm_features *f, const char *crs);
void hm_features_free(struct hm_features *f);

/* The formats that need no other library, as items of a list. */
#define HM_IMPORT_PLAIN                                                                            \
    {"ugrid", hm_import_is_ugrid, hm_import_ugrid, NULL},                                          \
        {"slf", hm_import_is_slf, hm_import_slf, NULL},                                            \
        {"msh", hm_import_is_msh, hm_import_msh, NULL},                                            \
        {"ply", hm_import_is_ply, hm_import_ply, NULL},                                            \
        {"vtk", hm_import_is_vtk, hm_import_vtk, NULL},                                            \
        {"2d", hm_import_is_kalypso, hm_import_kalypso, NULL},                                     \
        {"gr3", hm_import_is_gr3, hm_import_gr3, NULL},                                            \
        {"wkt", hm_import_is_wkt, NULL, hm_import_wkt},                                            \
    {                                                                                              \
        "triangle", hm_import_is_triangle, NULL, hm_import_triangle                                \
    }

#endif
