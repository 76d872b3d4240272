#include "hm_rough.h"

#include "hm_attr.h"
#include "hm_num.h"
#include "hm_plane.h"
#include "hm_polyline.h"
#include "hm_role.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const side_name[HM_SIDES] = {"left", "right", "inflow", "outflow"};

/* --- sizes --- */

/* One number, > 0, at *text, which moves behind it. */
static bool parse_length(const char **text, double *value)
{
    const char *end = hm_num_parse(*text, *text + strlen(*text), value);
    if (!end || !isfinite(*value) || !(*value > 0))
        return false;
    *text = end;
    return true;
}

static enum hm_err parse_fractions(const char *text, struct hm_rough_size *size, struct hm_diag *d)
{
    double f[HM_ROUGH_FRACTIONS];
    size_t n = hm_num_parse_list(text, ',', f, HM_ROUGH_FRACTIONS);
    bool good = n > 1 && f[0] == 0 && f[n - 1] == 1;
    for (size_t k = 1; good && k < n; k++)
        good = f[k] > f[k - 1];
    if (!good)
        return hm_fail(d, HM_EFORMAT,
                       "fractions across '%s' do not rise from 0 to 1, as in 0,.1,.3,.7,.9,1 (at "
                       "most %d of them)",
                       text, HM_ROUGH_FRACTIONS);
    memcpy(size->fraction, f, n * sizeof *f);
    size->nfractions = n;
    size->across = 0;
    return HM_OK;
}

enum hm_err hm_rough_parse_across(const char *text, struct hm_rough_size *size, struct hm_diag *d)
{
    if (strchr(text, ','))
        return parse_fractions(text, size, d);
    const char *p = text;
    double across;
    if (!parse_length(&p, &across) || *p)
        return hm_fail(d, HM_EFORMAT,
                       "'%s' is neither a distance across, in metres, nor a list of fractions",
                       text);
    size->across = across;
    size->nfractions = 0;
    return HM_OK;
}

enum hm_err hm_rough_parse_control(const char *text, struct hm_rough_size *size, struct hm_diag *d)
{
    const char *p = text;
    double along;
    if (!parse_length(&p, &along) || (*p && *p != '/'))
        return hm_fail(d, HM_EFORMAT,
                       "'%s' is no distance of control points ALONG/ACROSS, as in 10/8", text);
    size->along = size->across = along;
    size->nfractions = 0;
    return *p ? hm_rough_parse_across(p + 1, size, d) : HM_OK;
}

enum hm_err hm_rough_parse_elements(const char *text, struct hm_rough_size *size, struct hm_diag *d)
{
    double length[2];
    size_t n = hm_num_parse_list(text, '/', length, 2);
    if (n == 0 || !(length[0] > 0) || !(length[n - 1] > 0))
        return hm_fail(d, HM_EFORMAT, "'%s' is no length of elements ALONG/ACROSS, as in 8/3",
                       text);
    size->elem_along = length[0];
    size->elem_across = length[n - 1];
    return HM_OK;
}

/* along= and snap=: a number that is in order. */
static enum hm_err read_length(const char *attrs, const char *key, bool zero, double *value,
                               struct hm_diag *d)
{
    enum hm_err err = hm_attr_number(attrs, key, *value, value, d);
    if (!err && !(isfinite(*value) && (*value > 0 || (zero && *value == 0))))
        err = hm_fail(d, HM_EFORMAT, "%s=%g is no distance in metres", key, *value);
    return err;
}

static bool same_across(const struct hm_rough_size *a, const struct hm_rough_size *b)
{
    return a->across == b->across && a->nfractions == b->nfractions &&
           !memcmp(a->fraction, b->fraction, a->nfractions * sizeof *a->fraction);
}

/* The attributes of one of its lines that override the sizes of a surface. Two lines must not say
 * different things. */
