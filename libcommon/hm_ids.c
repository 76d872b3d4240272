#include "hm_ids.h"

#include <stdlib.h>

enum hm_err hm_ids_add(struct hm_ids *ids, int32_t id, struct hm_diag *d)
{
    if (!hm_grow(&ids->id, &ids->cap, ids->n + 1, sizeof *ids->id))
        return hm_fail_memory(d);
    ids->id[ids->n++] = id;
    return HM_OK;
}

/* By id; equal ones by their place. */
static int compare(const void *a, const void *b)
{
    const int32_t *const *p = a, *const *q = b;
    return **p < **q ? -1 : **p > **q ? 1 : *p < *q ? -1 : *p > *q;
}

enum hm_err hm_ids_sort(struct hm_ids *ids, const char *source, struct hm_diag *d)
{
    size_t n = ids->n, dense = 0;
    while (dense < n && ids->id[dense] == (int64_t)dense + 1)
        dense++;
    if (dense == n)
        return HM_OK;
    const int32_t **at = hm_alloc(n, sizeof *at);
    ids->order = hm_alloc(n, sizeof *ids->order);
    if (!at || !ids->order) {
        free(at);
        return hm_fail_memory(d);
    }
    for (size_t i = 0; i < n; i++)
        at[i] = &ids->id[i];
    qsort(at, n, sizeof *at, compare);
    enum hm_err err = HM_OK;
    for (size_t i = 0; i < n; i++) {
        ids->order[i] = (size_t)(at[i] - ids->id);
        if (i > 0 && *at[i] == *at[i - 1] && !err)
            err = hm_fail_line(d, HM_EFORMAT, source, 0, "two nodes have the id %d", *at[i]);
    }
    free(at);
    return err;
}

int64_t hm_ids_find(const struct hm_ids *ids, int32_t id)
{
    size_t low = 0, high = ids->n;
    if (!ids->order)
        return id >= 1 && (size_t)id <= high ? id - 1 : -1;
    while (low < high) {
        size_t mid = low + (high - low) / 2;
        if (ids->id[ids->order[mid]] < id)
            low = mid + 1;
        else
            high = mid;
    }
    return low < ids->n && ids->id[ids->order[low]] == id ? (int64_t)ids->order[low] : -1;
}

void hm_ids_free(struct hm_ids *ids)
{
    free(ids->id);
    free(ids->order);
    *ids = (struct hm_ids){0};
}
