#!/bin/sh
# stitch: channels that cross, join, touch and miss each other; meshes joined node by node.
. "${0%/*}/tap.sh"

. "$TESTS/channels.sh"

# joined NAME RESULT HIGHER LOWER [HOLES [PIECES]]: sound; new nodes only inside; the higher mesh whole
joined() {
    ok "$1: sound" sound "$2" "${5:-0}" "${6:-1}"
    ok "$1: new nodes only inside" new_inside "$2" "$3" "$4"
    elements "$2" >got.elements
    elements "$3" >higher.elements
    ok "$1: the higher mesh is whole" sh -c '! comm -13 got.elements higher.elements | grep .'
}

channel main 0 0 300 0 40 10 4 >main.hm

# --- aligned with the nodes of the main channel: the union is covered exactly ---
channel trib 150 170 150 0 20 10 4 >t.hm
stitch main.hm t.hm >out.hm 2>said
joined "T junction" out.hm main.hm t.hm
true_that "T junction: area" "($(area out.hm) - 15000) ^ 2 < (1e-9 * 15000) ^ 2"
ok "T junction: says what was cut" grep -Eq '^stitch: trib: [0-9]+ elements cut away \([0-9]+ overlap' said
channel cross 150 170 150 -170 20 10 4 >x.hm
stitch main.hm x.hm >out.hm 2>/dev/null
joined "X crossing" out.hm main.hm x.hm
true_that "X crossing: area" "($(area out.hm) - 18000) ^ 2 < (1e-9 * 18000) ^ 2"
channel inside 100 0 200 0 20 10 4 >inside.hm
stitch main.hm inside.hm >out.hm 2>said
joined "wholly inside" out.hm main.hm inside.hm
ok "wholly inside: says that nothing remains" grep -q 'nothing of it remains' said
stitch inside.hm main.hm >out.hm 2>said
joined "around the higher mesh" out.hm inside.hm main.hm
true_that "around the higher mesh: area" "($(area out.hm) - 12000) ^ 2 < (1e-9 * 12000) ^ 2"
channel touch 150 170 150 20 20 10 7 >touch.hm
stitch main.hm touch.hm >out.hm 2>/dev/null
joined "touching only" out.hm main.hm touch.hm
true_that "touching only: area" "($(area out.hm) - 15000) ^ 2 < (1e-9 * 15000) ^ 2"

# --- not aligned: within the union, and little is lost at the corners of the mouth ---
channel trib 151.3 170 151.3 0 20 8 3 quads >t.hm
stitch main.hm t.hm >out.hm 2>/dev/null
joined "quadrilaterals, not aligned" out.hm main.hm t.hm
true_that "not aligned: area" "$(area out.hm) <= 15000 + 1e-6 && $(area out.hm) > 14900"
channel sharp 20 150 200 5 20 8 3 >sharp.hm
stitch main.hm sharp.hm >out.hm 2>/dev/null
joined "a sharp angle" out.hm main.hm sharp.hm
channel beside 100 25 260 35 20 8 3 >beside.hm
stitch main.hm beside.hm >out.hm 2>/dev/null
joined "overlapping lengthwise at 4 degrees" out.hm main.hm beside.hm
channel narrow 151 150 151 0 5 3 2.5 >narrow.hm
stitch main.hm narrow.hm >out.hm 2>said
joined "narrower than an edge" out.hm main.hm narrow.hm
ok "narrower than an edge: says so" grep -q '1 mouth narrower' said
channel big -50 3 400 3 150 11 7 quads >big.hm
stitch main.hm big.hm >out.hm 2>/dev/null
joined "inside a wider mesh" out.hm main.hm big.hm
true_that "inside a wider mesh: area" "($(area out.hm) - 67500) ^ 2 < (1e-9 * 67500) ^ 2"
for angle in 30 50 75 100 125 150; do
    set -- $(awk -v a=$angle 'BEGIN { r = a * atan2(0, -1) / 180
        print 147 + 160 * cos(r), 160 * sin(r), 147 - 9 * cos(r), -9 * sin(r) }')
    channel turned "$@" 23 7 3.1 >turned.hm
    stitch main.hm turned.hm >out.hm 2>/dev/null
    joined "turned by $angle degrees" out.hm main.hm turned.hm
    stitch -w 0 main.hm turned.hm >out.hm 2>/dev/null
    joined "turned by $angle degrees, without buffer" out.hm main.hm turned.hm
