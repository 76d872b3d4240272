/* hm_cli_private: what the two halves of hm_cli share (options in hm_cli.c, streams in
 * hm_cli_io.c). Layer 7. */
#ifndef HM_CLI_PRIVATE_H
#define HM_CLI_PRIVATE_H

#include "hm_cli.h"

struct hm_cli {
    const struct hm_program *program;
    char *history;
    char **operands; /* owned; the strings are argv's */
    size_t noperands;

    const char *output;
    bool binary, single, quiet, verbose, strict, keep;
    int decimals, threads;

    size_t opened; /* operands opened so far */
    struct hm_reader *reader;
    int dropped;           /* kinds of this operand that were said to be dropped */
    struct hm_header seen; /* keys and history of all inputs so far */
    struct hm_writer *writer;

    bool units_said; /* that they are not metres */

    int64_t mends;
    double started, spoken; /* seconds; spoken 0: no progress stands on the terminal */
    size_t points;          /* read so far, for the progress */
};

void hm_cli_free_streams(struct hm_cli *cli);

#endif
