/* Any bytes whatever into the reader of one format of other programs, FORMAT by its name: it may
 * neither crash nor hang, and what it takes is sound: points, vertices and nodes are somewhere,
 * every element has nodes that are there. The Makefile builds a target of each. */
#define _GNU_SOURCE /* memfd_create */
#include "hm_data.h"
#include "hm_import.h"

#include <math.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

/* Whatever its first bytes are, if there are any. */
static bool always(const char *s, const char *end)
{
    return s < end;
}

static const struct hm_foreign *only(void)
{
    static struct hm_foreign list[2];
    const struct hm_foreign *f = hm_import_formats;
    while (f->name && strcmp(f->name, FORMAT))
        f++;
    if (!f->name)
        abort();
    list[0] = *f;
    list[0].is = always;
    return list;
}

static void check_places(const double *v, size_t n, size_t stride)
{
    for (size_t k = 0; k < n; k++)
        if (!isfinite(v[k * stride]) || !isfinite(v[k * stride + 1]) || isinf(v[k * stride + 2]))
            abort();
}

static void check_points(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct hm_points p = {0};
    hm_points_read(&p, r, h, d);
    check_places(p.v, p.n, p.stride);
    hm_points_free(&p);
}

static void check_lines(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct hm_lines l = {0};
    hm_lines_read(&l, r, h, d);
    for (size_t k = 0; k < l.n; k++)
        check_places(l.line[k].xyz, l.line[k].n, 3);
    hm_lines_free(&l);
}

static void check_mesh(struct hm_reader *r, struct hm_header *h, struct hm_diag *d)
{
    struct hm_mesh mesh = {0}, *m = &mesh;
    if (hm_mesh_read(m, r, h, d)) {
        hm_mesh_free(m);
        return;
    }
    for (size_t k = 0; k < m->nnodes; k++)
        check_places((double[]){m->node[k].x, m->node[k].y, m->node[k].z}, 1, 3);
    for (size_t k = 0; k < m->nelems; k++)
        for (int i = 0; i < hm_elem_corners(&m->elem[k]); i++)
            if (m->elem[k].node[i] < 0 || (size_t)m->elem[k].node[i] >= m->nnodes)
                abort();
    hm_mesh_free(m);
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
    hm_reader_foreign(r, only());
    while (!hm_reader_next(r, &h, &d)) {
        if (h.kind == HM_POINTS)
            check_points(r, &h, &d);
        else if (h.kind == HM_LINES)
            check_lines(r, &h, &d);
        else if (h.kind == HM_MESH)
            check_mesh(r, &h, &d);
        else
            hm_header_free(&h);
    }
    hm_reader_close(r);
    return 0;
}