done

# --- the triangles of the seam, at many angles and places ---
cp /dev/null seams
for angle in 28 35 43 52 61 70 78 87 96 105 113 122 131 140 149; do
    set -- $(awk -v a=$angle 'BEGIN { r = a * atan2(0, -1) / 180; x = 143 + a * 7 % 10; c = cos(r) / sin(r)
        print x + 150 * c, 150, x - 10 * c, -10, 12 + a * 5 % 17, 4 + a % 5, 2 + a % 3 }')
    channel seam "$@" >seam.hm
    stitch main.hm seam.hm >out.hm 2>/dev/null
    angles out.hm main.hm seam.hm >>seams
    area out.hm | awk -v angle=$angle -v width="$5" '{ r = angle * atan2(0, -1) / 180
        print $1 - 12000 - width * 130 / sin(r) }' >>areas
done
true_that "seams: $(awk '{ n += $1; poor += $3 } END { print poor " of " n " triangles under 15 degrees" }' seams)" \
    "$(awk '{ n += $1; poor += $3 } END { print (n > 200) * 100 * poor / n }' seams) <= 1"
true_that "no needles: $(awk 'NR == 1 || $2 < least { least = $2 } END { print least }' seams)" \
    "$(awk 'NR == 1 || $2 < least { least = $2 } END { print least }' seams) > 15"

true_that "the area of the union, but for the bends where the banks meet: $(sort -g areas | sed -n '1p;$p' | tr '\n' ' ')" \
    "$(awk '$1 ^ 2 > 25 ^ 2 { bad = 1 } END { print bad + 0 }' areas) == 0"

# A bank or an end section that stops a hand's breadth from the higher border would leave a needle.
for end in "149.6 20.5 18" "149.6 20.5 16" "153 19.65 16"; do
    channel corner 132 150 $end 8 2.6 >corner.hm
    stitch main.hm corner.hm >out.hm 2>said
    angles out.hm main.hm corner.hm >corner
    joined "a corner at $end" out.hm main.hm corner.hm
    true_that "its smallest angle $(cut -d' ' -f2 corner)" "$(cut -d' ' -f2 corner) > 15"
done
channel acute -20 60 160 10 12 7 3 >acute.hm
stitch main.hm acute.hm >out.hm 2>said
angles out.hm main.hm acute.hm >acute
true_that "poor triangles are listed: $(grep -c 'degrees at' said) of $(cut -d' ' -f3 acute)" \
    "$(grep -c 'degrees at' said) == $(cut -d' ' -f3 acute) && $(cut -d' ' -f3 acute) > 0"

# --- two meshes of one river, end to end: their banks lie on each other, but for centimetres ---
cp /dev/null ends
for end in "245 0 495 1 40" "234.6 .187 484.6 -.241 40" "222.7 -.024 472.7 -.168 40" "247.5 0 497.5 .86 40.02" \
    "267.8 .94 517.8 -6.5 40.06" "255 0 500 0 40" "231 -.4 481 .5 39.4"; do
    channel on $end 7.9 3.3 >on.hm
    stitch main.hm on.hm >out.hm 2>/dev/null
    joined "end to end, $end" out.hm main.hm on.hm
    angles out.hm main.hm on.hm >>ends
done
true_that "end to end: $(awk '{ n += $1; poor += $3 } END { print poor " of " n " triangles under 15 degrees" }' ends)" \
    "$(awk '{ n += $1; poor += $3 } END { print (n > 100) * 100 * poor / n }' ends) <= 1"

