#!/bin/sh
# hmdraw: every kind in every format, places on the page, and what cannot be drawn.
. "${0%/*}/tap.sh"
command -v hmdraw >/dev/null || {
    skip "hmdraw is not built (it needs cairo)"
    done_testing
}

# --- inputs: a 10 m square with a slope, points, lines of all roles, a small hybrid mesh ---
{
    printf 'ncols 11\nnrows 11\nxllcorner -0.5\nyllcorner -0.5\ncellsize 1\nnodata_value -9999\n'
    awk 'BEGIN { for (y = 10; y >= 0; y--) for (x = 0; x <= 10; x++)
        printf "%s%s", (x > 8 && y > 8 ? -9999 : 0.3 * x + 0.05 * y * y), (x < 10 ? " " : "\n") }'
} >dem.asc
awk 'BEGIN { for (i = 0; i < 200; i++) printf "%.2f %.2f %.2f\n", i % 17 / 1.7, i % 13 / 1.3, i / 50 }' >points.xyz
cat >lines.txt <<'END'
> limit=8
1 5 0
5 5.5 0
9 5 0
> surface=main side=left
1 8 0
9 8 0
> surface=main side=right
1 2 0
9 2 0
> face=main closed=1
3 3 0
7 3 0
7 7 0
> boundary=1 closed=1
0.5 0.5 0
9.5 0.5 0
9.5 9.5 0
0.5 9.5 0
> string=inflow
1 2 0
1 8 0
> hole=1 closed=1
4 4 0
5 4 0
5 5 0
END
cat >mesh.hm <<'END'
#hm 1 mesh text
#name hybrid
#role hybrid
#owners main
#data
v 1 1 0 1 1
v 5 1 1 1 1
v 5 9 2 1 1
v 1 9 1 1 1
v 9 1 2 1 0
v 9 9 3 1 0
q 0 1 2 3 1
t 1 4 2 0
t 4 5 2 0
#end
END
cat >residuals.hm <<'END'
#hm 1 points text
#fields x y z residual
#data
1 1 0 0.05
2 5 0 -0.2
3 3 0 0.5
4 4 0 nan
#end
END
cat >slope.hm <<'END'
#hm 1 grid text
#size 2 2
#origin 0 0
#step 1 1
#fields x y z slope
#data
0 0 0 1
1 0 0 2
0 1 0 3
1 1 0 nan
#end
END

# --- formats ---
magic() { head -c 4 "$1" | od -An -c | tr -d ' \n'; }
ok "PNG of everything" hmdraw -s 800 -o all.png -T "All kinds" dem.asc points.xyz lines.txt mesh.hm
[ "$(magic all.png)" = '211PNG' ]
report $? "it is a PNG"
ok "SVG by its suffix" hmdraw -s 800 -o all.svg -T "All <kinds> & more" dem.asc points.xyz lines.txt mesh.hm
if command -v xmllint >/dev/null; then
    ok "the SVG is well formed" xmllint --noout --huge all.svg
else
    skip "no xmllint"
fi
ok "PDF by its suffix" hmdraw -s 800 -o all.pdf dem.asc points.xyz lines.txt mesh.hm
[ "$(magic all.pdf)" = '%PDF' ]
report $? "it is a PDF"
hmdraw -t svg mesh.hm >typed.svg
ok "format by option" grep -q '<svg' typed.svg

for name in x.SVG x.Pdf x.PNG x a.b/x; do
    mkdir -p a.b
    hmdraw -o $name mesh.hm
    printf '%s ' "$(magic $name)"
done >magics
ok "suffixes in any case, or none" grep -q '^<?xm %PDF 211PNG 211PNG 211PNG $' magics
ok "-t counts more than the suffix" sh -c 'hmdraw -t png -o y.gif mesh.hm && [ -s y.gif ]'
must_fail "another suffix" 2 "x.gif: no picture format; -t says png, svg or pdf" hmdraw -o x.gif mesh.hm
[ ! -e x.gif ]
report $? "and no file"

# --- equal bytes ---
for format in png svg pdf; do
    hmdraw -s 600 -t $format dem.asc points.xyz lines.txt mesh.hm >once.$format
    hmdraw -s 600 -t $format dem.asc points.xyz lines.txt mesh.hm >twice.$format
    same "the same picture twice: $format" once.$format twice.$format
done
hmdraw <dem.asc >stdin.png
hmdraw dem.asc >operand.png
same "standard input" stdin.png operand.png

# --- every kind alone ---
for file in dem.asc points.xyz residuals.hm lines.txt mesh.hm; do
    ok "alone: $file" hmdraw -s 400 -o one.png $file
done
for fill in material wire z quality; do
    ok "mesh filled by $fill" hmdraw -f $fill -o $fill.png mesh.hm
