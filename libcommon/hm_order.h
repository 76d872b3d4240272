/* hm_order: points sorted along a space-filling curve, so that neighbours in the plane are
 * neighbours in memory. Layer 2.
 *
 * A frame lays 2^16 x 2^16 square cells over a rectangle of points; the key of a cell is its Morton
 * number (the bits of row and column interlaced, y above x). Cells are monotone in the coordinates:
 * where the keys of two points part at an x bit, the point with the 0 has the smaller x.
 */
#ifndef HM_ORDER_H
#define HM_ORDER_H

#include "hm_base.h"

/* cell = (v * pre - min) * scale[0] * scale[1], rounded down; all factors are powers of two */
struct hm_order_frame {
    double min[2], pre, scale[2];
};

struct hm_order_item {
    uint32_t key, index;
};

/* The frame of n points (all finite), the i-th at xy[i*stride]. */
struct hm_order_frame hm_order_frame(const double *xy, size_t n, size_t stride);
uint32_t hm_order_key(const struct hm_order_frame *f,
                      const double *p); /* any p: the nearest cell */

/* How finely to sort: to the cell, points of a cell by index; or on to the last bit, points of a
 * cell by their keys in a frame of their own and so on, and only equal points by index. */
enum hm_order_how { HM_ORDER_COARSE, HM_ORDER_FINE };

/* Sort n < 2^32 points. item[0 .. n) is the result, with the keys of the frame of all; other[0 ..
 * n) is scratch. The same for any number of threads. HM_ENOMEM. */
enum hm_err hm_order_sort(const double *xy, size_t n, size_t stride, enum hm_order_how how,
                          int threads, struct hm_order_item *item, struct hm_order_item *other,
                          struct hm_diag *d);

#endif
