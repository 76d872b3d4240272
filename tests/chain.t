#!/bin/sh
# The whole chain on a small survey: what must hold of its products, and of their bytes.
. "${0%/*}/tap.sh"

ok "the chain runs" "$TESTS/small_chain" .

# Bytes do not depend on the run nor on the number of threads.
mkdir again one
ok "it runs again" "$TESTS/small_chain" again
for file in dem slope breaklines regular river flood hybrid; do
    same "the same run twice: $file" $file.hm again/$file.hm
done
for file in dem slope breaklines regular river flood hybrid; do
    case $file in
    dem) command="bsgrid -d 2 survey.xyz" ;;
    slope) command="slope dem.hm" ;;
    breaklines) command="breaklines -s 13 -l 30 -r 6 slope.hm" ;;
    regular) command="bsmesh -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz" ;;
    river) command="stitch -c regular.hm survey.xyz" ;;
    flood) command="trimesh -l 6 -L 20 survey.xyz breaklines.hm lines.txt river.hm" ;;
    hybrid) command="stitch river.hm flood.hm" ;;
    esac
    $command -j 1 >one/$file.hm 2>/dev/null
    same "one thread as two: $file" $file.hm one/$file.hm
done
quality -j 1 hybrid.hm survey.xyz >one/quality.txt
same "one thread as two: quality" quality.txt one/quality.txt

# Text, binary and text again: the same bytes.
for file in dem slope breaklines regular river flood hybrid; do
    hmconv -t binary $file.hm | hmconv -t text >back.hm
    same "text, binary, text: $file" $file.hm back.hm
done
hmconv -t text survey.xyz >survey.hm
hmconv -t binary survey.hm | hmconv -t text >back.hm
same "text, binary, text: points" survey.hm back.hm

# A binary pipe carries the same numbers as files of text.
bsgrid -b -d 2 survey.xyz | slope -b | breaklines -s 13 -l 30 -r 6 >piped.hm 2>/dev/null
same "breaklines through binary pipes" breaklines.hm piped.hm

# The hybrid mesh covers its domain once: the elements' areas add up to the area of the outline.
area=$(awk 'BEGIN { n = 0 } /^v/ { x[n] = $2 - 545000; y[n++] = $3 - 5972000 }
    /^[tq]/ { m = /^t/ ? 3 : 4
        for (i = 0; i < m; i++) { a = $(2 + i); b = $(2 + (i + 1) % m); s += x[a] * y[b] - x[b] * y[a] } }
    END { printf "%.17g", s / 2 }' hybrid.hm)
outline=$(awk 'BEGIN { n = 0 } /^>/ { on = /boundary=1/; next } on && !/^#/ { x[n] = $1 - 545000; y[n++] = $2 - 5972000 }
    END { for (i = 0; i < n; i++) { j = (i + 1) % n; s += x[i] * y[j] - x[j] * y[i] }
          printf "%.17g", s < 0 ? -s / 2 : s / 2 }' lines.txt)
true_that "area of the elements $area against the outline $outline" \
    "($area - $outline) ^ 2 <= (1e-9 * $outline) ^ 2"
ok "the hybrid mesh is valid" quality --check valid hybrid.hm survey.xyz

# A plane survey: slope exact, residuals nil.
awk '!/^#/ { $3 = 0.02 * ($1 - 545000) - 0.01 * ($2 - 5972000) + 7; printf "%s %s %.17g\n", $1, $2, $3 }' \
    survey.xyz >plane.xyz
bsgrid -d 2 plane.xyz | slope >plane.hm
worst=$(awk 'BEGIN { want = atan2(sqrt(0.02 ^ 2 + 0.01 ^ 2), 1) * 180 / atan2(0, -1) }
    !/^#/ && $4 != "nan" { e = $4 - want; if (e < 0) e = -e; if (e > most) most = e }
    END { printf "%.3g", most }' plane.hm)
true_that "slope of a plane, degrees off" "$worst < 1e-9"
bsmesh -c 15/6 -e 12/5 lines.txt plane.xyz | stitch -c - plane.xyz >plane_river.hm
trimesh -l 6 -L 20 plane.xyz lines.txt plane_river.hm | stitch plane_river.hm - >plane_hybrid.hm
quality -r residuals.hm plane_hybrid.hm plane.xyz >/dev/null
worst=$(awk '!/^#/ && $4 != "nan" { e = $4 < 0 ? -$4 : $4; if (e > most) most = e; n++ }
    END { printf "%.3g", n ? most : 1 }' residuals.hm)
true_that "residuals of a plane, metres" "$worst < 1e-9"

# History: a line a stage, in order.
stages=$(awk '/^#prog/ { print $2 }' hybrid.hm | tr '\n' ' ')
true_that "the mesh tells how it was made: $stages" \
    "\"$stages\" ~ /^bsgrid slope breaklines bsmesh stitch trimesh stitch /"
done_testing
