#!/bin/sh
# breaklines: limits, modes, what becomes of the lines, slope from elsewhere, bad input.
. "${0%/*}/tap.sh"

# A straight bank along a slanted line, 1:3, 6 m wide, on a grid of 1 m; slopes by slope.
awk 'BEGIN { print "#hm 1 grid text"; print "#size 121 81"; print "#origin 500 900"; print "#step 1 1"
    print "#fields x y z"; print "#crs UTM 32N WGS84"; print "#data"
    for (j = 0; j < 81; j++) for (i = 0; i < 121; i++) { s = (j - 40) * 0.96 - (i - 60) * 0.28
        print 500 + i, 900 + j, (s < -3 ? -1 : s > 3 ? 1 : s / 3) }
    print "#end" }' >bank.hm
slope bank.hm >slope.hm
breaklines -s 9 slope.hm >lines.hm 2>err
# count FILE: lines in it
count() { grep -c '^>' "$1"; }

true_that "a bank has two breaklines" "$(count lines.hm) == 2"
ok "says what came and went" grep -Eq '2 lines found \([0-9]+ vertices\), 0 dropped .* 2 written' err
ok "attributes" grep -q '^> limit=9 length=12[0-9.]*$' lines.hm
ok "units, crs and history" sh -c "grep -q '^#units m m m$' lines.hm && grep -q '^#crs UTM 32N WGS84' lines.hm &&
    grep -q '^#prog breaklines .* -s 9$' lines.hm"
true_that "half the bank's slope: on toe and crest to a third of a cell" "$(awk '!/^[#>]/ && $1 > 503 && $1 < 617 {
    s = ($2 - 940) * 0.96 - ($1 - 560) * 0.28; e = (s < 0 ? -s : s) - 3; if (e < 0) e = -e; if (e > m) m = e }
    END { print m }' lines.hm) < 0.33"
true_that "z is the surface's" "$(awk '!/^[#>]/ { z = $3 < 0 ? -$3 : $3; if (z < 0.8 || z > 1) bad++ }
    END { print bad + 0 }' lines.hm) == 0"
true_that "the steep side is on the left" "$(awk '/^>/ { n = 0; next } !/^#/ { if (n++) {
    if (($1 - x) * (940 - y) - ($2 - y) * (560 - x) <= -60) bad++ } x = $1; y = $2 } END { print bad + 0 }' lines.hm) == 0"

breaklines -s 9,10%,14 slope.hm >three.hm 2>/dev/null
true_that "three limits at once" "$(count three.hm) == 6"
true_that "each line says its limit" "$(grep -c 'limit=10%' three.hm) == 2 && $(grep -c 'limit=14' three.hm) == 2"
breaklines -s 10% three.hm >/dev/null 2>&1
slope -u percent bank.hm | breaklines -s 9 2>/dev/null | grep -v '^#' >a
grep -v '^#' lines.hm >b
true_that "slopes in percent: nearly the same lines" "$(paste a b | awk '!/>/ { d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2
    if (d > m) m = d } END { print (NR > 100 ? m : 9) }') < 0.01"
breaklines -s 9 -m node slope.hm >node.hm 2>/dev/null
true_that "node mode: vertices are nodes" "$(awk '!/^[#>]/ && ($1 % 1 || $2 % 1)' node.hm | wc -l) == 0"
breaklines -s 9 -x mean slope.hm >mean.hm 2>/dev/null
true_that "mean: fewer vertices by one a line" "$(grep -vc '^[#>]' lines.hm) - $(grep -vc '^[#>]' mean.hm) == 2"

# rough ground: many lines, closed ones, the short ones dropped
awk 'BEGIN { print "#hm 1 grid text"; print "#size 200 200"; print "#origin 0 0"; print "#step 2 2"
    print "#fields x y z slope"; print "#units m m m degree"; print "#data"
    for (j = 0; j < 200; j++) for (i = 0; i < 200; i++)
        print 2 * i, 2 * j, i, (i % 37 == 5 && j > 90 ? "nan" : 6 + 4 * sin(i / 3 + j / 11) * cos(j / 4) + (i * 7 + j * 13) % 5)
    print "#end" }' >rough.hm
