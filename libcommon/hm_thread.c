#define _GNU_SOURCE /* sched_getaffinity */
#include "hm_thread.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { MOST_THREADS = 64 };

struct loop {
    void (*work)(void *arg, size_t chunk);
    void *arg;
    size_t chunks;
    atomic_size_t next;
};

static void *run(void *pointer)
{
    struct loop *loop = pointer;
    size_t chunk;
    while ((chunk = atomic_fetch_add(&loop->next, 1)) < loop->chunks)
        loop->work(loop->arg, chunk);
    return NULL;
}

int hm_thread_count(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set))
        return 1;
    int n = CPU_COUNT(&set);
    return n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : n;
}

void hm_thread_for(int threads, size_t chunks, void (*work)(void *arg, size_t chunk), void *arg)
{
    struct loop loop = {.work = work, .arg = arg, .chunks = chunks};
    pthread_t helper[MOST_THREADS];
    int started = 0;
    while (started + 1 < threads && started + 1 < MOST_THREADS && (size_t)started + 1 < chunks) {
        if (pthread_create(&helper[started], NULL, run, &loop))
            break;
        started++;
    }
    run(&loop);
    while (started > 0)
        pthread_join(helper[--started], NULL);
}
