/* hm_buckets: which measurements lie in which triangle of a domain. Layer 6. */
#ifndef HM_BUCKETS_H
#define HM_BUCKETS_H

#include "hm_domain.h"

enum { HM_NOBODY = -1 };

struct hm_buckets {
    const struct hm_domain *dom;
    const double *xyz; /* the measurements: x, y, z of each */
    int32_t *first;    /* by triangle: a measurement in it, or HM_NOBODY */
    int32_t *next;     /* by measurement: another one in its triangle */
    size_t n_first, cap_first;
    int32_t *star;      /* the star looked at last: edges from its vertex, of triangles inside */
    const double **rim; /* the other two corners of each, left of its edge from the vertex */
    size_t n_star, cap_star, cap_rim;
};

/* Sort n measurements, which stay the caller's, into the triangles inside a triangulated domain. */
enum hm_err hm_buckets_fill(struct hm_buckets *b, const struct hm_domain *dom, const double *xyz,
                            size_t n, int threads, struct hm_diag *d);
void hm_buckets_free(struct hm_buckets *b);

static inline const double *hm_buckets_at(const struct hm_buckets *b, int32_t measurement)
{
    return b->xyz + 3 * (size_t)measurement;
}

/* Find the star of a vertex, which may be new: then its triangles took the places of those that
 * were there, and two more. */
enum hm_err hm_buckets_look(struct hm_buckets *b, int32_t v, struct hm_diag *d);

/* Which triangle of that star holds p, with the vertex at v? The number of its edge: the one with p
 * left of its first edge and right of its last; for a p on the border, or at the vertex, as
 * rounding has it. */
size_t hm_buckets_sector(const struct hm_buckets *b, const double *v, const double *p);

/* Sort the measurements in that star anew, with the vertex at v; `but` is left out, for good. */
void hm_buckets_deal(struct hm_buckets *b, const double *v, int32_t but);

/* Leave a measurement out of its triangle, for good. */
void hm_buckets_drop(struct hm_buckets *b, int32_t tri, int32_t measurement);

#endif