# --- an island inside ---
island main.hm 180 220 -9 9 >ring.hm
channel up 260 170 235 5 25 8 3 >up.hm
stitch ring.hm up.hm >out.hm 2>/dev/null
joined "a tributary beside an island" out.hm ring.hm up.hm 1
channel into 200 170 200 4 25 8 3 >into.hm
stitch ring.hm into.hm >out.hm 2>/dev/null
joined "a tributary into an island" out.hm ring.hm into.hm 1
stitch into.hm ring.hm >out.hm 2>/dev/null
joined "an island of the lower mesh" out.hm into.hm ring.hm 1
channel pond 190 0 210 0 10 5 3 >pond.hm
stitch -c ring.hm pond.hm >out.hm 2>/dev/null
joined "a mesh within the island" out.hm ring.hm pond.hm 1 2
channel cover 170 0 230 0 30 7 4 >cover.hm
stitch ring.hm cover.hm >out.hm 2>/dev/null
joined "a mesh that covers the island" out.hm ring.hm cover.hm

# --- more than two ---
channel north 100 150 100 0 20 8 4 >north.hm
channel south 107 -150 107 0 20 8 4 >south.hm
stitch main.hm north.hm south.hm >out.hm 2>/dev/null
cat north.hm south.hm >both.hm
joined "two that enter opposite each other" out.hm main.hm both.hm
ok "owners are numbered in order" grep -q '^#owners main north south$' out.hm
true_that "owners: $(awk '/^v/ { n[$6]++ } END { print n[0] + 0, (n[1] > 0) (n[2] > 0) (n[3] > 0) }' out.hm)" \
    "\"$(awk '/^v/ { n[$6]++ } END { print n[0] + 0, (n[1] > 0) (n[2] > 0) (n[3] > 0) }' out.hm)\" == \"0 111\""
channel third 60 160 150 15 25 6 3 >third.hm
stitch main.hm north.hm third.hm >out.hm 2>/dev/null
cat north.hm third.hm >both.hm
joined "three that meet, with an island between" out.hm main.hm both.hm 1
cat main.hm north.hm third.hm | stitch >piped.hm 2>/dev/null
same "objects of one stream, as files" out.hm piped.hm
for j in 1 2; do stitch -j $j main.hm north.hm third.hm 2>/dev/null >threads.hm && same "the same bytes, -j $j" out.hm threads.hm; done
true_that "role: $(grep '^#role' out.hm)" "\"$(grep '^#role' out.hm)\" == \"#role regular\""
channel ring 60 60 240 60 20 8 4 >bridge.hm
channel back 220 100 220 0 20 8 4 >back.hm
cat north.hm bridge.hm back.hm >three.hm
stitch main.hm three.hm >out.hm 2>/dev/null
joined "four around an island" out.hm main.hm three.hm 1

# --- apart ---
channel apart 150 170 150 60 20 10 4 >apart.hm
must_fail "meshes that do not meet are refused" 2 'piece apart.*at 1[45]|components' stitch main.hm apart.hm
stitch -c main.hm apart.hm >out.hm 2>/dev/null
joined "unless that is allowed" out.hm main.hm apart.hm 0 2
channel parallel 0 32 300 32 20 8 4 >parallel.hm
stitch -c main.hm parallel.hm >out.hm 2>said
true_that "a channel 2 m beside is left alone: $(area out.hm)" "($(area out.hm) - 18000) ^ 2 < 1e-9"

