#!/bin/sh
# quality along lines: share followed, distances and heights against cases worked by hand, and against
# awk over stations of its own.
. "${0%/*}/tap.sh"
. "$TESTS/report.sh"

# line NAME KEY: of a line in report.json; line NAME KEY N: the N-th number behind the key
line() {
    awk -v name="\"$1\"," -v key="\"$2\":" -v n="${3:-1}" '$1 == "\"line\":" { on = $2 == name }
        on && $1 == key { if ($2 == "{") getline; for (; n > 1; n--) getline
            sub(/,$/, "", $2); print $2; exit }' report.json
}

# 10 x 10 quadrilaterals of 10 m, z = x / 10 + y / 20
awk 'BEGIN { print "#hm 1 mesh text\n#data"
    for (j = 0; j <= 10; j++) for (i = 0; i <= 10; i++) print "v", 10 * i, 10 * j, i + j / 2, 0, 0
    for (j = 0; j < 10; j++) for (i = 0; i < 10; i++) { a = 11 * j + i; print "q", a, a + 1, a + 12, a + 11, 0 }
    print "#end" }' >lattice.hm
echo 5 5 0.75 >point.xyz
cat >lines.txt <<'END'
> name=edge
0 50 3.5
100 50 13.5
> name=beside
20.25 10 2.25
20.25 60 4.75
> name=across
5 5 0.75
95 95 14.25
> name=half
0 20 1
50 20 6
50 25 nan
80 25 nan
> name=leaving
-50 30 0
50 30 0
> surface=main side=left
0 20 0
100 20 0
END
ok "lines" quality -J -o report.json lattice.hm point.xyz lines.txt
true_that "lines without a role only" "$(grep -c '"line":' report.json) == 6"
near "an edge is followed" "$(line edge followed)" 100 1e-12
near "at no distance" "$(line edge lateral_largest)" 0 1e-12
near "1 m under the line" "$(line edge vertical_mean)" -1 1e-12
near "the same as size" "$(line edge vertical_mean_size)" 1 1e-12
near "at worst" "$(line edge vertical_largest)" -1 1e-12
near "25 cm beside: followed" "$(line beside followed)" 100 1e-12
near "its mean distance" "$(line beside lateral_mean)" 0.25 1e-12
near "its height, x / 10 + y / 20 - z" "$(line beside vertical_largest)" 0.275 1e-12
near "a diagonal is not" "$(line across followed)" 0 1e-12
near "all of it in one stretch" "$(line across longest_not_followed)" "90 * sqrt(2)" 1e-9
near "but it has the heights" "$(line across vertical_mean_size)" 0 1e-12
near "55 m of 85 followed, round the corner" "$(line half followed)" "100 * 55 / 85" 1e-9
near "30 m are not" "$(line half longest_not_followed)" 30 1e-9
near "that begin where the line leaves the edge" "$(line half longest_not_followed 2)" 50 1e-9
near "heights where the line has some" "$(line half vertical_mean_size)" 0 1e-12
near "length" "$(line leaving length)" 100 1e-9
near "on the mesh" "$(line leaving on_mesh)" 50 1e-9
near "followed there" "$(line leaving followed)" 100 1e-9
near "the largest difference, at the end" "$(line leaving vertical_largest)" 6.5 1e-9
near "its place" "$(line leaving vertical_largest 2)" 50 1e-9
near "of all: their lengths" "$(line all length)" "100 + 50 + 90 * sqrt(2) + 85 + 100" 1e-9
near "of all: the largest difference" "$(line all vertical_largest)" 6.5 1e-9
quality -J --follow 0.2 -o report.json lattice.hm point.xyz lines.txt
near "25 cm beside at 20 cm" "$(line beside followed)" 0 1e-12
quality lattice.hm point.xyz lines.txt >report.txt
ok "the text has them" grep -Eq '^  edge +100.0 +100.0 +100.0% +0.000 +0.000 +1.000 +-1.000  at [0-9.]+ 50.000$' report.txt
ok "criteria of lines" quality -c 'followed>=50,lateral<=0.25,vertical<=6.6' lattice.hm point.xyz lines.txt
quality -c 'followed>=80' lattice.hm point.xyz lines.txt >report.txt
near "missed: exit 1" $? 1 0
quality -c 'followed>=0' lattice.hm point.xyz >report.txt
near "no line at all meets no criterion" $? 1 0
quality -J lattice.hm point.xyz lines.txt >report.json
quality -J lines.txt point.xyz lattice.hm >other.json
same "lines first, mesh last" report.json other.json
{ echo '#hm 1 lines text'; echo '#units ft ft ft'; echo '#data'; awk '/^>/ { print; next }
    { print $1 / 0.3048, $2 / 0.3048, ($3 == "nan" ? "nan" : $3 / 0.3048) }' OFMT=%.17g CONVFMT=%.17g lines.txt
  echo '#end'; } >feet.hm
quality -J -o report.json lattice.hm point.xyz feet.hm
near "lines in feet: metres" "$(line half on_mesh)" 85 1e-9
near "and their heights" "$(line leaving vertical_largest)" 6.5 1e-9