breaklines -s 8 -l 0 rough.hm >all.hm 2>err
breaklines -s 8 rough.hm >long.hm 2>/dev/null
true_that "short lines are dropped" "$(count long.hm) < $(count all.hm)"
true_that "the default is 20 spacings" "$(sed -n 's/^>.*length=\([0-9.]*\).*/\1/p' long.hm | sort -n | head -n 1) >= 40"
true_that "closed lines" "$(grep -c 'closed=1' all.hm) > 10"
breaklines -s 8 -l 50 rough.hm >l50.hm 2>/dev/null
true_that "another minimum" "$(sed -n 's/^>.*length=\([0-9.]*\).*/\1/p' l50.hm | sort -n | head -n 1) >= 50"
breaklines -s 8 -l 0 -e 0.5 rough.hm >simple.hm 2>/dev/null
true_that "simplified" "$(grep -vc '^[#>]' simple.hm) < 0.8 * $(grep -vc '^[#>]' all.hm) && $(count simple.hm) == $(count all.hm)"
breaklines -s 8 -r 5 rough.hm >equal.hm 2>/dev/null
true_that "resampled" "$(awk '/^>/ { n = 0; next } !/^#/ { if (n++) { d = sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2)
    if (d > 5.9) bad++ } x = $1; y = $2 } END { print bad + 0 }' equal.hm) == 0"
breaklines -s 8 -w 0 -l 0 rough.hm >raw.hm 2>/dev/null
sum='s/^>.*length=\([0-9.]*\).*/\1/p'
true_that "smoothed lines are shorter" "$(sed -n "$sum" all.hm | awk '{ s += $1 } END { print s }') < \
    $(sed -n "$sum" raw.hm | awk '{ s += $1 } END { print s }')"
breaklines -s 8 -w 1 -l 0 rough.hm 2>/dev/null | grep '^[^#]' >half
grep '^[^#]' all.hm >unasked
same "by half a spacing, unless asked" half unasked
true_that "vertices stay within it" "$(breaklines -s 8 -l 0 -w 0.3 rough.hm 2>/dev/null | paste - raw.hm | awk '$1 ~ /^[0-9]/ {
    d = ($1 - $4) ^ 2 + ($2 - $5) ^ 2; if (d > m) m = d; n++ } END { print (n > 9999 ? m : 9) }') <= 0.3 ^ 2 + 1e-9"
must_fail "a negative one" 2 'smooth: must not be less than 0' breaklines -w -1 rough.hm
ok "all at once" breaklines -s 8 -w 0.5 -e 0.3 -r 6 rough.hm
for options in "" "-m node" "-x mean" "-e 1 -w 1"; do
    breaklines -s 8 $options -j 1 rough.hm >a.hm 2>/dev/null
    breaklines -s 8 $options -j 2 rough.hm >b.hm 2>/dev/null
    same "one thread as two: $options" a.hm b.hm
done
slope -b bank.hm | breaklines -b -s 9 2>/dev/null >binary.hm
breaklines -s 9 slope.hm 2>/dev/null | head -n 1 >/dev/null
ok "binary lines are shorter" [ "$(wc -c <binary.hm)" -lt "$(wc -c <lines.hm)" ]

# many lines: those that are settled go out before the end
awk 'BEGIN { print "#hm 1 grid text"; print "#size 300 500"; print "#origin 0 0"; print "#step 2 2"
    print "#fields x y z slope"; print "#units m m m degree"; print "#data"
    for (j = 0; j < 500; j++) for (i = 0; i < 300; i++)
        print 2 * i, 2 * j, i, 6 + 4 * sin(i / 3 + j / 11) * cos(j / 4) + (i * 7 + j * 13) % 5
    print "#end" }' >large.hm
