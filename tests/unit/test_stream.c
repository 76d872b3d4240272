/* Streams: what is written is read back exactly, in text and in blocks, and bad input is refused
 * with its place. */
#include "stream.h"

/* The text is canonical: it comes back as it is, also through blocks. */
static void round_trip(const char *what, const char *stream)
{
    struct hm_diag d;
    size_t n;
    spill(path, stream, strlen(stream));
    enum hm_err err = convert(path, copy, text, true, &d);
    char *got = slurp(copy, &n);
    if (!ok(!err && !strcmp(got, stream), "%s: text as it was", what))
        printf("# %d line %lld: %s\n# got %s\n", err, (long long)d.line, d.text, got);
    err = convert(path, copy, blocks, true, &d);
    if (!err)
        err = convert(copy, path, text, true, &d);
    got = slurp(path, &n);
    if (!ok(!err && !strcmp(got, stream), "%s: text through blocks as it was", what))
        printf("# %d line %lld: %s\n# got %s\n", err, (long long)d.line, d.text, got);
    err = convert(copy, again, blocks, true, &d);
    size_t m;
    char *first = malloc(1 << 16);
    memcpy(first, slurp(copy, &n), 1 << 16);
    const char *second = slurp(again, &m);
    ok(!err && n == m && !memcmp(first, second, n), "%s: blocks as they were", what);
    free(first);
}

static const char points_text[] = "#hm 1 points text\n#fields x y z class\n#units m m m 1\n"
                                  "#crs UTM 32N WGS84\n#unheard of this\n# a remark\n"
                                  "#prog hmsurvey 0.1\n#prog other 2 -x\n#data\n"
                                  "1 2 3 2\n-0.1 1e+300 nan 9\n0.30000000000000004 -0 5e-324 1\n"
                                  "#end 3\n";
static const char grid_text[] = "#hm 1 grid text\n#size 3 2\n#origin 545000 5972000\n#step 5 -5\n"
                                "#fields x y z slope\n#data\n"
                                "545000 5972000 1 0\n545005 5972000 2 nan\n545010 5972000 nan nan\n"
                                "545000 5971995 1.5 0\n545005 5971995 2.5 1\n545010 5971995 3.5 2\n"
                                "#end 6\n";
static const char lines_text[] = "#hm 1 lines text\n#count 3\n#fields x y z\n#data\n"
                                 "> surface=main side=left name=\"upper bank\"\n0 0 1\n10 0 nan\n"
                                 ">\n5 5 5\n6 6 6\n"
                                 "> face=main closed=1 hole=1\n0 0 0\n1 0 0\n1 1 0\n#end 3\n";
static const char mesh_text[] =
    "#hm 1 mesh text\n#name main\n#role hybrid\n#owners main tributary\n"
    "#data\nv 0 0 1 1 0\nv 1 0 1.5 3 1\nv 1 1 2 0 2\nv 0 1 nan 7 0\n"
    "v 2 0.1 1 0 0\nt 0 1 2 5\nq 0 1 2 3 0\nt 1 4 2 2147483647\n#end 8\n";

static void test_round_trips(void)
{
    char all[4096];
    round_trip("points", points_text);
    round_trip("grid", grid_text);
    round_trip("lines", lines_text);
    round_trip("mesh", mesh_text);
    snprintf(all, sizeof all, "%s%s%s%s%s", mesh_text, points_text, points_text, grid_text,
             lines_text);
    round_trip("all, one behind the other", all);
    round_trip("no points", "#hm 1 points text\n#fields x y z\n#data\n#end 0\n");
    round_trip("no mesh", "#hm 1 mesh text\n#data\n#end 0\n");
}

/* Cut at every byte: never taken for whole. Every header line and record can be cut so. */
static void test_truncation(void)
{
    const char *const streams[] = {points_text, grid_text, lines_text, mesh_text};
    struct hm_diag d;
    for (int s = 0; s < 8; s++) {
        size_t n, taken = 0;
        spill(path, streams[s / 2], strlen(streams[s / 2]));
        convert(path, copy, s % 2 ? blocks : text, false, &d);
        char *whole = malloc(1 << 16), *bytes = slurp(copy, &n);
        memcpy(whole, bytes, n);
        size_t last = s % 2 ? n : n - strlen(" 3\n"); /* "#end" alone is whole */
        for (size_t cut = 5; cut < last; cut++) {
            spill(path, whole, cut);
            enum hm_err err = convert(path, copy, text, false, &d);
            if (err != HM_ETRUNC && taken++ == 0)
                printf("# cut at %zu: %d line %lld %s\n", cut, err, (long long)d.line, d.text);
        }
        ok(taken == 0, "stream %d cut anywhere is noticed", s);
        free(whole);
    }
}

