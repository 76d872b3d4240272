#!/bin/sh
# quality of elements: measures, warnings and materials against awk over the mesh, time steps by hand.
. "${0%/*}/tap.sh"
. "$TESTS/report.sh"

# of_material NUMBER NAME KEY: a measure of a material in report.json
of_material() {
    awk -v number="$1," -v name="\"$2\":" -v key="\"$3\":" '$1 == "\"material\":" { here = $2 == number; on = 0 }
        here && $1 == name && $2 == "{" { on = 1 } on && $1 == key { sub(/,$/, "", $2); print $2; exit }' report.json
}
# warned NAME [MATERIAL]: how often a warning was given, 0 when it is not there
warned() {
    awk -v name="\"warning\": \"$1\"," -v number="${2:+$2,}" '$1 == "\"material\":" { if (number == "") exit; here = $2 == number }
        (number == "" || here) && index($0, name) { getline; sub(/,$/, "", $2); n = $2; exit } END { print n + 0 }' report.json
}

# a mesh with everything that is warned of: bent triangles and quadrilaterals, materials 1 and 4, one node
# pulled far up, some far aside
awk 'BEGIN { print "#hm 1 mesh text\n#data"
    for (j = 0; j <= 12; j++) for (i = 0; i <= 12; i++) {
        x = 5 * i + 1.5 * sin(i + 2 * j); y = 5 * j + 1.5 * cos(3 * i + j)
        if (i == 5 && j == 5) x += 3.4
        if (i == 9 && j == 3) y -= 3.3
        print "v", x, y, (i == 7 && j == 7 ? 20 : sin(i) + j / 10), 0, 0 }
    for (j = 0; j < 12; j++) for (i = 0; i < 12; i++) { a = 13 * j + i; r = (i + j < 9 ? 4 : 1)
        if ((i + j) % 3 == 0) print "q", a, a + 1, a + 14, a + 13, r
        else if ((i * j) % 2) { print "t", a, a + 1, a + 14, r; print "t", a, a + 14, a + 13, r }
        else { print "t", a, a + 1, a + 13, r; print "t", a + 1, a + 14, a + 13, r } }
    print "#end" }' OFMT=%.15g CONVFMT=%.15g >rough.hm
echo 30 30 1 >point.xyz
ok "a report" quality -J -o report.json rough.hm point.xyz
awk 'function angle(p, q, r,    ax, ay, bx, by) {
        ax = x[r] - x[q]; ay = y[r] - y[q]; bx = x[p] - x[q]; by = y[p] - y[q]
        ax = atan2(ax * by - ay * bx, ax * bx + ay * by) * deg
        return ax < 0 ? ax + 360 : ax }
    function count(name) { print name; print name, region }
    function abs(v) { return v < 0 ? -v : v }
    BEGIN { deg = 180 / atan2(0, -1) }
    /^v/ { x[n + 0] = $2; y[n + 0] = $3; z[n++] = $4 }
    /^[tq]/ { m = /^t/ ? 3 : 4; e++; region = $NF; reg[e] = region; area = cx[e] = cy[e] = 0; least = 360; most = 0
        size[e] = m
        for (i = 0; i < m; i++) { p = $(2 + (i + m - 1) % m); q = $(2 + i); r = $(2 + (i + 1) % m)
            a = angle(p, q, r); if (a < least) least = a
            if (a > most) most = a
            corner[e, i] = q; at[q]++; cx[e] += x[q] / m; cy[e] += y[q] / m
            area += ((x[q] - x[$2]) * (y[r] - y[$2]) - (x[r] - x[$2]) * (y[q] - y[$2])) / 2
            key = q < r ? q SUBSEP r : r SUBSEP q
            if (key in first) { second[key] = e; right[key] = 1 } else first[key] = e }
        big[e] = area
        if (m == 3 && least < 10) count("sharp3")
        if (m == 3 && most > 150) count("blunt3")
        if (m == 4 && least < 30) count("sharp4")
        if (m == 4 && most > 150) count("blunt4")
        # the bed: gradient of the plane through three corners, of quadrilaterals along their diagonals
        a = $2; b = $3; c = $4; f = (m == 4 ? $5 : $2)
        if (m == 4) { ux = x[c] - x[a]; uy = y[c] - y[a]; uz = z[c] - z[a]; vx = x[f] - x[b]; vy = y[f] - y[b]; vz = z[f] - z[b] }
        else { ux = x[b] - x[a]; uy = y[b] - y[a]; uz = z[b] - z[a]; vx = x[c] - x[a]; vy = y[c] - y[a]; vz = z[c] - z[a] }
        d = ux * vy - uy * vx; gx = (uz * vy - vz * uy) / d; gy = (ux * vz - vx * uz) / d
        slope = atan2(sqrt(gx * gx + gy * gy), 1) * deg
        if (slope > steepest) steepest = slope
        if (slope > 45) count("steep")
    }
    END { for (key in first) { split(key, k, SUBSEP)
            if (!(key in second)) { edge[k[1]] = edge[k[2]] = 1; continue }
            l = first[key]; r = second[key]; region = reg[l] == reg[r] ? reg[l] : "none"
            ratio = big[l] > big[r] ? big[l] / big[r] : big[r] / big[l]
            if (ratio > 2) count("ratio")
            ux = x[k[2]] - x[k[1]]; uy = y[k[2]] - y[k[1]]; vx = cx[r] - cx[l]; vy = cy[r] - cy[l]
            off = atan2(abs(ux * vx + uy * vy), abs(ux * vy - uy * vx)) * deg
            sum += off; pairs++
            if (off > 70) count("off") }
        for (i = 0; i < n; i++) if (!(i in edge)) { if (at[i] < 4) print "few"; if (at[i] > 10) print "many"; inner++; degree += at[i] }
        for (i = 1; i <= e; i++) { region = reg[i]
            if (size[i] == 3 && (corner[i, 0] in edge) && (corner[i, 1] in edge) && (corner[i, 2] in edge)) count("corner") }
        print "steepest", steepest; print "off-mean", sum / pairs; print "degree", degree / inner }' CONVFMT=%.15g OFMT=%.15g rough.hm >facts
