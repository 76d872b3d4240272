/* Foreign forms, recognised by content: GMT lines, ESRI ASCII grids, LAS, SMS .2dm. */
#include "stream.h"

#include <stdint.h>

/* Reading `in` gives, from its first `#` line on, `out`. */
static void reads(const char *what, const char *in, const char *out)
{
    struct hm_diag d;
    size_t n;
    spill(path, in, strlen(in));
    enum hm_err err = convert(path, copy, text, false, &d);
    const char *got = slurp(copy, &n);
    if (!ok(!err && !strcmp(got, out), "%s", what))
        printf("# %d line %lld: %s; got\n%s\n", err, (long long)d.line, d.text, got);
}

#define LINES "#hm 1 lines text\n#fields x y z\n#data\n"

static void test_gmt(void)
{
    reads("marks and attributes", "> surface=main side=left\n1 2 3\n4 5 6\n>\n7 8 9\n7 9 9\n",
          LINES "> surface=main side=left\n1 2 3\n4 5 6\n>\n7 8 9\n7 9 9\n#end 2\n");
    reads("two columns", "# drawn by hand\n> side=left\n1 2\n4 5\n",
          LINES "> side=left\n1 2 nan\n4 5 nan\n#end 1\n");
    reads("tabs, more columns, CR LF", ">\r\n1\t2\t3\t99\r\n4\t5\t6\t99\r\n",
          LINES ">\n1 2 3\n4 5 6\n#end 1\n");
    reads("commas", ">\n1,2\n4,5\n", LINES ">\n1 2 nan\n4 5 nan\n#end 1\n");
    reads("the first line without a mark", "1 2 3\n4 5 6\n>\n7 8 9\n",
          LINES ">\n1 2 3\n4 5 6\n>\n7 8 9\n#end 2\n");
    reads("closed by its last vertex", ">\n0 0 1\n1 0 1\n1 1 1\n0 0 1\n",
          LINES "> closed=1\n0 0 1\n1 0 1\n1 1 1\n#end 1\n");
    reads("closed twice", ">\n0 0 1\n1 0 1\n1 1 1\n0 0 1\n0 0 1\n",
          LINES "> closed=1\n0 0 1\n1 0 1\n1 1 1\n#end 1\n");
    reads("closed by its attribute", "> hole=1 closed=1\n0 0 1\n1 0 1\n1 1 1\n",
          LINES "> hole=1 closed=1\n0 0 1\n1 0 1\n1 1 1\n#end 1\n");
    reads("there and back is not closed", ">\n0 0 1\n1 0 1\n0 0 1\n",
          LINES ">\n0 0 1\n1 0 1\n0 0 1\n#end 1\n");
    reads("marks without vertices", ">\n>\n1 2 3\n>\n", LINES ">\n1 2 3\n#end 1\n");
    reads("no attributes, but a label", "> -L\"a b\" -Z5\n1 2 3\n4 5 6\n",
          LINES "> label=\"-L\\\"a b\\\" -Z5\"\n1 2 3\n4 5 6\n#end 1\n");
    reads("OGR_GMT",
          "# @VGMT1.0 @GPOLYGON\n# @R0/4/0/4\n# @Je32632\n# @Jp\"+proj=utm +zone=32\"\n"
          "# @Nface|max area|note\n# @Tstring|double|string\n# FEATURE_DATA\n"
          ">\n# @Dmain|10.5|\"with a | bar\"\n# @P\n0 0\n4 0\n4 4\n0 0\n"
          ">\n# @H\n1 1\n2 1\n2 2\n1 1\n>\n# @Dother||\n# @P\n5 5\n6 5\n6 6\n5 5\n",
          "#hm 1 lines text\n#fields x y z\n#crs EPSG:32632\n#data\n"
          "> face=main max_area=10.5 note=\"with a | bar\" closed=1\n0 0 nan\n4 0 nan\n4 4 nan\n"
          "> face=main max_area=10.5 note=\"with a | bar\" hole=1 closed=1\n1 1 nan\n2 1 nan\n2 2 "
          "nan\n"
          "> face=other closed=1\n5 5 nan\n6 5 nan\n6 6 nan\n#end 3\n");
    reads("a stream behind", ">\n1 2 3\n4 5 6\n" LINES "#end 0\n",
          LINES ">\n1 2 3\n4 5 6\n#end 1\n" LINES "#end 0\n");
    refused_text("a vertex of fewer numbers", "> a=b\n1 2 3\n4 5\n", HM_EFORMAT, 3,
                 "expected 3 numbers, got 2");
    refused_text("a vertex of one number", ">\n1\n", HM_EFORMAT, 2, "got 1");
    refused_text("a word", ">\n1 2 3\none 2 3\n", HM_EFORMAT, 3, "\"one\"");
    refused_text("nan", ">\n1 nan 3\n", HM_EFORMAT, 2, "not a number");
}

