#!/bin/sh
# georef: against the tools of GeographicLib over the globe, and what headers and messages say.
. "${0%/*}/tap.sh"
command -v georef >/dev/null || {
    skip "georef is not built (it needs GeographicLib)"
    done_testing
}

# data FILE: the places of a stream alone
data() {
    grep -v '^[#>]' "$1"
}

# near NAME FILE FILE TOLERANCE …: columns 1, 2, … differ by the tolerances at most, no line is missing
near() {
    near_name=$1 near_a=$2 near_b=$3
    shift 3
    awk -v tolerances="$*" -v other="$near_b" '
        BEGIN { n = split(tolerances, most) }
        { if ((getline line < other) <= 0) { bad++; next }
          got = split(line, v)
          if (NF < n || got < n) bad++
          for (k = 1; k <= n; k++) {
              d = $k - v[k]
              if (d < 0) d = -d
              if (d != d || d > most[k]) bad++
              if (d > worst) worst = d
          } }
        END { if ((getline line < other) > 0) bad++
              if (bad || !NR) { print bad + 0, "differ by up to", worst, "in", NR; exit 1 } }' "$near_a" >near.log
    near_status=$?
    report $near_status "$near_name"
    [ $near_status -eq 0 ] || sed 's/^/# /' near.log
}

# --- UTM and UPS over the globe, zone by zone: against GeoConvert ---
if command -v GeoConvert >/dev/null; then
    : >got.utm; : >want.utm; : >got.deg; : >want.deg
    zone=1
    while [ $zone -le 60 ]; do
        for half in n s; do
            # a little beyond the borders of the zone, from the equator to where UTM ends
            awk -v zone=$zone -v half=$half 'BEGIN { for (i = 0; i < 24; i++) {
                u = (i * 0.618033988749 + zone * 0.377) % 1; v = (i + 0.5) / 24
                printf "%.9f %.9f %d\n", 6 * zone - 183 + (u - 0.5) * 8,
                    half == "n" ? 84 * v : -80 * v, i } }' >lonlat.xyz
            georef -z $zone$half lonlat.xyz >utm.hm
            data utm.hm >>got.utm
            awk '{ lon = $1; if (lon > 180) lon -= 360; if (lon < -180) lon += 360; printf "%s %.9f\n", $2, lon }' lonlat.xyz >latlon
            GeoConvert -u -p 9 -z $zone$half <latlon >oracle
            awk '{ print $2, $3, NR - 1 }' oracle >>want.utm
            georef -i utm.hm >deg.hm
            data deg.hm >>got.deg
            awk '{ print $2, $1, NR - 1 }' latlon >>want.deg
        done
        zone=$((zone + 1))
    done
    near "UTM, 60 zones, both hemispheres" got.utm want.utm 1e-6 1e-6 0
    near "and back" got.deg want.deg 1e-9 1e-9 0
    awk 'BEGIN { for (i = 0; i < 200; i++) printf "%.9f %.9f 0\n", (i * 137.50776 + 1) % 360 - 180, 83.5 + 6.5 * (i + 0.5) / 200 }' >north.xyz
    awk '{ print $1, -$2, 0 }' north.xyz >south.xyz
    for half in n s; do
        [ $half = n ] && in=north.xyz || in=south.xyz
        georef -z $half $in >ups.hm
        data ups.hm >got
        awk '{ print $2, $1 }' $in | GeoConvert -u -p 9 -z $half | awk '{ print $2, $3, 0 }' >want
        near "UPS $half" got want 1e-6 1e-6 0
        georef -i ups.hm >deg.hm
        data deg.hm >got
        # a longitude is good to 1e-9 degree on the ground, hence not at a pole
        awk '{ c = cos($2 * 3.14159265358979 / 180); print $1 * c, $2 }' got >got.ground
        awk '{ c = cos($2 * 3.14159265358979 / 180); print $1 * c, $2 }' $in >want.ground
        near "and back" got.ground want.ground 1e-9 1e-9
    done

    # the zone by the centre, and the place in it: borders, Norway, Svalbard, poles, the antimeridian
    : >got.one; : >want.one
    while read -r lon lat; do
        printf '%s %s 0\n' "$lon" "$lat" | georef >one.hm
        got=$(sed -n 's/^#crs U[TP][MS] \([0-9]*[NS]\) WGS84/\1/p' one.hm | tr NS ns)
        want=$(echo "$lat $lon" | GeoConvert -u -p 0 | sed 's/^0*//; s/ .*//')
        [ -n "$got" ] && [ "$got" = "$want" ]
        report $? "zone of $lon $lat: $want"
        data one.hm >>got.one
        echo "$lat $lon" | GeoConvert -u -p 9 | awk '{ print $2, $3 }' >>want.one
    done <<'END'
