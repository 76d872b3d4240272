#!/bin/sh
# slope: methods, units and aspect on planes; borders and nodata; a stream that flows; bad input.
. "${0%/*}/tap.sh"

# grid NX NY HEIGHT-EXPRESSION [DX DY]: a grid with z from x and y
grid() {
    awk -v nx="$1" -v ny="$2" -v dx="${4:-1}" -v dy="${5:-1}" 'BEGIN {
        print "#hm 1 grid text"; print "#size " nx " " ny; print "#origin 100 200"
        print "#step " dx " " dy; print "#fields x y z"; print "#crs UTM 32N WGS84"; print "#data"
        for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) { x = 100 + i * dx; y = 200 + j * dy
            z = '"$3"'; printf "%.17g %.17g ", x, y; if (z == "nan") print z; else printf "%.17g\n", z }
        print "#end" }'
}
# off COLUMN WANT: largest difference of a column from a number; counts missing ones as 1e9
off() {
    awk -v f="$1" -v want="$2" '!/^#/ { e = $f == "nan" ? 1e9 : $f - want; if (e < 0) e = -e; if (e > m) m = e }
        END { printf "%.3g", m }'
}

grid 12 9 '0.3 * x - 0.4 * y' 2 5 >plane.hm
degrees=26.565051177077989
for method in distance horn zt equal simple; do
    true_that "$method: exact on a plane to the border" "$(slope -m $method plane.hm | off 4 $degrees) < 1e-9"
done
true_that "percent" "$(slope -u percent plane.hm | off 4 50) < 1e-9"
true_that "radian" "$(slope -u radian plane.hm | off 4 0.46364760900080609) < 1e-12"
true_that "aspect: falls to the north-west" "$(slope -a plane.hm | off 5 323.13010235415598) < 1e-9"
grid 12 9 '0.3 * x - 0.4 * y' 2 -5 >south.hm
true_that "aspect when the grid comes north first" "$(slope -a south.hm | off 5 323.13010235415598) < 1e-9"
grid 9 9 '0.5 * y' >aligned.hm
true_that "steepest: exact along the lattice" "$(slope -m steepest aligned.hm | off 4 $degrees) < 1e-9"
slope -a plane.hm >a.hm
ok "fields" grep -q '^#fields x y z slope aspect$' a.hm
ok "units" grep -q '^#units m m m degree degree$' a.hm
ok "crs and history" sh -c "grep -q '^#crs UTM 32N WGS84' a.hm && grep -q '^#prog slope .* -a$' a.hm"

awk '!/^#/ && NR % 13 == 0 { $3 = "nan" } { print }' plane.hm >holes.hm
slope holes.hm >a.hm
true_that "beside nodata: still exact" "$(awk '$4 != "nan"' a.hm | off 4 $degrees) < 1e-9"
true_that "nodata itself has no slope" "$(awk '!/^#/ && $3 == "nan" && $4 != "nan"' a.hm | wc -l) == 0"
true_that "and only nodata" "$(awk '!/^#/ && $3 != "nan" && $4 == "nan"' a.hm | wc -l) <= 1"

# the exact derivative of the surface, and a survey from points to slope
awk 'BEGIN { s = 7; for (i = 0; i < 4000; i++) { s = (s * 16807) % 2147483647; x = s % 10000 / 100
    s = (s * 16807) % 2147483647; y = s % 10000 / 100; printf "%s %s %.17g\n", x, y, 0.3 * x - 0.4 * y } }' >plane.xyz
true_that "irregular points, TIN, dragging, slope: exact" \
    "$(bsgrid -d 2 plane.xyz 2>/dev/null | slope | awk '$3 != "nan"' | off 4 $degrees) < 1e-9"
true_that "bspline: the surface's own derivative" \
    "$(bsgrid -d 2 --derivatives plane.xyz 2>/dev/null | slope -m bspline | awk '$6 != "nan"' | off 6 $degrees) < 1e-9"

# curvature of a dome and a bowl: a sphere of radius 50 has 1/50 in every normal section; its contours at
# distance d from the middle have 1/d
for sign in - +; do
    grid 41 41 "${sign}(2500 - (x - 120.3) ^ 2 - (y - 219.8) ^ 2) ^ 0.5" >sphere.hm
    slope -c -m zt sphere.hm >a.hm
    true_that "profile curvature of a sphere, $sign" "$(awk -v s="$sign" '!/^#/ && $5 != "nan" { e = $5 - (s == "-" ? 0.02 : -0.02)
        if (e < 0) e = -e; if (e > m) m = e; n++ } END { print (n == 39 * 39 ? m : 9) }' a.hm) < 1e-4"
    true_that "plan curvature of its contours, $sign" "$(awk -v s="$sign" '!/^#/ && $6 != "nan" {
        d = sqrt(($1 - 120.3) ^ 2 + ($2 - 219.8) ^ 2); if (d < 4) next; e = $6 * d - (s == "-" ? 1 : -1)
        if (e < 0) e = -e; if (e > m) m = e; n++ } END { print (n > 1400 ? m : 9) }' a.hm) < 0.02"
