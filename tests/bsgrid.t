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
for options in "-n 4 -f points" "-d 0.7 -n 4 -k 3 -f points" "-d 0.7 -g 3"; do
    bsgrid -m mean $options -R 1012/1038/2012/2048 wavy.xyz 2>/dev/null | awk '!/^#/ { print $3 }' >window
    bsgrid -m mean $options -R 1010/1050/2010/2050 wavy.xyz 2>/dev/null |
        awk '!/^#/ && $1 >= 1012 && $1 <= 1038 && $2 >= 2012 && $2 <= 2048 { print $3 }' >cut.heights
    same "so do the heights with $options" window cut.heights
done
awk '{ print $1 - 1020, $2 - 2020, $3 }' wavy.xyz >around.xyz
bsgrid -m mean -n 2 -f points -R 10/20/10/20 around.xyz 2>/dev/null | grep -v '^#' >window
bsgrid -m mean -n 2 -f points -R -9/20/-9/20 around.xyz 2>/dev/null | awk '!/^#/ && $1 >= 10 && $2 >= 10' >cut.around
same "and where one of them has the origin in it" window cut.around
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

# medians: one wild point in a cell of three does not move it
awk 'BEGIN { for (j = 0; j < 12; j++) for (i = 0; i < 12; i++) { print i, j, 3; print i + 0.2, j, (i + j) % 4 ? 1 : 99
    print i, j - 0.3, 2 } }' >wild.xyz
bsgrid -m median -n 0 -k 1 wild.xyz >a.hm 2>/dev/null
true_that "median of cells" "$(awk '!/^#/ && $3 != 2 && $3 != 3' a.hm | wc -l) == 0 && $(grep -c ' 2$' a.hm) > 100"
bsgrid -d 5 -m median -n 3 plane.xyz >a.hm 2>/dev/null
ok "with the same nodes as means" sh -c 'bsgrid -d 5 -m mean -n 3 plane.xyz 2>/dev/null |
    awk "{ print \$1, \$2, (\$3 == \"nan\") }" | grep -v prog >b; awk "{ print \$1, \$2, (\$3 == \"nan\") }" a.hm | grep -v prog | cmp - b'

# tolerance: the same as many iterations that move nothing
awk '{ $3 = sprintf("%.4f", $3 + ((NR * 7919) % 101 - 50) / 500) } { print }' wavy.xyz >noisy.xyz
for fit in grid points; do
    bsgrid -n 200 -f $fit -t 0.01 noisy.xyz 2>/dev/null | grep -v '^#' >a
    bsgrid -n 200 -f $fit noisy.xyz 2>/dev/null | grep -v '^#' >b
    bsgrid -n 1 -f $fit noisy.xyz 2>/dev/null | grep -v '^#' >c
    true_that "a tolerance ends dragging to $fit in time" "$(paste a b c | awk '$3 != "nan" { d = ($3 - $6) ^ 2; e = ($9 - $6) ^ 2
        if (d > m) m = d; if (e > n) n = e } END { print (m > 0 && m < n / 4) }')"
done

# oversampling: the same surface, more nodes; a plane stays one
bsgrid -d 2 -O 4 --derivatives wavy.xyz 2>/dev/null >fine.hm
bsgrid -d 2 --derivatives wavy.xyz 2>/dev/null >coarse.hm
ok "the nodes of the grid come again" awk '!/^#/ { if (FNR == NR) { z[$1 " " $2] = $3 " " $4 " " $5 } else
    if (z[$1 " " $2] != $3 " " $4 " " $5) exit 1 }' fine.hm coarse.hm
true_that "with those between" "$(grep -c '^[^#]' fine.hm) > 15.5 * $(grep -c '^[^#]' coarse.hm)"
true_that "whose differences are the derivatives" "$(awk '!/^#/ && $3 != "nan" && $4 != "nan" { if (y == $2 && $1 - x < 0.6) {
    e = ($3 - z) / 0.5 - ($4 + d) / 2; if (e < 0) e = -e; if (e > m) m = e; n++ } x = $1; y = $2; z = $3; d = $4 }
    END { print (n > 30000 ? m : 9) }' fine.hm) < 0.05"