0 0
5.999999 10
6 10
179.999999 -0.000000001
180 45
-180 45
-179.999999 -45
2.999999 60
3 60
5.5 56
5.5 55.999999
5.5 64
8.999999 72
9 72
20.999999 78
21 78
33 83.999999
33 84
12 71.999999
41.999999 80
0 90
77 -90
10 -80
10 -80.000001
0 72
8.999999 78.2
9 78.2
15 78.2
20.999999 83.9
32.999999 78.2
33 78.2
5.3 60.4
11.999999 63.999999
2.9 58
END
    near "and the coordinates there" got.one want.one 1e-6 1e-6
    printf '32UNV1343802438 245.5 7\n32UNV13 1 8\n' >mgrs
    georef -m -z 32N mgrs >mgrs.hm
    data mgrs.hm >got
    printf '513438.5 5402438.5 245.5 7\n515000 5435000 1 8\n' >want
    near "MGRS: the middle of the square" got want 1e-6 1e-6 0 0
    georef -m -i mgrs >mgrs.hm
    data mgrs.hm | cut -d ' ' -f 1,2 >got
    cut -d ' ' -f 1 mgrs | GeoConvert -g -p 9 | awk '{ print $2, $1 }' >want
    near "MGRS to longitude and latitude" got want 1e-9 1e-9
    printf 'reference,z\nYZG1234567890,\nZAH5000050000,3\n' | georef -m - >mgrs.hm
    ok "MGRS of the pole, names above, a missing height" sh -c \
        'grep -q "#crs UPS N WGS84" mgrs.hm && grep -q "nan$" mgrs.hm && grep -q " 3$" mgrs.hm'
else
    skip "GeoConvert is not there (geographiclib-tools)"
fi

# --- transverse Mercator and east, north, up ---
awk 'BEGIN { for (i = 0; i < 400; i++) printf "%.9f %.9f %.3f\n",
    9.25 + 30 * ((i * 0.618033988749) % 1 - 0.5), 160 * (i + 0.5) / 400 - 80, i % 7 * 100 }' >wide.xyz
awk '{ print $2, $1 }' wide.xyz >latlon
if command -v TransverseMercatorProj >/dev/null; then
    georef -t tm -c 9.25,0 -k 0.9999 wide.xyz >tm.hm
    data tm.hm >got
    TransverseMercatorProj -l 9.25 -k 0.9999 -p 9 <latlon >want
    near "transverse Mercator" got want 1e-6 1e-6
    georef -i tm.hm >deg.hm
    data deg.hm >got
    near "and back, by its crs" got wide.xyz 1e-9 1e-9 0
    data tm.hm | georef -i -t tm -c 9.25,0 -k 0.9999 >deg.hm
    data deg.hm >got
    near "and back, by options" got wide.xyz 1e-9 1e-9 0
    georef -t tm -c 9.25,48 --shift 3500000,-20.5 wide.xyz >shifted.hm
    data shifted.hm >got
    y0=$(echo 48 9.25 | TransverseMercatorProj -l 9.25 -k 1 -p 9 | cut -d ' ' -f 2)
    TransverseMercatorProj -l 9.25 -k 1 -p 9 <latlon |
        awk -v y0="$y0" '{ printf "%.9f %.9f\n", $1 + 3500000, $2 - y0 - 20.5 }' >want
    near "with coordinates of the centre" got want 1e-6 1e-6
else
    skip "TransverseMercatorProj is not there (geographiclib-tools)"
