/* georef: the coordinates of points, lines and meshes, from one system to another.
 *
 * Every place goes to longitude and latitude, and from there to where it is wanted. When the UTM
 * zone must be found first, what is read waits as longitude and latitude in a file.
 */
#define _GNU_SOURCE /* asprintf */
#include "georef/georef.h"
#include "hm_num.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum to { UTM, TM, ENU, SAME };

static struct {
    int to;
    bool to_given, inverse, mgrs;
    const char *zone, *centre, *shift, *from, *units, *geoid;
    double scale;
} cmd = {.scale = 1};

static const struct hm_option options[] = {
    {'t', "to", NULL, HM_OPT_CHOICE, &cmd.to, .help = "the system of coordinates (default utm)",
     .choices = "utm|tm|enu|same", .given = &cmd.to_given},
    {'z', "zone", "ZONE", HM_OPT_TEXT, &cmd.zone,
     .help = "utm: 32N, or N or S for UPS (default: that of the data's centre)"},
    {'c', "centre", "LON,LAT[,H]", HM_OPT_TEXT, &cmd.centre,
     .help = "tm: central meridian and origin; enu: origin and its height"},
    {'k', "scale", "K", HM_OPT_POSITIVE, &cmd.scale,
     .help = "tm: on the central meridian (default 1)"},
    {0, "shift", "X,Y", HM_OPT_TEXT, &cmd.shift,
     .help = "tm: coordinates of the centre (default 0,0)"},
    {'i', "inverse", NULL, HM_OPT_FLAG, &cmd.inverse,
     .help = "from that system (default: the #crs) to longitude and latitude"},
    {'f', "from", "XY/Z", HM_OPT_TEXT, &cmd.from,
     .help = "units that come in: m, ft or us-ft (default: #units, or m)"},
    {'u', "units", "XY/Z", HM_OPT_TEXT, &cmd.units, .help = "units to write (default m)"},
    {'g', "geoid", "MODEL", HM_OPT_TEXT, &cmd.geoid,
     .help = "heights from the ellipsoid to this geoid; with -i back", .silent = true},
    {'m', "mgrs", NULL, HM_OPT_FLAG, &cmd.mgrs, .help = "the inputs are tables of MGRS references"},
    {0}};

static const struct hm_program program = {.name = "georef",
                                          .purpose = "change the coordinate system of any stream",
                                          .operands = "[file ...]",
                                          .options = options,
                                          .needs = HM_ANY,
                                          .degrees_ok = true,
                                          .without = "K"};

/* --- units --- */

static const struct hm_unit degree = {"degree", 1, 1};

/* `ft` or `ft/m`. */
static void parse_units(struct hm_cli *cli, const char *option, const char *text,
                        const struct hm_unit **xy, const struct hm_unit **z)
{
    size_t n = strcspn(text, "/");
    *xy = hm_unit_find(text, n);
    *z = text[n] ? hm_unit_find(text + n + 1, strlen(text + n + 1)) : *xy;
    if (!*xy || !*z)
        hm_cli_die(cli, "--%s: '%s' is not m, ft or us-ft, or two of them as ft/m", option, text);
}

/* The i-th of the units that a header says. */
static const struct hm_unit *said_unit(struct hm_cli *cli, const struct hm_header *h, size_t i)
{
    const struct hm_unit *unit;
    struct hm_diag d = {0};
    if (hm_unit_of(h, i, &unit, &d))
        hm_cli_die(cli, "%s: %s; say with --from what it is", hm_reader_name(hm_cli_reader(cli)),
                   d.text);
    return unit;
}

/* --- systems --- */

/* Up to `most` numbers between commas; how many. */
static int parse_numbers(struct hm_cli *cli, const char *option, const char *text, double *v,
                         int least, int most)
{
    const char *s = text, *end = text + strlen(text);
    int n = 0;
    while (n < most && (s = hm_num_parse(s, end, &v[n])) && isfinite(v[n])) {
        n++;
        if (s == end && n >= least)
            return n;
        if (s == end || *s++ != ',')
            break;
    }
    hm_cli_die(cli, "--%s: '%s' is not %d%s numbers between commas", option, text, least,
               most > least ? " or 3" : "");
}

