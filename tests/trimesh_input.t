#!/bin/sh
# trimesh: what it is given. Outlines, islands and holes, breaklines that leave the ground or have no
# heights; and what nobody should give: each is mended and counted, or refused with its place, by every
# method, and nothing hangs.
. "${0%/*}/tap.sh"

# ground MESH: its area
ground() {
    awk '/^v/ { if (!n) { x0 = $2; y0 = $3 } x[n + 0] = $2 - x0; y[n + 0] = $3 - y0; n++ }
         /^t/ { a += (x[$3] - x[$2]) * (y[$4] - y[$2]) - (x[$4] - x[$2]) * (y[$3] - y[$2]) }
         END { printf "%.9g\n", a / 2 }' "$1"
}
ring() { # ATTRIBUTES X0 Y0 X1 Y1: a rectangle as a line
    printf '> closed=1 %s\n%s %s\n%s %s\n%s %s\n%s %s\n' "$1" "$2" "$3" "$4" "$3" "$4" "$5" "$2" "$5"
}
methods="delaunay|-m delaunay
paper|-l 1
quality|-m quality -q 30 -a 3
terrain|-m terrain -e 0.01 -q 25"
# each NAME CONDITION FILES: every method makes a sound mesh, of which $a is the area; what it said is in
# `said`
each() {
    echo "$methods" >methods
    while IFS='|' read -r method options; do
        ok "$method: $1" timeout 60 sh -c "trimesh $options plane.xyz $3 2>said >mesh.hm"
        true_that "$method: its area" "$(ground mesh.hm | awk '{ a = $1; print ('"$2"') }')"
        ok "$method: quality(1) finds it sound" sound mesh.hm
        [ -z "${4-}" ] || ok "$method: says $4" grep -Eq -- "$4" said
    done <methods
}
# No fault but, of two outlines, a piece apart from the rest.
sound() {
    quality --quiet "$1" plane.xyz |
        awk '/^Validity/ { on = 1; next } !NF { on = 0 } { seen += on }
            on && !/no fault|piece apart|^  warning/ { print; bad = 1 } END { exit bad || !seen }'
}
# none NAME PATTERN FILES: every method refuses it
none() {
    echo "$methods" >methods
    while IFS='|' read -r method options; do
        must_fail "$method: $1" 2 "$2" timeout 60 trimesh $options plane.xyz $3
    done <methods
}
awk 'BEGIN { for (j = 0; j < 41; j++) for (i = 0; i < 41; i++) print i, j, i + 2 * j }' >plane.xyz

# --- outlines ---

{ ring boundary=1 2 2 12 12; ring boundary=1 20 5 35 35; } >two.txt
each "two outlines" 'a == 550' two.txt
{ ring boundary=1 2 2 38 38; ring boundary=1 10 10 30 30; } >island.txt
each "an outline with an island" 'a == 1296 - 400' island.txt
{ cat island.txt; ring boundary=1 15 15 20 20; } >pond.txt
each "with ground within the island" 'a == 1296 - 400 + 25' pond.txt
{ ring boundary=1 2 2 20 38; ring boundary=1 20 2 38 38; } >beside.txt
each "two that share a side" 'a == 1296' beside.txt
{ cat island.txt; ring hole=1 4 4 8 8; ring hole=1 31 31 35 35; } >holes.txt
each "holes, one near the corner of the island" 'a == 1296 - 400 - 32' holes.txt
{ ring boundary=1 2 2 38 38; ring hole=1 30 30 50 50; } >across.txt
each "a hole across the outline" 'a == 1296 - 64' across.txt
{ ring boundary=1 2 2 38 38; ring hole=1 50 50 60 60; } >away.txt
each "a hole outside" 'a == 1296' away.txt '1 hole outside the outline'
awk 'function at(t, r) { printf "%.6f %.6f\n", 20 + (r + 0.8 * t) * cos(t), 20 + (r + 0.8 * t) * sin(t) }
    BEGIN { print "> boundary=1 closed=1"; n = 120; turn = 6 * 3.14159265
        for (i = 0; i <= n; i++) at(turn * i / n, 3)
        for (i = n; i >= 0; i--) at(turn * i / n, 3.8) }' >spiral.txt
area=$(awk 'NF == 2 && !/>/ { x[n + 0] = $1; y[n + 0] = $2; n++ } END { for (i = 0; i < n; i++) { j = (i + 1) % n
    a += x[i] * y[j] - x[j] * y[i] } print a < 0 ? -a / 2 : a / 2 }' spiral.txt)
each "a spiral of three turns" "(a / $area - 1) ^ 2 < 1e-12" spiral.txt

# --- breaklines ---

