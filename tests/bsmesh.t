#!/bin/sh
# bsmesh on channels of known shape: where the nodes lie, what is refused.
. "${0%/*}/tap.sh"

# lines BODY: a stream of lines
lines() {
    printf '#hm 1 lines text\n#data\n%s\n#end\n' "$1"
}

# plane W E S N: measurements every 10 m on z = 0.01 x - 0.02 y + 5
plane() {
    awk -v w="$1" -v e="$2" -v s="$3" -v n="$4" 'BEGIN {
        for (y = s; y <= n; y += 10)
            for (x = w; x <= e; x += 10)
                printf "%g %g %.17g\n", x, y, 0.01 * x - 0.02 * y + 5 }'
}

# nodes FILE: x y z flags owner of every node; elements FILE: shape and corners
nodes() { awk '/^v/ { print $2, $3, $4, $5, $6 }' "$1"; }

# most FILE EXPRESSION: the largest value of the awk expression in $1 .. $5 over all nodes
most() { nodes "$1" | awk "{ e = $2; if (NR == 1 || e > m) m = e } END { printf \"%.12g\", m }"; }

# area FILE: of all elements, and the least of one
area() {
    awk '/^#hm/ { n = 0 }
        /^v/ { x[n] = $2; y[n++] = $3 }
        /^[tq]/ { m = /^t/ ? 3 : 4; a = 0
            for (i = 0; i < m; i++) { p = $(2 + i); q = $(2 + (i + 1) % m); a += x[p] * y[q] - x[q] * y[p] }
            s += a / 2; if (!k++ || a / 2 < least) least = a / 2 }
        END { printf "%.12g %.12g", s, least }' "$1"
}

# --- a straight channel on a plane ---

plane -40 340 -40 80 >plane.xyz
rough='> surface=main side=left
1 41 0
150 39 0
299 40.5 0
> surface=main side=right
300 1 0
120 -1 0
0 0.5 0'
banks='> limit=5
-20 44 1
320 44 1
> limit=5
-20 -3 1
320 -3 1'
lines "$rough" >rough.txt
lines "$rough
$banks" >lines.txt

ok "a straight channel" bsmesh -o m.hm -c 10/8 -e 10/4 lines.txt plane.xyz
true_that "all moved" "$(grep -c '60 of 62 control points on the banks moved\|62 of 62' tap.err) == 1"
true_that "on the plane" "$(most m.hm '($3-0.01*$1+0.02*$2-5)^2') < 1e-18"
true_that "up to the left breakline" "$(most m.hm '$2') - 44 < 1e-5 && $(most m.hm '$2') - 44 > -1e-5"
true_that "and to the right one" "$(most m.hm '-$2') - 3 < 1e-5 && $(most m.hm '-$2') - 3 > -1e-5"
set -- $(area m.hm)
true_that "elements counter-clockwise" "$2 > 0"
true_that "nodes 30 by 12 elements" "$(grep -c '^v' m.hm) == 31 * 13 && $(grep -c '^t' m.hm) == 2 * 30 * 12"
true_that "bank nodes are on a breakline, on the border and fixed" \
    "$(nodes m.hm | awk '$4 == 7' | wc -l) == 62"
true_that "the rest of the border is fixed" "$(nodes m.hm | awk '$4 == 5' | wc -l) == 22"
true_that "owner and region" "$(most m.hm '-$5') == -1 && $(grep -c '^t.* 1$' m.hm) == 720"
true_that "name, role and owners" "$(grep -c '^#name main\|^#role regular\|^#owners main' m.hm) == 3"

bsmesh -j 1 -c 10/8 -e 10/4 lines.txt plane.xyz >one.hm 2>/dev/null
same "one thread as several" m.hm one.hm
lines "$banks" >banks.txt
cat plane.xyz banks.txt rough.txt | bsmesh -c 10/8 -e 10/4 >piped.hm 2>/dev/null
same "operands in another order, through a pipe" m.hm piped.hm

ok "without breaklines" bsmesh -o m0.hm -c 10/8 -e 10/4 rough.txt plane.xyz
true_that "no node on a breakline" "$(most m0.hm 'int($4/2)%2') == 0"
ok "snap=0 leaves the banks" bsmesh -o m1.hm -n 0 -c 10/8 -e 10/4 lines.txt plane.xyz
true_that "the same places" "$(grep '^v' m0.hm | cksum | cut -d' ' -f1) == $(grep '^v' m1.hm | cksum | cut -d' ' -f1)"

