#!/bin/sh
# Streams through pipes and files: text and binary, joined, cut off, foreign, and what a full disk does.
. "${0%/*}/tap.sh"

printf '#hm 1 points text\n#fields x y z class\n#units m m m 1\n#crs UTM 32N WGS84\n#prog survey 1\n#data\n1 2 3.25 2\n4 5 nan 9\n#end 2\n' >points.hm
printf '#hm 1 grid text\n#size 3 2\n#origin 0 0\n#step 0.1 -0.1\n#fields x y z slope\n#kept as it is\n#data\n' >grid.hm
printf '0 0 1 2\n0.1 0 3 4\n0.2 0 nan nan\n0 -0.1 1 2\n0.1 -0.1 3 4\n0.2 -0.1 5 1e-7\n#end 6\n' >>grid.hm
printf '#hm 1 lines text\n#fields x y z\n#data\n> surface=main side=left\n0 0 1\n9 0 1\n> closed=1\n0 0 1\n9 0 1\n5 5 1\n#end 2\n' >lines.hm
printf '#hm 1 mesh text\n#name main\n#role regular\n#owners main\n#data\nv 0 0 1 1 1\nv 1 0 1 1 1\nv 1 1 1 3 1\nv 0 1 0.1 0 0\nt 0 1 2 0\nt 0 2 3 7\n#end 6\n' >mesh.hm
cat points.hm grid.hm mesh.hm lines.hm points.hm >all.hm

# --- there and back ---
for f in points grid lines mesh all; do
    hmconv -b $f.hm >$f.bin
    ok "$f: binary" test -s $f.bin
    hmconv $f.bin >back.hm
    same "$f: text, binary, text" $f.hm back.hm
    hmconv $f.bin | hmconv -b >back.bin
    same "$f: binary, text, binary" $f.bin back.bin
done
cat points.bin grid.bin mesh.bin lines.bin points.bin >joined.bin
same 'cat of binary streams' all.bin joined.bin
cat points.hm grid.bin mesh.hm lines.bin points.hm | hmconv >mixed.hm
same 'cat of text and binary' all.hm mixed.hm
printf '#hm 1 points text\n#fields x y z\n#data\n7 8 9\n#end 1\n' >seven.hm
{ cat lines.bin; echo 7 8 9; cat grid.bin; } | hmconv >got
cat lines.hm seven.hm grid.hm >want
same 'a bare table among binary streams' want got
sed 's/$/\r/' all.hm >crlf.hm
hmconv crlf.hm >got
same 'CR LF' all.hm got
hmconv -t single grid.hm | hmconv >got
awk '/^#/ || $4 != "1e-7"' grid.hm >want
awk '/^#/ || $4 !~ /e/' got >single.hm
same 'single precision holds small whole numbers' want single.hm

# --- filters in the middle ---
awk '/^#/ || $1 < 3' points.hm >fewer.hm
ok 'a filter may drop records' hmconv -o out fewer.hm
must_fail 'but not with --strict' 2 'fewer.hm:8: 2 records were announced, 1 came' hmconv --strict fewer.hm

# --- cut off: every length, no output taken for whole ---
for f in all.hm all.bin; do
    size=$(wc -c <$f)
    bad=
    for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
        head -c $((size * i / 21)) $f >cut
        hmconv -o cut.out cut 2>cut.err
        [ $? -eq 2 ] && grep -q 'cut' cut.err && [ ! -e cut.out ] || bad="$bad $i"
        hmconv cut 2>/dev/null | hmconv -o cut.out 2>/dev/null
        [ $? -eq 2 ] && [ ! -e cut.out ] || bad="$bad $i(pipe)"
    done
    [ -z "$bad" ]
    report $? "$f cut at 20 places is refused here and downstream$bad"
done

# --- text by several threads: the same points, and mistakes at the same lines ---
awk 'BEGIN { for (i = 1; i <= 60000; i++) { printf "%s %s %s%s\n", i / 8, -i, i % 7 ? i / 1000 : "nan", i % 5 ? "" : "\r"
    if (i % 9001 == 0) print "# " i; if (i % 17011 == 0) print "" } printf "1 2 3" }' >many.xyz
{ printf '#hm 1 points text\n#fields x y z\n#data\n'; awk '{ print } END { print "#end" }' many.xyz; cat points.hm; } >many.hm
for f in many.xyz many.hm; do
    hmconv -j 1 $f >want
    for j in 2 7; do
        hmconv -j $j $f >got
        same "$f: $j threads" want got
        hmconv -j $j <$f | cmp -s - want
        report $? "$f: $j threads, through a pipe"
    done
