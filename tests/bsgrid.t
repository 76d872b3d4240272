#!/bin/sh
# bsgrid: start grids, dragging, gaps, windows, bad input.
. "${0%/*}/tap.sh"

# points N WIDTH HEIGHT-EXPRESSION [SEED]: seeded scattered points with z as awk says it from x and y
points() {
    awk -v n="$1" -v w="$2" -v seed="${4:-1}" 'function random() {
            seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
        BEGIN { for (i = 0; i < n; i++) { x = 1000 + w * random(); y = 2000 + w * random()
            printf "%.3f %.3f ", x, y; x = sprintf("%.3f", x) + 0; y = sprintf("%.3f", y) + 0
            printf "%.17g\n", '"$3"' } }'
}
# column F FILE: the numbers of a column of a grid, without the missing
column() { awk -v f="$1" '!/^#/ && $f != "nan" { print $f }' "$2"; }
# worst FILE WANT: the largest difference of z from an expression in x and y
worst() {
    awk '!/^#/ && $3 != "nan" { x = $1; y = $2; e = $3 - ('"$2"'); if (e < 0) e = -e; if (e > m) m = e; n++ }
        END { printf "%.3g", n ? m : 1e9 }' "$1"
}

plane='0.3 * x - 0.2 * y + 50'
points 3000 100 "$plane" >plane.xyz
for degree in 1 2 3; do
    bsgrid -d 2.5 -k $degree -n 3 plane.xyz >plane.hm 2>/dev/null
    true_that "a plane stays a plane, degree $degree" "$(worst plane.hm "$plane") < 1e-9"
done
bsgrid -d 2.5 -f points -n 3 plane.xyz >plane.hm 2>/dev/null
true_that "a plane dragged to its points stays one" "$(worst plane.hm "$plane") < 1e-9"
bsgrid -d 2.5 --derivatives plane.xyz >plane.hm 2>/dev/null
true_that "its derivatives are exact" \
    "$(awk '!/^#/ && $4 != "nan" { a = $4 - 0.3; b = $5 + 0.2; e = a * a + b * b; if (e > m) m = e }
       END { print m < 1e-20 }' plane.hm)"

# lattice: whole multiples of the spacing, whatever the extent
ok "the lattice is anchored" grep -q '^#origin 1002.5 2002.5$' plane.hm
bsgrid -d 5 -R 1011/1049/2023/2058 plane.xyz >window.hm 2>/dev/null
ok "a window has the nodes inside" grep -q '^#origin 1015 2025$' window.hm
ok "and no others" grep -q '^#size 7 7$' window.hm

# the spike of scheme.md: what of 1 m is left after 0, 1, 5 iterations
awk 'BEGIN { for (j = 0; j <= 40; j++) for (i = 0; i <= 40; i++) print i, j, (i == 20 && j == 20) }' >spike.xyz
for pair in 0:0.5625 1:0.77 5:0.97; do
    height=$(bsgrid -n ${pair%:*} spike.xyz 2>/dev/null | awk '$1 == 20 && $2 == 20 { print $3 }')
    true_that "a spike after ${pair%:*} iterations" "$height - ${pair#*:} < 0.006 && ${pair#*:} - $height < 0.006"
done
rest=$(bsgrid -n 100 spike.xyz 2>/dev/null | worst - '(x == 20 && y == 20)')
true_that "many iterations interpolate" "$rest < 1e-6"
bsgrid -n 0 -k 1 spike.xyz 2>/dev/null | awk '!/^#/ { print $1, $2, $3 }' | sort >spike.back
sort spike.xyz >spike.sorted
same "points at the nodes come back, hull included" spike.sorted spike.back

