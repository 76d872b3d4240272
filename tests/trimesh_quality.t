#!/bin/sh
# trimesh -m quality: its angles and areas measured apart from it, what stays whole, what is said,
# what is refused.
. "${0%/*}/tap.sh"

# measure MESH [REGION]: triangles, smallest angle (degrees), largest area, whole area
measure() {
    awk -v only="${2--1}" '
        function angle(i, j, k) {
            ax = x[j] - x[i]; ay = y[j] - y[i]; bx = x[k] - x[i]; by = y[k] - y[i]
            return atan2(ax * by - ay * bx, ax * bx + ay * by) * 180 / 3.14159265358979
        }
        /^v/ { if (!n) { x0 = $2; y0 = $3 } x[n + 0] = $2 - x0; y[n + 0] = $3 - y0; n++ }
        /^t/ && (only < 0 || $5 == only) {
            a = ((x[$3] - x[$2]) * (y[$4] - y[$2]) - (y[$3] - y[$2]) * (x[$4] - x[$2])) / 2
            sum += a; tris++
            if (a > large) large = a
            for (i = 0; i < 3; i++) {
                g = angle($(2 + i), $(2 + (i + 1) % 3), $(2 + (i + 2) % 3))
                if (tris == 1 && i == 0 || g < least) least = g
            }
        }
        END { printf "%d %.9f %.12g %.12g\n", tris, least, large, sum }' "$1"
}
# holds NAME "MESH [REGION]" CONDITION: on n, angle, area, whole
holds() {
    set -- "$1" "$(measure $2)" "$3"
    echo "$2" | awk "{ n = \$1; angle = \$2; area = \$3; whole = \$4; exit !($3) }"
    tap_status=$?
    report $tap_status "$1"
    [ $tap_status -eq 0 ] || echo "# $2"
}

awk 'BEGIN { for (j = 0; j < 41; j++) for (i = 0; i < 41; i++) print i, j, i + 2 * j }' >plane.xyz
printf '> boundary=1 closed=1\n3 3 0\n37 5 0\n35 36 0\n6 34 0\n' >outline.txt
printf '> boundary=1 closed=1\n3 3\n37 5\n35 36\n6 34\n> hole=1 closed=1\n20 20\n24 20.5\n22 25\n' >holed.txt

ok "an outline, 20 degrees" trimesh -m quality outline.txt plane.xyz -o plain.hm
holds "no angle is smaller" plain.hm 'angle >= 20'
holds "it covers the outline" plain.hm '(whole - 975.5) ^ 2 < 1e-12'
ok "30 degrees, 2 m2, around a hole" trimesh -m quality -q 30 -a 2 holed.txt plane.xyz -o fine.hm
holds "no angle is smaller, no area larger" fine.hm 'angle >= 30 && area <= 2 && n > whole / 2 && n < 1000'
holds "the hole is left out" fine.hm '(whole - 975.5 + 9.5) ^ 2 < 1e-12'
true_that "all nodes lie on the terrain" \
    "$(awk '/^v/ && ($4 - $2 - 2 * $3) ^ 2 > 1e-20' fine.hm | wc -l) == 0"
trimesh -m quality -a 5 plane.xyz >hull.hm
holds "without an outline the hull of the measurements" hull.hm \
    'angle >= 20 && area <= 5 && whole == 1600'

printf '>\n10 10 100\n30 20 140\n' >line.txt

# --- regions ---

printf '> region=3 max_area=0.5 closed=1\n10 10\n16 11\n15 17\n> region=3 closed=1\n25 25\n30 25\n30 30\n' >regions.txt
ok "regions" trimesh -m quality -a 4 outline.txt regions.txt plane.xyz -o regions.hm
holds "one material, two areas" "regions.hm 3" 'area <= 4 && area > 0.5 && (whole - 31) ^ 2 < 1e-9'
holds "the size of its own holds" "regions.hm 3" 'angle >= 20 && n > 50'
holds "elsewhere the general one" "regions.hm 0" 'area <= 4 && area > 2'
printf '> region=3 max_area=6 closed=1\n10 10\n16 11\n15 27\n' >coarse.txt
trimesh -m quality -a 1 outline.txt coarse.txt plane.xyz >coarse.hm
holds "or a larger one" "coarse.hm 3" 'area <= 6 && area > 1'
printf '> region=3 max_area=-1 closed=1\n10 10\n16 11\n15 17\n' >bad.txt
must_fail "no area below nothing" 2 'max_area=-1 is not an area' \
    trimesh -m quality outline.txt bad.txt plane.xyz