# --- a channel drawn as one line round it: triangles between its banks have all nodes on the line ---
cat >channel.hm <<'END'
#hm 1 mesh text
#data
v 0 0 0 0 0
v 10 0 0 0 0
v 10 2 0 0 0
v 0 2 0 0 0
v 5 9 0 0 0
t 0 1 2 0
t 0 2 3 0
t 3 2 4 0
#end
END
printf '> name=banks\n0 0 0\n10 0 0\n10.005 2 0\n0 2 0\n> name=bank\n0 0 0\n10 0 0\n' >banks.txt
echo 5 1 0 >middle.xyz
quality -J -o report.json channel.hm middle.xyz banks.txt
near "two triangles dam the channel" "$(line banks triangles_on_line)" 2 0
near "the first of them" "$(line banks triangles_on_line 2)" "20 / 3" 1e-12
near "no triangle lies on one bank" "$(line bank triangles_on_line)" 0 0
ok "the text says so" sh -c "quality channel.hm middle.xyz banks.txt | grep -q 'all nodes on one line: 2, the first at 6.667 0.667'"

# --- awk as a second opinion: a wavy line over a bent mesh of triangles, by stations of its own ---
awk 'BEGIN { print "#hm 1 mesh text\n#data"
    for (j = 0; j <= 12; j++) for (i = 0; i <= 12; i++)
        print "v", 5 * i + sin(j), 5 * j + sin(i / 2), 2 * sin(i) + cos(j), 0, 0
    for (j = 0; j < 12; j++) for (i = 0; i < 12; i++) { a = 13 * j + i
        print "t", a, a + 1, a + 14, 0; print "t", a, a + 14, a + 13, 0 }
    print "#end" }' >bent.hm
awk 'BEGIN { print "> name=wave"
    for (k = 0; k <= 100; k++) print 5 + k / 2, 30 + sin((5 + k / 2) / 10) + 0.4 * sin(k / 3), 1 + k / 100 }' >wave.txt
quality -J --follow 0.3 -o report.json bent.hm point.xyz wave.txt
awk -v reach=0.3 '
    function toward(px, py, i, j,    dx, dy, t, l) { # distance from the edge, or 9 when it runs elsewhere
        dx = x[j] - x[i]; dy = y[j] - y[i]; l = sqrt(dx * dx + dy * dy)
        if ((dx * ux + dy * uy) / l < c15 && (dx * ux + dy * uy) / l > -c15) return 9
        t = ((px - x[i]) * dx + (py - y[i]) * dy) / l / l; t = t < 0 ? 0 : t > 1 ? 1 : t
        return sqrt((px - x[i] - t * dx) ^ 2 + (py - y[i] - t * dy) ^ 2) }
    BEGIN { c15 = cos(atan2(0, -1) / 12) }
    FNR == 1 { file++ }
    file == 1 && /^v/ { x[n + 0] = $2; y[n + 0] = $3; z[n++] = $4 }
    file == 1 && /^t/ { a[m] = $2; b[m] = $3; c[m++] = $4 }
    file == 2 && !/^>/ { if (k++) {
        l = sqrt(($1 - lx) ^ 2 + ($2 - ly) ^ 2); ux = ($1 - lx) / l; uy = ($2 - ly) / l
        s = int(l / reach); if (s < l / reach) s++
        for (q = 0; q < s; q++) { t = (q + 0.5) / s; px = lx + t * ($1 - lx); py = ly + t * ($2 - ly)
            best = 9; zz = ""
            for (e = 0; e < m; e++) {
                d = toward(px, py, a[e], b[e]); if (d < best) best = d
                d = toward(px, py, b[e], c[e]); if (d < best) best = d
                d = toward(px, py, c[e], a[e]); if (d < best) best = d
                area = (x[b[e]] - x[a[e]]) * (y[c[e]] - y[a[e]]) - (x[c[e]] - x[a[e]]) * (y[b[e]] - y[a[e]])
                u = ((x[b[e]] - px) * (y[c[e]] - py) - (x[c[e]] - px) * (y[b[e]] - py)) / area
                v = ((x[c[e]] - px) * (y[a[e]] - py) - (x[a[e]] - px) * (y[c[e]] - py)) / area
                if (u >= 0 && v >= 0 && u + v <= 1) zz = u * z[a[e]] + v * z[b[e]] + (1 - u - v) * z[c[e]] }
            all += l / s; dz = zz - lz - t * ($3 - lz)
            if (best <= reach) { on += l / s; side += best * l / s }
            rise += dz * l / s; size += (dz < 0 ? -dz : dz) * l / s } }
        lx = $1; ly = $2; lz = $3 }
    END { print all, 100 * on / all, side / on, rise / all, size / all }' OFMT=%.15g CONVFMT=%.15g bent.hm wave.txt >sums
read -r length followed lateral rise size <sums
true_that "some of it is followed" "$followed > 5 && $followed < 95"
near "awk: length" "$(line wave length)" "$length" 1e-9
near "awk: share followed" "$(line wave followed)" "$followed" 1e-9
near "awk: mean distance" "$(line wave lateral_mean)" "$lateral" 1e-9
near "awk: mean height" "$(line wave vertical_mean)" "$rise" 1e-9
near "awk: mean size of it" "$(line wave vertical_mean_size)" "$size" 1e-9

# --- a vertex typed wrong, names of another time ---
printf '> name=typo\n0 50 3.5\n1e15 50 3.5\n' >typo.txt
must_fail "a line of a million million kilometres" 2 "1e\+15 m straight.* at 0 50" timeout 20 quality lattice.hm point.xyz typo.txt
must_fail "stations without end" 2 "every 1e-09 m" timeout 20 quality --follow 1e-9 lattice.hm point.xyz lines.txt
printf '> name=Fl\303\274\337chen\n0 50 3.5\n100 50 13.5\n' >latin.txt
quality -J lattice.hm point.xyz latin.txt >report.json
ok "JSON is UTF-8, a name in Latin-1 as well" grep -q "\"$(printf 'Fl\303\274\303\237chen')\"" report.json

done_testing