grep -q 'main: banks as drawn.*snap=0' tap.err
report $? "which is said"
ok "quadrilaterals" bsmesh -o q.hm -Q -c 10/8 -e 10/4 lines.txt plane.xyz
true_that "all of them, of the same nodes" \
    "$(grep -c '^q' q.hm) == 360 && $(grep -c '^t' q.hm) == 0 && $(grep -c '^v' q.hm) == 403"
true_that "the same area" "$(area q.hm | cut -d' ' -f1) - $1 < 1e-6 && $(area q.hm | cut -d' ' -f1) - $1 > -1e-6"

for k in 1 3; do
    bsmesh -k $k -c 10/0,.1,.3,.7,.9,1 -e 10/4 lines.txt plane.xyz >k.hm 2>/dev/null
    true_that "degree $k, fractions across: on the plane" "$(most k.hm '($3-0.01*$1+0.02*$2-5)^2') < 1e-18"
done
true_that "fractions concentrate the nodes on the banks" \
    "$(nodes k.hm | awk '$2 > 39' | wc -l) > 2 * 31"

# sizes as attributes, drawn upstream, a curved inflow
lines "> surface=a side=right along=20 across=0,.5,1 elements=15/10 snap=6
300 40 0
0 40 0
> surface=a side=left
0 0 0
300 0 0
> surface=a side=inflow
300 0 0
310 20 0
300 40 0
> surface=b side=left along=10 across=10 elements=10
0 70 0
100 70 0
> surface=b side=right
100 50 0
0 50 0" >two.txt
ok "sizes as attributes, two surfaces" bsmesh -o two.hm two.txt plane.xyz
true_that "two objects in order" "$(awk '/^#name/ { printf "%s", $2 }' two.hm | grep -c '^ab$') == 1"
true_that "numbered by order" "$(most two.hm '$5') == 2 && $(most two.hm '-$5') == -1"
true_that "the bulge of the inflow" "$(most two.hm '$1') > 309 && $(most two.hm '$1') < 310.01"
set -- $(area two.hm)
true_that "counter-clockwise" "$2 > 0"
ok "only one of them" bsmesh -o b.hm -s b two.txt plane.xyz
true_that "with its number" "$(most b.hm '-$5') == -2 && $(grep -c '^#owners a b' b.hm) == 1"

# --- a bend of 120°, breaklines at radii 60 and 100 ---

# arc_from ANGLE RADIUS STEP: points of the arc from there to the opposite angle, every STEP degrees
arc_from() {
    awk -v from="$1" -v r="$2" -v step="$3" 'BEGIN { pi = atan2(0, -1)
        for (a = from; a <= -from; a += step) printf "%.10g %.10g 0\n", r * cos(a * pi / 180), r * sin(a * pi / 180) }'
}
arc() { arc_from -60 "$@"; }
plane -20 130 -120 120 >bend.xyz
lines "> surface=bend side=right
$(arc 103 15)
> surface=bend side=left
$(arc 58 30)
> limit=5
$(arc 60 0.5)
> limit=5
$(arc 100 0.5)" >bend.txt
# off FILE RADIUS: 95th percentile of the distance of its bank nodes from the arc
off() {
    nodes "$1" | awk -v r="$2" '{ e = sqrt($1 * $1 + $2 * $2) - r; if (e < 0) e = -e; if (e < 10) print e }' |
        awk '$1 < 5' | sort -g | awk '{ e[NR] = $1 } END { printf "%.6g", e[int(0.95 * NR + 0.999)] }'
}
for how in '' -Q; do
    ok "a bend $how" bsmesh -o bend.hm $how -c 8/8 -e 3/2 bend.txt bend.xyz
    nodes bend.hm | awk 'int($4 / 2) % 2' >bank.txt
    sed 's/^/v /' bank.txt >bank.hm
    true_that "bank nodes within 0.1 control distances of the inner breakline" "$(off bank.hm 60) < 0.6"
    true_that "and of the outer one" "$(off bank.hm 100) < 0.8"
    true_that "on the plane" "$(most bend.hm '($3-0.01*$1+0.02*$2-5)^2') < 1e-18"
    set -- $(area bend.hm)
    true_that "elements counter-clockwise" "$2 > 0"
    # the sector of the ring: (100² - 60²) 120° / 2, but for the slanted ends
    true_that "area of the bend: $1" "$1 > 0.97 * 6702 && $1 < 1.06 * 6702"
done

# --- tight bends: banks clicked every 38 or 40 degrees, the inner one tighter than the river is wide ---