static void test_ascii_grid(void)
{
    reads("corner, north first, nodata",
          "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n"
          "1 2 -9999\n4 5 6\n",
          "#hm 1 grid text\n#size 3 2\n#origin 105 215\n#step 10 -10\n#fields x y z\n#data\n"
          "105 215 1\n115 215 2\n125 215 nan\n105 205 4\n115 205 5\n125 205 6\n#end 6\n");
    reads("centre, any case, lines unlike rows, a grid behind",
          "NCOLS 2\nNROWS 2\nXLLCENTER 1\nYLLCENTER 2\nCELLSIZE 0.5\n1\n2 3\n4\n"
          "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ndx 2\ndy 4\nnodata_value 7\n7.5\n",
          "#hm 1 grid text\n#size 2 2\n#origin 1 2.5\n#step 0.5 -0.5\n#fields x y z\n#data\n"
          "1 2.5 1\n1.5 2.5 2\n1 2 3\n1.5 2 4\n#end 4\n"
          "#hm 1 grid text\n#size 1 1\n#origin 1 2\n#step 2 -4\n#fields x y z\n#data\n"
          "1 2 7.5\n#end 1\n");
    const char head[] = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    char grid[256];
    snprintf(grid, sizeof grid, "%s1 2\n3\n", head);
    refused_text("cut off", grid, HM_ETRUNC, 7, "3 of 4 values");
    snprintf(grid, sizeof grid, "%s1 2\n3 x\n", head);
    refused_text("a word", grid, HM_EFORMAT, 7, "\"x\"");
    snprintf(grid, sizeof grid, "%s1 2\n3 4 5\n", head);
    refused_text("a value too many", grid, HM_EFORMAT, 7, "more than the 4");
    snprintf(grid, sizeof grid, "%s1 2\n3 4\n5 6\n", head);
    refused_text("a row too many", grid, HM_EFORMAT, 8, "more than the 4");
    refused_text("no values", head, HM_ETRUNC, 5, "without values");
    refused_text("no corner", "ncols 2\nnrows 2\ncellsize 1\n1 2 3 4\n", HM_EFORMAT, 3,
                 "xllcorner");
    refused_text("no columns", "ncols 0\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
                 HM_EFORMAT, 5, "ncols");
    refused_text("many columns", "ncols 1e18\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
                 HM_EFORMAT, 5, "ncols");
    refused_text("no cell", "ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1\n",
                 HM_EFORMAT, 5, "cellsize");
}

