/* hmcloud: any number of points to standard output, as a binary stream, without holding them.
 *
 *     hmcloud COUNT WIDTH
 *
 * Scan lines over a square of WIDTH metres from (0, 0): rolling ground cut by parallel channels
 * with banks of 1:2, heights with a noise of 0.05 m. Equal operands give equal bytes.
 */
#include "hm_writer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t state = 1;

/* Uniform in [0, 1): the upper bits of a linear congruence. */
static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

/* Ground at (x, y): channels 400 m apart, 30 m wide at the top and 4 m deep. */
static double ground(double x, double y)
{
    double roll = 0.5 * (x - y) * 1e-3, from_axis = fabs(fmod(x + 0.2 * y, 400) - 200);
    double bank = (from_axis - 7) / 2 - 4;
    return roll + (bank < -4 ? -4 : bank > 0 ? 0 : bank);
}

static void check(enum hm_err err, const struct hm_diag *d)
{
    if (err) {
        fprintf(stderr, "hmcloud: %s\n", d->text);
        exit(2);
    }
}

int main(int argc, char **argv)
{
    enum { BATCH = 4096 };
    double count = argc == 3 ? strtod(argv[1], NULL) : 0;
    double width = argc == 3 ? strtod(argv[2], NULL) : 0;
    if (!(count >= 1 && count <= 1e12 && width > 0)) {
        fputs("usage: hmcloud COUNT WIDTH\n", stderr);
        return 2;
    }
    static double row[3 * BATCH];
    struct hm_writer *w;
    struct hm_header h;
    struct hm_diag d = {0};
    check(hm_header_init(&h, HM_POINTS, &d), &d);
    check(hm_writer_open(&w, "-", (struct hm_format){.binary = true}, &d), &d);
    check(hm_writer_begin(w, &h, &d), &d);
    double step = width / sqrt(count), x = 0, y = 0;
    for (int64_t k = 0, left = (int64_t)count; k < left;) {
        size_t n = 0;
        for (; n < BATCH && k < left; n++, k++) {
            double px = x + step * uniform(), py = y + step * uniform();
            double noise = 0.1 * (uniform() + uniform() + uniform() - 1.5);
            row[3 * n] = px;
            row[3 * n + 1] = py;
            row[3 * n + 2] = ground(px, py) + noise;
            x += step;
            if (x >= width) {
                x = 0;
                y += step;
            }
        }
        check(hm_writer_points(w, row, n, &d), &d);
    }
    check(hm_writer_end(w, &d), &d);
    check(hm_writer_close(&w, &d), &d);
    hm_header_free(&h);
    return 0;
}