plane -60 80 -80 80 >tight.xyz
for radius in 4 8 12; do
    for step in 38 40; do # the second ends short of the breaklines
        lines "> surface=t side=right
$(arc_from -95 43 19)
> surface=t side=left
$(arc_from -95 $((radius + 3)) $step)
> limit=5
$(arc_from -95 $radius 1)
> limit=5
$(arc_from -95 40 1)" >tight.txt
        for how in "-c 4/6" "-c 8/6" "-O -c 4/6"; do
            ok "no fold: inner radius $radius, $step degrees, $how" bsmesh $how -e 4/3 -o t.hm tight.txt tight.xyz
        done
    done
done

# --- from a rough centre line ---

axis='> surface=main side=axis half_width=20
-1 19 0
150 23 0
301 18 0'
lines "$axis
$banks
> limit=5
140 -40 1
150 80 1" >axis.txt
ok "both banks from an axis" bsmesh -o ax.hm -c 10/8 -e 10/4 axis.txt plane.xyz
grep -q 'main: both banks found from the axis, at all of 62 places' tap.err
report $? "which is said"
true_that "up to the left breakline" "($(most ax.hm '$2') - 44) ^ 2 < 1e-10"
true_that "and to the right one" "($(most ax.hm '-$2') - 3) ^ 2 < 1e-10"
true_that "as long as the axis" "($(most ax.hm '$1') - 301) ^ 2 < 4 && $(grep -c '^t' ax.hm) == 720"
lines "$axis
> limit=5
-20 44 1
320 44 1" >half.txt
ok "one bank only" bsmesh -o ax.hm -c 10/8 -e 10/4 half.txt plane.xyz
grep -q 'found from the axis at 31 of 62 places; at 31 the half-width holds, the first beside -1 19' tap.err
report $? "where none is found the half-width holds, and it is counted"
true_that "as wide as that: $(most ax.hm '-$2')" "$(most ax.hm '-$2') > 0 && $(most ax.hm '-$2') < 2.5"
lines "> surface=bend side=axis half_width=18
$(arc 82 12)
$(sed -n '/limit/,/#end/p' bend.txt | sed '/#end/d')" >axis_bend.txt
ok "in a bend" bsmesh -o ax.hm -c 8/8 -e 3/2 axis_bend.txt bend.xyz
nodes ax.hm | awk 'int($4 / 2) % 2' | sed 's/^/v /' >bank.hm
true_that "on both breaklines: $(off bank.hm 60) $(off bank.hm 100)" "$(off bank.hm 60) < 0.6 && $(off bank.hm 100) < 0.8"
lines "> surface=b side=left along=10 across=10 elements=10
0 70 0
100 70 0
$axis
> surface=b side=right
0 50 0
100 50 0" >order.txt
bsmesh -c 10/8 -e 10/4 order.txt plane.xyz 2>/dev/null >ax.hm
true_that "surfaces keep their order" "$(awk '/^#name/ { printf "%s", $2 }' ax.hm | grep -c '^bmain$') == 1"

# --- control points for a picture ---

ok "control points on request" bsmesh --net net.hm -o again.hm -c 10/8 -e 10/4 lines.txt plane.xyz
true_that "the mesh is the same" "$(grep '^[vt]' m.hm | cksum | cut -d' ' -f1) == $(grep '^[vt]' again.hm | cksum | cut -d' ' -f1)"
true_that "rows, columns and moves" "$(grep -c 'net=main row=' net.hm) == 6 && $(grep -c 'net=main column=' net.hm) == 31 &&
    $(grep -c 'move=main side=.* moved=1' net.hm) == $(sed -n 's/.*main: \([0-9]*\) of 62 control.*/\1/p' tap.err)"
true_that "moves end on the breaklines" "$(awk '/^>/ { on = /moved=1/; n = 0 } on && ++n == 3 &&
    ($2 - 44) ^ 2 > 1e-9 && ($2 + 3) ^ 2 > 1e-9 { bad++ } END { print bad + 0 }' net.hm) == 0"
bsmesh -c 10/8 -e 10/4 lines.txt net.hm plane.xyz 2>/dev/null >again.hm
true_that "and are no breaklines" "$(grep '^[vt]' m.hm | cksum | cut -d' ' -f1) == $(grep '^[vt]' again.hm | cksum | cut -d' ' -f1)"
must_fail "the net to standard output" 2 "needs a file" bsmesh --net - -c 10/8 -e 10/4 lines.txt plane.xyz
must_fail "or to nowhere" 2 "no/such" bsmesh --net no/such/file -c 10/8 -e 10/4 lines.txt plane.xyz

