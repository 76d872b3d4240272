/* Gmsh .msh 2.2, text: strings are lines of a physical group of their name, regions the physical
 * group of the elements. Gmsh forgets what is in none, so region 0 is a group called "region 0",
 * with the number behind the largest. */
#include "hm_export_private.h"

enum { LINE = 1, TRIANGLE = 2, QUAD = 3 };

static void put_names(struct hm_sink *s, const struct hm_strings *strings, bool nameless,
                      int64_t spare)
{
    if (strings->n + nameless == 0)
        return;
    hm_sink_format(s, "$PhysicalNames\n%zu\n", strings->n + nameless);
    for (size_t k = 0; k < strings->n; k++)
        hm_sink_format(s, "1 %zu \"%s\"\n", k + 1, strings->string[k].name);
    if (nameless)
        hm_sink_format(s, "2 %lld \"region 0\"\n", (long long)spare);
    hm_sink_text(s, "$EndPhysicalNames\n");
}

static void put_strings(struct hm_sink *s, const struct hm_strings *strings, size_t *number)
{
    for (size_t k = 0; k < strings->n; k++)
        for (size_t i = 0; i + 1 < strings->string[k].n; i++)
            hm_sink_format(s, "%zu %d 2 %zu %zu %d %d\n", ++*number, LINE, k + 1, k + 1,
                           strings->string[k].node[i] + 1, strings->string[k].node[i + 1] + 1);
}

static void put_elements(struct hm_sink *s, const struct hm_mesh *m, int64_t spare, size_t *number)
{
    for (size_t k = 0; k < m->nelems; k++) {
        const struct hm_elem *e = &m->elem[k];
        long long region = e->region ? e->region : spare;
        hm_sink_format(s, "%zu %d 2 %lld %lld", ++*number,
                       hm_elem_corners(e) == 3 ? TRIANGLE : QUAD, region, region);
        hm_export_corners(s, e, 1);
        hm_sink_text(s, "\n");
    }
}

enum hm_err hm_export_msh(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_strings strings = {0};
    enum hm_err err = hm_strings_read(&strings, m, d);
    struct hm_sink s = hm_sink_to(w, d);
    size_t lines = 0, number = 0;
    bool nameless = false;
    int64_t spare = hm_export_spare_region(m);
    for (size_t k = 0; k < strings.n; k++)
        lines += strings.string[k].n - 1;
    for (size_t k = 0; k < m->nelems; k++)
        nameless |= m->elem[k].region == 0;
    hm_sink_text(&s, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    put_names(&s, &strings, nameless, spare);
    hm_sink_format(&s, "$Nodes\n%zu\n", m->nnodes);
    for (size_t k = 0; k < m->nnodes; k++) {
        hm_sink_integer(&s, (int64_t)k + 1);
        hm_export_place(&s, &m->node[k]);
        hm_sink_text(&s, "\n");
    }
    hm_sink_format(&s, "$EndNodes\n$Elements\n%zu\n", lines + m->nelems);
    put_strings(&s, &strings, &number);
    put_elements(&s, m, spare, &number);
    hm_sink_text(&s, "$EndElements\n");
    hm_strings_free(&strings);
    return err ? err : hm_sink_finish(&s);
}
