/* Headers: keys, fields with their units, what inputs bring into a product, and degrees refused. */
#include "hm_header.h"
#include "tap.h"

#include <string.h>

static bool is(const char *got, const char *want)
{
    return want ? got && !strcmp(got, want) : !got;
}

static void test_keys(void)
{
    struct hm_diag d = {0};
    struct hm_header h, copy;
    hm_header_init(&h, HM_POINTS, &d);
    ok(h.nfields == 3 && h.count == -1 && is(h.fields[2], "z"), "fields x y z");
    hm_header_set(&h, "crs", "UTM 32N", &d);
    hm_header_set(&h, "name", "main", &d);
    hm_header_set(&h, "crs", "UTM 33N", &d);
    ok(h.nkeys == 2 && is(h.keys[0].value, "UTM 33N"), "a key is replaced in its place");
    hm_header_add(&h, "string", "a 1 2", &d);
    hm_header_add(&h, "string", "b 3 4", &d);
    ok(h.nkeys == 4 && is(hm_header_get(&h, "string"), "a 1 2"), "a key may be there twice");
    hm_header_add_history(&h, "bsgrid 0.1", &d);
    ok(!hm_header_copy(&copy, &h, &d) && copy.nkeys == 4 && copy.nhistory == 1 &&
           is(copy.keys[3].value, "b 3 4") && copy.fields[0] != h.fields[0],
       "a copy has all of its own");
    hm_header_set(&h, "string", NULL, &d);
    hm_header_set(&h, "nothing", NULL, &d);
    ok(h.nkeys == 2 && !hm_header_get(&h, "string"), "removed, all of them");
    hm_header_set(&h, "crs", hm_header_get(&h, "crs"), &d);
    ok(is(hm_header_get(&h, "crs"), "UTM 33N"), "set to itself");
    hm_header_free(&copy);
    hm_header_free(&h);
    hm_header_init(&h, HM_MESH, &d);
    ok(h.nfields == 0 && !d.err, "a mesh has no fields");
    hm_header_free(&h);
}

static void test_fields(void)
{
    struct hm_diag d = {0};
    struct hm_header h;
    hm_header_init(&h, HM_GRID, &d);
    hm_header_add_field(&h, "count", NULL, &d);
    ok(!hm_header_get(&h, "units"), "no unit said, none invented");
    hm_header_add_field(&h, "slope", "degree", &d);
    ok(is(hm_header_get(&h, "units"), "m m m 1 degree"), "units in step with fields");
    hm_header_add_field(&h, "class", NULL, &d);
    ok(is(hm_header_get(&h, "units"), "m m m 1 degree 1"), "and a number without unit");
    char unit[4];
    hm_header_unit(&h, 4, unit, sizeof unit);
    ok(is(unit, "deg"), "the unit of a column, cut to size");
    hm_header_set(&h, "units", "ft", &d);
    hm_header_unit(&h, 2, unit, sizeof unit);
    ok(is(unit, "m"), "of one that has none said, the usual");
    hm_header_unit(&h, 4, unit, sizeof unit);
    ok(is(unit, "1"), "a number, if it is not a coordinate");
    ok(hm_header_field(&h, "slope") == 4 && hm_header_field(&h, "aspect") == -1, "found by name");
    hm_header_free(&h);
}

static void test_merge(void)
{
    struct hm_diag d = {0};
    struct hm_header grid, mesh, other;
    hm_header_init(&grid, HM_GRID, &d);
    hm_header_add_field(&grid, "slope", "degree", &d);
    hm_header_set(&grid, "crs", "UTM 32N", &d);
    hm_header_set(&grid, "survey", "2024", &d);
    hm_header_add_history(&grid, "bsgrid 0.1", &d);
    hm_header_add_history(&grid, "slope 0.1", &d);
    hm_header_init(&other, HM_MESH, &d);
    hm_header_set(&other, "name", "main", &d);
    hm_header_set(&other, "role", "regular", &d);
    hm_header_add(&other, "string", "in 1 2", &d);
    hm_header_add(&other, "note", "one", &d);
    hm_header_add(&other, "note", "two", &d);
    hm_header_set(&other, "survey", "1999", &d);
    hm_header_add_history(&other, "bsgrid 0.1", &d);
    hm_header_add_history(&other, "bsmesh 0.1", &d);
    hm_header_init(&mesh, HM_MESH, &d);
    ok(!hm_header_merge(&mesh, &grid, &d) && !hm_header_merge(&mesh, &other, &d), "merged");
    ok(is(hm_header_get(&mesh, "units"), "m m m"), "units of x y z");
    ok(is(hm_header_get(&mesh, "survey"), "2024"), "the first input wins");
    ok(mesh.nhistory == 3 && is(mesh.history[2], "bsmesh 0.1"),
       "histories in order, each line once");
    ok(!hm_header_get(&mesh, "name") && !hm_header_get(&mesh, "role") &&
           !hm_header_get(&mesh, "string"),
       "not what holds for one object alone");
    ok(mesh.nkeys == 5 && is(mesh.keys[4].value, "two"), "a key with two lines comes over whole");
    hm_header_set(&other, "crs", "UTM 33N", &d);
    ok(hm_header_merge(&mesh, &other, &d) == HM_EFORMAT && strstr(d.text, "UTM 33N"),
       "another crs");
    hm_header_free(&grid);
    hm_header_free(&mesh);
    hm_header_free(&other);
}