/* The system that the options describe. False: its zone must be found; `hemisphere` then says
 * whether all of it. */
static bool asked_system(struct hm_cli *cli, struct hm_crs *crs)
{
    bool half = false;
    *crs = (struct hm_crs){.kind = HM_CRS_UTM};
    if (cmd.to == UTM) {
        if (cmd.zone && !hm_crs_parse_zone(crs, &half, cmd.zone))
            hm_cli_die(cli, "--zone: '%s' is not a zone as 32N, 5S, 32, N or S", cmd.zone);
        return half;
    }
    double v[3] = {0};
    if (!cmd.centre)
        hm_cli_die(cli, "--to %s needs --centre", cmd.to == TM ? "tm" : "enu");
    parse_numbers(cli, "centre", cmd.centre, v, 2, cmd.to == TM ? 2 : 3);
    crs->kind = cmd.to == TM ? HM_CRS_TM : HM_CRS_ENU;
    crs->lon = v[0];
    crs->lat = v[1];
    crs->h = v[2];
    crs->scale = cmd.scale;
    if (cmd.shift) {
        parse_numbers(cli, "shift", cmd.shift, v, 2, 2);
        crs->x0 = v[0];
        crs->y0 = v[1];
    }
    return true;
}

/* The system that a header says; without any, places are longitude and latitude. False when it is
 * not known. */
static bool said_system(const struct hm_header *h, struct hm_crs *crs)
{
    const char *text = hm_header_get(h, "crs");
    struct hm_diag d = {0};
    *crs = (struct hm_crs){.kind = HM_CRS_LONLAT};
    return !text || hm_header_need_metres(h, &d) || hm_crs_parse(crs, text);
}

static bool same_system(const struct hm_crs *a, const struct hm_crs *b)
{
    char s[HM_CRS_CHARS], t[HM_CRS_CHARS];
    hm_crs_print(s, a);
    hm_crs_print(t, b);
    return !strcmp(s, t);
}

/* Where an object comes from. */
static void find_source(struct hm_cli *cli, const struct hm_header *h, struct plan *p)
{
    const char *name = hm_reader_name(hm_cli_reader(cli)), *crs = hm_header_get(h, "crs");
    bool described = cmd.inverse && cmd.to != SAME && (cmd.to_given || cmd.zone);
    if (described) {
        p->known = true;
        if (!asked_system(cli, &p->source))
            hm_cli_die(cli, "--inverse needs the zone with its hemisphere, as 32N");
        return;
    }
    p->known = said_system(h, &p->source);
    if (!p->known && !(cmd.to == SAME && !cmd.geoid))
        hm_cli_die(cli,
                   "%s: the crs \"%s\" is not one of georef's; --inverse with --zone, or --to tm "
                   "and --centre, says what it is",
                   name, crs);
    if (p->known && !crs && cmd.to == SAME && !cmd.geoid)
        p->known = false;
    if (p->known && !crs && cmd.inverse && cmd.to != SAME)
        hm_cli_die(cli, "%s: no crs is said; --zone, or --to tm or enu, says what it is", name);
}

/* --- one object --- */

static void die_grid(struct hm_cli *cli)
{
    hm_cli_die(cli,
               "%s: a grid would not stay a grid. Carry its nodes over, and make it anew: "
               "hmconv -t xyz %s | georef ... | bsgrid -d STEP",
               hm_reader_name(hm_cli_reader(cli)), hm_reader_name(hm_cli_reader(cli)));
}