# --- buffer and terrain ---
stitch -w 25 main.hm x.hm >wide.hm 2>/dev/null
joined "a wide buffer" wide.hm main.hm x.hm
true_that "a wide buffer: area" "($(area wide.hm) - 18000) ^ 2 < (1e-9 * 18000) ^ 2"
printf '%s\n' '-500 -500 99' '-500 500 99' '500 500 99' '500 -500 99' >flat.xyz
stitch -w 25 main.hm x.hm flat.xyz >out.hm 2>/dev/null
grep -v '^#' wide.hm >a
grep -v '^#' out.hm >b
same "measurements too far apart tell nothing" a b
stitch -w 25 -g 2000 main.hm x.hm flat.xyz >out.hm 2>/dev/null
true_that "the terrain gives the inside of the gap its height: $(grep -c '^v .* 99 0 2$' out.hm) nodes" \
    "$(grep -c '^v .* 99 0 2$' out.hm) > 2 && $(grep -c '^v .* 99 1' out.hm) == 0"

# --- given up where the surface misses the terrain: a groyne from the bank to the middle ---
awk 'BEGIN { for (y = -40; y <= 40; y += 4) for (x = -20; x <= 320; x += 4)
    printf "%g %g %.17g\n", x, y, 0.01 * x - 0.02 * y + 5 + (x >= 144 && x <= 156 && y < 0) * 2 }' >groyne.xyz
ok "a groyne in the bed" stitch -m .2 -o m.hm main.hm groyne.xyz
given=$(sed -n 's/^stitch: \([0-9]*\) of 600 elements given up.*/\1/p' tap.err)
true_that "elements given up are said and gone: $given" "$given > 30 && $given < 200 && $(grep -c '^t' m.hm) == 600 - $given"
true_that "no node on the groyne" "$(awk '/^v/ && $2 > 142 && $2 < 158 && $3 < 0' m.hm | wc -l) == 0"
true_that "the other side stays" "$(awk '/^v/ && $2 > 145 && $2 < 155 && $3 > 15' m.hm | wc -l) == 2"
true_that "far from it nothing goes" "$(awk '/^v/ && ($2 < 105 || $2 > 195)' m.hm | wc -l) == 22 * 11"
ok "sound" sound m.hm
ok "and the irregular mesh fills the hole" sh -c 'trimesh -m terrain -N 400 -l 2 groyne.xyz m.hm >flood.hm 2>/dev/null &&
    stitch m.hm flood.hm >whole.hm 2>/dev/null && quality --check valid whole.hm groyne.xyz >report'
ok "quadrilaterals, and a tributary" sh -c 'stitch -c -m .2 main.hm t.hm groyne.xyz >q.hm 2>/dev/null'
sed 's/^#role/#string inflow 0 31 62\n#role/' main.hm >named.hm
stitch -m .2 named.hm groyne.xyz 2>/dev/null >m.hm
true_that "strings keep their nodes" "\"$(awk '/^#string inflow/ { split($0, s) } /^v/ { p[n++ + 0] = $2 "," $3 } END { print p[s[3]], p[s[4]], p[s[5]] }' m.hm)\" == \"0,-20 0,-16 0,-12\""
awk '!/^#/ { print $1, $2, .01 * $1 - .02 * $2 + 5 }' groyne.xyz >smooth.xyz
stitch -m .05 main.hm smooth.xyz 2>/dev/null | grep '^[vt]' >a
stitch main.hm 2>/dev/null | grep '^[vt]' >b
same "without misfit nothing changes" a b
must_fail "a misfit to nothing" 2 'misfit needs the terrain' stitch -m .2 main.hm
must_fail "nothing left" 2 'no elements' sh -c "awk '{ print \$1, \$2, \$3 + 3 * (NR % 2) }' groyne.xyz | stitch -m .01 main.hm -"

# --- by common nodes ---
channel left 0 0 50 0 20 10 4 triangles irregular | sed 's/^#name .*/#name flood/; s/^\(v .*\) 0 0$/\1 2 0/' >left.hm
channel right 50 0 100 0 20 10 4 | awk '/^v/ { $4 += 1 } { print }' >right.hm
stitch left.hm right.hm >out.hm 2>said
ok "side by side: sound" sound out.hm
true_that "side by side: nodes and area $(grep -c ^v out.hm) $(area out.hm)" \
    "$(grep -c ^v out.hm) == 66 && $(area out.hm) == 2000"
