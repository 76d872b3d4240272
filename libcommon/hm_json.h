/* hm_json: JSON, as it is written. Layer 6. Commas, indentation and quotes are done
 * here; names are given in objects and NULL in arrays. Texts hold no '<', so that it may stand in a
 * page of HTML.
 *
 *     struct hm_json j = {.w = writer};
 *     hm_json_open(&j, NULL, '{');
 *     hm_json_number(&j, "rmse", 0.12);
 *     hm_json_close(&j, '}');
 *     if (j.err) …                         // the first failure; later calls then do nothing
 */
#ifndef HM_JSON_H
#define HM_JSON_H

#include "hm_writer.h"

struct hm_json {
    struct hm_writer *w;
    enum hm_err err;
    struct hm_diag d;
    int depth;
    bool begun; /* something stands at this depth already */
};

void hm_json_open(struct hm_json *j, const char *name, char bracket); /* '{' or '[' */
void hm_json_close(struct hm_json *j, char bracket);                  /* '}' or ']' */

/* The shortest exact form; null for NaN and infinities, which JSON does not know. */
void hm_json_number(struct hm_json *j, const char *name, double v);
void hm_json_integer(struct hm_json *j, const char *name, int64_t v);
void hm_json_bool(struct hm_json *j, const char *name, bool v);
void hm_json_text(struct hm_json *j, const char *name, const char *text); /* NULL: null */

/* What stands for the character at *text in a string, quotes not included; how many bytes. *text
 * goes behind it. JSON is UTF-8 (RFC 8259): a byte that is none, as in names from a GIS in Latin-1,
 * is taken for Latin-1. */
enum { HM_JSON_ESCAPE = 8 };
size_t hm_json_escape(char out[HM_JSON_ESCAPE], const char **text);

#endif
