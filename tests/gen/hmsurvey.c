/* hmsurvey: a generated survey with known truth, shaped like a lowland river junction: a meandering
 * river, a tributary that joins it round a raised hook of land, a levee, a drainage ditch.
 *
 *     hmsurvey [-S seed] [-w width] [-d density | -n points] [-s sigma] [-b blunders] DIR
 *     hmsurvey [-w width] --true <xy >xyz
 *
 * writes to DIR
 *
 *     survey.xyz        LiDAR and bathymetry, a bare table
 *     lines.txt         rough lines as a user clicks them in a GIS, with their roles
 *     true_lines.txt    toes and crests as they are
 *     true_surface.asc  the surface as it is, every metre (ESRI ASCII grid)
 *
 * Heights of the truth are a function of place alone (terrain.h); the seed decides where points
 * lie, their errors, and how the user clicks. Equal options give equal bytes on every machine.
 */
#include "hmsurvey/measure.h"
#include "hmsurvey/terrain.h"
#include "hmsurvey/trace.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static struct {
    uint64_t seed;
    double width;    /* metres; the domain is width × 2/3 width */
    double density;  /* LiDAR points a square metre */
    double points;   /* or their number, gaps not counted; 0: by density */
    double sigma;    /* metres */
    double blunders; /* their number; < 0: one in 12,800 points, 30 by default */
    bool truth;      /* only answer what the height is */
    const char *dir;
} cmd = {.seed = 1, .width = 480, .density = 2.5, .sigma = 0.05, .blunders = -1};

static void die(const char *what, const char *why)
{
    fprintf(stderr, "hmsurvey: %s: %s\n", what, why);
    exit(2);
}

static double number(const char *option, const char *text, double least, double most)
{
    char *end;
    double value = strtod(text ? text : "", &end);
    if (!text || end == text || *end || !(value >= least && value <= most))
        die(option, "needs a number in its range");
    return value;
}

static void parse(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (!strcmp(a, "--true"))
            cmd.truth = true;
        else if (a[0] != '-' && !cmd.dir)
            cmd.dir = a;
        else if (!strcmp(a, "-S"))
            cmd.seed = (uint64_t)number(a, argv[++i], 0, 1e15);
        else if (!strcmp(a, "-w"))
            cmd.width = number(a, argv[++i], 300, 30000);
        else if (!strcmp(a, "-d"))
            cmd.density = number(a, argv[++i], 1e-4, 1e4);
        else if (!strcmp(a, "-n"))
            cmd.points = number(a, argv[++i], 100, 1e9);
        else if (!strcmp(a, "-s"))
            cmd.sigma = number(a, argv[++i], 0, 10);
        else if (!strcmp(a, "-b"))
            cmd.blunders = number(a, argv[++i], 0, 1e6);
        else
            die(a, "unknown option");
    }
    if (!cmd.truth && !cmd.dir)
        die("DIR", "is missing");
    const double area = cmd.width * cmd.width * 2 / 3;
    if (cmd.points > 0)
        cmd.density = cmd.points / area;
    if (cmd.blunders < 0)
        cmd.blunders = floor(cmd.density * area / 12800 + 0.5);
}

static FILE *create(const char *name)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s", cmd.dir, name) >= (int)sizeof path)
        die(cmd.dir, "name too long");
    FILE *f = fopen(path, "w");
    if (!f)
        die(path, strerror(errno));
    return f;
}

static void finish(FILE *f, const char *name)
{
    if (fflush(f) || ferror(f) || fclose(f))
        die(name, "cannot be written");
}

static void answer(const struct terrain *t)
{
    double x, y;
    int got;
    while ((got = scanf("%lf %lf%*[^\n]", &x, &y)) == 2)
        printf("%.4f %.4f %.6f\n", x, y, terrain_z(t, x - TERRAIN_EAST, y - TERRAIN_NORTH));
    if (got != EOF)
        die("standard input", "expected x and y on every line");
    finish(stdout, "standard output");
}

static void write_points(const struct terrain *t)
{
    struct cloud cloud = {0};
    struct hm_diag d = {0};
    if (measure_lidar(&cloud, t, cmd.density, cmd.sigma, (size_t)cmd.blunders, cmd.seed, &d) ||
        measure_bathymetry(&cloud, t, cmd.sigma, cmd.seed, &d))
        die("points", d.text);
    FILE *f = create("survey.xyz");
    for (size_t i = 0; i < cloud.n; i++)
        fprintf(f, "%.2f %.2f %.3f\n", TERRAIN_EAST + cloud.p[i][0], TERRAIN_NORTH + cloud.p[i][1],
                cloud.p[i][2]);
    finish(f, "survey.xyz");
    free(cloud.p);
}

static void write_surface(const struct terrain *t)
{
    /* Nodes on whole metres, the corner of the first cell half a metre outside. */
    int nx = (int)t->w + 1, ny = (int)t->h + 1;
    FILE *f = create("true_surface.asc");
    fprintf(f, "ncols %d\nnrows %d\nxllcorner %.1f\nyllcorner %.1f\ncellsize 1\n", nx, ny,
            TERRAIN_EAST - 0.5, TERRAIN_NORTH - 0.5);
    for (int j = ny - 1; j >= 0; j--)
        for (int i = 0; i < nx; i++)
            fprintf(f, "%.4f%c", terrain_z(t, i, j), i + 1 < nx ? ' ' : '\n');
    finish(f, "true_surface.asc");
}

int main(int argc, char **argv)
{
    struct terrain terrain;
    parse(argc, argv);
    terrain_init(&terrain, cmd.width);
    if (cmd.truth) {
        answer(&terrain);
        return 0;
    }
    if (mkdir(cmd.dir, 0777) && errno != EEXIST)
        die(cmd.dir, strerror(errno));
    write_points(&terrain);
    write_surface(&terrain);
    FILE *f = create("lines.txt");
    trace_rough(f, &terrain, cmd.seed);
    finish(f, "lines.txt");
    f = create("true_lines.txt");
    trace_truth(f, &terrain);
    finish(f, "true_lines.txt");
    return 0;
}