facts() { grep -cx "$1" facts; }
while read -r fact name; do
    near "$name" "$(warned "$name")" "$(facts "$fact")" 0
    for material in 1 4; do
        case $fact in few | many) continue ;; esac
        near "$name, material $material" "$(warned "$name" $material)" "$(facts "$fact $material")" 0
    done
done <<'END'
sharp3 triangle with an angle under 10 degrees
blunt3 triangle with an angle over 150 degrees
sharp4 quadrilateral with an angle under 30 degrees
blunt4 quadrilateral with an angle over 150 degrees
ratio neighbours of area ratio over 2
few inner node of fewer than 4 elements
many inner node of more than 10 elements
corner triangle with all nodes on the boundary
steep element steeper than 45 degrees
off edge over 70 degrees off orthogonal
END
true_that "most kinds of warning are there" "$(cut -d' ' -f1 facts | sort -u | wc -l) >= 9"
near "steepest bed" "$(measure bed_slope most)" "$(awk '$1 == "steepest" { print $2 }' facts)" 1e-9
near "mean deviation from orthogonal" "$(measure off_orthogonal mean)" "$(awk '$1 == "off-mean" { print $2 }' facts)" 1e-9
near "mean number of elements at inner nodes" "$(measure elements_at_a_node mean)" "$(awk '$1 == "degree" { print $2 }' facts)" 1e-9
near "areas of materials" "$(of_material 1 area mean) * $(of_material 1 area count) + $(of_material 4 area mean) * $(of_material 4 area count)" "$(value area)" 1e-9
near "elements of materials" "$(of_material 1 area count) + $(of_material 4 area count)" "$(measure area count)" 0
quality rough.hm point.xyz >report.txt
ok "a row a material" sh -c "sed -n '/^Materials/,/^$/p' report.txt | grep -Ec '^ +[14] ' | grep -qx 2"

# histograms against awk: areas
awk '/^v/ { x[n + 0] = $2; y[n++] = $3 }
    /^[tq]/ { m = /^t/ ? 3 : 4; area = 0
        for (i = 1; i < m - 1; i++) { q = $(2 + i); r = $(3 + i)
            area += ((x[q] - x[$2]) * (y[r] - y[$2]) - (x[r] - x[$2]) * (y[q] - y[$2])) / 2 }
        k = area < 1 ? 1 : area < 2 ? 2 : area < 5 ? 5 : area < 10 ? 10 : area < 20 ? 20 : area < 50 ? 50 : 100; bin[k]++ }
    END { print bin[5] + 0, bin[10] + 0, bin[20] + 0, bin[50] + 0 }' rough.hm >want
bin() { awk -v to="$1" '/"area": {/ { on = 1 } on && $1 == "\"to\":" && $2 + 0 == to { getline; print $2 + 0; exit }' report.json; }
echo "$(bin 5) $(bin 10) $(bin 20) $(bin 50)" >got
same "the histogram of areas" want got
awk '/^v/ { x[n + 0] = $2; y[n++] = $3 }
    /^[tq]/ { m = /^t/ ? 3 : 4; least = 1e9; most = cx = cy = 0
        for (i = 0; i < m; i++) { q = $(2 + i); r = $(2 + (i + 1) % m); cx += x[q] / m; cy += y[q] / m
            l = sqrt((x[r] - x[q]) ^ 2 + (y[r] - y[q]) ^ 2); if (l < least) least = l
            if (l > most) most = l }
        printf "%.3f  %.3f %.3f\n", most / least, cx, cy }' rough.hm | LC_ALL=C sort -k1,1gr | head -10 >want
