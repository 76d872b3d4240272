/* hm_plane: points, segments and triangles in the plane. Layer 2. A point is its x and y. */
#ifndef HM_PLANE_H
#define HM_PLANE_H

#include "hm_base.h"

static inline bool hm_plane_same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* Does p lie on the segment a–b, exactly? Ends count. */
bool hm_plane_holds(const double *p, const double *a, const double *b);

/* The place on the segment a–b nearest to p, as a part of the way from a to b, 0 .. 1; 0 for a
 * segment of no length. */
double hm_plane_foot(const double *p, const double *a, const double *b);

/* Distance of p from the segment a–b. */
double hm_plane_distance(const double *p, const double *a, const double *b);

/* Distance of the segments a–b and c–d; 0 when they meet. When they do not, `middle` gets the point
 * halfway between the nearest points of both. */
double hm_plane_gap(const double *a, const double *b, const double *c, const double *d,
                    double middle[2]);

/* Have the segments a–b and c–d a point in common, exactly? Ends count. */
bool hm_plane_meet(const double *a, const double *b, const double *c, const double *d);

/* The same; when they have, `place` gets one (rounded): an end where one touches the other. */
bool hm_plane_meet_at(const double *a, const double *b, const double *c, const double *d,
                      double place[2]);

/* Do they cross, each with an end on both sides of the other, exactly? */
bool hm_plane_cross(const double *a, const double *b, const double *c, const double *d);

/* Does the ray from p to the right cross the segment a–b? Of ends at the height of p one counts and
 * the other does not, so that a ring is crossed an odd number of times from inside, and an even
 * number from outside. Exact. */
enum hm_ray { HM_RAY_MISSES, HM_RAY_CROSSES, HM_RAY_ON /* p lies on a–b */ };
enum hm_ray hm_plane_ray(const double *p, const double *a, const double *b);

/* Where a–b meets c–d, as a part of a–b, 0 .. 1; exactly 0 or 1 when a or b lies on c–d. For
 * segments that meet; of an overlap the place nearest to a. */
double hm_plane_meeting(const double *a, const double *b, const double *c, const double *d);

/* The angle at `at` between the ways to a and to b, 0 .. 180 degrees. */
double hm_plane_angle(const double *at, const double *a, const double *b);

/* Height at p of the triangle a, b, c (either way round) whose corners have the heights z. For p in
 * the triangle or, as rounding has it, beside its border: always between the heights of the
 * corners, at a corner its height to the last bit, and the same whichever corner comes first. */
double hm_plane_height(const double *a, const double *b, const double *c, const double z[3],
                       const double *p);

#endif
