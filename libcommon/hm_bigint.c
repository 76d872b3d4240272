#include "hm_bigint.h"

#include <string.h>

static void trim(struct hm_bigint *r)
{
    while (r->n > 0 && r->limb[r->n - 1] == 0)
        r->n--;
    if (r->n == 0)
        r->sign = 0;
}

void hm_bigint_set(struct hm_bigint *r, int64_t m, int shift)
{
    int whole = shift / 32, part = shift % 32;
    uint64_t size = m < 0 ? -(uint64_t)m : (uint64_t)m;
    uint64_t low = size << part, high = part ? size >> (64 - part) : 0;
    memset(r->limb, 0, (size_t)whole * sizeof r->limb[0]);
    r->limb[whole] = (uint32_t)low;
    r->limb[whole + 1] = (uint32_t)(low >> 32);
    r->limb[whole + 2] = (uint32_t)high;
    r->sign = m < 0 ? -1 : 1;
    r->n = whole + 3;
    trim(r);
}

static int compare_size(const struct hm_bigint *a, const struct hm_bigint *b)
{
    if (a->n != b->n)
        return a->n < b->n ? -1 : 1;
    for (int i = a->n - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* |r| = |a| + |b| where |a| has at least as many limbs */
static void add_size(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    uint64_t carry = 0;
    for (int i = 0; i < a->n; i++) {
        carry += (uint64_t)a->limb[i] + (i < b->n ? b->limb[i] : 0);
        r->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    r->limb[a->n] = (uint32_t)carry;
    r->n = a->n + 1;
}

/* |r| = |a| - |b| where |a| >= |b| */
static void sub_size(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    uint64_t borrow = 0;
    for (int i = 0; i < a->n; i++) {
        uint64_t diff = (uint64_t)a->limb[i] - (i < b->n ? b->limb[i] : 0) - borrow;
        r->limb[i] = (uint32_t)diff;
        borrow = diff >> 63;
    }
    r->n = a->n;
}

/* r = a + b, as if b had the sign b_sign */
static void add_signed(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b,
                       int b_sign)
{
    int order = compare_size(a, b);
    const struct hm_bigint *large = order >= 0 ? a : b, *small = order >= 0 ? b : a;
    int sign = order >= 0 ? a->sign : b_sign;
    if (a->sign * b_sign < 0)
        sub_size(r, large, small);
    else
        add_size(r, large, small);
    r->sign = sign;
    trim(r);
}

void hm_bigint_add(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    add_signed(r, a, b, b->sign);
}

void hm_bigint_sub(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    add_signed(r, a, b, -b->sign);
}

void hm_bigint_mul(struct hm_bigint *r, const struct hm_bigint *a, const struct hm_bigint *b)
{
    r->n = a->n + b->n;
    memset(r->limb, 0, (size_t)r->n * sizeof r->limb[0]);
    for (int i = 0; i < a->n; i++) {
        uint64_t carry = 0;
        for (int k = 0; k < b->n; k++) {
            carry += (uint64_t)a->limb[i] * b->limb[k] + r->limb[i + k];
            r->limb[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
        r->limb[i + b->n] = (uint32_t)carry;
    }
    r->sign = a->sign * b->sign;
    trim(r);
}
