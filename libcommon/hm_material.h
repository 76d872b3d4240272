/* hm_material: closed lines with region=N give their material to the elements inside. Layer 4. */
#ifndef HM_MATERIAL_H
#define HM_MATERIAL_H

#include "hm_line.h"
#include "hm_mesh.h"

struct hm_material {
    struct hm_line ring; /* its pointers are those of the line it was made from */
    int32_t region;
    int64_t elements; /* that it gave its material to */
};

/* All of them in n sets of lines, which must outlive them, in order; *list is malloc'd. A line
 * whose last vertex repeats its first counts as closed. HM_EGEOM with the place when one is open or
 * crosses itself, HM_EFORMAT when N is not 0, 1, 2 … */
enum hm_err hm_material_collect(const struct hm_lines *sets, size_t n, struct hm_material **list,
                                size_t *count, struct hm_diag *d);

/* Elements with their centre (the mean of the corners) inside a ring or on it get its region: of
 * several rings that of the last. */
void hm_material_apply(struct hm_mesh *m, struct hm_material *list, size_t count);

#endif
