#define _GNU_SOURCE
#include "hm_cli_private.h"

#include "hm_num.h"
#include "hm_output.h"
#include "hm_thread.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* --- messages --- */

/* Take the progress from the terminal's line. */
static void clear_progress(struct hm_cli *cli)
{
    if (cli->spoken > 0)
        fputs("\033[K", stderr);
    cli->spoken = 0;
}

static void begin_message(struct hm_cli *cli)
{
    clear_progress(cli);
    fprintf(stderr, "%s: ", cli->program->name);
}

static void print(struct hm_cli *cli, const char *format, va_list args)
{
    begin_message(cli);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
}

_Noreturn static void leave(struct hm_cli *cli)
{
    hm_cli_free_streams(cli);
    exit(2);
}

void hm_cli_die(struct hm_cli *cli, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print(cli, format, args);
    va_end(args);
    leave(cli);
}

void hm_cli_check(struct hm_cli *cli, enum hm_err err, const struct hm_diag *d)
{
    if (err == HM_OK || err == HM_END)
        return;
    begin_message(cli);
    if (d->source[0])
        fprintf(stderr, "%s:", d->source);
    if (d->line > 0)
        fprintf(stderr, "%lld:", (long long)d->line);
    if (d->source[0] || d->line > 0)
        fputc(' ', stderr);
    fputs(d->text[0] ? d->text : "failed", stderr);
    if (d->has_place) {
        char x[HM_NUM_CHARS], y[HM_NUM_CHARS];
        x[hm_num_print(x, d->x)] = 0;
        y[hm_num_print(y, d->y)] = 0;
        fprintf(stderr, " at %s %s", x, y);
    }
    fputc('\n', stderr);
    leave(cli);
}

struct hm_counted hm_cli_counted(int64_t n, const char *noun)
{
    struct hm_counted c;
    size_t length = strlen(noun);
    bool vertex = length > 0 && noun[length - 1] == 'x';
    snprintf(c.text, sizeof c.text, "%lld %.*s%s", (long long)n,
             (int)(n != 1 && vertex ? length - 2 : length), noun,
             n == 1   ? ""
             : vertex ? "ices"
                      : "s");
    return c;
}

void hm_cli_say(struct hm_cli *cli, const char *format, ...)
{
    if (cli->quiet)
        return;
    va_list args;
    va_start(args, format);
    print(cli, format, args);
    va_end(args);
}

void hm_cli_mended(struct hm_cli *cli, int64_t n, const char *format, ...)
{
    if (n <= 0)
        return;
    cli->mends += n;
    if (cli->quiet)
        return;
    va_list args;
    va_start(args, format);
    print(cli, format, args);
    va_end(args);
}

