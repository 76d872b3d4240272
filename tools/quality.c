/* quality: mesh + measurements + lines → report, verdict, exit code.
 *
 * The residual of a measurement is the height of the mesh there minus the measured height. The
 * measurements stream through when the mesh comes before them; memory does not grow with their
 * number then.
 */
#include "quality/quality.h"

#include "hm_import.h"
#include "hm_num.h"
#include "hm_output.h"
#include "hm_report.h"
#include "hm_unit.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_SAMPLES = 16 };

static struct {
    const char *samples, *thresholds, *criteria, *residuals, *compare, *courant;
    double survey_error, follow;
    int seed, by;
    bool json, waved;
} cmd = {.samples = "1,5,10,30", .thresholds = "0.10,0.30", .seed = 1, .follow = 0.5};

static const struct hm_option options[] = {
    {'s', "sample", "LIST", HM_OPT_TEXT, &cmd.samples,
     .help = "samples in percent, besides all points (default 1,5,10,30)", .silent = true},
    {'S', "seed", "N", HM_OPT_NATURAL, &cmd.seed, .help = "seed of the samples (default 1)",
     .silent = true},
    {'t', "thresholds", "G,Y", HM_OPT_TEXT, &cmd.thresholds,
     .help = "largest green and yellow residual, m (default 0.10,0.30)"},
    {0, "by", "WHAT", HM_OPT_CHOICE, &cmd.by,
     .help = "residuals of each class of points, material, or zone=NAME too",
     .choices = "none|class|region|zone", .silent = true},
    {0, "survey-error", "M", HM_OPT_NUMBER, &cmd.survey_error,
     .help = "RMSE of the measurements themselves, m (default 0: not known)", .silent = true},
    {0, "follow", "M", HM_OPT_POSITIVE, &cmd.follow,
     .help = "an edge this near follows a line, m (default 0.5)", .silent = true},
    {0, "courant", "H,V", HM_OPT_TEXT, &cmd.courant,
     .help = "time steps of Courant number 1 at depth H m and velocity V m/s", .silent = true,
     .given = &cmd.waved},
    {'c', "check", "CRITERIA", HM_OPT_TEXT, &cmd.criteria,
     .help = "exit 1 unless all are met: 'rmse<=0.15,red<=5%,minangle>=20,valid'", .silent = true},
    {0, "compare", "FILE", HM_OPT_TEXT, &cmd.compare,
     .help = "judge that mesh too, and say both side by side", .silent = true},
    {'J', "json", NULL, HM_OPT_FLAG, &cmd.json, .help = "write the report as JSON", .silent = true},
    {'r', "residuals", "FILE", HM_OPT_TEXT, &cmd.residuals,
     .help = "write the points with residual and class there", .silent = true},
    {0}};

static const struct hm_program program = {
    .name = "quality",
    .purpose = "mesh + measurements → how well they fit, how good the elements are",
    .operands = "[file ...]",
    .options = options,
    .needs = HM_POINTS | HM_LINES | HM_MESH,
    .foreign = hm_import_plain,
    .converts = true,
    .without = "K"};

/* In reach of the exit handler, so that a failure anywhere leaves no residual file. */
static struct run run;

static void abandon_residuals(void)
{
    hm_writer_abandon(run.writer);
}

/* --- what the user asked for --- */

/* Numbers with commas between, each within 0 .. most; how many. */
static size_t parse_list(const char *option, const char *text, double most, double *list,
                         size_t room)
{
    size_t n = hm_num_parse_list(text, ',', list, room);
    bool good = n > 0;
    for (size_t k = 0; good && k < n; k++)
        good = list[k] >= 0 && list[k] <= most;
    if (good)
        return n;
    hm_cli_die(run.cli, "--%s: '%s' is not a list of at most %zu numbers from 0 to %g", option,
               text, room, most);
}

static void prepare_mesh(struct hm_quality *q)
{
    double percent[MOST_SAMPLES], thresholds[2], water[2];
    struct hm_diag d = {0};
    size_t n = parse_list("sample", cmd.samples, 100, percent, MOST_SAMPLES);
    if (parse_list("thresholds", cmd.thresholds, 1e6, thresholds, 2) != 2 ||
        thresholds[0] > thresholds[1])
        hm_cli_die(run.cli, "--thresholds: '%s' is not two ascending numbers", cmd.thresholds);
    if (cmd.waved && (parse_list("courant", cmd.courant, 1e4, water, 2) != 2 || water[0] <= 0))
        hm_cli_die(run.cli, "--courant: '%s' is not a depth over 0 and a velocity", cmd.courant);
    *q = (struct hm_quality){.survey_error = cmd.survey_error,
                             .strata = run.strata,
                             .zones = &run.zones,
                             .waved = cmd.waved,
                             .depth = cmd.waved ? water[0] : 0,
                             .velocity = cmd.waved ? water[1] : 0};
    hm_cli_check(run.cli, hm_survey_init(&q->survey, percent, n, cmd.seed, thresholds, &d), &d);
}

