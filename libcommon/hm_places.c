#include "hm_places.h"

#include <stdlib.h>
#include <string.h>

struct hm_place {
    double x, y;
    int32_t value; /* + 1: 0 in a free slot */
};

static uint64_t bits(double v)
{
    uint64_t b;
    v += 0.0; /* -0 becomes 0 */
    memcpy(&b, &v, sizeof b);
    return b;
}

/* The finaliser of splitmix64 over both coordinates: lattices of nodes differ in few bits. */
static size_t hash(double x, double y)
{
    uint64_t h = bits(x) * 0x9e3779b97f4a7c15u + bits(y);
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return (size_t)(h ^ (h >> 31));
}

/* The slot of the place, or the free one where it would go. */
static struct hm_place *find(const struct hm_places *p, double x, double y)
{
    size_t i = hash(x, y) & (p->slots - 1);
    while (p->slot[i].value && !(p->slot[i].x == x && p->slot[i].y == y))
        i = (i + 1) & (p->slots - 1);
    return &p->slot[i];
}

static bool widen(struct hm_places *p)
{
    struct hm_places wide = {.slots = p->slots ? p->slots * 2 : 64, .n = p->n};
    wide.slot = hm_alloc0(wide.slots, sizeof *wide.slot);
    if (!wide.slot)
        return false;
    for (size_t i = 0; i < p->slots; i++)
        if (p->slot[i].value)
            *find(&wide, p->slot[i].x, p->slot[i].y) = p->slot[i];
    free(p->slot);
    *p = wide;
    return true;
}

int32_t hm_places_put(struct hm_places *p, double x, double y, int32_t value)
{
    if (p->n >= p->slots / 2 && !widen(p))
        return -1;
    struct hm_place *slot = find(p, x, y);
    if (!slot->value) {
        *slot = (struct hm_place){x, y, value + 1};
        p->n++;
    }
    return slot->value - 1;
}

int32_t hm_places_get(const struct hm_places *p, double x, double y)
{
    return p->slots ? find(p, x, y)->value - 1 : -1;
}

void hm_places_free(struct hm_places *p)
{
    free(p->slot);
    *p = (struct hm_places){0};
}
