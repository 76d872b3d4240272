/* hm_export_private: what the writers of mesh formats share. Layer 6. */
#ifndef HM_EXPORT_PRIVATE_H
#define HM_EXPORT_PRIVATE_H

#include "hm_export.h"
#include "hm_meshedges.h"
#include "hm_sink.h"
#include "hm_strings.h"

/* The number behind the largest region: what region 0 becomes where there is no material 0. */
int64_t hm_export_spare_region(const struct hm_mesh *m);

/* The text `#name` of a mesh, or "mesh". */
const char *hm_export_name(const struct hm_mesh *m);

/* Blank, x, blank, y, blank, z. */
void hm_export_place(struct hm_sink *s, const struct hm_node *node);

/* Blank and number + first, for each corner. */
void hm_export_corners(struct hm_sink *s, const struct hm_elem *e, int first);

/* What a string is by the beginning of its name: inflow; wall, land, bank or island: closed; any
 * other: open, where a height of the water may be given. */
enum hm_export_side { HM_SIDE_WALL, HM_SIDE_INFLOW, HM_SIDE_OPEN };
enum hm_export_side hm_export_side_of(const char *name);

/* The boundary, edge by edge in the order of its loops, with the string that each edge is part of.
 */
struct hm_export_border {
    struct hm_mesh_loops loops;
    struct hm_strings strings;
    size_t n;        /* edges, and as many nodes */
    int32_t *string; /* of the edge from node i to the next of its loop; -1: none */
    int32_t *place;  /* of each node of the mesh on the boundary, -1 inside */
};
enum hm_err hm_export_border_build(struct hm_export_border *b, const struct hm_mesh *m,
                                   struct hm_diag *d);
void hm_export_border_free(struct hm_export_border *b);

/* The place behind place i in its loop k. */
static inline size_t hm_export_border_next(const struct hm_export_border *b, size_t k, size_t i)
{
    return i + 1 < b->loops.start[k + 1] ? i + 1 : b->loops.start[k];
}

/* Is loop k that of an island (clockwise)? */
bool hm_export_is_island(const struct hm_export_border *b, const struct hm_mesh *m, size_t k);

#endif