fi
printf '9.25 48 0\n' | georef -t tm -c 9.25,48 --shift 1000,2000 >one.hm
data one.hm >got
echo "1000 2000 0" >want
near "the centre itself" got want 1e-9 1e-9 0
if command -v CartConvert >/dev/null; then
    # origins in the middle of a country, at the poles, on the antimeridian and on the equator
    while read -r lon lat h; do
        georef -t enu -c "$lon,$lat,$h" wide.xyz >enu.hm
        data enu.hm >got
        awk '{ print $2, $1, $3 }' wide.xyz | CartConvert -l "$lat" "$lon" "$h" -p 9 >want
        near "east, north, up at $lon $lat" got want 1e-6 1e-6 1e-6
        georef -i enu.hm >deg.hm
        data deg.hm >got
        near "and back" got wide.xyz 1e-9 1e-9 1e-6
    done <<'END'
9.25 48 310
12 90 0
-70 -90 2800
180 -17.5 5
-179.9999 66 -20
0 0 0
END
else
    skip "CartConvert is not there (geographiclib-tools)"
fi

# --- the kinds, their headers ---
cat >mesh.hm <<'END'
#hm 1 mesh text
#name main
#string inflow 0 3
#data
v 179.99 10 1 1 0
v 180.01 10 1 0 2
v 180.01 10.02 1 4 0
v 179.99 10.02 nan 0 0
q 0 1 2 3 6
#end 5
END
cat >lines.txt <<'END'
> surface=main side=left
179.99 10 0
-179.99 10.01 0
END
cat mesh.hm lines.txt >both.hm
georef -z 60N both.hm >utm.hm
ok "a mesh keeps flags, owners, regions, strings" sh -c \
    'grep -q "^q 0 1 2 3 6" utm.hm && grep -q "^#string inflow 0 3" utm.hm && grep -q "^v .* 1 0 2$" utm.hm'
ok "a missing height stays one" grep -q ' nan 0 0$' utm.hm
georef -b -z 60N both.hm | hmconv >binary.hm
same "binary and text hold the same" utm.hm binary.hm
georef -i utm.hm >back.hm
grep '^v' back.hm | awk '{ print $2, $3 }' >got
grep '^v' mesh.hm | awk '{ print $2, $3 }' >want
near "a mesh across the antimeridian stays in one piece" got want 1e-9 1e-9
ok "a line as well, with its attributes" sh -c \
    'grep -A 2 "^> surface=main side=left" back.hm | tail -n 1 | grep -q "^180.0"'
georef -z 1N back.hm >other.hm
georef -z 60N -b both.hm | georef -z 1N >direct.hm
grep '^v' other.hm | awk '{ print $2, $3 }' >got
grep '^v' direct.hm | awk '{ print $2, $3 }' >want
near "from zone to zone directly" got want 1e-6 1e-6
georef both.hm >auto.hm
ok "one zone for the whole stream" sh -c '[ $(grep -c "^#crs UTM [0-9]*N WGS84" auto.hm) -eq 2 ] &&
    [ $(grep "^#crs" auto.hm | sort -u | wc -l) -eq 1 ]'
for j in 1 2 5; do
    awk 'BEGIN { for (i = 0; i < 70000; i++) print 9 + i % 300 / 1e3, 48 + i / 1e6, i }' | georef -j $j >many.$j
done
same "any number of threads" many.1 many.2
same "any number of threads" many.1 many.5
awk 'BEGIN { for (i = 0; i < 70000; i++) print (i == 40000 ? 60 : i == 41000 ? 61 : 9), 8, i }' >far.xyz
for j in 1 2 5; do
    georef -z 32N -j $j far.xyz 2>far.$j >/dev/null
done
same "and the same place that is wrong" far.1 far.5
ok "the first of them" grep -q " at 60 8" far.2
awk 'BEGIN { for (i = 0; i < 400000; i++) print 9 + i % 300 / 1e3, 48 + i / 1e6, i }' | hmconv -b >large.hm
limit="ulimit -v 60000;" # which the sanitizers cannot run under
sh -c "$limit georef --version" >/dev/null 2>&1 || limit=
ok "points stream: there is no memory for all of them" sh -c \
    "$limit cat large.hm large.hm large.hm large.hm large.hm large.hm large.hm large.hm | georef -b -j 2 -z 32N >/dev/null"
ok "all are there" sh -c 'tail -n 1 many.1 | grep -q "^#end 70000$"'
printf '#hm 1 points text\n#fields x y z class\n#units degree degree m 1\n#crs EPSG:4326\n#data\n9 48 5 2\n#end\n' |
    georef -z 32 >class.hm
