#include "hm_export.h"

#include "hm_attr.h"
#include "hm_num.h"
#include "hm_sink.h"
#include "hm_strings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* v to p; the end. */
static char *put(char *p, double v, int decimals)
{
    return p + (decimals ? hm_num_print_fixed(p, v, decimals) : hm_num_print(p, v));
}

/* x, y, z with blanks between and `last` behind. */
static char *put_place(char *p, const double xyz[3], int decimals, char last)
{
    for (int k = 0; k < 3; k++) {
        p = put(p, xyz[k], decimals);
        *p++ = k < 2 ? ' ' : last;
    }
    return p;
}

/* --- 2dm --- */

static enum hm_err write_nodes(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < m->nnodes && !err; k++) {
        const struct hm_node *node = &m->node[k];
        char line[4 * HM_NUM_CHARS], *p = line;
        p += sprintf(p, "ND %zu ", k + 1);
        p = put_place(p, (double[3]){node->x, node->y, node->z}, 0, '\n');
        err = hm_writer_bytes(w, line, (size_t)(p - line), d);
    }
    return err;
}

static enum hm_err write_elements(const struct hm_mesh *m, int64_t nameless, struct hm_writer *w,
                                  struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < m->nelems && !err; k++) {
        const struct hm_elem *e = &m->elem[k];
        int corners = hm_elem_corners(e);
        char line[160], *p = line;
        p += sprintf(p, "%s %zu", corners == 3 ? "E3T" : "E4Q", k + 1);
        for (int i = 0; i < corners; i++)
            p += sprintf(p, " %lld", (long long)e->node[i] + 1);
        p += sprintf(p, " %lld\n", (long long)(e->region ? e->region : nameless));
        err = hm_writer_bytes(w, line, (size_t)(p - line), d);
    }
    return err;
}

/* NS cards of ten nodes, the last node negative and the name behind it. */
static enum hm_err write_string(const struct hm_string *s, struct hm_writer *w, struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; !err && k < s->n; k++)
        err = hm_writer_printf(w, d, "%s%s%lld",
                               k % 10 ? " "
                               : k    ? "\nNS "
                                      : "NS ",
                               k + 1 == s->n ? "-" : "", (long long)s->node[k] + 1);
    return err ? err : hm_writer_printf(w, d, " %s\n", s->name);
}

static enum hm_err write_strings(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    struct hm_strings s = {0};
    enum hm_err err = hm_strings_read(&s, m, d);
    for (size_t i = 0; !err && i < s.n; i++)
        err = write_string(&s.string[i], w, d);
    hm_strings_free(&s);
    return err;
}

enum hm_err hm_export_2dm(const struct hm_mesh *m, struct hm_writer *w, struct hm_diag *d)
{
    int64_t largest = 0;
    bool nameless = false;
    for (size_t k = 0; k < m->nnodes; k++)
        if (!isfinite(m->node[k].z))
            return hm_fail_at(d, HM_EGEOM, m->node[k].x, m->node[k].y, "a node has no height");
    for (size_t k = 0; k < m->nelems; k++) {
        nameless |= m->elem[k].region == 0;
        if (m->elem[k].region > largest)
            largest = m->elem[k].region;
    }
    const char *name = hm_header_get(&m->header, "name");
    enum hm_err err = hm_writer_printf(w, d, "MESH2D\n");
    if (!err && name)
        err = hm_writer_printf(w, d, "MESHNAME \"%s\"\n", name);
    if (!err)
        err = hm_writer_printf(w, d, "NUM_MATERIALS_PER_ELEM 1\n");
    if (!err)
        err = write_nodes(m, w, d);
    if (!err)
        err = write_elements(m, largest + 1, w, d);
    if (!err)
        err = write_strings(m, w, d);
    if (!err && nameless)
        err = hm_writer_printf(w, d, "BEG2DMBC\nMAT %lld \"region 0\"\nEND2DMBC\n",
                               (long long)largest + 1);
    return err;
}

/* --- ESRI ASCII grid --- */

static double value_at(const struct hm_grid *g, size_t band, int64_t i, int64_t j)
{
    return g->v[(size_t)(j * g->header.lattice.nx + i) * g->bands + band];
}

/* A nodata number that no node has. */
static double choose_nodata(const struct hm_grid *g, size_t band)
{
    const struct hm_lattice *l = &g->header.lattice;
    size_t n = (size_t)(l->nx * l->ny);
    double nodata = -9999;
    for (size_t k = 0; k < n; k++)
        if (g->v[k * g->bands + band] == nodata) {
            nodata = nodata * 10 - 9;
            k = (size_t)-1; /* from the start again */
        }
    return nodata;
}