# --- lengths, and sizes by place ---

# edges MESH CONDITION: how many edges meet a condition on x, y (of the middle) and length
edges() {
    awk '/^v/ { x[n + 0] = $2; y[n + 0] = $3; n++ }
        /^t/ { for (i = 2; i < 5; i++) { a = $i; b = $(i == 4 ? 2 : i + 1)
            print (x[a] + x[b]) / 2, (y[a] + y[b]) / 2, sqrt((x[a] - x[b]) ^ 2 + (y[a] - y[b]) ^ 2) } }' "$1" |
        awk "{ x = \$1; y = \$2; long = \$3 } $2" | wc -l
}
ok "edges up to 3 m" trimesh -m quality -L 3 outline.txt line.txt plane.xyz -o long.hm
true_that "none is longer, and many nearly as long" "$(edges long.hm 'long > 3') == 0 && $(edges long.hm 'long > 2.4') > 100"
holds "and no angle is small" long.hm 'angle >= 20'
sizes() { # a grid 10 m apart, 0 .. 40: 0.6 m at one node in the middle, 8 m elsewhere; nothing east of 35
    printf '#hm 1 grid text\n#size 5 5\n#origin 0 0\n#step 10 10\n#fields x y z size\n#data\n'
    awk -v small="$1" 'BEGIN { for (j = 0; j < 5; j++) for (i = 0; i < 5; i++)
        print 10 * i, 10 * j, 7, i == 2 && j == 2 ? small : i == 4 ? "nan" : 8 }'
    echo '#end'
}
sizes 0.6 >sizes.hm
ok "a grid of sizes" trimesh -m quality -s sizes.hm outline.txt plane.xyz -o sized.hm
true_that "small where it says so" "$(edges sized.hm '(x - 20) ^ 2 + (y - 20) ^ 2 < 1 && long > 1.5') == 0"
true_that "nowhere over it" "$(edges sized.hm 'long > 12') == 0"
true_that "large away from there" "$(edges sized.hm '(x - 20) ^ 2 + (y - 20) ^ 2 > 100 && long > 4') > 20"
true_that "its heights are none" "$(awk '/^v/ && ($4 - $2 - 2 * $3) ^ 2 > 1e-20' sized.hm | wc -l) == 0"
sizes 0 >zero.hm
must_fail "a size of nothing" 2 '0 is not an edge length.* 20 20' trimesh -m quality -s zero.hm outline.txt plane.xyz
sizes 1e-7 >tiny.hm
must_fail "a size beyond all memory" 2 'makes? about' trimesh -m quality -s tiny.hm outline.txt plane.xyz
must_fail "sizes that are no grid" 2 'not a grid' trimesh -m quality -s plane.xyz outline.txt plane.xyz
must_fail "that are not there" 2 'missing.hm' trimesh -m quality -s missing.hm outline.txt plane.xyz

# --- gradation ---