done
true_that 'all of them' "$(grep -c '^[^#]' want) == 60003"
for line in 1 16384 16385 40000 60010; do
    sed "${line}s/.*/1 2 3 word/" many.xyz >word.xyz
    for j in 1 2; do
        must_fail "line $line, $j threads" 2 "word.xyz:$line: " hmconv -o out -j $j word.xyz
    done
done

# --- files ---
must_fail 'a full disk' 2 'cannot write: No space' sh -c 'hmconv points.hm >/dev/full'
must_fail 'a full disk, by name' 2 'cannot write: No space' hmconv -o /dev/full points.hm
awk 'BEGIN { for (i = 0; i < 300000; i++) print i, i + 0.5, 1 }' >many.xyz
must_fail 'a full disk in the middle' 2 'No space' sh -c 'hmconv -b many.xyz >/dev/full'
cp points.hm same.hm
ok 'an input may be the output' hmconv -o same.hm same.hm
same 'and is as it was' points.hm same.hm
chmod 640 same.hm
hmconv -o same.hm points.hm
ok 'the mode of a file stays' test "$(ls -l same.hm | cut -c1-10)" = -rw-r-----
ln -s same.hm link.hm
hmconv -o link.hm grid.hm
ok 'a link stays a link' test -h link.hm
same 'and what it points to is written' grid.hm same.hm
echo old >kept
printf '1 2 3\n4 x 6\n' >bad.xyz
must_fail 'a failure leaves' 2 'bad.xyz:2: expected a number, got "x"' hmconv -o kept bad.xyz
ok 'the old file' grep -qx old kept
ok 'and nothing beside it' sh -c '! ls | grep part'
must_fail 'no such file' 2 'none.hm: cannot open: No such file' hmconv none.hm
must_fail 'a folder' 2 'cannot read: Is a directory' hmconv .
must_fail 'empty input' 2 'standard input: empty' sh -c ': | hmconv'
(hmconv many.xyz; echo $? >status) 2>err | head -1 >/dev/null
ok 'a closed pipe ends it in silence' test ! -s err
ok 'by SIGPIPE' test "$(cat status)" -gt 128

# --- killed: nothing is left, neither of the output nor of what --keep holds for a second reading ---
mkdir product spool
mkfifo pipe
TMPDIR=$WORK/spool slope --keep -o product/kept.hm pipe &
pid=$!
exec 3>pipe # opened by the tool behind all that it writes
cat grid.hm >&3
named=$(ls product)
kill -TERM $pid
wait $pid 2>/dev/null
exec 3>&-
ok 'no spool is left' test -z "$(ls -A spool)"
if [ -n "$named" ]; then
    skip 'this file system has no files without names'
else
    ok 'nor the output' test -z "$(ls -A product)"
fi
sed 's/ slope$//; s/^\([^#]*\) [^ ]*$/\1/' grid.hm >height.hm
cat points.hm height.hm lines.hm | TMPDIR=$WORK/spool slope --keep >got 2>err
slope height.hm | cat points.hm height.hm lines.hm - >want
same '--keep: the inputs, then the product' want got
ok 'what the tool does not use is named' grep -qx 'slope: standard input: lines not used here' err
must_fail '--keep without room' 2 'nowhere/hm-spool-' env TMPDIR=nowhere slope --keep height.hm

