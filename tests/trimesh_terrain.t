#!/bin/sh
# trimesh -m terrain, and -z fit: every measurement within the error, as quality(1) finds it; exact
# where the ground is plane; what is said, what is refused.
. "${0%/*}/tap.sh"

nodes() { grep -c '^v' "$1"; }
# worst MESH POINTS: the largest vertical distance of a measurement from the mesh
worst() {
    quality --quiet -r residuals.hm "$1" "$2" >/dev/null
    awk '/^#fields/ { for (i = 2; i <= NF; i++) if ($i == "residual") column = i - 1 }
         !/^#/ && $column != "nan" { r = $column < 0 ? -$column : $column; if (r > most) most = r }
         END { printf "%.12g\n", most }' residuals.hm
}

ground() { # FUNCTION of x, y: measurements on it, 41 x 41
    awk "BEGIN { for (y = 0; y < 41; y++) for (x = 0; x < 41; x++) printf \"%d %d %.17g\n\", x, y, $1 }"
}
ground '3 + x / 4 - y / 8' >plane.xyz
ground '(x < 20 ? x : 40 - x) / 2' >roof.xyz
ground 'sin(x / 7) * cos(y / 5) * 3' >hills.xyz

# --- the error ---

ok "a plane" trimesh -m terrain -e 0.001 plane.xyz -o plane.hm
true_that "needs no node but its corners" "$(nodes plane.hm) == 4"
ok "a roof" trimesh -m terrain -e 0.001 roof.xyz -o roof.hm
true_that "is exact, with nodes on its ridge only" "$(worst roof.hm roof.xyz) < 1e-12 && $(nodes roof.hm) <= 8"
printf '>\n20 0 10\n20 40 10\n' >ridge.txt
trimesh -m terrain -e 0.001 roof.xyz ridge.txt >ridge.hm
true_that "with a breakline along it with none" "$(nodes ridge.hm) == 6"
for e in 1 0.3 0.05; do
    trimesh --quiet -m terrain -e $e hills.xyz >hills.hm
    nodes hills.hm >>counts
    true_that "hills within $e m" "$(worst hills.hm hills.xyz) <= $e"
done
true_that "less error takes more nodes" "$(tr '\n' ' ' <counts | awk '{ print ($1 < $2 && $2 < $3 && $3 < 1681) }')"
ok "a budget" sh -c 'trimesh -m terrain -N 200 hills.xyz 2>said >budget.hm'
true_that "is used up" "$(nodes budget.hm) == 200"
true_that "the error left is said" \
    "($(sed -n 's/.*vertical error left is \([0-9.]*\) m.*/\1/p' said) / $(worst budget.hm hills.xyz) - 1) ^ 2 < 0.01 ^ 2"
trimesh --quiet -m terrain -e 0.3 -l 4 hills.xyz >apart.hm
true_that "no two nodes nearer than -l" "$(awk '/^v/ { x[n + 0] = $2; y[n + 0] = $3; n++ }
    END { for (i = 0; i < n; i++) for (j = 0; j < i; j++)
              if ((x[i] - x[j]) ^ 2 + (y[i] - y[j]) ^ 2 < 16) bad++
          print bad + 0 }' apart.hm) == 0"
trimesh --quiet -m terrain -e 0.3 -q 28 -a 40 hills.xyz >good.hm
true_that "and good angles on top" "$(quality --quiet good.hm hills.xyz |
    awk '/smallest angle  / { print $3 }') >= 28"

for i in 0 5; do
    ok "within 0.3 m, with 28 degrees, $i passes of smoothing" \
        sh -c "trimesh -m terrain -e 0.3 -q 28 -a 40 -i $i hills.xyz 2>said >both$i.hm"
    true_that "both hold" "$(worst both$i.hm hills.xyz) <= 0.3 && $(quality --quiet both$i.hm hills.xyz |
        awk '/smallest angle  / { print $3 }') >= 28"
    true_that "and nothing is said of errors left" "$(grep -c error said) == 0"
    quality --quiet both$i.hm hills.xyz | awk '$1 == "all" { print $8 }' >rmse$i
