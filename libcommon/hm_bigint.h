/* hm_bigint: whole numbers of a fixed largest size, for exact predicates. Layer 1.
 *
 * Sign and magnitude in 32-bit limbs, the least first. Big enough for a determinant of degree four
 * in differences of doubles of any size: 4 * 2099 bits and a few for the sums. Operands may not be
 * the result.
 */
#ifndef HM_BIGINT_H
#define HM_BIGINT_H

#include <stdint.h>

enum { HM_BIGINT_LIMBS = 272 };

struct hm_bigint {
    int sign; /* -1, 0, 1 */
    int n;    /* limbs in use; 0 for zero */
    uint32_t limb[HM_BIGINT_LIMBS];
};

void hm_bigint_set(struct hm_bigint *r, int64_t m, int shift); /* m * 2^shift, shift >= 0 */
void hm_bigint_add(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b);
void hm_bigint_sub(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b);
void hm_bigint_mul(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b);

#endif