void hm_cli_mended_points(struct hm_cli *cli, int64_t without_z, int64_t duplicates)
{
    hm_cli_mended(cli, without_z, "%s without a height left out",
                  hm_cli_counted(without_z, "point").text);
    hm_cli_mended(cli, duplicates, "%s at the place of another: their mean height counts",
                  hm_cli_counted(duplicates, "point").text);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Progress is for terminals, when it takes over two seconds; not more often than every `pause`. */
static bool may_speak(struct hm_cli *cli, double pause)
{
    if (cli->quiet || !isatty(STDERR_FILENO))
        return false;
    double now = seconds();
    if (now - cli->started < 2 || now - cli->spoken < pause)
        return false;
    cli->spoken = now;
    return true;
}

/* The cursor goes back, so that what comes next is written over it. */
__attribute__((format(printf, 2, 3))) static void speak(struct hm_cli *cli, const char *format, ...)
{
    va_list args;
    fprintf(stderr, "\r%s: ", cli->program->name);
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputs("\033[K\r", stderr);
}

static const double pause_seconds = 0.2;

void hm_cli_progress(struct hm_cli *cli, const char *text, double part)
{
    if (may_speak(cli, pause_seconds))
        speak(cli, "%s: %.0f %%", text, 100 * part);
}

void hm_cli_progress_points(struct hm_cli *cli, size_t n)
{
    cli->points += n;
    if (may_speak(cli, pause_seconds))
        speak(cli, "reading: %.1f million points", 1e-6 * (double)cli->points);
}

void hm_cli_stage(struct hm_cli *cli, const char *text)
{
    if (may_speak(cli, 0))
        speak(cli, "%s ...", text);
}

/* --- help --- */

/* Does a common option mean anything to the program? */
static bool applies(const struct hm_program *p, const struct hm_option *common)
{
    return !p->without || !common->letter || !strchr(p->without, common->letter);
}

static void print_option(const struct hm_option *o)
{
    char left[64];
    int n = o->letter ? snprintf(left, sizeof left, "-%c, --%s", o->letter, o->name)
                      : snprintf(left, sizeof left, "    --%s", o->name);
    const char *argument = o->type == HM_OPT_CHOICE ? o->choices : o->argument;
    if (argument && o->type != HM_OPT_FLAG && n > 0 && n < (int)sizeof left)
        n += snprintf(left + n, sizeof left - (size_t)n, " %s", argument);
    printf("  %-28s%s%s\n", left, n > 27 ? "\n                              " : "", o->help);
}

/* Help and version are all that was asked for. */
_Noreturn static void leave_told(const struct hm_program *p)
{
    if (fflush(stdout) || ferror(stdout)) {
        fprintf(stderr, "%s: standard output: cannot write: %s\n", p->name, strerror(errno));
        exit(2);
    }
    exit(0);
}

_Noreturn static void print_help(const struct hm_program *p, const struct hm_option *common)
{
    printf("usage: %s [options] %s\n%s\n", p->name, p->operands, p->purpose);
    if (p->options && p->options->name) {
        printf("\nOptions:\n");
        for (const struct hm_option *o = p->options; o->name; o++)
            print_option(o);
    }
    printf("\nCommon options:\n");
    for (const struct hm_option *o = common; o->name; o++)
        if (applies(p, o))
            print_option(o);
    printf("\nFiles may be of any kind, in any order; - is standard input, the default.\n"
           "Exit status: 0 done, 1 the answer is no, 2 error.  See %s(1), hybridmesh(5).\n",
           p->name);
    leave_told(p);
}

_Noreturn static void print_version(const struct hm_program *p)
{
    printf("%s (hybridmesh) %s\n", p->name, HM_VERSION);
    leave_told(p);
}

/* --- parsing --- */

_Noreturn __attribute__((format(printf, 2, 3))) static void misuse(const struct hm_program *p,
                                                                   const char *format, ...)
{
    va_list args;
    fprintf(stderr, "%s: ", p->name);
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fprintf(stderr, "; %s --help shows the options\n", p->name);
    exit(2);
}

static void set_number(const struct hm_program *p, const struct hm_option *o, const char *text)
{
    double v;
    const char *end = text + strlen(text);
    if (hm_num_parse(text, end, &v) != end || !isfinite(v))
        misuse(p, "--%s: '%s' is not a number", o->name, text);
    if (o->type == HM_OPT_POSITIVE && !(v > 0))
        misuse(p, "--%s: must be greater than 0, not %s", o->name, text);
    if (o->type == HM_OPT_NATURAL) {
        if (v < 0 || v > INT_MAX || v != floor(v))
            misuse(p, "--%s: must be a whole number from 0, not %s", o->name, text);
        *(int *)o->value = (int)v;
    } else {
        *(double *)o->value = v;
    }
}

static void set_choice(const struct hm_program *p, const struct hm_option *o, const char *text)
{
    size_t n = strlen(text);
    int index = 0;
    for (const char *c = o->choices; c; index++) {
        size_t length = strcspn(c, "|");
        if (length == n && !strncmp(c, text, n)) {
            *(int *)o->value = index;
            return;
        }
        c = c[length] ? c + length + 1 : NULL;
    }
    misuse(p, "--%s: must be one of %s, not '%s'", o->name, o->choices, text);
}

/* An option as the user gave it, kept for the history. */
struct given {
    const struct hm_option *option;
    const char *text; /* NULL for flags */
};

static void apply(const struct hm_program *p, const struct hm_option *o, const char *text)
{
    switch (o->type) {
    case HM_OPT_FLAG:
        *(bool *)o->value = true;
        break;
    case HM_OPT_TEXT:
        *(const char **)o->value = text;
        break;
    case HM_OPT_CHOICE:
        set_choice(p, o, text);
        break;
    case HM_OPT_NUMBER:
    case HM_OPT_POSITIVE:
    case HM_OPT_NATURAL:
        set_number(p, o, text);
        break;
    }
    if (o->given)
        *o->given = true;
}

static const struct hm_option *find_in(const struct hm_option *o, char letter, const char *name,
                                       size_t length)
{
    for (; o && o->name; o++)
        if (name ? strlen(o->name) == length && !strncmp(o->name, name, length)
                 : o->letter == letter)
            return o;
    return NULL;
}

struct parser {
    const struct hm_program *program;
    const struct hm_option *common;
    char **argv;
    int argc, at;
    struct given *given; /* argc of them at most */
    size_t ngiven;
};

/* The program's option, or the common one, of that name or letter. */
static const struct hm_option *find(const struct parser *s, char letter, const char *name,
                                    size_t length)
{
    const struct hm_option *o = find_in(s->program->options, letter, name, length);
    if (o)
        return o;
    o = find_in(s->common, letter, name, length);
    if (o && !applies(s->program, o))
        misuse(s->program, "--%s means nothing here", o->name);
    return o;
}

static void take(struct parser *s, const struct hm_option *o, const char *text)
{
    apply(s->program, o, text);
    for (size_t k = 0; k < s->ngiven; k++)
        if (s->given[k].option == o) { /* the last one counts */
            s->given[k].text = text;
            return;
        }
    s->given[s->ngiven++] = (struct given){o, text};
}

static const char *argument_of(struct parser *s, const struct hm_option *o, const char *attached)
{
    if (attached)
        return attached;
    if (s->at >= s->argc)
        misuse(s->program, "--%s needs an argument (%s)", o->name,
               o->argument ? o->argument : o->choices);
    return s->argv[s->at++];
}

static void parse_long(struct parser *s, const char *word)
{
    size_t length = strcspn(word, "=");
    const struct hm_option *o = find(s, 0, word, length);
    if (!o)
        misuse(s->program, "unknown option --%.*s", (int)length, word);
    const char *attached = word[length] ? word + length + 1 : NULL;
    if (o->type != HM_OPT_FLAG)
        take(s, o, argument_of(s, o, attached));
    else if (attached)
        misuse(s->program, "--%s takes no argument", o->name);
    else
        take(s, o, NULL);
}

static void parse_letters(struct parser *s, const char *word)
{
    while (*word) {
        const struct hm_option *o = find(s, *word, NULL, 0);
        if (!o)
            misuse(s->program, "unknown option -%c", *word);
        word++;
        if (o->type != HM_OPT_FLAG) {
            take(s, o, argument_of(s, o, *word ? word : NULL));
            return;
        }
        take(s, o, NULL);
    }
}

static void print_given(FILE *f, const struct given *g)
{
    if (g->option->letter)
        fprintf(f, " -%c", g->option->letter);
    else
        fprintf(f, " --%s", g->option->name);
    if (!g->text)
        return;
    bool quote = !*g->text || strpbrk(g->text, " \t\n");
    fputs(quote ? " \"" : " ", f);
    for (const char *c = g->text; *c; c++)
        fputc(*c == '\n' ? ' ' : *c, f);
    fputs(quote ? "\"" : "", f);
}

/* `name version -d 5 --method mean -p 2`: what was given and changes the result, the program's own
 * options and then the common ones, each in the order of its table. */
static char *make_history(const struct parser *s)
{
    const struct hm_option *const tables[] = {s->program->options, s->common};
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f)
        return NULL;
    fprintf(f, "%s %s", s->program->name, HM_VERSION);
    for (int t = 0; t < 2; t++)
        for (const struct hm_option *o = tables[t]; o && o->name; o++)
            for (size_t k = 0; k < s->ngiven && !o->silent; k++)
                if (s->given[k].option == o)
                    print_given(f, &s->given[k]);
    return fclose(f) ? NULL : text;
}