static enum hm_err set_units(struct hm_header *h, const struct plan *p, struct hm_diag *d)
{
    const char *rest = hm_header_get(h, "units");
    for (int i = 0; i < 3 && rest; i++) {
        rest += strspn(rest, " \t");
        rest += strcspn(rest, " \t");
    }
    char *text = NULL;
    if (asprintf(&text, "%s %s %s%s", p->out_xy->name, p->out_xy->name, p->out_z->name,
                 rest ? rest : "") < 0)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_set(h, "units", text, d);
    for (size_t i = 3; i < h->nfields && !rest && !err; i++) {
        char *longer = NULL;
        if (asprintf(&longer, "%s 1", hm_header_get(h, "units")) < 0)
            err = hm_fail_memory(d);
        else
            err = hm_header_set(h, "units", longer, d);
        free(longer);
    }
    free(text);
    return err;
}

/* A crs of others in other units is not that crs any more. */
static enum hm_err set_crs(struct hm_header *h, const struct plan *p, struct hm_diag *d)
{
    const char *old = hm_header_get(h, "crs");
    char text[HM_CRS_CHARS], *longer = NULL;
    if (p->known) {
        hm_crs_print(text, &p->target);
        bool stays = old && same_system(&p->source, &p->target);
        return stays ? HM_OK : hm_header_set(h, "crs", text, d);
    }
    if (!old || p->in_xy == p->out_xy)
        return HM_OK;
    if (asprintf(&longer, "%s, x y in %s", old, p->out_xy->name) < 0)
        return hm_fail_memory(d);
    enum hm_err err = hm_header_set(h, "crs", longer, d);
    free(longer);
    return err;
}

/* `#geoid` says what heights stand on. */
static void set_geoid(struct hm_cli *cli, struct hm_header *h)
{
    const char *on = hm_header_get(h, "geoid"), *slash = strrchr(cmd.geoid, '/');
    const char *name = slash ? slash + 1 : cmd.geoid, *source = hm_reader_name(hm_cli_reader(cli));
    struct hm_diag d = {0};
    if (!cmd.inverse && on)
        hm_cli_die(cli, "%s: its heights stand on the geoid %s already", source, on);
    if (cmd.inverse && on && strcmp(on, name))
        hm_cli_die(cli, "%s: its heights stand on the geoid %s, not on %s", source, on, name);
    hm_cli_check(cli, hm_header_set(h, "geoid", cmd.inverse ? NULL : name, &d), &d);
}

/* Degrees that stay degrees are looked at nevertheless. */
static void open_systems(struct hm_cli *cli, struct plan *p)
{
    struct hm_diag d = {0};
    bool degrees = p->source.kind == HM_CRS_LONLAT, stays = same_system(&p->source, &p->target);
    if (!p->known || (stays && !degrees && !p->geoid))
        return;
    if (!degrees)
        hm_cli_check(cli, hm_geod_open(&p->from, &p->source, &d), &d);
    if (stays && !degrees)
        p->to = p->from;
    else
        hm_cli_check(cli, hm_geod_open(&p->to, &p->target, &d), &d);
}

static void close_systems(struct plan *p)
{
    if (p->to != p->from)
        hm_geod_close(p->to);
    hm_geod_close(p->from);
}

/* Units of both sides, for x y of an object whose systems are known to have degrees or metres. */
static void choose_units(struct hm_cli *cli, const struct hm_header *h, struct plan *p)
{
    p->in_xy = p->out_xy = p->in_z = p->out_z = &hm_unit[HM_UNIT_M];
    if (cmd.units)
        parse_units(cli, "units", cmd.units, &p->out_xy, &p->out_z);
    if (cmd.from)
        parse_units(cli, "from", cmd.from, &p->in_xy, &p->in_z);
    else
        p->in_z = said_unit(cli, h, 2);
    bool in_degrees = p->known && p->source.kind == HM_CRS_LONLAT;
    if (in_degrees)
        p->in_xy = &degree;
    else if (!cmd.from)
        p->in_xy = said_unit(cli, h, 0);
    if (!in_degrees && !cmd.from && said_unit(cli, h, 1) != p->in_xy)
        hm_cli_die(cli, "%s: x is in %s, y in %s", hm_reader_name(hm_cli_reader(cli)),
                   p->in_xy->name, said_unit(cli, h, 1)->name);
    if (p->known && p->target.kind == HM_CRS_LONLAT)
        p->out_xy = &degree;
}