breaklines -s 8 -l 0 -w 0 large.hm >raw.hm 2>/dev/null
breaklines --quiet -s 8 -l 0 -w 0.4 large.hm >smooth.hm 2>said
ok "nothing but errors is said of them when quiet" [ ! -s said ]
sizes() { awk '/^[>#]/ { if (n) print n, closed; n = 0; closed = $0 ~ /closed/; next } { n++ }' "$1" | sort; }
sizes raw.hm >raw.sizes
sizes smooth.hm >smooth.sizes
true_that "with smoothing lines come in another order" "$(sed -n 's/^>.*length=//p' raw.hm | wc -l) > 5000 &&
    $(grep -vc '^[#>]' raw.hm) > 80000 && $(paste raw.hm smooth.hm | awk '$1 ~ /^[0-9]/ && ($1 - $4) ^ 2 > 9' | wc -l) > 1000"
same "but all of them, and each as long" raw.sizes smooth.sizes
true_that "each within 0.4 m of where it was" "$(awk '/^[#>]/ { next } FNR == NR { c[int($1) " " int($2)] = c[int($1) " " int($2)] " " $1 " " $2; next }
    { best = 9; for (i = -1; i < 2; i++) for (j = -1; j < 2; j++) { n = split(c[int($1) + i " " int($2) + j], v, " ")
        for (k = 1; k < n; k += 2) { d = (v[k] - $1) ^ 2 + (v[k + 1] - $2) ^ 2; if (d < best) best = d } }
      if (best > m) m = best } END { print m }' raw.hm smooth.hm) <= 0.4 ^ 2 + 1e-9"

# curvature: toe and crest of the bank
breaklines -m curvature bank.hm >curved.hm 2>/dev/null
true_that "curvature: a bank has two lines" "$(count curved.hm) == 2"
ok "a crest and a toe" sh -c "grep -q '^> kind=crest limit=0.06 length=1' curved.hm && grep -q '^> kind=toe limit=0.06 length=1' curved.hm"
true_that "each where it belongs, to a third of a cell" "$(awk '/^> kind=toe/ { side = -3 } /^> kind=crest/ { side = 3 }
    !/^[#>]/ { e = ($2 - 940) * 0.96 - ($1 - 560) * 0.28 - side; if (e < 0) e = -e; if (e > m) m = e; n++ }
    END { print (n > 200 ? m : 9) }' curved.hm) < 0.33"
# levee and ditch, narrower than any limit of slope could tell: ridge, foot, bottom
awk 'BEGIN { print "#hm 1 grid text"; print "#size 140 60"; print "#origin 0 0"; print "#step 1 1"
    print "#fields x y z"; print "#data"
    for (j = 0; j < 60; j++) for (i = 0; i < 140; i++) { a = i + 0.3 * j - 50.3; b = i + 0.3 * j - 90.7
        a = 1.5 - (a < 0 ? -a : a) / 3; b = 1.2 - (b < 0 ? -b : b) / 2; print i, j, (a > 0 ? a : 0) - (b > 0 ? b : 0) }
    print "#end" }' >narrow.hm
breaklines -m curvature -s 0.1 narrow.hm >curved.hm 2>/dev/null
true_that "levee: a ridge and two feet; ditch: a bottom and two crests" \
    "$(grep -c kind=crest curved.hm) == 3 && $(grep -c kind=toe curved.hm) == 3"
true_that "ridge and bottom run along the middle" "$(awk '!/^[#>]/ { u = $1 + 0.3 * $2; if (u > 48 && u < 52.6) e = u - 50.3
    else if (u > 88.5 && u < 93) e = u - 90.7; else next; if (e < 0) e = -e; if (e > m) m = e; n++ }
    END { print (n > 100 ? m : 9) }' curved.hm) < 0.35"
awk '!/^#/ && $2 == 30 { $3 = "nan" } { print }' narrow.hm >cut.hm
breaklines -m curvature -s 0.1 cut.hm >curved.hm 2>/dev/null
true_that "lines end at nodata" "$(count curved.hm) == 12 && $(awk '!/^[#>]/ && $2 > 27 && $2 < 33' curved.hm | wc -l) == 0"
awk '/^#/ || ($3 = 0.2 * $1 - 0.1 * $2) != "" { print }' narrow.hm >level.hm
breaklines -m curvature -s 0.001 -l 0 level.hm >curved.hm 2>/dev/null
true_that "a plane has none" "$(count curved.hm) == 0"
breaklines -m curvature -s 0.01 -l 0 -j 1 rough.hm >a.hm 2>/dev/null
breaklines -m curvature -s 0.01 -l 0 -j 2 rough.hm >b.hm 2>/dev/null
same "one thread as two: curvature" a.hm b.hm
must_fail "a slope for a curvature" 2 '1/m' breaklines -m curvature -s 10% narrow.hm