static void test_2dm(void)
{
    reads("triangles, quadrilaterals, strings",
          "MESH2D\nMESHNAME \"flood plain\"\nNUM_MATERIALS_PER_ELEM 1\n"
          "E3T 1 1 2 3 5\nE4Q 2 1 3 4 5 7\n"
          "ND 1 0 0 1.5\nND 2 1 0 1\nND 3 1 1 1\nND 4 0.5 1 1\nND 5 0 1 -1\n"
          "NS 1 2\nNS -3 inflow\nNS 4 -5\nBEGPARAMDEF\nGM \"Mesh\"\nEND2DMBC",
          "#hm 1 mesh text\n#name flood_plain\n#string inflow 0 1 2\n#string 2 3 4\n#data\n"
          "v 0 0 1.5 0 0\nv 1 0 1 0 0\nv 1 1 1 0 0\nv 0.5 1 1 0 0\nv 0 1 -1 0 0\n"
          "t 0 1 2 5\nq 0 2 3 4 7\n#end 7\n");
    reads("ids with gaps, no material, a stream behind",
          "MESH2D\nND 10 0 0 1\nND 7 1 0 1\nND 30 1 1 1\nE3T 1 10 7 30\n"
          "#hm 1 mesh text\n#data\n#end 0\n",
          "#hm 1 mesh text\n#data\nv 0 0 1 0 0\nv 1 0 1 0 0\nv 1 1 1 0 0\nt 0 1 2 0\n#end 4\n"
          "#hm 1 mesh text\n#data\n#end 0\n");
#define TRI "MESH2D\nND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\n"
    reads("another material for region 0", TRI "E3T 1 1 2 3 8\nMAT 8 \"region 0\"\n",
          "#hm 1 mesh text\n#data\nv 0 0 1 0 0\nv 1 0 1 0 0\nv 1 1 1 0 0\nt 0 1 2 0\n#end 4\n");
    refused_text("a mark without a kind behind", TRI "#hm\n", HM_EFORMAT, 5, "expected \"#hm 1");
    refused_text("no such node", TRI "E3T 1 1 2 4 1\n", HM_EFORMAT, 0, "element 1");
    refused_text("an id twice", TRI "ND 3 5 5 5\nE3T 1 1 2 3 1\n", HM_EFORMAT, 0, "id 3");
    refused_text("a word", "MESH2D\nND 1 0 zero 1\n", HM_EFORMAT, 2, "zero");
    refused_text("nan", "MESH2D\nND 1 nan 0 1\n", HM_EFORMAT, 2, "not a number");
    refused_text("mid-side nodes", TRI "E6T 1 1 2 3 4 5 6 1\n", HM_EFORMAT, 5, "mid-side");
    refused_text("a string of no node", TRI "NS 1 -9 out\n", HM_EFORMAT, 0, "out");
}

/* --- LAS --- */

static void put(char *to, uint64_t v, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (char)(v >> 8 * i);
}

static void put_f64(char *to, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    put(to, bits, 8);
}

/* A LAS file of `count` points at X = 100 i, Y = -i, Z = i; every fifth withheld; class i mod 32,
 * or i mod 256 in formats from 6 on. Returns its size. */
