/* hm_simplify: fewer vertices for a set of lines, without making any two of them cross. Layer 6.
 *
 * The vertex whose loss moves its line least goes first. It may go when every vertex that the line
 * had there lies within the tolerance of the new piece, and no other vertex of any line lies in the
 * triangle between the old pieces and the new one: then nothing can cross the new piece, and
 * nothing changes from one side of the line to the other.
 */
#ifndef HM_SIMPLIFY_H
#define HM_SIMPLIFY_H

#include "hm_line.h"

/* Simplify all lines in place; tolerance in metres. Ends of open lines stay, closed lines keep
 * three vertices at least. */
enum hm_err hm_simplify(struct hm_lines *lines, double tolerance, struct hm_diag *d);

#endif
