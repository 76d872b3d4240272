/* stream: what the tests of streams share. */
#ifndef STREAM_H
#define STREAM_H

#include "copy.h"
#include "tap.h"

/* Reading must fail just so. */
static void refused(const char *what, const char *bytes, size_t n, enum hm_err want, int64_t line,
                    const char *words)
{
    struct hm_diag d;
    spill(path, bytes, n);
    unlink(copy);
    enum hm_err err = convert(path, copy, text, false, &d);
    bool pass = err == want && d.line == line && strstr(d.text, words);
    if (!ok(pass, "%s: refused", what))
        printf("# got %d line %lld: %s\n", err, (long long)d.line, d.text);
    ok(access(copy, F_OK) != 0, "%s: nothing written", what);
}

__attribute__((unused)) static void refused_text(const char *what, const char *bytes,
                                                 enum hm_err want, int64_t line, const char *words)
{
    refused(what, bytes, strlen(bytes), want, line, words);
}

#endif