# --- diagonals, right angles, bends ---

ok "alternating diagonals" bsmesh -d alternating -o alt.hm -c 10/8 -e 10/4 lines.txt plane.xyz
# Of each inner node of such a mesh eight triangles meet or four; a corner never has three border nodes.
true_that "eight triangles round a node or four" "$(awk '/^v/ { inner[n++ + 0] = $5 % 2 == 0 && $2 > 15 && $2 < 285 && $3 > 2 && $3 < 39 }
    /^t/ { k[$2]++; k[$3]++; k[$4]++ } END { for (i in inner) if (inner[i] && k[i] != 8 && k[i] != 4) bad++; print bad + 0 }' alt.hm) == 0"
set -- $(area alt.hm)
true_that "the same ground" "$1 - $(area again.hm | cut -d' ' -f1) < 1e-6 && $2 > 0"

# squareness FILE: 90th percentile of how far sections, along which nodes are numbered, are off the right
# angle to the banks' mean direction, degrees; COLUMNS nodes a section
squareness() {
    awk -v m="$2" '/^v/ { x[n] = $2; y[n++] = $3 }
        END { for (i = 2 * m; i + 3 * m <= n; i += m) {
                dx = x[i + m] - x[i - m] + x[i + 2 * m - 1] - x[i - 1]; dy = y[i + m] - y[i - m] + y[i + 2 * m - 1] - y[i - 1]
                wx = x[i + m - 1] - x[i]; wy = y[i + m - 1] - y[i]
                a = (dx * wx + dy * wy) / sqrt((dx ^ 2 + dy ^ 2) * (wx ^ 2 + wy ^ 2)); if (a < 0) a = -a
                print atan2(a, sqrt(1 - a * a)) * 180 / 3.14159265358979 } }' n=0 "$1" |
        sort -g | awk '{ e[NR] = $1 } END { printf "%.4g", e[int(0.9 * NR + 0.999)] }'
}
# An S of three arcs: one bank is longer here, the other there.
awk 'BEGIN { pi = atan2(0, -1); for (k = 0; k < 2; k++) { print "> surface=s side=" (k ? "right" : "left")
    for (t = 0; t <= 300; t += 5) { a = .9 * sin(t / 300 * 2 * pi); if (t == 0) { cx = cy = 0 }
        printf "%.6f %.6f 0\n", cx - (k ? -12 : 12) * sin(a), cy + (k ? -12 : 12) * cos(a); cx += 5 * cos(a); cy += 5 * sin(a) } } }' >s.txt
{ echo '#hm 1 lines text'; echo '#data'; cat s.txt; echo '#end'; } >bow.txt
plane -40 340 -100 200 >wide.xyz
# columns FILE: nodes a section of an uncut mesh of triangles, from its numbers of nodes and triangles
columns() { awk '/^v/ { n++ } /^t/ { p += .5 } END { s = n - p - 1; print int((s - sqrt(s * s - 4 * p)) / 2 + 1.5) }' "$1"; }
bsmesh -n 0 -c 10/8 -e 8/4 bow.txt wide.xyz >skewed.hm 2>/dev/null
ok "sections at right angles on request" bsmesh -O -n 0 -o square.hm -c 10/8 -e 8/4 bow.txt wide.xyz
true_that "off the right angle: $(squareness square.hm $(columns square.hm)), was $(squareness skewed.hm $(columns skewed.hm))" \
    "$(squareness square.hm $(columns square.hm)) < 3 && $(squareness skewed.hm $(columns skewed.hm)) > 8"
grep -v '^[>#]' s.txt >bank.points
true_that "without leaving the banks" "$(nodes square.hm | awk -v m=$(columns square.hm) 'NR % m < 2' |
    awk 'NR == FNR { x[n] = $1; y[n++] = $2; next } { best = 9; for (i = 0; i + 1 < n; i++) { if (i == 60) continue
        dx = x[i + 1] - x[i]; dy = y[i + 1] - y[i]; t = (($1 - x[i]) * dx + ($2 - y[i]) * dy) / (dx * dx + dy * dy)
        t = t < 0 ? 0 : t > 1 ? 1 : t; d = sqrt((x[i] + t * dx - $1) ^ 2 + (y[i] + t * dy - $2) ^ 2); if (d < best) best = d }
        if (best > most) most = best } END { print most + 0 }' bank.points -) < 0.3"