static enum hm_err read_sizes(struct hm_rough *r, const char *attrs, struct hm_diag *d)
{
    static const char *const key[] = {"along", "snap", "across", "elements", "bend"};
    char text[512];
    struct hm_rough_size now = r->size;
    enum hm_err err = HM_OK;
    for (int k = 0; !err && k < 5; k++) {
        if (!hm_attr_get(attrs, key[k], text, sizeof text))
            continue;
        err = k == 0   ? read_length(attrs, key[k], false, &now.along, d)
              : k == 1 ? read_length(attrs, key[k], true, &now.snap, d)
              : k == 2 ? hm_rough_parse_across(text, &now, d)
              : k == 4 ? hm_attr_number(attrs, key[k], 0, &now.bend, d)
                       : hm_rough_parse_elements(text, &now, d);
        if (!err && !(now.bend >= 0 && now.bend <= 180))
            err = hm_fail(d, HM_EFORMAT, "bend=%s is no angle from 0 to 180 degrees", text);
        bool same = now.bend == r->size.bend && now.along == r->size.along &&
                    now.snap == r->size.snap && same_across(&now, &r->size) &&
                    now.elem_along == r->size.elem_along && now.elem_across == r->size.elem_across;
        if (!err && (r->said & 1U << k) && !same)
            err = hm_fail(d, HM_EFORMAT,
                          "%s=%s contradicts another line of surface '%s'; one of them is enough",
                          key[k], text, r->name);
        r->said |= 1U << k;
        r->size = now;
    }
    return err;
}

/* --- collecting the sides --- */

static enum hm_err copy_side(struct hm_line *to, const struct hm_line *from, struct hm_diag *d)
{
    to->xyz = hm_alloc(from->n, 3 * sizeof *to->xyz);
    if (!to->xyz)
        return hm_fail_memory(d);
    memcpy(to->xyz, from->xyz, from->n * 3 * sizeof *to->xyz);
    to->n = from->n;
    return HM_OK;
}

static enum hm_err find_surface(const char *name, const struct hm_rough_size *defaults,
                                struct hm_rough **list, size_t *count, struct hm_rough **found,
                                struct hm_diag *d)
{
    for (size_t k = 0; k < *count; k++)
        if (!strcmp((*list)[k].name, name)) {
            *found = &(*list)[k];
            return HM_OK;
        }
    struct hm_rough *more = hm_alloc(*count + 1, sizeof **list);
    if (!more)
        return hm_fail_memory(d);
    if (*count > 0)
        memcpy(more, *list, *count * sizeof *more);
    free(*list);
    *list = more;
    *found = &more[(*count)++];
    **found = (struct hm_rough){.number = (int32_t)*count, .size = *defaults};
    memcpy((*found)->name, name, strlen(name) + 1);
    return HM_OK;
}

static enum hm_err take_line(const struct hm_line *line, const struct hm_rough_size *defaults,
                             struct hm_rough **list, size_t *count, struct hm_diag *d)
{
    char name[HM_ROUGH_NAME + 1], side[16];
    double x = line->n > 0 ? line->xyz[0] : 0, y = line->n > 0 ? line->xyz[1] : 0;
    hm_attr_get(line->attrs, "surface", name, sizeof name);
    if (!name[0] || strlen(name) >= HM_ROUGH_NAME || strpbrk(name, " \t"))
        return hm_fail_at(d, HM_EFORMAT, x, y,
                          "the name of a surface is one word of at most %d letters, not '%s'",
                          HM_ROUGH_NAME - 1, name);
    int s = HM_SIDES;
    bool has_side = hm_attr_get(line->attrs, "side", side, sizeof side),
         axis = !strcmp(side, "axis");
    if (has_side && !axis)
        for (s = 0; s < HM_SIDES && strcmp(side, side_name[s]) != 0; s++)
            ;
    if (s == HM_SIDES && !axis)
        return hm_fail_at(d, HM_EFORMAT, x, y,
                          "a line of surface '%s' has side '%s': left, right, inflow, outflow or "
                          "axis",
                          name, side);
    struct hm_rough *r = NULL;
    enum hm_err err = find_surface(name, defaults, list, count, &r, d);
    if (err || axis)
        return err;
    if (r->side[s].xyz)
        return hm_fail_at(d, HM_EGEOM, x, y, "surface '%s' has two lines with side=%s", name, side);
    if (line->closed || !(hm_polyline_length(line) > 0))
        return hm_fail_at(d, HM_EGEOM, x, y, "side %s of surface '%s' is %s", side, name,
                          line->closed ? "a closed line" : "only one point");
    err = copy_side(&r->side[s], line, d);
    if (!err)
        err = read_sizes(r, line->attrs, d);
    return hm_fail_place(d, err, x, y);
}