static void parse(struct parser *s, struct hm_cli *cli)
{
    static char standard_input[] = "-";
    bool options_over = false;
    while (s->at < s->argc) {
        char *word = s->argv[s->at++];
        if (options_over || word[0] != '-' || !word[1])
            cli->operands[cli->noperands++] = word;
        else if (!strcmp(word, "--"))
            options_over = true;
        else if (word[1] == '-')
            parse_long(s, word + 2);
        else
            parse_letters(s, word + 1);
    }
    if (!cli->noperands)
        cli->operands[cli->noperands++] = standard_input;
}

/* Rounding is part of the history, so what is only copied must not be rounded. */
static void check_precision(const struct parser *s, const struct hm_cli *cli)
{
    bool given = false;
    for (size_t k = 0; k < s->ngiven; k++)
        given |= s->given[k].option->value == &cli->decimals;
    if (!given)
        return;
    if (cli->decimals < 1 || cli->decimals > 17)
        misuse(s->program, "--precision: 1 to 17 decimals");
    if (cli->binary)
        misuse(s->program, "--precision is for text, --binary is exact");
    if (cli->keep)
        misuse(s->program, "--precision would round what --keep copies");
}

/* A computation of minutes must not end at a name that was wrong from the start. */
static void check_output(struct hm_cli *cli)
{
    struct hm_diag d = {0};
    if (!*cli->output)
        misuse(cli->program, "--output: needs a file name");
    hm_cli_check(cli, hm_output_check(cli->output, &d), &d);
}

