#include "hm_cellsort.h"

#include <math.h>
#include <stdlib.h>

bool hm_cellsort_cell(const struct hm_anchor *a, const double *xy, size_t *i, size_t *j)
{
    double u = floor(xy[0] / a->spacing + 0.5) - (double)a->i0;
    double v = floor(xy[1] / a->spacing + 0.5) - (double)a->j0;
    if (!(u >= 0 && u < (double)a->nx && v >= 0 && v < (double)a->ny))
        return false;
    *i = (size_t)u;
    *j = (size_t)v;
    return true;
}

enum hm_err hm_cellsort_make(struct hm_cellsort *c, const struct hm_anchor *a, const double *xyz,
                             size_t n, struct hm_diag *d)
{
    size_t cells = a->nx * a->ny, i, j;
    *c = (struct hm_cellsort){a->nx, a->ny, hm_alloc0(cells + 2, sizeof *c->start),
                              hm_alloc(n, sizeof *c->item)};
    if (!c->start || !c->item) {
        hm_cellsort_free(c);
        return hm_fail_memory(d);
    }
    /* count one place further on; filling moves every start to its own place */
    size_t *next = c->start + 1;
    for (size_t k = 0; k < n; k++)
        if (hm_cellsort_cell(a, xyz + 3 * k, &i, &j))
            next[j * a->nx + i + 1]++;
    for (size_t k = 0; k < cells; k++)
        next[k + 1] += next[k];
    for (size_t k = 0; k < n; k++)
        if (hm_cellsort_cell(a, xyz + 3 * k, &i, &j))
            c->item[next[j * a->nx + i]++] = k;
    return HM_OK;
}

void hm_cellsort_free(struct hm_cellsort *c)
{
    free(c->start);
    free(c->item);
    *c = (struct hm_cellsort){0};
}

static void swap(double *a, double *b)
{
    double t = *a;
    *a = *b;
    *b = t;
}

/* Put the k-th smallest to v[k], none greater before it (Hoare's selection, as by Wirth). */
static void select_nth(double *v, int64_t n, int64_t k)
{
    int64_t low = 0, high = n - 1;
    while (low < high) {
        double pivot = v[k];
        int64_t i = low, j = high;
        do {
            while (v[i] < pivot)
                i++;
            while (v[j] > pivot)
                j--;
            if (i <= j)
                swap(&v[i++], &v[j--]);
        } while (i <= j);
        if (j < k)
            low = i;
        if (k < i)
            high = j;
    }
}

double hm_cellsort_median(double *v, size_t n)
{
    size_t half = n / 2;
    select_nth(v, (int64_t)n, (int64_t)half);
    if (n & 1)
        return v[half];
    double below = v[0];
    for (size_t k = 1; k < half; k++)
        below = v[k] > below ? v[k] : below;
    return below + (v[half] - below) / 2;
}

enum hm_err hm_cellsort_medians(const struct hm_cellsort *c, const double *xyz, double *z,
                                struct hm_diag *d)
{
    double *v = NULL;
    size_t cap = 0;
    for (size_t k = 0; k < c->nx * c->ny; k++) {
        size_t n = c->start[k + 1] - c->start[k];
        z[k] = NAN;
        if (n == 0)
            continue;
        if (!hm_grow(&v, &cap, n, sizeof *v)) {
            free(v);
            return hm_fail_memory(d);
        }
        for (size_t p = 0; p < n; p++)
            v[p] = xyz[3 * c->item[c->start[k] + p] + 2];
        z[k] = hm_cellsort_median(v, n);
    }
    free(v);
    return HM_OK;
}