/* --- turning them --- */

static double *first_of(const struct hm_line *line)
{
    return line->xyz;
}

static double *last_of(const struct hm_line *line)
{
    return line->xyz + 3 * (line->n - 1);
}

static double apart(const double *a, const double *b)
{
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static void reverse(struct hm_line *line)
{
    for (size_t i = 0, j = line->n - 1; i < j; i++, j--)
        for (size_t k = 0; k < 3; k++) {
            double t = line->xyz[3 * i + k];
            line->xyz[3 * i + k] = line->xyz[3 * j + k];
            line->xyz[3 * j + k] = t;
        }
}

/* Shift a section so that its ends are a and b: each vertex by the shifts of the ends, weighted by
 * its distance along the section. */
static void hang_section(struct hm_line *s, const double *a, const double *b)
{
    double length = hm_polyline_length(s), behind = 0;
    double da[2] = {a[0] - s->xyz[0], a[1] - s->xyz[1]};
    double db[2] = {b[0] - last_of(s)[0], b[1] - last_of(s)[1]};
    double before[2] = {s->xyz[0], s->xyz[1]};
    for (size_t i = 0; i < s->n; i++) {
        double *p = s->xyz + 3 * i;
        behind += apart(before, p);
        before[0] = p[0];
        before[1] = p[1];
        double t = i + 1 < s->n ? behind / length : 1;
        for (int k = 0; k < 2; k++)
            p[k] = i == 0 ? a[k] : i + 1 == s->n ? b[k] : p[k] + (1 - t) * da[k] + t * db[k];
    }
}

/* Can a drawn section be meant for the ends a and b of the banks? */
static enum hm_err check_section(const struct hm_line *s, const char *side, const char *name,
                                 const double *a, const double *b, struct hm_diag *d)
{
    const double *first = first_of(s), *last = last_of(s), width = apart(a, b);
    double far = fmax(apart(first, a), apart(last, b));
    double along = (last[0] - first[0]) * (b[0] - a[0]) + (last[1] - first[1]) * (b[1] - a[1]);
    if (along < 0.5 * apart(first, last) * width)
        return hm_fail_at(d, HM_EGEOM, first[0], first[1],
                          "the %s line of surface '%s' does not run from bank to bank", side, name);
    if (far > width)
        return hm_fail_at(d, HM_EGEOM, first[0], first[1],
                          "the %s line of surface '%s' lies %.4g m from the ends of its banks, "
                          "which are %.4g m apart",
                          side, name, far, width);
    return HM_OK;
}

static enum hm_err set_section(struct hm_rough *r, enum hm_rough_side side, const double *a,
                               const double *b, struct hm_diag *d)
{
    struct hm_line *s = &r->side[side];
    if (s->xyz) {
        if (apart(first_of(s), a) + apart(last_of(s), b) >
            apart(first_of(s), b) + apart(last_of(s), a))
            reverse(s);
        enum hm_err err = check_section(s, side_name[side], r->name, a, b, d);
        if (!err)
            hang_section(s, a, b);
        return err;
    }
    s->xyz = hm_alloc(2, 3 * sizeof *s->xyz);
    if (!s->xyz)
        return hm_fail_memory(d);
    s->n = 2;
    memcpy(s->xyz, a, 3 * sizeof *a);
    memcpy(s->xyz + 3, b, 3 * sizeof *b);
    return HM_OK;
}

/* The outline: right bank downstream, outflow, left bank upstream, inflow. Sections drawn count;
 * others are the straight lines between the banks' ends. */
static enum hm_err outline(const struct hm_rough *r, struct hm_line *ring, struct hm_diag *d)
{
    size_t most = 0;
    for (int s = 0; s < HM_SIDES; s++)
        most += r->side[s].n;
    double *p = ring->xyz = hm_alloc(most, 3 * sizeof *p);
    if (!p)
        return hm_fail_memory(d);
    ring->closed = true;
    const struct hm_line *right = &r->side[HM_RIGHT], *left = &r->side[HM_LEFT];
    const struct hm_line *in = &r->side[HM_INFLOW], *out = &r->side[HM_OUTFLOW];
    memcpy(p, right->xyz, right->n * 3 * sizeof *p);
    p += 3 * right->n;
    for (size_t i = 1; i + 1 < out->n; i++, p += 3)
        memcpy(p, out->xyz + 3 * i, 3 * sizeof *p);
    for (size_t i = left->n; i-- > 0; p += 3)
        memcpy(p, left->xyz + 3 * i, 3 * sizeof *p);
    for (size_t i = in->n; i-- > 2; p += 3)
        memcpy(p, in->xyz + 3 * (i - 1), 3 * sizeof *p);
    ring->n = (size_t)(p - ring->xyz) / 3;
    return HM_OK;
}

static bool touches(const struct hm_line *line, const double xy[2], double near)
{
    for (size_t k = 0; k < hm_polyline_pieces(line); k++) {
        if (hm_plane_distance(xy, hm_polyline_from(line, k), hm_polyline_to(line, k)) <= near)
            return true;
    }
    return false;
}

/* Is the outline simple? area2 gets twice its area. What crosses what goes to d. */
static enum hm_err check_outline(const struct hm_rough *r, double *area2, struct hm_diag *d)
{
    struct hm_line ring = {0};
    bool crosses = false;
    double xy[2];
    enum hm_err err = outline(r, &ring, d);
    if (!err) {
        *area2 = hm_polygon_area2(&ring);
        err = hm_polyline_crosses_itself(&ring, &crosses, xy, d);
    }
    if (!err && crosses) {
        double hair = 1e-9 * hm_polyline_length(&ring);
        bool left = touches(&r->side[HM_LEFT], xy, hair);
        bool right = touches(&r->side[HM_RIGHT], xy, hair);
        err = hm_fail_at(d, HM_EGEOM, xy[0], xy[1], "%s of surface '%s' %s",
                         left && right   ? "the banks"
                         : left || right ? left ? "the left bank" : "the right bank"
                                         : "the end sections",
                         r->name,
                         left && right   ? "cross"
                         : left || right ? "crosses itself or an end section"
                                         : "cross");
    }
    free(ring.xyz);
    return err;
}

/* Which way do the banks run? Beside each other with the shorter end sections, or, if their outline
 * would cross itself then, the other way. Leaves the right bank turned; *alike: it is as drawn. */
static enum hm_err pair_banks(struct hm_rough *r, double *area2, bool *alike, struct hm_diag *d)
{
    struct hm_line *left = &r->side[HM_LEFT], *right = &r->side[HM_RIGHT];
    struct hm_rough banks = *r; /* the outline without drawn sections */
    banks.side[HM_INFLOW].n = banks.side[HM_OUTFLOW].n = 0;
    *alike = apart(first_of(left), first_of(right)) + apart(last_of(left), last_of(right)) <=
             apart(first_of(left), last_of(right)) + apart(last_of(left), first_of(right));
    if (!*alike)
        reverse(right);
    struct hm_diag first = {0}, second = {0};
    enum hm_err err = check_outline(&banks, area2, &first);
    if (!err)
        return HM_OK;
    reverse(right);
    *alike = !*alike;
    if (err == HM_EGEOM && !check_outline(&banks, area2, &second))
        return HM_OK;
    if (d && !d->err)
        *d = first;
    return err;
}

static double middle_apart(const struct hm_line *section, const double *a, const double *b)
{
    double mid[3], xy[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    hm_polyline_at(section, hm_polyline_length(section) / 2, mid);
    return apart(mid, xy);
}

/* 1 when the sections drawn say that the banks run downstream as they stand, -1 upstream, 0 when no
 * section says anything, 2 when they contradict each other. */
static int flow_direction(const struct hm_rough *r)
{
    const struct hm_line *left = &r->side[HM_LEFT], *right = &r->side[HM_RIGHT];
    int said = 0;
    for (int s = HM_INFLOW; s <= HM_OUTFLOW; s++) {
        if (!r->side[s].xyz)
            continue;
        double start = middle_apart(&r->side[s], first_of(left), first_of(right));
        double end = middle_apart(&r->side[s], last_of(left), last_of(right));
        int says = (start <= end) == (s == HM_INFLOW) ? 1 : -1;
        if (said == -says)
            return 2;
        said = says;
    }
    return said;
}

/* Is left on the left, looking downstream? That is where the sections drawn say, or else the way in
 * which both banks were drawn; banks drawn against each other say nothing. */
static enum hm_err check_swapped(const struct hm_rough *r, bool alike, double area2,
                                 struct hm_diag *d)
{
    const double *left = r->side[HM_LEFT].xyz;
    int flow = flow_direction(r);
    if (flow == 2)
        return hm_fail_at(d, HM_EGEOM, left[0], left[1],
                          "inflow and outflow of surface '%s' lie at the same end", r->name);
    if ((flow > 0 && area2 < 0) || (flow < 0 && area2 > 0))
        return hm_fail_at(d, HM_EGEOM, left[0], left[1],
                          "the banks of surface '%s' are swapped: looking from its inflow to its "
                          "outflow, left lies on the right",
                          r->name);
    if (flow == 0 && alike && area2 < 0)
        return hm_fail_at(d, HM_EGEOM, left[0], left[1],
                          "the banks of surface '%s' are swapped (or drawn upstream, which a line "
                          "with side=inflow would say): left lies on the right",
                          r->name);
    return HM_OK;
}

static enum hm_err turn(struct hm_rough *r, struct hm_diag *d)
{
    struct hm_line *left = &r->side[HM_LEFT], *right = &r->side[HM_RIGHT];
    double area2 = 0;
    bool alike;
    enum hm_err err = pair_banks(r, &area2, &alike, d);
    if (!err)
        err = check_swapped(r, alike, area2, d);
    if (err)
        return err;
    if (area2 < 0) { /* left on the left tells where downstream is */
        reverse(left);
        reverse(right);
    }
    err = set_section(r, HM_INFLOW, first_of(right), first_of(left), d);
    if (!err)
        err = set_section(r, HM_OUTFLOW, last_of(right), last_of(left), d);
    return err ? err : check_outline(r, &area2, d);
}

static enum hm_err finish(struct hm_rough *r, struct hm_diag *d)
{
    const struct hm_line *left = &r->side[HM_LEFT], *right = &r->side[HM_RIGHT];
    if (!left->xyz || !right->xyz) {
        const struct hm_line *some = left->xyz ? left : right->xyz ? right : &r->side[HM_INFLOW];
        some = some->xyz ? some : &r->side[HM_OUTFLOW];
        return hm_fail_at(d, HM_EGEOM, some->xyz[0], some->xyz[1],
                          "surface '%s' has no line with side=%s", r->name,
                          left->xyz ? "right" : "left");
    }
    enum hm_err err = turn(r, d);
    double xy[2] = {right->xyz[0], right->xyz[1]};
    if (!err && !(r->size.along > 0 && (r->size.across > 0 || r->size.nfractions > 0)))
        err = hm_fail_at(d, HM_EARG, xy[0], xy[1],
                         "no distance of control points for surface '%s': give it by option or as "
                         "along= and across=",
                         r->name);
    if (!err && !(r->size.elem_along > 0))
        err = hm_fail_at(d, HM_EARG, xy[0], xy[1],
                         "no length of elements for surface '%s': give it by option or as "
                         "elements=",
                         r->name);
    if (!err && r->size.snap < 0)
        r->size.snap = r->size.along;
    return err;
}

enum hm_err hm_rough_collect(const struct hm_lines *sets, size_t n,
                             const struct hm_rough_size *defaults, struct hm_rough **list,
                             size_t *count, struct hm_diag *d)
{
    *list = NULL;
    *count = 0;
    enum hm_err err = HM_OK;
    for (size_t s = 0; !err && s < n; s++)
        for (size_t k = 0; !err && k < sets[s].n; k++)
            if (hm_role_of(sets[s].line[k].attrs) == HM_ROLE_SURFACE)
                err = take_line(&sets[s].line[k], defaults, list, count, d);
    for (size_t k = 0; !err && k < *count; k++)
        err = finish(&(*list)[k], d);
    if (err) {
        hm_rough_free(*list, *count);
        *list = NULL;
        *count = 0;
    }
    return err;
}

void hm_rough_free(struct hm_rough *list, size_t count)
{
    for (size_t k = 0; k < count; k++)
        for (int s = 0; s < HM_SIDES; s++)
            free(list[k].side[s].xyz);
    free(list);
}
