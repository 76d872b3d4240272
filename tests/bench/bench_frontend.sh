#!/bin/sh
# Speed from points to breaklines against GMT and GDAL, runs of both by turns, medians of five (or RUNS):
# a line a case with the times, their ratio and the goal; then a pipe of POINTS points (100 million, or the
# first argument) on a grid of 5000 x 5000 and the memory of each process.
# Status 1 when a goal is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}" "${RUNS:=5}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
points=${1:-100000000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for peer in gmt gdaldem gdal_grid gdal_contour /usr/bin/time; do
    command -v $peer >/dev/null || { echo "$peer is not installed"; exit 2; }
done
missed=0
good=0

# seconds COMMAND: wall clock
seconds() { /usr/bin/time -o t -f '%e' sh -c "$1" >/dev/null 2>&1 || { echo "failed: $1" >&2; exit 2; }; cat t; }
# of FILE: median and, of the middle half, the spread over it
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
noisy() { sort -n "$1" | awk '{ v[NR] = $1 } END { exit !(v[int((3 * NR + 3) / 4)] > 1.5 * v[int((NR + 3) / 4)]) }'; }

# against NAME GOAL OURS PEER: a line of the table
against() {
    : >ours
    : >peers
    for run in $(seq "$RUNS"); do
        seconds "$3" >>ours
        seconds "$4" >>peers
    done
    note=
    if noisy ours || noisy peers; then note=" (noisy machine)"; fi
    judge "$1" "$(median ours)" "$(median peers)" "$2" "$note"
}
judge() {
    if awk "BEGIN { exit !($2 <= $4 * $3) }"; then word=ok good=$((good + 1)); else word=MISS missed=$((missed + 1)); fi
    awk -v n="$1" -v a="$2" -v b="$3" -v g="$4" -v w="$word$5" \
        'BEGIN { printf "%-44s %9.2f %9.2f %7.3f %7.3f  %s\n", n, a, b, a / b, g, w }'
}

hmcloud 1000000 1400 >p.hm
hmconv p.hm | awk '!/^#/' >p.xyz
gmt convert p.xyz -bo3d >p.bin
{ echo x,y,z; tr ' ' , <p.xyz; } >p.csv
cat >p.vrt <<'END'
<OGRVRTDataSource><OGRVRTLayer name="p"><SrcDataSource>p.csv</SrcDataSource>
<GeometryType>wkbPoint</GeometryType><GeometryField encoding="PointFromColumns" x="x" y="y" z="z"/>
</OGRVRTLayer></OGRVRTDataSource>
END
region=-R0/1400/0/1400
bsgrid --quiet -b -m mean -d 0.35 -g 7 -o dem.hm p.hm
hmconv -t asc dem.hm >dem.asc
gdal_translate -q -ot Float32 dem.asc dem.tif
slope -b -o slope.hm dem.hm
gdaldem slope -q dem.tif slope.tif

printf '%-44s %9s %9s %7s %7s\n' "case, seconds" ours peer ratio goal
against "1M lines of text to binary, gmt convert" 0.15 "hmconv -b p.xyz" "gmt convert p.xyz -bo3d"
against "1M points, means of 2 m, gmt blockmean" 0.15 "bsgrid --quiet -b -m mean -d 2 p.hm" \
    "gmt blockmean p.bin -bi3d -bo3d -I2 $region"
against "1M points, B-spline at 2 m, gmt surface" 0.25 "bsgrid --quiet -b -d 2 p.hm" \
    "gmt blockmean p.bin -bi3d -bo3d -I2 $region | gmt surface -bi3d -I2 $region -Gs.nc"
against "1M points, triangles, gdal_grid linear" 0.08 "bsgrid --quiet -b -d 2 -n 0 p.hm" \
    "gdal_grid -q -a linear -txe 0 1400 -tye 0 1400 -outsize 700 700 -l p p.vrt g.tif"
against "slope of 4000 x 4000, gdaldem" 0.5 "slope -b -o s.hm dem.hm" "gdaldem slope -q dem.tif s.tif"
against "lines at 5 degrees on it, gdal_contour" 0.7 "breaklines --quiet -s 5 -l 0 -o c.hm slope.hm" \
    "rm -f c.gmt; gdal_contour -q -fl 5 -f OGR_GMT slope.tif c.gmt"
against "both in a pipe, gdaldem and gdal_contour" 0.7 "slope -b dem.hm | breaklines --quiet -s 5 -l 0 -o c.hm" \
    "rm -f c.gmt; gdaldem slope -q dem.tif s.tif && gdal_contour -q -fl 5 -f OGR_GMT s.tif c.gmt"

printf '\n%-44s %9s %9s %7s %7s\n' "memory, MB" ours limit ratio goal
memory() { /usr/bin/time -o "$1" -f %M "$@"; }
hmcloud "$points" 5000 | memory bsgrid --quiet -b -m mean -d 1 | memory slope -b | memory breaklines --quiet -s 13 -o l.hm
judge "$((points / 1000000))M points: bsgrid -m mean" "$(awk '{ print $1 / 1024 }' bsgrid)" 1024 1 ""
judge "... slope" "$(awk '{ print $1 / 1024 }' slope)" 16 1 ""
judge "... breaklines" "$(awk '{ print $1 / 1024 }' breaklines)" 1024 1 ""
echo "$good ok, $missed missed"
[ $missed -eq 0 ]
