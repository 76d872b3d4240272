# study.sh: what the case studies share. A study is a script `. study.sh`, run in a folder of its own,
#
#     B=build tests/study/NAME FOLDER [small]
#
# that makes the meshes and pictures of a case of the paper from rough lines and a survey, and ends with a table
# of goals: status 1 when one is missed.

set -eu
study=$(cd "${0%/*}" && pwd)
: "${B:=$study/../../build}"
DATA=${HM_DATA:-$study/../../../shared/data}
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
mkdir -p "$1" && cd "$1" || exit 2
rm -f ./*.hm ./*.png ./*.txt goals
size=${2:-whole}
ok=0
missed=0

# draw FILE …: a picture, of the whole study and where hmdraw is built
draw() {
    out=$1
    shift
    [ $size = small ] || ! command -v hmdraw >/dev/null || hmdraw --quiet -o "$out" "$@"
}
# goal WHAT VALUE SIGN GOAL: a row of the table; SIGN is <= or >=
goal() {
    verdict=$(awk -v v="$2" -v sign="$3" -v g="$4" 'BEGIN {
        print v != "" && (sign == "<=" ? v + 0 <= g + 0 : v + 0 >= g + 0) ? "ok" : "MISS" }')
    if [ $verdict = ok ]; then ok=$((ok + 1)); else missed=$((missed + 1)); fi
    printf '%-58s %9s  %s %-7s %s\n' "$1" "$2" "$3" "$4" $verdict | tee -a goals
}
# finish: how many goals are met
finish() {
    echo "$ok ok, $missed missed"
    exit $((missed > 0))
}
# nodes MESH
nodes() {
    awk '/^v/ { n++ } END { print n + 0 }' "$1"
}
# of_report PATTERN FIELD: a number of report.txt
of_report() {
    awk -v pattern="$1" -v field="$2" '$0 ~ pattern { gsub(/[%,]/, ""); print $field; exit }' report.txt
}
# regular_goals SIZES FACED: regular.hm against breaklines.hm and the sizes asked for (regular.awk)
regular_goals() {
    awk -v size="$1" -v faced="$2" -f "$study/regular.awk" breaklines.hm regular.hm >regular.txt
    while read -r name bank ratio sharp counted; do
        [ "$bank" = 0.0000 ] || goal "$name: bank off its breakline, p95, control distances" "$bank" "<=" 0.1
        goal "$name: median edge ratio over the one asked for, off 1" \
            "$(awk -v r="$ratio" 'BEGIN { printf "%.4f", (r > 1 ? r - 1 : 1 - r) }')" "<=" 0.1
        goal "$name: under 0.8 atan(1/ratio), % of $counted % of its triangles" "$sharp" "<=" 1
    done <regular.txt
}
# seam_goals: what stitch said, in said.txt
seam_goals() {
    awk '/triangles in the gap/ { for (i = 2; i <= NF; i++) if ($i == "triangles") n += $(i - 1) }
        /degrees at/ { poor++ } END { printf "%d %.2f\n", n, n ? 100 - 100 * poor / n : 0 }' said.txt >seam.txt
    read -r all good <seam.txt
    goal "seams: of $all triangles at least 15 degrees, %" "$good" ">=" 99
    sed -n 's/^stitch: *\([0-9.]* degrees at.*\)/    under that: \1/p' said.txt
}
# even MESH: the part of the pairs of triangles with a common edge whose areas differ by a factor of 2 at most, %
even() {
    awk '/^v/ { x[n + 0] = $2; y[n++] = $3 }
        /^t/ { area = (x[$3] - x[$2]) * (y[$4] - y[$2]) - (x[$4] - x[$2]) * (y[$3] - y[$2])
            pair($2, $3); pair($3, $4); pair($4, $2) }
        function pair(a, b) { # an edge runs the other way in the element beside
            if (!((b, a) in beside)) { beside[a, b] = area; return }
            pairs++; good += area <= 2 * beside[b, a] && beside[b, a] <= 2 * area }
        END { if (pairs) printf "%.2f", 100 * good / pairs }' "$1"
}
# neighbour_goals: areas of neighbours in river.hm, the regular meshes with their seams, and in hybrid.hm
neighbour_goals() {
    for mesh in river hybrid; do
        goal "$mesh mesh: neighbours with area ratio up to 2, %" "$(even $mesh.hm)" ">=" 98
    done
}
