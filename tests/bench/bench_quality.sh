#!/bin/sh
# Speed and memory of quality: 10 million points (or the first argument) against a mesh of a million
# elements, on two threads, medians of five (or RUNS): a line a case with seconds or megabytes and the
# limit. Status 1 when a limit is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}" "${RUNS:=5}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
points=${1:-10000000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
command -v /usr/bin/time >/dev/null || { echo "time is not installed"; exit 2; }
missed=0
good=0

# measure COMMAND: seconds to the file t, kilobytes to m
measure() { /usr/bin/time -o tm -f '%e %M' sh -c "$1" >/dev/null 2>err || { cat err >&2; exit 2; }; read -r t m <tm; }
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
noisy() { sort -n "$1" | awk '{ v[NR] = $1 } END { exit !(v[int((3 * NR + 3) / 4)] > 1.5 * v[int((NR + 3) / 4)]) }'; }

# judge NAME VALUE LIMIT NOTE
judge() {
    if awk "BEGIN { exit !($2 <= $3) }"; then word=ok good=$((good + 1)); else word=MISS missed=$((missed + 1)); fi
    printf '%-56s %9.2f %9.2f  %s\n' "$1" "$2" "$3" "$word$4"
}
# seconds NAME LIMIT COMMAND
seconds() {
    : >times
    for _ in $(seq "$RUNS"); do
        measure "$3"
        echo "$t" >>times
    done
    note=
    if noisy times; then note=" (noisy machine)"; fi
    judge "$1" "$(median times)" "$2" "$note"
}

width=$(awk "BEGIN { print 3000 * sqrt($points / 1e7) }")
hmcloud "$points" "$width" >points.hm
hmcloud $((points / 10)) "$width" >tenth.hm
hmcloud $((points / 19)) "$width" | trimesh --quiet -b -m delaunay >mesh.hm
elements=$(hmconv --info mesh.hm | awk '$1 == "elements" { print $2 }')

printf '%-56s %9s %9s\n' "$points points, $elements elements, two threads" measured limit
seconds "seconds, streams in binary" 4 "quality -j 2 --quiet mesh.hm points.hm"
hmconv -t xyz points.hm >points.xyz
seconds "seconds, points as a table" 4 "quality -j 2 --quiet mesh.hm points.xyz"
measure "quality -j 2 --quiet mesh.hm points.hm"
all=$m
measure "quality -j 2 --quiet mesh.hm tenth.hm"
judge "memory of all points over that of a tenth" "$(awk "BEGIN { print $all / $m }")" 1.02 ""
echo "$good ok, $missed missed"
[ $missed = 0 ]
