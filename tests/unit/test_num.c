/* Numbers against the C library as oracle (correctly rounded in glibc), and the table of powers
 * against long arithmetic. HM_LONG=1 in the environment: ten times as many random numbers. */
#include "hm_num.h"
#include "hm_num_table.h"
#include "tap.h"

#include <stdlib.h>
#include <string.h>

static uint64_t state = 20240601;

static uint64_t next_random(void) /* splitmix64 */
{
    uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

static uint64_t bits(double v)
{
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    return b;
}

static double of_bits(uint64_t b)
{
    double v;
    memcpy(&v, &b, sizeof v);
    return v;
}

/* A finite double, by turns: any bits, a power of two, a denormal, a coordinate. */
static double any_double(int i)
{
    for (;;) {
        uint64_t r = next_random();
        double v = of_bits(r);
        if (i % 8 == 1)
            v = of_bits(r & 0xfff0000000000000);
        else if (i % 8 == 2)
            v = of_bits(r & 0x800fffffffffffff);
        else if (i % 8 == 3)
            v = (double)(int64_t)(r % 1000000000000) / 1000 - 500000000;
        else if (i % 8 == 4)
            v = (double)(int64_t)r;
        if (isfinite(v))
            return v;
    }
}

/* --- the table --- */

enum { WORDS = 80 };

/* b *= 5; true when the top word overflows (it never does here). */
static void times5(uint32_t b[WORDS])
{
    uint64_t carry = 0;
    for (int i = 0; i < WORDS; i++) {
        carry += (uint64_t)b[i] * 5;
        b[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

static void over5(uint32_t b[WORDS])
{
    uint64_t rest = 0;
    for (int i = WORDS; i-- > 0;) {
        rest = rest << 32 | b[i];
        b[i] = (uint32_t)(rest / 5);
        rest %= 5;
    }
}

/* The leading 128 bits of b. */
static void leading(const uint32_t b[WORDS], uint64_t top[2])
{
    int bit = WORDS * 32 - 1;
    while (!(b[bit / 32] >> (bit % 32) & 1))
        bit--;
    top[0] = top[1] = 0;
    for (int i = 0; i < 128; i++, bit--)
        top[i / 64] = top[i / 64] << 1 | (bit >= 0 ? b[bit / 32] >> (bit % 32) & 1 : 0);
}

/* 10^q has the leading bits of 5^q. Downward from 2^2528: 5^-342 takes 795 bits off, and cutting
 * off at every division is cutting off once, since floor(floor(a/5)/5) = floor(a/25). */
static void table(void)
{
    static uint32_t up[WORDS], down[WORDS];
    uint64_t top[2];
    int wrong = 0, all_ones = 0;
    up[0] = 1;
    for (int q = 0; q <= HM_NUM_POW10_MAX; q++, times5(up)) {
        leading(up, top);
        wrong += memcmp(top, hm_num_pow10[q - HM_NUM_POW10_MIN], sizeof top) != 0;
    }
    down[WORDS - 1] = 1;
    for (int q = 0; q >= HM_NUM_POW10_MIN; q--, over5(down)) {
        leading(down, top);
        wrong += memcmp(top, hm_num_pow10[q - HM_NUM_POW10_MIN], sizeof top) != 0;
    }
    for (int q = HM_NUM_POW10_MIN; q <= HM_NUM_POW10_MAX; q++)
        all_ones += hm_num_pow10[q - HM_NUM_POW10_MIN][1] == UINT64_MAX;
    ok(wrong == 0, "all powers of ten are those of long arithmetic");
    ok(all_ones == 0, "each can be rounded up in its low word");
}

/* --- reading --- */

/* Does it read text as strtod does, bit for bit, and all of it? */
static bool reads(const char *text)
{
    double v = -77, want = strtod(text, NULL);
    const char *end = text + strlen(text);
    bool good =
        hm_num_parse(text, end, &v) == end && (bits(v) == bits(want) || (isnan(v) && isnan(want)));
    if (!good)
        printf("# %.60s: got %.17g, want %.17g\n", text, v, want);
    return good;
}

/* Does it stop where it should (n = -1: no number at all)? */
static bool stops(const char *text, int n)
{
    double v = -77;
    const char *end = hm_num_parse(text, text + strlen(text), &v);
    return n < 0 ? end == NULL && v == -77 : end == text + n;
}

static void reading(void)
{
    static const char *const texts[] = {"0",
                                        "-0",
                                        "+1",
                                        "484649.36",
                                        "5972000.125",
                                        ".5",
                                        "5.",
                                        "1e5",
                                        "1E+05",
                                        "-1.5e-3",
                                        "00000000000000000000000000001.5",
                                        "0.00000000000000000000000000000000015",
                                        "9007199254740993",
                                        "9007199254740992.5",
                                        "9007199254740993.0000000000000000000001",
                                        "18446744073709551615",
                                        "18446744073709551616",
                                        "123456789012345678901234567890",
                                        "1.7976931348623157e308",
                                        "1.7976931348623158e308",
                                        "1.7976931348623159e308",
                                        "1e309",
                                        "1e-400",
                                        "1e400",
                                        "-1e400",
                                        "1e99999999999999999999",
                                        "1e-99999999999999999999",
                                        "0e99999999999999999999",
                                        "4.9406564584124654e-324",
                                        "2.4703282292062327e-324",
                                        "2.4703282292062328e-324",
                                        "2.2250738585072011e-308",
                                        "2.2250738585072014e-308",
                                        "8.5e-323",
                                        "inf",
                                        "-INF",
                                        "Infinity",
                                        "nan",
                                        "NaN",
                                        "1e22",
                                        "1e23",
                                        "-1e23",
                                        "8.5e22",
                                        "6250000000000000000000000000000000e-34",
                                        "179769313486231580793e289"};
    int wrong = 0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        wrong += !reads(texts[i]);
    ok(wrong == 0, "chosen texts read as by strtod");

    ok(stops("12abc", 2) && stops("1e", 1) && stops("1e+", 1) && stops("1.5.2", 3) &&
           stops("1,2", 1) && stops("-.5-", 3) && stops("0x10", 1) && stops("infinite", 3) &&
           stops("1 2", 1),
       "stops behind the number");
    ok(stops("", -1) && stops("-", -1) && stops(".", -1) && stops("e5", -1) && stops(" 1", -1) &&
           stops("+-1", -1) && stops("-.e1", -1) && stops("na", -1),
       "no number: NULL, and the value untouched");
    double v = 0;
    const char *text = "12345";
    ok(hm_num_parse(text, text + 3, &v) == text + 3 && v == 123, "never reads beyond end");
}

static void reading_random(int n)
{
    char text[64];
    int wrong = 0;
    for (int i = 0; i < n; i++) {
        snprintf(text, sizeof text, "%.*e", (int)(next_random() % 22), any_double(i));
        wrong += !reads(text);
        snprintf(text, sizeof text, "%llu%llue%d", (unsigned long long)next_random(),
                 (unsigned long long)(next_random() % 1000), (int)(next_random() % 700) - 360);
        wrong += !reads(text);
        snprintf(text, sizeof text, "%.*f", (int)(next_random() % 5), any_double(8 * i + 3));
        wrong += !reads(text);
    }
    ok(wrong == 0, "%d random texts read as by strtod", 3 * n);
}

/* Exactly halfway between two doubles, and a last digit below and above. %.*e prints all digits of
 * a long double that holds the halfway point. */
static void halfway(int n)
{
    char text[1400];
    int wrong = 0;
    for (int i = 0; i < n; i++) {
        double a = fabs(any_double(8 * i + (i & 1 ? 2 : 0))), b = of_bits(bits(a) + 1);
        if (!isfinite(b))
            continue;
        long double half = ((long double)a + (long double)b) / 2;
        int length = snprintf(text, sizeof text, "%.1150Le", half);
        wrong += !reads(text);
        char *e = strchr(text, 'e');
        e[-1] = '1'; /* a hair above, behind more than 1,000 digits */
        wrong += !reads(text);
        char *p = e - 1;
        *p = '0';
        while (*p == '0' || *p == '.')
            p--;
        --*p; /* below */
        wrong += !reads(text) || length < 1150;
        text[20] = text[21] = '9';
        wrong += !reads(text);
    }
    ok(wrong == 0, "halfway points and their neighbours, with over 1,000 digits");
}

/* --- writing --- */

static bool prints(double v, const char *want)
{
    char text[HM_NUM_CHARS];
    size_t n = hm_num_print(text, v);
    bool good = n == strlen(want) && memcmp(text, want, n) == 0;
    if (!good)
        printf("# got %.*s, want %s\n", (int)n, text, want);
    return good;
}

static bool prints_fixed(double v, int decimals, const char *want)
{
    char text[HM_NUM_CHARS];
    size_t n = hm_num_print_fixed(text, v, decimals);
    bool good = n == strlen(want) && memcmp(text, want, n) == 0;
    if (!good)
        printf("# got %.*s, want %s\n", (int)n, text, want);
    return good;
}

static void writing(void)
{
    ok(prints(0, "0") && prints(-0.0, "-0") && prints(12.5, "12.5") && prints(-0.001, "-0.001") &&
           prints(1e300, "1e+300") && prints(NAN, "nan") && prints(-NAN, "nan") &&
           prints(INFINITY, "inf") && prints(-INFINITY, "-inf"),
       "as the header says");
    ok(prints(1e-5, "0.00001") && prints(9.9e-6, "9.9e-6") && prints(1e15, "1000000000000000") &&
           prints(9999999999999998, "9999999999999998") && prints(1e16, "1e+16") &&
           prints(12345678901234568, "1.2345678901234568e+16"),
       "plain notation and its limits");
    ok(prints(5e-324, "5e-324") && prints(1.7976931348623157e308, "1.7976931348623157e+308") &&
           prints(2.2250738585072014e-308, "2.2250738585072014e-308") &&
           prints(9007199254740992, "9007199254740992") && prints(0.1, "0.1") &&
           prints(0.1 + 0.2, "0.30000000000000004") && prints(2e-44, "2e-44") &&
           prints(1e23, "1e+23") && prints(9.5367431640625e-7, "9.5367431640625e-7"),
       "ends of the range, and familiar ones");
    ok(prints_fixed(2.5, 0, "2") && prints_fixed(3.5, 0, "4") && prints_fixed(0.125, 2, "0.12") &&
           prints_fixed(2.675, 2, "2.67") && prints_fixed(1.0005, 3, "1") &&
           prints_fixed(484649.357, 2, "484649.36") && prints_fixed(-1e-9, 3, "0") &&
           prints_fixed(999.9996, 3, "1000") && prints_fixed(0.1, 17, "0.1") &&
           prints_fixed(1e-300, 17, "0") && prints_fixed(1e22, 2, "1e+22") &&
           prints_fixed(NAN, 2, "nan") && prints_fixed(1e-7, 9, "1e-7"),
       "rounded to decimals");
}

/* The shortest by trial. At powers of two the interval reaches less far down than up, so that a
 * number of fewer digits than any %.*e finds may lie in it. */
static bool is_shortest(double v, const char *text)
{
    char trial[HM_NUM_CHARS], mine[HM_NUM_CHARS];
    int digits = 0, mark = 0;
    for (const char *p = text; *p && *p != 'e'; p++)
        if (*p >= '1' && *p <= '9')
            mark = ++digits;
        else if (*p == '0' && digits)
            digits++;
    digits = mark;
    if (v == 0)
        return true;
    int n = 0;
    do
        snprintf(trial, sizeof trial, "%.*e", n, v);
    while (strtod(trial, NULL) != v && ++n < 17);
    if (digits != n + 1)
        return digits < n + 1 && (bits(v) & 0xfffffffffffff) == 0;
    snprintf(mine, sizeof mine, "%.*e", n, v);
    char same[2 * HM_NUM_CHARS];
    snprintf(same, sizeof same, "%.*Le", n, strtold(text, NULL));
    return strcmp(mine, same) == 0;
}

static void writing_random(int n)
{
    char text[HM_NUM_CHARS + 1], fixed[400];
    int back = 0, longer = 0, rounded = 0;
    for (int i = 0; i < n; i++) {
        double v = any_double(i);
        size_t length = hm_num_print(text, v);
        text[length] = 0;
        back += bits(strtod(text, NULL)) != bits(v) || length >= HM_NUM_CHARS || !reads(text);
        if (!is_shortest(v, text) && longer++ < 5)
            printf("# %.17g: %s is not the shortest\n", v, text);
        int decimals = i % 7;
        double coordinate = any_double(8 * i + 3) + (double)(i % 1000) / 7e5;
        snprintf(fixed, sizeof fixed, "%.*f", decimals, coordinate);
        length = hm_num_print_fixed(text, coordinate, decimals);
        text[length] = 0;
        rounded += strtod(text, NULL) != strtod(fixed, NULL) || length > strlen(fixed);
    }
    ok(back == 0, "%d random doubles: written, read, the same bits", n);
    ok(longer == 0, "each the shortest, and the nearest of those");
    ok(rounded == 0, "rounded to decimals as by printf");
}

static void lists(void)
{
    double v[3] = {0};
    ok(hm_num_parse_list("1,-2.5,3e2", ',', v, 3) == 3 && v[0] == 1 && v[1] == -2.5 && v[2] == 300,
       "a list of numbers");
    ok(hm_num_parse_list("7", '/', v, 3) == 1 && v[0] == 7, "a list of one");
    static const char *const bad[] = {"",    ",",     "1,",    ",1",   "1,,2",   "1/2",
                                      "1,x", "1,nan", "1,inf", "1 ,2", "1,2,3,4"};
    int taken = 0;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        taken += hm_num_parse_list(bad[k], ',', v, 3) != 0;
    ok(taken == 0, "what is no list of at most three numbers");
}

int main(void)
{
    int n = getenv("HM_LONG") ? 1000000 : 100000;
    table();
    reading();
    reading_random(n);
    halfway(n / 100);
    lists();
    writing();
    writing_random(n);
    return done();
}