# order of the points, threads, form of the stream
points 20000 100 '3 * sin(x / 7) + 2 * cos(y / 9)' >wavy.xyz
awk 'NR % 50 == 0 { print $1, $2, $3 + 1 } { print }' wavy.xyz >double.xyz
sort -k2,2n double.xyz >other.xyz
bsgrid -d 1 double.xyz >a.hm 2>err
ok "points at one place are counted" grep -q '^bsgrid: 400 points at the place of another' err
bsgrid -d 1 other.xyz >b.hm 2>/dev/null
same "the order of the points does not matter" a.hm b.hm
for options in "" "-f points" "-m mean" "-m mean -f points -k 3"; do
    bsgrid -d 1 -n 2 $options -j 1 wavy.xyz >one.hm 2>/dev/null
    bsgrid -d 1 -n 2 $options -j 2 wavy.xyz >two.hm 2>/dev/null
    same "one thread as two: ${options:-tin}" one.hm two.hm
done

# dense data: means of cells and triangles tell the same
points 60000 60 '3 * sin(x / 7) + 2 * cos(y / 9)' >dense.xyz
bsgrid -n 2 dense.xyz >tin.hm 2>/dev/null
bsgrid -n 2 -m mean dense.xyz >mean.hm 2>/dev/null
true_that "mean against tin on dense data" "$(awk '!/^#/ && $3 != "nan" { k = $1 " " $2
    if (FNR == NR) { z[k] = $3; next } if (k in z && $1 > 1001 && $1 < 1059 && $2 > 2001 && $2 < 2059) {
    s += ($3 - z[k]) ^ 2; n++ } } END { print (n > 3000 ? sqrt(s / n) : 9) }' tin.hm mean.hm) < 0.05"
true_that "tin against the truth" "$(worst tin.hm '3 * sin(x / 7) + 2 * cos(y / 9)') < 0.05"
fit=$(bsgrid -d 4 -n 30 -f points dense.xyz 2>/dev/null | worst - '3 * sin(x / 7) + 2 * cos(y / 9)')
true_that "dragging to the points fits a coarse grid" "$fit < 0.1"
awk '(NR * 7919) % 101 < 4 && ($1 - 1028) ^ 2 + ($2 - 2026) ^ 2 > 60' dense.xyz >sparse.xyz
for gap in 3 9; do
    bsgrid -m mean -n 3 -g $gap -R 1010/1030/2010/2030 sparse.xyz 2>/dev/null | grep -v '^#' >window
    bsgrid -m mean -n 3 -g $gap -R 1010/1050/2010/2050 sparse.xyz 2>/dev/null |
        awk '!/^#/ && $1 <= 1030 && $2 <= 2030' >cut
    same "windows agree to the last bit, gap $gap" window cut
done
true_that "of which a part is empty, a part filled" "$(grep -c nan cut) < 200 && $(grep -c nan cut) > 0 && $(bsgrid -m mean -g 3 -R \
    1010/1030/2010/2030 sparse.xyz 2>/dev/null | grep -c nan) > 20"

# gaps: a strip of 12 m without points
awk '$1 < 1040 || $1 > 1052' dense.xyz >gap.xyz
for method in tin mean; do
    bsgrid -m $method -g 8 gap.xyz >gap.hm 2>err
    true_that "$method: a gap over the limit stays empty" \
        "$(awk '!/^#/ && $1 > 1041 && $1 < 1051 && $3 != "nan"' gap.hm | wc -l) == 0"
    ok "$method: and is told" grep -q 'empty' err
    bsgrid -m $method -g 16 gap.xyz >gap.hm 2>/dev/null
    true_that "$method: one under the limit is bridged" \
        "$(awk '!/^#/ && $1 > 1041 && $1 < 1051 && $2 > 2003 && $2 < 2057 && $3 == "nan"' gap.hm | wc -l) == 0"
done
bsgrid -g 8 -n 4 plane.xyz >/dev/null 2>&1
awk '$1 < 1030 || $1 > 1050 || $2 < 2040' plane.xyz >gap.xyz
bsgrid -d 2 -g 9 -n 4 gap.xyz >gap.hm 2>/dev/null
true_that "a plane with a gap stays a plane to its rim" "$(worst gap.hm "$plane") < 1e-9"

