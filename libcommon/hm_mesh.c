#include "hm_mesh.h"

#include <stdlib.h>
#include <string.h>

enum hm_err hm_mesh_add_node(struct hm_mesh *m, struct hm_node node, struct hm_diag *d)
{
    if (m->nnodes >= INT32_MAX)
        return hm_fail(d, HM_ENOMEM, "a mesh of more than 2147483647 nodes");
    if (!hm_grow(&m->node, &m->node_cap, m->nnodes + 1, sizeof *m->node))
        return hm_fail_memory(d);
    m->node[m->nnodes++] = node;
    return HM_OK;
}

enum hm_err hm_mesh_add_elem(struct hm_mesh *m, struct hm_elem elem, struct hm_diag *d)
{
    if (!hm_grow(&m->elem, &m->elem_cap, m->nelems + 1, sizeof *m->elem))
        return hm_fail_memory(d);
    m->elem[m->nelems++] = elem;
    return HM_OK;
}

void hm_mesh_free(struct hm_mesh *m)
{
    hm_header_free(&m->header);
    free(m->node);
    free(m->elem);
    memset(m, 0, sizeof *m);
}
