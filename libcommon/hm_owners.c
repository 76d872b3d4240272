/* hm_owners: see hm_owners.h. */
#include "hm_owners.h"

#include <stdlib.h>
#include <string.h>

static int32_t count_names(const char *s)
{
    int32_t n = 0;
    for (; *s; s += strcspn(s, " "), s += strspn(s, " "))
        n++;
    return n;
}

/* Is one list the beginning of the other, name by name? */
static bool agree(const char *a, const char *b)
{
    size_t na = strlen(a), nb = strlen(b), n = na < nb ? na : nb;
    return strncmp(a, b, n) == 0 && (a[n] == 0 || a[n] == ' ') && (b[n] == 0 || b[n] == ' ');
}

enum hm_err hm_owners_join(struct hm_mesh *mesh, size_t n, char **owners, struct hm_diag *d)
{
    size_t room = 1;
    for (size_t k = 0; k < n; k++) {
        const char *names = hm_header_get(&mesh[k].header, "owners");
        room += names ? strlen(names) + 1 : 0;
    }
    char *all = hm_alloc0(room, 1);
    *owners = all;
    if (!all)
        return hm_fail_memory(d);
    for (size_t k = 0; k < n; k++) {
        const char *names = hm_header_get(&mesh[k].header, "owners");
        if (!names || !*names)
            continue;
        if (agree(all, names) || !*all) {
            if (strlen(names) > strlen(all))
                strcpy(all, names);
            continue;
        }
        int32_t before = count_names(all);
        strcat(all, " ");
        strcat(all, names);
        for (size_t i = 0; i < mesh[k].nnodes; i++)
            if (mesh[k].node[i].owner > 0)
                mesh[k].node[i].owner += before;
    }
    return HM_OK;
}
