#!/bin/sh
# Units: one for x, y and z, the same in all inputs; feet are said.
. "${0%/*}/tap.sh"

points() { # UNITS FILE
    printf '#hm 1 points text\n#units %s\n#data\n0 0 0\n50 0 0\n0 50 50\n50 50 50\n#end\n' "$1" >"$2"
}
points "m m m" metres.hm
points "ft ft ft" feet.hm
points "m m ft" mixed.hm
must_fail "heights in feet over metres" 2 "z in ft.*georef" bsgrid -d 5 -g 100 mixed.hm
must_fail "feet beside metres" 2 "differ in their units" trimesh -m delaunay metres.hm feet.hm
ok "all in feet" bsgrid -d 5 -g 100 -o grid.hm feet.hm
true_that "that is said" "$(grep -c 'are in ft' tap.err) == 1"
true_that "the grid says so" "$(grep -c '^#units ft ft ft' grid.hm) == 1"
ok "metres are not worth a word" sh -c 'bsgrid -d 5 -g 100 metres.hm 2>&1 >/dev/null | grep "are in"; [ $? -eq 1 ]'
if command -v georef >/dev/null; then
    ok "georef makes one unit of two" sh -c 'georef -t same mixed.hm | bsgrid -d 5 -g 100 | slope >slope.hm'
    true_that "and the slope is right" \
        "$(awk '!/^#/ { s += $4; n++ } END { d = s / n - atan2(0.3048, 1) * 180 / atan2(0, -1); print (d < 0 ? -d : d) }' slope.hm) < 1e-9"
else
    skip "georef is not built"
fi
done_testing