set -- $(area square.hm)
true_that "counter-clockwise" "$2 > 0"
lines "> surface=l side=left
0 40 0
140 40 0
140 200 0
> surface=l side=right
0 0 0
180 0 0
180 200 0" >elbow.txt
ok "denser where it bends" bsmesh -B 15 -n 0 --net bend.net -o elbow.hm -c 20/10 -e 10/8 elbow.txt wide.xyz
spacing=$(awk '/^>/ { on = /row=0/; n = 0; next } /^#/ { next } on { if (n++) { d = sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2)
    if (n == 2) first = d; if (!least || d < least) least = d } x = $1; y = $2 } END { print least, first }' bend.net)
set -- $spacing
true_that "nearest and first control points: $spacing" "$1 < 0.5 * $2 && $1 > 4 && $2 > 15"
bsmesh -B 0 -n 0 -c 20/10 -e 10/8 elbow.txt wide.xyz 2>/dev/null | grep '^v' >a
bsmesh -n 0 -c 20/10 -e 10/8 elbow.txt wide.xyz 2>/dev/null | grep '^v' >b
same "no bend asked for, equal distances" a b
sed 's/side=left/side=left bend=15/' elbow.txt >bend_attr.txt
bsmesh -n 0 -c 20/10 -e 10/8 bend_attr.txt wide.xyz 2>/dev/null | grep '^v' >a
grep '^v' elbow.hm >b
same "as an attribute" a b

# --- faces ---

loop='> face=main closed=1
50 -20 0
250 -20 0
250 20 0
150 20 0
150 60 0
50 60 0'
lines "$rough
$banks
$loop" >face.txt
ok "a face loop" bsmesh -o f.hm -c 10/8 -e 10/4 face.txt plane.xyz
true_that "all inside it" "$(most f.hm '$1 < 50 || $1 > 250 || ($1 > 150 && $2 > 20)') == 0"
true_that "no unused node" "$(awk '/^v/ { n++ } /^t/ { for (i = 2; i <= 4; i++) if (!seen[$i]++) m++ } END { print n - m }' f.hm) == 0"
set -- $(area f.hm)
true_that "area $1 of the cut" "$1 > 6500 && $1 < 200 * 47 - 100 * 24 + 1e-3 && $2 > 0"
true_that "the cut is border" "$(nodes f.hm | awk '$4 % 2 == 0 && ($1 < 58 || $1 > 242)' | wc -l) == 0"
lines "$rough
$banks
$loop
> face=main hole=1 closed=1
70 10 0
120 10 0
120 35 0
70 35 0" >hole.txt
ok "a hole in it" bsmesh -o h.hm -c 10/8 -e 10/4 hole.txt plane.xyz
true_that "nothing inside" "$(most h.hm '$1 > 70 && $1 < 120 && $2 > 10 && $2 < 35') == 0"

# --- the cut moved onto its loop: a slanted strip, and a hole ---

slanted='> face=main closed=1
30 -10 0
60 -10 0
270 30 0
262 50 0
220 50 0'
lines "$rough
$banks
$slanted" >slanted.txt
ok "fitted to the loop" bsmesh -F -o fit.hm -c 10/8 -e 5/4 slanted.txt plane.xyz
grep -Eq 'main: [0-9]+ nodes of the cut moved onto the face loop, the furthest [0-9.]+ m; [0-9]+ stay' tap.err
report $? "which is said: $(grep 'of the cut' tap.err)"
# beside FILE: border nodes off the banks further than 1 cm from the sloping edges of the loop, and the
# smallest area
beside() {
    nodes "$1" | awk '$4 % 2 && $2 > -2.9 && $2 < 43.9 { a = $2 + 10 - ($1 - 60) * 40 / 210; b = $2 + 10 - ($1 - 30) * 60 / 190
        c = ($1 - 270) * 20 + ($2 - 30) * 8
        if (a ^ 2 > 1e-4 && b ^ 2 > 1e-4 && c ^ 2 > .05) n++ } END { print n + 0 }'
}
true_that "most nodes of the cut lie on the loop" "$(beside fit.hm) <= 20"
true_that "without -F they do not" "$(bsmesh -c 10/8 -e 5/4 slanted.txt plane.xyz 2>/dev/null >saw.hm; beside saw.hm) > 60"
true_that "on the plane" "$(most fit.hm '($3-0.01*$1+0.02*$2-5)^2') < 1e-18"
true_that "counter-clockwise" "$(area fit.hm | cut -d' ' -f2) > 0.5"
for length in 5 6 7 8; do # the loop encloses 3842.76 m2 of the channel
    bsmesh -F -c 10/8 -e $length/4 slanted.txt plane.xyz >notch.hm 2>/dev/null
    true_that "elements of $length m fill the loop, but for" \
        "3842.76 - $(area notch.hm | cut -d' ' -f1) < 55 && 3842.76 - $(area notch.hm | cut -d' ' -f1) > -5"
    ok "without fault" sh -c 'stitch notch.hm >/dev/null'
