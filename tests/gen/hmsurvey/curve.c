#include "curve.h"

#include <math.h>

void curve_init(struct curve *c, const double (*parts)[2], size_t n, double w, double h)
{
    c->n = n;
    for (size_t i = 0; i < n; i++) {
        c->control[i][0] = parts[i][0] * w;
        c->control[i][1] = parts[i][1] * h;
    }
    c->nsamples = 8 * (n - 3) + 1;
    for (size_t k = 0; k < c->nsamples; k++)
        curve_at(c, (double)k / 8, c->sample[k], NULL, NULL);
}

double curve_end(const struct curve *c)
{
    return (double)(c->n - 3);
}

void curve_at(const struct curve *c, double t, double p[2], double d1[2], double d2[2])
{
    size_t i = t <= 0 ? 0 : (size_t)t;
    if (i > c->n - 4)
        i = c->n - 4;
    double u = t - (double)i, v = 1 - u;
    for (int k = 0; k < 2; k++) {
        double a = c->control[i][k], b = c->control[i + 1][k];
        double e = c->control[i + 2][k], f = c->control[i + 3][k];
        p[k] = (v * v * v * a + (3 * u * u * u - 6 * u * u + 4) * b +
                (3 * v * v * v - 6 * v * v + 4) * e + u * u * u * f) /
               6;
        if (d1)
            d1[k] = (v * v * (b - a) + (1 + 2 * u * v) * (e - b) + u * u * (f - e)) / 2;
        if (d2)
            d2[k] = v * (a - 2 * b + e) + u * (b - 2 * e + f);
    }
}

void curve_offset(const struct curve *c, double t, double offset, double p[2])
{
    double d[2];
    curve_at(c, t, p, d, NULL);
    double length = sqrt(d[0] * d[0] + d[1] * d[1]);
    p[0] -= offset * d[1] / length;
    p[1] += offset * d[0] / length;
}

double curve_advance(const struct curve *c, double t, double length)
{
    /* Heun's steps of about a metre: millimetres at the end, and nobody measures by it. */
    int steps = (int)fabs(length) + 1;
    for (int k = 0; k < steps; k++) {
        double p[2], d[2], e[2], dt;
        curve_at(c, t, p, d, NULL);
        dt = length / steps / sqrt(d[0] * d[0] + d[1] * d[1]);
        curve_at(c, t + dt, p, e, NULL);
        t += (dt + length / steps / sqrt(e[0] * e[0] + e[1] * e[1])) / 2;
    }
    return t;
}

/* Newton's iteration for (c(t) - p) · c'(t) = 0, kept within half a sample of where it began. */
static double polish(const struct curve *c, const double p[2], double start, double *t)
{
    double lo = fmax(0, start - 0.125), hi = fmin(curve_end(c), start + 0.125);
    double q[2], d1[2], d2[2];
    *t = start;
    for (int k = 0; k < 6; k++) {
        curve_at(c, *t, q, d1, d2);
        double rx = q[0] - p[0], ry = q[1] - p[1];
        double f = rx * d1[0] + ry * d1[1];
        double df = d1[0] * d1[0] + d1[1] * d1[1] + rx * d2[0] + ry * d2[1];
        if (df <= 0)
            break;
        *t = fmin(hi, fmax(lo, *t - f / df));
    }
    curve_at(c, *t, q, NULL, NULL);
    return sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]));
}

double curve_distance(const struct curve *c, const double p[2], double reach, double *t)
{
    double best = INFINITY, step = 0;
    size_t at = 0;
    for (size_t k = 0; k < c->nsamples; k++) {
        double dx = c->sample[k][0] - p[0], dy = c->sample[k][1] - p[1];
        double square = dx * dx + dy * dy;
        if (square < best) {
            best = square;
            at = k;
        }
    }
    if (at + 1 < c->nsamples)
        step = fabs(c->sample[at + 1][0] - c->sample[at][0]) +
               fabs(c->sample[at + 1][1] - c->sample[at][1]);
    *t = (double)at / 8;
    if (sqrt(best) > reach + step)
        return sqrt(best);
    return polish(c, p, *t, t);
}
