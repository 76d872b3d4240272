/* Outputs: bytes that did not arrive are noticed, at the latest when a file is closed. */
#define _GNU_SOURCE
#include "hm_output.h"
#include "tap.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

static bool disk_is_full;

/* In place of the C library's: fails as a file system does that writes behind, and finds no room.
 */
int close(int fd)
{
    int status = (int)syscall(SYS_close, fd);
    if (!disk_is_full)
        return status;
    errno = EDQUOT;
    return -1;
}

static enum hm_err put_and_close(const char *path, struct hm_diag *d)
{
    struct hm_output out;
    enum hm_err err = hm_output_open(&out, path, d);
    if (!err)
        err = hm_output_write(&out, "# bytes\n", 8, d);
    disk_is_full = true;
    if (!err)
        err = hm_output_close(&out, d);
    disk_is_full = false;
    return err;
}

static void test_closing(void)
{
    struct hm_diag d = {0};
    fflush(stdout);
    ok(put_and_close("-", &d) == HM_EIO && strstr(d.text, strerror(EDQUOT)) &&
           !strcmp(d.source, "standard output"),
       "standard output that is not taken at its closing: %s", d.text);
    ok(fcntl(STDOUT_FILENO, F_GETFD) >= 0, "standard output stays open");
    d = (struct hm_diag){0};
    ok(put_and_close("out.hm", &d) == HM_EIO && access("out.hm", F_OK), "a file: %s", d.text);
}

static void test_names(void)
{
    struct hm_diag d = {0};
    struct hm_output out;
    ok(!hm_output_open(&out, "new.hm", &d) && access("new.hm", F_OK), "no name before the end");
    hm_output_write(&out, "whole\n", 6, &d);
    ok(!hm_output_close(&out, &d) && !access("new.hm", F_OK), "a name then");
    ok(!hm_output_open(&out, "new.hm", &d) && !hm_output_write(&out, "other\n", 6, &d),
       "written again");
    hm_output_abandon(&out);
    char text[16] = "";
    int fd = open("new.hm", O_RDONLY);
    ok(read(fd, text, sizeof text - 1) == 6 && !strcmp(text, "whole\n"), "and given up: as it was");
    close(fd);
    ok(!unlink("new.hm"), "removed");
}

int main(void)
{
    char folder[] = "/tmp/hm-output-XXXXXX";
    if (!mkdtemp(folder) || chdir(folder))
        return 2;
    test_closing();
    test_names();
    ok(!rmdir(folder), "nothing is left behind");
    return done();
}
