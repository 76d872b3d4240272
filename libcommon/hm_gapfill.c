#include "hm_gapfill.h"

#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>

enum { BAND = 64 };

/* A filled node is put down here first, since only measured nodes may serve for others. */
struct filled {
    size_t node;
    double z;
};

struct fill {
    double *z;
    size_t nx, ny;
    double gap;
    struct band {
        struct filled *item;
        size_t n, cap;
        bool failed;
    } * band;
};

/* Steps from node (i, j) to the first one with data in direction (di, dj), at most `most`; 0 when
 * there is none. */
static int64_t reach(const struct fill *f, int64_t i, int64_t j, int di, int dj, int64_t most,
                     double *z)
{
    for (int64_t k = 1; k <= most; k++) {
        i += di;
        j += dj;
        if (i < 0 || j < 0 || i >= (int64_t)f->nx || j >= (int64_t)f->ny)
            return 0;
        *z = f->z[(size_t)j * f->nx + (size_t)i];
        if (!isnan(*z))
            return k;
    }
    return 0;
}

static double height_between(const struct fill *f, int64_t i, int64_t j)
{
    static const int direction[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    double sum = 0, weights = 0;
    for (int k = 0; k < 4; k++) {
        int di = direction[k][0], dj = direction[k][1];
        double step = di && dj ? sqrt(2) : 1;
        int64_t most = (int64_t)(f->gap / step);
        double za, zb;
        int64_t a = reach(f, i, j, di, dj, most - 1, &za);
        int64_t b = a ? reach(f, i, j, -di, -dj, most - a, &zb) : 0;
        if (!b)
            continue;
        double weight = 1 / (step * step * (double)(a * b));
        sum += weight * ((double)b * za + (double)a * zb) / (double)(a + b);
        weights += weight;
    }
    return weights > 0 ? sum / weights : NAN;
}

static void fill_band(void *arg, size_t chunk)
{
    const struct fill *f = arg;
    struct band *band = &f->band[chunk];
    size_t end = (chunk + 1) * BAND < f->ny ? (chunk + 1) * BAND : f->ny;
    for (size_t j = chunk * BAND; j < end; j++)
        for (size_t i = 0; i < f->nx; i++) {
            size_t node = j * f->nx + i;
            if (!isnan(f->z[node]))
                continue;
            double z = height_between(f, (int64_t)i, (int64_t)j);
            if (isnan(z))
                continue;
            if (!hm_grow(&band->item, &band->cap, band->n + 1, sizeof *band->item)) {
                band->failed = true;
                return;
            }
            band->item[band->n++] = (struct filled){node, z};
        }
}

enum hm_err hm_gapfill(double *z, size_t nx, size_t ny, double gap, int threads, struct hm_diag *d)
{
    size_t bands = (ny + BAND - 1) / BAND;
    struct fill f = {.z = z, .nx = nx, .ny = ny};
    f.gap = fmin(gap, 2 * (double)(nx > ny ? nx : ny)); /* further there is nothing */
    f.band = hm_alloc0(bands, sizeof *f.band);
    if (!f.band)
        return hm_fail_memory(d);
    hm_thread_for(threads, bands, fill_band, &f);
    bool failed = false;
    for (size_t b = 0; b < bands; b++)
        failed |= f.band[b].failed;
    for (size_t b = 0; b < bands; b++) {
        for (size_t k = 0; k < f.band[b].n && !failed; k++)
            z[f.band[b].item[k].node] = f.band[b].item[k].z;
        free(f.band[b].item);
    }
    free(f.band);
    return failed ? hm_fail_memory(d) : HM_OK;
}
