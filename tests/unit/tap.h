/* tap: the few lines that a unit test needs. Each test program is one C file that includes this
 * once, calls ok() for every claim and ends with `return done();`. Output is TAP. */
#ifndef TAP_H
#define TAP_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

static int tap_count, tap_failed;

__attribute__((format(printf, 2, 3), unused)) static bool ok(bool pass, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    printf("%s %d - ", pass ? "ok" : "not ok", ++tap_count);
    vprintf(format, args);
    printf("\n");
    va_end(args);
    tap_failed += !pass;
    return pass;
}

/* |got - want| <= tolerance; says both when it fails. */
__attribute__((unused)) static bool near(double got, double want, double tolerance,
                                         const char *what)
{
    bool pass = fabs(got - want) <= tolerance;
    ok(pass, "%s", what);
    if (!pass)
        printf("# got %.17g, want %.17g +- %g\n", got, want, tolerance);
    return pass;
}

__attribute__((unused)) static void skip(const char *why)
{
    printf("ok %d # SKIP %s\n", ++tap_count, why);
}

static int done(void)
{
    printf("1..%d\n", tap_count);
    return tap_failed > 0;
}

#endif