/* The corner of the first cell when it leads back to the node exactly, else its middle. */
static char *put_anchor(char *p, char axis, double node, double step)
{
    double corner = node - step / 2;
    bool exact = corner + step / 2 == node;
    p += sprintf(p, "%cll%s ", axis, exact ? "corner" : "center");
    p = put(p, exact ? corner : node, 0);
    *p++ = '\n';
    return p;
}

static enum hm_err write_asc_header(const struct hm_lattice *l, double nodata, struct hm_writer *w,
                                    struct hm_diag *d)
{
    double step = fabs(l->dx);
    double west = l->dx > 0 ? l->x0 : l->x0 + (double)(l->nx - 1) * l->dx;
    double south = l->dy > 0 ? l->y0 : l->y0 + (double)(l->ny - 1) * l->dy;
    char text[8 * HM_NUM_CHARS], *p = text;
    p += sprintf(p, "ncols %lld\nnrows %lld\n", (long long)l->nx, (long long)l->ny);
    p = put_anchor(p, 'x', west, step);
    p = put_anchor(p, 'y', south, step);
    p += sprintf(p, "cellsize ");
    p = put(p, step, 0);
    p += sprintf(p, "\nNODATA_value ");
    p = put(p, nodata, 0);
    *p++ = '\n';
    return hm_writer_bytes(w, text, (size_t)(p - text), d);
}

enum hm_err hm_export_asc(const struct hm_grid *g, size_t band, int decimals, struct hm_writer *w,
                          struct hm_diag *d)
{
    const struct hm_lattice *l = &g->header.lattice;
    if (fabs(l->dx) != fabs(l->dy))
        return hm_fail(d, HM_EARG, "an ESRI ASCII grid has square cells, not %g x %g", fabs(l->dx),
                       fabs(l->dy));
    double nodata = choose_nodata(g, band);
    enum hm_err err = write_asc_header(l, nodata, w, d);
    for (int64_t row = 0; row < l->ny; row++) {
        int64_t j = l->dy > 0 ? l->ny - 1 - row : row;
        for (int64_t column = 0; column < l->nx && !err; column++) {
            double z = value_at(g, band, l->dx > 0 ? column : l->nx - 1 - column, j);
            char text[HM_NUM_CHARS + 1],
                *p = isnan(z) ? put(text, nodata, 0) : put(text, z, decimals);
            *p++ = column + 1 < l->nx ? ' ' : '\n';
            err = hm_writer_bytes(w, text, (size_t)(p - text), d);
        }
    }
    return err;
}

/* --- tables --- */

enum hm_err hm_export_xyz(const double *rows, size_t n, size_t stride, int decimals,
                          int64_t *left_out, struct hm_writer *w, struct hm_diag *d)
{
    for (size_t k = 0; k < n; k++) {
        const double *row = rows + k * stride;
        if (isnan(row[2])) {
            ++*left_out;
            continue;
        }
        char line[3 * (HM_NUM_CHARS + 1)], *end = put_place(line, row, decimals, '\n');
        enum hm_err err = hm_writer_bytes(w, line, (size_t)(end - line), d);
        if (err)
            return err;
    }
    return HM_OK;
}

enum hm_err hm_export_csv_names(char *const *fields, size_t n, struct hm_writer *w,
                                struct hm_diag *d)
{
    enum hm_err err = HM_OK;
    for (size_t k = 0; k < n && !err; k++)
        err = hm_writer_printf(w, d, "%s%c", fields[k], k + 1 < n ? ',' : '\n');
    return err;
}

enum hm_err hm_export_csv(const double *rows, size_t n, size_t stride, int decimals,
                          struct hm_writer *w, struct hm_diag *d)
{
    struct hm_sink s = hm_sink_to(w, d);
    for (size_t k = 0; k < n * stride; k++) {
        if (!isnan(rows[k]))
            hm_sink_number(&s, rows[k], decimals);
        hm_sink_text(&s, (k + 1) % stride ? "," : "\n");
    }
    return hm_sink_finish(&s);
}

enum hm_err hm_export_gmt(const struct hm_line *line, int decimals, struct hm_writer *w,
                          struct hm_diag *d)
{
    char *attrs = hm_attr_set(line->attrs, "closed", NULL);
    if (!attrs)
        return hm_fail_memory(d);
    enum hm_err err = hm_writer_printf(w, d, *attrs ? "> %s\n" : ">\n", attrs);
    free(attrs);
    size_t n = line->n + (line->closed && line->n > 0);
    for (size_t k = 0; k < n && !err; k++) {
        char text[3 * (HM_NUM_CHARS + 1)];
        char *end = put_place(text, line->xyz + 3 * (k % line->n), decimals, '\n');
        err = hm_writer_bytes(w, text, (size_t)(end - text), d);
    }
    return err;
}