done
! cmp -s material.png quality.png
report $? "fills differ"
sed 's/^#fields.*/&\n#units m m m percent/' slope.hm >percent.hm
hmdraw -B slope -o percent.png percent.hm
hmdraw -B slope -o number.png slope.hm
! cmp -s percent.png number.png
report $? "the colour bar says the unit"
sed 's/^#fields.*/&\n#units ft ft ft 1/' slope.hm >feet.hm
hmdraw -o feet.png feet.hm
hmdraw -o metres.png slope.hm
! cmp -s feet.png metres.png
report $? "feet are called so"
ok "another band" hmdraw -B slope -o band.png slope.hm
ok "one point" sh -c 'echo 545000 5972000 3 | hmdraw >one_point.png'
ok "points all on a line" sh -c 'seq 9 | awk "{ print \$1, 7, 1 }" | hmdraw >on_line.png'
ok "a point without height" sh -c 'echo 5 6 nan | hmdraw >no_height.png'

hmdraw -l 4 -o few.png mesh.hm dem.asc
hmdraw -o many.png mesh.hm dem.asc
true_that "fewer colours, smaller file" "$(wc -c <few.png) < $(wc -c <many.png)"

# --- places ---
size() { od -An -j16 -N8 -t u4 --endian=big "$1" | tr -s ' ' | sed 's/^ //'; }
hmdraw -P -s 200 -R 0/10/0/5 -o plain.png mesh.hm
true_that "size of a plain map" "\"$(size plain.png)\" == \"200 100\""
hmdraw -s 800 -R 0/10/0/10 -o framed.png mesh.hm
width=$(size framed.png | cut -d ' ' -f 1) height=$(size framed.png | cut -d ' ' -f 2)
true_that "the picture is as large as asked" "$width == 800 && $height < 800 && $height > 400"
# 10 m on 100 units: node (1, 1) is at 10, 90
hmdraw -P -s 100 -R 0/10/0/10 -t svg mesh.hm >places.svg
ok "a quadrilateral where it belongs" grep -q 'M 10 90 L 50 90 L 50 10 L 10 10 Z' places.svg
hmdraw -P -s 100 -R 0/10/0/10 -t svg lines.txt >lines.svg
ok "a breakline where it belongs" grep -q 'M 10 50 L 50 45 L 90 50' lines.svg
# its ticks point to its left, which is up on the page
grep -o 'M [0-9.]* [0-9.]* L [0-9.]* [0-9.]* M [^"]*' lines.svg | head -n 1 | tr M '\n' |
    awk 'NF == 5 { n++; up += $5 < $2 } END { exit !(n > 2 && up == n) }'
report $? "ticks on the left side"

