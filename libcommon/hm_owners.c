#include "hm_owners.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 128, MOST_OWNERS = 1 << 20 };

struct owners {
    char **name; /* of owner i + 1 */
    size_t n, cap;
};

/* The number of a name, given now if it has none; 0 when memory is short. */
static int32_t number_of(struct owners *o, const char *name)
{
    for (size_t i = 0; i < o->n; i++)
        if (!strcmp(o->name[i], name))
            return (int32_t)i + 1;
    char *copy = strdup(name);
    if (!copy || !hm_grow(&o->name, &o->cap, o->n + 1, sizeof *o->name)) {
        free(copy);
        return 0;
    }
    o->name[o->n++] = copy;
    return (int32_t)o->n;
}

/* Word k (from 1) of a list of words, cut to NAME; "" when it has not as many. */
static void word(const char *list, int64_t k, char name[NAME])
{
    const char *s = list ? list : "";
    for (int64_t i = 1;; i++) {
        s += strspn(s, " \t");
        size_t length = strcspn(s, " \t");
        if (i == k || length == 0) {
            snprintf(name, NAME, "%.*s", (int)(length < NAME ? length : NAME - 1), s);
            return;
        }
        s += length;
    }
}

/* What owner `number` of the mesh is called. */
static void name_of(const struct hm_mesh *m, const struct owners *o, int32_t number,
                    char name[NAME])
{
    const char *own = hm_header_get(&m->header, "name");
    word(hm_header_get(&m->header, "owners"), number, name);
    if (name[0] == 0 && number <= 1)
        word(own, 1, name);
    if (name[0] == 0)
        snprintf(name, NAME, "mesh%zu", o->n + 1);
}

static bool is_regular(const struct hm_mesh *m)
{
    const char *role = hm_header_get(&m->header, "role");
    return role && !strcmp(role, "regular");
}

/* Give m's nodes the numbers of `o`, which learns the names that it lacks. */
static enum hm_err adopt(struct owners *o, struct hm_mesh *m, struct hm_diag *d)
{
    int32_t most = 0;
    for (size_t i = 0; i < m->nnodes; i++) {
        if (m->node[i].owner < 0 || m->node[i].owner > MOST_OWNERS)
            return hm_fail_at(d, HM_EFORMAT, m->node[i].x, m->node[i].y,
                              "%d is no number of a regular mesh", m->node[i].owner);
        if (m->node[i].owner > most)
            most = m->node[i].owner;
    }
    int32_t *number = hm_alloc0((size_t)most + 1, sizeof *number);
    if (!number)
        return hm_fail_memory(d);
    for (size_t i = 0; i < m->nnodes; i++) /* those in use; the header may name others */
        number[m->node[i].owner] = -1;
    number[0] = most == 0 && is_regular(m) ? -1 : 0;
    for (int32_t k = 0; k <= most; k++) {
        char name[NAME];
        if (number[k] == 0)
            continue;
        name_of(m, o, k, name);
        number[k] = number_of(o, name);
        if (number[k] == 0) {
            free(number);
            return hm_fail_memory(d);
        }
    }
    for (size_t i = 0; i < m->nnodes; i++)
        m->node[i].owner = number[m->node[i].owner];
    free(number);
    return HM_OK;
}

static char *list_of(const struct owners *o)
{
    size_t length = 1;
    for (size_t i = 0; i < o->n; i++)
        length += strlen(o->name[i]) + 1;
    char *list = hm_alloc0(length, 1), *end = list;
    for (size_t i = 0; list && i < o->n; i++)
        end += sprintf(end, "%s%s", i > 0 ? " " : "", o->name[i]);
    return list;
}

enum hm_err hm_owners_join(struct hm_mesh *mesh, size_t n, char **owners, struct hm_diag *d)
{
    struct owners o = {0};
    enum hm_err err = HM_OK;
    *owners = NULL;
    for (size_t i = 0; !err && i < n; i++)
        err = adopt(&o, &mesh[i], d);
    if (!err && !(*owners = list_of(&o)))
        err = hm_fail_memory(d);
    for (size_t i = 0; i < o.n; i++)
        free(o.name[i]);
    free(o.name);
    return err;
}