# --- bare tables: which column is what ---
# table NAMES LINE: the first point of a table, by hmconv
table() { printf '%s\n%s\n' "$1" "$2" | hmconv | grep '^[^#]'; }
ok 'three columns, two names known: the third is z' test "$(table Easting,Northing,Hoogte 1,2,3)" = '1 2 3'
ok '... wherever it stands' test "$(table 'Kote y x' '3 2 1')" = '1 2 3'
ok 'German names' test "$(table 'Punkt Hochwert Rechtswert Höhe' '7 2 1 3')" = '1 2 3 7'
ok 'three names of which none is known' test "$(table 'a b c' '1 2 3')" = '1 2 3'
printf 'x y Hoogte code\n1 2 3 4\n' >unnamed.txt
must_fail 'four columns and no height' 2 'unnamed.txt:1: no column is named as a height .*: x y hoogte code' hmconv unnamed.txt
printf 'id x Hochw z\n1 2 3 4\n' >unnamed.txt
must_fail 'four columns and no y' 2 'no column is named as y .*: id x hochw z' hmconv unnamed.txt

# --- progress: on a terminal, after two seconds, and taken away again ---
if script -qec true terminal >/dev/null 2>&1 </dev/null && [ -e terminal ]; then
    mkfifo slow
    { echo 0 0 0; sleep 2.3; awk 'BEGIN { for (i = 0; i < 20000; i++) print i % 100, int(i / 100), 1 }'; } >slow &
    script -qec 'bsgrid -o progress.hm slow' terminal >/dev/null </dev/null
    ok 'a slow run says how far it is' grep -q 'bsgrid: reading: 0.0 million points' terminal
    ok 'and wipes that away' grep -q "$(printf '\033')\[Kbsgrid: 20001 points" terminal
else
    skip 'no script here'
fi

# --- foreign, on real data ---
if need_data willamette_autzen/autzen_trim.las; then
    las=$DATA/willamette_autzen/autzen_trim.las
    hmconv "$las" | awk '!/^#/ && $4 == 2 { printf "%.3f %.3f %.3f\n", $1 * 0.3048, $2 * 0.3048, $3 * 0.3048 }' |
        sort >got
    sort "$DATA/willamette_autzen/points_ground_m.xyz" >want
    ok 'LAS: 26,107 points of the ground' test "$(wc -l <got)" -eq 26107
    # the sums rounded another way differ in the last digit at most
    true_that 'LAS: where they are, to a millimetre' \
        "$(paste -d ' ' got want | awk '{ for (i = 1; i < 4; i++) { e = $i - $(i + 3); if (e < 0) e = -e; if (e > m) m = e } } END { print m + 0 }') < 0.0011"
    hmconv "$las" >file.hm
    cat "$las" | hmconv >pipe.hm
    same 'LAS through a pipe' file.hm pipe.hm
    head -c 1000000 "$las" >cut.las
    must_fail 'LAS cut off' 2 'cut off behind [0-9]* of 110000 points' hmconv cut.las
fi
if need_data lidarhd_farmland_dense/tile_pdrf8_extra_bytes.laz; then
    must_fail 'LAZ' 2 'laszip -i .*extra_bytes.laz -stdout -olas' \
        hmconv "$DATA/lidarhd_farmland_dense/tile_pdrf8_extra_bytes.laz"
fi
if need_data severn_caersws/caersws_10m.asc; then
    hmconv "$DATA/severn_caersws/caersws_10m.asc" >severn.hm
    awk '!/^#/ && $3 != "nan" { printf "%.3f %.3f %.3f\n", $1, $2, $3 }' severn.hm >got
    same 'ESRI ASCII grid: the centres of all cells with data' "$DATA/severn_caersws/points.xyz" got
    ok 'the north comes first' grep -qx '#step 10 -10' severn.hm
fi
if command -v ogr2ogr >/dev/null; then
    printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"surface":"main","side":"left","note":"a b"},"geometry":{"type":"LineString","coordinates":[[1,2,3],[4,5,6]]}},{"type":"Feature","properties":{"face":"main"},"geometry":{"type":"LineString","coordinates":[[0,0,0],[4,0,0],[4,4,0],[0,0,0]]}}]}' >lines.json
    ok 'ogr2ogr writes OGR_GMT' ogr2ogr -f OGR_GMT lines.gmt lines.json
    hmconv lines.gmt | grep -v -e '^#' >got
    printf '> surface=main side=left note="a b"\n1 2 3\n4 5 6\n> face=main closed=1\n0 0 0\n4 0 0\n4 4 0\n' >want
    same 'its attributes arrive' want got
else
    skip 'no ogr2ogr here'
fi
done_testing
