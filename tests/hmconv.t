#!/bin/sh
# hmconv: what comes back is what went in, and foreign formats have the shape that their readers want.
. "${0%/*}/tap.sh"

cat >mesh.hm <<'END'
#hm 1 mesh text
#name main
#string inflow 0 3
#string outflow 4 1 0
#data
v 545000.1 5972000.123456789 1.1 0 0
v 545010 5972000 0.30000000000000004 0 0
v 545010 5972010 -2e-7 0 0
v 545000 5972010 2 0 0
v 545020 5972000 12345.678 0 0
q 0 1 2 3 0
t 1 4 2 7
#end 7
END

# --- meshes: .2dm ---
ok "to 2dm" hmconv -t 2dm -o mesh.2dm mesh.hm
cat >want.2dm <<'END'
MESH2D
MESHNAME "main"
NUM_MATERIALS_PER_ELEM 1
ND 1 545000.1 5972000.123456789 1.1
ND 2 545010 5972000 0.30000000000000004
ND 3 545010 5972010 -2e-7
ND 4 545000 5972010 2
ND 5 545020 5972000 12345.678
E4Q 1 1 2 3 4 8
E3T 2 2 5 3 7
NS 1 -4 inflow
NS 5 2 -1 outflow
BEG2DMBC
MAT 8 "region 0"
END2DMBC
END
same "2dm, card by card" want.2dm mesh.2dm
hmconv mesh.2dm >back.hm
same "and back: coordinates, connectivity, regions, strings, name" mesh.hm back.hm
hmconv -t 2dm back.hm >again.2dm
same "and once more" mesh.2dm again.2dm
awk 'BEGIN { print "#hm 1 mesh text\n#data"; for (i = 0; i < 50; i++) print "v", i, 0, 0, 0, 0
    for (i = 0; i < 50; i++) print "v", i, 1, 0, 0, 0
    for (i = 0; i < 49; i++) print "q", i, i + 1, i + 51, i + 50, i % 3 + 1
    printf "#end\n" }' | sed 's/^#data/#string bank 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21\n&/' >strip.hm
hmconv strip.hm >want.hm
hmconv -t 2dm strip.hm >strip.2dm
hmconv strip.2dm >back.hm
same "a long string over several cards; no region 0" want.hm back.hm
ok "three cards of it, no MAT" sh -c '[ $(grep -c ^NS strip.2dm) -eq 3 ] && ! grep -q ^MAT strip.2dm'
ok "no tab, no carriage return, a last line feed" sh -c \
    "! grep -q '[[:cntrl:]]' mesh.2dm && [ \"\$(tail -c 1 mesh.2dm | od -An -tx1)\" = ' 0a' ]"
must_fail "a node without height" 2 "no height at 545010 5972000" \
    sh -c "sed 's/0.30000000000000004/nan/' mesh.hm | hmconv -t 2dm"
ok "nothing was written then" sh -c '[ ! -s tap.out ]'
must_fail "two meshes" 2 "one mesh" hmconv -t 2dm mesh.hm strip.hm
ok "nothing was written then" sh -c '[ ! -s tap.out ]'
must_fail "a truncated mesh" 2 "end" sh -c "sed '\$d' mesh.hm | hmconv -t 2dm"
ok "nothing was written then" sh -c '[ ! -s tap.out ]'
must_fail "fewer digits would move nodes" 2 "precision" hmconv -p 2 -t 2dm mesh.hm
must_fail "nor in a stream, whatever stands before it" 2 "precision would move the nodes of a mesh" \
    sh -c 'printf "1 2 3\n" | cat - mesh.hm | hmconv -p 2'
ok "nothing was written then" sh -c '[ ! -s tap.out ]'
printf '1.234 2 3\n#hm 1 lines text\n#data\n>\n1.26 2 3\n4 5 6\n#end\n' | hmconv -p 1 >got
ok "without a mesh all is rounded" sh -c 'grep -qx "1.2 2 3" got && grep -qx "1.3 2 3" got && grep -c "^#end" got | grep -qx 2'
must_fail "a string of a node that is not there" 2 "string inflow" \
    sh -c "sed 's/inflow 0 3/inflow 0 5/' mesh.hm | hmconv -t 2dm"

# --- grids: ESRI ASCII ---
cat >grid.hm <<'END'
#hm 1 grid text
#size 3 2
#origin 100.5 200.5
#step 1 1
#fields x y z slope
#data
100.5 200.5 1 0.1
101.5 200.5 2 0.2
102.5 200.5 nan nan
100.5 201.5 4 0.4
101.5 201.5 -9999 0.5
102.5 201.5 6.125 0.6
#end 6
END
cat >want.asc <<'END'
ncols 3
nrows 2
xllcorner 100
yllcorner 200
cellsize 1
NODATA_value -99999
4 -9999 6.125
1 2 -99999
END
hmconv -t asc grid.hm >got.asc
same "ESRI ASCII: north first, nodata that no node has" want.asc got.asc
cat >want.asc <<'END'
ncols 3
nrows 2
xllcorner 100
yllcorner 200
cellsize 1
NODATA_value -9999
0.4 0.5 0.6
0.1 0.2 -9999
END
hmconv -t asc --band slope grid.hm >slope.asc
same "another band" want.asc slope.asc
hmconv slope.asc | hmconv -t asc >back.asc
same "a grid that runs south, as ESRI's are read, is not turned" want.asc back.asc
hmconv -t xyz grid.hm >north.xyz
hmconv got.asc | hmconv -t xyz | sort >south.xyz
sort north.xyz >sorted.xyz
same "the same nodes after the way there and back" sorted.xyz south.xyz
sed -e 's/^#origin.*/#origin 0.001 0.001/' -e 's/^#step.*/#step 7 7/' grid.hm |
    awk '/^#/ { print; next } { $1 = 0.001 + 7 * (k % 3); $2 = 0.001 + 7 * int(k / 3); k++; print }' >fine.hm
