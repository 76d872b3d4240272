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
    for (int i = 0; i < 4; i++)
        b[i] = (char)(v >> 8 * i);
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