/* The history of a header, its lines joined by blanks. */
static const char *history(const struct hm_header *h)
{
    static char text[256];
    text[0] = '\0';
    for (size_t i = 0; i < h->nhistory; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", i ? " " : "",
                 h->history[i]);
    return text;
}

static struct hm_header with_history(const char *const *lines)
{
    struct hm_header h;
    hm_header_init(&h, HM_MESH, NULL);
    for (; *lines; lines++)
        hm_header_add_history(&h, *lines, NULL);
    return h;
}

static void test_histories(void)
{
    struct hm_header river = with_history((const char *[]){"bsgrid", "bsmesh", "stitch", NULL});
    struct hm_header twice = with_history((const char *[]){"bsgrid", "slope", "slope", NULL});
    struct hm_header hybrid =
        with_history((const char *[]){"bsgrid", "bsmesh", "stitch", "trimesh", "stitch", NULL});
    struct hm_header h = with_history((const char *[]){NULL});
    hm_header_merge(&h, &hybrid, NULL);
    ok(is(history(&h), "bsgrid bsmesh stitch trimesh stitch"), "equal stages of one input stay: %s",
       history(&h));
    hm_header_merge(&h, &hybrid, NULL);
    ok(h.nhistory == 5, "the same input again adds nothing: %s", history(&h));
    hm_header_merge(&h, &river, NULL);
    ok(h.nhistory == 5, "nor does one that it came from: %s", history(&h));
    hm_header_merge(&h, &twice, NULL);
    ok(is(history(&h), "bsgrid bsmesh stitch trimesh stitch slope slope"),
       "another past comes over whole, the common line once: %s", history(&h));
    hm_header_free(&river);
    hm_header_free(&twice);
    hm_header_free(&hybrid);
    hm_header_free(&h);
}

static void test_metres(void)
{
    static const char *const degrees[] = {"EPSG:4326",
                                          "epsg:4326 ",
                                          "WGS84",
                                          "WGS 84",
                                          "longitude latitude",
                                          "lon/lat",
                                          "+proj=longlat +datum=WGS84",
                                          "geographic, NAD83",
                                          "degrees",
                                          "ETRS89",
                                          "GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174]]"};
    static const char *const metres[] = {
        "UTM 32N WGS84",
        "EPSG:32632",
        "EPSG:43260",
        "Lambert-93",
        "PROJCS[\"UTM 32N\",GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174]]]",
        "+proj=utm +zone=32 +datum=WGS84",
        "CGCS2000 / 3-degree Gauss-Kruger zone 37",
        ""};
    struct hm_header h;
    struct hm_diag d = {0};
    hm_header_init(&h, HM_POINTS, &d);
    ok(!hm_header_need_metres(&h, &d), "no crs");
    for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++) {
        struct hm_diag why = {0};
        hm_header_set(&h, "crs", degrees[i], &d);
        ok(hm_header_need_metres(&h, &why) == HM_EFORMAT && strstr(why.text, "georef"),
           "refused: %s", degrees[i]);
    }
    for (size_t i = 0; i < sizeof metres / sizeof *metres; i++) {
        hm_header_set(&h, "crs", metres[i], &d);
        ok(!hm_header_need_metres(&h, &d), "taken: %s", metres[i]);
    }
    hm_header_set(&h, "units", "degree degree m", &d);
    ok(hm_header_need_metres(&h, NULL) == HM_EFORMAT, "units of degrees");
    hm_header_free(&h);
}

static void test_line_breaks(void)
{
    struct hm_header h;
    struct hm_diag d = {0};
    hm_header_init(&h, HM_MESH, &d);
    ok(hm_header_set(&h, "name", "a\n#end", &d) == HM_EARG && strstr(d.text, "line break in"),
       "a line break in a value is refused");
    ok(!hm_header_get(&h, "name"), "and not kept");
    hm_header_set(&h, "name", "main", NULL);
    ok(hm_header_set(&h, "name", "a\rb", NULL) == HM_EARG &&
           !strcmp(hm_header_get(&h, "name"), "main"),
       "nor put in the place of another");
    ok(hm_header_add(&h, "a\nb", "1", NULL) == HM_EARG, "nor in the name of a key");
    hm_header_free(&h);
}

int main(void)
{
    test_keys();
    test_line_breaks();
    test_fields();
    test_merge();
    test_histories();
    test_metres();
    return done();
}
