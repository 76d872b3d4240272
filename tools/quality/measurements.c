/* Measurements against meshes: where each lies, how high the mesh is there, the residual stream. */
#include "quality.h"

#include "hm_batch.h"
#include "hm_elem.h"
#include "hm_num.h"
#include "hm_thread.h"
#include "hm_unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 2048 };

/* --- units --- */

void quality_scale(struct run *run, const struct hm_header *h, const struct hm_quality *q,
                   double scale[2])
{
    double metres[2] = {1, 1};
    struct hm_diag d = {0};
    hm_cli_check(run->cli, hm_unit_metres(h, metres, &d), &d);
    scale[0] = metres[0] / q->metres;
    scale[1] = metres[1] / q->z_metres;
}

void quality_scale_lines(struct run *run, const struct hm_lines *lines, const struct hm_quality *q,
                         struct hm_lines *scaled)
{
    double scale[2];
    struct hm_diag d = {0};
    quality_scale(run, &lines->header, q, scale);
    *scaled = (struct hm_lines){0};
    for (size_t k = 0; k < lines->n; k++) {
        hm_cli_check(run->cli, hm_lines_append(scaled, &lines->line[k], &d), &d);
        double *xyz = scaled->line[k].xyz;
        for (size_t i = 0; i < 3 * scaled->line[k].n; i++)
            xyz[i] *= scale[i % 3 == 2];
    }
}

/* --- some measurements at a time --- */

/* Where each lies on a mesh, and its residual there. */
struct finding {
    enum hm_survey_place place;
    int64_t elem;
    double residual;
};

struct comparison {
    const struct run *run;
    const double *rows;
    size_t n, stride;
    double scale[MESHES][2];
    int class_field; /* column of the class, or -1 */
    struct finding found[MESHES][HM_BATCH];
};

static struct finding find(const struct hm_quality *q, const double *p, const double scale[2],
                           int32_t *hint)
{
    double x = p[0] * scale[0], y = p[1] * scale[0];
    struct finding f = {.residual = NAN};
    f.elem = hm_quality_place(q, x, y, hint, &f.place);
    if (f.elem >= 0) {
        double z = hm_elem_height(&q->mesh, &q->mesh.elem[f.elem], x, y);
        f.residual = (z - p[2] * scale[1]) * q->z_metres;
    }
    return f;
}

static void compare_chunk(void *arg, size_t chunk)
{
    struct comparison *c = arg;
    size_t end = (chunk + 1) * CHUNK < c->n ? (chunk + 1) * CHUNK : c->n;
    for (size_t m = 0; m < c->run->nmeshes; m++) {
        int32_t hint = 0;
        for (size_t i = chunk * CHUNK; i < end; i++)
            c->found[m][i] = find(&c->run->mesh[m], c->rows + i * c->stride, c->scale[m], &hint);
    }
}

/* The stratum of a measurement by what its row, or its place on the first mesh, says. */
static int64_t stratum_of(const struct comparison *c, const double *p, const struct finding *f)
{
    const struct run *run = c->run;
    double scale = c->scale[0][0];
    switch (run->strata) {
    case HM_STRATA_CLASS:
        return isfinite(p[c->class_field]) ? (int64_t)p[c->class_field] : -1;
    case HM_STRATA_REGION:
        return f->elem < 0 ? -1 : run->mesh[0].mesh.elem[f->elem].region;
    case HM_STRATA_ZONE:
        return f->elem < 0 ? -1 : hm_zones_find(&run->zones, p[0] * scale, p[1] * scale);
    default:
        return 0;
    }
}

static void count_point(struct run *run, const struct comparison *c, size_t i)
{
    const double *p = c->rows + i * c->stride;
    struct hm_diag d = {0};
    int64_t key = stratum_of(c, p, &c->found[0][i]);
    for (size_t m = 0; m < run->nmeshes; m++) {
        const struct finding *f = &c->found[m][i];
        struct hm_residual r = {p[0] * c->scale[m][0], p[1] * c->scale[m][0], f->residual};
        hm_cli_check(run->cli,
                     hm_survey_add(&run->mesh[m].survey, r, f->place, isnan(p[2]),
                                   run->strata ? &key : NULL, &d),
                     &d);
    }
}

static void write_residual(struct run *run, const struct comparison *c, size_t i)
{
    const double *p = c->rows + i * c->stride, *scale = c->scale[0];
    double residual = c->found[0][i].residual;
    int class = hm_residual_classify(residual, run->mesh[0].survey.thresholds);
    double row[5] = {p[0] * scale[0], p[1] * scale[0], p[2] * scale[1], residual, class};
    struct hm_diag d = {0};
    hm_cli_check(run->cli, hm_writer_points(run->writer, row, 1, &d), &d);
}