#define HEAD "#hm 1 points text\n#data\n"
#define GRID "#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 1 1\n#data\n"
#define MESH "#hm 1 mesh text\n#data\nv 0 0 0 0 0\nv 1 0 0 0 0\nv 1 1 0 0 0\n"
#define LINES "#hm 1 lines text\n#data\n"

static void test_bad_text(void)
{
    refused_text("empty", "", HM_EFORMAT, 0, "empty");
    refused_text("blank", "\n \n", HM_EFORMAT, 0, "empty");
    refused_text("newer", "#hm 2 points text\n#data\n#end\n", HM_EFORMAT, 1, "version 2");
    refused_text("unknown kind", "#hm 1 pints text\n", HM_EFORMAT, 1, "kind");
    refused_text("unknown encoding", "#hm 1 points f32le\n", HM_EFORMAT, 1, "encoding");
    refused_text("word", HEAD "1 2 3\n1 two 3\n#end\n", HM_EFORMAT, 4,
                 "expected a number, got \"two\"");
    refused_text("two of three", HEAD "1 2\n#end\n", HM_EFORMAT, 3, "expected 3 numbers, got 2");
    refused_text("four of three", HEAD "1 2 3 4\n", HM_EFORMAT, 3, "expected 3 numbers, got 4");
    refused_text("digits and letters", HEAD "1 2 3x\n", HM_EFORMAT, 3, "got \"3x\"");
    refused_text("nan x", HEAD "nan 2 3\n#end\n", HM_EFORMAT, 3, "not a number");
    refused_text("infinite y", HEAD "1 -inf 3\n#end\n", HM_EFORMAT, 3, "infinite");
    refused_text("infinite z", HEAD "1 2 1e999\n#end\n", HM_EFORMAT, 3, "z is infinite");
    refused_text("object in object", HEAD "1 2 3\n" HEAD "#end\n", HM_ETRUNC, 4, "cut off");
    refused_text("bad count", HEAD "#end many\n", HM_EFORMAT, 3, "number");
    refused_text("data in header", "#hm 1 points text\n1 2 3\n", HM_EFORMAT, 2, "header");
    refused_text("fields", "#hm 1 points text\n#fields y x z\n", HM_EFORMAT, 2, "x y z");
    refused("control character", HEAD "#end\n#hm 1 points text\n#a \0b\n#data\n#end\n", 64,
            HM_EFORMAT, 5, "control");
    refused_text("size 0", "#hm 1 grid text\n#size 0 2\n#origin 0 0\n#step 1 1\n#data\n",
                 HM_EFORMAT, 5, "#size");
    refused_text("no size", "#hm 1 grid text\n#data\n", HM_EFORMAT, 2, "#size");
    refused_text("huge size", "#hm 1 grid text\n#size 1e18 2\n", HM_EFORMAT, 2, "#size");
    refused_text("large size", "#hm 1 grid text\n#size 1e12 2\n#step 1 1\n#data\n", HM_EFORMAT, 4,
                 "too large");
    refused_text("step 0", "#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 1 0\n#data\n",
                 HM_EFORMAT, 5, "#step");
    refused_text("lost step", "#hm 1 grid text\n#size 2 2\n#origin 1e20 0\n#step 1 1\n#data\n",
                 HM_EFORMAT, 5, "lost");
    refused_text("node off", GRID "0 0 1\n1.00001 0 1\n", HM_EFORMAT, 7, "lattice");
    refused_text("node outside", GRID "0 0 1\n1 0 1\n2 0 1\n", HM_EFORMAT, 8, "lattice");
    refused_text("node twice", GRID "0 0 1\n0 0 1\n", HM_EFORMAT, 7, "order");
    refused_text("claimed grid",
                 "#hm 1 grid text\n#size 10000000 10000000\n#origin 0 0\n#step 1 1\n#data\n0 0 1\n"
                 "5 7000000 2\n#end\n",
                 HM_EFORMAT, 7, "missing");
    refused_text("claimed empty grid",
                 "#hm 1 grid text\n#size 10000000 10000000\n#origin 0 0\n#step 1 1\n#data\n#end\n",
                 HM_EFORMAT, 6, "missing");
    refused_text("vertex without line", LINES "1 2 3\n#end\n", HM_EFORMAT, 3, "'>'");
    refused_text("bad attributes", LINES "> a=\"b\n1 2 3\n#end\n", HM_EFORMAT, 3, "");
    refused_text("vertex of two", LINES ">\n1 2\n#end\n", HM_EFORMAT, 4,
                 "expected 3 numbers, got 2");
    refused_text("no such node", MESH "t 0 1 3 0\n#end\n", HM_EFORMAT, 6, "not there");
    refused_text("negative node", MESH "t 0 1 -1 0\n#end\n", HM_EFORMAT, 6, "not there");
    refused_text("half a node", MESH "t 0 1 1.5 0\n#end\n", HM_EFORMAT, 6, "whole");
    refused_text("node twice", MESH "t 0 1 1 0\n#end\n", HM_EFORMAT, 6, "twice");
    refused_text("region", MESH "t 0 1 2 -1\n#end\n", HM_EFORMAT, 6, "region");
    refused_text("node too late", MESH "t 0 1 2 0\nv 5 5 5 0 0\n#end\n", HM_EFORMAT, 7, "behind");
    refused_text("unknown line", MESH "w 0 1 2\n#end\n", HM_EFORMAT, 6, "v, t or q");
}