# an exact hit everywhere: a plane at just the limit is steep, all of it, and has no border
awk '/^#/ && !/^#end/ { print } !/^#/ { print $1, $2, $3, 8 } END { print "#end" }' rough.hm >level.hm
breaklines -s 8 -l 0 level.hm >a.hm 2>/dev/null
true_that "slope equal to the limit everywhere: no line" "$(grep -c '^>' a.hm) == 0"
ok "but a whole stream" sh -c 'tail -n 1 a.hm | grep -q "^#end"'

# slope from elsewhere
awk '/^#fields/ { print "#fields x y slope"; next } /^#units/ { print "#units m m degree"; next } /^#/ { print; next }
    { print $1, $2, $4 }' slope.hm >apart.hm
breaklines -s 9 --slope apart.hm bank.hm >a.hm 2>/dev/null
grep -v '^#' a.hm >a
same "slope and heights apart" a b
sed 's/^#origin.*/#origin 501 900/' apart.hm >shifted.hm
must_fail "another lattice" 2 'nodes are not those' breaklines -s 9 --slope shifted.hm bank.hm
must_fail "no such slope file" 2 'nowhere' breaklines --slope nowhere bank.hm

# bad input
: >empty
must_fail "empty" 2 'empty' breaklines empty
must_fail "no slope" 2 'no grid has a band slope' breaklines bank.hm
head -n 400 slope.hm >cut.hm
must_fail "truncated" 2 'cut.hm' breaklines cut.hm
sed '$d' slope.hm >cut.hm
must_fail "no end mark" 2 'cut.hm' breaklines cut.hm
ok "then nothing looks whole" sh -c '! breaklines cut.hm 2>/dev/null | grep -q "^#end"'
must_fail "points for a grid" 2 'no grid' sh -c 'echo 1 2 3 | breaklines'
for limit in 0 90 -3 x 5,,6 5%% nan; do
    must_fail "limit $limit" 2 'limit is' breaklines -s "$limit" slope.hm
done
if [ -e /dev/full ]; then
    must_fail "a full disk" 2 'space|No space' sh -c 'breaklines -s 8 -l 0 rough.hm >/dev/full'
fi
# --- what a stranger would write ---
must_fail "a negative length" 2 'min-length: must not be less than 0' breaklines -l -1 slope.hm
must_fail "a limit given twice" 2 'the limit 5.0 is given twice' breaklines -s 5,5.0,5 slope.hm
must_fail "a limit of 90 degrees in percent" 2 '-s: a limit is' breaklines -s 1e300% slope.hm

# --- a pipe with --keep brings the same ground twice ---
slope -K bank.hm | breaklines -s 9 >kept.hm 2>err
ok "of a grid and its slope the second is taken" grep -q 'left out 1 grid without a band slope' err
grep '^[^#]' kept.hm >a
grep '^[^#]' lines.hm >b
same "... with the same lines" a b
slope -K bank.hm | breaklines -m curvature -s 0.01 >kept.hm 2>err
ok "of two with heights the first is taken" grep -q 'left out a second grid of the same nodes' err
slope -K bank.hm | slope >again.hm 2>err
ok "slope takes the grid without slope" grep -q 'left out 1 grid that had a band slope already' err
grep '^[^#]' again.hm >a
grep '^[^#]' slope.hm >b
same "... and makes the same of it" a b
must_fail "slope of a slope" 2 'no grid without a band slope' slope slope.hm
ok "with --keep messages name the operand" sh -c '
    slope -K - <lines.hm 2>&1 >/dev/null | grep -q "^slope: standard input: lines not used here"'

done_testing
