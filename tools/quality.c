/* quality: mesh + measurements → report, verdict, exit code.
 *
 * The residual of a measurement is the height of the mesh there minus the measured height. The
 * measurements stream through when the mesh comes before them; memory does not grow with their
 * number then.
 */
#include "hm_batch.h"
#include "hm_cli.h"
#include "hm_locate.h"
#include "hm_num.h"
#include "hm_output.h"
#include "hm_quality.h"
#include "hm_thread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SAMPLES = 16, CHUNK = 1024 };

static struct {
    const char *samples, *thresholds, *criteria, *residuals;
    int seed;
    bool json;
} cmd = {.samples = "1,5,10,30", .thresholds = "0.10,0.30", .seed = 1};

static const struct hm_option options[] = {
    {'s', "sample", "LIST", HM_OPT_TEXT, &cmd.samples,
     .help = "samples in percent, besides all points (default 1,5,10,30)", .silent = true},
    {'S', "seed", "N", HM_OPT_NATURAL, &cmd.seed, .help = "seed of the samples (default 1)",
     .silent = true},
    {'t', "thresholds", "G,Y", HM_OPT_TEXT, &cmd.thresholds,
     .help = "largest green and yellow residual, m (default 0.10,0.30)"},
    {'c', "check", "CRITERIA", HM_OPT_TEXT, &cmd.criteria,
     .help = "exit 1 unless all are met: 'rmse<=0.15,red<=5%,minangle>=20,valid'", .silent = true},
    {'J', "json", NULL, HM_OPT_FLAG, &cmd.json, .help = "write the report as JSON", .silent = true},
    {'r', "residuals", "FILE", HM_OPT_TEXT, &cmd.residuals,
     .help = "write the points with residual and class there", .silent = true},
    {0}};

static const struct hm_program program = {
    .name = "quality",
    .purpose = "mesh + measurements → how well they fit, how good the elements are",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_POINTS | HM_MESH,
    .without = "K"};

/* All that the run holds. */
struct run {
    struct hm_cli *cli;
    struct hm_mesh mesh;
    struct hm_locate *locate; /* NULL until the mesh is there */
    struct hm_points *held;   /* measurements that came before it */
    size_t nheld, held_cap;
    struct hm_quality quality;
    struct hm_criterion *criteria;
    size_t ncriteria;
};

/* The residual stream. In reach of the exit handler, so that a failure anywhere leaves no file. */
static struct hm_writer *residuals;

static void abandon_residuals(void)
{
    hm_writer_abandon(residuals);
}

/* --- what the user asked for --- */

/* Numbers with commas between, each within 0 .. most; how many. */
static size_t parse_list(struct hm_cli *cli, const char *option, const char *text, double most,
                         double *list, size_t room)
{
    size_t n = hm_num_parse_list(text, ',', list, room);
    bool good = n > 0;
    for (size_t k = 0; good && k < n; k++)
        good = list[k] >= 0 && list[k] <= most;
    if (good)
        return n;
    hm_cli_die(cli, "--%s: '%s' is not a list of at most %zu numbers from 0 to %g", option, text,
               room, most);
}

static void prepare(struct run *run)
{
    double percent[MOST_SAMPLES], thresholds[2];
    struct hm_diag d = {0};
    size_t n = parse_list(run->cli, "sample", cmd.samples, 100, percent, MOST_SAMPLES);
    if (parse_list(run->cli, "thresholds", cmd.thresholds, 1e6, thresholds, 2) != 2 ||
        thresholds[0] > thresholds[1])
        hm_cli_die(run->cli, "--thresholds: '%s' is not two ascending numbers", cmd.thresholds);
    if (cmd.residuals && !strcmp(cmd.residuals, "-"))
        hm_cli_die(run->cli, "--residuals: needs a file, standard output has the report");
    if (cmd.residuals)
        hm_cli_check(run->cli, hm_output_check(cmd.residuals, &d), &d);
    if (cmd.criteria)
        hm_cli_check(run->cli, hm_criteria_parse(cmd.criteria, &run->criteria, &run->ncriteria, &d),
                     &d);
    hm_cli_check(run->cli, hm_quality_init(&run->quality, percent, n, cmd.seed, thresholds, &d),
                 &d);
}

/* --- measurements against the mesh --- */

static void begin_residuals(struct run *run)
{
    struct hm_diag d = {0};
    struct hm_header h;
    if (residuals)
        return;
    enum hm_err err = hm_header_init(&h, HM_POINTS, &d);
    hm_cli_make_header(run->cli, &h);
    if (!err)
        err = hm_header_set(&h, "units", "m m m", &d);
    if (!err)
        err = hm_header_add_field(&h, "residual", "m", &d);
    if (!err)
        err = hm_header_add_field(&h, "class", "1", &d);
    if (!err)
        err = hm_writer_open(&residuals, cmd.residuals, hm_cli_format(run->cli), &d);
    if (!err)
        err = hm_writer_begin(residuals, &h, &d);
    hm_header_free(&h);
    hm_cli_check(run->cli, err, &d);
}

/* Some measurements: where each lies and how high the mesh is there. */
struct comparison {
    const struct run *run;
    const double *rows;
    size_t n, stride;
    bool on_mesh[HM_BATCH];
    double height[HM_BATCH];
};

static void locate_chunk(void *arg, size_t chunk)
{
    struct comparison *c = arg;
    const struct hm_mesh *mesh = &c->run->mesh;
    size_t end = (chunk + 1) * CHUNK < c->n ? (chunk + 1) * CHUNK : c->n;
    for (size_t i = chunk * CHUNK; i < end; i++) {
        const double *p = c->rows + i * c->stride;
        int64_t e = hm_locate_element(c->run->locate, p[0], p[1]);
        c->on_mesh[i] = e >= 0;
        c->height[i] = e < 0 ? NAN : hm_elem_height(mesh, &mesh->elem[e], p[0], p[1]);
    }
}