static size_t make_las(char *b, int minor, int format, int extra, int count)
{
    static const int least[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    int header = minor == 4 ? 375 : minor == 3 ? 235 : 227, record = least[format] + extra;
    int data = header + 54; /* something between header and points */
    size_t size = (size_t)(data + count * record);
    memset(b, 0, size);
    memcpy(b, "LASF", 4);
    put(b + 24, 1, 1);
    put(b + 25, (uint64_t)minor, 1);
    put(b + 94, (uint64_t)header, 2);
    put(b + 96, (uint64_t)data, 4);
    put(b + 104, (uint64_t)format, 1);
    put(b + 105, (uint64_t)record, 2);
    put(b + 107, minor == 4 ? 0 : (uint64_t)count, 4);
    for (int k = 0; k < 3; k++) {
        put_f64(b + 131 + 8 * k, k < 2 ? 0.01 : 0.001);
        put_f64(b + 155 + 8 * k, k == 0 ? 500000 : k == 1 ? 6e6 : 0.5);
    }
    if (minor == 4)
        put(b + 247, (uint64_t)count, 8);
    for (int i = 0; i < count; i++) {
        char *p = b + data + i * record;
        put(p, (uint64_t)(100 * i), 4);
        put(p + 4, (uint64_t)-i, 4);
        put(p + 8, (uint64_t)i, 4);
        put(p + 14, (uint64_t)(format < 6 ? 2 | 3 << 3 : 2 | 3 << 4), 1); /* the second of three */
        put(p + (format < 6 ? 15 : 16), (uint64_t)(format < 6 ? i % 32 : i % 256), 1);
        if (i % 5 == 4)
            p[15] = (char)(p[15] | (format < 6 ? 0x80 : 0x04));
    }
    return size;
}

static bool las_points_are_right(int count, int classes)
{
    struct hm_diag d = {0};
    struct hm_reader *r;
    struct hm_header h;
    struct hm_points p = {0};
    bool good = !hm_reader_open(&r, path, &d) && !hm_reader_next(r, &h, &d) &&
                hm_header_field(&h, "class") == 3 && !hm_points_read(&p, r, &h, &d);
    size_t n = 0;
    for (int i = 0; i < count && good; i++) {
        if (i % 5 == 4)
            continue;
        const double *v = p.v + 6 * n++;
        /* decimals to the last bit, as strtod reads them */
        good = n <= p.n && v[0] == 500000 + i && v[1] == (600000000 - i) / 100.0 &&
               v[2] == (500 + i) / 1000.0 && v[3] == i % classes && v[4] == 2 && v[5] == 3;
    }
    good = good && n == p.n && hm_reader_next(r, &h, &d) == HM_END;
    hm_points_free(&p);
    hm_reader_close(r);
    return good;
}

static void test_las(void)
{
    static char b[1 << 16];
    for (int minor = 0; minor <= 4; minor++)
        for (int format = minor < 2   ? 0
                          : minor < 4 ? 3
                                      : 6;
             format <= (minor < 4 ? 5 : 10); format++) {
            spill(path, b, make_las(b, minor, format, format % 3 * 5, 300));
            ok(las_points_are_right(300, format < 6 ? 32 : 256), "LAS 1.%d, format %d", minor,
               format);
        }
    size_t n = make_las(b, 2, 3, 0, 300);
    refused("a point cut off", b, n - 1, HM_ETRUNC, 0, "299 of 300");
    refused("a header cut off", b, 100, HM_ETRUNC, 0, "cut off");
    b[104] = (char)0x83;
    refused("LAZ", b, n, HM_EFORMAT, 0, "laszip -i ");
    b[104] = 11;
    refused("an unknown point format", b, n, HM_EFORMAT, 0, "0 to 10");
    b[104] = 3;
    b[105] = 33;
    refused("a short record", b, n, HM_EFORMAT, 0, "record");
    make_las(b, 2, 3, 0, 300);
    b[25] = 5;
    refused("LAS 1.5", b, n, HM_EFORMAT, 0, "1.4");
    make_las(b, 2, 3, 0, 300);
    put_f64(b + 131, 0);
    refused("scale 0", b, n, HM_EFORMAT, 0, "scale");
    n = make_las(b, 4, 6, 0, 3);
    put(b + 247, UINT64_MAX, 8);
    refused("a count of 2^64 - 1", b, n, HM_ETRUNC, 0, "of 18446744073709551615");
    n = make_las(b, 2, 0, 0, 3);
    memmove(b + 6, b, n);
    memcpy(b, "1 2 3\n", 6);
    refused("LAS behind points", b, n + 6, HM_EFORMAT, 0, "binary");
}

/* A record of the reference system put between header and points, and what the header says of it.
 */
static void says(const char *what, int number, const void *record, size_t n, const char *crs,
                 const char *units)
{
    static char b[1 << 13];
    enum { HEADER = 227, HEAD = 54 };
    size_t size = make_las(b, 2, 3, 0, 3);
    memmove(b + HEADER + HEAD + n, b + HEADER + HEAD, size - HEADER - HEAD);
    put(b + 96, HEADER + HEAD + n, 4);
    put(b + 100, 1, 4);
    memcpy(b + HEADER + 2, "LASF_Projection", 15);
    put(b + HEADER + 18, (uint64_t)number, 2);
    put(b + HEADER + 20, n, 2);
    memcpy(b + HEADER + HEAD, record, n);
    spill(path, b, size + n);
    struct hm_diag d = {0};
    struct hm_reader *r;
    struct hm_header h;
    bool good = !hm_reader_open(&r, path, &d) && !hm_reader_next(r, &h, &d);
    const char *got_crs = good ? hm_header_get(&h, "crs") : NULL;
    const char *got_units = good ? hm_header_get(&h, "units") : NULL;
    ok(good && !strcmp(got_crs ? got_crs : "", crs) && !strcmp(got_units ? got_units : "", units),
       "%s: %s, %s", what, got_crs ? got_crs : "no crs", got_units ? got_units : "no units");
    if (good)
        hm_header_free(&h);
    hm_reader_close(r);
}

static void says_wkt(const char *what, const char *wkt, const char *crs, const char *units)
{
    says(what, 2112, wkt, strlen(wkt) + 1, crs, units);
}

static void says_keys(const char *what, const int *key, size_t n, const char *crs,
                      const char *units)
{
    char b[256];
    for (size_t k = 0; k < n; k++)
        put(b + 2 * k, (uint64_t)key[k], 2);
    says(what, 34735, b, 2 * n, crs, units);
}

static void test_las_crs(void)
{
    says_keys("GeoTIFF keys",
              (int[]){1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 25832, 3076, 0, 1, 9001}, 16,
              "EPSG:25832", "m m m 1 1 1");
    says_keys("feet, heights in metres",
              (int[]){1, 1, 0, 3, 3072, 0, 1, 2926, 3076, 0, 1, 9003, 4099, 0, 1, 9001}, 16,
              "EPSG:2926", "us-ft us-ft m 1 1 1");
    says_keys("longitude and latitude", (int[]){1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326}, 12,
              "EPSG:4326", "degree degree m 1 1 1");
    says_keys("more keys promised than there are", (int[]){1, 1, 0, 999, 3072, 0, 1, 2154}, 8,
              "EPSG:2154", "");
    says_keys("a name out of reach", (int[]){1, 1, 0, 1, 1026, 34737, 60000, 60000}, 8, "", "");
    says_wkt("WKT",
             "PROJCS[\"RGF93 / Lambert-93\",GEOGCS[\"RGF93\",DATUM[\"x\",SPHEROID[\"GRS 1980\","
             "6378137,298.257]],UNIT[\"degree\",0.0174],AUTHORITY[\"EPSG\",\"4171\"]],"
             "UNIT[\"metre\",1],AXIS[\"X\",EAST],AUTHORITY[\"EPSG\",\"2154\"]]",
             "EPSG:2154", "m m m 1 1 1");
    says_wkt("WKT, compound",
             "COMPD_CS[\"both\",PROJCS[\"Oregon, with ] and (\",GEOGCS[\"NAD83\"],"
             "UNIT[\"foot\",0.3048]],\n VERT_CS[\"NAVD88\",UNIT[\"US survey foot\","
             "0.3048006096012192]]]",
             "Oregon, with ] and (", "ft ft us-ft 1 1 1");
    says_wkt("WKT 2",
             "COMPOUNDCRS[\"a\",PROJCRS[\"b\",BASEGEOGCRS[\"c\",ID[\"EPSG\",4258]],"
             "LENGTHUNIT[\"metre\",1],ID[\"EPSG\",25832]],VERTCRS[\"h\",LENGTHUNIT[\"metre\",1]]]",
             "EPSG:25832", "m m m 1 1 1");
    says_wkt("WKT of longitude and latitude", "GEOGCS[\"WGS 84\",AUTHORITY[\"EPSG\",\"4326\"]]",
             "EPSG:4326", "degree degree m 1 1 1");
    says_wkt("WKT cut off", "PROJCS[\"x\",UNIT[\"metre\",1", "x", "");
    says_wkt("no WKT at all", "][(\"", "", "");
}

static void test_compressed(void)
{
    refused("gzip", "\x1f\x8b\x08\0\0\0\0\0", 8, HM_EFORMAT, 0, "gunzip");
    reads("a byte order mark", "\xef\xbb\xbfx,y,z\n1,2,3\n",
          "#hm 1 points text\n#fields x y z\n#data\n1 2 3\n#end 1\n");
}

int main(void)
{
    begin_files();
    test_gmt();
    test_ascii_grid();
    test_2dm();
    test_las();
    test_las_crs();
    test_compressed();
    end_files();
    return done();
}
