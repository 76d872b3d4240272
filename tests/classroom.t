#!/bin/sh
# The classroom case of hybridmesh(7): what the page prints is what the programs say, and what can be
# computed by hand comes out when awk does, from the points alone or from what the page prints.
. "${0%/*}/tap.sh"

page=$TESTS/../man/hybridmesh.7
sed -n '/^\.Sh A CLASSROOM CASE/,/^\.Sh SWAPPING/p' "$page" |
    sed -e 's/\\-/-/g' -e 's/\\e$/\\/' -e 's/\\ / /g' -e 's/\\(pc/*/g' >section
# every block with a command
awk '/^\.Bd/ { block = ""; on = 1; next } /^\.Ed/ { if (block ~ /^\$ /) printf "%s", block; on = 0 }
    on { block = block $0 "\n" }' section >printed
"$TESTS/classroom/stages" case >said 2>log || { sed 's/^/# /' log; report 1 "the stages run"; }
same "what the page prints is what the programs say" printed said
cd case || exit 2

# the table of heights is the survey
sed -n 's/^y = *\([0-9]*\)  *\([-0-9 ]*\)$/\1 \2/p' ../section |
    awk '{ for (i = 2; i <= NF; i++) if ($i != "-") print 10 * (i - 2), $1, $i }
        END { print 59, 20, 3.875; print 63, 20, 4.375 }' | sort >table
grep -v '^#' points.xyz | sort >sorted
same "its table is the survey" sorted table
true_that "of about 30 points" "$(grep -c . sorted) == 33"

# its sums come out, to the last digit printed
tr -s '\n' ' ' <../section | grep -oE '[ (]\(*[0-9][-0-9.()/*+ ]*[/*+-][-0-9.()/*+ ]* = -?[0-9.]*[0-9]([^/0-9]|$)' |
    sed -e 's/[^0-9]$//' -e 's/^ *//' -e 's/\(.*\) = \(.*\)/\2 \1/' >sums
