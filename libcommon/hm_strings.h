/* hm_strings: node strings, the named stretches of its boundary that a solver asks a mesh for:
 * where water flows in, where out. Layer 4.
 *
 * The header of a mesh has them as `#string name node node …`. Lines with `string=NAME` say where
 * new ones are to be.
 */
#ifndef HM_STRINGS_H
#define HM_STRINGS_H

#include "hm_line.h"
#include "hm_mesh.h"

struct hm_string {
    char *name;
    int32_t *node;
    size_t n;
};

/* Begins as `= {0}`, emptied by hm_strings_free. */
struct hm_strings {
    struct hm_string *string;
    size_t n, cap;
};

/* Append the strings in the header of m. HM_EFORMAT for one without nodes, or with a word that is
 * not the number of one. */
enum hm_err hm_strings_read(struct hm_strings *s, const struct hm_mesh *m, struct hm_diag *d);

/* Put node number[k], or -1 when it is lost, for node k in the strings from `first` on. */
void hm_strings_renumber(struct hm_strings *s, size_t first, const int32_t *number);

/* Remove the strings that do not run from node to node along the boundary of m, all one way.
 * *dropped says how many, *name (malloc'd; NULL when none) what the first is called. */
enum hm_err hm_strings_drop_broken(struct hm_strings *s, const struct hm_mesh *m, int64_t *dropped,
                                   char **name, struct hm_diag *d);

/* For each line with string=NAME in n sets: the nodes of the boundary between those two nearest to
 * its ends, the way along the boundary that stays nearer to the line, in the line's direction. A
 * string of that name that is there from before is replaced. Neither may a node be further from the
 * line, nor one of the line's vertices from the nodes' way, than `tolerance=` of the line, by
 * default the mean edge of the boundary (metres): HM_EGEOM with the place. HM_EGEOM, too, when the
 * string has no edge, or fewer than two and its name begins with inflow. *before says how many are
 * left of those from before; the new ones stand behind them. */
enum hm_err hm_strings_find(struct hm_strings *s, const struct hm_mesh *m,
                            const struct hm_lines *sets, size_t n, size_t *before,
                            struct hm_diag *d);

/* Replace the header's strings by these. */
enum hm_err hm_strings_write(const struct hm_strings *s, struct hm_header *h, struct hm_diag *d);

void hm_strings_free(struct hm_strings *s);

#endif
