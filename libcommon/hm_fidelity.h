/* hm_fidelity: does a mesh keep the features of the ground, such as crests, toes, thalwegs and
 * banks that are given as lines? Layer 6.
 *
 * Stations stand along each line, at most `tolerance` apart, and at its vertices. At a station the
 * mesh follows the line when one of its edges lies within `tolerance` and runs in the line's
 * direction, to 15 degrees. Means and shares go by length.
 *
 * A triangle with all three nodes on one line, to 1 cm, has one height where the line is level: it
 * dams a channel, or cuts the corner of a bank.
 */
#ifndef HM_FIDELITY_H
#define HM_FIDELITY_H

#include "hm_line.h"
#include "hm_measure.h"
#include "hm_walk.h"

/* Of one line, or of all. Lengths in metres, places in the coordinates of the mesh; what does not
 * exist is NaN. */
struct hm_fidelity_line {
    char name[32];             /* its attribute name=, else limit=, else its number */
    double length, on_mesh;    /* whole, and of that on the mesh */
    double followed;           /* length on the mesh that edges follow */
    double lateral;            /* mean distance of the edges that follow, */
    struct hm_measured aside;  /* and the largest */
    double sounded;            /* length on the mesh where line and mesh have heights, */
    double rise, rise_size;    /* there: mean of z(mesh) - z(line), and of its size, */
    struct hm_measured worst;  /* and the one of largest size, with its sign */
    struct hm_measured gap;    /* longest stretch on the mesh that no edge follows; its beginning */
    struct hm_measured across; /* triangles with all nodes on the line; the first */
};

struct hm_fidelity {
    double tolerance;              /* m */
    struct hm_fidelity_line *line; /* owned */
    size_t n;
    struct hm_fidelity_line all;
};

/* Lines without a role (hm_role), in the coordinates and units of the mesh, of which a unit of x
 * and y, and of z, is so many metres. There may be none. */
struct hm_fidelity_want {
    double tolerance, metres, z_metres;
};
enum hm_err hm_fidelity_run(struct hm_fidelity *f, const struct hm_mesh *m,
                            const struct hm_walk *walk, const struct hm_lines *sets, size_t n,
                            const struct hm_fidelity_want *want, struct hm_diag *d);
void hm_fidelity_free(struct hm_fidelity *f);

/* The share of its length on the mesh that edges follow, percent. */
double hm_fidelity_share(const struct hm_fidelity_line *line);

#endif
