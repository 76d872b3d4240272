#!/bin/sh
# hmconv for a GIS and for Triangle: points and lines as GeoJSON, WKT, OGR_GMT, csv, .node, .poly and
# .ele; there and back, as GDAL reads and writes them, and what is broken.
. "${0%/*}/tap.sh"

# back FORMAT FILE: the file as that format, to got.FORMAT, and from there to back.FORMAT
back() {
    hmconv -t "$1" "$2" >"got.$1" 2>err && hmconv "got.$1" >"back.$1"
}

json=true
printf '{"type":"Point","coordinates":[1,2]}' | hmconv >/dev/null 2>&1 || json=false

cat >lines.txt <<'END'
> surface=main side=left name="upper, \"bank\"" code=007 w=2.5
545000.1 5972000.123456789 3
545010 5972000 -2e-7
> hole=1
1 1 1
2 1 1
2 2 1.5
1 1 1
>
545010 5972000 -2e-7
20 10 0.30000000000000004
20 20 1
> region=3 max_area=10
100 100 nan
200 100 nan
200 200 nan
100 100 nan
END
sed 's/^#data/#crs UTM 32N WGS84\n&/' >lines.hm <<END
$(hmconv lines.txt)
END
hmconv lines.txt >plain.hm
ok "the lines" sh -c 'grep -c "^>" lines.hm | grep -qx 4 && grep -q "^#crs UTM 32N" lines.hm'

# --- lines, there and back ---
cat >want <<'END'
WKT,surface,side,name,code,w,hole,region,max_area
"LINESTRING Z (545000.1 5972000.123456789 3, 545010 5972000 -2e-7)",main,left,"upper, ""bank""",007,2.5,,,
"POLYGON Z ((1 1 1, 2 1 1, 2 2 1.5, 1 1 1))",,,,,,1,,
"LINESTRING Z (545010 5972000 -2e-7, 20 10 0.30000000000000004, 20 20 1)",,,,,,,,
"POLYGON ((100 100, 200 100, 200 200, 100 100))",,,,,,,3,10
END
back wkt lines.hm
same "WKT, a table with the attributes" want got.wkt
same "and back" plain.hm back.wkt
ok "the crs is told of" grep -q 'no place for the crs: "UTM 32N WGS84"' err
cat >want <<'END'
# @VGMT1.0 @GLINESTRING
# @Je32632
# @Nsurface|side|name|code|w|hole|region|max_area
# @Tstring|string|string|string|string|string|string|string
# FEATURE_DATA
>
# @Dmain|left|"upper, \"bank\""|007|2.5|||
545000.1 5972000.123456789 3
545010 5972000 -2e-7
>
# @D|||||1||
1 1 1
2 1 1
2 2 1.5
1 1 1
>
# @D|||||||
545010 5972000 -2e-7
20 10 0.30000000000000004
20 20 1
>
# @D||||||3|10
100 100 nan
200 100 nan
200 200 nan
100 100 nan
END
back ogrgmt lines.hm
same "OGR_GMT" want got.ogrgmt
sed 's/^#crs.*/#crs EPSG:32632/' lines.hm >want
same "and back" want back.ogrgmt
ok "a code and the words for it are one crs" sh -c 'cat lines.hm got.ogrgmt | hmconv -t geojson >/dev/null'
sed '/^#crs/s/32N/33N/' lines.hm >other.hm
must_fail "another zone is another" 2 "differ in their crs" hmconv -t geojson got.ogrgmt other.hm
cat >want <<'END'
10 2 1 0
1 545000.1 5972000.123456789 3
2 545010 5972000 -2e-7
3 1 1 1
4 2 1 1
5 2 2 1.5
6 20 10 0.30000000000000004
7 20 20 1
8 100 100 nan
9 200 100 nan
10 200 200 nan
END
back poly lines.hm
head -n 11 got.poly >head
same "Triangle's .poly: a node a place" want head
cat >want <<'END'
9 1
# > surface=main side=left name="upper, \"bank\"" code=007 w=2.5
1 1 2 2
# > hole=1
2 3 4 3
3 4 5 3
4 5 3 3
# >
5 2 6 4
6 6 7 4
# > region=3 max_area=10
7 8 9 5
8 9 10 5
9 10 8 5
1
1 1.75 1.5
1
1 175 150 3 10
END
sed 1,11d got.poly >tail
same "segments with their lines, a place in the hole and in the region" want tail
same "and back, the attributes by comments" plain.hm back.poly
grep -v '^# >' got.poly | hmconv >bare.hm
cat >want <<'END'
> marker=2
> marker=3 hole=1 closed=1
> marker=4
> marker=5 region=3 max_area=10 closed=1
END
grep '^>' bare.hm >got
same "without the comments: markers, holes and regions" want got
if $json; then
    back geojson lines.hm
    same "GeoJSON and back, with the crs" lines.hm back.geojson
    hmconv -t geojson plain.hm >got.json
    ok "no crs is null" grep -q '^"crs": null' got.json
    hmconv got.json >got
    same "and stays none" plain.hm got
    printf '> a=1\n9.1 48.2 1\n9.2 48.3 2\n' | hmconv >degrees.hm
    sed 's/^#data/#crs longitude latitude WGS84\n&/' degrees.hm >want
    hmconv -t geojson want >got.json
    ok "longitude and latitude need no crs" sh -c '! grep -q crs got.json'
    hmconv got.json >got
    same "and are known without" want got
    must_fail "so that the other tools refuse them" 2 "georef" sh -c 'hmconv got.json | trimesh -l 1'
    must_fail "which know no GeoJSON" 2 "hmconv reads more" trimesh -l 1 got.json