# uneven MESH ...: pairs of elements of which one has over twice the area of the other, in one mesh or
# in several that share nodes by coordinate
uneven() {
    awk '/^#hm/ { base = n + 0 }
        /^v/ { p = $2 " " $3; if (!(p in at)) { at[p] = m + 0; x[m + 0] = $2; y[m + 0] = $3; m++ }
            v[n + 0] = at[p]; n++ }
        /^[tq]/ { k = $1 == "t" ? 3 : 4; a = 0
            for (i = 0; i < k; i++) c[i] = v[base + $(2 + i)]
            for (i = 0; i < k; i++) { j = (i + 1) % k
                a += (x[c[i]] - x[0]) * (y[c[j]] - y[0]) - (x[c[j]] - x[0]) * (y[c[i]] - y[0]) }
            for (i = 0; i < k; i++) { j = (i + 1) % k
                e = c[i] < c[j] ? c[i] " " c[j] : c[j] " " c[i]
                if (!(e in area)) area[e] = a
                else if (a > 2 * area[e] || area[e] > 2 * a) bad++ } }
        END { print bad + 0 }' "$@"
}
printf '> boundary=1 closed=1\n3 3\n37 5\n35 36\n6 34\n> hole=1 closed=1\n20 20\n20.2 20\n20.2 20.2\n20 20.2\n' >speck.txt
trimesh -m quality -g 0 speck.txt plane.xyz >any.hm
trimesh -m quality speck.txt plane.xyz >graded.hm
true_that "around a speck angles alone leave large beside small" "$(uneven any.hm) > 5"
true_that "gradation leaves none over twice its neighbour" "$(uneven graded.hm) == 0"
holds "nor a small angle" graded.hm 'angle >= 20 && n < 400'
trimesh -m quality -q 30 -a 3 speck.txt regions.txt plane.xyz >graded.hm
true_that "nor with sizes and regions" "$(uneven graded.hm) == 0"
holds "which hold as well" graded.hm 'angle >= 30 && area <= 3'
holds "also of the region" "graded.hm 3" 'area <= 3'
must_fail "a gradation under 1" 2 'gradation of 0.5' trimesh -m quality -g 0.5 plane.xyz
must_fail "none for the paper's mesh" 2 '-g means nothing' trimesh -l 2 -g 2 plane.xyz

# --- breaklines ---

ok "a breakline" trimesh -m quality -a 3 outline.txt line.txt plane.xyz -o line.hm
true_that "is split, and its new nodes have its height" "$(awk '
    /^v/ && int($5 / 2) % 2 { n++; if (($4 - 100 - 2 * ($2 - 10)) ^ 2 > 1e-18) bad++ }
    END { print (n > 5 && !bad) }' line.hm)"
printf '>\n5 10 0\n30 10 0\n>\n5 10 0\n30 10.8 0\n' >needle.txt
trimesh -m quality outline.txt needle.txt plane.xyz >needle.hm 2>said
ok "a needle between two lines is said, with its place" \
    grep -Eq '^trimesh: [1-9][0-9]* elements under 20 degrees .* smallest, 1\.83 degrees, at ' said
holds "it is no worse than they are" needle.hm 'angle > 1.83 && n < 1500'

# --- beside a regular mesh ---

hmsurvey -n 20000 . >/dev/null
bsgrid --quiet -d 2 survey.xyz | slope | breaklines --quiet -w 0 -s 8 -l 30 -r 6 >breaklines.hm
bsmesh --quiet -s main -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz >main.hm
for j in 1 2; do
    trimesh --quiet -m quality -q 25 -a 22 -j $j survey.xyz breaklines.hm lines.txt main.hm >flood$j.hm
done
same "the same bytes with one thread and two" flood1.hm flood2.hm
awk '/^#/ { next } { print | "sort -k2,2 -k1,1" }' survey.xyz >shuffled.xyz
trimesh --quiet -m quality -q 25 -a 22 shuffled.xyz breaklines.hm lines.txt main.hm >flood.hm
grep '^[vt]' flood.hm >a
grep '^[vt]' flood1.hm >b
same "and in another order of the measurements" a b
ok "its boundary stays whole: both make one mesh" sh -c 'stitch --quiet main.hm flood1.hm >hybrid.hm'
trimesh -m quality -q 25 -a 22 -g 0 survey.xyz breaklines.hm lines.txt main.hm 2>said >flood.hm
# free_small MESH ANGLE: elements with a smaller angle and without any fixed node
free_small() {
    awk -v least="$2" '
        function angle(i, j, k) {
            ax = x[j] - x[i]; ay = y[j] - y[i]; bx = x[k] - x[i]; by = y[k] - y[i]
            return atan2(ax * by - ay * bx, ax * bx + ay * by) * 180 / 3.14159265358979
        }
        /^v/ { x[n + 0] = $2; y[n + 0] = $3; fixed[n + 0] = $6 > 0 || int($5 / 4) % 2; n++ }
        /^t/ && !fixed[$2] && !fixed[$3] && !fixed[$4] &&
            (angle($2, $3, $4) < least || angle($3, $4, $2) < least || angle($4, $2, $3) < least) { bad++ }
        END { print bad + 0 }' "$1"
}
true_that "angles under 25 degrees are left at lines and regular meshes only" "$(free_small flood1.hm 24.9999) == 0"
true_that "gradation: across the seam, too, few elements are over twice their neighbour" \
    "$(uneven flood1.hm main.hm) * 50 < $(uneven flood.hm main.hm) * 4"
