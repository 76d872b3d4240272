#!/bin/sh
# Speed of regular meshes and seams: a mesh of a million elements from a million points; meshes of a
# million elements and of two thirds of that, which overlap, stitched. Wall clock, medians of five (or RUNS), against
# the seconds asked for. Status 1 when one is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}" "${RUNS:=5}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
command -v /usr/bin/time >/dev/null || { echo "/usr/bin/time is not installed"; exit 2; }
good=0
missed=0

# within NAME SECONDS COMMAND: a line of the table
within() {
    : >times
    for _ in $(seq "$RUNS"); do
        /usr/bin/time -o t -f %e sh -c "$3" 2>said || { echo "failed: $3"; cat said; exit 2; }
        cat t >>times
    done
    sort -n times >sorted
    median=$(awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }' sorted)
    note=$(awk '{ v[NR] = $1 } END { if (v[NR] > 1.5 * v[1]) print " (noisy machine)" }' sorted)
    if awk "BEGIN { exit !($median <= $2) }"; then word=ok good=$((good + 1)); else word=MISS missed=$((missed + 1)); fi
    printf '%-58s %6.2f s  <= %s  %s%s\n' "$1" "$median" "$2" $word "$note"
}

hmcloud 1000000 1400 >points.hm
cat >lines.txt <<'END'
> surface=main side=left along=10 across=10 elements=1.38/1.38
10 1000
1390 1000
> surface=main side=right
10 300
1390 300
> surface=tributary side=left along=10 across=10 elements=1.38/1.38
10 400
900 1300
> surface=tributary side=right
400 100
1300 1000
END
bsmesh -b lines.txt points.hm >meshes.hm 2>made
within "bsmesh: $(sed -n 's/.*main: .* nodes, //p' made), 1000000 points" 3 "bsmesh -b -s main lines.txt points.hm >mesh.hm"
within "stitch: of $(sed -n 's/.* nodes, \([0-9]*\) elements/\1/p' made | paste -s -d+) elements" 3 "stitch -b meshes.hm >river.hm"
echo "$good ok, $missed missed"
exit $((missed > 0))
