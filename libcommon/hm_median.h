/* hm_median: the middle of some numbers. Layer 1. */
#ifndef HM_MEDIAN_H
#define HM_MEDIAN_H

#include <stddef.h>

/* Sorts v; of an even number the upper one in the middle; 0 of none. No NaN among them. */
double hm_median(double *v, size_t n);

#endif