ok "units and further columns" sh -c 'grep -q "^#units m m m 1$" class.hm && grep -q " 5 2$" class.hm &&
    grep -q "^#crs UTM 32N WGS84" class.hm && grep -q "^#prog georef [0-9.]* -z 32$" class.hm'
printf '#hm 1 points text\n#crs EPSG:32732\n#data\n500000 5683785.5 5\n#end\n' | georef -i >epsg.hm
ok "EPSG codes of UTM are known" sh -c "grep -q '^9 -38\.9949348' epsg.hm"

# --- feet ---
printf '#hm 1 points text\n#units us-ft us-ft ft\n#crs EPSG:2225\n#data\n3937 39.37 10\n#end\n' >feet.hm
georef -t same feet.hm >metres.hm
ok "feet to metres" grep -qx '1200 12 3.048' metres.hm
ok "units and crs say so" sh -c 'grep -q "^#units m m m" metres.hm && grep -q "^#crs EPSG:2225, x y in m" metres.hm'
printf '1200 12 3.048\n' | georef -t same -u us-ft/ft >back.hm
printf '3937 39.37 10\n' >want
data back.hm >got
same "and back" want got
printf '9 48 100\n' | georef -f m/ft -z 32N -u ft/m >mixed.hm
data mixed.hm | awk '{ print $3 }' >got
echo 30.48 >want
same "heights apart from x y" want got
must_fail "a unit that is none" 2 "not m, ft or us-ft" georef -u yard feet.hm

# --- heights over a geoid ---
# 10 degrees, one byte pair a node: N = 0.5 (k mod 7) - 2
awk 'function byte(v) { printf "\\%03o", v }
    BEGIN { for (k = 0; k < 36 * 19; k++) { byte(0); byte(k % 7) } }' >octal
{ printf 'P5\n# Description a test\n# DateTime 2020-01-01 00:00:00\n# Offset -2\n# Scale 0.5\n# Origin 90N 0E\n# AREA_OR_POINT Point\n# Vertical_Datum WGS84\n36 19\n65535\n'
  # shellcheck disable=SC2059
  printf "$(cat octal)"; } >test.pgm 2>/dev/null
awk 'BEGIN { for (i = 0; i < 100; i++) printf "%.6f %.6f %d\n", (i * 137.5) % 360 - 180, 170 * (i + 0.5) / 100 - 85, i }' >where.xyz
georef -t same -g ./test.pgm where.xyz >over.hm
if command -v GeoidEval >/dev/null; then
    data over.hm >got
    awk '{ print $2, $1 }' where.xyz | GeoidEval -n test -d . >heights
    paste -d ' ' where.xyz heights | awk '{ print $1, $2, $3 - $4 }' >want
    near "heights over the geoid, as GeoidEval has them" got want 0 0 1e-4
else
    skip "GeoidEval is not there (geographiclib-tools)"
fi
ok "the header says so" grep -qx '#geoid test.pgm' over.hm
must_fail "not twice" 2 "stand on the geoid" georef -t same -g test.pgm over.hm
georef -i -t same -g test.pgm over.hm >back.hm
data back.hm >got
near "and back over the ellipsoid" got where.xyz 0 0 1e-9
ok "without the key" sh -c '! grep -q "^#geoid" back.hm'
awk 'BEGIN { for (i = 0; i < 50; i++) print 9 + i / 100, 48 + i / 50, 100 }' >small.xyz
georef -z 32N -g test.pgm small.xyz >a.hm
georef -z 32N small.xyz | georef -t same -g test.pgm >b.hm
data a.hm >got
data b.hm >want
near "the same with x y in metres" got want 0 0 1e-9
must_fail "a geoid that is not there" 2 "nowhere" georef -t same -g nowhere.pgm small.xyz

# --- what is refused ---
printf '#hm 1 points text\n#crs longitude latitude WGS84\n#data\n9 48 1\n9.1 48 1\n9 48.1 1\n#end\n' >degrees.hm
printf '#hm 1 grid text\n#size 2 2\n#origin 9 48\n#step 1 1\n#fields x y z slope\n#crs EPSG:4326\n#data\n9 48 1 0\n10 48 1 0\n9 49 1 0\n10 49 1 0\n#end\n' >slope.hm
printf '#hm 1 mesh text\n#crs EPSG:4326\n#data\nv 9 48 1 0 0\nv 9.1 48 1 0 0\nv 9 48.1 1 0 0\nt 0 1 2 0\n#end\n' >degmesh.hm
# the shapes of their commands, each with an input in degrees
while read -r command; do
    must_fail "${command%% *} refuses degrees and names georef" 2 "longitude and latitude.*georef" sh -c "$command"
