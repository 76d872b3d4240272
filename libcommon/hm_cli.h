/* hm_cli: the command line that all tools share. Layer 7, the top: may print and exit.
 *
 * A tool has one struct for what the user asked, one table of options, and main():
 *
 *     static struct { double spacing; int degree; … } cmd = { .spacing = 1, .degree = 2 };
 *     static const struct hm_option options[] = {
 *         {'d', "spacing", "M", HM_OPT_POSITIVE, &cmd.spacing, "distance of grid nodes (default
 * 1)"}, … {0}
 *     };
 *     static const struct hm_program program = {
 *         "bsgrid", "points → analysis grid on a B-spline surface", HM_POINTS, options, …};
 *
 *     int main(int argc, char **argv)
 *     {
 *         struct hm_cli *cli = hm_cli_start(&program, argc, argv);
 *         …
 *         return hm_cli_finish(cli);
 *     }
 *
 * The common options (-o -b -p -j -v -h --quiet --version --strict -K) are added to every table,
 * `--help` is made from it, and so is the history line: the options given that change the result,
 * in the order of the table, the common ones last.
 *
 * `tool: file:line: text` on standard error and exit 2 for every failure.
 */
#ifndef HM_CLI_H
#define HM_CLI_H

#include "hm_data.h"
#include "hm_inputs.h"

#define HM_VERSION "0.1"

enum hm_opt_type {
    HM_OPT_FLAG = 1, /* bool *; no argument */
    HM_OPT_NUMBER,   /* double *; any finite number */
    HM_OPT_POSITIVE, /* double *; > 0 */
    HM_OPT_NATURAL,  /* int *; 0, 1, 2 … */
    HM_OPT_TEXT,     /* const char ** */
    HM_OPT_CHOICE    /* int *; index of the argument in `choices` */
};

struct hm_option {
    char letter;          /* 0: long name only */
    const char *name;     /* long name, without dashes; NULL ends the table */
    const char *argument; /* placeholder in the help: "M", "FILE"; NULL for flags */
    enum hm_opt_type type;
    void *value;         /* where it goes; holds the default before */
    const char *help;    /* one line: what, unit, default */
    const char *choices; /* HM_OPT_CHOICE: "tin|mean" */
    bool silent;         /* does not change the result: stays out of the history */
    bool *given;         /* set to true when the user gave it; may be NULL */
};

struct hm_program {
    const char *name;     /* as in its man page */
    const char *purpose;  /* one line */
    const char *operands; /* for the synopsis: "[file …]" */
    const struct hm_option *options;
    int needs; /* hm_kind bits it takes from its operands; others are dropped aloud */
    const struct hm_foreign *foreign; /* formats that it reads besides (hm_import), or NULL */
    bool degrees_ok;                  /* longitude and latitude are not refused */
    bool converts;                    /* units: each object may have its own (hm_unit) */
    const char *without; /* letters of the common options that mean nothing to it: "bpK", NULL */
};

struct hm_cli;

/* Parse; on a mistake says so and exits 2; --help and --version exit 0. */
struct hm_cli *hm_cli_start(const struct hm_program *program, int argc, char **argv);

/* Close the output, say what was mended; the exit status: 0, or 1 with --strict and mends. */
int hm_cli_finish(struct hm_cli *cli);

int hm_cli_threads(const struct hm_cli *cli);             /* -j, default all cores */
bool hm_cli_verbose(const struct hm_cli *cli);            /* -v */
struct hm_format hm_cli_format(const struct hm_cli *cli); /* -b, -p */
/* What --single means to a tool that has it: grids as f32le. Before the first hm_cli_writer. */
void hm_cli_set_single(struct hm_cli *cli);
const char *hm_cli_output(const struct hm_cli *cli); /* -o, or "-" */
/* Another format than asked for by the common options; before the first hm_cli_writer. */
void hm_cli_set_format(struct hm_cli *cli, struct hm_format format);
const char *hm_cli_history(const struct hm_cli *cli);               /* "bsgrid 0.1 -d 5" */
size_t hm_cli_operands(const struct hm_cli *cli, char ***operands); /* at least one: "-" */

/* --- input --- */

/* The objects of all operands one after the other, of the kinds the program needs; others are
 * dropped with one line said. With -K every object is copied to the output before the first is
 * given. Checks CRS (equal, in metres). Exits on failure. The header is the caller's. False behind
 * the last. */
bool hm_cli_next(struct hm_cli *cli, struct hm_header *h);
struct hm_reader *hm_cli_reader(struct hm_cli *cli); /* of the object just given */

/* The points just given, all of them, with progress; h is taken over. */
void hm_cli_read_points(struct hm_cli *cli, struct hm_points *p, struct hm_header *h);

/* All objects at once. */
void hm_cli_read_all(struct hm_cli *cli, struct hm_inputs *in);

/* Bring keys and history of every input seen so far, and then this program's own line, into the
 * header of a product. */
void hm_cli_make_header(struct hm_cli *cli, struct hm_header *h);

/* --- output --- */
/* -o FILE or standard output, opened at the first call (binary to a terminal is refused). */
struct hm_writer *hm_cli_writer(struct hm_cli *cli);

/* A new empty file for what must be read twice: a descriptor, which is the caller's. It has no
 * name, so nothing of it is left however the program ends. */
int hm_cli_spool(struct hm_cli *cli);

/* --- messages --- */
/* If err is a failure: print d with the program's name and exit 2. */
void hm_cli_check(struct hm_cli *cli, enum hm_err err, const struct hm_diag *d);
void hm_cli_die(struct hm_cli *cli, const char *format, ...)
    __attribute__((format(printf, 2, 3), noreturn));
/* "1 edge", "3 edges", "0 vertices": hm_cli_counted(n, "edge").text as an argument of a message. */
struct hm_counted {
    char text[64];
};
struct hm_counted hm_cli_counted(int64_t n, const char *noun);
/* One line unless --quiet. */
void hm_cli_say(struct hm_cli *cli, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* As hm_cli_say, when n > 0; and --strict turns it into exit 1 at the end. */
void hm_cli_mended(struct hm_cli *cli, int64_t n, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* What a terrain left out or merged among its measurements (hm_terrain_counts). */
void hm_cli_mended_points(struct hm_cli *cli, int64_t without_z, int64_t duplicates);
/* Progress, on a terminal only, after two seconds; call as often as you like: "text: p %", */
void hm_cli_progress(struct hm_cli *cli, const char *text, double part);
/* that n more points were read, */
void hm_cli_progress_points(struct hm_cli *cli, size_t n);
/* and what begins now and cannot say how far it is. */
void hm_cli_stage(struct hm_cli *cli, const char *text);

#endif
