#!/bin/sh
# trimesh: the paper's coarsening and refinement by hand, the seam with a regular mesh, what is said,
# what is refused.
. "${0%/*}/tap.sh"

nodes() { grep -c '^v' "$1"; }
area() { # of a mesh of triangles
    awk '/^v/ { if (!n) { x0 = $2; y0 = $3 } x[n + 0] = $2 - x0; y[n + 0] = $3 - y0; n++ }
         /^t/ { a += (x[$3] - x[$2]) * (y[$4] - y[$2]) - (y[$3] - y[$2]) * (x[$4] - x[$2]) }
         END { printf "%.9g\n", a / 2 }' "$1"
}
square() { # n × n points 1 m apart, z = x + 2y
    awk -v n="$1" 'BEGIN { for (j = 0; j < n; j++) for (i = 0; i < n; i++) print i, j, i + 2 * j }'
}
regular() { # X0 Y0 X1 Y1: a regular mesh of two triangles
    printf '#hm 1 mesh text\n#name river\n#role regular\n#owners river\n#data\n'
    printf 'v %s %s 1 5 1\nv %s %s 1 5 1\nv %s %s 1 5 1\nv %s %s 1 5 1\n' \
        "$1" "$2" "$3" "$2" "$3" "$4" "$1" "$4"
    printf 't 0 1 2 0\nt 0 2 3 0\n#end\n'
}

# says NAME PATTERN COMMAND …: succeeds, and says on standard error what matches
says() {
    name=$1 pattern=$2
    shift 2
    "$@" 2>said
    status=$?
    [ $status -eq 0 ] && grep -Eq -- "$pattern" said
    good=$?
    report $good "$name"
    [ $good -eq 0 ] || { echo "# status $status, wanted 0 and /$pattern/"; sed 's/^/# /' said; }
}

# --- the paper's figures ---

