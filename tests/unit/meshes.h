/* meshes: small meshes for unit tests, made in memory. Included once by a test program. */
#ifndef MESHES_H
#define MESHES_H

#include "hm_data.h"

#include <stdlib.h>
#include <string.h>

static inline int32_t node(struct hm_mesh *m, double x, double y, double z)
{
    m->node = realloc(m->node, (m->nnodes + 1) * sizeof *m->node);
    m->node[m->nnodes] = (struct hm_node){.x = x, .y = y, .z = z};
    return (int32_t)m->nnodes++;
}

static inline void element(struct hm_mesh *m, int32_t a, int32_t b, int32_t c, int32_t d)
{
    m->elem = realloc(m->elem, (m->nelems + 1) * sizeof *m->elem);
    m->elem[m->nelems++] = (struct hm_elem){.node = {a, b, c, d}};
}

/* nx × ny cells over [x0, x1] × [y0, y1], as quadrilaterals or pairs of triangles, z = x + 2y. */
static inline void lattice(struct hm_mesh *m, double x0, double x1, int nx, double y0, double y1,
                           int ny, bool quads)
{
    int32_t first = (int32_t)m->nnodes;
    for (int j = 0; j <= ny; j++)
        for (int i = 0; i <= nx; i++) {
            double x = x0 + (x1 - x0) * i / nx, y = y0 + (y1 - y0) * j / ny;
            node(m, x, y, x + 2 * y);
        }
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++) {
            int32_t a = first + j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
            if (quads) {
                element(m, a, b, c, d);
            } else {
                element(m, a, b, c, -1);
                element(m, a, c, d, -1);
            }
        }
}

/* Take element i out; later ones move up. */
static inline void drop(struct hm_mesh *m, size_t i)
{
    memmove(m->elem + i, m->elem + i + 1, (m->nelems - i - 1) * sizeof *m->elem);
    m->nelems--;
}

static inline void empty(struct hm_mesh *m)
{
    free(m->node);
    free(m->elem);
    *m = (struct hm_mesh){0};
}

#endif
