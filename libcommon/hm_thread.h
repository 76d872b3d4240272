/* hm_thread: a loop spread over threads. Layer 0.
 *
 * Work is cut into `chunks` pieces that do not depend on the number of threads, so results that are
 * put together by chunk number are the same for any number.
 */
#ifndef HM_THREAD_H
#define HM_THREAD_H

#include <stddef.h>

/* Cores that this process may use, at least 1. */
int hm_thread_count(void);

/* Call work(arg, c) once for every chunk c in 0 .. chunks-1, on up to `threads` threads, and return
 * when all are done. work must not fail; it leaves failures in what arg points to. When a thread
 * cannot be started the others do its share. */
void hm_thread_for(int threads, size_t chunks, void (*work)(void *arg, size_t chunk), void *arg);

#endif
