/* trace: the lines of the survey, true ones and those that a user clicks. */
#ifndef TRACE_H
#define TRACE_H

#include "terrain.h"

#include <stdint.h>
#include <stdio.h>

/* Toes and crests of banks and levee, bottom and edges of the ditch, a vertex a metre, as
 * `kind=toe|crest of=main|tributary|levee|ditch side=left|right`. Only where they really are a
 * break of the surface: crests end where another channel cuts them. */
void trace_truth(FILE *out, const struct terrain *t);

/* Rough lines: banks of the two rivers 1 to 3 m beside the crests, a piece of the levee with
 * overhang and its face, the outline of the model, the boundary strings. */
void trace_rough(FILE *out, const struct terrain *t, uint64_t seed);

#endif