static void test_counts(void)
{
    struct hm_diag d;
    const char stream[] = "#hm 1 points text\n#count 3\n#data\n1 2 3\n#end 2\n";
    spill(path, stream, strlen(stream));
    ok(convert(path, copy, text, false, &d) == HM_OK, "counts are not checked");
    ok(convert(path, copy, text, true, &d) == HM_EFORMAT && d.line == 5, "but when strict");
    const char later[] = "#hm 1 points text\n#count 1\n#data\n1 2 3\n#end 2\n";
    spill(path, later, strlen(later));
    ok(convert(path, copy, text, true, &d) == HM_EFORMAT, "the count behind the end as well");
}

/* A filter takes nodes out of a grid: they are nodata. */
static void test_thinned_grid(void)
{
    struct hm_diag d;
    size_t n;
    const char stream[] = GRID "1 0 5\n0 1 6\n#end 4\n";
    spill(path, stream, strlen(stream));
    ok(convert(path, copy, text, false, &d) == HM_OK, "a grid without some nodes");
    const char *got = strstr(slurp(copy, &n), "#data\n");
    ok(got && !strcmp(got, "#data\n0 0 nan\n1 0 5\n0 1 6\n1 1 nan\n#end 4\n"), "they are nodata");
}

/* 150,001 points: blocks of 65,536, whatever the pieces they were written in. */
static void test_blocks(void)
{
    enum { N = 150001 };
    static double v[N][3];
    struct hm_diag d = {0};
    size_t n, m;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 3; k++)
            v[i][k] = 0.001 * i * (k + 1);
    for (int pass = 0; pass < 2; pass++) {
        struct hm_writer *w;
        struct hm_header h;
        hm_header_init(&h, HM_POINTS, &d);
        hm_writer_open(&w, pass ? copy : path, blocks, &d);
        hm_writer_begin(w, &h, &d);
        for (size_t i = 0, part; i < N; i += part) {
            part = pass ? 1 + i % 977 : N;
            if (part > N - i)
                part = N - i;
            hm_writer_points(w, v[i], part, &d);
        }
        hm_writer_end(w, &d);
        hm_writer_close(&w, &d);
        hm_header_free(&h);
    }
    ok(!d.err, "written");
    static char first[1 << 22];
    memcpy(first, slurp(path, &n), 1 << 22);
    const char *second = slurp(copy, &m);
    size_t head = (size_t)(strstr(first, "#data\n") + 6 - first);
    ok(n == m && !memcmp(first, second, n), "the bytes do not depend on the pieces");
    ok(n == head + N * 24 + 4 * 16, "as long as three blocks and done");
    ok(!memcmp(first + head, "pnts\0\0\0\0\0\0\1\0\0\0\0\0", 16), "65,536 in the first");
    const char *third = first + head + 2 * (16 + 65536 * 24);
    ok(!memcmp(third, "pnts\0\0\0\0\xf1\x49\0\0\0\0\0\0", 16), "the rest in the third");
    ok(!memcmp(first + n - 16, "done\0\0\0\0\xf1\x49\x02\0\0\0\0\0", 16), "and done counts them");
    ok(convert(path, copy, text, true, &d) == HM_OK &&
           convert(copy, path, blocks, true, &d) == HM_OK,
       "to text and back");
    second = slurp(path, &m);
    ok(n == m && !memcmp(first, second, n), "the same bytes");
}