done
true_that "smoothing takes no node" "$(nodes both0.hm) == $(nodes both5.hm)"
true_that "and brings the mesh nearer to the ground" "$(cat rmse5) < 0.9 * $(cat rmse0)"
trimesh --quiet -m terrain -e 0.3 -q 25 -g 2 hills.xyz >even.hm
true_that "gradation, too, keeps to the error" "$(worst even.hm hills.xyz) <= 0.3"
trimesh --quiet -m terrain -e 0.3 -L 5 hills.xyz >short.hm
true_that "or edges" "$(awk '/^v/ { x[n + 0] = $2; y[n + 0] = $3; n++ }
    /^t/ { for (i = 2; i < 5; i++) { a = $i; b = $(i == 4 ? 2 : i + 1)
        if ((x[a] - x[b]) ^ 2 + (y[a] - y[b]) ^ 2 > 25) bad++ } }
    END { print bad + 0 }' short.hm) == 0"

# --- fitted heights ---

trimesh --quiet -m quality -a 20 -z fit plane.xyz >fit.hm
true_that "fitted to a plane: the plane" "$(worst fit.hm plane.xyz) < 1e-9"
hmsurvey -n 60000 -b 0 -s 0.2 . >/dev/null
for z in terrain fit; do
    trimesh --quiet -m quality -a 60 -z $z survey.xyz lines.txt >$z.hm
    quality --quiet $z.hm survey.xyz | awk '$1 == "all" { print $8 }' >$z.rmse
done
true_that "noisy measurements: fitted heights miss them by less" "$(cat fit.rmse) < 0.9 * $(cat terrain.rmse)"

# --- rivers ---

bsgrid --quiet -d 2 survey.xyz | slope | breaklines --quiet -s 8 -l 30 -r 6 >breaklines.hm
bsmesh --quiet -s main -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz >main.hm
for j in 1 2; do
    trimesh --quiet -m terrain -l 3 -N 3000 -q 25 -z fit -j $j survey.xyz breaklines.hm lines.txt main.hm >flood$j.hm
done
same "the same bytes with one thread and two" flood1.hm flood2.hm
awk '/^#/ { next } { print | "sort -k2,2 -k1,1" }' survey.xyz >shuffled.xyz
trimesh --quiet -m terrain -l 3 -N 3000 -q 25 -z fit shuffled.xyz breaklines.hm lines.txt main.hm >flood.hm
grep '^[vt]' flood.hm >a
grep '^[vt]' flood1.hm >b
same "and in another order of the measurements" a b
ok "beside a regular mesh both make one" sh -c 'stitch --quiet main.hm flood1.hm >hybrid.hm'

# --- refusals ---

must_fail "neither error nor budget" 2 'needs a maximum error' trimesh -m terrain hills.xyz
must_fail "no error" 2 'max-error' trimesh -m terrain -e 0 hills.xyz
must_fail "an error for the paper's mesh" 2 '-e means nothing' trimesh -l 2 -e 1 hills.xyz
must_fail "edges up to a length, without any" 2 '-L means nothing' trimesh -m delaunay -L 2 hills.xyz
must_fail "the neighbours' mean" 2 'mean means nothing' trimesh -m terrain -e 1 -z mean hills.xyz
printf '#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 9 9\n#fields x y z\n#data\n0 0 7\n9 0 7\n0 9 7\n9 9 7\n#end\n' >flat.hm
printf '> boundary=1 closed=1\n1 1\n8 1\n8 8\n' >outline.txt
must_fail "a grid alone" 2 'needs measurements' trimesh -m terrain -e 1 flat.hm outline.txt
: >empty
must_fail "nothing" 2 'empty' trimesh -m terrain -e 1 empty
printf '0 0 1\n1 1 1\n2 2 1\n' >line.xyz
must_fail "all on a line" 2 'on one line' trimesh -m terrain -e 1 line.xyz
done_testing