done
ok "a mesh without fault" sh -c 'stitch fit.hm >/dev/null'
ok "quadrilaterals too" sh -c 'bsmesh -F -Q -c 10/8 -e 5/4 slanted.txt plane.xyz >fit.hm 2>/dev/null && stitch fit.hm >/dev/null'
ok "round a hole" sh -c 'bsmesh -F -c 10/8 -e 5/4 hole.txt plane.xyz >fit.hm 2>/dev/null && stitch fit.hm >/dev/null'
true_that "which stays empty" "$(most fit.hm '$1 > 71 && $1 < 119 && $2 > 11 && $2 < 34') == 0"

lines "$rough
> face=main closed=1
100 10 0
100.2 10 0
100 10.2 0" >tiny.txt
must_fail "a loop too small for -F" 2 "surface 'main'" bsmesh -F -c 10/8 -e 5/4 tiny.txt plane.xyz

# --- gaps in the terrain ---

awk '!($1 > 100 && $1 < 200 && $2 > 0 && $2 < 50)' plane.xyz >gap.xyz
ok "a gap in the terrain is filled" bsmesh -o g.hm -g 30 -c 10/8 -e 10/4 lines.txt gap.xyz
true_that "aloud" "$(grep -c 'control points without terrain' tap.err) == 1"
true_that "between what is known" "$(most g.hm '($3-0.01*$1+0.02*$2-5)^2') < 1e-6"
must_fail "--strict makes that exit 1" 1 "without terrain" \
    bsmesh --strict -g 30 -c 10/8 -e 10/4 lines.txt gap.xyz
awk '$1 < 200' plane.xyz >half.xyz
must_fail "terrain that ends" 2 "no terrain under the outflow end of surface 'main'" \
    bsmesh -c 10/8 -e 10/4 lines.txt half.xyz

# --- a real river, with breaklines found in its survey ---

if need_data danube_deggendorf/points.xyz; then
    survey=$DATA/danube_deggendorf/points.xyz
    bsgrid -d 5 -g 60 "$survey" 2>/dev/null | slope | breaklines -s 10 -l 100 -r 12 >found.hm 2>/dev/null
    ok "the Danube" bsmesh -o danube.hm -c 25/20 -e 16/10 "$TESTS/danube_lines.txt" found.hm "$survey"
    set -- $(sed -n 's/.* \([0-9]*\) of \([0-9]*\) control points on the banks moved.*/\1 \2/p' tap.err)
    true_that "nine of ten control points find a breakline" "$1 > 0.9 * $2"
    set -- $(area danube.hm)
    true_that "elements counter-clockwise" "$2 > 0"
    ok "quadrilaterals there" bsmesh -o danube.hm -Q -c 25/20 -e 16/10 "$TESTS/danube_lines.txt" found.hm "$survey"
fi

# A right bank drawn between toe and crest, metres from either: it stays on the crest all along.
if need_data severn_caersws/points.xyz; then
    survey=$DATA/severn_caersws/points.xyz
    bsgrid -d 5 "$survey" 2>/dev/null | slope | breaklines -s 6 -l 60 -r 8 >found.hm 2>/dev/null
    lines "> surface=s side=left
303150 285675 0
303250 285685 0
303370 285685 0
303470 285665 0
303540 285635 0
303585 285590 0
303590 285560 0
> surface=s side=right
303150 285620 0
303250 285635 0
303400 285635 0
303450 285615 0
303500 285590 0
303540 285555 0
303550 285535 0" >severn.txt
    ok "the Severn" bsmesh -o severn.hm -n 15 -c 10/8 -e 10/6 severn.txt found.hm "$survey"
    true_that "no node of the bank down at the toe" "$(awk '/^v/ && int($5 / 2) % 2 { p[n++] = $0 }
        END { for (i = 0; i < n; i++) { split(p[i], v); low += v[4] < 120.3 } print low + 0 }' severn.hm) == 0"
fi

# --- what is refused ---

