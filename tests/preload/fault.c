/* fault: preloaded before a program (LD_PRELOAD), makes one of its calls fail.
 *
 *     FAULT_ALLOC=n   the n-th allocation, counted from 1, finds no memory
 *     FAULT_WRITE=n   the n-th write but to standard error, and all after it, finds the disk full
 *     FAULT_READ=n    the n-th read, and all after it, is an input/output error
 *     FAULT_COUNT=f   at its end the program writes to file f how many of each there were
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

/* glibc's own, behind those defined here */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *old, size_t size);

static atomic_long allocs, writes, reads;
static long fail_alloc, fail_write, fail_read;

static long number(const char *name)
{
    const char *text = getenv(name);
    return text ? atol(text) : 0;
}

__attribute__((constructor)) static void begin(void)
{
    fail_alloc = number("FAULT_ALLOC");
    fail_write = number("FAULT_WRITE");
    fail_read = number("FAULT_READ");
    allocs = writes = reads = 0;
}

__attribute__((destructor)) static void end(void)
{
    const char *name = getenv("FAULT_COUNT");
    if (!name)
        return;
    char text[100];
    int n = snprintf(text, sizeof text, "%ld %ld %ld\n", allocs, writes, reads);
    int fd = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    syscall(SYS_write, fd, text, n);
    close(fd);
}

static bool has_memory(void)
{
    if (++allocs != fail_alloc)
        return true;
    errno = ENOMEM;
    return false;
}

void *malloc(size_t size)
{
    return has_memory() ? __libc_malloc(size) : NULL;
}

void *calloc(size_t n, size_t size)
{
    return has_memory() ? __libc_calloc(n, size) : NULL;
}

void *realloc(void *old, size_t size)
{
    return has_memory() ? __libc_realloc(old, size) : NULL;
}

ssize_t write(int fd, const void *bytes, size_t n)
{
    if (fd == STDERR_FILENO || ++writes < fail_write || fail_write == 0)
        return syscall(SYS_write, fd, bytes, n);
    errno = ENOSPC;
    return -1;
}

ssize_t read(int fd, void *bytes, size_t n)
{
    if (++reads < fail_read || fail_read == 0)
        return syscall(SYS_read, fd, bytes, n);
    errno = EIO;
    return -1;
}