static void count_point(struct hm_quality *q, const double *p, bool on_mesh, double residual)
{
    int64_t ordinal = q->points++;
    if (isnan(p[2]))
        q->heightless++;
    else if (!on_mesh)
        q->outside++;
    else if (!isfinite(residual))
        q->unknown++;
    else
        hm_quality_add(q, (struct hm_residual){p[0], p[1], residual}, ordinal);
}

static void compare(struct run *run, struct comparison *c)
{
    struct hm_diag d = {0};
    hm_thread_for(hm_cli_threads(run->cli), (c->n + CHUNK - 1) / CHUNK, locate_chunk, c);
    for (size_t i = 0; i < c->n; i++) {
        const double *p = c->rows + i * c->stride;
        double residual = c->height[i] - p[2];
        count_point(&run->quality, p, c->on_mesh[i], residual);
        if (cmd.residuals) {
            int class = hm_residual_classify(residual, run->quality.thresholds);
            double row[5] = {p[0], p[1], p[2], residual, class};
            hm_cli_check(run->cli, hm_writer_points(residuals, row, 1, &d), &d);
        }
    }
}

static struct comparison *new_comparison(struct run *run, size_t stride)
{
    struct comparison *c = hm_alloc(1, sizeof *c);
    if (!c)
        hm_cli_die(run->cli, "out of memory");
    c->run = run;
    c->stride = stride;
    if (cmd.residuals)
        begin_residuals(run);
    return c;
}

static void compare_held(struct run *run)
{
    for (size_t k = 0; k < run->nheld; k++) {
        struct hm_points *p = &run->held[k];
        struct comparison *c = new_comparison(run, p->stride);
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

/* --- input --- */

static void stream_points(struct run *run, struct hm_header *h)
{
    struct hm_diag d = {0};
    struct comparison *c = new_comparison(run, h->nfields);
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
    hm_header_free(h);
}

static void hold_points(struct run *run, struct hm_header *h)
{
    if (!hm_grow(&run->held, &run->held_cap, run->nheld + 1, sizeof *run->held))
        hm_cli_die(run->cli, "out of memory");
    struct hm_points *p = &run->held[run->nheld++];
    *p = (struct hm_points){0};
    hm_cli_read_points(run->cli, p, h);
}

static void take_mesh(struct run *run, struct hm_header *h)
{
    struct hm_diag d = {0};
    const char *name = hm_reader_name(hm_cli_reader(run->cli));
    if (run->locate)
        hm_cli_die(run->cli, "%s: a second mesh; quality judges one at a time", name);
    enum hm_err err = hm_mesh_read(&run->mesh, hm_cli_reader(run->cli), h, &d);
    if (!err && run->mesh.nelems == 0)
        hm_cli_die(run->cli, "%s: the mesh has no elements", name);
    if (!err)
        err = hm_locate_build(&run->locate, &run->mesh, &d);
    hm_cli_check(run->cli, err, &d);
    compare_held(run);
}

static void read_inputs(struct run *run)
{
    struct hm_header h;
    while (hm_cli_next(run->cli, &h)) {
        run->quality.surveyed |= h.kind == HM_POINTS;
        if (h.kind == HM_MESH)
            take_mesh(run, &h);
        else if (run->locate)
            stream_points(run, &h);
        else
            hold_points(run, &h);
    }
    if (!run->locate)
        hm_cli_die(run->cli, "no mesh among the inputs");
    const struct hm_quality *q = &run->quality;
    if (q->points == 0)
        hm_cli_die(run->cli, "no points among the inputs");
    if (q->nworst == 0)
        hm_cli_die(
            run->cli,
            "no measurement tells anything: of %lld, %lld lie outside the mesh, %lld have no "
            "height, %lld lie where the mesh has none",
            (long long)q->points, (long long)q->outside, (long long)q->heightless,
            (long long)q->unknown);
}

/* --- output --- */

static bool report(struct run *run)
{
    struct hm_diag d = {0};
    struct hm_quality *q = &run->quality;
    q->mesh = &run->mesh;
    hm_cli_stage(run->cli, "the elements");
    enum hm_err err = hm_meshstat_run(&run->mesh, &q->shape, &d);
    if (!err)
        err = hm_meshcheck_run(&run->mesh, &q->check, &d);
    hm_cli_check(run->cli, err, &d);
    if (residuals) {
        err = hm_writer_end(residuals, &d);
        if (!err)
            err = hm_writer_close(&residuals, &d);
        hm_cli_check(run->cli, err, &d);
    }
    bool good = hm_quality_judge(q, run->criteria, run->ncriteria);
    struct hm_writer *w = hm_cli_writer(run->cli);
    err = cmd.json ? hm_quality_json(q, run->criteria, run->ncriteria, w, &d)
                   : hm_quality_text(q, run->criteria, run->ncriteria, w, &d);
    hm_cli_check(run->cli, err, &d);
    return good;
}

int main(int argc, char **argv)
{
    struct run run = {.cli = hm_cli_start(&program, argc, argv)};
    atexit(abandon_residuals);
    prepare(&run);
    read_inputs(&run);
    bool good = report(&run);
    hm_locate_free(run.locate);
    hm_mesh_free(&run.mesh);
    hm_quality_free(&run.quality);
    free(run.held);
    free(run.criteria);
    int status = hm_cli_finish(run.cli);
    return status ? status : good ? 0 : 1;
}
