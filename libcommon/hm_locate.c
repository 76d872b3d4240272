#include "hm_locate.h"

#include "hm_boxtree.h"

#include <stdlib.h>

struct hm_locate {
    const struct hm_mesh *mesh;
    struct hm_boxtree *boxes;
};

enum hm_err hm_locate_build(struct hm_locate **locate, const struct hm_mesh *mesh,
                            struct hm_diag *d)
{
    *locate = NULL;
    struct hm_locate *x = hm_alloc0(1, sizeof *x);
    struct hm_box *box = hm_alloc(mesh->nelems, sizeof *box);
    if (!x || !box) {
        free(x);
        free(box);
        return hm_fail_memory(d);
    }
    x->mesh = mesh;
    for (size_t i = 0; i < mesh->nelems; i++)
        box[i] = hm_elem_box(mesh, &mesh->elem[i]);
    enum hm_err err = hm_boxtree_build(&x->boxes, box, mesh->nelems, d);
    free(box);
    if (err) {
        free(x);
        return err;
    }
    *locate = x;
    return HM_OK;
}

void hm_locate_free(struct hm_locate *x)
{
    if (!x)
        return;
    hm_boxtree_free(x->boxes);
    free(x);
}

int64_t hm_locate_element(const struct hm_locate *x, double px, double py)
{
    const double at[2] = {px, py};
    int64_t found = -1;
    struct hm_boxquery q = hm_boxtree_find(x->boxes, hm_box_of(at, at));
    for (int32_t i; (i = hm_boxtree_next(&q)) >= 0;)
        if ((found < 0 || i < found) && hm_elem_holds(x->mesh, &x->mesh->elem[i], px, py))
            found = i;
    return found;
}

const struct hm_boxtree *hm_locate_boxes(const struct hm_locate *x)
{
    return x->boxes;
}
