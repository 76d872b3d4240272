#!/bin/sh
# The whole chain on a small survey: what must hold of its products, and of their bytes.
. "${0%/*}/tap.sh"

ok "the chain runs" "$TESTS/small_chain" .

# Bytes do not depend on the run nor on the number of threads.
mkdir again threads
ok "it runs again" "$TESTS/small_chain" again
for file in dem slope breaklines regular river flood hybrid; do
    same "the same run twice: $file" $file.hm again/$file.hm
done
command_of() {
    case $1 in
    dem) echo "bsgrid -d 2 survey.xyz" ;;
    slope) echo "slope dem.hm" ;;
    breaklines) echo "breaklines -s 13 -l 30 -r 6 slope.hm" ;;
    regular) echo "bsmesh -c 15/6 -e 12/5 lines.txt breaklines.hm survey.xyz" ;;
    river) echo "stitch -c regular.hm survey.xyz" ;;
    flood) echo "trimesh -l 6 -L 20 survey.xyz breaklines.hm lines.txt river.hm" ;;
    hybrid) echo "stitch river.hm flood.hm lines.txt" ;;
    esac
}
for file in dem slope breaklines regular river flood hybrid; do
    for j in 1 2 7; do
        $(command_of $file) -j $j >threads/$file.hm 2>/dev/null
        same "-j $j: $file" $file.hm threads/$file.hm
    done
done
for j in 1 2 7; do
    quality -j $j hybrid.hm survey.xyz >threads/quality.txt
    same "-j $j: quality" quality.txt threads/quality.txt
done

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

# Every segment of a breakline, both of whose ends trimesh kept, is a chain of mesh edges: the nodes
# on it, in order, are joined by edges. Counted: segments kept, and those that are no chain.
cat >chains.awk <<'END'
/^#/ { next }
FNR == NR && /^v/ { x[n] = $2; y[n] = $3; node[$2 " " $3] = n++; next }
FNR == NR { for (i = 2; i <= 4; i++) { j = i % 3 + 2; edge[$i, $j] = edge[$j, $i] = 1 } next }
/^>/ { a = ""; next }
{ b = ($1 " " $2) in node ? node[$1 " " $2] : ""
  if (a != "" && b != "") check(a, b)
  a = b }
function check(a, b,    k, m, dx, dy, t, at, on, i, j, swap) {
    kept++
    if ((a, b) in edge) return
    dx = x[b] - x[a]; dy = y[b] - y[a]; m = 0
    for (k = 0; k < n; k++) {
        t = ((x[k] - x[a]) * dx + (y[k] - y[a]) * dy) / (dx * dx + dy * dy)
        if (t < 0 || t > 1 || ((x[k] - x[a]) * dy - (y[k] - y[a]) * dx) ^ 2 > 1e-12 * (dx * dx + dy * dy)) continue
        for (i = m++; i > 0 && at[i - 1] > t; i--) { at[i] = at[i - 1]; on[i] = on[i - 1] }
        at[i] = t; on[i] = k
    }
    for (i = 1; i < m; i++) if (!((on[i - 1], on[i]) in edge)) { broken++; return }
}
BEGIN { n = 0 }
END { print kept + 0, broken + 0 }
END
set -- $(awk -f chains.awk flood.hm breaklines.hm)
true_that "breaklines are chains of mesh edges: segments kept and broken: $*" "$1 > 100 && $2 == 0"

# The hybrid mesh covers its domain once: the elements' areas add up to the area of the outline.
cat >area.awk <<'END'
BEGIN { n = 0 }
/^v/ { x[n] = $2 - 545000; y[n++] = $3 - 5972000 }
/^[tq]/ { m = /^t/ ? 3 : 4
    for (i = 0; i < m; i++) { a = $(2 + i); b = $(2 + (i + 1) % m); s += x[a] * y[b] - x[b] * y[a] } }
END { printf "%.17g", s / 2 }
END
# area of the closed line whose attributes match: ring_area PATTERN FILE
ring_area() {
    awk -v pattern="$1" 'BEGIN { n = 0 } /^>/ { on = $0 ~ pattern; next }
        on && !/^#/ { x[n] = $1 - 545000; y[n++] = $2 - 5972000 }
        END { for (i = 0; i < n; i++) { j = (i + 1) % n; s += x[i] * y[j] - x[j] * y[i] }
              printf "%.17g", s < 0 ? -s / 2 : s / 2 }' "$2"
}
# The tour's outline bends to the rivers' corners where they reach through it; this one holds them.
awk '!/^#/ { if (!n++) { w = e = $1; s = t = $2 }
        if ($1 < w) w = $1; if ($1 > e) e = $1; if ($2 < s) s = $2; if ($2 > t) t = $2 }
    END { w += 1.5; s += 1.5; e -= 1.5; t -= 1.5; printf "> boundary=1 closed=1\n"
          printf "%.2f %.2f\n%.2f %.2f\n%.2f %.2f\n%.2f %.2f\n", w, s, e, s, e, t, w, t }' \
    survey.xyz >outline.txt
trimesh -l 6 -L 20 survey.xyz breaklines.hm outline.txt river.hm 2>/dev/null |
    stitch river.hm - >whole.hm 2>/dev/null
area=$(awk -f area.awk whole.hm)
outline=$(ring_area boundary=1 outline.txt)
true_that "area of the elements $area against the outline $outline" \
    "($area - $outline) ^ 2 <= (1e-9 * $outline) ^ 2"
cat >building.txt <<'END'
> hole=1 closed=1
545060 5972210
545078 5972212
545076 5972226
545058 5972223
END
trimesh -l 6 -L 20 survey.xyz breaklines.hm outline.txt building.txt river.hm 2>/dev/null |
    stitch river.hm - >with_hole.hm
area=$(awk -f area.awk with_hole.hm)
outline=$(awk "BEGIN { printf \"%.17g\", $outline - $(ring_area hole=1 building.txt) }")
true_that "area with a building left out: $area of $outline" \
    "($area - $outline) ^ 2 <= (1e-9 * $outline) ^ 2"

# Without an outline the mesh fills the convex hull of the points.
trimesh -l 6 -L 20 survey.xyz breaklines.hm >hull_mesh.hm 2>/dev/null
hull=$(sort -k1,1n -k2,2n survey.xyz | awk '
    function turn(i, j, k) { return (x[j] - x[i]) * (y[k] - y[i]) - (y[j] - y[i]) * (x[k] - x[i]) }
    !/^#/ { x[n] = $1 - 545000; y[n] = $2 - 5972000; n++ }
    BEGIN { n = 0 }
    END {
        for (i = 0; i < n; i++) { while (m >= 2 && turn(h[m - 2], h[m - 1], i) <= 0) m--; h[m++] = i }
        floor = m + 1
        for (i = n - 2; i >= 0; i--) { while (m >= floor && turn(h[m - 2], h[m - 1], i) <= 0) m--; h[m++] = i }
        for (i = 0; i + 1 < m; i++) s += x[h[i]] * y[h[i + 1]] - x[h[i + 1]] * y[h[i]]
        printf "%.17g", s / 2 }')
area=$(awk -f area.awk hull_mesh.hm)
true_that "area without an outline: $area, hull $hull" "($area - $hull) ^ 2 <= (1e-9 * $hull) ^ 2"
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
before=$(grep -c '^#prog' hybrid.hm)
after=$(stitch hybrid.hm 2>/dev/null | stitch 2>/dev/null | stitch 2>/dev/null | grep -c '^#prog')
true_that "a line a stage, of equal stages too: $before, then $after" "$after == $before + 3"
done_testing