for degree in 1 2 3; do
    bsgrid -d 2.5 -O 3 -k $degree plane.xyz >a.hm 2>/dev/null
    true_that "a plane oversampled, degree $degree" "$(worst a.hm "$plane") < 1e-9 && $(grep -c '^[^#]' a.hm) > 12000"
done
bsgrid -d 2 -O 4 -R 1011.3/1030.2/2011/2030.7 wavy.xyz 2>/dev/null >window.hm
ok "a window reaches to its border" sh -c "grep -q '^#origin 1011.5 2011$' window.hm && grep -q '^#size 38 40$' window.hm"

# blunders: all found, nothing else, whatever the start grid
awk 'NR % 997 == 500 { $3 += (NR % 2 ? 3 : -4); print >"wrong" } { print }' noisy.xyz >blunders.xyz
awk 'NR % 997 != 500' noisy.xyz | awk '{ printf "%.3f %.3f %.9f\n", $1, $2, $3 }' | sort >right
for options in "" "-m mean" "-m median" "-f points" "-n 3 -k 3"; do
    bsgrid $options --clean clean.hm blunders.xyz >a.hm 2>err
    awk '!/^#/ { printf "%.3f %.3f %.9f\n", $1, $2, $3 }' clean.hm | sort >kept
    same "blunders out, all others kept: ${options:-tin}" right kept
    ok "and counted" grep -q "$(grep -c . wrong) blunders left out" err
done
true_that "the surface is as without them" "$(bsgrid -B 6 blunders.xyz 2>/dev/null | worst - '3 * sin(x / 7) + 2 * cos(y / 9)') < 0.2"
must_fail "--strict counts blunders" 1 'blunders' bsgrid --strict -B 6 blunders.xyz
ok "a clean survey keeps all" sh -c 'bsgrid -B 6 plane.xyz 2>&1 >/dev/null | grep -q "^bsgrid: 3000 points"'
awk 'BEGIN { for (j = 0; j < 60; j++) for (i = 0; i < 60; i++) print i / 2, j / 2, (i > 30 ? 5 : 0) + (i * 7 + j * 13) % 5 / 50 }' >cliff.xyz
ok "a cliff is none" sh -c 'bsgrid -B 6 cliff.xyz 2>&1 >/dev/null | grep -q "^bsgrid: 3600 points"'
ok "the rest is a stream with its history" sh -c "head -n 1 clean.hm | grep -q '^#hm 1 points' && tail -n 1 clean.hm | grep -q '^#end'"
must_fail "a file that cannot be written" 2 'nowhere' bsgrid --clean nowhere/clean.hm blunders.xyz

# a mask
cat >mask.txt <<'END'
> closed=1
1010 2010
1050 2010
1050 2050
1010 2050
> closed=1 hole=1
1020 2020
1030.5 2020
1030.5 2030
1020 2030
END
bsgrid --mask mask.txt plane.xyz 2>/dev/null | awk '!/^#/ && $3 != "nan" { print $1, $2 }' >a
awk 'BEGIN { for (y = 2010; y < 2050; y++) for (x = 1010; x < 1050; x++)
    if (!(x >= 1020 && x < 1030.5 && y >= 2020 && y < 2030)) print x, y }' >b
same "nodes within the outline, not in the hole" a b
sed -n '/hole/,$p' mask.txt >hole.txt
true_that "a hole alone" "$(bsgrid --mask hole.txt plane.xyz 2>/dev/null | grep -c nan) - $(bsgrid plane.xyz 2>/dev/null | grep -c nan) == 110"
sed 's/closed=1//' mask.txt >open.txt
must_fail "an open line as mask" 2 'line 1 of the mask is not closed' bsgrid --mask open.txt plane.xyz
must_fail "points as mask" 2 'needs lines' bsgrid --mask plane.xyz plane.xyz

