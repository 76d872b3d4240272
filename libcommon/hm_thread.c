#define _GNU_SOURCE /* sched_getaffinity */
#include "hm_thread.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>

enum { MOST_THREADS = 64 };

struct loop {
    void (*work)(void *arg, size_t chunk);
    void *arg;
    size_t chunks;
    atomic_size_t next;
};

static void run(struct loop *loop)
{
    size_t chunk;
    while ((chunk = atomic_fetch_add(&loop->next, 1)) < loop->chunks)
        loop->work(loop->arg, chunk);
}

int hm_thread_count(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set))
        return 1;
    int n = CPU_COUNT(&set);
    return n < 1 ? 1 : n > MOST_THREADS ? MOST_THREADS : n;
}

/* Helpers sleep until a loop is there; only those that woke in time to join it are waited for. */
struct hm_team {
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t begun, left;
    struct loop *loop;   /* that helpers may join, or NULL */
    unsigned long round; /* its number */
    int inside;          /* helpers at work in it */
    bool over;           /* no loop will come any more */
    int helpers;
    pthread_t helper[MOST_THREADS];
};

static void *help(void *pointer)
{
    struct hm_team *t = pointer;
    unsigned long seen = 0;
    pthread_mutex_lock(&t->lock);
    while (!t->over) {
        struct loop *loop = t->loop;
        if (!loop || t->round == seen) {
            pthread_cond_wait(&t->begun, &t->lock);
            continue;
        }
        seen = t->round;
        t->inside++;
        pthread_mutex_unlock(&t->lock);
        run(loop);
        pthread_mutex_lock(&t->lock);
        if (--t->inside == 0)
            pthread_cond_signal(&t->left);
    }
    pthread_mutex_unlock(&t->lock);
    return NULL;
}

struct hm_team *hm_team_new(int threads)
{
    struct hm_team *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    pthread_mutex_init(&t->lock, NULL);
    pthread_cond_init(&t->begun, NULL);
    pthread_cond_init(&t->left, NULL);
    while (t->helpers + 1 < threads && t->helpers < MOST_THREADS &&
           !pthread_create(&t->helper[t->helpers], NULL, help, t))
        t->helpers++;
    return t;
}

static void open_loop(struct hm_team *t, struct loop *loop)
{
    pthread_mutex_lock(&t->lock);
    t->loop = loop;
    t->round++;
    pthread_cond_broadcast(&t->begun);
    pthread_mutex_unlock(&t->lock);
}

static void close_loop(struct hm_team *t)
{
    pthread_mutex_lock(&t->lock);
    t->loop = NULL;
    while (t->inside > 0)
        pthread_cond_wait(&t->left, &t->lock);
    pthread_mutex_unlock(&t->lock);
}

void hm_team_for(struct hm_team *t, size_t chunks, void (*work)(void *arg, size_t chunk), void *arg)
{
    struct loop loop = {.work = work, .arg = arg, .chunks = chunks};
    bool alone = !t || t->helpers == 0 || chunks < 2;
    if (!alone)
        open_loop(t, &loop);
    run(&loop);
    if (!alone)
        close_loop(t);
}

void hm_team_free(struct hm_team *t)
{
    if (!t)
        return;
    pthread_mutex_lock(&t->lock);
    t->over = true;
    pthread_cond_broadcast(&t->begun);
    pthread_mutex_unlock(&t->lock);
    while (t->helpers > 0)
        pthread_join(t->helper[--t->helpers], NULL);
    pthread_mutex_destroy(&t->lock);
    pthread_cond_destroy(&t->begun);
    pthread_cond_destroy(&t->left);
    free(t);
}

void hm_thread_for(int threads, size_t chunks, void (*work)(void *arg, size_t chunk), void *arg)
{
    struct hm_team *t = hm_team_new((size_t)threads < chunks ? threads : (int)chunks);
    hm_team_for(t, chunks, work, arg);
    hm_team_free(t);
}

/* --- two workers one behind the other --- */

struct relay {
    bool (*make)(void *arg, size_t slot);
    void *arg;
    size_t slots;
    pthread_mutex_t lock; /* of all below */
    pthread_cond_t made, used;
    size_t full;    /* slots made and not yet used */
    bool last_made; /* make has ended */
    bool unwanted;  /* use has ended */
};

static void *run_ahead(void *pointer)
{
    struct relay *r = pointer;
    size_t slot = 0;
    bool more = true;
    while (more) {
        pthread_mutex_lock(&r->lock);
        while (r->full == r->slots && !r->unwanted)
            pthread_cond_wait(&r->used, &r->lock);
        more = !r->unwanted;
        pthread_mutex_unlock(&r->lock);
        more = more && r->make(r->arg, slot);
        slot = (slot + 1) % r->slots;
        pthread_mutex_lock(&r->lock);
        r->full += more;
        r->last_made = !more;
        pthread_cond_signal(&r->made);
        pthread_mutex_unlock(&r->lock);
    }
    return NULL;
}

static bool wait_for_slot(struct relay *r)
{
    pthread_mutex_lock(&r->lock);
    while (r->full == 0 && !r->last_made)
        pthread_cond_wait(&r->made, &r->lock);
    bool there = r->full > 0;
    pthread_mutex_unlock(&r->lock);
    return there;
}

static void give_back(struct relay *r, bool wanted)
{
    pthread_mutex_lock(&r->lock);
    r->full--;
    r->unwanted = !wanted;
    pthread_cond_signal(&r->used);
    pthread_mutex_unlock(&r->lock);
}

void hm_thread_relay(int threads, size_t slots, bool (*make)(void *arg, size_t slot),
                     bool (*use)(void *arg, size_t slot), void *arg)
{
    struct relay r = {.make = make, .arg = arg, .slots = slots};
    pthread_t ahead;
    pthread_mutex_init(&r.lock, NULL);
    pthread_cond_init(&r.made, NULL);
    pthread_cond_init(&r.used, NULL);
    bool wanted = true;
    if (threads > 1 && !pthread_create(&ahead, NULL, run_ahead, &r)) {
        for (size_t slot = 0; wanted && wait_for_slot(&r); slot = (slot + 1) % slots) {
            wanted = use(arg, slot);
            give_back(&r, wanted);
        }
        pthread_join(ahead, NULL);
    } else {
        while (wanted && make(arg, 0))
            wanted = use(arg, 0);
    }
    pthread_mutex_destroy(&r.lock);
    pthread_cond_destroy(&r.made);
    pthread_cond_destroy(&r.used);
}
