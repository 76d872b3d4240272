#!/bin/sh
# How near meshes of equal numbers of nodes come to the ground: the paper's way, quality, terrain, with
# heights measured and fitted, and a uniform mesh by gmsh with heights from the same TIN. One measurement
# in ten is held out from meshing and scores the mesh; on the generated survey (noise 0.05 m, no blunders)
# the true surface at those places does, too. Ends with the goals: status 1 when one is missed on the
# generated survey; of real ground they are only shown. Takes about ten minutes.
# BENCH_ARGS="SET ...": only these of generator, lidarhd_farmland_dense, danube_deggendorf (needs HM_DATA).
set -eu
: "${B:=$(cd "${0%/*}/../.." && pwd)/build}"
TESTS=$(cd "${0%/*}/.." && pwd)
PATH=$B/bin:$B/test:$PATH
LC_ALL=C
export PATH LC_ALL
command -v gmsh >/dev/null || { echo "gmsh is not installed"; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# --- meshes ---

# The closed line of a file as x y a vertex.
ring() { awk '/^>/ { next } NF > 1 { print $1, $2 }' "$1"; }

# gmsh AREA: elements with edges of one length, on the outline drawn in by a millionth, so that no node is
# outside the TIN; heights from that
uniform() {
    ring outline.txt | awk -v area="$1" '{ x[NR] = $1; y[NR] = $2; cx += $1; cy += $2 }
        END { cx /= NR; cy /= NR
            if (x[NR] == x[1] && y[NR] == y[1]) NR--
            for (i = 1; i <= NR; i++) {
                printf "Point(%d)={%.9f,%.9f,0};\n", i, x[i] + 1e-6 * (cx - x[i]), y[i] + 1e-6 * (cy - y[i])
                line = line (i > 1 ? "," : "") i }
            for (i = 1; i <= NR; i++) printf "Line(%d)={%d,%d};\n", i, i, i % NR + 1
            printf "Curve Loop(1)={%s};\nPlane Surface(1)={1};\n", line
            printf "Mesh.MeshSizeMin=%g;\nMesh.MeshSizeMax=%g;\n", sqrt(area / 0.866), sqrt(area / 0.866) }' >u.geo
    gmsh -2 -v 0 -format msh2 -o u.msh u.geo
    hmconv -t text u.msh >flat.hm
    awk '/^v/ { print $2, $3, 0 }' flat.hm >nodes.xyz
    quality --quiet -r heights.hm tin.hm nodes.xyz >/dev/null # mesh - 0
    awk 'NR == FNR { if ($1 == "#fields") for (i = 2; i <= NF; i++) if ($i == "residual") c = i - 1
                     if (!/^#/) z[n++] = $c; next }
         /^v/ { $4 = z[m++] } 1' heights.hm flat.hm
}

# mesh METHOD AREA: a mesh of meshed.xyz; AREA is about that a node, m2
mesh() {
    case $1 in
    gmsh) uniform "$2" ;;
    paper) trimesh --quiet -l "$(echo "$2" | awk '{ print 0.7 * sqrt($1) }')" meshed.xyz outline.txt ;;
    quality) trimesh --quiet -m quality -q 25 -a "$2" meshed.xyz outline.txt ;;
    quality-fit) trimesh --quiet -m quality -q 25 -a "$2" -z fit meshed.xyz outline.txt ;;
    terrain-fit) trimesh --quiet -m terrain -q 25 -l "$(echo "$2" | awk '{ print 0.4 * sqrt($1) }')" \
        -N "$(echo "$2 $area" | awk '{ print int($2 / $1) + 4 }')" -z fit meshed.xyz outline.txt ;;
    esac >mesh.hm
}

# --- scores ---

# score POINTS: RMSE, 95 %, green, yellow, red
score() {
    quality --quiet mesh.hm "$1" | awk '$1 == "all" { gsub(/%/, ""); g = $3; y = $4; r = $5; e = $8 }
        /95 % of/ { p = $6 } END { print e, p, g, y, r }'
}
# row SET METHOD NODES: bring the mesh to so many nodes within 2 %, score it
row() {
    size=$(echo "$area $3" | awk '{ print $1 / $2 }')
    for _ in 1 2 3 4 5 6; do
        mesh "$2" "$size"
        nodes=$(grep -c '^v' mesh.hm)
        next=$(echo "$size $nodes $3" | awk '{ r = $2 / $3; print (r < 1.02 && r > 0.98 ? $1 : $1 * r) }')
        [ "$next" != "$size" ] || break
        size=$next
    done
    angle=$(quality --quiet mesh.hm held.xyz | awk '/smallest angle  / { print $3 }')
    echo "$1 $2 $3 $nodes $angle $(score held.xyz) $(if [ -e true.xyz ]; then score true.xyz; fi)"
}
# table SET AREA-A-NODE ...: of the measurements on standard input, on the outline in outline.txt
table() {
    set=$1
    shift
    rm -f held.xyz meshed.xyz
    awk '/^#/ || NF < 3 { next } ++n % 10 == 0 { print >"held.xyz"; next } { print >"meshed.xyz" }'
    trimesh --quiet -m delaunay meshed.xyz >tin.hm
    if [ ! -s outline.txt ]; then # the hull, by the edges of a coarse mesh that are used once
        trimesh --quiet -m quality -q 0 -g 0 meshed.xyz |
            awk '/^v/ { x[n + 0] = $2; y[n + 0] = $3; n++ }
                /^t/ { to[$2 " " $3]; to[$3 " " $4]; to[$4 " " $2] }
                END { for (e in to) { split(e, p, " "); if (!((p[2] " " p[1]) in to)) { next_of[p[1]] = p[2]; at = p[1] } }
                    print "> boundary=1 closed=1"
                    for (first = at; at != first || !k++; at = next_of[at]) printf "%.9f %.9f\n", x[at], y[at] }' >outline.txt
    fi
    area=$(ring outline.txt | awk '{ x[NR] = $1; y[NR] = $2 } END { for (i = 1; i <= NR; i++) { j = i % NR + 1
        a += (x[i] - x[1]) * (y[j] - y[1]) - (x[j] - x[1]) * (y[i] - y[1]) } print a < 0 ? -a / 2 : a / 2 }')
    [ "$set" != generator ] || awk '{ print $1, $2 }' held.xyz | hmsurvey --true >true.xyz
    for per; do
        for method in gmsh paper quality quality-fit terrain-fit; do
            row "$set" $method "$(echo "$area $per" | awk '{ print int($1 / $2) }')" | tee -a scores |
                awk '{ printf "%-22s %-12s %7s %7s %6.2f %7s %7s %6s %6s %6s %9s\n",
                    $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11 }'
        done
    done
    rm -f true.xyz
}
points_of() { # SET: its points, or false
    for f in "${HM_DATA:-/nonexistent}/$1"/points.xyz "${HM_DATA:-/nonexistent}/$1"/points_ground.xyz.gz; do
        case $f in
        *.gz) [ ! -e "$f" ] || { gzip -dc "$f"; return; } ;;
        *) [ ! -e "$f" ] || { cat "$f"; return; } ;;
        esac
    done
    echo "$1 is not there (set HM_DATA)" >&2
    return 1
}

: >scores
printf '%-22s %-12s %7s %7s %6s %7s %7s %6s %6s %6s %9s\n' set method wanted nodes angle rmse p95 green \
    yellow red 'rmse,true'
for set in ${*:-generator lidarhd_farmland_dense danube_deggendorf}; do
    : >outline.txt
    case $set in
    generator)
        hmsurvey -b 0 . >/dev/null
        grep -v '^$' lines.txt | awk '/^>/ { on = /boundary=1/ } on' >outline.txt
        table generator 80 40 20 10 <survey.xyz ;;
    danube_deggendorf)
        awk '/^#/ { next } /^>/ { on = /boundary=1/ } on' "$TESTS/danube_lines.txt" >outline.txt
        points_of $set >points.xyz && table $set 1600 800 400 200 <points.xyz ;;
    *)
        points_of $set >points.xyz && table $set 80 40 20 10 <points.xyz ;;
    esac
done

# The goals. Of measurements noise is part of what they miss; only the true surface is free of it, so on
# real ground the ratio is that of whole squares, which no mesh brings under (noise / RMSE)^2.
echo
awk '{ key = $1 " " $3; true = $1 == "generator"; e = (true ? $11 : $6) ^ 2 }
    $2 == "gmsh" { uniform[key] = e }
    $2 == "quality" { quality[key] = e }
    $2 == "terrain-fit" {
        what = $1 " " $4 ": "
        goal(true, what "squares of errors to gmsh", e / uniform[key], "<=", 0.25)
        goal(true, what "squares of errors to quality", e / quality[key], "<=", 0.25)
        goal(1, what "angle", $5, ">=", 25)
        if (true && ++count == 3) {
            goal(1, what "green, %", $8, ">=", 90)
            goal(1, what "red, %", $10, "<=", 1) } }
    function goal(counts, what, got, sign, want, ok) {
        ok = sign == "<=" ? got <= want : got >= want
        printf "%-60s %8.3f  goal %s %-6s %s\n", what, got, sign, want, ok ? "ok" : counts ? "MISS" : "not reached"
        if (ok) good++; else if (counts) missed++ }
    END { printf "%d ok, %d missed\n", good, missed; exit missed > 0 }' scores