if python3 -c 'import zlib' 2>/dev/null; then
    pixel() { python3 "$TESTS/pngpixel.py" "$@" | tr '\n' ' '; }
    # the north-east corner of the grid is nodata: paper; low in the south-west is blue, high is brown
    hmdraw -P -s 110 -R -0.5/10.5/-0.5/10.5 -o grid.png dem.asc
    set -- $(pixel grid.png 105,5 5,105 75,5)
    true_that "nodata stays transparent" "$1 == 255 && $2 == 255 && $3 == 255"
    true_that "low is blue" "$6 > $4"
    true_that "high is brown" "$7 > $9"
    hmdraw -P -s 100 -R 0/10/0/10 -o residuals.png residuals.hm
    set -- $(pixel residuals.png 10,90 20,50 30,70)
    true_that "small residual green" "$2 > $1"
    true_that "medium residual yellow" "$4 > 200 && $5 > 180 && $6 < 100"
    true_that "large residual red" "$7 > 200 && $8 < 100 && $9 < 50"
    sed 's/^#data/#thresholds 5 9\n#data/' residuals.hm >mild.hm
    hmdraw -P -s 100 -R 0/10/0/10 -o mild.png mild.hm
    set -- $(pixel residuals.png 10,90) $(pixel mild.png 10,90 20,50 30,70)
    true_that "all green by the thresholds of the header" "$4 == $1 && $7 == $1 && ${10} == $1"

    # a plain, 10 to 10.3 high, beside a mountain: in a window on the plain the colours are the plain's
    awk 'BEGIN { print "#hm 1 grid text\n#size 21 11\n#origin 0 0\n#step 1 1\n#data"
        for (y = 0; y <= 10; y++) for (x = 0; x <= 20; x++) print x, y, (x > 11 ? 500 : 10 + 0.03 * x)
        print "#end" }' >plain.hm
    hmdraw -P -s 100 -R 0/10/0/10 -o plain.png plain.hm
    set -- $(pixel plain.png 5,50 95,50)
    true_that "in the window low is blue" "$3 > $1 + 30"
    true_that "and high is brown" "$4 > $6 + 30"

    # a flat ground and a flat mesh on it: the swatch in the legend is the colour in the map
    awk 'BEGIN { print "#hm 1 grid text\n#size 11 11\n#origin 0 0\n#step 1 1\n#data"
        for (y = 0; y <= 10; y++) for (x = 0; x <= 10; x++) print x, y, 5
        print "#end" }' >flat.hm
    hmdraw -s 800 -R 0/10/0/10 -o swatch.png flat.hm mesh.hm
    hmdraw -s 800 -R 0/10/0/10 -t svg -o swatch.svg mesh.hm
    # frame: from 24.2 (2.2 of the text size, 11) to the panel; swatches in the panel, 17 wide
    map=$((800 - 24 - 13 - 187))
    set -- $(pixel swatch.png $((24 + map * 2 / 10)),$((13 + map / 2)) $((800 - 187 + 11)),$((13 + 11 + 17)) \
        $((24 + map * 8 / 10)),$((13 + map * 4 / 10)) $((800 - 187 + 11)),$((13 + 11)))
    for k in 1 2; do
        true_that "swatch $k as in the map" \
            "($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2 < 50 && $1 + $2 + $3 < 720"
        shift 6
    done

    # triangles that close the gap between two meshes have nodes of both, and the material of one
    sed 's/^t 0*1 4 2 0/t 1 4 2 1/' mesh.hm >gap.hm
    hmdraw -P -s 100 -R 0/10/0/10 -o gap.png gap.hm
    set -- $(pixel gap.png 30,60 65,70 85,40)
    true_that "a gap's triangle is the river's colour" "$1 == $4 && $2 == $5 && $3 == $6 && $3 < 150"
    true_that "and its neighbour the floodplain's" "$7 > 220 && $9 > 220"

    # 160,000 elements of half a pixel do not cover the colours under them
    awk 'BEGIN { n = 400; print "#hm 1 mesh text\n#data"
        for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) print "v", i, j, 0, 0, 0
        for (j = 0; j < n; j++) for (i = 0; i < n; i++) { a = j * (n + 1) + i
            print "q", a, a + 1, a + n + 2, a + n + 1, 0 }
        print "#end" }' >fine.hm
    hmdraw -P -s 100 -o fine.png fine.hm
    hmdraw -P -s 400 -R 0/40/0/40 -o coarse.png fine.hm
    set -- $(pixel fine.png 50,50 51,50 50,51 51,51) $(pixel coarse.png 200,205)
    true_that "wires too fine are left out" "$1 > 230 && $4 > 230 && $7 > 230 && ${10} > 230"
    true_that "and drawn where there is room" "${13} < 230"

    # sixty materials: more than a legend has room for
    awk 'BEGIN { print "#hm 1 mesh text\n#data"
        for (i = 0; i <= 60; i++) print "v", i, 0, 0, 0, 0 "\nv", i, 30, 0, 0, 0
        for (i = 0; i < 60; i++) print "q", 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1, i
        print "#end" }' >sixty.hm
    hmdraw -s 800 -o sixty.png sixty.hm
    set -- $(pixel sixty.png 625,39 625,150)
    true_that "a legend has a swatch for each material" "$4 != $6"
    set -- $(for y in $(seq 265 310); do pixel sixty.png 625,$y; done)
    true_that "but none under the scale bar" "$(echo "$*" | awk '{ for (i = 1; i <= NF; i += 3) if (($i - $(i + 1)) ^ 2 + ($i - $(i + 2)) ^ 2 > 400) bad = 1 } END { print !bad }')"

    # colours that eyes without one kind of cones tell apart, too
    awk 'BEGIN { print "#hm 1 mesh text\n#data"
        for (i = 0; i <= 8; i++) print "v", i, 0, 0, 0, 0 "\nv", i, 1, 0, 0, 0
        for (i = 0; i < 8; i++) print "q", 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1, i
        print "#end" }' >materials.hm
    awk 'BEGIN { print "#hm 1 mesh text\n#data"
        for (k = split("50 25 15 5", a); k; k--) { t = sin(a[k] / 57.29578) / cos(a[k] / 57.29578)
            print "v", 3 * k, 0, 0, 0, 0 "\nv", 3 * k + 1, 0, 0, 0, 0 "\nv", 3 * k + 1, t, 0, 0, 0 }
        for (k = 0; k < 4; k++) print "t", 3 * k, 3 * k + 1, 3 * k + 2, 0
        print "#end" }' >angles.hm
    awk 'BEGIN { print "#hm 1 grid text\n#size 7 2\n#origin 0 0\n#step 1 1\n#fields x y z slope"
        print "#units m m m degree\n#data"
        for (y = 0; y < 2; y++) for (x = 0; x < 7; x++) print x, y, 0, 1 + x * (x + 1)
        print "#end" }' >slopes.hm
    hmdraw -P -t svg materials.hm >materials.svg
    hmdraw -P -f quality -t svg angles.hm >angles.svg
    hmdraw -t svg -B slope slopes.hm >slopes.svg
    for picture in materials:8:16 angles:4:16 slopes:7:10; do
        IFS=: read -r name count least <<END
