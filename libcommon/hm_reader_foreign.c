/* Files in formats of other programs that the reader was told of: read whole, then given object by
 * object: points, lines, meshes. */
#include "hm_reader_private.h"

#include <stdlib.h>
#include <string.h>

/* The object being given is the reader's, in r->whole. */
struct giving {
    const struct hm_points *points;
    const struct hm_lines *lines;
    struct hm_mesh *mesh;
    size_t at; /* the next point or line */
};

static size_t count(const struct hm_inputs *in)
{
    return in->npoints + in->nlines + in->nmeshes;
}

bool hm_reader_has_whole(const struct hm_reader *r)
{
    return r->whole_given < count(&r->whole);
}

static enum hm_err read_mesh_file(struct hm_reader *r, struct hm_diag *d)
{
    struct hm_mesh *m = hm_inputs_add_mesh(&r->whole);
    enum hm_err err = m ? hm_header_init(&m->header, HM_MESH, d) : hm_fail_memory(d);
    return err ? err : r->found->mesh(&r->in, m, d);
}

static enum hm_err read_file(struct hm_reader *r, struct hm_diag *d)
{
    hm_inputs_free(&r->whole);
    r->whole_given = 0;
    enum hm_err err =
        r->found->mesh ? read_mesh_file(r, d) : r->found->objects(&r->in, &r->whole, d);
    if (!err && count(&r->whole) == 0)
        err = hm_fail_line(d, HM_EFORMAT, r->in.name, 0, "no points, lines or elements in it");
    if (err)
        hm_inputs_free(&r->whole);
    return err;
}

/* The object whose turn it is; its header. */
static struct hm_header *find_object(struct hm_reader *r, struct giving *g)
{
    size_t k = r->whole_given++;
    if (k < r->whole.npoints) {
        g->points = &r->whole.points[k];
        return &r->whole.points[k].header;
    }
    k -= r->whole.npoints;
    if (k < r->whole.nlines) {
        g->lines = &r->whole.lines[k];
        return &r->whole.lines[k].header;
    }
    g->mesh = &r->whole.mesh[k - r->whole.nlines];
    return &g->mesh->header;
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct giving *g = r->state = hm_alloc0(1, sizeof *g);
    if (!g)
        return hm_fail_memory(d);
    enum hm_err err = hm_reader_has_whole(r) ? HM_OK : read_file(r, d);
    if (err)
        return err;
    struct hm_header *header = find_object(r, g);
    *h = *header;
    *header = (struct hm_header){0};
    return HM_OK;
}

static enum hm_err give_points(struct hm_reader *r, double *rows, size_t max, size_t *n,
                               struct hm_diag *d)
{
    (void)d;
    struct giving *g = r->state;
    *n = g->points->n - g->at < max ? g->points->n - g->at : max;
    memcpy(rows, g->points->v + g->at * r->nfields, *n * r->nfields * sizeof *rows);
    g->at += *n;
    r->ended = g->at == g->points->n;
    return *n > 0 ? HM_OK : HM_END;
}

/* A closed line is given as one that comes back to its first vertex. */
static enum hm_err give_line(struct hm_reader *r, struct hm_diag *d)
{
    struct giving *g = r->state;
    if (g->at == g->lines->n) {
        r->ended = true;
        return HM_END;
    }
    const struct hm_line *line = &g->lines->line[g->at++];
    enum hm_err err = hm_reader_set_attrs(r, line->attrs, strlen(line->attrs), d);
    size_t n = line->n + line->closed;
    for (size_t k = 0; k < n && !err; k++)
        err = hm_reader_add_vertex(r, line->xyz + 3 * (k % line->n), d);
    return err;
}

static enum hm_err give_mesh(struct hm_reader *r, struct hm_mesh *mesh, struct hm_diag *d)
{
    (void)d;
    struct giving *g = r->state;
    struct hm_header header = mesh->header;
    *mesh = *g->mesh;
    mesh->header = header;
    *g->mesh = (struct hm_mesh){0};
    r->ended = true;
    return HM_OK;
}

const struct hm_reader_form hm_reader_whole = {
    .begin = begin, .points = give_points, .line = give_line, .mesh = give_mesh};