hmconv -t asc fine.hm >fine.asc
ok "a corner that would not lead back to 0.001 exactly: the middle of the cell" \
    grep -q '^xllcenter 0.001' fine.asc
hmconv fine.asc >fine_back.hm
ok "and the origin comes back exactly" grep -q '^#origin 0.001 7.001$' fine_back.hm
must_fail "a .prj of nothing" 2 "no crs is said" hmconv -t prj grid.hm
must_fail "a .prj without words" 2 'no words for the crs "local"' sh -c "sed 's/^#data/#crs local\n&/' grid.hm | hmconv -t prj"
must_fail "cells that are not square" 2 "square" sh -c "sed 's/^#step.*/#step 1 2/; s/ 201.5/ 202.5/' grid.hm | hmconv -t asc"
must_fail "a band that is not there" 2 "no band 'aspect'" hmconv -t asc --band aspect grid.hm
must_fail "two grids" 2 "one grid" hmconv -t asc grid.hm grid.hm
hmconv -t single grid.hm | hmconv >single.hm
ok "single precision: 0.1 is 0.1 no more, 6.125 is" sh -c "grep -q ' 6.125 ' single.hm && ! grep -q ' 0.1\$' single.hm"

# --- points and lines ---
printf '1 2 3\n4.5 5 nan\n7 8 9.25\n' >points.xyz
hmconv -t xyz points.xyz >got 2>err
printf '1 2 3\n7 8 9.25\n' >want
same "xyz" want got
ok "what has no height is counted" grep -q '1 without height left out' err
hmconv -p 1 -t xyz points.xyz 2>/dev/null >got
printf '1 2 3\n7 8 9.2\n' >want
same "xyz with fewer digits" want got
cat >lines.txt <<'END'
> surface=main side=left
1 2 3
4 5 6
> closed=1 face="two words"
1 1 1
2 1 1
2 2 1.5
END
hmconv -t gmt lines.txt >got.gmt
cat >want.gmt <<'END'
> surface=main side=left
1 2 3
4 5 6
> face="two words"
1 1 1
2 1 1
2 2 1.5
1 1 1
END
same "GMT" want.gmt got.gmt
hmconv got.gmt | hmconv -t gmt >back.gmt
same "GMT and back" want.gmt back.gmt

# --- streams ---
for kind in mesh.hm grid.hm points.xyz lines.txt; do
    hmconv $kind >text
    hmconv -t binary text >binary
    hmconv -b text >other
    same "$kind: -b is -t binary" binary other
    hmconv binary >back
    same "$kind: text, binary, text" text back
done
cat grid.hm mesh.hm lines.txt | hmconv | hmconv -b | hmconv -i | grep -c : >got
echo 3 >want
same "several objects in one stream" want got
hmconv -t 2dm grid.hm mesh.hm 2>err >got
same "what a format cannot hold is left out" mesh.2dm got
ok "and said" grep -q 'grid.hm: grid not written as 2dm' err
must_fail "nothing that fits" 2 "2dm can hold" hmconv -t 2dm grid.hm
must_fail "an unknown format" 2 "text|binary" hmconv -t shp grid.hm
must_fail "binary text" 2 "exclude" hmconv -b -t xyz points.xyz
: >empty
must_fail "an empty file" 2 "empty" hmconv empty
must_fail "a full disk" 2 "space|full" sh -c "hmconv mesh.hm >/dev/full"
must_fail "a full disk for 2dm" 2 "space|full" sh -c "hmconv -t 2dm mesh.hm >/dev/full"
cp mesh.hm own.hm
ok "over its own input" hmconv -b -o own.hm own.hm
hmconv own.hm >back.hm
same "which then holds the same" mesh.hm back.hm

# --- --info ---
cat >want <<'END'
grid.hm: grid
  nodes    3 x 2
  step     1 1
  x        100.5 .. 102.5
  y        200.5 .. 201.5
  z        -9999 .. 6.125, 1 missing
  slope    0.1 .. 0.6, 1 missing
mesh.hm: mesh
  nodes    5
  elements 1 triangles, 1 quadrilaterals
  x        545000 .. 545020
  y        5972000 .. 5972010
  z        -2e-7 .. 12345.678
  region   0 .. 7
  name     main
  string   inflow 0 3
  string   outflow 4 1 0
lines.txt: lines
  lines    2, 1 closed, 5 vertices
  x        1 .. 4
  y        1 .. 5
  z        1 .. 6
points.xyz: points
  points   3
  x        1 .. 7
  y        2 .. 8
  z        3 .. 9.25, 1 missing
END
hmconv -i grid.hm mesh.hm lines.txt points.xyz >got
same "--info of every kind" want got
done_testing