frame='-100 -100 0|100 -100 0|100 100 0|-100 100 0'
printf -- "$frame|0 0 3|3 0 6|0 3 9" | tr '|' '\n' >nine.xyz
ok "figure 9: a small triangle" trimesh -l 5 -L 500 -i 0 -z mean nine.xyz -o nine.hm
true_that "becomes one node" "$(nodes nine.hm) == 5"
ok "at its centre, its height the mean" grep -q '^v 1 1 6 0 0' nine.hm
trimesh -l 5 -L 500 -i 0 nine.xyz >nine.hm
true_that "or the terrain's, which here is the same" "$(awk '/^v 1 1/ { print $4 }' nine.hm) == 6"
printf -- "$frame|0 0 3|3 0 6" | tr '|' '\n' >edge.xyz
trimesh -l 5 -L 500 -i 0 -z mean edge.xyz >edge.hm
ok "a single edge shrinks to its middle" grep -q '^v 1.5 0 4.5 0 0' edge.hm
printf -- "$frame|99 98 7" | tr '|' '\n' >corner.xyz
trimesh -l 5 -L 500 -i 0 corner.xyz >corner.hm
true_that "one with a fixed end shrinks onto that" "$(nodes corner.hm) == 4"
ok "which stays" grep -q '^v 100 100 0 5 0' corner.hm
printf '0 0 0\n9 0 9\n4 8 4\n' >ten.xyz
trimesh -l 1 -L 8 -i 0 ten.xyz >ten.hm
ok "figure 10: a large triangle gets its centre" grep -Eq '^v 4.33333333333333[0-9]* 2.66666666666666[0-9]* ' ten.hm
ok "a large edge its middle" grep -q '^v 4.5 0 4.5 5 0' ten.hm
ok "--steps" trimesh -l 1 -L 8 --steps steps ten.xyz -o ten.hm
ok "writes the start" [ -s steps/001-start.hm ]
ok "and every round" [ -s steps/002-refine-triangles.hm ]
hmconv -i steps/*.hm >info
true_that "as whole meshes" "$(grep -ci 'mesh' info) >= 3"

# --- a survey ---

hmsurvey -n 20000 . >/dev/null
bsgrid --quiet -d 2 survey.xyz | slope | breaklines --quiet -s 8 -l 30 -r 6 >breaklines.hm
bsmesh --quiet -s main -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz >main.hm
says "floodplain of a small survey" 'breaklines cut' \
    trimesh -l 6 -L 15 survey.xyz breaklines.hm lines.txt main.hm -o flood.hm
ok "irregular" grep -q '^#role irregular' flood.hm
ok "owners come along" grep -q '^#owners main' flood.hm
trimesh --quiet -j 1 -l 6 -L 15 survey.xyz breaklines.hm lines.txt main.hm >one.hm
trimesh --quiet -j 2 -l 6 -L 15 survey.xyz breaklines.hm lines.txt main.hm >two.hm
same "the same bytes with one thread and two" one.hm two.hm
hmconv -t text main.hm |
    awk '/^q/ { print "t", $2, $3, $4; print "t", $2, $4, $5; next } 1' >triangles.hm
outline=$(awk '/^>/ { on = /boundary=1/; next }
               on { if (!n) { x0 = $1; y0 = $2 } x[n + 0] = $1 - x0; y[n + 0] = $2 - y0; n++ }
               END { for (i = 0; i < n; i++) { j = (i + 1) % n; a += x[i] * y[j] - x[j] * y[i] }
                     printf "%.9g", a < 0 ? -a / 2 : a / 2 }' lines.txt)
true_that "river and floodplain fill the outline, which is bent where the river leaves it" \
    "(($(area flood.hm) + $(area triangles.hm)) / $outline - 1) ^ 2 < 0.002 ^ 2"
trimesh -b -l 6 -L 15 survey.xyz breaklines.hm lines.txt main.hm 2>/dev/null | hmconv -t text >binary.hm
grep -v '^#prog' flood.hm >a.hm
grep -v '^#prog' binary.hm >b.hm
same "binary is the same mesh" a.hm b.hm
trimesh --quiet -m delaunay survey.xyz >tin.hm
true_that "delaunay: every measurement is a node" "$(nodes tin.hm) == $(grep -vc '^#' survey.xyz)"

# --- what is mended, what is said ---

square 21 >square.xyz
printf '> \n2.5 2.5\n17.5 17.5\n> \n2.5 16.9\n17.5 2.2\n> \n2.5 2.5\n17.5 17.5\n' >cross.txt
says "crossing and double breaklines" 'lines mended: 1 crossing,.* [1-9][0-9]* pieces drawn twice' \
    trimesh -l 2 square.xyz cross.txt -o cross.hm
says "with -v each with its place" 'lines cross at 9[0-9.]* 9[0-9.]*$' trimesh -v -l 2 square.xyz cross.txt -o cross.hm
ok "their heights come from the terrain" grep -q '6 vertices of breaklines' said
must_fail "--strict" 1 'lines mended' trimesh --strict -l 2 square.xyz cross.txt
cat square.xyz square.xyz >twice.xyz
says "measurements given twice" '441 points at the place of another: their mean height counts' trimesh -m delaunay twice.xyz -o twice.hm
true_that "are merged" "$(nodes twice.hm) == 441"
awk 'BEGIN { print "> "; for (i = 0; i <= 40; i++) print 2 + i * 0.4, 9.8, 1 }' >fine.txt
says "short segments" 'resample' trimesh -l 4 square.xyz fine.txt -o fine.hm
says "a maximum under twice the minimum" 'under twice' trimesh -l 4 -L 5 square.xyz -o narrow.hm
printf '> boundary=1 closed=1\n0 0\n20 0\n20 20\n0 20\n' >outline.txt
printf '#hm 1 grid text\n#size 2 2\n#origin -5 -5\n#step 30 30\n#fields x y z\n#data\n-5 -5 7\n25 -5 7\n-5 25 7\n25 25 7\n#end\n' >flat.hm
ok "an outline and a grid, no points" trimesh -l 2 outline.txt flat.hm -o flat_mesh.hm
true_that "all at the grid's height" "$(awk '/^v/ && $4 != 7' flat_mesh.hm | wc -l) == 0"
true_that "over the outline" "($(area flat_mesh.hm) - 400) ^ 2 < 1e-12"

# --- refusals ---

regular 4 4 10 10 >r1.hm
regular 8 8 16 16 >r2.hm
must_fail "overlapping regular meshes" 2 'stitch' trimesh -l 2 square.xyz r1.hm r2.hm
regular 4.5 4.5 16.5 16.5 >r3.hm
regular 8 8 12 12 >r4.hm
must_fail "one within the other" 2 'stitch' trimesh -l 2 square.xyz r3.hm r4.hm
regular 10 4 16 10 >r5.hm
ok "regular meshes side by side" trimesh -l 2 square.xyz r1.hm r5.hm -o beside.hm
true_that "leave both as holes" "($(area beside.hm) - (400 - 72)) ^ 2 < 1e-12"
must_fail "minimum over maximum" 2 'must be more' trimesh -l 5 -L 4 square.xyz
must_fail "paper without a length" 2 'needs a minimum' trimesh square.xyz
must_fail "a mesh beyond all memory" 2 'nodes on' trimesh -l 1e-5 square.xyz
printf '> boundary=1 closed=1\n0 0\n20 20\n20 0\n0 20\n' >bow.txt
must_fail "an outline that crosses itself" 2 'outline meets itself' trimesh -l 2 square.xyz bow.txt
printf '> boundary=1 closed=1\n100 100\n120 100\n120 120\n' >away.txt
must_fail "no points inside" 2 'no measurement lies inside .* at [0-9]' trimesh -l 2 square.xyz away.txt
printf '> region=wet closed=1\n1 1\n5 1\n5 5\n' >wet.txt
must_fail "a region without a number" 2 'wet' trimesh -l 2 square.xyz wet.txt
must_fail "lines alone without heights" 2 'height' trimesh -l 2 outline.txt
: >empty
must_fail "nothing" 2 'empty' trimesh -l 2 empty
echo '1 2 3' >one.xyz
must_fail "one point" 2 'three points' trimesh -l 2 one.xyz
printf '0 0 1\n1 1 1\n2 2 1\n3 3 1\n' >line.xyz
must_fail "all on a line" 2 'on one line' trimesh -l 2 line.xyz
printf '1 1 1\n1 1 1\n1 1 1\n' >equal.xyz
must_fail "all equal" 2 'one place' trimesh -l 2 equal.xyz
[ -e /dev/full ] && must_fail "a full disk" 2 'space' sh -c 'trimesh -l 2 square.xyz >/dev/full'

# --- real terrain ---

if need_data danube_deggendorf/points.xyz; then
    ok "Danube" trimesh -l 8 -L 20 "$DATA/danube_deggendorf/points.xyz" -o danube.hm
    true_that "as many nodes as its size wants" "$(nodes danube.hm) > 30000 && $(nodes danube.hm) < 90000"
fi
printf '0 0 nan\n9 0 nan\n0 9 nan\n' >nan.xyz
printf '> boundary=1 closed=1\n1 1\n4 1\n4 4\n' >inside.txt
must_fail "no height at all" 2 'no measurement has a height' trimesh -l 1 nan.xyz
must_fail "nor with an outline" 2 'nothing tells the height of a node: no measurement.* at 1 1' trimesh -l 1 nan.xyz inside.txt
printf '> hole=1 closed=1\n1 1\n' >point.txt
must_fail "a hole of a vertex" 2 'hole has only 1 vertex at 1 1' trimesh -l 1 square.xyz point.txt
printf '> hole=1 closed=1\n1 1\n2 2\n' >point.txt
must_fail "a hole of two" 2 'hole has only 2 vertices at 1 1' trimesh -l 1 square.xyz point.txt

# --- ground that nobody surveyed, and ground that is none ---
{ square 20; echo 200 0 0; echo 200 20 0; } >far.xyz
says "half of it is a gap" '3.*e\+03 of 3.*e\+03 m2 \([89][0-9] %\) lie between measurements over 15 m apart.*boundary=1' \
    trimesh -l 1 -L 3 far.xyz -o far.hm
says "also for other methods" 'lie between measurements over 10' trimesh -m delaunay far.xyz -o far.hm
trimesh -l 1 -L 3 square.xyz -o far.hm 2>said
ok "else nothing is said" sh -c '! grep between.measurements said'
printf '0 0 0\n1e7 0 0\n0 1e-9 0\n1e7 1e-9 1\n5e6 5e-10 3\n' >thread.xyz
must_fail "a thread of ground" 2 'about 8e\+06 nodes on 0.01 m2 and along 2e\+07 m' timeout 20 trimesh -l 1 thread.xyz

done_testing
