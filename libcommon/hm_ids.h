/* hm_ids: which node has which id, in formats that number nodes as they like. Layer 3. */
#ifndef HM_IDS_H
#define HM_IDS_H

#include "hm_base.h"

/* Begins as `= {0}`, emptied by hm_ids_free. */
struct hm_ids {
    int32_t *id; /* of node 0, 1, 2 … */
    size_t n, cap;
    size_t *order; /* nodes by id, when ids are not 1, 2, 3 … */
};

/* The id of the next node. */
enum hm_err hm_ids_add(struct hm_ids *ids, int32_t id, struct hm_diag *d);

/* Once, behind the last. HM_EFORMAT, naming the file, when two nodes have one id. */
enum hm_err hm_ids_sort(struct hm_ids *ids, const char *source, struct hm_diag *d);

/* The number of the node with that id; -1 when there is none. */
int64_t hm_ids_find(const struct hm_ids *ids, int32_t id);

void hm_ids_free(struct hm_ids *ids);

#endif