done <<'END'
bsgrid -d 1 degrees.hm
slope slope.hm
breaklines -s 5 slope.hm
bsmesh -c 1/1 -e 1/1 degrees.hm
trimesh -l 1 degrees.hm
stitch degmesh.hm
quality degmesh.hm degrees.hm
END
must_fail "by the names of columns as well" 2 "georef" \
    sh -c 'printf "lon,lat,z\n9,48,1\n9.1,48,1\n9,48.1,1\n" | bsgrid -d 1'
printf '#hm 1 grid text\n#size 2 2\n#origin 9 48\n#step 1 1\n#data\n9 48 1\n10 48 1\n9 49 1\n10 49 1\n#end\n' >grid.hm
must_fail "a grid, with the way around" 2 "grid.hm: .*hmconv -t xyz grid.hm | georef" georef grid.hm
ok "nothing that looks whole" sh -c '! grep -q "^#end" tap.out'
ok "which works" sh -c 'hmconv -t xyz grid.hm | georef -z 32N | bsgrid -d 50000 >/dev/null'
printf '545000 5972000 1\n' >metres.xyz
must_fail "metres for degrees" 2 "metres.xyz: 5.972e.06 is no latitude at 545000 5972000" georef metres.xyz
must_fail "with a zone as well" 2 "no latitude" georef -z 32N metres.xyz
must_fail "back from nowhere" 2 "no crs is said" georef -i metres.xyz
must_fail "half a zone" 2 "hemisphere" georef -i -z 32 metres.xyz
must_fail "a zone that is none" 2 "not a zone" georef -z 61N metres.xyz
must_fail "too far from the meridian" 2 "35 degrees.* at 60 10" \
    sh -c 'printf "9 10 1\n60 10 1\n" | georef -z 32N'
must_fail "UPS beyond the equator" 2 "other side" sh -c 'printf "9 -1 1\n" | georef -z N'
must_fail "no zone of metres" 2 "central meridian" sh -c 'printf "1e9 5 1\n" | georef -i -z 32N'
must_fail "ENU without heights" 2 "needs heights" sh -c 'printf "9 48\n" | georef -t enu -c 9,48'
must_fail "a crs of others" 2 'crs "EPSG:31467"' \
    sh -c 'printf "#hm 1 points text\n#crs EPSG:31467\n#data\n1 2 3\n#end\n" | georef'
must_fail "no centre" 2 "needs --centre" georef -t tm metres.xyz
must_fail "half a centre" 2 "2 numbers" georef -t tm -c 9 metres.xyz
must_fail "a centre beyond the pole" 2 "no longitude and latitude" georef -t tm -c 9,91 metres.xyz
must_fail "no MGRS" 2 "mgrs:2: " sh -c 'printf "32UNV1343802438 1\n99XYZ 2\n" >mgrs; georef -m mgrs'
must_fail "a word for a height" 2 "mgrs:1: expected a number" sh -c 'printf "32UNV13 high\n" >mgrs; georef -m mgrs'
: >empty
for from in m us-ft; do
    echo 9 48 1e308 >high.xyz
    must_fail "a height that no double holds, $from" 2 "beyond all doubles at" georef -z 32 -f $from -u ft high.xyz
done
{ echo "#hm 1 points text"; echo "#units m ft m"; echo "#data"; echo "1 2 3"; echo "#end"; } >mixed.hm
must_fail "x and y in different units" 2 "x is in m, y in ft" georef -t same mixed.hm
must_fail "an empty file" 2 "empty" georef empty
must_fail "an empty file of references" 2 "empty" georef -m empty
head -n 6 utm.hm >cut.hm
must_fail "a stream cut off" 2 "cut.hm" georef -i cut.hm
must_fail "a full disk" 2 "space|full" sh -c "georef -z 32N small.xyz >/dev/full"
must_fail "different systems" 2 "differ in their crs" georef -z 32N a.hm epsg.hm
done_testing