/* --- meshes --- */

static void read_mesh(struct hm_quality *q, struct hm_reader *r, struct hm_header *h)
{
    double metres[2] = {1, 1};
    struct hm_diag d = {0};
    enum hm_err err = hm_mesh_read(&q->mesh, r, h, &d);
    if (!err && q->mesh.nelems == 0)
        hm_cli_die(run.cli, "%s: the mesh has no elements", hm_reader_name(r));
    if (!err)
        err = hm_unit_metres(&q->mesh.header, metres, &d);
    hm_cli_check(run.cli, err, &d);
    q->metres = metres[0];
    q->z_metres = metres[1];
    hm_cli_stage(run.cli, "the elements");
    hm_cli_check(run.cli, hm_quality_examine(q, &d), &d);
}

/* The mesh of --compare: the first of its file. */
static void read_other(struct hm_quality *q, const char *path)
{
    struct hm_reader *r;
    struct hm_header h;
    struct hm_diag d = {0};
    hm_cli_check(run.cli, hm_reader_open(&r, path, &d), &d);
    hm_reader_foreign(r, hm_import_plain);
    enum hm_err err;
    while (!(err = hm_reader_next(r, &h, &d)) && h.kind != HM_MESH)
        hm_header_free(&h);
    if (err == HM_END)
        hm_cli_die(run.cli, "--compare: no mesh in %s", path);
    hm_cli_check(run.cli, err, &d);
    read_mesh(q, r, &h);
    hm_reader_close(r);
}

static void check_crs(const struct hm_quality *a, const struct hm_quality *b)
{
    const char *ours = hm_header_get(&a->mesh.header, "crs");
    const char *theirs = hm_header_get(&b->mesh.header, "crs");
    if (ours && theirs && strcmp(ours, theirs))
        hm_cli_die(run.cli, "--compare: %s is in %s, the mesh in %s", cmd.compare, theirs, ours);
}

static void prepare(void)
{
    struct hm_diag d = {0};
    run.strata = (enum hm_strata)cmd.by;
    run.residuals = cmd.residuals;
    run.nmeshes = cmd.compare ? 2 : 1;
    if (cmd.survey_error < 0)
        hm_cli_die(run.cli, "--survey-error: %g is less than 0", cmd.survey_error);
    if (cmd.residuals && !strcmp(cmd.residuals, "-"))
        hm_cli_die(run.cli, "--residuals: needs a file, standard output has the report");
    if (cmd.residuals)
        hm_cli_check(run.cli, hm_output_check(cmd.residuals, &d), &d);
    for (size_t m = 0; m < run.nmeshes; m++)
        prepare_mesh(&run.mesh[m]);
}

/* --- input --- */

/* Can measurements be compared, or must they wait for mesh or zones? */
static bool is_ready(void)
{
    return run.has_mesh && (run.strata != HM_STRATA_ZONE || run.zones.ring.n > 0);
}

static void take_points(struct hm_header *h)
{
    if (is_ready()) {
        quality_stream_points(&run, h);
        hm_header_free(h);
        return;
    }
    if (!hm_grow(&run.held, &run.held_cap, run.nheld + 1, sizeof *run.held))
        hm_cli_die(run.cli, "out of memory");
    struct hm_points *p = &run.held[run.nheld++];
    *p = (struct hm_points){0};
    hm_cli_read_points(run.cli, p, h);
}

/* Zones among the lines, once it is known in which units. */
static void take_zones(const struct hm_lines *lines)
{
    struct hm_lines scaled;
    struct hm_diag d = {0};
    size_t before = run.zones.ring.n;
    if (run.strata != HM_STRATA_ZONE)
        return;
    quality_scale_lines(&run, lines, &run.mesh[0], &scaled);
    hm_cli_check(run.cli, hm_zones_take(&run.zones, &scaled, &d), &d);
    hm_lines_free(&scaled);
    if (run.compared && run.zones.ring.n > before)
        hm_cli_die(run.cli, "--by zone: all lines zone=NAME must come before the points");
}

