/* hm_num: numbers from text and to text, exact, fast and independent of the locale. Layer 1. */
#ifndef HM_NUM_H
#define HM_NUM_H

#include <stddef.h>

enum { HM_NUM_CHARS = 40 }; /* room that hm_num_print and hm_num_print_fixed need */

/* Read the number at the start of s[0 .. end-s): decimal, with optional sign, fraction and
 * exponent, or nan, inf, infinity in any case. Correctly rounded, as strtod in the C locale does
 * it; no leading blanks, no hexadecimal. Returns the first byte behind the number, or NULL, with
 * *value untouched, when there is none. Beyond the range of double: ±inf or ±0, as strtod. */
const char *hm_num_parse(const char *s, const char *end, double *value);

/* The numbers of a whole string, `separator` between them, to value[0 .. room). Returns how many; 0
 * when it is no such list, one of them is not finite, or there are more. */
size_t hm_num_parse_list(const char *s, char separator, double *value, size_t room);

/* Write v as the shortest decimal that reads back to the same double (the nearest to v among them),
 * without a terminating 0: 12.5, -0.001, 1e+300, nan, inf; -0 keeps its sign. Plain notation for
 * magnitudes in 1e-5 .. 1e16. Returns the number of characters, less than HM_NUM_CHARS. */
size_t hm_num_print(char *buf, double v);

/* Write v rounded to at most `decimals` places (0 .. 17) behind the point, trailing zeros dropped;
 * magnitudes of 1e16 and more as hm_num_print. Never longer than hm_num_print would be. */
size_t hm_num_print_fixed(char *buf, double v, int decimals);

#endif