else
    skip "hmconv is built without jansson"
fi
printf '> a=1\n1 2 3\n4 5 nan\n7 8 9\n' >half.txt
for f in geojson wkt; do
    hmconv -t $f half.txt >got 2>err
    ok "$f: a line with some heights loses them, and it is said" sh -c \
        'grep -q "1 line without a height at some vertex" err && ! grep -q 9[,\ ]*3 got'
done
hmconv -p 1 -t wkt lines.hm >got 2>err
ok "fewer digits" grep -q '545000.1 5972000.1 3, 545010 5972000 0)' got
must_fail "not where nodes are told apart by their places" 2 "precision" hmconv -p 1 -t poly lines.hm

# --- points ---
printf 'x,y,z,class,gain\n545000.1,5972000.123456789,1.25,2,0.1\n7,8,,,-0.00003\n' >points.csv
hmconv points.csv >points.hm
back csv points.hm
same "csv, with names and gaps" points.csv got.csv
same "and back" points.hm back.csv
for f in wkt geojson; do
    [ $f = wkt ] || $json || continue
    back $f points.hm
    same "$f and back: all columns" points.hm back.$f
done
back node points.hm
cat >want <<'END'
2 2 3 0
1 545000.1 5972000.123456789 1.25 2 0.1
2 7 8 nan nan -0.00003
END
same "Triangle's .node" want got.node
sed 's/class gain/attribute2 attribute3/' points.hm >want
same "and back, the names lost" want back.node
ok "which is said" grep -q 'class is attribute 2' err
printf '1 2 3\n4 5 6\n' >more.xyz
hmconv -t poly more.xyz lines.txt >both.poly
hmconv both.poly >both.hm
hmconv more.xyz >want; cat plain.hm >>want
same "points and lines in one .poly" want both.hm
printf '#hm 1 grid text\n#size 2 2\n#origin 0 0\n#step 1 1\n#fields x y z slope\n#data\n0 0 1 2\n1 0 3 4\n0 1 nan 5\n1 1 6 7\n#end\n' >grid.hm
printf 'x,y,z,slope\n0,0,1,2\n1,0,3,4\n0,1,,5\n1,1,6,7\n' >want
hmconv -t csv grid.hm >got
same "the nodes of a grid with all bands" want got
hmconv -t xyz grid.hm >/dev/null 2>err
ok "the bands that xyz leaves are said" grep -q 'xyz has no place for the column slope' err
hmconv -t asc --band slope grid.hm >/dev/null 2>err
ok "and those of asc" grep -q 'asc has no place for the column z' err
must_fail "a table of two kinds of columns" 2 "other columns" hmconv -t csv points.hm more.xyz