refuse() { # NAME PATTERN LINES [OPTION …]
    name=$1 pattern=$2
    lines "$3" >bad.txt
    shift 3
    must_fail "$name" 2 "$pattern" bsmesh -c 10/8 -e 10/4 "$@" bad.txt plane.xyz
}
left='> surface=main side=left
0 40 0
300 40 0'
right='> surface=main side=right
0 0 0
300 0 0'
refuse "no rough banks" "no rough banks" "$banks"
refuse "one bank only" "surface 'main' has no line with side=right" "$left"
refuse "no bank" "surface 'main' has no line with side=left" '> surface=main side=inflow
0 0 0
0 40 0'
refuse "a bank of one point" "side left of surface 'main' is only one point" "$right
> surface=main side=left
0 40 0"
refuse "a bank without length" "only one point" "$right
> surface=main side=left
0 40 0
0 40 0"
refuse "a closed bank" "a closed line" "$right
> surface=main side=left closed=1
0 40 0
30 40 0
30 80 0"
refuse "the same bank twice" "two lines with side=left" "$left
$left"
refuse "an unknown side" "side 'top': left, right, inflow, outflow or axis" '> surface=main side=top
0 0 0
1 1 0'
refuse "a bend that is none" "bend=270 is no angle" "$left
> surface=main side=right bend=270
0 0 0
300 0 0"
refuse "nor as an option" "an angle is from 0 to 180" "$left
$right" -B -1
refuse "a half-width that is no number" "half_width=wide.* at 0 20" '> surface=main side=axis half_width=wide
0 20 0
300 20 0'
refuse "an axis without half-width" "half_width=20.* at 0 20" '> surface=main side=axis
0 20 0
300 20 0'
refuse "a half-width that is none" "half-width" '> surface=main side=axis half_width=-3
0 20 0
300 20 0'
refuse "a closed axis" "axis.* closed line at 0 20" '> surface=main side=axis half_width=9 closed=1
0 20 0
30 20 0
30 60 0'
refuse "an axis of one point" "axis.* only one point at 0 20" '> surface=main side=axis half_width=9
0 20 0'
refuse "an axis and a bank" "two lines with side=left" "$left
> surface=main side=axis half_width=9
0 20 0
300 20 0"
refuse "no side" "side ''" '> surface=main
0 0 0
1 1 0'
refuse "banks that cross" "the banks of surface 'main' cross at 199.99" "$left
> surface=main side=right
0 0 0
100 0 0
200 40.00001 0
150 20 0
300 0 0"
refuse "a bank that crosses itself" "the left bank of surface 'main' crosses itself" "$right
> surface=main side=left
0 40 0
200 40 0
200 80 0
100 20 0
300 20 0"
refuse "sections that cross" "of surface 'main'" "$left
$right
> surface=main side=inflow
0 0 0
20 50 0
0 40 0"
refuse "swapped banks" "the banks of surface 'main' are swapped" "$left
$right
> surface=main side=inflow
300 0 0
300 40 0"
refuse "swapped banks, both drawn downstream" "the banks of surface 'main' are swapped .* at 2 1" '> surface=main side=left
2 1 0
300 0 0
> surface=main side=right
0 40 0
150 44 0
300 40 0'
refuse "or in a bend that turns back" "the banks of surface 'main' are swapped .* at " "$(
    echo '> surface=main side=left'; arc_from -170 60 10; echo '> surface=main side=right'; arc_from -170 40 10)"
lines "$right
$(echo "$left" | sed 's/^0 40/20 40/')
> surface=main side=inflow
300 0 0
300 40 0" | sed 's/side=left/side=x/; s/side=right/side=left/; s/side=x/side=right/' >upstream.txt
ok "both drawn upstream, when an inflow says so" bsmesh -c 10/8 -e 10/4 upstream.txt plane.xyz
refuse "inflow and outflow at one end" "lie at the same end" "$left
$right
> surface=main side=inflow
300 0 0
300 40 0
> surface=main side=outflow
301 0 0
301 40 0"
refuse "spacing larger than the river is wide" "farther apart than its banks" "$left
$right" -c 10/50
refuse "spacing larger than the river is long" "farther apart than its banks are long" "$left
$right" -c 400/8
refuse "a face without surface" "face=x: there is no surface 'x'" "$left
$right
> face=x closed=1
0 0 0
9 0 0
9 9 0"
refuse "an open face" "the loop face=main is open" "$left
$right
> face=main
0 0 0
90 0 0
90 90 0"
refuse "a face that crosses itself" "the loop face=main crosses itself" "$left
$right
> face=main closed=1
0 0 0
90 0 0
0 40 0
90 40 0"
refuse "a face that leaves nothing" "no element of surface 'main'" "$left
$right
> face=main closed=1
500 0 0
590 0 0
590 40 0"
refuse "an attribute that is no number" "along" "$right
> surface=main side=left along=wide
0 40 0
300 40 0"
refuse "a distance that is none" 'along=-1 is no distance.* at 0 40' "$right
> surface=main side=left along=-1
0 40 0
300 40 0"
refuse "a snap distance that is none" 'snap=-2 is no distance' "$right
> surface=main side=left snap=-2
0 40 0
300 40 0"
refuse "attributes that contradict each other" "snap=5 contradicts another line of surface 'main'.* at 0 0" \
    "> surface=main side=left snap=3