sed -n '/^  edge ratio, the 10/,/^$/s/^ *\([0-9]\)/\1/p' report.txt | sed 's/  */ /g' >got
sed -i 's/  */ /g' want
same "the ten worst edge ratios by coordinate" want got

# --- what that mesh has not: many and few elements at a node, a sharp quadrilateral ---
awk 'BEGIN { print "#hm 1 mesh text\n#data\nv 0 0 0 0 0"; pi = atan2(0, -1)
    for (k = 0; k < 12; k++) print "v", cos(k * pi / 6), sin(k * pi / 6), 0, 0, 0
    for (k = 1; k <= 12; k++) print "t", 0, k, k % 12 + 1, 0
    print "#end" }' >fan.hm
echo 0 0 0 >centre.xyz
quality -J -o report.json fan.hm centre.xyz
near "twelve elements at a node" "$(warned "inner node of more than 10 elements")" 1 0
near "none of them on the boundary alone" "$(warned "triangle with all nodes on the boundary")" 0 0
awk '/^t/ { k = ($3 - 1) / 4; if (k == int(k)) print "t", 0, $3, ($3 + 3) % 12 + 1, 0; next }
    /^v/ && n++ && (n - 2) % 4 { next } { print }' fan.hm | sed 's/^t 0 1 5/t 0 1 2/; s/^t 0 5 9/t 0 2 3/; s/^t 0 9 1/t 0 3 1/' >three.hm
quality -J -o report.json three.hm centre.xyz
near "three elements at a node" "$(warned "inner node of fewer than 4 elements")" 1 0
printf '#hm 1 mesh text\n#data\nv 0 0 0 0 0\nv 10 0 0 0 0\nv 19 4 0 0 0\nv 9 4 0 0 0\nq 0 1 2 3 5\n#end\n' >rhombus.hm
quality -J -o report.json rhombus.hm centre.xyz
near "a rhombus of 24 degrees" "$(warned "quadrilateral with an angle under 30 degrees" 5)" 1 0
near "and of 156" "$(warned "quadrilateral with an angle over 150 degrees" 5)" 1 0

# --- time steps: legs of 10 m, smallest height 10 / sqrt(2); and a square of 10 m ---
cat >square.hm <<'END'
#hm 1 mesh text
#data
v 0 0 0 0 0
v 10 0 0 0 0
v 10 10 0 0 0
v 0 10 0 0 0
v 20 0 0 0 0
q 0 1 2 3 0
t 1 4 2 0
#end
END
echo 5 5 0 >point.xyz
quality -J --courant 2,1.5 -o report.json square.hm point.xyz
near "smallest time step" "$(measure time_step least)" "10 / sqrt(2) / (1.5 + sqrt(9.81 * 2))" 1e-12
near "largest time step" "$(measure time_step most)" "10 / (1.5 + sqrt(9.81 * 2))" 1e-12
ok "as a criterion" quality --courant 2,1.5 -c 'timestep>=1.1' square.hm point.xyz
quality -c 'timestep>=0' square.hm point.xyz >report.txt
near "without water there is none" $? 1 0
must_fail "no depth" 2 "courant.*'0,1'" quality --courant 0,1 square.hm point.xyz
must_fail "depth alone" 2 "courant" quality --courant 2 square.hm point.xyz
must_fail "a survey error under 0" 2 "survey-error" quality --survey-error -1 square.hm point.xyz

# --- two pieces, one over the other: only a look at all elements tells ---
awk '/^v/ { n++; print; v[n] = $0; next } /^q/ { q = $0; print; next } /^#end/ {
    for (k = 1; k <= 4; k++) { split(v[k], p, " "); print "v", p[2] / 4 + 2, p[3] / 4 + 2, 0, 0, 0 }
    print "q 5 6 7 8 0" } { print }' square.hm | awk '/^v/ { nodes = nodes $0 "\n"; next } /^[tq]/ { elems = elems $0 "\n"; next }
    /^#end/ { printf "%s%s", nodes, elems } { print }' >twice.hm
quality twice.hm point.xyz >report.txt
ok "a small piece over a large element" grep -Eq 'error +elements that overlap +1 ' report.txt

done_testing
