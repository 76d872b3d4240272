/* Meshes in formats of other programs that the reader was told of: read whole, then given. */
#include "hm_reader_private.h"

#include <stdlib.h>
#include <string.h>

static void free_mesh(void *state)
{
    hm_mesh_free(state);
    free(state);
}

static enum hm_err begin(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct hm_mesh *m = r->state = hm_alloc0(1, sizeof *m);
    if (!m)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_init(&m->header, HM_MESH, d);
    if (!err)
        err = r->found->read(&r->in, m, d);
    if (err)
        return err;
    *h = m->header;
    memset(&m->header, 0, sizeof m->header);
    return HM_OK;
}

static enum hm_err read_mesh(struct hm_reader *r, struct hm_mesh *mesh, struct hm_diag *d)
{
    (void)d;
    struct hm_mesh *own = r->state;
    struct hm_header header = mesh->header;
    *mesh = *own;
    mesh->header = header;
    *own = (struct hm_mesh){0};
    r->ended = true;
    return HM_OK;
}

const struct hm_reader_form hm_reader_foreign_mesh = {
    .begin = begin, .mesh = read_mesh, .free = free_mesh};
