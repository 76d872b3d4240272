/* Damaged streams of every form, by a fixed sequence of bit flips, cuts, copied and removed pieces:
 * the reader must refuse them with a reason, or take something that can be written and read again.
 */
#include "stream.h"

#include <dirent.h>

enum { ROUNDS = 150, LONGEST = 8192 };

/* splitmix64: the same damage on every machine */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Change bytes[0 .. n) somewhere; returns the new length. */
static size_t damage(char *bytes, size_t n, uint64_t *seed)
{
    static const char *const words[] = {"nan",  "-1",       "1e999", "#hm ",
                                        "#end", ">",        "\n",    "1e18",
                                        ",",    "\0\0\0\0", "  ",    "9223372036854775808"};
    uint64_t what = next(seed), from = n ? next(seed) % n : 0, to = n ? next(seed) % n : 0;
    size_t part = 1 + next(seed) % 32;
    const char *word = words[next(seed) % (sizeof words / sizeof *words)];
    switch (n == 0 ? 3 : what % 5) {
    case 0:
        bytes[from] ^= (char)(1 << next(seed) % 8);
        return n;
    case 1:
        return from;
    case 2:
        if (part > n - (from > to ? from : to))
            return n;
        memmove(bytes + to, bytes + from, part);
        return n;
    case 3:
        if (n + strlen(word) > LONGEST)
            return n;
        memmove(bytes + from + strlen(word), bytes + from, n - from);
        memcpy(bytes + from, word, strlen(word));
        return n + strlen(word);
    default:
        if (part > n - from)
            return n;
        memmove(bytes + from, bytes + from + part, n - from - part);
        return n - part;
    }
}

static void try_seed(const char *folder, const char *name)
{
    static char whole[LONGEST], bytes[LONGEST];
    char file[512];
    size_t n, bad = 0;
    uint64_t seed = 1;
    snprintf(file, sizeof file, "%s/%s", folder, name);
    const char *read = slurp(file, &n);
    if (n > LONGEST)
        n = LONGEST;
    memcpy(whole, read, n);
    bool whole_good = comes_back(whole, n);
    for (int i = 0; i < ROUNDS; i++) {
        size_t m = n;
        memcpy(bytes, whole, n);
        for (uint64_t k = next(&seed) % 4; k < 4; k++)
            m = damage(bytes, m, &seed);
        if (!comes_back(bytes, m) && bad++ == 0)
            printf("# round %d\n", i);
    }
    ok(n > 0 && whole_good && bad == 0, "%s, damaged in %d ways", name, ROUNDS);
}

int main(void)
{
    const char *folder = "tests/fuzz/corpus/fuzz_reader";
    struct dirent **list;
    int n = scandir(folder, &list, NULL, alphasort);
    begin_files();
    for (int i = 0; i < n; i++) {
        if (list[i]->d_name[0] != '.')
            try_seed(folder, list[i]->d_name);
        free(list[i]);
    }
    if (n < 0)
        skip("not started in the folder of the sources");
    else
        free(list);
    end_files();
    return done();
}