ok "side by side: hybrid" grep -q '^#role hybrid' out.hm
true_that "heights come from the regular mesh: $(grep -c '^v 50 .* [67][.0-9]* ' out.hm)" \
    "$(awk '/^v 50 / && $4 > 5.99 { n++ } END { print n + 0 }' out.hm) >= 5"
true_that "shared nodes keep the flags of both and are inside" \
    "$(awk '/^v 50 / && ($3 > -10 && $3 < 10) && $5 % 2 == 0 && $6 == 1 { n++ } END { print n + 0 }' out.hm) == 4"
channel right 50 0 100 0 20 10 4 >right.hm
channel left 0 0 50 0 20 10 4 >left.hm
stitch left.hm right.hm >out.hm 2>said
true_that "regular meshes beside each other keep all elements: $(grep -c ^t out.hm)" "$(grep -c ^t out.hm) == 100"

# --- foreign meshes ---
foreign() { # a mesh in .2dm, moved by X in x
    awk -v move="$2" 'BEGIN { print "MESH2D" } /^v/ { printf "ND %d %.2f %.2f %.2f\n", ++n, $2 + move, $3, $4 }
        /^t/ { printf "E3T %d %d %d %d 1\n", ++e, $2 + 1, $3 + 1, $4 + 1 }' "$1"
}
channel slanted 13.1117 0 48.7771 33.3333 20 7 4 >slanted.hm
channel onward 48.7771 33.3333 84.4425 66.6666 20 7 4 >onward.hm
foreign onward.hm 0.003 >onward.2dm
stitch slanted.hm onward.2dm >out.hm 2>said
ok "a foreign mesh is matched within a tolerance" sound out.hm
ok "which is said" grep -Eq '[456] of them matched within 0.01 m, the furthest 0.0' said
must_fail "not with --tolerance 0" 2 'hang|overlap|apart|touch' stitch -T 0 slanted.hm onward.2dm
must_fail "--strict makes it exit 1" 1 'matched' stitch --strict slanted.hm onward.2dm
ok "a 2dm alone is checked and written" sh -c 'stitch onward.2dm >alone.hm 2>/dev/null && [ $(grep -c ^t alone.hm) -gt 20 ]'

# --- renumbering ---
awk 'BEGIN { srand(3) } /^v/ { print rand(), $0 }' main.hm | sort -n | awk '{ $1 = ""; print substr($0, 2) }' >shuffled
awk 'NR == FNR { new[$2, $3] = n++; line[n - 1] = $0; next } /^v/ { if (!done) for (i = 0; i < n; i++) print line[i]
        done = 1; number[k++ + 0] = new[$2, $3]; next }
    /^t/ { print "t", number[$2], number[$3], number[$4], $5; next } { print }' shuffled main.hm >mixed.hm
stitch -r mixed.hm >out.hm 2>said
elements mixed.hm >a && elements out.hm >b
same "renumbering keeps the elements" a b
nodes mixed.hm >a && nodes out.hm >b
same "and the nodes" a b
ok "bandwidth before and after is said: $(cat said)" awk '/bandwidth/ { exit !($3 + 0 <= 24 && $5 > 100) }' said

# --- strings and materials ---

