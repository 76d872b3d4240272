/* Any bytes whatever into the readers of other programs' meshes: none may crash or hang, and a mesh
 * that they take is sound: every node is somewhere, every element has nodes that are there. */
#define _GNU_SOURCE /* memfd_create */
#include "hm_data.h"
#include "hm_import.h"

#include <math.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static void check(const struct hm_mesh *m)
{
    for (size_t k = 0; k < m->nnodes; k++)
        if (!isfinite(m->node[k].x) || !isfinite(m->node[k].y))
            abort();
    for (size_t k = 0; k < m->nelems; k++)
        for (int i = 0; i < hm_elem_corners(&m->elem[k]); i++)
            if (m->elem[k].node[i] < 0 || (size_t)m->elem[k].node[i] >= m->nnodes)
                abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    struct hm_reader *r;
    struct hm_header h;
    struct hm_diag d = {0};
    int fd = memfd_create("fuzz", 0);
    if (fd < 0 || write(fd, bytes, n) != (ssize_t)n || lseek(fd, 0, SEEK_SET))
        abort();
    if (hm_reader_open_fd(&r, fd, "fuzz", &d))
        return 0;
    hm_reader_foreign(r, hm_import_formats);
    while (!hm_reader_next(r, &h, &d)) {
        struct hm_mesh m = {0};
        bool mesh = h.kind == HM_MESH;
        if (!mesh)
            hm_header_free(&h);
        else if (!hm_mesh_read(&m, r, &h, &d))
            check(&m);
        hm_mesh_free(&m);
    }
    hm_reader_close(r);
    return 0;
}
