/* hm_chain: directed pieces linked into lines while they come, without any search. Layer 6.
 *
 * A joint is a place where at most one piece ends and one begins: an edge between two cells of a
 * grid. Pieces come in any order; a line is handed out, and its memory used again, as soon as no
 * piece can come any more at either end. So memory grows with the lines that are open.
 */
#ifndef HM_CHAIN_H
#define HM_CHAIN_H

#include "hm_boxtree.h"
#include "hm_line.h"

/* The caller keeps the joints, at fixed addresses, cleared by hm_joint_clear. */
struct hm_joint {
    int64_t ending, beginning; /* the open line that ends, that begins here; or HM_JOINT_FREE */
};
enum { HM_JOINT_FREE = -1 };

static inline void hm_joint_clear(struct hm_joint *j)
{
    j->ending = j->beginning = HM_JOINT_FREE;
}

struct hm_chain;

/* `take` gets each finished line: line->xyz and line->attrs (NULL) are valid during the call. */
enum hm_err hm_chain_new(struct hm_chain **c,
                         enum hm_err (*take)(void *arg, const struct hm_line *line,
                                             struct hm_diag *d),
                         void *arg, struct hm_diag *d);
void hm_chain_free(struct hm_chain *c);

/* Add the piece from one joint to another, with up to three vertices: at its start, in the middle
 * and at its end (x, y, z; NULL: none). Vertices at a joint must come with both pieces that meet
 * there; they are taken once. */
enum hm_err hm_chain_add(struct hm_chain *c, struct hm_joint *from, struct hm_joint *to,
                         const double *start, const double *middle, const double *end,
                         struct hm_diag *d);

/* Add the piece between two joints, with a vertex at either, in whichever direction fits the lines
 * there; a line that runs against it is turned round. For lines without a sense of direction. */
enum hm_err hm_chain_join(struct hm_chain *c, struct hm_joint *a, struct hm_joint *b,
                          const double *at_a, const double *at_b, struct hm_diag *d);

/* Append boxes around the open lines, as far as they have come, one for every few vertices, to *box
 * (malloc'd, *n of *cap). */
enum hm_err hm_chain_open(const struct hm_chain *c, struct hm_box **box, size_t *n, size_t *cap,
                          struct hm_diag *d);

/* No more pieces come to this joint; it is cleared. */
enum hm_err hm_chain_seal(struct hm_chain *c, struct hm_joint *joint, struct hm_diag *d);

#endif
