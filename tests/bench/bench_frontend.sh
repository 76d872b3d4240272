#!/bin/sh
# Speed from points to breaklines against GMT and GDAL, runs of both by turns, medians of five (or RUNS):
# a line a case with the times, their ratio and the goal; then a pipe of POINTS points (100 million) on a
# grid of 5000 x 5000 and the memory of each process.
#
#     bench_frontend.sh [text] [mean] [surface] [slope] [lines] [pipe]
#
# Status 1 when a goal is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}" "${RUNS:=5}" "${POINTS:=100000000}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
[ $# -gt 0 ] || set -- text mean surface slope lines pipe
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for peer in gmt gdaldem gdal_grid gdal_contour bash /usr/bin/time; do
    command -v $peer >/dev/null || { echo "$peer is not installed"; exit 2; }
done
missed=0
good=0

# seconds COMMAND: wall clock, to a millisecond
seconds() { bash -c "TIMEFORMAT=%3R; time { $1; } >out 2>err" 2>t || { echo "failed: $1" >&2; exit 2; }; cat t; }
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
        'BEGIN { printf "%-44s %9.3f %9.3f %7.3f %7.3f  %s\n", n, a, b, a / b, g, w }'
}
# memory NAME COMMAND ...: runs the command; its most memory, kB, to the file NAME
memory() { name=$1; shift; /usr/bin/time -o "$name" -f %M "$@"; }
# weigh NAME FILE MB: a line of the table
weigh() { judge "$1" "$(awk '{ print $1 / 1024 }' "$2")" "$3" 1 ""; }

# --- inputs ---
make_points() {
    hmcloud 1000000 1400 >p.hm
    hmconv -t xyz p.hm >p.xyz
    gmt convert p.xyz -bo3d >p.bin
}
make_grid() {
    [ -e p.hm ] || make_points
    bsgrid --quiet --single -m mean -d 0.35 -g 7 -o dem.hm p.hm
    hmconv -t asc dem.hm >dem.asc
    gdal_translate -q -ot Float32 dem.asc dem.tif
    rm dem.asc
    slope --single -o slope.hm dem.hm
    gdaldem slope -q dem.tif slope.tif
}
region=-R0/1400/0/1400

# --- cases ---
bench_text() { # lines of 24 bytes, two decimals
    hmcloud 2000000 5000 | hmconv -p 2 -t xyz >text.xyz
    against "2M lines of text, one thread, gmt convert" 0.096 "hmconv -j 1 -b text.xyz" "gmt convert text.xyz -bo3d"
    against "... all threads" 0.048 "hmconv -b text.xyz" "gmt convert text.xyz -bo3d"
    rm text.xyz
}
bench_mean() {
    make_points
    against "1M points, means of 2 m, gmt blockmean" 0.15 "bsgrid --quiet -b -m mean -d 2 p.hm" \
        "gmt blockmean p.bin -bi3d -bo3d -I2 $region"
    hmcloud 5000000 1400 >p5.hm
    hmconv -t xyz p5.hm | gmt convert -bo3d >p5.bin
    against "5M points, means of 2 m, gmt blockmean" 0.15 "bsgrid --quiet -b -m mean -d 2 p5.hm" \
        "gmt blockmean p5.bin -bi3d -bo3d -I2 $region"
    memory m1 bsgrid --quiet -b -m mean -d 2 p.hm >out
    memory m5 bsgrid --quiet -b -m mean -d 2 p5.hm >out
    judge "memory of 5M points, of 1M, MB" "$(awk '{ print $1 / 1024 }' m5)" "$(awk '{ print $1 / 1024 }' m1)" 1.05 ""
    rm p5.*
}
bench_surface() {
    make_points
    against "1M points, B-spline at 2 m, gmt surface" 0.25 "bsgrid --quiet -b -d 2 p.hm" \
        "gmt blockmean p.bin -bi3d -bo3d -I2 $region | gmt surface -bi3d -I2 $region -Gs.nc"
    { echo x,y,z; tr ' ' , <p.xyz; } >p.csv
    cat >p.vrt <<'END'
<OGRVRTDataSource><OGRVRTLayer name="p"><SrcDataSource>p.csv</SrcDataSource>
<GeometryType>wkbPoint</GeometryType><GeometryField encoding="PointFromColumns" x="x" y="y" z="z"/>
</OGRVRTLayer></OGRVRTDataSource>
END
    against "1M points, triangles, gdal_grid linear" 0.08 "bsgrid --quiet -b -d 2 -n 0 p.hm" \
        "gdal_grid -q -a linear -txe 0 1400 -tye 0 1400 -outsize 700 700 -l p p.vrt g.tif"
}
bench_slope() {
    make_grid
    against "slope of 4000 x 4000, gdaldem" 0.5 "slope --single -o s.hm dem.hm" "gdaldem slope -q dem.tif s.tif"
    memory m slope --single -o s.hm dem.hm
    weigh "... memory, MB" m 16
}
bench_lines() {
    [ -e slope.hm ] || make_grid
    against "lines at 5 degrees on it, gdal_contour" 0.7 "breaklines --quiet -s 5 -l 0 -w 0 -o c.hm slope.hm" \
        "rm -f c.gmt; gdal_contour -q -fl 5 -f OGR_GMT slope.tif c.gmt"
    against "both in a pipe, gdaldem and gdal_contour" 0.7 \
        "slope --single dem.hm | breaklines --quiet -s 5 -l 0 -w 0 -o c.hm" \
        "rm -f c.gmt; gdaldem slope -q dem.tif s.tif && gdal_contour -q -fl 5 -f OGR_GMT s.tif c.gmt"
}
bench_pipe() {
    hmcloud "$POINTS" 5000 | memory bsgrid bsgrid --quiet -b -m mean -d 1 | memory slope slope -b |
        memory lines breaklines --quiet -s 13 -o l.hm
    weigh "$((POINTS / 1000000))M points in a pipe, MB: bsgrid -m mean" bsgrid 1024
    weigh "... slope" slope 16
    weigh "... breaklines" lines 1024
}

printf '%-44s %9s %9s %7s %7s\n' "case, seconds" ours peer ratio goal
for case; do "bench_$case"; done
echo "$good ok, $missed missed"
[ $missed -eq 0 ]