# counts and density
for options in "" "-m mean" "-B 6 -m mean"; do
    bsgrid -d 5 $options --count --density wavy.xyz 2>/dev/null >a.hm
    awk 'FILENAME == "wavy.xyz" { n[int($1 / 5 + 0.5) * 5 " " int($2 / 5 + 0.5) * 5]++; next } !/^#/ { k = 0
        for (i = -5; i <= 5; i += 5) for (j = -5; j <= 5; j += 5) k += n[$1 + i " " $2 + j]
        if ($4 != n[$1 " " $2] + 0 || ($5 - k / 225) ^ 2 > 1e-20) bad++ } END { exit bad || NR < 400 }' wavy.xyz a.hm
    report $? "counts and densities are those of the points: ${options:-tin}"
done
ok "their units" grep -q '^#units m m m 1 1/m2$' a.hm

# returns
{ echo "#hm 1 points text"; echo "#fields x y z class return returns"; echo "#data"
  awk '{ print $1, $2, $3 + 9, 2, 1, 2; print $1, $2, $3, 2, 2, 2 }' plane.xyz; echo "#end"; } >returns.hm
bsgrid -d 2.5 --returns last returns.hm >a.hm 2>/dev/null
true_that "only last returns" "$(worst a.hm "$plane") < 1e-9"
must_fail "only returns: none" 2 'no points.*--returns let pass' bsgrid --returns only returns.hm
must_fail "returns without the fields" 2 'fields return' bsgrid --returns first class.hm

# pipes
bsgrid -b -d 1 wavy.xyz 2>/dev/null | slope >a.hm
bsgrid -d 1 wavy.xyz 2>/dev/null | slope >b.hm
same "binary and text pipes" a.hm b.hm

bsgrid --single --clean clean.hm -d 1 wavy.xyz 2>/dev/null | hmconv >a.hm
true_that "single precision" "$(bsgrid -d 1 -B 6 wavy.xyz 2>/dev/null | paste a.hm - | awk '!/^#/ && $3 != "nan" { e = $3 - $6
    if (e < 0) e = -e; if (e > m) m = e; n++ } END { print (n > 9000 ? m : 9) }') < 5e-7"
hmconv clean.hm >clean.txt
true_that "the clean points stay exact" "$(hmconv wavy.xyz | grep -v '^#' | grep -cFxf - clean.txt) == 20000"

# bad input
: >empty
must_fail "empty" 2 'empty' bsgrid empty
printf '1 2 3\n' >one.xyz
must_fail "one point" 2 'no surface: there is only one' bsgrid one.xyz
must_fail "one point, mean" 2 'no surface: there is only one' bsgrid -m mean one.xyz
printf '1 1 0\n2 2 0\n3 3 0\n4 4 0\n' >line.xyz
must_fail "all on a line" 2 'no surface: all lie on one line' bsgrid line.xyz
printf '5 5 0\n5 5 1\n5 5 2\n' >equal.xyz
must_fail "all equal" 2 'no surface: all lie at one place' bsgrid equal.xyz
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
must_fail "oversampling by 0" 2 '-O' bsgrid -O 0 plane.xyz
must_fail "a grid for points" 2 'no points' bsgrid a.hm
if [ -e /dev/full ]; then
    must_fail "a full disk" 2 'space|No space' sh -c 'bsgrid -d 1 wavy.xyz >/dev/full'
fi

if need_data danube_deggendorf/points.xyz; then
    ok "the Danube" bsgrid -d 4 -g 60 -o danube.hm "$DATA/danube_deggendorf/points.xyz"
    true_that "heights within those measured" "$(column 3 danube.hm | awk 'NR == 1 { a = b = $1 }
        { if ($1 < a) a = $1; if ($1 > b) b = $1 } END { print (a > 303.5 && b < 318.7 && NR > 200000) }')"
fi
# --- grids without anything, and heights beyond reckoning, are said ---
printf '0 0 1\n10 0 1\n0 10 1\n' >three.xyz
bsgrid -g 0.1 three.xyz 2>err >none.hm
ok "a grid without a height" grep -q 'warning: no node has a height.*-g' err
printf '0 0 1e308\n10 0 -1e308\n0 10 1e308\n10 10 1\n3 3 -1e308\n' >huge.xyz
bsgrid -g 99 huge.xyz 2>err >huge.hm
ok "heights that overflow" grep -Eq 'warning: the heights around [0-9]+ nodes are too large' err
bsgrid -g 99 three.xyz 2>err >some.hm
ok "else no warning" sh -c '! grep warning err'

done_testing
