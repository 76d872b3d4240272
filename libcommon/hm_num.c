#include "hm_num.h"

#include "hm_num_table.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

__extension__ typedef unsigned __int128 wide;

enum {
    MANTISSA = 52,       /* stored bits of the mantissa */
    BIAS = 1075,         /* a double is mantissa * 2^(stored exponent - BIAS) */
    FITTING_DIGITS = 19, /* that any 64-bit word holds */
    MOST_DIGITS = 800    /* a halfway point between doubles has at most 767 */
};
static const uint64_t HIDDEN = (uint64_t)1 << MANTISSA;

static double double_of_bits(uint64_t bits)
{
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static uint64_t bits_of_double(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

/* floor(log2(10^q)), exact for |q| <= 350. */
static int floor_log2_pow10(int q)
{
    return (q * 217706) >> 16;
}

/* --- reading --- */

/* The decimal as it stands in the text. */
struct decimal {
    uint64_t w;              /* its first digits, up to FITTING_DIGITS of them, as an integer */
    int64_t exponent;        /* its value is w * 10^exponent, or a little more when … */
    bool cut;                /* … digits follow that are not all 0 */
    const char *first, *end; /* all digits, with perhaps a point among them */
    int64_t last;            /* power of ten of the last digit */
};

/* Eight characters as a word, the first one lowest. */
static uint64_t load_eight(const char *s)
{
    uint64_t word;
    memcpy(&word, s, sizeof word);
    return __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? __builtin_bswap64(word) : word;
}

static bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* Natural numbers for the slow path. 801 digits, or 5^1143 times a mantissa, stay under 2,750 bits.
 */
enum { BIG_WORDS = 96 };
struct big {
    uint32_t word[BIG_WORDS]; /* lowest first */
    int n;
};

static void big_multiply_add(struct big *b, uint32_t factor, uint32_t add)
{
    uint64_t carry = add;
    for (int i = 0; i < b->n; i++) {
        carry += (uint64_t)b->word[i] * factor;
        b->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry)
        b->word[b->n++] = (uint32_t)carry;
}

static void big_multiply_pow5(struct big *b, int64_t power)
{
    static const uint32_t pow5_13 = 1220703125;
    for (; power >= 13; power -= 13)
        big_multiply_add(b, pow5_13, 0);
    for (; power > 0; power--)
        big_multiply_add(b, 5, 0);
}

static void big_shift(struct big *b, int64_t bits)
{
    int words = (int)(bits / 32);
    big_multiply_add(b, (uint32_t)1 << (bits % 32), 0);
    memmove(b->word + words, b->word, (size_t)b->n * sizeof *b->word);
    memset(b->word, 0, (size_t)words * sizeof *b->word);
    b->n += words;
}

static int big_compare(const struct big *a, const struct big *b)
{
    if (a->n != b->n)
        return a->n < b->n ? -1 : 1;
    for (int i = a->n; i-- > 0;)
        if (a->word[i] != b->word[i])
            return a->word[i] < b->word[i] ? -1 : 1;
    return 0;
}

/* All significant digits of a decimal as an integer; returns the power of ten that goes with it. */
static int64_t big_of_decimal(struct big *b, const struct decimal *dec)
{
    int64_t taken = 0, left = 0;
    bool rest = false;
    b->n = 0;
    for (const char *p = dec->first; p < dec->end; p++) {
        if (*p == '.')
            continue;
        if (taken < MOST_DIGITS) {
            big_multiply_add(b, 10, (uint32_t)(*p - '0'));
            taken++;
        } else {
            rest |= *p != '0';
            left++;
        }
    }
    /* More digits than a halfway point has: they can only lift the value above one. */
    if (rest)
        big_multiply_add(b, 10, 1);
    return dec->last + left - rest;
}

/* Is the decimal below, at or above (2 * mantissa + 1) * 2^(scale - 1), the halfway point between
 * two doubles? Powers of 5 and of 2 go to the side where their exponent is positive. */
static int compare_with_half(const struct decimal *dec, uint64_t mantissa, int scale)
{
    uint64_t m = 2 * mantissa + 1;
    struct big text, half = {.word = {(uint32_t)m, (uint32_t)(m >> 32)}, .n = m >> 32 ? 2 : 1};
    int64_t ten = big_of_decimal(&text, dec), two = ten - (scale - 1);
    big_multiply_pow5(ten < 0 ? &half : &text, ten < 0 ? -ten : ten);
    big_shift(two < 0 ? &half : &text, two < 0 ? -two : two);
    return big_compare(&text, &half);
}

/* Correctly rounded double of a decimal with w > 0 (bits without the sign).
 *
 * The product of w and the leading 128 bits of the power of ten (Eisel and Lemire; Lemire 2021,
 * "Number parsing at a gigabyte per second") is a lower bound of the value, in 192 bits. It is
 * below the truth by less than one unit of its middle word, or, when digits were cut from w, by
 * less than 17 units of the high one. Unless a halfway point lies in that narrow range the rounding
 * is settled; else the decimal is compared with the halfway point in exact arithmetic. */
static uint64_t round_decimal(const struct decimal *dec)
{
    const uint64_t infinite = (uint64_t)2047 << MANTISSA;
    if (dec->exponent < HM_NUM_POW10_MIN)
        return 0;
    if (dec->exponent > 308)
        return infinite;
    int q = (int)dec->exponent;
    const uint64_t *pow10 = hm_num_pow10[q - HM_NUM_POW10_MIN];
    bool exact = q >= 0 && q <= HM_NUM_POW10_EXACT && !dec->cut;
    int zeros = __builtin_clzll(dec->w);
    uint64_t w = dec->w << zeros;
    wide high = (wide)w * pow10[0] + (uint64_t)(((wide)w * pow10[1]) >> 64);
    uint64_t low = w * pow10[1], mid = (uint64_t)high, top = (uint64_t)(high >> 64);

    int lead = (int)(top >> 63);                            /* the product has 191 or 192 bits */
    int exponent = floor_log2_pow10(q) - zeros + 63 + lead; /* of its leading bit */
    if (exponent > 1023)
        return infinite;
    bool denormal = exponent < -1022;
    int scale = denormal ? -1074 : exponent - MANTISSA;       /* the double is mantissa * 2^scale */
    int drop = 10 + lead + (denormal ? -1022 - exponent : 0); /* bits of top below the mantissa */
    if (drop > 65)
        return 0;
    if (drop == 65) /* below half the least double, or a hair above */
        return compare_with_half(dec, 0, scale) > 0;
    uint64_t mantissa = drop == 64 ? 0 : top >> drop;
    uint64_t half = (uint64_t)1 << (drop - 1);
    uint64_t rest = top & (half | (half - 1));

    bool doubtful = dec->cut ? rest < half && half - rest <= 17
                             : !exact && rest == half - 1 && mid == UINT64_MAX;
    bool up;
    if (doubtful) {
        int side = compare_with_half(dec, mantissa, scale);
        up = side > 0 || (side == 0 && (mantissa & 1));
    } else if (exact && rest == half && !mid && !low)
        up = mantissa & 1;
    else
        up = rest >= half;
    /* A mantissa that rounds up to 2^53 carries into the exponent, and a denormal that rounds up
     * to 2^52 becomes normal; both come out right by plain addition. */
    uint64_t stored = denormal ? 0 : (uint64_t)(exponent + 1022) << MANTISSA;
    return stored + mantissa + up;
}

/* Powers of ten that are doubles */
static const double power_of_10[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static double value_of(const struct decimal *dec)
{
    /* Both operands are exact, so one operation is rounded once (Clinger 1990). */
    if (dec->w <= 2 * HIDDEN && dec->exponent >= -22 && dec->exponent <= 22 && !dec->cut) {
        double w = (double)dec->w;
        return dec->exponent < 0 ? w / power_of_10[-dec->exponent] : w * power_of_10[dec->exponent];
    }
    return dec->w ? double_of_bits(round_decimal(dec)) : 0;
}

/* More digits than fit in w: keep the first ones, from the first that is not 0 on. */
static void cut_digits(struct decimal *dec)
{
    int kept = 0;
    dec->w = 0;
    while (dec->first < dec->end && (*dec->first == '0' || *dec->first == '.'))
        dec->first++;
    for (const char *p = dec->first; p < dec->end; p++) {
        if (*p == '.')
            continue;
        if (kept < FITTING_DIGITS) {
            dec->w = dec->w * 10 + (uint64_t)(*p - '0');
            kept++;
        } else {
            dec->cut |= *p != '0';
            dec->exponent++;
        }
    }
}

/* nan, inf or infinity in any case. */
static const char *parse_word(const char *s, const char *end, bool minus, double *value)
{
    static const struct {
        const char *word;
        size_t length;
        double value;
    } words[] = {{"nan", 3, NAN}, {"infinity", 8, INFINITY}, {"inf", 3, INFINITY}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if ((size_t)(end - s) >= words[i].length &&
            strncasecmp(s, words[i].word, words[i].length) == 0) {
            *value = copysign(words[i].value, minus ? -1 : 1);
            return s + words[i].length;
        }
    return NULL;
}

/* The exponent at s ("e-7"), if there is one; its value is capped far beyond what matters. */
static const char *parse_exponent(const char *s, const char *end, int64_t *exponent)
{
    const char *p = s + 1;
    if (s == end || (*s | 32) != 'e')
        return s;
    bool minus = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    if (p == end || !is_digit(*p))
        return s;
    int64_t e = 0;
    for (; p < end && is_digit(*p); p++)
        if (e < INT64_MAX / 100)
            e = e * 10 + (*p - '0');
    *exponent += minus ? -e : e;
    return p;
}

/* The digits, eight at most, that the eight characters at s begin with, as an integer; *n: how
 * many. All are looked at together, as the bytes of a word: a loop would be left after a number of
 * digits that no processor foresees. */
static uint64_t digits_of_eight(const char *s, unsigned *n)
{
    uint64_t c = load_eight(s) ^ 0x3030303030303030; /* a digit becomes 0 .. 9 */
    uint64_t other = (c | (c + 0x7676767676767676)) & 0x8080808080808080; /* what is over 9 */
    *n = other ? (unsigned)__builtin_ctzll(other) / 8 : 8;
    if (*n == 0)
        return 0;
    c <<= 64 - 8 * *n; /* as if zeros stood before them */
    c = (c * 10 + (c >> 8)) & 0x00FF00FF00FF00FF;
    c = (c * 100 + (c >> 16)) & 0x0000FFFF0000FFFF;
    return (c * 10000 + (c >> 32)) & UINT32_MAX;
}

/* Append the digits at s to *w; returns what follows them. */
static const char *parse_digits(const char *s, const char *end, uint64_t *w)
{
    static const uint64_t power[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
    while (end - s >= 8) {
        unsigned n;
        uint64_t part = digits_of_eight(s, &n);
        *w = *w * power[n] + part;
        s += n;
        if (n < 8)
            return s;
    }
    for (; s < end && is_digit(*s); s++)
        *w = *w * 10 + (uint64_t)(*s - '0');
    return s;
}

/* What needs more than one division. The digits from `first` to p are w, with so many decimals. */
static const char *parse_slowly(const char *first, const char *p, const char *end, uint64_t w,
                                ptrdiff_t digits, ptrdiff_t decimals, double *value)
{
    struct decimal dec = {.w = w, .exponent = -decimals, .first = first, .end = p};
    p = parse_exponent(p, end, &dec.exponent);
    dec.last = dec.exponent;
    if (digits > FITTING_DIGITS)
        cut_digits(&dec);
    *value = value_of(&dec);
    return p;
}

const char *hm_num_parse(const char *s, const char *end, double *value)
{
    enum { EXACT_DIGITS = 15 }; /* an integer of so many is a double */
    bool minus = s < end && *s == '-';
    const char *first = s < end && (*s == '-' || *s == '+') ? s + 1 : s;
    uint64_t w = 0;
    const char *p = parse_digits(first, end, &w);
    ptrdiff_t digits = p - first, decimals = 0;
    if (p < end && *p == '.') {
        const char *point = p++;
        p = parse_digits(p, end, &w);
        decimals = p - point - 1;
        digits += decimals;
    }
    if (digits == 0)
        return parse_word(first, end, minus, value);
    if (digits <= EXACT_DIGITS && (p == end || (*p | 32) != 'e'))
        *value = (double)w / power_of_10[decimals];
    else
        p = parse_slowly(first, p, end, w, digits, decimals, value);
    if (minus)
        *value = -*value;
    return p;
}

size_t hm_num_parse_list(const char *s, char separator, double *value, size_t room)
{
    const char *end = s + strlen(s);
    for (size_t n = 0; n < room; s++) {
        s = hm_num_parse(s, end, &value[n]);
        if (!s || !isfinite(value[n++]))
            return 0;
        if (s == end)
            return n;
        if (*s != separator)
            return 0;
    }
    return 0;
}

/* --- writing --- */

/* digits * 10^exponent, without trailing zeros */
struct shortest {
    uint64_t digits;
    int exponent;
};

/* The high word of power * factor / 2^64, its last bit set when anything was cut off. */
static uint64_t round_to_odd(const uint64_t power[2], uint64_t factor)
{
    wide low = (wide)power[1] * factor;
    wide high = (wide)power[0] * factor + (uint64_t)(low >> 64);
    return (uint64_t)(high >> 64) | ((uint64_t)high > 1);
}

static struct shortest without_zeros(uint64_t digits, int exponent)
{
    while (digits % 100000000 == 0 && digits) {
        digits /= 100000000;
        exponent += 8;
    }
    while (digits % 10 == 0 && digits) {
        digits /= 10;
        exponent++;
    }
    return (struct shortest){digits, exponent};
}

/* The shortest decimal in the interval of the reals that round to c * 2^q, and the nearest to it of
 * those: R. Giulietti, "The Schubfach way to render doubles" (2020). With k = floor(log10(width of
 * the interval)) the interval holds at most one multiple of 10^(k+1), which is the answer if there
 * is one, and at least one of 10^k. Interval ends and value, times 4 and in units of 10^k, are
 * known well enough with 126 bits of 10^-k, rounded to odd. */
static struct shortest shorten(uint64_t c, int q, bool power_of_two)
{
    bool even = (c & 1) == 0;
    int k = (q * 1262611 - (power_of_two ? 524031 : 0)) >> 22;
    int shift = q + floor_log2_pow10(-k) + 1;
    const uint64_t *entry = hm_num_pow10[-k - HM_NUM_POW10_MIN];
    bool exact = -k >= 0 && -k <= HM_NUM_POW10_EXACT;
    uint64_t power[2] = {entry[0], entry[1] + !exact}; /* rounded up; no low word is all ones */

    uint64_t value = round_to_odd(power, (4 * c) << shift);
    uint64_t lower = round_to_odd(power, (4 * c - 2 + power_of_two) << shift) + !even;
    uint64_t upper = round_to_odd(power, (4 * c + 2) << shift) - !even;
    uint64_t s = value / 4;
    if (s >= 10) {
        uint64_t ten = s / 10;
        bool down = lower <= 40 * ten, up = 40 * ten + 40 <= upper;
        if (down != up)
            return without_zeros(ten + up, k + 1);
    }
    bool down = lower <= 4 * s, up = 4 * s + 4 <= upper;
    if (down == up)
        up = value > 4 * s + 2 || (value == 4 * s + 2 && (s & 1));
    return without_zeros(s + up, k);
}

/* c * 2^q = |v|, v finite. */
static uint64_t take_apart(double v, int *q)
{
    uint64_t bits = bits_of_double(v) & (UINT64_MAX >> 1);
    uint64_t stored = bits >> MANTISSA, fraction = bits & (HIDDEN - 1);
    *q = (stored ? (int)stored : 1) - BIAS;
    return stored ? fraction | HIDDEN : fraction;
}

static struct shortest shortest_of(double v)
{
    /* Survey coordinates are whole millimetres. Different decimals of up to 15 digits are different
     * doubles, so one that reads as v is the only one of its length or less. */
    double thousand = fabs(v) * 1000;
    if (thousand < 1e15 && thousand >= 1) {
        uint64_t n = (uint64_t)(thousand + 0.5);
        if ((double)n / 1000 == fabs(v))
            return without_zeros(n, -3);
    }
    int q;
    uint64_t c = take_apart(v, &q);
    if (c == 0)
        return (struct shortest){0, 0};
    /* Integers below 2^53 lie a half or more from any other decimal that reads as they do. */
    if (q <= 0 && q > -MANTISSA - 1 && (c & (((uint64_t)1 << -q) - 1)) == 0)
        return without_zeros(c >> -q, 0);
    return shorten(c, q, c == HIDDEN && q > 1 - BIAS);
}

/* The decimal digits of n, without leading zeros (nothing for 0); how many. Pairs of digits from a
 * table halve the divisions. */
static int write_digits(char *buf, uint64_t n)
{
    static const char pairs[] = "00010203040506070809101112131415161718192021222324"
                                "25262728293031323334353637383940414243444546474849"
                                "50515253545556575859606162636465666768697071727374"
                                "75767778798081828384858687888990919293949596979899";
    char text[20], *p = text + sizeof text;
    for (; n >= 100; n /= 100)
        memcpy(p -= 2, pairs + 2 * (n % 100), 2);
    if (n >= 10)
        memcpy(p -= 2, pairs + 2 * n, 2);
    else if (n > 0)
        *--p = (char)('0' + n);
    int count = (int)(text + sizeof text - p);
    memcpy(buf, p, (size_t)count);
    return count;
}

/* digits * 10^exponent with n digits, in plain notation. */
static char *write_plain(char *p, const char *digits, int n, int exponent)
{
    int before = n + exponent; /* digits before the point */
    if (before <= 0) {
        *p++ = '0';
        if (n == 0)
            return p;
        *p++ = '.';
        memset(p, '0', (size_t)-before);
        p += -before;
        memcpy(p, digits, (size_t)n);
        return p + n;
    }
    if (before >= n) {
        memcpy(p, digits, (size_t)n);
        memset(p + n, '0', (size_t)(before - n));
        return p + before;
    }
    memcpy(p, digits, (size_t)before);
    p[before] = '.';
    memcpy(p + before + 1, digits + before, (size_t)(n - before));
    return p + n + 1;
}

/* … and with one digit before the point and an exponent. */
static char *write_scientific(char *p, const char *digits, int n, int exponent)
{
    int e = exponent + n - 1;
    *p++ = digits[0];
    if (n > 1) {
        *p++ = '.';
        memcpy(p, digits + 1, (size_t)(n - 1));
        p += n - 1;
    }
    *p++ = 'e';
    *p++ = e < 0 ? '-' : '+';
    return p + write_digits(p, (uint64_t)(e < 0 ? -e : e));
}

static size_t write_decimal(char *buf, bool minus, struct shortest s)
{
    char digits[20], *p = buf;
    int n = write_digits(digits, s.digits);
    int before = n + s.exponent;
    if (minus)
        *p++ = '-';
    p = before < -4 || before > 16 ? write_scientific(p, digits, n, s.exponent)
                                   : write_plain(p, digits, n, s.exponent);
    return (size_t)(p - buf);
}

static size_t write_word(char *buf, double v)
{
    const char *word = isnan(v) ? "nan" : v < 0 ? "-inf" : "inf";
    size_t n = strlen(word);
    memcpy(buf, word, n);
    return n;
}

size_t hm_num_print(char *buf, double v)
{
    return isfinite(v) ? write_decimal(buf, signbit(v), shortest_of(v)) : write_word(buf, v);
}

/* |v| * 10^decimals, rounded to an integer, half to even, as exact arithmetic has it. Only where
 * that has no more than 17 digits and v is no integer: the product then fits 128 bits. */
static uint64_t scale_and_round(double v, int decimals)
{
    int q;
    wide product = take_apart(v, &q);
    for (int i = 0; i < decimals; i++)
        product *= 10;
    if (-q >= 127)
        return 0;
    wide half = (wide)1 << (-q - 1), rest = product & (2 * half - 1);
    uint64_t n = (uint64_t)(product >> -q);
    return n + (rest > half || (rest == half && (n & 1)));
}

size_t hm_num_print_fixed(char *buf, double v, int decimals)
{
    if (!isfinite(v))
        return write_word(buf, v);
    struct shortest s = shortest_of(v);
    if (-s.exponent <= decimals)
        return write_decimal(buf, signbit(v), s);
    uint64_t n = scale_and_round(v, decimals);
    if (n == 0) {
        *buf = '0'; /* what rounds to nothing has no sign */
        return 1;
    }
    return write_decimal(buf, v < 0, without_zeros(n, -decimals));
}