while read -r result sum; do
    true_that "$sum = $result" "($sum - ($result)) ^ 2 <= 0.2501 * 10 ^ (-2 * $(printf '%s' "${result#*.}" | wc -c))"
done <sums
true_that "sums found" "$(grep -c . sums) >= 9"

# --- analysis grid: basis by equations 5 to 7, surface by 4, one round of dragging ---
cat >surface.awk <<'END'
function N(i, r, u) {
    if (r == 0)
        return u >= i && u < i + 1
    return (u - i) / r * N(i, r - 1, u) + (i + r + 1 - u) / r * N(i + 1, r - 1, u)
}
# along a line of n control points and one more, extrapolated, at either end
function at(D, n, i) {
    return i < 0 ? 2 * D[0] - D[1] : i == n ? 2 * D[n - 1] - D[n - 2] : D[i]
}
function over(D, n, i) {
    return w[0] * at(D, n, i - 1) + w[1] * at(D, n, i) + w[2] * at(D, n, i + 1)
}
function smooth(Z, B,   i, j, row, D) {
    for (j = 0; j < 4; j++) {
        for (i = 0; i < 8; i++) D[i] = Z[i, j]
        for (i = 0; i < 8; i++) row[i, j] = over(D, 8, i)
    }
    for (i = 0; i < 8; i++) {
        for (j = 0; j < 4; j++) D[j] = row[i, j]
        for (j = 0; j < 4; j++) B[i, j] = over(D, 4, j)
    }
}
!/^#/ && $1 % 10 == 0 { Z[$1 / 10, $2 / 10] = $3 }
!/^#/ && $1 % 10 { beside[$1] = $3 }
END {
    for (k = 0; k < 3; k++)
        w[k] = N(0, 2, 2.5 - k)
    Z[6, 2] = beside[59] * (63 - 60) / 4 + beside[63] * (60 - 59) / 4
    smooth(Z, B)
    for (i = 0; i < 8; i++) for (j = 0; j < 4; j++) D[i, j] = Z[i, j] + Z[i, j] - B[i, j]
    smooth(D, S)
    print "w", w[0], w[1], w[2]
    for (j = 0; j < 4; j++) for (i = 0; i < 8; i++)
        printf "%d %d %.17g %.17g %.17g %.17g\n", 10 * i, 10 * j, Z[i, j], B[i, j], Z[i, j] - B[i, j], S[i, j]
}
END
awk -f surface.awk points.xyz >hand
true_that "the basis" "$(awk '/^w/ { print $2 " == 1/8 && " $3 " == 6/8 && " $4 " == 1/8" }' hand)"
# differ FILE FIELD: the greatest difference of its heights from that field of ours
differ() {
    grep -v '^#' "$1" | awk -v field="$2" 'NR == FNR { if (!/^w/) ours[$1, $2] = $field; next }
        { e = $3 - ours[$1, $2]; if (e < 0) e = -e; if (e > m) m = e; n++ } END { print (n == 32 ? m + 0 : 9) }' hand -
}
bsgrid --quiet -d 10 -k 1 -n 0 points.xyz >start.hm
bsgrid --quiet -d 10 -n 0 points.xyz >smooth.hm
true_that "the start grid, every node" "$(differ start.hm 3) == 0"
true_that "the surface by equation 4" "$(differ smooth.hm 4) < 1e-12"
true_that "dragged once" "$(differ dem.hm 6) < 1e-12"
# the nine misfits of the page
sed -n '/^\.Ss Dragging/,/^\.Ss The slope/p' ../section | grep -E '^ *-?[0-9.]+ +-?[0-9.]+ +-?[0-9.]+$' |
    tail -n 3 | awk '{ for (i = 1; i <= 3; i++) print 10 * (i - 1), 30 - 10 * (NR - 1), $i + 0 }' >nine
true_that "its nine misfits" "$(awk 'NR == FNR { if (!/^w/) r[$1, $2] = $5; next } $3 == r[$1, $2] { n++ }
    END { print n + 0 }' hand nine) == 9"

# --- slope by equation 1, a crossing by equation 8 ---
slope_by_hand=$(awk '!/^#/ { z[$1 / 10, $2 / 10] = $3 }
    END { q = sqrt(2); i = 1; j = 2; d = (4 + 2 * q) * 10
        u = (z[i+1,j+1] + q * z[i+1,j] + z[i+1,j-1] - z[i-1,j+1] - q * z[i-1,j] - z[i-1,j-1]) / d
        v = (z[i-1,j+1] + q * z[i,j+1] + z[i+1,j+1] - z[i-1,j-1] - q * z[i,j-1] - z[i+1,j-1]) / d
        printf "%.15g", atan2(sqrt(u * u + v * v), 1) * 180 / atan2(0, -1) }' dem.hm)
true_that "the slope by equation 1" "($slope_by_hand - $(awk '/^10 20 / { print $4 }' slope.hm))^2 < 1e-24"
awk '/^0 20 / { z = $3; s = $4 }
    /^10 20 / { t = (7 - s) / ($4 - s); printf "%.15g %.15g\n", 10 * t, z + t * ($3 - z) }' slope.hm >crossing
true_that "the crossing by equation 8" "$(awk 'NR == FNR { x = $1; z = $2; next }
    $2 == 20 && $1 < 25 { print ($1 - x)^2 + ($3 - z)^2 }' crossing breaklines.hm) < 1e-20"

# --- the Coons point from the border of the net, and a node from nine control points ---
bsmesh --quiet -k 1 -c 10/0,.1,.37,.63,.9,1 -e 10/7.4 --net bowed.net banks.txt bow.txt breaklines.hm \
    points.xyz >bowed.hm
true_that "the Coons point" "$(awk '/^>/ { row = $3 ~ /^row=/ ? substr($3, 5) : -1; i = 0; next }
    row >= 0 { x[row, i] = $1; y[row, i++] = $2 }
    function coons(p, v) {
        corners = ((1 - v) * (p[0, 0] + p[0, 2]) + v * (p[5, 0] + p[5, 2])) / 2
        return (p[2, 0] + p[2, 2]) / 2 + (1 - v) * p[0, 1] + v * p[5, 1] - corners
    }
    END { print (coons(x, 0.37) - x[2, 1])^2 + (coons(y, 0.37) - y[2, 1])^2 }' bowed.net) < 1e-16"
true_that "a node by equation 4" "$(awk 'BEGIN { split("1 6 1", w) }
    FILENAME == "net.hm" && /^>/ { row = $3 ~ /^row=/ ? substr($3, 5) : -1; i = 0; next }
    FILENAME == "net.hm" && row >= 1 && row <= 3 { i++; f = w[row] * w[i] / 64; x += f * $1; y += f * $2; z += f * $3 }
    FILENAME == "bed.hm" && /^v/ && ++n == 9 { print (x - $2)^2 + (y - $3)^2 + (z - $4)^2 }' net.hm bed.hm) < 1e-16"

# --- one step of coarsening, all residuals ---
true_that "4 m apart is under 6 m: the midpoint" "$(awk 'FILENAME ~ /001/ && /^v (59|63) 20 / { x += $2 / 2; z += $4 / 2 }
    FILENAME ~ /002/ && /^v/ && $2 == x && $3 == 20 { print ($4 == z) }' steps/001*.hm steps/002*.hm) == 1"
# every residual anew, by barycentric coordinates
quality --quiet -r exact.hm hybrid.hm points.xyz >quality.txt
awk '/^v/ { X[n + 0] = $2; Y[n + 0] = $3; Z[n++] = $4 }
    /^t/ { A[m + 0] = $2; B[m + 0] = $3; C[m++] = $4 }
    FILENAME == "exact.hm" && !/^#/ {
        for (t = 0; t < m; t++) {
            a = A[t]; b = B[t]; c = C[t]
            d = (X[b] - X[a]) * (Y[c] - Y[a]) - (X[c] - X[a]) * (Y[b] - Y[a])
            p = (($1 - X[a]) * (Y[c] - Y[a]) - (X[c] - X[a]) * ($2 - Y[a])) / d
            q = ((X[b] - X[a]) * ($2 - Y[a]) - ($1 - X[a]) * (Y[b] - Y[a])) / d
            if (p < -1e-12 || q < -1e-12 || p + q > 1 + 1e-12) continue
            r = Z[a] + p * (Z[b] - Z[a]) + q * (Z[c] - Z[a]) - $3
            e = r - $4; if (e < 0) e = -e; if (e > worst) worst = e
            r = r < 0 ? -r : r
            if ((r <= 0.1 ? 1 : r <= 0.3 ? 2 : 3) == $5) good++
            break
        }
    }
    END { print worst + 0, good + 0 }' hybrid.hm exact.hm >residuals
true_that "all residuals" "$(cut -d' ' -f1 residuals) < 1e-12"
true_that "and their classes by Table 1" "$(cut -d' ' -f2 residuals) == 33"
done_testing