0 40 0
300 40 0
> surface=main side=right snap=5
0 0 0
300 0 0"
lines "> surface=main side=left along=20 across=0,.5,1
0 40 0
300 40 0
> surface=main side=right along=20 across=0,.5,1
0 0 0
300 0 0" >agree.txt
ok "the same said twice is none" bsmesh -e 10/4 agree.txt plane.xyz
refuse "an inflow along the banks" "inflow line of surface 'main' does not run from bank to bank.* at " "$left
$right
> surface=main side=inflow
0 20 0
40 22 0"
refuse "an inflow far from them" "outflow line of surface 'main' lies 60 m from the ends" "$left
$right
> surface=main side=outflow
360 0 0
360 40 0"
refuse "a hole that covers all" "a hole covers the whole surface 'main' at" "$left
$right
> face=main hole=1 closed=1
-10 -10 0
310 -10 0
310 50 0
-10 50 0"
refuse "control points closer than measurements by far" "no terrain .* more than 2.5 m apart .*-g" "$left
$right" -c .5/.5
refuse "a loop of two points" 'face=main has only 2 points' "$left
$right
> face=main hole=1 closed=1
0 0 0
9 9 0"
refuse "fractions that fall" "do not rise from 0 to 1" "$left
$right" -c 10/0,.5,.3,1
refuse "a length that is none" "no length of elements" "$left
$right" -e 8/x
refuse "an unknown surface" "no surface 'side'" "$left
$right" -s side
refuse "a fold" "folds here" '> surface=main side=left
0 40 0
80 40 0
80 45 0
20 45 0
20 50 0
300 50 0
> surface=main side=right
0 0 0
300 0 0'

lines "$left
$right" >good.txt
must_fail "no terrain" 2 "no terrain" bsmesh -c 10/8 -e 10/4 good.txt
must_fail "terrain elsewhere" 2 "no terrain under surface 'main'" \
    sh -c "awk '{ print \$1 + 9000, \$2, \$3 }' plane.xyz | bsmesh -c 10/8 -e 10/4 good.txt -"
must_fail "measurements on a line" 2 "line" sh -c "awk '\$1 == 0' plane.xyz | bsmesh -c 10/8 -e 10/4 good.txt -"
must_fail "one measurement" 2 "" sh -c "head -1 plane.xyz | bsmesh -c 10/8 -e 10/4 good.txt -"
must_fail "a word for a number" 2 "" sh -c "(cat plane.xyz; echo 1 two 3) | bsmesh -c 10/8 -e 10/4 good.txt -"
must_fail "NaN" 2 "" sh -c "(cat plane.xyz; echo 1 nan 3) | bsmesh -c 10/8 -e 10/4 good.txt -"
must_fail "truncated lines" 2 "" sh -c "head -4 good.txt | bsmesh -c 10/8 -e 10/4 - plane.xyz"
must_fail "no control distance" 2 "no distance of control points for surface 'main'" bsmesh -e 8 good.txt plane.xyz
must_fail "no element length" 2 "no length of elements for surface 'main'" bsmesh -c 8 good.txt plane.xyz
must_fail "empty input" 2 "empty" bsmesh -c 8 -e 8 /dev/null
must_fail "a full disk" 2 "" sh -c "bsmesh -c 10/8 -e 10/4 good.txt plane.xyz >/dev/full"
lines "$left
$right
> surface=other side=left
0 0 0
5 5 0" >late.txt
bsmesh -c 10/8 -e 10/4 late.txt plane.xyz >late.hm 2>/dev/null
true_that "nothing is written when a later surface fails" "$(wc -c <late.hm) == 0"
done_testing