static void test_table(void)
{
    struct hm_diag d;
    size_t n;
    static const struct {
        const char *what, *in, *out;
    } t[] = {
        {"blanks and tabs", "# from a GPS\n1 2 3\n\t4\t5  6\r\n",
         "x y z\n#data\n1 2 3\n4 5 6\n#end 2\n"},
        {"commas", "1,2,3\n4, 5 ,\n", "x y z\n#data\n1 2 3\n4 5 nan\n#end 2\n"},
        {"two columns", "1 2\n3 4\n", "x y z\n#data\n1 2 nan\n3 4 nan\n#end 2\n"},
        {"more columns", "1 2 3 4\n", "x y z c4\n#data\n1 2 3 4\n#end 1\n"},
        {"names", "x,y,z,Class\n1,2,3,9\n", "x y z class\n#data\n1 2 3 9\n#end 1\n"},
        {"names in another order", "ID Height Northing Easting\n7 3 2 1\n",
         "x y z id\n#data\n1 2 3 7\n#end 1\n"},
        {"names without z", "y hoogte x\n2 9 1\n", "x y z\n#data\n1 2 9\n#end 1\n"},
        {"no line end", "1 2 3", "x y z\n#data\n1 2 3\n#end 1\n"},
        {"a stream behind", "1 2 3\n" HEAD "4 5 6\n#end\n",
         "x y z\n#data\n1 2 3\n#end 1\n#hm 1 points text\n#fields x y z\n#data\n4 5 6\n#end 1\n"},
        {"a table behind a stream", HEAD "4 5 6\n#end\n1 2 3\n",
         "x y z\n#data\n4 5 6\n#end 1\n#hm 1 points text\n#fields x y z\n#data\n1 2 3\n#end 1\n"},
    };
    for (size_t i = 0; i < sizeof t / sizeof *t; i++) {
        spill(path, t[i].in, strlen(t[i].in));
        enum hm_err err = convert(path, copy, text, false, &d);
        const char *got = slurp(copy, &n), *body = strstr(got, "#fields ");
        if (!ok(!err && body && !strcmp(body + 8, t[i].out), "table: %s", t[i].what))
            printf("# %d line %lld: %s; got %s\n", err, (long long)d.line, d.text, got);
    }
    refused_text("a table gets short", "1 2 3\n4 5\n", HM_EFORMAT, 2, "expected 3 numbers, got 2");
    refused_text("a word in a table", "1 2 3\n4 five 6\n", HM_EFORMAT, 2, "\"five\"");
    refused_text("one column", "1\n2\n", HM_EFORMAT, 1, "got 1");
    refused_text("prose", "Dear reader,\nthis is prose\n", HM_EFORMAT, 1, "Dear");
    refused_text("names alone", "x y z\n", HM_EFORMAT, 1, "no data");
    refused_text("remarks alone", "# nothing\n", HM_EFORMAT, 1, "no data");
    refused("garbage", "\0\1\2\3\377\376", 6, HM_EFORMAT, 0, "binary");
}

/* A number cannot be longer than the buffer, but a line can. */
static void test_long_line(void)
{
    enum { BLANKS = 3 << 20 };
    static char bytes[BLANKS + 64];
    struct hm_diag d;
    size_t n;
    memset(bytes, ' ', BLANKS);
    memcpy(bytes, "1 2", 3);
    strcpy(bytes + BLANKS, " 3\n4 5 6\n");
    spill(path, bytes, strlen(bytes));
    ok(convert(path, copy, text, false, &d) == HM_OK, "a line of three megabytes");
    const char *got = strstr(slurp(copy, &n), "#data\n");
    ok(got && !strcmp(got, "#data\n1 2 3\n4 5 6\n#end 2\n"), "and the line behind it");
}

int main(void)
{
    begin_files();
    test_round_trips();
    test_counts();
    test_thinned_grid();
    test_blocks();
    test_table();
    test_long_line();
    test_bad_text();
    test_truncation();
    end_files();
    return done();
}