/* --- objects to where they are wanted --- */

static struct hm_geoid *geoid; /* NULL: heights stay */

static void carry(struct hm_cli *cli, struct hm_reader *r, struct hm_header *h, struct plan *p,
                  struct hm_writer *w, struct extent *extent)
{
    struct hm_diag d = {0};
    open_systems(cli, p);
    enum hm_err err = set_crs(h, p, &d);
    if (!err)
        err = set_units(h, p, &d);
    if (!err)
        err = georef_carry(r, h, w, p, hm_cli_threads(cli), extent, &d);
    if (err && !d.source[0] && r == hm_cli_reader(cli))
        snprintf(d.source, sizeof d.source, "%s", hm_reader_name(r));
    hm_cli_check(cli, err, &d);
    close_systems(p);
}

/* All inputs to w: to `target`, or, when that is NULL, to longitude and latitude in metres of
 * height for a second reading. */
static void carry_inputs(struct hm_cli *cli, const struct hm_crs *target, struct hm_writer *w,
                         struct extent *extent)
{
    struct hm_header h;
    while (hm_cli_next(cli, &h)) {
        struct plan p = {.geoid = geoid, .geoid_sign = cmd.inverse ? 1 : -1};
        struct hm_diag d = {0};
        if (h.kind == HM_GRID)
            die_grid(cli);
        find_source(cli, &h, &p);
        p.target = (struct hm_crs){.kind = HM_CRS_LONLAT};
        if (target)
            p.target = *target;
        else if (cmd.to == SAME)
            p.target = p.source;
        choose_units(cli, &h, &p);
        if (extent)
            p.out_z = &hm_unit[HM_UNIT_M];
        if (geoid && p.source.kind == HM_CRS_ENU && cmd.to == SAME)
            hm_cli_die(cli, "up is no height: --geoid cannot be used on east, north, up");
        if (geoid)
            set_geoid(cli, &h);
        if (!extent)
            hm_cli_check(cli, hm_header_add_history(&h, hm_cli_history(cli), &d), &d);
        carry(cli, hm_cli_reader(cli), &h, &p, w, extent);
        hm_header_free(&h);
    }
}

/* --- the second reading --- */

static const char spool_name[] = "the places read";

/* What waits goes to a file without a name; a descriptor of it, to be read from the beginning. */
static int fill_spool(struct hm_cli *cli, struct extent *extent)
{
    const struct hm_format binary = {.binary = true};
    struct hm_diag d = {0};
    struct hm_writer *w;
    int spool = hm_cli_spool(cli), copy = dup(spool);
    if (copy < 0)
        hm_cli_die(cli, "%s: %s", spool_name, strerror(errno));
    hm_cli_check(cli, hm_writer_open_fd(&w, copy, spool_name, binary, &d), &d);
    if (cmd.mgrs) {
        char **operand;
        size_t n = hm_cli_operands(cli, &operand);
        for (size_t k = 0; k < n; k++)
            hm_cli_check(cli, georef_read_mgrs(operand[k], w, extent, &d), &d);
    } else {
        carry_inputs(cli, NULL, w, extent);
    }
    hm_cli_check(cli, hm_writer_close(&w, &d), &d);
    if (lseek(spool, 0, SEEK_SET))
        hm_cli_die(cli, "%s: %s", spool_name, strerror(errno));
    return spool;
}

