/* hm_attr: the key=value attributes of a line, kept as the text that came in. Layer 3.
 *
 * `surface=main side=left name="upper bank"`: blanks separate, double quotes protect blanks, a
 * backslash inside quotes protects the next character. A later key overrides an earlier one.
 */
#ifndef HM_ATTR_H
#define HM_ATTR_H

#include "hm_base.h"

/* Copy the value of key in attrs (NULL counts as "") to value[size], unquoted and 0-terminated
 * (cut to fit). False, with value "", when the key is not there. A bare word `closed` counts as
 * closed=1. */
bool hm_attr_get(const char *attrs, const char *key, char *value, size_t size);

/* The value as a number; `otherwise` when the key is not there. HM_EFORMAT when it is no number. */
enum hm_err hm_attr_number(const char *attrs, const char *key, double otherwise, double *value,
                           struct hm_diag *d);

/* True when the key is there with a value other than "0". */
bool hm_attr_flag(const char *attrs, const char *key);

/* A new string: attrs with key set to value (quoted when it must be), or removed when value is
 * NULL. The other attributes keep order and bytes. Free with free(). NULL when memory is short. */
char *hm_attr_set(const char *attrs, const char *key, const char *value);

/* The attributes one by one, unquoted, in order; of several with one key the last. Begins as
 * `= {0}`, emptied by hm_attr_list_free. False when memory is short. */
struct hm_attr {
    char *key, *value;
};
struct hm_attr_list {
    struct hm_attr *item;
    size_t n, cap;
};
bool hm_attr_list_read(struct hm_attr_list *list, const char *attrs);
/* The value of a key; NULL when it is not there. */
const char *hm_attr_list_get(const struct hm_attr_list *list, const char *key);
void hm_attr_list_free(struct hm_attr_list *list);

/* Is the whole string well formed? On failure the reason is in d. */
enum hm_err hm_attr_check(const char *attrs, struct hm_diag *d);

#endif