# classes, missing heights, history, units
{ echo "#hm 1 points text"; echo "#fields x y z class"; echo "#units m m m 1"; echo "#crs UTM 32N WGS84"; echo "#data"
  awk '{ print $1, $2, $3, 2; print $1, $2, $3 + 9, 5 }' plane.xyz; echo "#end"; } >class.hm
bsgrid -d 2.5 -c 2,9 class.hm >a.hm 2>/dev/null
true_that "only points of the class count" "$(worst a.hm "$plane") < 1e-9"
ok "units pass" grep -q '^#units m m m$' a.hm
ok "so does the crs" grep -q '^#crs UTM 32N WGS84$' a.hm
ok "history" grep -q '^#prog bsgrid .* -d 2.5 -c 2,9$' a.hm
awk 'NR % 3 == 0 { $3 = "nan" } { print }' plane.xyz >missing.xyz
bsgrid -d 5 missing.xyz >a.hm 2>err
ok "points without height are counted" grep -q '1000 points without a height' err
must_fail "--strict" 1 'without a height' bsgrid --strict -d 5 missing.xyz

# pipes
bsgrid -b -d 1 wavy.xyz 2>/dev/null | slope >a.hm
bsgrid -d 1 wavy.xyz 2>/dev/null | slope >b.hm
same "binary and text pipes" a.hm b.hm

# bad input
: >empty
must_fail "empty" 2 'empty' bsgrid empty
printf '1 2 3\n' >one.xyz
must_fail "one point" 2 'three points|2 x 2' bsgrid one.xyz
must_fail "one point, mean" 2 '2 x 2' bsgrid -m mean one.xyz
printf '1 1 0\n2 2 0\n3 3 0\n4 4 0\n' >line.xyz
must_fail "all on a line" 2 'line' bsgrid line.xyz
printf '5 5 0\n5 5 1\n5 5 2\n' >equal.xyz
must_fail "all equal" 2 '2 x 2|line' bsgrid equal.xyz
printf '1 1 0\n2 x 0\n' >word.xyz
must_fail "a word" 2 'word.xyz:2:' bsgrid word.xyz
printf '0 0 1\n1e300 1 2\n5 1e300 3\n' >far.xyz
must_fail "points too far apart" 2 'node|far|memory' bsgrid far.xyz
must_fail "points too far apart, mean" 2 'far' bsgrid -m mean far.xyz
must_fail "all without height" 2 'no points' bsgrid -c 7 class.hm
must_fail "no points in the window" 2 'no points' bsgrid -R 0/9/0/9 plane.xyz
must_fail "a window inside out" 2 'west/east' bsgrid -R 9/0/0/9 plane.xyz
must_fail "a window between nodes" 2 'no node' bsgrid -d 10 -R 1001/1002/2001/2002 plane.xyz
must_fail "classes without a field" 2 'field class' bsgrid -c 2 plane.xyz
must_fail "a class too large" 2 'classes' bsgrid -c 256 class.hm
must_fail "degree 4" 2 'degree' bsgrid -k 4 plane.xyz
must_fail "a grid for points" 2 'no points' bsgrid a.hm
if [ -e /dev/full ]; then
    must_fail "a full disk" 2 'space|No space' sh -c 'bsgrid -d 1 wavy.xyz >/dev/full'
fi

if need_data danube_deggendorf/points.xyz; then
    ok "the Danube" bsgrid -d 4 -g 60 -o danube.hm "$DATA/danube_deggendorf/points.xyz"
    true_that "heights within those measured" "$(column 3 danube.hm | awk 'NR == 1 { a = b = $1 }
        { if ($1 < a) a = $1; if ($1 > b) b = $1 } END { print (a > 303.5 && b < 318.7 && NR > 200000) }')"
fi
done_testing