# --- meshes ---
cat >mesh.hm <<'END'
#hm 1 mesh text
#data
v 545000.5 5972000.123456789 1.25 0 0
v 545010 5972000 0.30000000000000004 0 0
v 545010 5972010 -2e-7 0 0
v 545000 5972010 2 0 0
v 545005 5972005 7 0 0
t 0 1 4 0
t 1 2 4 7
t 2 3 4 0
t 3 0 4 2
#end 9
END
hmconv -t node mesh.hm >mesh.node
hmconv -t ele mesh.hm >mesh.ele
printf '4 3 1\n1 1 2 5 0\n2 2 3 5 7\n3 3 4 5 0\n4 4 1 5 2\n' >want
same "elements" want mesh.ele
ok "nodes, the inner one without marker" grep -qx '5 545005 5972005 7 0' mesh.node
cat mesh.node mesh.ele | hmconv >got
same ".node and .ele to a mesh again" mesh.hm got
awk 'NR == 1 { print; next } { print $1 - 1, $2, $3, $4, $5, "  # from 0" }' mesh.node >zero
awk 'NR == 1 { print "# a comment"; print; print ""; next } { print $1 - 1, $2 - 1, $3 - 1, $4 - 1, $5 }' mesh.ele >>zero
hmconv zero >got
same "counted from 0, with comments" mesh.hm got
must_fail "elements alone" 2 "cat FILE.node FILE.ele" hmconv mesh.ele
must_fail "points and a mesh in one .node" 2 "no more" hmconv -t node mesh.hm more.xyz
printf '0 2 1 0\n1 0\n1 1 2\n0\n' >no.poly
must_fail "a .poly without its nodes" 2 "cat FILE.node FILE.poly" hmconv no.poly
cat mesh.node no.poly | hmconv >got
ok "with them" sh -c 'grep -q "^#hm 1 lines" got && grep -q "^#end 3" got'

# --- WKT of others ---
cat >other.wkt <<'END'
SRID=25832;POINT ZM (1 2 3 4)
MULTIPOINT ((1 2), (3 4));MultiLineStringZ((0 0 1,
  1 1 2), (5 5 5, 6 6 6))
GEOMETRYCOLLECTION (POLYGON ((0 0,1 0,1 1,0 0),(0.1 0.1,.2 .1,.2 .2,.1 .1)), POINT EMPTY, POINT M (7 8 9))
END
cat >want <<'END'
#hm 1 points text
#fields x y z
#crs EPSG:25832
#data
1 2 3
1 2 nan
3 4 nan
7 8 nan
#end 4
#hm 1 lines text
#fields x y z
#crs EPSG:25832
#data
>
0 0 1
1 1 2
>
5 5 5
6 6 6
> closed=1
0 0 nan
1 0 nan
1 1 nan
> hole=1 closed=1
0.1 0.1 nan
0.2 0.1 nan
0.2 0.2 nan
#end 4
END
hmconv other.wkt >got
same "WKT: many, measured, collected, over several lines" want got
printf 'name;geom;n\r\n"a;b";POINT(1 2);3\r\n;;\r\n' | hmconv >got
ok "a table of others, with a geometry missing" sh -c 'grep -q "^#fields x y z n" got && grep -qx "1 2 nan 3" got'