# lines BODY: a stream of lines; string NAME FILE: the places of the nodes of a string
lines() { printf '#hm 1 lines text\n#data\n%s\n#end\n' "$1"; }
string() {
    awk -v name="$1" '/^v/ { p[n++ + 0] = $2 "," $3 } $1 == "#string" && $2 == name { k = split($0, node) }
        END { for (i = 3; i <= k; i++) printf "%s%s", (i > 3 ? " " : ""), p[node[i]] }' "$2"
}
# runs NAME STRING PLACES [FILE]: the string has nodes at just these places
runs() {
    [ "$(string "$2" "${4:-out.hm}")" = "$3" ]
    report $? "$1: $(string "$2" "${4:-out.hm}")"
}
channel s 0 0 40 0 12 10 4 >s.hm
channel onto 40 0 80 0 12 10 4 >onto.hm
down='0,6 0,2 0,-2 0,-6'
lines '> string=inflow
0.5 7 0
-0.5 -6.5 0
> string=around
11 -6 0
0 -6 0
0 1.5 0
> string=outflow
40 6 0
40 -6 0' >strings.txt
stitch s.hm strings.txt >out.hm 2>said
runs "a string is the boundary nearest to a line, in its direction" inflow "$down"
runs "around a corner" around "10,-6 0,-6 0,-2 0,2"
ok "how many edges is said" grep -q 'string inflow: 3 edges' said
stitch -r out.hm >turned.hm 2>/dev/null
runs "strings are renumbered with the nodes" inflow "$down" turned.hm
stitch onto.hm out.hm >two.hm 2>said
runs "and when their mesh is joined to another" inflow "$down" two.hm
ok "one that is inside then is dropped, aloud" grep -q "1 string that no longer.*'outflow'" said
true_that "and only that" "$(grep -c '^#string' two.hm) == 2 && $(grep -c outflow two.hm) == 0"
must_fail "--strict makes it exit 1" 1 "outflow" stitch --strict onto.hm out.hm
lines '> string=inflow
0 -6 0
0 6 0' >again.txt
stitch two.hm again.txt >three.hm 2>/dev/null
runs "a line replaces the string of its name" inflow "0,-6 0,-2 0,2 0,6" three.hm
true_that "there is one of it" "$(grep -c '^#string inflow' three.hm) == 1"
ok "2dm has them" sh -c 'hmconv -t 2dm three.hm | grep -q "^NS .* inflow$"'
hmconv -t 2dm three.hm 2>/dev/null >three.2dm
stitch three.2dm 2>/dev/null >three.hm
runs "and gives them back" inflow "0,-6 0,-2 0,2 0,6" three.hm
awk '/^[tq]/ { x = 0; for (i = 2; i < 5; i++) x += p[$i] / 3; if (x > 10 && x < 30 && y[$2] > -3 && y[$2] < 3 && y[$3] > -3 && y[$3] < 3 && y[$4] > -3 && y[$4] < 3) next }
    /^v/ { p[n + 0] = $2; y[n++] = $3 } { print }' s.hm >ring.hm
lines '> string=island
11 2.2 0
29 1.8 0' >island.txt
stitch ring.hm island.txt >out.hm 2>/dev/null
runs "along an island" island "10,2 20,2 30,2"
refuse() { # NAME PATTERN LINES
    lines "$3" >bad.txt
    must_fail "$1" 2 "$2" stitch s.hm bad.txt
}
refuse "a string across the mesh" 'string=mid does not run along the boundary.* 20 m apart.* at ' '> string=mid
20 6 0
20 -6 0'
refuse "one beside it" 'string=far does not run along.* 15 m apart.* at ' '> string=far
-15 6 0
-15 -6 0'
lines '> string=far tolerance=16
-15 6 0
-15 -6 0' >far.txt
stitch s.hm far.txt >out.hm 2>/dev/null
runs "unless its tolerance= allows it" far "$down"
refuse "an inflow of one edge" 'string=inflow_2 is 1 edge .*needs 2 at 0 6' '> string=inflow_2
0 6 0
0 2 0'
refuse "a string without an edge" 'string=x is 0 edges' '> string=x
0 6 0
0 5.5 0'
refuse "a closed string" 'string=x is closed' '> string=x closed=1
0 6 0
0 2 0
5 2 0'
refuse "a string of one point" 'string=x is only one point' '> string=x
0 6 0'
refuse "a string without name" 'name of a string' '> string=""
0 6 0
0 -6 0'
refuse "a tolerance that is none" 'tolerance=wide.* at [0-9-]' '> string=x tolerance=wide
0 6 0
0 -6 0'
sed 's/^#role/#string broken 1 x\n#role/' s.hm >broken.hm
must_fail "a string that is no list of nodes" 2 'string broken: expected numbers' stitch broken.hm