ring boundary=1 2 2 38 38 >box.txt
printf '>\n-5 20.5 30\n45 20.5 80\n' >leaves.txt
each "a breakline that leaves the outline" 'a == 1296' "box.txt leaves.txt" '14 of 50 m of breaklines outside'
while IFS='|' read -r method options; do
    trimesh --quiet $options plane.xyz box.txt leaves.txt >mesh.hm
    true_that "$method: it is cut there, at its height" "$(awk '
        /^v/ && $3 == 20.5 && int($5 / 2) % 2 { if ($2 == 2 || $2 == 38) ends++; if (($4 - 35 - $2) ^ 2 > 1e-18) bad++ }
        END { print (ends == 2 && !bad) }' mesh.hm)"
done <methods
printf '>\n10 10.5 100\n30 20.5 200\n>\n10 20.5 300\n30 10.5 400\n' >meet.txt
trimesh --quiet -m quality plane.xyz meet.txt >mesh.hm
true_that "where two meet their mean counts" "$(awk '/^v/ && $2 == 20 && $3 == 15.5 { print $4 }' mesh.hm) == 250"
printf '>\n5 20\n35 20\n' >flat.txt
each "a breakline without heights" 'a == 1600' flat.txt '2 vertices of breaklines with their height from the terrain'
printf '>\n5 20 300\n35 20 700\n' >contour.txt
trimesh --quiet -m quality -a 5 --line-z terrain plane.xyz contour.txt >mesh.hm
true_that "--line-z terrain: its heights do not count" \
    "$(awk '/^v/ && ($4 - $2 - 2 * $3) ^ 2 > 1e-18' mesh.hm | wc -l) == 0"
printf '>\n10 10 5\n30 20 5\n>\n10 20 5\n30 10 5\n>\n10 10 5\n30 20 5\n>\n30 20 5\n20 15 5\n' >cross.txt
each "crossing and double breaklines" 'a == 1296' "box.txt cross.txt" 'lines mended: .* pieces drawn twice'

# --- what cannot be ---

printf '> boundary=1 closed=1\n2 2\n38 2\n20 20\n38 38\n2 38\n20 20\n' >touch.txt
none "an outline that touches itself" 'outline meets itself at 20 20' touch.txt
ring boundary=1 2.2 2.2 2.8 2.8 >small.txt
none "no points inside the outline" 'no measurement lies inside the outline, .* at 2.2 2.2' small.txt
must_fail "minimum over maximum edge" 2 'must be more than the minimum' trimesh -l 5 -L 4 plane.xyz
must_fail "also for the vertical error's" 2 'must be more than the minimum' trimesh -m terrain -e 1 -l 5 -L 4 plane.xyz
must_fail "an angle over 34 degrees" 2 '0 to 34 can be reached' trimesh -m terrain -e 1 -q 34.1 plane.xyz

# --- what nearly meets ---

printf '>\n10 10 5\n30 20 5\n>\n10 10.000000001 5\n30 20.000000001 5\n' >near.txt
for options in "-m delaunay" "-l 1" "-m terrain -e 0.01"; do
    ok "two lines 1e-9 apart: $options" timeout 60 sh -c "trimesh --quiet $options plane.xyz near.txt >mesh.hm"
    true_that "all the ground is there" "($(ground mesh.hm) - 1600) ^ 2 < 1e-12"
done
for options in "-m quality -a 3" "-m terrain -e 0.01 -q 20"; do
    must_fail "no angles between two lines 1e-9 apart: $options" 2 'nearly meet at [12][0-9.]* 1[0-9.]*$' \
        timeout 60 trimesh --quiet $options plane.xyz near.txt
done
printf '0 0 0\n1e7 0 0\n0 1e-9 0\n1e7 1e-9 1\n5e6 5e-10 3\n' >thread.xyz
must_fail "nor on a thread of ground" 2 'borders nearly meet' timeout 60 trimesh -m quality thread.xyz

# --- heights ---

awk 'BEGIN { for (j = 0; j < 9; j++) for (i = 0; i < 9; i++) print i, j, i == 4 && j == 4 ? 1e308 : -1e308 }' >high.xyz
for options in "-m delaunay" "-l 2 -z mean" "-m quality -z fit" "-m terrain -e 1"; do
    must_fail "heights that overflow: $options" 2 'a height of -1e\+308 m at 0 0' trimesh $options high.xyz
done
printf '>\n10 10 1e200\n30 20 5\n' >line.txt
must_fail "of a breakline" 2 'height of 1e\+200 m at 10 10' trimesh -l 1 plane.xyz line.txt
printf '#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 40 40\n#fields x y z\n#data\n0 0 7\n40 0 1e300\n0 40 7\n40 40 7\n#end\n' >grid.hm
must_fail "of a grid" 2 'height of 1e\+300 m at 40 0' trimesh -l 1 plane.xyz grid.hm
done_testing