# --- as GDAL reads and writes them ---
if command -v ogr2ogr >/dev/null; then
    cp got.ogrgmt lines.gmt
    hmconv -t wkt lines.hm >lines.csv 2>err
    hmconv -t geojson lines.hm >lines.geojson
    # the geometries of a file as GDAL has them, a line each; closed lines may be polygons
    shapes() {
        ogrinfo -al -q "$1" | sed -n -e 's/^  \(LINESTRING.*\|POLYGON.*\)/\1/p' | sed -e 's/POLYGON/LINESTRING/; s/((/(/; s/))/)/; s/ Z / /; s/\.0\([ ,)]\)/\1/g; s/ nan\([,)]\)/\1/g'
    }
    cat >want <<'END'
LINESTRING (545000.1 5972000.12345679 3,545010 5972000 -0.0000002)
LINESTRING (1 1 1,2 1 1,2 2 1.5,1 1 1)
LINESTRING (545010 5972000 -0.0000002,20 10 0.3,20 20 1)
LINESTRING (100 100,200 100,200 200,100 100)
END
    for f in lines.gmt lines.csv lines.geojson; do
        shapes $f >got
        sed -e 's/-2[eE]-07/-0.0000002/g' got >got.plain
        same "$f as GDAL reads it" want got.plain
    done
    for f in lines.gmt lines.geojson; do
        ok "$f: GDAL knows the crs" sh -c "ogrinfo -al -so $f | grep -q 'UTM zone 32N'"
    done
    ok "GDAL reads the attributes" sh -c 'ogrinfo -al -q lines.geojson | grep -q "max_area (Integer) = 10" &&
        ogrinfo -al -q lines.geojson | grep -q "name (String) = upper, \"bank\"" && ogrinfo -al -q lines.gmt | grep -q "side (String) = left"'
    ogr2ogr -f CSV -lco GEOMETRY=AS_WKT there.csv lines.geojson >gdal.log 2>&1
    hmconv there.csv | grep -v '^#' | sed 's/ "closed=1"//' >got
    grep -v '^#' lines.hm | sed 's/\.123456789/.12345679/; s/0.30000000000000004/0.3/' >want
    same "the table of WKT that GDAL writes" want got
    if $json; then
        ogr2ogr -f GeoJSON -lco COORDINATE_PRECISION=15 there.geojson lines.geojson >gdal.log 2>&1
        hmconv there.geojson >got
        sed 's/0.30000000000000004$/0.3/' lines.hm >want
        same "the GeoJSON that GDAL writes" want got
        hmconv -t geojson plain.hm >unknown.geojson
        ogr2ogr -f GeoJSON there.geojson unknown.geojson >gdal.log 2>&1
        ok "and of data without a crs, of which it says CRS84" sh -c 'hmconv there.geojson >got && ! grep -q "^#crs" got'
        ogr2ogr -f GeoJSON -lco RFC7946=YES lonlat.geojson lines.geojson -where "surface='main'" >gdal.log 2>&1
        hmconv -i lonlat.geojson >got
        ok "and in longitude and latitude" sh -c 'grep -q "longitude latitude" got && grep -q "x  *9.68" got'
    fi
    ogr2ogr -f OGR_GMT there.gmt lines.geojson -where "surface='main'" >gdal.log 2>&1
    ok "and the OGR_GMT" sh -c 'hmconv there.gmt | grep -q "surface=main side=left" && hmconv there.gmt | grep -q "^#crs EPSG:32632"'
    hmconv -t asc grid.hm >grid.asc 2>err
    gdal_translate -q -of XYZ grid.asc grid.xyz >gdal.log 2>&1
    printf '0 1 -9999\n1 1 6\n0 0 1\n1 0 3\n' >want
    same "the ESRI grid as GDAL reads it" want grid.xyz
else
    skip "ogr2ogr is not there (gdal-bin)"
fi