static void take_lines(struct hm_header *h)
{
    struct hm_diag d = {0};
    if (!hm_grow(&run.lines, &run.lines_cap, run.nlines + 1, sizeof *run.lines))
        hm_cli_die(run.cli, "out of memory");
    struct hm_lines *lines = &run.lines[run.nlines++];
    *lines = (struct hm_lines){0};
    hm_cli_check(run.cli, hm_lines_read(lines, hm_cli_reader(run.cli), h, &d), &d);
    if (run.has_mesh)
        take_zones(lines);
}

static void take_mesh(struct hm_header *h)
{
    if (run.has_mesh)
        hm_cli_die(run.cli, "%s: a second mesh; quality judges one at a time (--compare)",
                   hm_reader_name(hm_cli_reader(run.cli)));
    read_mesh(&run.mesh[0], hm_cli_reader(run.cli), h);
    run.has_mesh = true;
    if (cmd.compare) {
        read_other(&run.mesh[1], cmd.compare);
        check_crs(&run.mesh[0], &run.mesh[1]);
    }
    for (size_t k = 0; k < run.nlines; k++)
        take_zones(&run.lines[k]);
}

static void check_measurements(const struct hm_survey *s)
{
    if (s->points == 0)
        hm_cli_die(run.cli, "no points among the inputs");
    if (s->nworst == 0)
        hm_cli_die(
            run.cli,
            "no measurement tells anything: of %lld, %lld lie outside the mesh, %lld have no "
            "height, %lld lie where the mesh has none",
            (long long)s->points, (long long)(s->off[0] + s->off[1]), (long long)s->heightless,
            (long long)s->unknown);
}

static void read_inputs(void)
{
    struct hm_header h;
    while (hm_cli_next(run.cli, &h)) {
        if (h.kind == HM_MESH)
            take_mesh(&h);
        else if (h.kind == HM_LINES)
            take_lines(&h);
        else
            take_points(&h);
        if (is_ready())
            quality_compare_held(&run);
    }
    if (!run.has_mesh)
        hm_cli_die(run.cli, "no mesh among the inputs");
    if (!is_ready())
        hm_cli_die(run.cli, "--by zone: no line zone=NAME among the inputs");
    check_measurements(&run.mesh[0].survey);
}

/* --- output --- */

static void follow_lines(struct hm_quality *q)
{
    const struct hm_fidelity_want want = {cmd.follow, q->metres, q->z_metres};
    struct hm_diag d = {0};
    struct hm_lines *scaled = hm_alloc0(run.nlines, sizeof *scaled);
    if (!scaled)
        hm_cli_die(run.cli, "out of memory");
    for (size_t k = 0; k < run.nlines; k++)
        quality_scale_lines(&run, &run.lines[k], q, &scaled[k]);
    hm_cli_check(run.cli,
                 hm_fidelity_run(&q->lines, &q->mesh, q->walk, scaled, run.nlines, &want, &d), &d);
    for (size_t k = 0; k < run.nlines; k++)
        hm_lines_free(&scaled[k]);
    free(scaled);
}

static bool report(struct hm_criterion *criteria, size_t n)
{
    struct hm_diag d = {0};
    bool good = hm_quality_judge(&run.mesh[0], criteria, n);
    const struct hm_report r = {&run.mesh[0], cmd.compare ? &run.mesh[1] : NULL, criteria, n};
    struct hm_writer *w = hm_cli_writer(run.cli);
    hm_cli_check(run.cli, cmd.json ? hm_report_json(&r, w, &d) : hm_report_text(&r, w, &d), &d);
    return good;
}

static void clear(void)
{
    for (size_t m = 0; m < run.nmeshes; m++)
        hm_quality_free(&run.mesh[m]);
    for (size_t k = 0; k < run.nlines; k++)
        hm_lines_free(&run.lines[k]);
    hm_zones_free(&run.zones);
    free(run.lines);
    free(run.held);
}

int main(int argc, char **argv)
{
    struct hm_criterion *criteria = NULL;
    size_t ncriteria = 0;
    struct hm_diag d = {0};
    run.cli = hm_cli_start(&program, argc, argv);
    atexit(abandon_residuals);
    if (cmd.criteria)
        hm_cli_check(run.cli, hm_criteria_parse(cmd.criteria, &criteria, &ncriteria, &d), &d);
    prepare();
    read_inputs();
    quality_end_residuals(&run);
    for (size_t m = 0; m < run.nmeshes; m++)
        follow_lines(&run.mesh[m]);
    bool good = report(criteria, ncriteria);
    clear();
    free(criteria);
    int status = hm_cli_finish(run.cli);
    return status ? status : good ? 0 : 1;
}
