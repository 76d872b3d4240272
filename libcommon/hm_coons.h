/* hm_coons: the bilinearly blended Coons patch (Coons 1967), by which the paper places the interior
 * control points (section 5.1). Layer 6. */
#ifndef HM_COONS_H
#define HM_COONS_H

#include <stddef.h>

/* The border of an n × m net of points (x, y) is known; fill the inside: column i lies at u[i],
 * row j at v[j], both rising from 0 to 1. Point (i, j) is net[(j*n + i)*stride]. The corners are
 * those of rows 0 and m-1. */
void hm_coons_fill(double *net, size_t n, size_t m, size_t stride, const double *u,
                   const double *v);

#endif
