#!/bin/sh
# How long trimesh takes as a whole, with reading and writing: -m terrain to a tenth of the measurements on
# two threads, how that grows, and its memory; -m paper on the dense tile (needs HM_DATA), and how that
# grows. Medians of RUNS (3). Status 1 when a goal is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}" "${RUNS:=3}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
[ -x /usr/bin/time ] || { echo "/usr/bin/time is not installed"; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
good=0
missed=0

median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# run COMMAND: medians of wall clock (s), processor time (s) and memory (MB) to $wall, $cpu, $memory
run() {
    : >walls
    : >cpus
    : >memories
    for _ in $(seq "$RUNS"); do
        /usr/bin/time -o t -f '%e %U %S %M' sh -c "$1" >/dev/null || { echo "failed: $1" >&2; exit 2; }
        awk '{ print $1 >>"walls"; print $2 + $3 >>"cpus"; print $4 / 1000 >>"memories" }' t
    done
    wall=$(median walls) cpu=$(median cpus) memory=$(median memories)
}
# goal NAME VALUE GOAL UNIT
goal() {
    if awk "BEGIN { exit !($2 <= $3) }"; then word=ok good=$((good + 1)); else word=MISS missed=$((missed + 1)); fi
    awk -v n="$1" -v v="$2" -v g="$3" -v u="$4" -v w=$word 'BEGIN { printf "%-56s %8.2f  goal <= %6.2f %-10s %s\n", n, v, g, u, w }'
}

hmcloud 250000 1000 >quarter.hm
hmcloud 1000000 2000 >million.hm
run "trimesh -b --quiet -j 2 -m terrain -N 25000 quarter.hm"
quarter=$cpu
run "trimesh -b --quiet -j 2 -m terrain -N 100000 million.hm"
goal "terrain, 1 million measurements to 100,000 nodes" "$wall" 5 s
goal "  growth from 250,000, over that of n log n" \
    "$(awk "BEGIN { print $cpu / $quarter / (4 * log(1e6) / log(2.5e5)) }")" 1.2 ""
goal "  memory" "$(awk "BEGIN { print $memory }")" 160 "B a point"

tile=${HM_DATA:-/nonexistent}/lidarhd_farmland_dense/points_ground.xyz.gz
if [ -e "$tile" ]; then
    gzip -dc "$tile" >tile.xyz
    for edge in 1 2 4; do
        run "trimesh -b --quiet -j 2 -l $edge tile.xyz"
        goal "paper, dense tile (683,023), -l $edge" "$wall" 5 s
    done
else
    echo "the dense tile is not there (set HM_DATA)"
fi
run "trimesh -b --quiet -j 2 -l 4 quarter.hm"
quarter=$cpu
run "trimesh -b --quiet -j 2 -l 4 million.hm"
goal "paper, growth from 250,000 to 1 million, over that of n" "$(awk "BEGIN { print $cpu / $quarter / 4 }")" 1.2 ""
echo "$good ok, $missed missed"
[ $missed -eq 0 ]