# --- broken files ---
# refused NAME PATTERN TEXT: hmconv says so of a file with that text, and writes nothing
refused() {
    printf '%s' "$3" >bad.file
    must_fail "$1" 2 "bad.file.*$2" hmconv bad.file
    [ -s tap.out ] && report 1 "$1: something was written"
}
if $json; then
    refused "GeoJSON cut off" "end of file" '{"type":"Feature"'
    refused "half a place" "not .x, y" '{"type":"Point","coordinates":[1]}'
    refused "a word for a number" "no number" '{"type":"Point","coordinates":["a",2]}'
    refused "no GeoJSON" "not one of GeoJSON" '{"a":1}'
    refused "a number that is none" "overflow" '{"type":"LineString","coordinates":[[1,2],[1e999,2]]}'
    refused "depth" "no list" '{"type":"Polygon","coordinates":[[1,2],[3,4]]}'
    refused "nothing in it" "no points, lines or elements" '{"type":"FeatureCollection","features":[]}'
    refused "the feature is named" "feature 2" \
        '{"type":"FeatureCollection","features":[{"type":"Point","coordinates":[1,2]},{"type":"Pint"}]}'
fi
refused "WKT: one number" "expected a number" 'POINT (1)'
refused "WKT cut off" "ends here" 'POINT (1 2'
refused "WKT: a word" 'got "x' 'LINESTRING (1 2, 3 x)'
refused "WKT: one parenthesis" "expected \\(" 'POLYGON (1 2, 3 4)'
refused "WKT: infinite" "infinite" 'POINT (1 1e999)'
refused "WKT: more fields" ":2: more fields" 'WKT,a
"POINT (1 2)",3,4'
refused "WKT: text behind" ":2: expected nothing more" 'WKT,a
POINT (1 2) and so on,3'
refused "WKT: a table of nothing" "no points, lines or elements" 'WKT,a
,3'
nodes='3 2 1 0
1 0 0 1
2 1 0 1
3 0 1 1
'
refused "Triangle: nodes missing" ":3: the file ends here" '3 2 1 0
1 0 0 1
2 1 0 1
'
refused "Triangle: an id twice" "have the id 2" '3 2 1 0
1 0 0 1
2 1 0 1
2 0 1 1
'
refused "Triangle: a node that is not there" ":6: a node that is not there" "${nodes}1 3 0
1 1 2 9
"
refused "Triangle: mid-side nodes" "mid-side" "${nodes}1 6 0
1 1 2 3 1 2 3
"
refused "Triangle: a huge count" "the file ends here" "${nodes}2000000000 3 0
1 1 2 3
"
refused "Triangle: a region that is none" "not a whole number" "${nodes}1 3 1
1 1 2 3 0.5
"
refused "Triangle: edges" "neither nodes, elements nor segments" "${nodes}1 7 1 1 1
"
refused "Triangle: attributes cut off" "without its attributes" "${nodes}2 1
# > name=\"a
1 1 2 3
"
for f in geojson wkt poly node; do
    [ -s got.$f ] || continue
    [ $f != node ] || head -n 2 got.node >got.node # a node more would be no loss
    size=$(wc -c <got.$f)
    for part in 1 2 3 4 5 6 7 8 9 10 11; do
        head -c $((size * part / 12)) got.$f >cut
        hmconv cut >got 2>err
        status=$?
        # a table of WKT may end behind any of its rows; but never is there a crash
        case $status in
        2) ;;
        0) [ $f = wkt ] || echo "$part: taken for whole" ;;
        *) echo "$part: status $status" ;;
        esac
    done >bad
    [ ! -s bad ]
    report $? "$f cut off: an error"
    sed 's/^/# /' bad
done

# --- names in Latin-1, as older shape files have them ---
printf '> name=Fl\374\337chen river="Gro\303\237e Laber"\n0 0 0\n10 10 5\n' >latin.txt
printf '> name=Fl\303\274\303\237chen river="Gro\303\237e Laber"\n0 0 0\n10 10 5\n' >utf8.txt
hmconv -t geojson latin.txt >latin.geojson
hmconv -t geojson utf8.txt >utf8.geojson
same "GeoJSON is UTF-8" latin.geojson utf8.geojson

# --- a table whose first line is no header of Triangle's ---
printf '38 2147483647 0\n1 2 3\n' >table.xyz
ok "a table with a coordinate of 2147483647" sh -c 'hmconv table.xyz | grep -qx "38 2147483647 0"'
done_testing
