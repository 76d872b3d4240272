#!/bin/sh
# How near breaklines come to the true toes and crests of hmsurvey, where LiDAR covers them: settings
# against noise. Banks are those of the rivers and the levee (1:2 and 1:2.5, so half their slope is 11 to
# 13 degrees); the ditch (1:1.5, its bottom 1.6 m wide) is a table of its own. hmscore says what the columns
# mean. Ends with the goals at a noise of 0.05 m: status 1 when one is missed.
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}"
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# survey NOISE: a folder of that name, with the cover that counts
survey() {
    hmsurvey -s "$1" "$1"
    bsgrid --quiet --density "$1/survey.xyz" >"$1/cover.hm"
}

# The ways to breaklines, each from a survey to found.hm. The defaults are a limit of 11 degrees and lines
# smoothed by half a spacing.
old_way() { bsgrid --quiet -b -n 0 -k 1 "$1" | slope -b | breaklines --quiet -m node -l 30 >found.hm; }
paper_5() { bsgrid --quiet -b "$1" | slope -b | breaklines --quiet -s 5 -l 30 -w 0 >found.hm; }
paper_half() { bsgrid --quiet -b "$1" | slope -b | breaklines --quiet -l 30 -w 0 >found.hm; }
defaults() { bsgrid --quiet -b "$1" | slope -b | breaklines --quiet >found.hm; }
points() { bsgrid --quiet -b -B 6 -n 3 -f points "$1" | slope -b | breaklines --quiet >found.hm; }
fine() { bsgrid --quiet -b -B 6 -n 2 -f points -O 2 "$1" | slope -b | breaklines --quiet -l 20 -w 0.5 >found.hm; }
curvature() { bsgrid --quiet -b -B 6 -n 3 -f points "$1" | breaklines --quiet -m curvature >found.hm; }
gdal() { # the same start grid; contour lines of the slope, those shorter than 30 m left out
    bsgrid --quiet -n 0 -k 1 "$1" | hmconv -t asc >dem.asc
    gdaldem slope -q dem.asc slope.tif
    rm -f found.gmt
    gdal_contour -q -fl 11 -f OGR_GMT slope.tif found.gmt
    breaklines_of_gmt found.gmt >found.hm
}
breaklines_of_gmt() {
    awk '/^>/ { put(); n = 0; length_ = 0; next } /^#/ || NF < 2 { next }
        { if (n) length_ += sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2); x = $1; y = $2; line[n++] = x " " y " 0" }
        function put(k) { if (n > 1 && length_ >= 30) { print ">"; for (k = 0; k < n; k++) print line[k] } }
        END { put() }' "$1"
}

ways="old_way paper_5 paper_half defaults points fine curvature"
name() {
    case $1 in
    old_way) echo "linear grid, nodes, 11" ;;
    paper_5) echo "B-spline, interpolated, 5" ;;
    paper_half) echo "B-spline, interpolated, 11" ;;
    defaults) echo "the defaults" ;;
    points) echo "... -B 6 -n 3 -f points" ;;
    fine) echo "... -B 6 -n 2 -f points -O 2" ;;
    curvature) echo "-m curvature" ;;
    gdal) echo "gdaldem, gdal_contour, 11" ;;
    esac
}
command -v gdal_contour >/dev/null && ways="$ways gdal" || echo "gdal-bin is not installed: without its line"

for noise in 0.05 0.10 0.15; do
    survey $noise
    for way in $ways; do
        $way $noise/survey.xyz
        for what in main,tributary,levee ditch; do
            echo "$what $noise $way $(hmscore -f $what $noise/cover.hm $noise/true_lines.txt found.hm)"
        done
    done
done >scores

for what in main,tributary,levee ditch; do
    printf '\n%-28s %6s %8s %8s %8s %8s %8s\n' "$what" noise mean p95 found false ratio
    for way in $ways; do
        grep "^$what [0-9.]* $way " scores | while read -r _ noise _ mean p95 found false ratio; do
            printf '%-28s %6s %6s m %6s m %6s %% %6s %% %8s\n' "$(name "$way")" "$noise" "$mean" "$p95" "$found" \
                "$false" "$ratio"
        done
    done
done

# goals, for lines at half the bank's slope
echo
awk '$1 == "main,tributary,levee" && $2 == "0.05" && $3 ~ /^(paper_half|defaults|points|fine|curvature)$/ {
        goal($3 " p95, m", $5, "<=", 0.75); goal($3 " found, %", $6, ">=", 97)
        goal($3 " false, %", $7, "<=", 3); goal($3 " ratio", $8, "<=", 1.03) }
    function goal(what, got, sign, want, ok) {
        ok = sign == "<=" ? got + 0 <= want : got + 0 >= want
        printf "%-24s %8s  goal %s %-6s %s\n", what, got, sign, want, ok ? "ok" : "MISS"
        if (ok) good++; else missed++ }
    END { printf "%d ok, %d missed\n", good, missed; exit missed > 0 }' scores