done
ok "its bands" grep -q '^#fields x y z slope profile plan$' a.hm
ok "and units" grep -q '^#units m m m degree 1/m 1/m$' a.hm
true_that "a plane has none" "$(slope -c plane.hm | awk '!/^#/ && $5 != "nan"' | off 5 0) < 1e-12"
bsgrid -d 2 --derivatives plane.xyz 2>/dev/null | slope -m bspline -c >a.hm
ok "with the surface's own derivative, too" grep -q '^#fields x y z dzdx dzdy slope profile plan$' a.hm

# forms of the stream, threads
grid 300 300 'sin(x / 7) * cos(y / 5) + ((x * 7 + y * 3) % 11) / 20' >rough.hm
slope -j 1 -a -c rough.hm >one.hm
slope -j 2 -a -c rough.hm >two.hm
same "one thread as two, all bands" one.hm two.hm
slope -j 1 rough.hm >one.hm
slope -j 2 rough.hm >two.hm
same "one thread as two" one.hm two.hm
slope -b rough.hm >binary.hm
slope <rough.hm | cmp -s - one.hm
report $? "standard input as a file"
breaklines -s 5 one.hm >a.hm 2>/dev/null
breaklines -s 5 binary.hm >b.hm 2>/dev/null
same "text and binary" a.hm b.hm

slope --single rough.hm | hmconv >single.hm
true_that "single precision, as good as it is" "$(paste single.hm one.hm | awk '!/^#/ && $4 != "nan" { e = ($4 - $8) / $8; f = ($3 - $7) / 2
    if (e < 0) e = -e; if (f < 0) f = -f; if (e > m) m = e; if (f > m) m = f; n++ } END { print (n > 80000 ? m : 9) }') < 6e-8"
ok "half as long" sh -c 'slope --single rough.hm >single.hm && slope -b rough.hm >double.hm &&
    [ $(wc -c <double.hm) -gt $(($(wc -c <single.hm) * 19 / 10)) ]'
ok "which is history" sh -c 'slope --single rough.hm | hmconv | grep -q "^#prog slope .* --single$"'
must_fail "single precision is binary" 2 'single is binary' slope --single -p 3 rough.hm
must_fail "and would round a copy" 2 'single would round' slope --single -K rough.hm

# a true filter: rows come out while the input is still open
mkfifo pipe
slope <pipe >flow.hm &
exec 3>pipe
head -n 60000 rough.hm >&3
tries=0
while [ ! -s flow.hm ] && [ $tries -lt 50 ]; do sleep 0.1; tries=$((tries + 1)); done
ok "rows come out before the last is in" [ -s flow.hm ]
tail -n +60001 rough.hm >&3
exec 3>&-
wait
same "and all of them in the end" one.hm flow.hm

# against gdaldem, where it is installed: it computes in single precision, and sums heights for Horn
# against_gdaldem NAME FILE OPTION...: a grid of real ground by bsgrid, its interior nodes compared
against_gdaldem() {
    name=$1 file=$2
    shift 2
    need_data "$file" || return 0
    bsgrid --quiet --single "$@" -o real.hm "$DATA/$file"
    hmconv -t asc real.hm >real.asc 2>/dev/null
    for method in horn:Horn:5e-4 zt:ZevenbergenThorne:1e-5; do
        ours=${method%%:*} bound=${method##*:} method=${method#*:}
        gdaldem slope -q -of AAIGrid -co DECIMAL_PRECISION=9 -alg "${method%:*}" real.asc peer.asc 2>/dev/null
        slope --quiet -m "$ours" real.asc | awk '!/^#/ { print $4 }' >a
        awk '$1 + 0 == $1 && NF > 50 { for (i = 1; i <= NF; i++) print $i }' peer.asc >b
        true_that "$ours as gdaldem: $name" "$(paste a b |
            awk '$2 != -9999 { e = $1 - $2; if (e < 0) e = -e; if (e > m) m = e; n++ }
                 END { print (n > 15000 ? m : 9) }') < $bound"
    done
}
if command -v gdaldem >/dev/null; then
    against_gdaldem "the Severn" severn_caersws/points.xyz -d 10 -n 0 -k 1 -g 30
    against_gdaldem "the Danube" danube_deggendorf/points.xyz -d 5 -g 60
    against_gdaldem "the Willamette, feet" willamette_autzen/autzen_trim.las -c 2 -d 5 -g 40
else
    skip 'no gdaldem here'
fi

# bad input
: >empty
must_fail "empty" 2 'empty' slope empty
head -n 50 plane.hm >cut.hm
must_fail "truncated" 2 'cut.hm' slope cut.hm
sed '$d' plane.hm >cut.hm
must_fail "no end mark" 2 'cut.hm' slope cut.hm
ok "then nothing looks whole" sh -c '! slope cut.hm 2>/dev/null | grep -q "^#end"'
sed '30s/^[^ ]*/word/' plane.hm >word.hm
must_fail "a word" 2 'word.hm:30' slope word.hm
must_fail "points for a grid" 2 'no grid' slope plane.xyz
must_fail "slope twice" 2 'already' slope one.hm
must_fail "bspline without derivatives" 2 'dzdx' slope -m bspline plane.hm
must_fail "no such method" 2 'method' slope -m best plane.hm
grid 1 1 1 >one.hm
ok "one node: no slope, but no failure" sh -c 'slope one.hm | grep -q "^100 200 1 nan$"'
if [ -e /dev/full ]; then
    must_fail "a full disk" 2 'space|No space' sh -c 'slope rough.hm >/dev/full'
fi
done_testing