lines '> region=7 closed=1
-1 -10 0
20 -10 0
20 10 0
-1 10 0
> region=9
10 -10 0
15 -10 0
15 10 0
10 10 0
10 -10 0' >regions.txt
stitch s.hm regions.txt >out.hm 2>said
true_that "materials by closed lines, the last one wins" "\"$(awk '/^t/ { n[$5]++ } END { print n[7], n[9], n[0] }' out.hm)\" == \"9 3 12\""
ok "how many elements is said" grep -q 'region 9: given to 3 elements' said
refuse "an open region" 'region=2 is not closed.* at 0 0' '> region=2
0 0 0
9 0 0
9 9 0'
refuse "a region of two points" 'region=2 has only 2 points' '> region=2 closed=1
0 0 0
9 0 0'
refuse "a region that crosses itself" 'region=2 crosses itself' '> region=2 closed=1
0 0 0
9 9 0
9 0 0
0 9 0'
refuse "a region that is a word" 'region=reeds.* at 0 0' '> region=reeds closed=1
0 0 0
9 0 0
9 9 0'
refuse "a region that is no whole number" 'region=1.5 is not a material' '> region=1.5 closed=1
0 0 0
9 0 0
9 9 0'

# --- what is checked, and bad input ---
sed 's/^t 0 1 31 0/t 1 0 31 0/' main.hm >clockwise.hm
must_fail "a clockwise element is refused, with its place" 2 'area.*at|twice.*at' stitch clockwise.hm
awk '{ print } /^#data/ { print "v 1000 1000 0 0 0" } ' main.hm | awk '/^[tq]/ { for (i = 2; i < NF; i++) $i++ } { print }' >isolated.hm
ok "a node without element is left out" sh -c 'stitch isolated.hm 2>said | grep -c ^v >n && [ $(cat n) = 341 ] && grep -q "1 nodes without an element" said'
printf '#hm 1 mesh text\n#name bad\n#role regular\n#data\nv 0 0 0 1 1\nv 10 0 0 1 1\nv 0 10 0 1 1\nt 0 1 2 1\nt 2 1 0 1\n#end\n' >bad.hm
must_fail "it is said which mesh is at fault, and where" 2 'mesh 2 of 2 \(bad\): .*area.* at [0-9]' stitch -c main.hm bad.hm
must_fail "also when it is the same twice" 2 'mesh 1 of 2 \(bad\)' stitch -c bad.hm bad.hm
sed '0,/^v 0 -20 [^ ]* /s//v 0 -20 nan /' main.hm >nan.hm
must_fail "a missing height is refused" 2 'height.* at 0 -20' stitch nan.hm
channel over 10 5 200 5 20 9 4 triangles irregular >over.hm
must_fail "an irregular mesh that overlaps is refused" 2 'overlap.* at ' stitch main.hm over.hm
must_fail "a negative buffer" 2 'buffer' stitch -w -1 main.hm
must_fail "a negative tolerance" 2 'tolerance' stitch -T -1 main.hm
must_fail "a name with a line break" 2 'name.*control' stitch -N "$(printf 'a\n#end')" main.hm
must_fail "an empty name" 2 'name is not empty' stitch -N '' main.hm
must_fail "no mesh" 2 'mesh' stitch flat.xyz
sed '$d' main.hm >cut.hm
must_fail "a mesh without its end" 2 'cut.hm.*end' stitch t.hm cut.hm
printf '#hm 1 mesh text\n#data\n#end\n' >empty.hm
must_fail "a mesh of nothing" 2 'no elements' stitch empty.hm
must_fail "a full disk" 2 'space|full' sh -c 'stitch main.hm t.hm >/dev/full'
done_testing