struct hm_cli *hm_cli_start(const struct hm_program *program, int argc, char **argv)
{
    signal(SIGPIPE, SIG_DFL); /* a closed pipe ends a tool in silence */
    struct hm_cli *cli = hm_alloc0(1, sizeof *cli);
    struct given *given = hm_alloc((size_t)argc + 1, sizeof *given);
    char **operands = hm_alloc((size_t)argc + 1, sizeof *operands);
    if (!cli || !given || !operands)
        misuse(program, "out of memory");
    cli->program = program;
    cli->operands = operands;
    cli->output = "-";
    cli->started = seconds();
    bool help = false, version = false;
    const struct hm_option common[] = {
        {'o', "output", "FILE", HM_OPT_TEXT, &cli->output, "write there (default: standard output)",
         .silent = true},
        {'b', "binary", NULL, HM_OPT_FLAG, &cli->binary, "write a binary stream", .silent = true},
        {'p', "precision", "DIGITS", HM_OPT_NATURAL, &cli->decimals,
         "text: at most that many decimals (default: exact)", .silent = false},
        {'j', "threads", "N", HM_OPT_NATURAL, &cli->threads, "threads (default: all cores)",
         .silent = true},
        {'K', "keep", NULL, HM_OPT_FLAG, &cli->keep, "copy the inputs to the output first",
         .silent = true},
        {'v', "verbose", NULL, HM_OPT_FLAG, &cli->verbose, "say more", .silent = true},
        {0, "quiet", NULL, HM_OPT_FLAG, &cli->quiet, "say nothing but errors", .silent = true},
        {0, "strict", NULL, HM_OPT_FLAG, &cli->strict, "exit 1 when input had to be mended",
         .silent = true},
        {'h', "help", NULL, HM_OPT_FLAG, &help, "this help", .silent = true},
        {0, "version", NULL, HM_OPT_FLAG, &version, "the version", .silent = true},
        {0}};
    struct parser s = {program, common, argv, argc, 1, given, 0};
    parse(&s, cli);
    if (help)
        print_help(program, common);
    if (version)
        print_version(program);
    check_precision(&s, cli);
    check_output(cli);
    if (!cli->threads)
        cli->threads = hm_thread_count();
    cli->history = make_history(&s);
    free(given);
    if (!cli->history)
        misuse(program, "out of memory");
    return cli;
}

int hm_cli_finish(struct hm_cli *cli)
{
    if (cli->writer) {
        struct hm_diag d = {0};
        hm_cli_check(cli, hm_writer_close(&cli->writer, &d), &d);
    }
    clear_progress(cli);
    int status = cli->strict && cli->mends ? 1 : 0;
    hm_cli_free_streams(cli);
    free(cli->operands);
    free(cli->history);
    free(cli);
    return status;
}

/* --- what was asked --- */

int hm_cli_threads(const struct hm_cli *cli)
{
    return cli->threads;
}

bool hm_cli_verbose(const struct hm_cli *cli)
{
    return cli->verbose;
}

struct hm_format hm_cli_format(const struct hm_cli *cli)
{
    return (struct hm_format){
        .binary = cli->binary, .single = cli->single, .decimals = cli->decimals};
}

void hm_cli_set_format(struct hm_cli *cli, struct hm_format format)
{
    cli->binary = format.binary;
    cli->single = format.single;
    cli->decimals = format.decimals;
}

void hm_cli_set_single(struct hm_cli *cli)
{
    if (cli->decimals)
        misuse(cli->program, "--precision is for text, --single is binary");
    if (cli->keep)
        misuse(cli->program, "--single would round what --keep copies");
    cli->binary = cli->single = true;
}

const char *hm_cli_output(const struct hm_cli *cli)
{
    return cli->output;
}

const char *hm_cli_history(const struct hm_cli *cli)
{
    return cli->history;
}

size_t hm_cli_operands(const struct hm_cli *cli, char ***operands)
{
    *operands = cli->operands;
    return cli->noperands;
}
