#include "hm_elem.h"

#include "hm_plane.h"
#include "hm_pred.h"

#include <math.h>

int hm_elem_xy(const struct hm_mesh *m, const struct hm_elem *e, double xy[4][2])
{
    int n = hm_elem_corners(e);
    for (int i = 0; i < n; i++) {
        xy[i][0] = m->node[e->node[i]].x;
        xy[i][1] = m->node[e->node[i]].y;
    }
    return n;
}

struct hm_box hm_elem_box(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    struct hm_box box = hm_box_of(p[0], p[1]);
    for (int i = 2; i < n; i++)
        hm_box_add(&box, p[i]);
    return box;
}

double hm_elem_area(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    double area2 = hm_area2(p[0], p[1], p[2]);
    if (n == 4)
        area2 += hm_area2(p[0], p[2], p[3]);
    return area2 / 2;
}

void hm_elem_angles(const struct hm_mesh *m, const struct hm_elem *e, double *least, double *most)
{
    const double degrees = 180 / acos(-1);
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    *least = 360;
    *most = 0;
    for (int i = 0; i < n; i++) {
        const double *here = p[i], *next = p[(i + 1) % n], *before = p[(i + n - 1) % n];
        double dot = (next[0] - here[0]) * (before[0] - here[0]) +
                     (next[1] - here[1]) * (before[1] - here[1]);
        double angle = atan2(hm_area2(here, next, before), dot) * degrees;
        if (angle < 0)
            angle += 360;
        *least = fmin(*least, angle);
        *most = fmax(*most, angle);
    }
}

/* The length of the edge that begins at corner i of n. */
static double edge_length(double p[4][2], int i, int n)
{
    const double *a = p[i], *b = p[(i + 1) % n];
    return hypot(b[0] - a[0], b[1] - a[1]);
}

double hm_elem_edge_ratio(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    double least = INFINITY, most = 0;
    for (int i = 0; i < n; i++) {
        double length = edge_length(p, i, n);
        least = fmin(least, length);
        most = fmax(most, length);
    }
    return least > 0 ? most / least : INFINITY;
}

void hm_elem_centre(const struct hm_mesh *m, const struct hm_elem *e, double xy[2])
{
    const double *first = hm_mesh_xy(m, e->node[0]);
    int corners = hm_elem_corners(e);
    double sum[2] = {0, 0}; /* from the first corner: large coordinates would cost digits */
    for (int k = 1; k < corners; k++)
        for (int c = 0; c < 2; c++)
            sum[c] += hm_mesh_xy(m, e->node[k])[c] - first[c];
    for (int c = 0; c < 2; c++)
        xy[c] = first[c] + sum[c] / corners;
}

double hm_elem_mean_edge(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += edge_length(p, i, n);
    return sum / n;
}

bool hm_elem_is_convex(const struct hm_mesh *m, const struct hm_elem *e)
{
    double p[4][2];
    int n = hm_elem_xy(m, e, p);
    for (int i = 0; i < n; i++)
        if (hm_pred_orient(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0)
            return false;
    return true;
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Inverse of the isoparametric map h = s·e + t·f + s·t·g (h, e, f from the first corner). Taking
 * the cross product with e + t·g leaves F(t) = k2·t² + k1·t + k0 = 0. At the wanted root F' is the
 * map's Jacobian, which is positive in a convex quadrilateral, so it is the root with +√: of its
 * two forms the one without cancellation is used, which also serves parallelograms (k2 = 0). */
static double quad_height(double p[4][2], const double z[4], double px, double py)
{
    double h[2], e[2], f[2], g[2];
    double at[2] = {px, py};
    for (int k = 0; k < 2; k++) {
        h[k] = at[k] - p[0][k];
        e[k] = p[1][k] - p[0][k];
        f[k] = p[3][k] - p[0][k];
        g[k] = (p[2][k] - p[3][k]) - e[k];
    }
    double k2 = cross(g, f), k1 = cross(e, f) + cross(h, g), k0 = cross(h, e);
    double root = sqrt(fmax(k1 * k1 - 4 * k2 * k0, 0));
    double t = k1 > 0 ? -2 * k0 / (k1 + root) : (root - k1) / (2 * k2);
    double a[2] = {e[0] + t * g[0], e[1] + t * g[1]};
    double s = ((h[0] - t * f[0]) * a[0] + (h[1] - t * f[1]) * a[1]) / (a[0] * a[0] + a[1] * a[1]);
    if (!isfinite(s) || !isfinite(t))
        return (z[0] + z[1] + z[2] + z[3]) / 4;
    return z[0] + s * (z[1] - z[0]) + t * (z[3] - z[0]) + s * t * ((z[2] - z[3]) - (z[1] - z[0]));
}

double hm_elem_height(const struct hm_mesh *m, const struct hm_elem *e, double px, double py)
{
    double p[4][2], z[4];
    int n = hm_elem_xy(m, e, p);
    for (int i = 0; i < n; i++)
        z[i] = m->node[e->node[i]].z;
    const double at[2] = {px, py};
    return n == 3 ? hm_plane_height(p[0], p[1], p[2], z, at) : quad_height(p, z, px, py);
}

bool hm_elem_holds(const struct hm_mesh *m, const struct hm_elem *e, double px, double py)
{
    double p[4][2], at[2] = {px, py};
    int n = hm_elem_xy(m, e, p);
    bool left = false, right = false;
    bool west = false, east = false, south = false, north = false;
    for (int i = 0; i < n; i++) {
        int side = hm_pred_orient(p[i], p[(i + 1) % n], at);
        left |= side > 0;
        right |= side < 0;
        west |= p[i][0] <= px;
        east |= p[i][0] >= px;
        south |= p[i][1] <= py;
        north |= p[i][1] >= py;
    }
    /* the box decides for elements without area, on whose line all sides are 0 */
    return !(left && right) && west && east && south && north;
}

/* Does an edge of p (counter-clockwise) have all of q on its right, or on its line? Common nodes
 * are on it without asking: the exact predicate is slow where the answer is 0. */
static bool separates(double p[4][2], int np, double q[4][2], int nq)
{
    for (int i = 0; i < np; i++) {
        const double *a = p[i], *b = p[(i + 1) % np];
        int j = 0;
        while (j < nq && (hm_plane_same(a, q[j]) || hm_plane_same(b, q[j]) ||
                          hm_pred_orient(a, b, q[j]) <= 0))
            j++;
        if (j == nq)
            return true;
    }
    return false;
}

bool hm_elem_overlap(const struct hm_mesh *m, const struct hm_elem *e, const struct hm_mesh *n,
                     const struct hm_elem *f)
{
    double p[4][2], q[4][2];
    int np = hm_elem_xy(m, e, p), nq = hm_elem_xy(n, f, q);
    return !separates(p, np, q, nq) && !separates(q, nq, p, np);
}
