/* hm_block: the blocks of the binary form, for reader and writer. Layer 5.
 *
 * A block is a tag of four bytes, u32 zero, u64 count, and its records, all little endian.
 */
#ifndef HM_BLOCK_H
#define HM_BLOCK_H

#include <stdint.h>
#include <string.h>

enum {
    HM_BLOCK_RECORDS = 65536, /* a block holds so many but for the last */
    HM_BLOCK_HEAD = 16        /* bytes of tag, zero and count */
};

static inline uint64_t hm_block_swap(uint64_t v)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return __builtin_bswap64(v);
#else
    return v;
#endif
}

static inline uint64_t hm_block_get_u64(const char *b)
{
    uint64_t v;
    memcpy(&v, b, sizeof v);
    return hm_block_swap(v);
}

static inline void hm_block_put_u64(char *b, uint64_t v)
{
    v = hm_block_swap(v);
    memcpy(b, &v, sizeof v);
}

static inline uint32_t hm_block_get_u32(const char *b)
{
    const unsigned char *u = (const unsigned char *)b;
    return (uint32_t)u[0] | (uint32_t)u[1] << 8 | (uint32_t)u[2] << 16 | (uint32_t)u[3] << 24;
}

static inline void hm_block_put_u32(char *b, uint32_t v)
{
    b[0] = (char)v;
    b[1] = (char)(v >> 8);
    b[2] = (char)(v >> 16);
    b[3] = (char)(v >> 24);
}

static inline double hm_block_get_f64(const char *b)
{
    uint64_t bits = hm_block_get_u64(b);
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static inline void hm_block_put_f64(char *b, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    hm_block_put_u64(b, bits);
}

/* Turn n numbers from the order of the stream to that of this machine, or back. */
static inline void hm_block_turn_f64s(double *v, size_t n)
{
    char *b = (char *)v;
    for (size_t i = 0; __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ && i < n; i++)
        v[i] = hm_block_get_f64(b + 8 * i);
}

/* n numbers at once */
static inline void hm_block_get_f64s(double *to, const char *b, size_t n)
{
    memcpy(to, b, 8 * n);
    hm_block_turn_f64s(to, n);
}

static inline void hm_block_put_f64s(char *b, const double *v, size_t n)
{
    memcpy(b, v, 8 * n);
    for (size_t i = 0; __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ && i < n; i++)
        hm_block_put_f64(b + 8 * i, v[i]);
}

static inline float hm_block_get_f32(const char *b)
{
    uint32_t bits = hm_block_get_u32(b);
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static inline void hm_block_put_f32(char *b, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    hm_block_put_u32(b, bits);
}

#endif
