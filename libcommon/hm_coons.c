#include "hm_coons.h"

/* Ruled between the rows, plus ruled between the columns, minus bilinear between the corners. */
void hm_coons_fill(double *net, size_t n, size_t m, size_t stride, const double *u, const double *v)
{
    const double *bottom = net, *top = net + (m - 1) * n * stride, *corner = (n - 1) * stride + net;
    for (size_t j = 1; j + 1 < m; j++) {
        double *row = net + j * n * stride;
        const double *first = row, *last = row + (n - 1) * stride;
        for (size_t i = 1; i + 1 < n; i++)
            for (size_t k = 0; k < 2; k++) {
                size_t at = i * stride + k;
                double rows = (1 - v[j]) * bottom[at] + v[j] * top[at];
                double columns = (1 - u[i]) * first[k] + u[i] * last[k];
                double corners = (1 - v[j]) * ((1 - u[i]) * bottom[k] + u[i] * corner[k]) +
                                 v[j] * ((1 - u[i]) * top[k] + u[i] * top[(n - 1) * stride + k]);
                row[at] = rows + columns - corners;
            }
    }
}
