/* Loops spread over threads: every chunk once, whatever the number of threads; two workers one
 * behind the other hand over in order and end as either wants. */
#include "hm_thread.h"
#include "tap.h"

#include <stdatomic.h>
#include <string.h>

enum { CHUNKS = 1000 };

static void count_chunk(void *arg, size_t chunk)
{
    atomic_int *count = arg;
    atomic_fetch_add(&count[chunk], 1);
}

static bool all_are(const atomic_int *count, int n)
{
    for (size_t k = 0; k < CHUNKS; k++)
        if (count[k] != n)
            return false;
    return true;
}

static void test_team(int threads)
{
    enum { LOOPS = 300 };
    static atomic_int count[CHUNKS];
    memset(count, 0, sizeof count);
    struct hm_team *team = threads > 0 ? hm_team_new(threads) : NULL;
    for (int k = 0; k < LOOPS; k++)
        hm_team_for(team, CHUNKS, count_chunk, count);
    ok(all_are(count, LOOPS), "every chunk once a loop, a team of %d", threads);
    hm_team_for(team, 0, count_chunk, count);
    hm_team_for(team, 1, count_chunk, count);
    ok(count[0] == LOOPS + 1 && count[1] == LOOPS, "loops of no chunk and of one");
    hm_team_free(team);
    memset(count, 0, sizeof count);
    hm_thread_for(threads, CHUNKS, count_chunk, count);
    ok(all_are(count, 1), "every chunk once, %d threads", threads);
}

/* Slots are filled with 1, 2, 3, …; `made` ends the making, `used` the use. */
enum { SLOTS = 3 };
struct line {
    int slot[SLOTS], made, used, last_made, last_used;
    bool in_order;
};

static bool make(void *arg, size_t slot)
{
    struct line *l = arg;
    if (l->made == l->last_made)
        return false;
    l->slot[slot] = ++l->made;
    return true;
}

static bool use(void *arg, size_t slot)
{
    struct line *l = arg;
    l->in_order = l->in_order && l->slot[slot] == l->used + 1;
    l->slot[slot] = 0;
    return ++l->used < l->last_used;
}

static void test_relay(int threads, int last_made, int last_used)
{
    struct line l = {.last_made = last_made, .last_used = last_used, .in_order = true};
    hm_thread_relay(threads, SLOTS, make, use, &l);
    int want = last_made < last_used ? last_made : last_used;
    ok(l.in_order && l.used == want && l.made <= want + SLOTS,
       "%d threads: %d made, %d wanted, in order", threads, last_made, last_used);
}

int main(void)
{
    for (int threads = 0; threads < 8; threads++)
        test_team(threads);
    for (int threads = 1; threads < 4; threads++) {
        test_relay(threads, 10000, 20000);
        test_relay(threads, 10000, 777);
        test_relay(threads, 0, 10);
        test_relay(threads, 1, 1);
        test_relay(threads, 5, 1);
    }
    return done();
}
