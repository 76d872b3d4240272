/* rng: seeded random numbers, the same bits on every machine (splitmix64). */
#ifndef RNG_H
#define RNG_H

#include <stdint.h>

struct rng {
    uint64_t state;
};

static inline uint64_t rng_bits(struct rng *r)
{
    uint64_t z = (r->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Uniform in [lo, hi). */
static inline double rng_uniform(struct rng *r, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(rng_bits(r) >> 11) * 0x1p-53);
}

/* Mean 0, standard deviation 1: the sum of twelve uniform numbers, which needs no logarithm. */
static inline double rng_normal(struct rng *r)
{
    double sum = -6;
    for (int k = 0; k < 12; k++)
        sum += rng_uniform(r, 0, 1);
    return sum;
}

static inline int rng_sign(struct rng *r)
{
    return rng_bits(r) >> 63 ? 1 : -1;
}

#endif