holds "and no angle is bad" flood1.hm 'angle > 9'
ok "and are said" grep -q 'under 25 degrees left' said
holds "and none is bad" flood.hm 'angle > 10'
ok "measurements are no nodes: none is left out" sh -c '! grep measurements said'

# lines as breaklines makes them as a rule; one has a spike of 7 degrees
bsgrid --quiet -d 2 survey.xyz | slope | breaklines --quiet -s 8 -l 30 -r 6 >breaklines.hm
bsmesh --quiet -s main -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz >main.hm
trimesh -m quality -q 25 -a 22 survey.xyz breaklines.hm lines.txt main.hm 2>said >flood.hm
holds "nor is any angle bad where lines are smoothed" flood.hm 'angle > 11'
# small MESH: as it says itself, elements under 25 degrees and the smallest angle
small() {
    awk 'function angle(i, j, k) {
            ax = x[j] - x[i]; ay = y[j] - y[i]; bx = x[k] - x[i]; by = y[k] - y[i]
            return atan2(ax * by - ay * bx, ax * bx + ay * by) * 180 / 3.14159265358979 }
        /^v/ { x[n + 0] = $2; y[n + 0] = $3; n++ }
        /^t/ { least = 180
            for (i = 0; i < 3; i++) {
                g = angle($(2 + i), $(2 + (i + 1) % 3), $(2 + (i + 2) % 3))
                if (g < least) least = g }
            bad += least < 25 - 1e-9
            if (!smallest || least < smallest) smallest = least }
        END { printf "%d %.3g\n", bad, smallest }' "$1"
}
small flood.hm >a
sed -n 's/^trimesh: \([0-9]*\) elements under 25 degrees .* smallest, \([0-9.]*\) degrees, .*/\1 \2/p' said >b
same "what is said of angles is what the mesh has" a b

# --- refusals ---

must_fail "an angle that cannot be reached" 2 '0 to 34' trimesh -m quality -q 35 plane.xyz
must_fail "no area" 2 'max-area' trimesh -m quality -a 0 plane.xyz
must_fail "a mesh beyond all memory" 2 'makes? about .* nodes' trimesh -m quality -a 1e-7 plane.xyz
must_fail "an angle for the paper's mesh" 2 '-q means nothing' trimesh -l 2 -q 20 plane.xyz
must_fail "lengths for this one" 2 '-l means nothing' trimesh -m quality -l 2 plane.xyz
printf '> boundary=1 closed=1\n100 100\n120 100\n120 120\n' >away.txt
must_fail "no points inside" 2 'no measurement lies inside' trimesh -m quality plane.xyz away.txt
must_fail "no heights" 2 'height' trimesh -m quality outline.txt
: >empty
must_fail "nothing" 2 'empty' trimesh -m quality empty

# --- real terrain ---

if need_data danube_deggendorf/points.xyz; then
    ok "Danube" trimesh -m quality -q 30 -a 200 "$DATA/danube_deggendorf/points.xyz" -o danube.hm
    holds "30 degrees, 200 m2" danube.hm 'angle >= 30 && area <= 200'
fi
done_testing