/* The zone of the middle of all, or its hemisphere when the zone was given. */
static void find_zone(struct hm_cli *cli, const struct extent *e, struct hm_crs *target)
{
    struct hm_diag d = {0};
    struct hm_crs found;
    double lat = (e->south + e->north) / 2;
    if (!e->any)
        hm_cli_die(cli, "no places to find a zone by; --zone gives one");
    hm_cli_check(cli, hm_geod_zone(&found, (e->west + e->east) / 2, lat, &d), &d);
    if (target->zone)
        target->north = lat >= 0;
    else
        *target = found;
    char text[HM_CRS_CHARS];
    hm_crs_print(text, target);
    if (hm_cli_verbose(cli))
        hm_cli_say(cli, "%s", text);
}

static void carry_spool(struct hm_cli *cli, int spool, const struct hm_crs *target)
{
    struct hm_reader *r;
    struct hm_header h;
    struct hm_diag d = {0};
    enum hm_err err;
    hm_cli_check(cli, hm_reader_open_fd(&r, spool, spool_name, &d), &d);
    while (!(err = hm_reader_next(r, &h, &d))) {
        struct plan p = {.known = true, .source = {.kind = HM_CRS_LONLAT}, .target = *target};
        p.in_xy = &degree;
        p.in_z = p.out_xy = p.out_z = &hm_unit[HM_UNIT_M];
        if (cmd.units)
            parse_units(cli, "units", cmd.units, &p.out_xy, &p.out_z);
        if (target->kind == HM_CRS_LONLAT)
            p.out_xy = &degree;
        hm_cli_check(cli, hm_header_add_history(&h, hm_cli_history(cli), &d), &d);
        carry(cli, r, &h, &p, hm_cli_writer(cli), NULL);
        hm_header_free(&h);
    }
    hm_cli_check(cli, err, &d);
    hm_reader_close(r);
}

/* --- what was asked --- */

static void check_options(struct hm_cli *cli)
{
    static const char *const names[] = {"utm", "tm", "enu", "same"};
    if (cmd.zone && cmd.to != UTM)
        hm_cli_die(cli, "--zone is for --to utm");
    if (cmd.centre && cmd.to != TM && cmd.to != ENU)
        hm_cli_die(cli, "--centre is for --to tm or enu");
    if ((cmd.shift || cmd.scale != 1) && cmd.to != TM)
        hm_cli_die(cli, "--scale and --shift are for --to tm");
    if (cmd.geoid && cmd.to == ENU)
        hm_cli_die(cli, "--geoid and --to enu exclude each other: up is no height");
    const struct hm_unit *xy, *z;
    if (cmd.units)
        parse_units(cli, "units", cmd.units, &xy, &z);
    if (cmd.from)
        parse_units(cli, "from", cmd.from, &xy, &z);
    if (cmd.mgrs && (cmd.to == SAME || cmd.from))
        hm_cli_die(cli, "--mgrs excludes --%s", cmd.from ? "from" : names[cmd.to]);
    if (cmd.mgrs && cmd.geoid)
        hm_cli_die(cli, "--mgrs excludes --geoid; pipe through georef once more");
}

int main(int argc, char **argv)
{
    struct hm_cli *cli = hm_cli_start(&program, argc, argv);
    struct hm_diag d = {0};
    struct hm_crs target = {.kind = HM_CRS_LONLAT};
    bool whole = true;
    check_options(cli);
    if (cmd.geoid)
        hm_cli_check(cli, hm_geoid_open(&geoid, cmd.geoid, &d), &d);
    if (!cmd.inverse && cmd.to != SAME)
        whole = asked_system(cli, &target);
    if (whole && !cmd.mgrs) {
        bool named = cmd.to != SAME && !cmd.inverse;
        carry_inputs(cli, named ? &target : NULL, hm_cli_writer(cli), NULL);
    } else {
        struct extent extent = {0};
        int spool = fill_spool(cli, &extent);
        if (!whole)
            find_zone(cli, &extent, &target);
        carry_spool(cli, spool, &target);
    }
    hm_geoid_close(geoid);
    return hm_cli_finish(cli);
}
