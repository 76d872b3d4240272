/* hm_thread: loops spread over threads. Layer 0.
 *
 * Work is cut into `chunks` pieces that do not depend on the number of threads, so results that are
 * put together by chunk number are the same for any number.
 */
#ifndef HM_THREAD_H
#define HM_THREAD_H

#include <stdbool.h>
#include <stddef.h>

/* Cores that this process may use, at least 1. */
int hm_thread_count(void);

/* Call work(arg, c) once for every chunk c in 0 .. chunks-1, on up to `threads` threads, and return
 * when all are done. work must not fail; it leaves failures in what arg points to. When a thread
 * cannot be started the others do its share. */
void hm_thread_for(int threads, size_t chunks, void (*work)(void *arg, size_t chunk), void *arg);

/* Threads that stay for many loops: starting a thread, and moving it to a core that is idle, takes
 * as long as some milliseconds of work. One loop at a time; a loop within a loop needs a team of
 * its own. Without memory it is NULL, which works alone. */
struct hm_team;
struct hm_team *hm_team_new(int threads);
void hm_team_free(struct hm_team *t);

/* As hm_thread_for, on the team's threads. */
void hm_team_for(struct hm_team *t, size_t chunks, void (*work)(void *arg, size_t chunk),
                 void *arg);

/* Two workers one behind the other: make(arg, s) fills slot s and use(arg, s) empties it, for s =
 * 0, 1, … slots - 1, 0, 1, … until either returns false: then that slot holds nothing more to use,
 * or nothing more is wanted. With more than one thread make runs ahead, on a thread of its own, as
 * far as there are empty slots. */
void hm_thread_relay(int threads, size_t slots, bool (*make)(void *arg, size_t slot),
                     bool (*use)(void *arg, size_t slot), void *arg);

#endif