$picture
END
        set -- $(python3 "$TESTS/colours.py" $name.svg)
        true_that "$name: colours apart" "$1 == $count && $2 > $least && $3 > $least && $4 > $least && $5 > $least"
    done
else
    skip "no python3 to look at pixels"
fi

# --- heights and coordinates of any size: ticks must end ---
drawn() {
    printf '%b' "$2" >extreme.xyz
    ok "drawn: $1" timeout 20 hmdraw -s 300 -o extreme.png extreme.xyz
}
drawn "heights whose range overflows" '1 1 -1e308\n2 2 1e308\n3 3 4\n'
drawn "huge heights" '1 1 1.7e308\n2 2 1.6e308\n'
drawn "heights 1e-300 apart" '1 1 0\n2 2 1e-300\n3 3 4e-301\n'
drawn "heights subnormally apart" '1 1 0\n2 2 5e-324\n'
drawn "heights apart by rounding" '1 1 1e15\n2 2 1000000000000000.1\n'
drawn "all heights equal" '1 1 5\n2 2 5\n3 1 5\n'
drawn "places 1e-300 apart" '0 0 1\n1e-300 1e-300 2\n'
drawn "places far apart" '9e298 0 0\n0 3 4\n'
must_fail "places whose distance overflows" 2 "far apart" timeout 20 \
    sh -c "printf '1e308 1 1\n-1e308 2 2\n' | hmdraw"
must_fail "a window of a few bits" 2 "too small" timeout 20 \
    hmdraw -R 1e17/1.00000000000000016e17/0/16 mesh.hm
must_fail "a window that overflows" 2 "too large" timeout 20 hmdraw -R -1e308/1e308/-1e308/1e308 mesh.hm

# --- many elements in seconds ---
awk 'BEGIN { n = 200; print "#hm 1 mesh text\n#data"
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) print "v", i, j, i % 7, 0, 0
    for (j = 0; j < n; j++) for (i = 0; i < n; i++) { a = j * (n + 1) + i
        print "t", a, a + 1, a + n + 2, 0; print "t", a, a + n + 2, a + n + 1, 0 }
    print "#end" }' >large.hm
start=$(date +%s)
ok "80,000 triangles" hmdraw -s 800 -o large.png large.hm
true_that "in seconds" "$(date +%s) - $start < 30"

# --- what cannot be drawn ---
: >empty
must_fail "empty input" 2 "empty" hmdraw empty
head -n 8 mesh.hm >cut.hm
must_fail "a stream cut off" 2 "cut.hm" hmdraw -o never.png cut.hm
[ ! -e never.png ]
report $? "nothing is left of it"
printf '1 2 3\n1 two 3\n' >word.xyz
must_fail "a word for a number" 2 "word.xyz:2:" hmdraw word.xyz
printf '1 2 3\nnan 2 3\n' >nan.xyz
must_fail "NaN for a coordinate" 2 "nan.xyz:2:" hmdraw nan.xyz
must_fail "a band that is not there" 2 "no band 'slope'" hmdraw -B slope dem.asc
must_fail "no window" 2 "w/e/s/n" hmdraw -R 0/10/0 dem.asc
must_fail "a window inside out" 2 "west" hmdraw -R 10/0/0/10 dem.asc
hmdraw -R 20/30/20/30 -o beside.png mesh.hm 2>beside.err
ok "a window beside the data is told" grep -q "data are in 1/9/1/9" beside.err
must_fail "a size beyond reason" 2 "within 64 and 20000 pixels in PNG" hmdraw -s 1e6 dem.asc
must_fail "a size beyond vectors" 2 "within 64 and 14400 points in SVG and PDF" hmdraw -t svg -s 20000 dem.asc
must_fail "a place that cannot be written, before the work" 2 "nowhere/x.png" hmdraw -o nowhere/x.png word.xyz
must_fail "a single colour" 2 "levels" hmdraw -l 1 dem.asc
must_fail "an unknown format" 2 "type" hmdraw -t gif dem.asc
printf '0 0 1\n1e308 1e308 1\n-1e308 -1e308 1\n' >far.xyz
must_fail "coordinates too far apart" 2 "far apart" hmdraw far.xyz
if [ -e /dev/full ]; then
    for format in png svg pdf; do
        must_fail "a full disk, $format" 2 "No space" sh -c "hmdraw -t $format dem.asc >/dev/full"
    done
fi

done_testing