static void compare(struct run *run, struct comparison *c)
{
    hm_thread_for(hm_cli_threads(run->cli), (c->n + CHUNK - 1) / CHUNK, compare_chunk, c);
    for (size_t i = 0; i < c->n; i++) {
        count_point(run, c, i);
        if (run->writer)
            write_residual(run, c, i);
    }
}

/* --- the residual stream --- */

static enum hm_err set_units(const struct run *run, struct hm_header *h, struct hm_diag *d)
{
    const char *units = hm_header_get(&run->mesh[0].mesh.header, "units");
    return hm_header_set(h, "units", units ? units : "m m m", d);
}

static enum hm_err set_thresholds(const struct run *run, struct hm_header *h, struct hm_diag *d)
{
    char text[2 * HM_NUM_CHARS + 2];
    const double *t = run->mesh[0].survey.thresholds;
    size_t n = hm_num_print(text, t[0]);
    text[n++] = ' ';
    text[n + hm_num_print(text + n, t[1])] = 0;
    return hm_header_set(h, "thresholds", text, d);
}

/* Coordinates are those of the mesh: a system of the measurements in other units is not theirs. */
static void begin_residuals(struct run *run, bool converted)
{
    struct hm_diag d = {0};
    struct hm_header h;
    enum hm_err err = hm_header_init(&h, HM_POINTS, &d);
    hm_cli_make_header(run->cli, &h);
    if (!err && converted)
        err = hm_header_set(&h, "crs", hm_header_get(&run->mesh[0].mesh.header, "crs"), &d);
    if (!err)
        err = set_units(run, &h, &d);
    if (!err)
        err = set_thresholds(run, &h, &d);
    if (!err)
        err = hm_header_add_field(&h, "residual", "m", &d);
    if (!err)
        err = hm_header_add_field(&h, "class", "1", &d);
    if (!err)
        err = hm_writer_open(&run->writer, run->residuals, hm_cli_format(run->cli), &d);
    if (!err)
        err = hm_writer_begin(run->writer, &h, &d);
    hm_header_free(&h);
    hm_cli_check(run->cli, err, &d);
}

void quality_end_residuals(struct run *run)
{
    struct hm_diag d = {0};
    if (!run->writer)
        return;
    enum hm_err err = hm_writer_end(run->writer, &d);
    if (!err)
        err = hm_writer_close(&run->writer, &d);
    hm_cli_check(run->cli, err, &d);
}

/* --- objects of measurements --- */

static struct comparison *new_comparison(struct run *run, const struct hm_header *h)
{
    struct comparison *c = hm_alloc(1, sizeof *c);
    if (!c)
        hm_cli_die(run->cli, "out of memory");
    c->run = run;
    c->stride = h->nfields;
    c->class_field = hm_header_field(h, "class");
    if (run->strata == HM_STRATA_CLASS && c->class_field < 0)
        hm_cli_die(run->cli, "--by class: points without a field 'class' among the inputs");
    for (size_t m = 0; m < run->nmeshes; m++)
        quality_scale(run, h, &run->mesh[m], c->scale[m]);
    if (run->residuals && !run->writer)
        begin_residuals(run, c->scale[0][0] != 1);
    run->compared = true;
    return c;
}

void quality_stream_points(struct run *run, const struct hm_header *h)
{
    struct hm_diag d = {0};
    struct comparison *c = new_comparison(run, h);
    struct hm_batch b = {0};
    enum hm_err err;
    while (!(err = hm_batch_read(&b, hm_cli_reader(run->cli), h, &d))) {
        c->rows = b.rows;
        c->n = b.n;
        compare(run, c);
        hm_cli_progress_points(run->cli, b.n);
    }
    hm_cli_check(run->cli, err, &d);
    hm_batch_free(&b);
    free(c);
}

void quality_compare_held(struct run *run)
{
    for (size_t k = 0; k < run->nheld; k++) {
        struct hm_points *p = &run->held[k];
        struct comparison *c = new_comparison(run, &p->header);
        for (size_t i = 0; i < p->n; i += HM_BATCH) {
            c->rows = p->v + i * p->stride;
            c->n = p->n - i < HM_BATCH ? p->n - i : HM_BATCH;
            compare(run, c);
        }
        free(c);
        hm_points_free(p);
    }
    run->nheld = 0;
}
